"""Water: level surfaces below the horizon that mirror the sky.

``METHODS`` maps a name to a function ``(Working, sky, horizon_row) -> (h, w) float32``.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from sunwidget.analysis.working import Working


def none(working: Working, sky: np.ndarray, horizon_row: float) -> np.ndarray:
    """Call nothing water."""
    return np.zeros_like(sky)


METHODS: dict[str, Callable[[Working, np.ndarray, float], np.ndarray]] = {"none": none}


def glitter(working: Working, sky: np.ndarray) -> np.ndarray:
    """Zone of the old sun's glints: land or water around pixels burnt white.

    A zone, not the pixels themselves: what is burnt and what nearly is must be relit alike, or
    the brightest would come out darker than their rim.

    Returns
    -------
    (h, w) float32 in [0, 1]
    """
    import cv2

    red, green, blue = np.moveaxis(working.linear, -1, 0)
    white = np.minimum(np.minimum(red, green), blue)  # ten times as fast as min(-1)
    burnt = np.clip((white - 0.5) / 0.4, 0, 1).astype(np.float32) * (1 - sky)
    reach = 2 * max(2, round(0.012 * max(sky.shape))) + 1
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (reach, reach))
    # In bytes: a fifth of the time, and as fine as what it becomes for the frame.
    spread = cv2.dilate(np.round(burnt * 255).astype(np.uint8), kernel)
    zone = cv2.GaussianBlur(spread.astype(np.float32) / 255, (0, 0), reach / 3)
    return np.clip(zone * (1 - sky), 0, 1).astype(np.float32)
