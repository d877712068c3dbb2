"""Soften the sky's border where the photo shows no edge: fog, haze before mountains, clouds.

A mask has a border everywhere, and a moved sun changes both of its sides differently. An
edge-preserving smoother (Min et al., "Fast global image smoothing based on weighted least squares",
2014) spreads the border as far as the photo is smooth, and keeps it where the photo has an edge.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.images.working_copy import Working, resize, shrink, smoothstep

# Chosen by eye on a few pictures.
_LONG_SIDE = 256  # pixels: in a larger copy, blurred edges are ramps that do not stop the smoother
_REACH = 0.06  # of the longer side: how far a border spreads where the photo is uniform
_EDGE = 4.0  # code values between neighbors, at which e times less spreads
_FOG = (0.1, 0.4)  # change of the matte at which the border is no edge of the photo at all
_LEAST = 0.01  # subtracted from any change, so that most pixels stay sky or land alone


def softening(
    working: Working, sky: np.ndarray, clouds: np.ndarray, glare: np.ndarray
) -> np.ndarray:
    """Return how a matte and the opacity of its clouds are softened: factor · map + addend.

    Parameters
    ----------
    working : Working
        The small copy of the photo.
    sky, clouds, glare : (H, W) float32
        Matte (1 = sky), opacity of the clouds, and where the sun outshines the photo's edges:
        nothing is softened there or near it. Each may have its own size.

    Returns
    -------
    (h, w, 3) float32
        Addends of matte and opacity, and the factor of both, at most 256 pixels wide and high;
        0, 0 and 1 where the border is kept. In fog the factor is 0: not even the fine line of the
        border is left.
    """
    import cv2

    guide = shrink(working.encoded, _LONG_SIDE)
    height, width = guide.shape[:2]
    levels = np.clip(guide * 255 + 0.5, 0, 255).astype(np.uint8)
    sky, clouds, glare = (resize(image, width, height) for image in (sky, clouds, glare))
    spread = _smooth(levels, sky)
    change = spread - sky
    change = np.sign(change) * np.maximum(np.abs(change) - _LEAST, 0) * (1 - _widened(glare))
    # Lost sky takes its share of cloud along; new sky is as cloudy as the sky beside it.
    here = clouds / np.maximum(sky, _LEAST)
    beside = _smooth(levels, clouds) / np.maximum(spread, _LEAST)
    cloudy = change * np.clip(np.where(change > 0, beside, here), 0, 1)
    fog = smoothstep(*_FOG, cv2.dilate(np.abs(change), np.ones((5, 5), np.uint8)))
    return np.stack([change + fog * sky, cloudy + fog * clouds, 1 - fog], -1).astype(np.float32)


def _smooth(levels: np.ndarray, image: np.ndarray) -> np.ndarray:
    import cv2

    strength = (_REACH * max(image.shape)) ** 2
    image = np.ascontiguousarray(image, np.float32)
    return np.asarray(cv2.ximgproc.fastGlobalSmootherFilter(levels, image, strength, _EDGE))


def _widened(glare: np.ndarray) -> np.ndarray:
    import cv2

    side = 2 * round(_REACH / 2 * max(glare.shape)) + 1
    wide = cv2.dilate(np.ascontiguousarray(glare, np.float32), np.ones((side, side), np.uint8))
    return np.asarray(cv2.blur(wide, (side, side)))
