"""Water: level surfaces below the horizon that reflect the sky.

``METHODS`` maps a name to a function ``(Working, sky, Horizon, SunMaps) -> (h, w) float32``; the
horizon is in working pixels.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from sunwidget.analysis.horizon.horizon import Horizon, above
from sunwidget.analysis.images.working_copy import Working, log_odds, resize, smoothstep
from sunwidget.analysis.networks.land import look_at_land
from sunwidget.analysis.networks.sky import look_at_sky
from sunwidget.analysis.networks.sun import SunMaps
from sunwidget.analysis.segmentation.feather import softened_water
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera

_EDGE = (0.45, 0.55)  # probabilities between which a pixel is partly water
_BELIEF = 0.6  # mean probability from which a patch is water
WEIGHTS = (0.35, 0.55, 0.1)  # of the log odds of the networks of suns, sky and land
_BURNT = 0.9  # linear light from which a pixel has lost its color
_COLUMN = 0.08  # of the width: half of the widest column of glints that hides the water
_SUN = 0.3  # probability of a sun from which its column may be twice as wide
_GAP = 0.02  # of the width: half of the gap between water and sky
_STRIP = 0.005  # of the width: half of the gap above the horizon
_NO_LAND = 0.6  # probability of sky or water from which a gap as wide as below it is no land
_LEAST = 0.004  # of the picture: less is a puddle, or nothing
_RADIUS = 5  # px of the working copy: distance over which the mask's edge follows the picture
_EPSILON = 1e-4


def none(working: Working, sky: np.ndarray, horizon: Horizon, maps: SunMaps) -> np.ndarray:
    """Return no water."""
    return np.zeros_like(sky)


def network(working: Working, sky: np.ndarray, horizon: Horizon, maps: SunMaps) -> np.ndarray:
    """Find water with the networks of suns, sky and land.

    Parameters
    ----------
    working : Working
        The small photo.
    sky : (h, w) float32
        Sky matte at its size.
    horizon : Horizon
        Horizon in its pixels.
    maps : SunMaps
        The sun network's output.

    Returns
    -------
    (h, w) float32
        Share of water in a pixel, [0, 1]; zero everywhere if there is almost none.
    """
    height, width = sky.shape
    camera = Camera.from_horizon(width, height, 50.0, horizon.row, roll=horizon.roll)
    ground = (1 - sky) * (1 - above(camera, width, height))
    small = (maps.water.shape[1], maps.water.shape[0])
    others = (resize(look(working).water, *small) for look in (look_at_sky, look_at_land))
    odds = water_odds(maps.water, *others)
    likely = _believed(odds * resize(1 - sky, *small))
    water = smoothstep(*_EDGE, resize(likely, width, height)) * ground
    if water.mean() < _LEAST:
        return np.zeros_like(sky)
    seen = look_at_sky(working)
    no_land = resize(seen.sky + seen.water, width, height) > _NO_LAND
    water = soft_edged(working, sky, _with_glints(working, sky, ground, no_land, water, maps))
    return softened_water(working, sky, water, odds * resize(ground, *small)) * (1 - sky)


METHODS: dict[str, Callable[[Working, np.ndarray, Horizon, SunMaps], np.ndarray]] = {
    "none": none,
    "network": network,
}


def _believed(likely: np.ndarray) -> np.ndarray:
    """Return the probability (h, w) in patches that are water as a whole."""
    import cv2

    count, labels = cv2.connectedComponents((likely > _EDGE[0]).astype(np.uint8), connectivity=4)
    size = np.bincount(labels.ravel(), minlength=count)
    mean = np.bincount(labels.ravel(), likely.ravel(), count) / np.maximum(size, 1)
    kept = (mean > _BELIEF) & (np.arange(count) > 0)
    return np.where(kept[labels], likely, 0).astype(np.float32)


def water_odds(*seen: np.ndarray) -> np.ndarray:
    """Return the probability (h, w) of water from three networks' outputs, each (h, w) in [0, 1].

    The order is that of ``WEIGHTS``. On photos the land network adds nothing, but without it plain
    ground of rendered pictures would be water (``training/land/calibrate_water.py``).
    """
    score = sum(weight * log_odds(one) for weight, one in zip(WEIGHTS, seen, strict=True))
    return np.asarray(1 / (1 + np.exp(-score)), np.float32)


def _with_glints(
    working: Working,
    sky: np.ndarray,
    ground: np.ndarray,
    no_land: np.ndarray,
    water: np.ndarray,
    maps: SunMaps,
) -> np.ndarray:
    """Add bright pixels between water and water, or between water and sky.

    They include the sun's clipped column, whose surface is invisible; it is widest below the sun.
    """
    import cv2

    def closed(image: np.ndarray, columns: float, rows: float) -> np.ndarray:
        kernel = np.ones([2 * round(side * water.shape[1]) + 1 for side in (rows, columns)])
        kernel = kernel.astype(np.uint8)
        return cv2.morphologyEx(image, cv2.MORPH_CLOSE, kernel, borderType=cv2.BORDER_REFLECT)

    light = working.encoded @ LUMINANCE
    share = water.sum(axis=1)
    rows = np.flatnonzero(share > 0)
    level = (light * water).sum(axis=1)[rows] / share[rows]
    level = np.interp(np.arange(len(share)), rows, level)
    brighter = smoothstep(0.0, 0.1, light - level[:, None])
    # The farthest water below the sky is thinner than the network's map; land there is darker.
    as_bright = smoothstep(0.6, 0.8, light / np.maximum(level, _EPSILON)[:, None])
    found = np.maximum(water, closed(water, _COLUMN, 0) * brighter * ground)
    below = _below_sun(maps, water.shape[1])
    found = np.maximum(found, closed(found, 2 * _COLUMN, 0) * below * as_bright * ground)
    found = np.maximum(found, closed(np.maximum(found, sky), 0, _GAP) * as_bright * ground)

    # The horizon is known to a few rows; gaps between sky and sky are not water.
    def strip(reach: float) -> np.ndarray:
        gap = closed(np.maximum(found, sky), 0, reach) - closed(sky, 0, reach)
        return np.maximum(gap, 0) * as_bright

    found = np.maximum(found, np.maximum(strip(_STRIP), strip(_GAP) * no_land))
    return np.asarray(found, np.float32)


def _below_sun(maps: SunMaps, width: int) -> np.ndarray:
    """Return the columns, (width,) bool, that a detected sun's column of glints may cover."""
    row, column = np.unravel_index(int(maps.probability.argmax()), maps.probability.shape)
    seen = float(maps.probability[row, column]) > _SUN
    away = np.abs((np.arange(width) + 0.5) / width - (column + 0.5) / maps.probability.shape[1])
    return np.asarray(seen & (away < 2 * _COLUMN))


