"""Outlines drawn by hand, as tables keep them: corners ``x,y`` in per cent of width and height."""

from __future__ import annotations

import numpy as np


def outlines_of(text: str, apart: str = ";") -> list[np.ndarray]:
    """Polygons (n, 2) in fractions of width and height, from their text, parted by ``apart``."""
    return [
        np.array([[float(v) / 100 for v in corner.split(",")] for corner in part.split()])
        for part in text.split(apart)
        if part.strip()
    ]
