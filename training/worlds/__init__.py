"""Outdoor worlds made by seed, rendered with labels that photos lack: depth, light, matter."""

CLASSES = ("sky", "water", "vegetation", "ground", "rock", "snow", "building", "object")
"""What a pixel shows; the index is what is stored."""
