"""Straight edges across a picture: the far end of water, independent of the sky mask."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from sunwidget.analysis.images.working_copy import resize

LARGEST_ROLL = 6.0  # degrees searched in either direction
_STEP = 0.25  # degrees; at the picture's ends 0.2 % of its width
_SIDE = 512  # px
_CONTRAST = 0.04  # encoded; a change of color this large counts half


class StraightEdge(NamedTuple):
    """A line in fractions of the picture's height.

    ``row`` is at the center column, ``roll`` in degrees (falls to the right), and ``strength``,
    0 to 1, the share of the width whose color changes across it in the same way.
    """

    row: float
    roll: float
    strength: float


def straight_edges(encoded: np.ndarray) -> list[StraightEdge]:
    """Find the straight edges of a picture, topmost first.

    For each row and roll, the change of color from just above to just below is averaged over the
    columns as a vector of bounded length: a long faint edge counts, a short strong one does not,
    and texture cancels out (a Hough transform of signed color).

    Parameters
    ----------
    encoded : (h, w, 3) float32
        sRGB-encoded, [0, 1].

    Returns
    -------
    list of StraightEdge
        Local maxima of strength 0.4 and more.
    """
    import cv2

    scale = min(1.0, _SIDE / max(encoded.shape[:2]))
    image = np.asarray(resize(encoded, encoded.shape[1] * scale, encoded.shape[0] * scale))
    height, width = image.shape[:2]
    reach = max(2, round(0.008 * height))
    if height < 8 * reach or width < 32:
        return []
    change = _change(image, reach)
    strength = np.zeros(height)
    roll = np.zeros(height)
    for degrees in np.arange(-LARGEST_ROLL, LARGEST_ROLL + _STEP / 2, _STEP):
        slope = float(np.tan(np.radians(degrees)))
        # Sheared so that lines of this roll become rows; outside the frame the change is 0.
        sheared = cv2.warpAffine(
            change,
            np.array([[1, 0, 0], [slope, 1, slope * (0.5 - width / 2)]]),
            (width, height),
            flags=cv2.INTER_NEAREST | cv2.WARP_INVERSE_MAP,
        )
        length = np.linalg.norm(cv2.reduce(sheared, 1, cv2.REDUCE_AVG)[:, 0], axis=-1)
        # Prefers small rolls, since most photos are level.
        better = length - 0.01 * abs(degrees) > strength - 0.01 * np.abs(roll)
        strength = np.where(better, length, strength)
        roll = np.where(better, degrees, roll)
    return [
        StraightEdge(row / height, float(roll[row]), float(strength[row]))
        for row in range(reach, height - reach)
        if strength[row] >= 0.4 and strength[row] == strength[max(row - 8, 0) : row + 9].max()
    ]


def _change(image: np.ndarray, reach: int) -> np.ndarray:
    """Return the change of color across the upper edge of each pixel, as vectors shorter than 1."""
    import cv2

    width = image.shape[1]
    soft = cv2.blur(image, (max(1, width // 100), 1))
    sums = np.cumsum(soft, axis=0, dtype=np.float64)
    total = np.concatenate([np.zeros((1, *soft.shape[1:])), sums])
    middle = total[reach:-reach]
    change = np.zeros(image.shape)
    difference = (total[2 * reach :] - middle) - (middle - total[: -2 * reach])
    change[reach : reach + len(difference)] = (difference / reach)[: image.shape[0] - reach]
    bounded = change / (np.linalg.norm(change, axis=-1, keepdims=True) + _CONTRAST)
    return np.asarray(bounded, np.float32)
