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

from sunwidget.analysis.camera_glare import (
    angle_to_sun,
    share_of_glare,
    through_glare,
    with_glare,
)
from sunwidget.analysis.fit import SkyFit, view_angles
from sunwidget.analysis.old_sun import largest_halo, old_sun_mark, starburst
from sunwidget.analysis.unmix import cloud_white, unmix
from sunwidget.analysis.working import LUMINANCE, Working, resize, smoothstep
from sunwidget.camera import Camera
from sunwidget.layout import size_within

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
    size = size_within((working.width, working.height), LONG_SIDE)
    display = np.asarray(resize(working.linear, *size), np.float32)
    matte = np.asarray(resize(sky, *size), np.float32)
    scene_light = fit.response.scene_light(display)
    clipped = smoothstep(0.90, 0.97, display.max(-1))
    clear = _clear_sky(fit, camera, size)
    angle = angle_to_sun(camera, size, fit.sun)
    if visible and measure:
        # Against the sky without glare, also when ``fit`` has been here before and has some.
        trusted = (matte > 0.95) & (clipped < 0.3)
        fit = with_glare(fit, scene_light @ LUMINANCE, clear @ LUMINANCE, angle, trusted)
    model = through_glare(clear, fit, camera)
    log_residual = _log_residual(scene_light, model)
    weight = (matte > 0.98) * (1 - clipped)
    if not visible:
        filled = fill_by_pyramid(log_residual, weight.astype(np.float32))
        return fit, Backdrop(_dithered((filled + RANGE) / (2 * RANGE)), 0 * matte)

    # Where white light hides the sky says little about it, be it cloud or the rim of the glare.
    whiteness = unmix(scene_light, model, cloud_white(fit), np.ones_like(matte))[0]
    # By day a burnt channel is glare; round a setting sun the sky's red burns by itself.
    white = smoothstep(0.85, 0.95, display @ LUMINANCE)
    white += smoothstep(4.0, 10.0, np.array(fit.sun[1], np.float32)) * (clipped - white)
    residual = log_residual @ LUMINANCE
    rays = starburst(
        residual, (matte > 0.9) & (clipped < 0.9), _place_of_sun(camera, size, fit.sun)
    )
    reach = largest_halo(white, matte, angle)
    rays *= 1 - smoothstep(1.5 * reach, 2.2 * reach, angle)
    glare = old_sun_mark(residual, white, matte, angle)
    for _ in range(2):
        # First against the level far away, then against the sky that the fill expects there,
        # in the channel that white light changes most.
        mark = np.maximum(glare, rays)
        trust = (weight * np.square(1 - mark)).astype(np.float32)
        behind = fill_by_pyramid(log_residual, trust * clearness(whiteness, trust, mark, angle))
        glare = old_sun_mark((log_residual - behind).max(-1), white, matte, angle)
    mark = np.maximum(glare, rays)
    # Away from the glare the field follows the clouds, too.
    plain = fill_by_pyramid(log_residual, (weight * np.square(1 - mark)).astype(np.float32))
    filled = plain + np.sqrt(mark)[..., None] * (behind - plain)
    return fit, Backdrop(_dithered((filled + RANGE) / (2 * RANGE)), mark.astype(np.float32))


def matched_sky(fit: SkyFit, camera: Camera, size: tuple[int, int]) -> np.ndarray:
    """Return the fitted sky with the camera's glare at ``size`` (w, h): (h, w, 3) scene-linear."""
    return through_glare(_clear_sky(fit, camera, size), fit, camera)


def _clear_sky(fit: SkyFit, camera: Camera, size: tuple[int, int]) -> np.ndarray:
    """March the fitted sky on a coarser grid: without its disc the sky's logarithm is smooth."""
    import cv2

    coarse = size_within(size, _MODEL_SIDE)
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


def _log_residual(scene_light: np.ndarray, model: np.ndarray) -> np.ndarray:
    ratio = np.maximum(scene_light, 1e-4) / np.maximum(model, 1e-6)
    return np.clip(np.log(ratio), -RANGE, RANGE).astype(np.float32)


def clouds_behind_sun(
    opacity: np.ndarray, weight: np.ndarray, mark: np.ndarray, camera: Camera, fit: SkyFit
) -> np.ndarray:
    """Continue the clouds across the old sun, as the sky behind it is: (h, w) float32.

    Parameters
    ----------
    opacity, weight : (h, w) float32
        Of the clouds, and the trust in it.
    mark : (h, w) float32
        Where the old sun hides the sky.
    camera : Camera
    fit : SkyFit
        With its glare: where that is much of the light, whiteness tells little of clouds.
    """
    size = opacity.shape[1], opacity.shape[0]
    clear = _clear_sky(fit, camera, size)
    share = share_of_glare(clear, through_glare(clear, fit, camera))
    blind = np.maximum(mark, smoothstep(0.1, 0.4, share))
    trust = (weight * (1 - blind)).astype(np.float32)
    trust *= clearness(opacity, trust, mark, angle_to_sun(camera, size, fit.sun))
    behind = fill_by_pyramid(opacity[..., None], trust)[..., 0]
    mixed = opacity + np.sqrt(blind) * (behind - opacity)
    return np.clip(mixed, 0, 1).astype(np.float32)  # rounding leaves it by a hair


def clearness(
    opacity: np.ndarray, trust: np.ndarray, mark: np.ndarray, angle: np.ndarray
) -> np.ndarray:
    """How much each pixel says about the sky behind the sun, (h, w) float32 in (0, 1].

    Relative to the clearest quarter of what is seen just round the mark: a sun in a veil of cirrus
    leaves cirrus, one between clouds leaves blue.

    Parameters
    ----------
    opacity : (h, w) float32
        Of the white light before the sky.
    trust : (h, w) float32
        Unclipped sky away from the glare.
    mark : (h, w) float32
        Where the old sun hides the sky.
    angle : (h, w) float32
        Degrees from the sun.
    """
    inside = mark > 0.5
    reach = 2 * float(np.quantile(angle[inside], 0.9)) + 2 if inside.any() else 0.0
    near = (trust > 0.5) & (angle < reach)
    usual = float(np.quantile(opacity[near], 0.25)) if near.sum() >= 12 else 0.0
    return np.asarray(1e-3 + 1 - smoothstep(0.05, 0.3, opacity - usual), np.float32)


def _place_of_sun(
    camera: Camera, size: tuple[int, int], sun: tuple[float, float]
) -> tuple[float, float]:
    """Return the sun's pixel in a picture shrunk to ``size`` (w, h)."""
    x, y = camera.pixel(*sun)
    return x * size[0] / camera.width, y * size[1] / camera.height


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


def _dithered(encoded: np.ndarray) -> np.ndarray:
    """Add ±half an 8-bit level of fixed noise: the field is slow and would band when stored."""
    noise = np.random.default_rng(20170601).random(encoded.shape, np.float32) - 0.5
    return np.clip(encoded + noise / 255, 0, 1).astype(np.float32)
