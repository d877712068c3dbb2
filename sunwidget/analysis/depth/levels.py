"""Depth for the frame: eight bits of log-depth per pixel, with the sky filled from the land.

level = log2(depth in metres, clamped to 1 … 65 536) / 16, so that one of 255 levels is 4.4 % of
the depth. A dither of ± half a level lets neighboring pixels represent values between levels.
"""

from __future__ import annotations

import numpy as np

OCTAVES = 16.0  # 1 m to 65 536 m


def to_level(log_depth: np.ndarray) -> np.ndarray:
    """Return the level of ln(metres): float32 in [0, 1]; below 1 m it is 0, inf is 1."""
    octaves = np.asarray(log_depth, np.float32) * np.float32(1 / (OCTAVES * np.log(2)))
    return np.clip(octaves, 0, 1)


def to_depth(level: np.ndarray) -> np.ndarray:
    """Return the metres of a level, the inverse of ``to_level``."""
    return np.asarray(np.exp2(np.asarray(level, np.float32) * np.float32(OCTAVES)))


def fill_sky(values: np.ndarray, land: np.ndarray) -> np.ndarray:
    """Give each pixel outside the land the value of the nearest one inside.

    Parameters
    ----------
    values : (h, w) or (h, w, n) float32
    land : (h, w) bool

    Returns
    -------
    array of the shape of ``values``
        ``values`` itself if all or no pixels are land.
    """
    import cv2

    if land.all() or not land.any():
        return values
    _, labels = cv2.distanceTransformWithLabels(
        (~land).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    # Each pixel of the land has its own label, which the pixels nearest to it share.
    of_label = np.zeros((int(labels.max()) + 1, *values.shape[2:]), np.float32)
    of_label[labels[land]] = values[land]
    filled = values.copy()
    filled[~land] = of_label[labels[~land]]
    return filled


def dithered(level: np.ndarray, first_row: int = 0) -> np.ndarray:
    """Add ± half an 8-bit level of fixed interleaved gradient noise.

    ``level`` (h, w) float32 may be some rows of a picture, from ``first_row`` on. The noise has a
    mean of nearly 0 over any 3 × 3 pixels (Jimenez, "Next generation post processing in Call of
    Duty: Advanced Warfare", SIGGRAPH 2014 course), so that small averages are exact.
    """
    height, width = level.shape
    slope = np.float32(0.06711056) * np.arange(width, dtype=np.float32)
    rows = np.arange(first_row, first_row + height, dtype=np.float32)[:, None]
    rows *= np.float32(0.00583715)
    noise = slope + rows
    noise -= np.floor(noise)
    noise *= np.float32(52.9829189)
    noise -= np.floor(noise)
    noise -= np.float32(0.5)
    noise *= np.float32(1 / 255)
    noise += level
    return np.clip(noise, 0, 1, out=noise)
