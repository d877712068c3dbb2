"""Reject a sky of low confidence, such as walls and ceilings.

Refinement follows edges and colors, and makes a clean mask even from low probabilities. The
network's mean probability inside that mask separates rooms from skies: over 111 held-out photos it
is 0.77 and more in each daylight sky that fills part of the picture, 0.46 to 0.67 in most rooms.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.formats.color import LUMINANCE

_BELIEF = 0.75  # least mean probability of a daylight sky that fills part of a picture
_NIGHT, _BURNT = 0.2, 0.95  # median encoded luminance; the network is less sure outside
_MOST = 0.5  # of the picture; a wall this large would have furniture before it


def plausible(sky: np.ndarray, probability: np.ndarray, working: Working) -> bool:
    """Return whether a refined sky is likely to be a sky.

    Parameters
    ----------
    sky : (h, w) float32
        The refined sky, at any size.
    probability : (h, w) float32
        The network's map, at any size.
    working : Working
        The small photo.
    """
    import cv2

    height, width = sky.shape
    mask = (sky > 0.5).astype(np.uint8)
    # The network's map has a soft rim, which does not represent the inside.
    core = cv2.erode(mask, np.ones((9, 9), np.uint8)) > 0
    if not core.any():
        return True
    luminance = resize(working.encoded, width, height) @ LUMINANCE
    if not _NIGHT < float(np.median(luminance[core])) < _BURNT or float(mask.mean()) >= _MOST:
        return True
    return float(resize(probability, width, height)[core].mean()) >= _BELIEF
