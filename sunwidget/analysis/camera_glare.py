"""The camera's own glare round a sun in the frame: measured once, then carried with the sun.

Bloom and haze in the lens add light of the sun's own colour to the sky, falling off as a Moffat
profile a / (1 + (angle / b)²)^c (Moffat 1969). It is added, not multiplied: the glow in a deep
blue sky is white, and a ratio that took it for sky would leave it cyan. Twin: camera_glare.glsl.
"""

from __future__ import annotations

import dataclasses
import itertools
import math
from functools import lru_cache

import numpy as np

from sunwidget.analysis.fit import SkyFit
from sunwidget.analysis.working import LUMINANCE
from sunwidget.atmosphere.constants import SPECTRAL_TO_REC709, WAVELENGTHS, solar_irradiance
from sunwidget.atmosphere.optics import camera_height, transmittance_to_top
from sunwidget.camera import Camera

# The sky shows between clouds and rays: in a ring the darker third is sky and glare alone.
_CLEAREST = 0.3
# In units of a picture's width and of the light of its middle grey: with lib/frame_output.glsl's
# highlights this falls off as the photos' suns do. Lenses scatter as the angle squared.
_CORE, _LEVEL, _POWER = 0.013, 68.0, 1.3
SUN_RADIUS = 0.2665  # degrees
_WIDTHS, _POWERS = (0.5, 1.0, 2.0, 4.0, 7.0, 11.0), (1.0, 1.5, 2.5)


def with_glare(
    fit: SkyFit,
    luminance: np.ndarray,
    clear: np.ndarray,
    angle: np.ndarray,
    trusted: np.ndarray,
) -> SkyFit:
    """Return the fit with the camera's glare round a visible sun.

    Parameters
    ----------
    fit : SkyFit
    luminance, clear : (h, w) float32
        Luminance of the photo and of the fitted sky without glare, scene-linear.
    angle : (h, w) float32
        Degrees from the sun.
    trusted : (h, w) bool
        Unclipped sky.
    """
    edges = np.concatenate([np.arange(0, 10, 0.5), np.arange(10, 41, 2.0)])
    centres, levels, skies = [], [], []
    for low, high in itertools.pairwise(edges):
        ring = trusted & (angle >= low) & (angle < high)
        if ring.sum() >= 12:
            centres.append((low + high) / 2)
            levels.append(float(np.quantile(luminance[ring] / clear[ring], _CLEAREST)))
            skies.append(float(np.median(clear[ring])))
    if len(centres) < 5:
        return fit
    theta, level, sky = np.array(centres), np.array(levels), np.array(skies)
    outer = float(np.median(level[theta >= 0.5 * theta[-1]]))
    excess = np.clip(level - outer, -0.5, 20)
    # Errors count relative to what is there: near the core a stop is a stop.
    weight = 1 / (1 + np.maximum(excess, 0))
    best = (float(np.square(weight * excess).sum()), 0.0, 3.0, 2.0)
    for width, power in itertools.product(_WIDTHS, _POWERS):
        shape = (1 + (theta / width) ** 2) ** -power / sky
        height = float((weight * shape) @ (weight * excess)) / float(
            np.square(weight * shape).sum()
        )
        height = float(np.clip(height, 0, 30 * sky.max()))
        cost = float(np.square(weight * (excess - height * shape)).sum())
        if cost < best[0]:
            best = (cost, height, width, power)
    return dataclasses.replace(fit, glare=best[1:])


def default_glare(fit: SkyFit, camera: Camera) -> tuple[float, float, float]:
    """Return the profile of a camera that is not known, as 94 photos of the sun have it.

    Parameters
    ----------
    fit : SkyFit
        Its response says how bright the picture's white is.
    camera : Camera
        Glare is as wide as the picture, and no narrower than the sun's disc.
    """
    width = math.degrees(camera.width / camera.focal)
    core = math.hypot(_CORE * width, SUN_RADIUS)
    middle = float(fit.response.scene_light(np.array(0.5)))
    return _LEVEL * middle * (_CORE * width / core) ** (2 * _POWER), core, _POWER


def through_glare(clear: np.ndarray, fit: SkyFit, camera: Camera) -> np.ndarray:
    """Add the camera's glare to the fitted sky (h, w, 3), scene-linear."""
    height, width, power = fit.glare
    if height <= 0:
        return clear
    angle = angle_to_sun(camera, (clear.shape[1], clear.shape[0]), fit.sun)
    veil = height * (1 + (angle / max(width, 0.1)) ** 2) ** -power
    return (clear + veil[..., None] * sun_color(fit)).astype(np.float32)


def share_of_glare(clear: np.ndarray, model: np.ndarray) -> np.ndarray:
    """Share of the light of ``model``, the sky ``clear`` with glare, that is glare: (h, w)."""
    return np.asarray(1 - (clear @ LUMINANCE) / np.maximum(model @ LUMINANCE, 1e-9), np.float32)


def sun_color(fit: SkyFit) -> np.ndarray:
    """Return the direct sun's colour (3,) in the photo's scene-linear unit, of luminance 1."""
    air = fit.atmosphere
    through = transmittance_to_top(air, camera_height(air), np.sin(np.radians(fit.sun[1])))
    matrix = np.asarray(SPECTRAL_TO_REC709).reshape(3, 4)
    light = matrix @ (solar_irradiance(WAVELENGTHS) * np.asarray(through).reshape(4))
    color = np.maximum(light, 1e-9) * np.array(fit.gain)
    return np.asarray(color / float(color @ LUMINANCE), np.float32)


@lru_cache(maxsize=4)
def angle_to_sun(camera: Camera, size: tuple[int, int], sun: tuple[float, float]) -> np.ndarray:
    """Return degrees from the sun of each pixel at ``size`` (w, h): (h, w) float32, read-only."""
    azimuth, elevation = np.radians(sun)
    level = np.cos(elevation)
    x, y, z = (
        level * (np.cos(azimuth) * forward + np.sin(azimuth) * right) + np.sin(elevation) * up
        for forward, right, up in zip(camera.forward, camera.right, camera.up, strict=True)
    )
    width, height = size
    u = ((np.arange(width) + 0.5) / width - 0.5) * camera.width / camera.focal
    v = (((np.arange(height) + 0.5) / height - 0.5) * camera.height / camera.focal)[:, None]
    cosine = (u * x + (v * y + z)) / np.sqrt(u * u + (v * v + 1))
    angle = np.degrees(np.arccos(np.clip(cosine, -1, 1))).astype(np.float32)
    angle.flags.writeable = False
    return angle
