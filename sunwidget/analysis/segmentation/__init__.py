"""Segment the sky: a coarse map, refined to a decision, then a matte."""