def soft_edged(working: Working, sky: np.ndarray, water: np.ndarray) -> np.ndarray:
    """Give a mask of any size edges that follow the picture (guided filter, He et al. 2013).

    Returns
    -------
    (h, w) float32
        At working size, [0, 1], 0 in the sky.
    """
    import cv2

    found = resize(water, working.width, working.height).astype(np.float32)
    # Where water meets the sky, the sky's matte is its edge.
    near = cv2.dilate(found, np.ones((2 * _RADIUS + 1, 2 * _RADIUS + 1), np.uint8))
    rough = np.maximum(found, near * sky)
    guide = np.sqrt(np.clip(working.luminance, 0, 1)).astype(np.float32)

    def mean(image: np.ndarray) -> np.ndarray:
        return cv2.blur(image, (2 * _RADIUS + 1, 2 * _RADIUS + 1), borderType=cv2.BORDER_REFLECT)

    middle, share = mean(guide), mean(rough)
    slope = (mean(guide * rough) - middle * share) / (mean(guide * guide) - middle**2 + _EPSILON)
    fine = mean(slope) * guide + mean(share - slope * middle)
    fine = np.clip(1.5 * (fine - 0.5) + 0.5, 0, 1)
    # Water and sky clipped by a low sun look alike, and the filter would leave a strip of land.
    strip = cv2.morphologyEx(np.maximum(fine, sky), cv2.MORPH_CLOSE, np.ones((2 * _RADIUS + 1, 1)))
    burnt = smoothstep(_BURNT / 2, _BURNT, working.linear.max(-1))
    return np.asarray(np.maximum(fine, np.minimum(strip, found) * burnt) * (1 - sky), np.float32)
