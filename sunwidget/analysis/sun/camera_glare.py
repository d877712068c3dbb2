"""The camera's own glare round a sun in the frame: what is drawn with the sun wherever it is moved.

Bloom and haze in the lens add light of the sun's colour, falling off as a Moffat profile
a / (1 + (angle / b)²)^c (Moffat 1969). It is added, not multiplied: the glow in a deep blue sky is
white, and a ratio that took it for sky would leave it cyan. A profile is that of a sun of 20 klx on
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

# Of cameras that are not known, in units of a picture's width and of the light of its middle grey:
# with frame/frame_output.glsl's highlights it falls off as in 94 photos that show their sun.
_CORE, _LEVEL, _POWER = 0.02, 23.0, 1.3
_LEAST, _MOST = 0.1, 3.0  # of that, whatever was measured
_BURNT = (0.6, 0.9)  # display-linear light of the least channel: a coloured disc, a white one
_LARGEST_DISC, _DISC_STEP = 0.08, 0.08  # widths; encoded luminance over what lies beside it
_RIM = (1.1, 1.9)  # radii: of a sharp disc, and of the softest glow
_WIDTHS = (0.4, 0.7, 1.1, 1.6, 2.4, 3.6, 5.5)  # degrees
# The sky shows between clouds and rays: in a ring the darker third is sky and glare alone.
_CLEAREST = 0.3
_REFERENCE, _GROWTH = 20.0, 0.35  # as in camera_glare.glsl


def glare_profile(fit: SkyFit, camera: Camera) -> Profile:
    """Return the glare of a new sun: as the photo's own has it, else as other photos' suns have it.

    Parameters
    ----------
    fit : SkyFit
        With what was measured, if anything was; its response says how bright white is.
    camera : Camera
        Glare is as wide as the picture, and no narrower than the sun's disc.
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
    # Far out only a b^2c counts. A core that is sharper than the usual would jump along a drag.
    wide = max(own, core)
    share = height * (own / core) ** (2 * _POWER) / usual
    share = min(max(share, _LEAST), _MOST)
    return share * usual * (core / wide) ** (2 * _POWER), wide, _POWER


def own_disc(sun: SunObservation | None, camera: Camera, working: Working) -> dict[str, Any]:
    """Return what a photo shows of its sun: its disc, or the core that its camera burnt to white.

    Where the sun is moved it stays as large, since that is the camera's doing.

    Parameters
    ----------
    sun : SunObservation or None
    camera : Camera
    working : Working
        The photo's small copy, sun and all.

    Returns
    -------
    dict
        Scene uniforms: ``own_disc``, the median of its display-linear light (Rec. 709);
        ``own_disc_radius``, the tangent of the angle from its centre to its rim, 0 where the photo
        shows no sun; ``own_disc_burnt``, how far it is white, [0, 1]; ``own_disc_rim``, where its
        light has fallen half way to that beside it, in radii.
    """
    color, radius, rim = np.zeros(3), 0.0, _RIM[0]
    if sun is not None and sun.visible and 0 < sun.radius_px < _LARGEST_DISC * sun.size[0]:
        scale = working.width / sun.size[0]
        shape = working.height, working.width
        away = away_from(shape, scale * sun.x, scale * sun.y) / max(scale * sun.radius_px, 1.0)
        above = np.arange(working.height)[:, None] + 0.5 < scale * sun.y
        inside = (resize(sun.blot, working.width, working.height) > 0.5) & (away < 1.5)
        beside = (away > 2.5) & (away < 3.5) & above
        light = working.encoded @ LUMINANCE
        # What is no brighter than the sky beside it is a blot that grew into it.
        seen = inside.any() and beside.any()
        if seen and np.median(light[inside]) > np.median(light[beside]) + _DISC_STEP:
            color = np.median(working.linear[inside], axis=0)
            radius = sun.radius_px * camera.width / sun.size[0] / camera.focal
            rim = _rim(working.linear @ LUMINANCE, away, above)
    return {
        "own_disc": tuple(float(v) for v in color),
        "own_disc_radius": radius,
        "own_disc_burnt": float(smoothstep(*_BURNT, color.min())),
        "own_disc_rim": rim,
    }


def _rim(light: np.ndarray, away: np.ndarray, above: np.ndarray) -> float:
    """Return where, in radii, light is half way from the disc's to that of what lies beside it.

    ``above`` holds where no land is: above the sun.
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
        Its response, air and sun.

    Returns
    -------
    tuple of 3 floats
        For ``SkyFit.glare``; its height is 0 where too little is seen.
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
    # Errors count relative to what is there: near the core a stop is a stop.
    weight = 1 / (0.1 * float(fit.response.scene_light(np.array(0.5))) + level)
    best = (math.inf, 0.0, 3.0)
    for width in _WIDTHS:
        shape = weight * (1 + (theta / width) ** 2) ** -_POWER
        height = max(float(shape @ (weight * level)) / float(shape @ shape), 1e-6)
        best = min(best, (float(np.square(weight * level - height * shape).sum()), height, width))
    return best[1] / strength(fit), best[2], _POWER


def before_roll_off(light: np.ndarray, response: Response) -> np.ndarray:
    """Return the light that frame/frame_output.glsl draws as bright as the photo has ``light``."""
    knee, burns = 0.5, 1.06
    w = max(response.shoulder, 1e-4)
    over = np.clip((response.display_light(light) - knee) / (1 - knee) / burns, 0, 0.9)
    r = -np.log(1 - w * knee) / w + over / (1 - over) * (1 - knee) / (1 - w * knee)
    return np.where(over > 0, r ** (1 / response.contrast), light)


def beam(fit: SkyFit) -> np.ndarray:
    """Light of the photo's own sun (3,) on the lens, klx."""
    air = fit.atmosphere
    through = transmittance_to_top(air, camera_height(air), np.sin(np.radians(fit.sun[1])))
    matrix = np.asarray(SPECTRAL_TO_REC709).reshape(3, 4)
    light = matrix @ (solar_irradiance(WAVELENGTHS) * np.asarray(through).reshape(4))
    return np.asarray(np.maximum(light, 1e-9))


def strength(fit: SkyFit) -> float:
    """Return what a measured profile is multiplied with for the photo's own sun."""
    return float((max(float(beam(fit) @ LUMINANCE), 0.1) / _REFERENCE) ** _GROWTH)


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
