"""Corrections with brush strokes, computed only where the strokes touch."""
