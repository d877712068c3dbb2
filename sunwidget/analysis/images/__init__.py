"""The working copy of a photo, and general image operations: enlarging, filling, noise, color."""
