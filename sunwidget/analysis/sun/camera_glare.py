"""The camera's glare around a sun in the frame, which is drawn with the moved sun.

Bloom and haze in the lens add light of the sun's color, which falls off as a Moffat profile
a / (1 + (angle / b)²)^c (Moffat 1969). It is added, not multiplied: the glow in a deep blue sky is
white, and a ratio that treats it as sky would leave it cyan. A profile holds for a sun of 20 klx on
the lens, in a picture exposed for it. Twin: camera_glare.glsl.
"""

from __future__ import annotations

import itertools
import math
from functools import lru_cache
from typing import Any

import numpy as np

from sunwidget.analysis.fit.fit import Response, SkyFit
from sunwidget.analysis.images.working_copy import Working, resize, smoothstep
from sunwidget.analysis.sun.sun import SunObservation, away_from
from sunwidget.atmosphere.constants import (
    SPECTRAL_TO_REC709,
    SUN_ANGULAR_RADIUS_DEG,
    WAVELENGTHS,
    solar_irradiance,
)
from sunwidget.atmosphere.optics import camera_height, transmittance_to_top
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera

Profile = tuple[float, float, float]

# Glare of unknown cameras, in units of a picture's width and of the light of its middle gray: with
# the highlights of frame/frame_output.glsl it falls off as in 193 photos that show their sun.
_CORE, _LEVEL, _POWER = 0.02, 23.0, 1.4
_LEAST, _MOST = 0.1, 3.0  # limits of a measured glare relative to that
_BURNT = (0.6, 0.9)  # display-linear light of the least channel: a colored disc, a white one
_LARGEST_DISC, _DISC_STEP = 0.08, 0.08  # widths; encoded luminance above the surroundings
_GLOWS = 0.95  # encoded: a channel of a disc whose glow may be as bright
_RIM = (1.1, 1.9)  # radii: of a sharp disc, and of the softest glow
_WIDTHS = (0.4, 0.7, 1.1, 1.6, 2.4, 3.6, 5.5)  # degrees
# Between clouds and rays the sky shows: the darker third of a ring is sky and glare only.
_CLEAREST = 0.3
_REFERENCE, _GROWTH = 20.0, 0.35  # as in camera_glare.glsl


def glare_profile(fit: SkyFit, camera: Camera) -> Profile:
    """Return the glare of a new sun: that of the photo's own sun, or the usual one.

    Parameters
    ----------
    fit : SkyFit
        With the measured glare, if any; its response gives the brightness of white.
    camera : Camera
        The usual glare scales with the picture, but is never narrower than the sun's disc.
    """
    width = math.degrees(camera.width / camera.focal)
    core = math.hypot(_CORE * width, SUN_ANGULAR_RADIUS_DEG)
    usual = (
        _LEVEL
        * float(fit.response.scene_light(np.array(0.5)))
        * (_CORE * width / core) ** (2 * _POWER)
    )
    height, own, _ = fit.glare
    if height <= 0:
        return usual, core, _POWER
    # Far out only a b^2c counts. A core sharper than the usual would jump while dragging.
    wide = max(own, core)
    share = height * (own / core) ** (2 * _POWER) / usual
    share = min(max(share, _LEAST), _MOST)
    return share * usual * (core / wide) ** (2 * _POWER), wide, _POWER


def own_disc(sun: SunObservation | None, camera: Camera, working: Working) -> dict[str, Any]:
    """Return the disc of a photo's sun, or the core that its camera clipped to white.

    A moved sun keeps this size, which comes from the camera.

    Parameters
    ----------
    sun : SunObservation or None
    camera : Camera
    working : Working
        The photo's small copy, with its sun.

    Returns
    -------
    dict
        Scene uniforms: ``own_disc``, the median of its display-linear light (Rec. 709);
        ``own_disc_radius``, the tangent of the angle from its center to its rim, 0 if the photo
        shows no sun; ``own_disc_burnt``, its degree of clipping, [0, 1]; ``own_disc_rim``, the
        distance in radii at which its light has fallen half way to the surroundings.
    """
    color, radius, rim = np.zeros(3), 0.0, _RIM[0]
    if sun is not None and sun.visible and 0 < sun.radius_px < _LARGEST_DISC * sun.size[0]:
        scale = working.width / sun.size[0]
        shape = working.height, working.width
        away = away_from(shape, scale * sun.x, scale * sun.y) / max(scale * sun.radius_px, 1.0)
        above = np.arange(working.height)[:, None] + 0.5 < scale * sun.y
        inside = (resize(sun.blot, working.width, working.height) > 0.5) & (away < 1.5)
        beside = (away > 2.5) & (away < 3.5) & above
        if inside.any() and beside.any() and _stands_out(working.encoded, inside, beside):
            color = np.median(working.linear[inside], axis=0)
            radius = sun.radius_px * camera.width / sun.size[0] / camera.focal
            rim = _rim(working.linear @ LUMINANCE, away, above)
    return {
        "own_disc": tuple(float(v) for v in color),
        "own_disc_radius": radius,
        "own_disc_burnt": float(smoothstep(*_BURNT, color.min())),
        "own_disc_rim": rim,
    }


