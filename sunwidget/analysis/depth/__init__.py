"""Depth in metres, the land's relief, and the methods that find them."""
