"""Doubt: what the network takes for sky without much conviction, as walls and ceilings.

Refinement follows edges and colours, and makes a clean mask of a faint idea. The network's own
mean probability inside that mask tells rooms from skies: over 111 held-out photos 0.77 and more in
every daylight sky that fills part of the picture, in most rooms 0.46 to 0.67.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.working import LUMINANCE, Working, resize

_BELIEF = 0.75  # least mean probability of a sky in daylight that fills part of a picture
_PATCH_BELIEF = 1 / 3  # and of a patch away from the rest
_PATCH = 0.004  # of the picture: smaller ones show between leaves and girders, at any belief
_NIGHT, _BURNT = 0.2, 0.95  # median encoded luminance of skies that the network knows less
_MOST = 0.5  # of the picture: walls that fill as much come with furniture


def plausible(sky: np.ndarray, probability: np.ndarray, working: Working) -> np.ndarray:
    """Return which pixels of a refined sky to keep.

    Parameters
    ----------
    sky : (h, w) float32
        The refined sky, at any size.
    probability : (h, w) float32
        The network's map, at any size.
    working : Working
        The small photo.

    Returns
    -------
    (h, w) bool
        At the size of ``sky``; False everywhere when the whole sky is unlikely.
    """
    import cv2

    height, width = sky.shape
    keep = np.ones(sky.shape, bool)
    mask = (sky > 0.5).astype(np.uint8)
    # The network's own rim is soft, and says little about what it thinks of the inside.
    core = cv2.erode(mask, np.ones((9, 9), np.uint8)) > 0
    if not core.any():
        return keep
    belief = resize(probability, width, height)
    luminance = resize(working.encoded, width, height) @ LUMINANCE
    level = float(np.median(luminance[core]))
    usual = _NIGHT < level < _BURNT and float(mask.mean()) < _MOST
    if usual and float(belief[core].mean()) < _BELIEF:
        return ~keep
    count, labels, stats, _ = cv2.connectedComponentsWithStats(mask, connectivity=4)
    weight = np.bincount(labels.ravel(), core.ravel(), minlength=count)
    inside = np.bincount(labels.ravel(), (belief * core).ravel(), minlength=count)
    mean = np.where(weight > 0, inside / np.maximum(weight, 1), 1.0)
    unlikely = (mean < _PATCH_BELIEF) & (stats[:, cv2.CC_STAT_AREA] > _PATCH * sky.size)
    unlikely[0] = False
    if unlikely.any():
        # With its soft rim, which lies outside the mask.
        drop = cv2.dilate(unlikely[labels].astype(np.uint8), np.ones((7, 7), np.uint8)) > 0
        keep &= ~(drop & (unlikely[labels] | (mask == 0)))
    return keep
