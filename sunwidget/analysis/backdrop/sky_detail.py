"""Separate a sky's clouds from its slow light, and fill in the clouds that the glare hides.

Where the glare only brightens the sky, the photo keeps detail finer than a halo. Its other clouds,
and all clouds where the camera clipped, are mirrored from the left and right.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.images.fill import fill_by_pyramid, mirror_texture
from sunwidget.analysis.images.working_copy import resize
from sunwidget.formats.color import LUMINANCE
from sunwidget.formats.pixels import size_within

DETAILED = 512
"""Longer side of the map, in pixels."""

# In longer sides.
_FINE = 0.02  # finer detail is cloud instead of glare, even within the glare
_COARSE = 0.04  # coarser detail is the sky's slow light
_SKYLINE = 0.006  # so near to the skyline, which has twigs, detail is not cloud
_FADE, _FADE_AT_SIDE = 0.01, 0.06  # width over which the mirrored texture fades out

_USUAL = 2.0  # standard deviations of detail beside the glare
_GRAIN = 1.0  # pixels of the map: blur that removes the grain of the mirrored texture


def sky_detail(
    logs: np.ndarray, sky: np.ndarray, hidden: np.ndarray, keep: np.ndarray
) -> np.ndarray:
    """Return the log of a sky's light over its local mean.

    Parameters
    ----------
    logs : (h, w, 3) float32
        Natural logarithm of the photo's light.
    sky : (h, w) float32
        Sky matte.
    hidden : (h, w) float32
        Where glare changes the light, [0, 1].
    keep : (h, w) float32
        Weight of the photo's fine detail there, [0, 1].

    Returns
    -------
    (h', w', 3) float32
        At most ``DETAILED`` pixels long; continued slowly outside the sky.
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
    # Extended to and beyond the skyline, so that the gap has clouds down to the land.
    borrowed = _fading(cv2.dilate(clear, skyline, iterations=2), side)

    def clouds(reach: float, known: np.ndarray) -> np.ndarray:
        share = cv2.GaussianBlur(known, (0, 0), reach * side)[..., None]
        mean = cv2.GaussianBlur(logs * known[..., None], (0, 0), reach * side)
        return logs - mean / np.maximum(share, 1e-6)

    def without_glare(reach: float) -> np.ndarray:
        known = clear * beside
        continued = fill_by_pyramid(clouds(reach, known), known)
        found = mirror_texture(continued, beside, beside * borrowed)
        # The frame adds the photo's grain to filled areas, so the texture must have none.
        plain = cv2.GaussianBlur(found, (0, 0), _GRAIN)
        return np.where(beside[..., None] > 0, found, plain)

    inside = np.asarray(sky > 0.98, np.float32)
    found = without_glare(_FINE)
    own = (inside[..., None] * clouds(_FINE, inside) - found) @ LUMINANCE
    # Rims of the disc and what a JPEG file makes of them stand out more than clouds do.
    seen = clear * beside
    most = _USUAL * float(np.sqrt((seen * (found @ LUMINANCE) ** 2).sum() / max(seen.sum(), 1.0)))
    kept = keep * hidden * np.clip(own, -most, most)
    return np.asarray(without_glare(_COARSE) + kept[..., None], np.float32)


def _fading(part: np.ndarray, side: int) -> np.ndarray:
    """Fade a part (h, w) of a picture towards its edge, more strongly at the picture's sides."""
    import cv2

    columns = part.shape[1]
    fade, at_side = _FADE * side, _FADE_AT_SIDE * side
    from_side = np.minimum(np.arange(columns) + 1, columns - np.arange(columns))
    inwards = np.minimum(cv2.distanceTransform(part, cv2.DIST_L2, 5), fade) / fade
    return np.asarray(inwards * np.minimum(from_side / at_side, 1), np.float32)