def _stands_out(encoded: np.ndarray, inside: np.ndarray, beside: np.ndarray) -> bool:
    """Return whether a disc is brighter than the sky beside it, or has grown into the sky.

    In a glow as bright as the disc, a white one is brighter in blue alone.
    """
    disc, sky = (np.median(encoded[part], axis=0) for part in (inside, beside))
    step = disc - sky if disc.max() > _GLOWS else (disc - sky) @ LUMINANCE
    return bool(np.max(step) > _DISC_STEP)


def _rim(light: np.ndarray, away: np.ndarray, above: np.ndarray) -> float:
    """Return the distance, in radii, at which light is half way from disc to surroundings.

    ``above`` selects pixels above the sun, where there is no land.
    """
    rings = np.arange(0.8, 3.5, 0.1)
    parts = [above & (away >= r - 0.15) & (away < r + 0.15) for r in rings]
    known = [(r, float(np.median(light[p]))) for r, p in zip(rings, parts, strict=True) if p.any()]
    if len(known) < 2:
        return _RIM[0]
    radii, level = np.array(known).T
    fallen = radii[level < 0.5 * (level[0] + level[-1])]
    return float(np.clip(fallen[0] if fallen.size else _RIM[1], *_RIM))


def measured_glare(
    excess: np.ndarray, angle: np.ndarray, trusted: np.ndarray, fit: SkyFit
) -> Profile:
    """Measure the glare of the sun that a photo shows.

    Parameters
    ----------
    excess : (h, w, 3) float32
        The photo's light over that of its sky without sun and glare, scene-linear.
    angle : (h, w) float32
        Degrees from the sun.
    trusted : (h, w) bool
        Unclipped sky.
    fit : SkyFit
        Response, air and sun.

    Returns
    -------
    tuple of 3 floats
        For ``SkyFit.glare``; its height is 0 if too little sky is visible.
    """
    light = np.asarray(excess @ LUMINANCE)
    edges = np.concatenate([np.arange(0, 10, 0.5), np.arange(10, 41, 2.0)])
    found = []
    for low, high in itertools.pairwise(edges):
        ring = trusted & (angle >= low) & (angle < high)
        if ring.sum() >= 12:
            found.append(((low + high) / 2, float(np.quantile(light[ring], _CLEAREST))))
    if len(found) < 5:
        return 0.0, 3.0, _POWER
    theta, level = np.array(found).T
    level = before_roll_off(np.maximum(level, 0), fit.response)
    # Errors are relative to the level: a stop near the core counts as much as one farther out.
    weight = 1 / (0.1 * float(fit.response.scene_light(np.array(0.5))) + level)
    best = (math.inf, 0.0, 3.0)
    for width in _WIDTHS:
        shape = weight * (1 + (theta / width) ** 2) ** -_POWER
        height = max(float(shape @ (weight * level)) / float(shape @ shape), 1e-6)
        best = min(best, (float(np.square(weight * level - height * shape).sum()), height, width))
    return best[1] / strength(fit), best[2], _POWER


def before_roll_off(light: np.ndarray, response: Response) -> np.ndarray:
    """Return the light that frame/frame_output.glsl draws as bright as ``light`` in the photo."""
    knee, burns = 0.5, 1.06
    w = max(response.shoulder, 1e-4)
    over = np.clip((response.display_light(light) - knee) / (1 - knee) / burns, 0, 0.9)
    r = -np.log(1 - w * knee) / w + over / (1 - over) * (1 - knee) / (1 - w * knee)
    return np.where(over > 0, r ** (1 / response.contrast), light)


def beam(fit: SkyFit) -> np.ndarray:
    """Return the light of the photo's own sun (3,) on the lens, klx."""
    air = fit.atmosphere
    through = transmittance_to_top(air, camera_height(air), np.sin(np.radians(fit.sun[1])))
    matrix = np.asarray(SPECTRAL_TO_REC709).reshape(3, 4)
    light = matrix @ (solar_irradiance(WAVELENGTHS) * np.asarray(through).reshape(4))
    return np.asarray(np.maximum(light, 1e-9))


def strength(fit: SkyFit) -> float:
    """Return the factor of a measured profile for the photo's own sun."""
    return float((max(float(beam(fit) @ LUMINANCE), 0.1) / _REFERENCE) ** _GROWTH)


@lru_cache(maxsize=4)
def angle_to_sun(camera: Camera, size: tuple[int, int], sun: tuple[float, float]) -> np.ndarray:
    """Return each pixel's angle from the sun in degrees, ``size`` (w, h): (h, w) float32."""
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
