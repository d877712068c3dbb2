"""Water, and the glints of the old sun on it."""
