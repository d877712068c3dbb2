"""Frames of one fixed camera: analysed together, edited together."""
