"""The air's share of the land's light: haze and fog, which change with the sun as the sky does.

The land network predicts it (``air`` in models/MODEL_CARD.md; Koschmieder 1924: light = J t + A
(1 − t), the share is A (1 − t) over the light). Edges follow the picture, and no place has more air
than the darkest one nearby (dark channel: He, Sun & Tang, "Single Image Haze Removal Using Dark
Channel Prior", CVPR 2009).
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.depth.field import guided
from sunwidget.analysis.depth.levels import fill_sky
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.networks.land import look_at_land

# In longer sides, and squared contrast that is an edge.
_SMOOTH, _EPSILON = 0.02, 1e-3
_PATCH = 0.02  # a neighborhood that contains something dark
_NO_LAND = 9.0  # light of pixels that do not count
_SKYLINE = 0.05  # reach of the skyline into the sky


def air_share(working: Working, sky: np.ndarray) -> np.ndarray:
    """Return the share of the air's light in that of the land, (h, w) float32 in [0, 1].

    Parameters
    ----------
    working : Working
        The photo's small copy.
    sky : (h, w) float32
        Sky matte at its size; in the sky the share is that of the nearest land.

    Raises
    ------
    AnalysisError
        If onnxruntime is missing.
    """
    (rows, columns), land = sky.shape, sky < 0.5
    seen = fill_sky(resize(look_at_land(working).air, columns, rows), land)
    share = guided(working.encoded, seen, max(2, round(_SMOOTH * columns)), _EPSILON)
    share = np.minimum(np.clip(share, 0, 1), _most(working.luminance, land))
    return fill_sky(np.asarray(share, np.float32), land)


def _most(light: np.ndarray, land: np.ndarray) -> np.ndarray:
    """Return the light of the darkest land nearby over each pixel's, (h, w) in [0, 1]."""
    import cv2

    side = 2 * round(0.5 * _PATCH * max(light.shape)) + 1
    kernel = np.ones((side, side), np.uint8)
    dark = cv2.erode(np.where(land, light, np.float32(_NO_LAND)), kernel)
    # Opened, so that what is dark does not darken the fog beside it.
    dark = cv2.dilate(np.where(dark < _NO_LAND, dark, np.float32(0)), kernel)
    return np.minimum(dark / np.maximum(light, 1e-4), 1)


def cover_of_low_sky(sky: np.ndarray, clouds: np.ndarray) -> float:
    """Return the mean opacity of clouds in the sky over the skyline, [0, 1]; 0 without a sky.

    Parameters
    ----------
    sky : (h, w) float32
        Sky matte.
    clouds : (h', w') float32
        Share of pixels that clouds cover, at most the matte.
    """
    import cv2

    rows, columns = sky.shape
    near = sky * cv2.GaussianBlur(1 - sky, (0, 0), _SKYLINE * max(sky.shape))
    opacity = np.minimum(resize(clouds, columns, rows) / np.maximum(sky, 1e-3), 1)
    return float((near * opacity).sum() / max(float(near.sum()), 1e-6))
