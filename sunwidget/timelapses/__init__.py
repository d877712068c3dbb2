"""Frames of one fixed camera: analyzed together, edited together."""
