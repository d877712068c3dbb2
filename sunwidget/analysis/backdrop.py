"""The sky behind the old sun: what fills in when the sun is moved away.

Colours are never inpainted. The logarithm of photo over matched model is a slow, nearly
colourless field wherever the sky is clear; it is taken outside the glare, filled across it
(push–pull pyramid: Gortler et al. 1996, "The Lumigraph", 3.4.2), and the compositor multiplies
the model by it.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from sunwidget.analysis.fit import SkyFit, view_angles, with_glare
from sunwidget.analysis.working import LUMINANCE, Working, resize
from sunwidget.camera import Camera

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


LONG_SIDE = 256
_MODEL_SIDE = 80
_LARGEST_GLARE = 15.0  # degrees; a halo wider than this is sky or cloud


def behind_sun(
    working: Working,
    sky: np.ndarray,
    camera: Camera,
    fit: SkyFit,
    *,
    visible: bool,
    measure: bool = True,
) -> tuple[SkyFit, Backdrop]:
    """Measure the camera's glare and fill the log residual across the old sun.

    Parameters
    ----------
    working : Working
        The small photo.
    sky : (h, w) float32
        Sky matte at its size.
    camera : Camera
    fit : SkyFit
        Model and response, fitted at the photo's own sun.
    visible : bool
        Whether the photo shows the sun: otherwise there is no glare to take away.
    measure : bool
        False keeps the glare profile that ``fit`` has.

    Returns
    -------
    SkyFit, Backdrop
        The fit with its glare profile; the field at no more than ``LONG_SIDE`` pixels.
    """
    scale = min(1.0, LONG_SIDE / max(working.width, working.height))
    size = (max(1, round(working.width * scale)), max(1, round(working.height * scale)))
    display = np.asarray(resize(working.linear, *size), np.float32)
    matte = np.asarray(resize(sky, *size), np.float32)
    angle = _angle_to_sun(camera, size, fit.sun)
    scene_light = fit.response.scene_light(display)
    clipped = _smoothstep(0.90, 0.97, display.max(-1))
    clear = _clear_sky(fit, camera, size)
    if visible and measure:
        # Against the sky without glare, also when ``fit`` has been here before and has some.
        residual = _log_residual(scene_light, clear) @ LUMINANCE
        fit = with_glare(fit, residual, angle, (matte > 0.95) & (clipped < 0.3))
    model = _through_glare(clear, fit, camera)
    log_residual = _log_residual(scene_light, model)
    glare = _glare(log_residual @ LUMINANCE, clipped, matte, angle) if visible else 0 * matte
    weight = (matte > 0.98) * (1 - clipped) * np.square(1 - glare)
    filled = fill_by_pyramid(log_residual, weight.astype(np.float32))
    # What borders on the glare is bleached by it; the sky behind has the tint of the rest.
    trusted = weight > 0.5
    if visible and trusted.any():
        tint = np.median(log_residual[trusted], axis=0)
        level = (filled @ LUMINANCE)[..., None]
        plain = level + tint - float(tint @ LUMINANCE)
        filled = filled + np.sqrt(glare)[..., None] * (plain - filled)
    encoded = (filled + RANGE) / (2 * RANGE)
    return fit, Backdrop(_dithered(encoded), glare.astype(np.float32))


def matched_sky(fit: SkyFit, camera: Camera, size: tuple[int, int]) -> np.ndarray:
    """Return the fitted sky with the camera's glare at ``size`` (w, h): (h, w, 3) scene-linear."""
    return _through_glare(_clear_sky(fit, camera, size), fit, camera)


def _clear_sky(fit: SkyFit, camera: Camera, size: tuple[int, int]) -> np.ndarray:
    """March the fitted sky on a coarser grid: without its disc the sky's logarithm is smooth."""
    import cv2

    scale = min(1.0, _MODEL_SIDE / max(size))
    coarse = max(1, round(size[0] * scale)), max(1, round(size[1] * scale))
    logs = _coarse_logs(dataclasses.replace(fit, glare=(0.0, 3.0, 2.0)), camera, coarse)
    model = np.exp(cv2.resize(logs, size, interpolation=cv2.INTER_LINEAR))
    return model.reshape(size[1], size[0], 3).astype(np.float32)


@lru_cache(maxsize=8)
def _coarse_logs(fit: SkyFit, camera: Camera, size: tuple[int, int]) -> np.ndarray:
    """March once for all that look at the same fit: its glare and the matte do not matter."""
    azimuth, elevation = view_angles(camera, *size)
    logs = np.log(fit.model(azimuth, np.maximum(elevation, 0.2))).astype(np.float32)
    logs.flags.writeable = False
    return logs


def _through_glare(clear: np.ndarray, fit: SkyFit, camera: Camera) -> np.ndarray:
    height, width, power = fit.glare
    if height <= 0:
        return clear
    angle = _angle_to_sun(camera, (clear.shape[1], clear.shape[0]), fit.sun)
    veil = 1 + height * (1 + (angle / width) ** 2) ** -power
    return (clear * veil[..., None]).astype(np.float32)


def _log_residual(scene_light: np.ndarray, model: np.ndarray) -> np.ndarray:
    ratio = np.maximum(scene_light, 1e-4) / np.maximum(model, 1e-6)
    return np.clip(np.log(ratio), -RANGE, RANGE).astype(np.float32)


def _angle_to_sun(camera: Camera, size: tuple[int, int], sun: tuple[float, float]) -> np.ndarray:
    azimuth, elevation = view_angles(camera, *size)
    az, el = np.radians(azimuth - sun[0]), np.radians(elevation)
    sun_el = np.radians(sun[1])
    cosine = np.sin(el) * np.sin(sun_el) + np.cos(el) * np.cos(sun_el) * np.cos(az)
    return np.asarray(np.degrees(np.arccos(np.clip(cosine, -1, 1))), np.float32)


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

    rings = np.arange(0.0, min(_LARGEST_GLARE, float(angle.max())) + 0.5, 0.5)
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
    # Bloom reaches well past the burnt core, and a fill that starts inside it would keep a ghost.
    core = max(0.5 * np.count_nonzero(burnt > 0.3), 0.4)
    halo = np.maximum(halo, 1 - _smoothstep(1.5 * core, 4.0 * core + 0.5, rings))
    halo *= 1 - _smoothstep(0.6 * _LARGEST_GLARE, _LARGEST_GLARE, rings)
    radial = np.interp(angle, rings, halo).astype(np.float32)
    # Clipped pixels that touch the halo belong to it, whatever their shape.
    burnt_out = (clipped > 0.5) & (sky > 0.3)
    labels = cv2.connectedComponents(burnt_out.astype(np.uint8))[1]
    touched = np.unique(labels[burnt_out & (radial > 0.3)])
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
