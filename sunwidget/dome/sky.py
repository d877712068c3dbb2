"""The sky of an environment map, found by the photos' network in perspective views."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.dome.sphere import angles, sample
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera

Floats = NDArray[np.float32]

_SIDE, _FOV = 384, 65.0
# Pitch and number of the views: one row at the horizon, one toward the zenith.
_VIEWS = ((12.0, 8), (58.0, 4))
_BORDER = 40.0  # pixels over which a view's weight fades to its border
_EXPOSED = 0.6, 0.4  # quantile of a view's light, and the light that it maps to
_RADIUS, _EDGE = 0.4, 1e-4  # degrees over which the mask follows the picture; squared contrast
_SURE = 0.15  # distance from 0 or 1 within which the network's answer is certain
_WIDEST = 1024  # width in pixels of the map that the views sample


def find_sky(light: NDArray[Any]) -> Floats:
    """Return the probability of sky (H, W) for a map's pixels, [0, 1]; 0 below the horizon."""
    import cv2

    from sunwidget.analysis.depth.field import guided
    from sunwidget.analysis.images.working_copy import Working, encode, log_odds, resize
    from sunwidget.analysis.segmentation.coarse_sky import network

    width = min(light.shape[1], _WIDEST)
    small = np.asarray(resize(np.asarray(light, np.float32), width, width // 2), np.float32)
    azimuth, elevation = angles(width)
    odds, total = np.zeros(small.shape[:2]), np.full(small.shape[:2], 1e-6)
    for pitch, count in _VIEWS:
        camera = Camera(_SIDE, _SIDE, _FOV, pitch)
        across, up = camera.angles(*np.meshgrid(np.arange(_SIDE) + 0.5, np.arange(_SIDE) + 0.5))
        for turn in np.arange(count) * 360 / count:
            seen = expose(sample(small, across + turn, up))
            encoded = encode(seen)
            found = network(Working(seen, encoded, encoded, (1.0, 1.0)))
            found = np.asarray(log_odds(resize(found, _SIDE, _SIDE)), np.float32)
            x, y = camera.pixel((azimuth - turn + 180) % 360 - 180, elevation)
            margin = np.minimum.reduce([x, y, _SIDE - x, _SIDE - y]) / _BORDER
            weight = np.nan_to_num(np.clip(margin, 0, 1), nan=0.0)
            at = [np.nan_to_num(part - 0.5, nan=-1e4).astype(np.float32) for part in (x, y)]
            odds += weight * cv2.remap(found, *at, cv2.INTER_LINEAR)
            total += weight
    mask = (1 / (1 + np.exp(-odds / total))).astype(np.float32)
    mask = resize(mask, light.shape[1], light.shape[0])
    picture = encode(expose(np.asarray(light, np.float32)))
    radius = max(1, round(_RADIUS * light.shape[1] / 360))
    mask = np.clip((guided(picture, mask, radius, _EDGE) - _SURE) / (1 - 2 * _SURE), 0, 1)
    above = np.arange(light.shape[0])[:, None] < light.shape[0] // 2
    return np.asarray(mask * above, np.float32)


def expose(light: Floats) -> Floats:
    """Return light (…, 3) exposed as by a camera, 1 - e^-x, which never reaches white."""
    quantile, target = _EXPOSED
    level = max(float(np.quantile(light @ LUMINANCE, quantile)), 1e-12)
    return np.asarray(1 - np.exp(-np.maximum(light, 0) * (target / level)), np.float32)
