"""A sky's clouds, told from its slow light: what the sun's glare hides is borrowed from beside it.

Of what the glare only brightens the photo keeps what is finer than a halo; the rest of the clouds
there, and all of them where the camera clipped, are those left and right of it, mirrored.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.images.fill import fill_by_pyramid, mirrored
from sunwidget.analysis.images.working_copy import resize
from sunwidget.formats.color import LUMINANCE
from sunwidget.formats.pixels import size_within

DETAILED = 512
"""Longer side of the map, in pixels."""

# In longer sides.
_FINE = 0.02  # what is finer is cloud and not glare, also in the glare
_COARSE = 0.04  # what is coarser is the sky's slow light
_SKYLINE = 0.006  # so near to the skyline, which holds twigs, clouds are not believed
_FADE, _FADE_AT_SIDE = 0.01, 0.06  # how softly ends what may be borrowed

_GRAIN = 1.0  # pixels of the map: what is borrowed leaves its grain behind


def sky_detail(
    logs: np.ndarray, sky: np.ndarray, hidden: np.ndarray, keep: np.ndarray
) -> np.ndarray:
    """Return the log of a sky's light over its mean round about.

    Parameters
    ----------
    logs : (h, w, 3) float32
        Natural logarithm of the photo's light.
    sky : (h, w) float32
        Sky matte.
    hidden : (h, w) float32
        Where glare changes the light, [0, 1].
    keep : (h, w) float32
        How far the photo's fine detail counts all the same, [0, 1].

    Returns
    -------
    (h', w', 3) float32
        At no more than ``DETAILED`` pixels a side; slowly continued over what is no sky.
    """
    import cv2

    size = size_within((sky.shape[1], sky.shape[0]), DETAILED)
    logs, sky, hidden, keep = (resize(values, *size) for values in (logs, sky, hidden, keep))
    side = max(size)
    reach = 2 * round(_SKYLINE * side) + 1
    skyline = np.ones((reach, reach), np.uint8)
    clear = np.asarray(sky > 0.98, np.uint8)
    clear = cv2.erode(clear, skyline, borderType=cv2.BORDER_CONSTANT, borderValue=0)
    beside = np.asarray(hidden < 0.1, np.float32)
    # They go on to the skyline, and as far over it, so that the gap has them down to the land.
    borrowed = _fading(cv2.dilate(clear, skyline, iterations=2), side)

    def clouds(reach: float, known: np.ndarray) -> np.ndarray:
        share = cv2.GaussianBlur(known, (0, 0), reach * side)[..., None]
        mean = cv2.GaussianBlur(logs * known[..., None], (0, 0), reach * side)
        return logs - mean / np.maximum(share, 1e-6)

    def without_glare(reach: float) -> np.ndarray:
        known = clear * beside
        continued = fill_by_pyramid(clouds(reach, known), known)
        found = mirrored(continued, beside, beside * borrowed)
        # The frame gives what is filled the photo's grain; it shall not have two.
        plain = cv2.GaussianBlur(found, (0, 0), _GRAIN)
        return np.where(beside[..., None] > 0, found, plain)

    inside = np.asarray(sky > 0.98, np.float32)
    own = (inside[..., None] * clouds(_FINE, inside) - without_glare(_FINE)) @ LUMINANCE
    kept = keep * hidden * own
    return np.asarray(without_glare(_COARSE) + kept[..., None], np.float32)


def _fading(part: np.ndarray, side: int) -> np.ndarray:
    """Let a part (h, w) of a picture fade towards its edge, more so towards the picture's sides."""
    import cv2

    columns = part.shape[1]
    fade, at_side = _FADE * side, _FADE_AT_SIDE * side
    from_side = np.minimum(np.arange(columns) + 1, columns - np.arange(columns))
    inwards = np.minimum(cv2.distanceTransform(part, cv2.DIST_L2, 5), fade) / fade
    return np.asarray(inwards * np.minimum(from_side / at_side, 1), np.float32)
