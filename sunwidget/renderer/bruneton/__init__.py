"""Bruneton's precomputed sky, one of the explorer's models."""
