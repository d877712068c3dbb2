"""Measure the photo's noise, so that filled areas do not look smoother than the rest.

Source: Immerkær, "Fast Noise Variance Estimation", Computer Vision and Image Understanding 64
(1996): the difference of two Laplacians removes even, tilted and bent surfaces and leaves noise.
Its median ignores the few edges of clouds and twigs; only the sky counts, since leaves look like
noise.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.images.working_copy import code_values, resize
from sunwidget.formats.color import LUMINANCE
from sunwidget.photo.photo import Photo

_KERNEL = np.array([[1, -2, 1], [-2, 4, -2], [1, -2, 1]], np.float32)
_LARGEST = 0.05
_TILE = 1024  # side of the largest measured part in pixels


def noise_level(photo: Photo, sky: np.ndarray) -> float:
    """Return the deviation of the luminance's noise in the sky, encoded, [0, 0.05].

    It is measured at the photo's own size, in the middle of a large sky; 0 without sky.

    Parameters
    ----------
    photo : Photo
    sky : (H, W) float32
        Matte.
    """
    import cv2

    small = resize(sky, min(128, sky.shape[1]), min(128, sky.shape[0]))
    inside = np.argwhere(small > 0.98)
    if not inside.size:
        return 0.0
    middle = np.median(inside, axis=0) / small.shape
    part = tuple(
        slice(start, start + _TILE)
        for start in (
            int(np.clip(share * size - _TILE / 2, 0, max(size - _TILE, 0)))
            for share, size in zip(middle, sky.shape, strict=True)
        )
    )
    code = code_values(photo, *part) @ LUMINANCE
    seen = cv2.erode((sky[part] > 0.98).astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    seen &= (code > 0.03) & (code < 0.95)
    if np.count_nonzero(seen) < 50:
        return 0.0
    response = np.abs(cv2.filter2D(code, -1, _KERNEL, borderType=cv2.BORDER_REFLECT))[seen]
    # The kernel's norm is 6; the median of a normal deviate's size is 0.6745 of its deviation.
    return float(min(np.median(response) / 6 / 0.6745, _LARGEST))
