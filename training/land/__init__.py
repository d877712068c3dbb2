"""The network that sees how land lies and what light falls on it."""
