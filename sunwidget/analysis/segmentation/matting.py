"""The matte: a low-resolution decision, extended to every pixel along the photo's edges.

A guided filter (He et al., "Guided image filtering", 2013), weighted by the decision's confidence
(after Liba et al., "Sky optimization", 2020, section 3.2).
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.images.enlarge import Box, enlarged_part, pixels_of
from sunwidget.analysis.images.working_copy import Working, encode, resize
from sunwidget.analysis.segmentation.refine import MINIMUM_SIDE, Decision
from sunwidget.photo.photo import Photo

RADIUS, EPSILON = 6, 1e-4  # window in working pixels; code values² below which nothing is an edge
CLEAR, OPAQUE = 0.06, 0.94  # the guided filter's output for land and for sky
_TILE = 64  # working pixels
_ROUNDING = 1e-4  # far above the rounding of float32


def matte(
    photo: Photo,
    working: Working,
    decision: Decision,
) -> np.ndarray:
    """Extend a decision to the photo's own resolution along its edges.

    Parameters
    ----------
    photo : Photo
    working : Working
        Its small copy, on which the filter's coefficients are computed.
    decision : Decision
        Low-resolution sky and its confidence.

    Returns
    -------
    (H, W) float32
        Alpha matte, 1 = sky.
    """
    width, height = photo.size
    if decision.final or min(working.width, working.height) < MINIMUM_SIDE:
        return np.asarray(np.clip(resize(decision.sky, width, height), 0, 1))
    sky = resize(decision.sky, working.width, working.height)
    confidence = resize(decision.confidence, working.width, working.height)
    slope, offset = guided_coefficients(working.guide, sky, confidence, RADIUS, EPSILON)
    return _at_full_size(photo, working.zoom, np.dstack([slope, offset]))


def guided_coefficients(
    guide: np.ndarray, target: np.ndarray, weight: np.ndarray, radius: int, epsilon: float
) -> tuple[np.ndarray, np.ndarray]:
    """Fit ``target ≈ slope · guide + offset`` in every window, weighted, and average the fits.

    Parameters
    ----------
    guide : (h, w, 3) float32
    target, weight : (h, w) float32
    radius : int
        Half side of the window in pixels.
    epsilon : float
        Ridge on the slope, in squared units of the guide.

    Returns
    -------
    slope (h, w, 3), offset (h, w) : float32
    """
    import cv2

    side = (2 * radius + 1, 2 * radius + 1)

    def mean(x: np.ndarray) -> np.ndarray:
        return cv2.blur(np.ascontiguousarray(x), side, borderType=cv2.BORDER_REFLECT)

    total = np.maximum(mean(weight), 1e-6)
    mean_guide = mean(guide * weight[..., None]) / total[..., None]
    mean_target = mean(target * weight) / total
    covariance = mean(guide * (weight * target)[..., None]) / total[..., None]
    covariance -= mean_guide * mean_target[..., None]
    products = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]
    second = np.stack([guide[..., i] * guide[..., j] for i, j in products[:4]], axis=-1)
    third = np.stack([guide[..., i] * guide[..., j] for i, j in products[4:]], axis=-1)
    moments = np.concatenate(
        [mean(second * weight[..., None]), mean(third * weight[..., None])], axis=-1
    )
    moments /= total[..., None]
    rr, rg, rb, gg, gb, bb = (
        moments[..., k] - mean_guide[..., i] * mean_guide[..., j]
        for k, (i, j) in enumerate(products)
    )
    rr, gg, bb = rr + epsilon, gg + epsilon, bb + epsilon
    # Inverse of the symmetric 3 × 3 covariance by cofactors.
    c00, c01, c02 = gg * bb - gb * gb, gb * rb - rg * bb, rg * gb - gg * rb
    c11, c12, c22 = rr * bb - rb * rb, rb * rg - rr * gb, rr * gg - rg * rg
    determinant = rr * c00 + rg * c01 + rb * c02
    r, g, b = covariance[..., 0], covariance[..., 1], covariance[..., 2]
    slope = (
        np.stack(
            [c00 * r + c01 * g + c02 * b, c01 * r + c11 * g + c12 * b, c02 * r + c12 * g + c22 * b],
            axis=-1,
        )
        / np.maximum(determinant, 1e-18)[..., None]
    )
    offset = mean_target - np.einsum("hwc,hwc->hw", slope, mean_guide)
    # Windows with a higher confidence count more in the average, too.
    average = mean(total)
    slope = mean(slope * total[..., None]) / average[..., None]
    return slope.astype(np.float32), (mean(offset * total) / average).astype(np.float32)


def _at_full_size(photo: Photo, zoom: tuple[float, float], lines: np.ndarray) -> np.ndarray:
    """Evaluate slope and offset (h, w, 4) at every pixel of the photo: (H, W) float32.

    Most tiles contain only sky or only land: their matte is 1 or 0 for any pixel values, so that
    their pixels need not be read.
    """
    slope, offset = lines[..., :3], lines[..., 3]
    lowest = offset + np.minimum(slope, 0).sum(axis=-1)
    highest = offset + np.maximum(slope, 0).sum(axis=-1)
    width, height = photo.size
    alpha = np.empty((height, width), np.float32)
    for top in range(0, lines.shape[0], _TILE):
        for left in range(0, lines.shape[1], _TILE):
            bottom, right = min(top + _TILE, lines.shape[0]), min(left + _TILE, lines.shape[1])
            part = pixels_of(top, bottom, zoom[1]), pixels_of(left, right, zoom[0])
            # Interpolation reads one more pixel on each side.
            corner = max(top - 1, 0), max(left - 1, 0)
            near = slice(corner[0], bottom + 1), slice(corner[1], right + 1)
            if lowest[near].min() > OPAQUE + _ROUNDING:
                alpha[part] = 1
            elif highest[near].max() < CLEAR - _ROUNDING:
                alpha[part] = 0
            else:
                here = enlarged_part(np.ascontiguousarray(lines[near]), zoom, part, corner)
                alpha[part] = stretched(on_lines(here, photo, part))
    return alpha


def on_lines(lines: np.ndarray, photo: Photo, part: Box) -> np.ndarray:
    """Return slope · code values + offset for ``lines`` (h, w, 4) in a part of the photo."""
    import cv2

    code = photo.encoded[part]
    scale = 1.0
    if code.dtype.kind == "f":
        code = encode(code)
    else:
        scale = 1 / np.iinfo(code.dtype).max
    # With an alpha of 1 beside R, G and B, a single product includes the offset.
    opaque = cv2.cvtColor(np.ascontiguousarray(code), cv2.COLOR_RGB2RGBA)
    product = cv2.multiply(lines, opaque, scale=scale, dtype=cv2.CV_32F)
    return cv2.transform(product, np.ones((1, 4), np.float32))


def stretched(alpha: np.ndarray) -> np.ndarray:
    """Stretch the ends: a guided filter leaves even sure pixels a few percent off 0 and 1."""
    return np.asarray(np.clip((alpha - CLEAR) / (OPAQUE - CLEAR), 0, 1), np.float32)
