"""Depth in metres, how the land lies, and the methods that find them."""
