"""Soften borders where the photo shows no edge: fog, haze before mountains, clouds, wet sand.

A mask has a border everywhere, and a moved sun changes both of its sides differently. An
edge-preserving smoother (Min et al., "Fast global image smoothing based on weighted least squares",
2014) spreads the border as far as the photo is smooth, and keeps it where the photo has an edge.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.images.working_copy import Working, resize, shrink, smoothstep

# Chosen by eye on a few pictures. Of others, on 60 photos, twice the reach and its edge were worse
# by far (8 to 37 pairs), and half of them a little (21 to 27).
_LONG_SIDE = 256  # pixels: in a larger copy, blurred edges are ramps that do not stop the smoother
_REACH = 0.06  # of the longer side: how far a border spreads where the photo is uniform
_EDGE = 4.0  # code values between neighbors, at which e times less spreads
_FOG = (0.1, 0.4)  # change of the matte at which the border is no edge of the photo at all
# The same for water, whose border the networks know less well: twice as wide.
_WATER_REACH = 0.12
_WATER_EDGE = 9.0
_THERE = (0.05, 0.25)  # probability of water from which it may spread, and spreads as far as it can
_SHARE_EDGE = 6.0  # of a map that is placed to within a few pixels
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

    levels = _guide(working)
    height, width = levels.shape[:2]
    sky, clouds, glare = (resize(image, width, height) for image in (sky, clouds, glare))
    spread = _smoothed(levels, sky)
    change = _beyond_least(spread - sky) * (1 - _widened(glare))
    # Lost sky takes its share of cloud along; new sky is as cloudy as the sky beside it.
    here = clouds / np.maximum(sky, _LEAST)
    beside = _smoothed(levels, clouds) / np.maximum(spread, _LEAST)
    cloudy = change * np.clip(np.where(change > 0, beside, here), 0, 1)
    fog = smoothstep(*_FOG, cv2.dilate(np.abs(change), np.ones((5, 5), np.uint8)))
    return np.stack([change + fog * sky, cloudy + fog * clouds, 1 - fog], -1).astype(np.float32)


def softened_water(
    working: Working, sky: np.ndarray, water: np.ndarray, odds: np.ndarray
) -> np.ndarray:
    """Return water with an edge as wide as the photo is smooth.

    On wet sand, in mist and on a bank before its mirror image nobody can tell where water begins.

    Parameters
    ----------
    working : Working
        The small copy of the photo.
    sky, water : (h, w) float32
        Sky matte, and share of water, [0, 1], at its size.
    odds : (H, W) float32
        Probability of water by the networks, of any size: it spreads only where they doubt.

    Returns
    -------
    (h, w) float32
    """
    import cv2

    if not hasattr(cv2, "ximgproc"):  # another package replaced opencv-contrib-python-headless
        return water
    levels = _guide(working)
    size = levels.shape[1], levels.shape[0]
    small, ground = resize(water, *size), resize(1 - sky, *size)
    # Relative to what is not sky: far water may be as white as the sky above it.
    spread, seen = (_smoothed(levels, i, _WATER_REACH, _WATER_EDGE) for i in (small, ground))
    change = _beyond_least(ground * (spread / np.maximum(seen, _LEAST) - small))
    change *= np.where(change > 0, smoothstep(*_THERE, resize(odds, *size)), 1)
    return np.clip(water + resize(change.astype(np.float32), *water.shape[::-1]), 0, 1)


def share_along_edges(working: Working, part: np.ndarray, whole: np.ndarray) -> np.ndarray:
    """Return the share of ``whole`` that ``part`` has, ending at the photo's edges.

    Parameters
    ----------
    working : Working
        The small copy of the photo.
    part, whole : (h, w) float32
        Maps of any size, the first nowhere above the second.

    Returns
    -------
    (h, w) float32 in [0, 1]
    """
    import cv2

    if not hasattr(cv2, "ximgproc"):
        return part / np.maximum(whole, _LEAST)
    levels = _guide(working)
    size = levels.shape[1], levels.shape[0]
    some, all_ = (_smoothed(levels, resize(i, *size), edge=_SHARE_EDGE) for i in (part, whole))
    share = np.clip(some / np.maximum(all_, _LEAST), 0, 1).astype(np.float32)
    return np.asarray(resize(share, *part.shape[::-1]))


def _smoothed(
    levels: np.ndarray, image: np.ndarray, reach: float = _REACH, edge: float = _EDGE
) -> np.ndarray:
    """Return ``image`` (h, w) smoothed where ``levels``, (h, w, 3) uint8, has no edge."""
    import cv2

    strength = (reach * max(image.shape)) ** 2
    image = np.ascontiguousarray(image, np.float32)
    return np.asarray(cv2.ximgproc.fastGlobalSmootherFilter(levels, image, strength, edge))


def _guide(working: Working) -> np.ndarray:
    guide = shrink(working.encoded, _LONG_SIDE)
    return np.clip(guide * 255 + 0.5, 0, 255).astype(np.uint8)


def _beyond_least(change: np.ndarray) -> np.ndarray:
    return np.sign(change) * np.maximum(np.abs(change) - _LEAST, 0)


def _widened(glare: np.ndarray) -> np.ndarray:
    import cv2

    side = 2 * round(_REACH / 2 * max(glare.shape)) + 1
    wide = cv2.dilate(np.ascontiguousarray(glare, np.float32), np.ones((side, side), np.uint8))
    return np.asarray(cv2.blur(wide, (side, side)))
