"""The sky behind the old sun: what fills in when the sun is moved away.

Colours are never inpainted. The logarithm of photo over matched model is a slow, nearly
colourless field wherever the sky is clear; it is taken outside the glare, filled across it
(push–pull pyramid: Gortler et al. 1996, "The Lumigraph", 3.4.2), and the compositor multiplies
the model by it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sunwidget.analysis.working import LUMINANCE, resize

RANGE = 2.0
"""The stored field spans ±2 in natural logarithm: a seventh to seven times the model."""


@dataclass(frozen=True, eq=False)
class Backdrop:
    """The residual field and where it replaces the photo.

    Parameters
    ----------
    field : (h, w, 3) float32
        (log(photo / model) + RANGE) / (2 RANGE), [0, 1], in scene-linear light.
    glare : (h, w) float32
        Weight with which the sky behind replaces the photo once the sun has moved, [0, 1].
    """

    field: np.ndarray
    glare: np.ndarray


def backdrop(
    scene_light: np.ndarray,
    display: np.ndarray,
    model: np.ndarray,
    sky: np.ndarray,
    angle_to_sun: np.ndarray | None,
) -> Backdrop:
    """Fill the log residual across clipped pixels and the old sun's halo.

    Parameters
    ----------
    scene_light : (h, w, 3) float32
        The photo through the inverse camera response.
    display : (h, w, 3) float32
        The photo in linear Rec. 709, where clipping shows.
    model : (h, w, 3) float32
        The fitted sky without disc at the photo's own sun, in the unit of ``scene_light``.
    sky : (h, w) float32
        Sky matte.
    angle_to_sun : (h, w) float32 or None
        Degrees between each pixel and the sun; ``None`` when the photo does not show it.

    Returns
    -------
    Backdrop
        At the size of the inputs.
    """
    log_residual = np.log(np.maximum(scene_light, 1e-4) / np.maximum(model, 1e-6))
    log_residual = np.clip(log_residual, -RANGE, RANGE).astype(np.float32)
    clipped = _smoothstep(0.90, 0.97, display.max(-1))
    if angle_to_sun is None:
        glare = np.zeros(sky.shape, np.float32)
    else:
        glare = _glare(log_residual @ LUMINANCE, clipped, sky, angle_to_sun)
    weight = (sky > 0.98) * (1 - clipped) * np.square(1 - glare)
    filled = fill_by_pyramid(log_residual, weight.astype(np.float32))
    # Outside the glare the field is only a fallback for extreme ratios: its slow part serves.
    encoded = (filled + RANGE) / (2 * RANGE)
    return Backdrop(_dithered(encoded), glare)


def fill_by_pyramid(values: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Push–pull: average upwards by weight, then fill downwards where weight is missing.

    Parameters
    ----------
    values : (h, w, c) float32
    weight : (h, w) float32
        Trust in each value, [0, 1].

    Returns
    -------
    (h, w, c) float32
        ``values`` where the weight is 1, a smooth continuation where it is 0.
    """
    import cv2

    height, width = weight.shape
    if height <= 2 or width <= 2:
        total = float(weight.sum())
        mean = (values * weight[..., None]).sum((0, 1)) / total if total > 0 else 0 * values[0, 0]
        return np.broadcast_to(mean, values.shape).astype(np.float32).copy()
    weighted = np.dstack([values * weight[..., None], weight])
    sums = resize(weighted, (width + 1) // 2, (height + 1) // 2)
    coarse_weight = sums[..., -1]
    coarse = sums[..., :-1] / np.maximum(coarse_weight, 1e-6)[..., None]
    coarse = fill_by_pyramid(coarse, np.clip(coarse_weight * 4, 0, 1))
    below = cv2.resize(coarse, (width, height), interpolation=cv2.INTER_LINEAR)
    below = cv2.GaussianBlur(below, (0, 0), 1.0).reshape(values.shape)
    share = weight[..., None]
    return (share * values + (1 - share) * below).astype(np.float32)


def _glare(
    residual: np.ndarray, clipped: np.ndarray, sky: np.ndarray, angle: np.ndarray
) -> np.ndarray:
    """Weight of the old sun's clipped core and of the halo that the model does not explain."""
    import cv2

    rings = np.arange(0.0, min(40.0, float(angle.max())) + 0.5, 0.5)
    which = np.clip((angle / 0.5).astype(int), 0, len(rings) - 1)
    usable = (sky > 0.9) & (clipped < 0.5)
    profile = np.full(len(rings), np.nan)
    burnt = np.zeros(len(rings))
    for index in range(len(rings)):
        inside = (which == index) & (sky > 0.9)
        if inside.sum() >= 8:
            burnt[index] = clipped[inside].mean()
            if (inside & usable).sum() >= 8:
                profile[index] = np.median(residual[inside & usable])
    known = np.isfinite(profile)
    if known.sum() >= 4:
        level = np.nanmedian(profile[len(rings) // 3 :]) if known[len(rings) // 3 :].any() else 0.0
        excess = np.interp(rings, rings[known], profile[known]) - level
    else:
        excess = np.zeros(len(rings))
    # The halo ends where the excess first falls under a twelfth of a stop; the core is burnt.
    halo = np.maximum(_smoothstep(0.06, 0.3, excess), _smoothstep(0.05, 0.5, burnt))
    halo[:2] = 1.0
    ended = np.flatnonzero(halo < 0.02)
    if ended.size:
        halo[ended[0] :] = 0.0
    radial = np.interp(angle, rings, halo).astype(np.float32)
    # Clipped pixels that touch the halo belong to it, whatever their shape.
    core = (clipped > 0.5) & (sky > 0.3)
    labels = cv2.connectedComponents(core.astype(np.uint8))[1]
    touched = np.unique(labels[core & (radial > 0.3)])
    mine = np.isin(labels, touched[touched > 0]).astype(np.float32)
    size = max(3, round(0.02 * max(sky.shape))) | 1
    mine = cv2.GaussianBlur(cv2.dilate(mine, np.ones((size, size), np.uint8)), (0, 0), size / 3)
    return np.clip(np.maximum(radial, mine), 0, 1).astype(np.float32)


def _dithered(encoded: np.ndarray) -> np.ndarray:
    """Add ±half an 8-bit level of fixed noise: the field is slow and would band when stored."""
    noise = np.random.default_rng(20170601).random(encoded.shape, np.float32) - 0.5
    return np.clip(encoded + noise / 255, 0, 1).astype(np.float32)


def _smoothstep(low: float, high: float, x: np.ndarray) -> np.ndarray:
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)
