"""Bruneton's precomputed sky, a model of the explorer."""
