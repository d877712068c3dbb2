"""The sky behind the photo's sun, which the frame shows when the sun has moved.

It is the photo without its sun (erase.py). Over the land, and where the camera clipped, the matched
model continues it: the logarithm of photo over model is a slow field.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from sunwidget.analysis.backdrop.aureole import find_aureole
from sunwidget.analysis.backdrop.erase import Erased
from sunwidget.analysis.backdrop.sky_detail import DETAILED
from sunwidget.analysis.fit.fit import SkyFit, view_angles
from sunwidget.analysis.images.fill import fill_by_layers
from sunwidget.analysis.images.working_copy import Working, resize, smoothstep
from sunwidget.formats.pixels import size_within
from sunwidget.geometry.camera import Camera

RANGE = 2.0
"""Logs of clear sky over model (clear_sky.py) span ±2: a seventh to seven times the model."""


@dataclass(frozen=True, eq=False)
class Backdrop:
    """The sky behind the sun, and where it replaces the photo.

    Parameters
    ----------
    field : (h, w, 3) float32
        Code of scene-linear light (``to_code``), [0, 1].
    glare : (h, w) float32
        Weight with which the field replaces the photo when the sun has moved, [0, 1]; on land
        the share of light that is removed then.
    """

    field: np.ndarray
    glare: np.ndarray


_OCTAVES, _FINE = 10.0, 64.0  # as shaders/camera/response.glsl


def to_code(light: np.ndarray) -> np.ndarray:
    """Return codes in [0, 1] of scene-linear light up to 16; 8 bits resolve 3 %.

    Air around a sun is brighter than white, and darkens from that level when the sun moves away.
    """
    return np.asarray(np.clip(np.log2(1 + _FINE * np.maximum(light, 0)) / _OCTAVES, 0, 1))


def to_light(code: np.ndarray) -> np.ndarray:
    """Return the scene-linear light of codes, the inverse of ``to_code``."""
    return np.asarray((np.exp2(_OCTAVES * np.asarray(code, np.float32)) - 1) / _FINE)


LONG_SIDE = 256
_MODEL_SIDE = 80
_TURNS = (-1.0, -0.5, 0.0, 0.5, 1.0)  # in spreads of the sun
_NARROWEST, _WIDEST = 40.0, 90.0  # degrees: clouds that hide a sun scatter its glow
_COUNTS = 0.01, 0.05  # logs of light: less of an aureole stays, more goes completely


def behind_sun(
    working: Working, erased: Erased, sky: np.ndarray, camera: Camera, fit: SkyFit
) -> Backdrop:
    """Return the photo without its sun, with the sky continued over everything else.

    Parameters
    ----------
    working : Working
        The small photo. Beside the glare its own light counts: the frame removes the bright air
        there, and light erased as well would be missing in a ring. Only its aureole goes.
    erased : Erased
        The same without its sun: where that is a guess, and its clouds.
    sky : (h, w) float32
        Sky matte at its size.
    camera : Camera
    fit : SkyFit
        Model and response, fitted at the photo's own sun.

    Returns
    -------
    Backdrop
        At most ``LONG_SIDE`` pixels long, twice that if the photo shows a sun.
    """
    size = size_within(
        (working.width, working.height), DETAILED if erased.mark.any() else LONG_SIDE
    )
    display = np.asarray(resize(working.linear, *size), np.float32)
    matte = np.asarray(resize(sky, *size), np.float32)
    mark = np.asarray(resize(erased.mark, *size), np.float32)
    # Clipped pixels carry little information. Beside an erased sun they count nevertheless, or
    # the filled gap would end at an edge.
    clipped = smoothstep(0.90, 0.97, display.max(-1)) * (not mark.any())
    model = matched_sky(fit, camera, size)
    seen = fit.response.scene_light(display)
    # Behind the glare the model continues the sky, with the bright air around the sun, which the
    # frame removes together with the old sun. The clouds there continue those beside it.
    known = 1 - np.asarray(resize(erased.hidden, *size), np.float32)
    weight = np.asarray((matte > 0.98) * (1 - clipped) * known, np.float32)
    detail = resize(erased.detail, *size)
    hides = (weight < 0.5) & (mark > 0.5)
    at = camera.resized(*size).pixel(*fit.sun)
    excess = _log_residual(seen, model) - detail
    aureole = find_aureole(excess, weight, hides, at)
    seen = seen * np.exp(-aureole)
    filled = fill_by_layers(excess - aureole, weight) + detail
    beyond = model * np.exp(filled)
    sky_light = beyond + weight[..., None] * (seen - beyond)
    # A pixel of the skyline also shows sky, and has one mark for both.
    on_land = np.asarray(resize(erased.on_land, *size), np.float32)
    in_sky = np.maximum(mark, smoothstep(*_COUNTS, aureole.max(-1)))
    glare = np.where(matte > 0.98, in_sky, np.maximum(mark * smoothstep(0.0, 0.2, matte), on_land))
    return Backdrop(_dithered(to_code(sky_light)), glare)


def matched_sky(fit: SkyFit, camera: Camera, size: tuple[int, int]) -> np.ndarray:
    """Return the fitted clear sky at ``size`` (w, h): (h, w, 3) scene-linear.

    It is marched on a coarser grid, since without the disc the sky's logarithm is smooth.
    """
    return _enlarged(_coarse_logs(fit, camera, size_within(size, _MODEL_SIDE)), size)


def expected_sky(fit: SkyFit, camera: Camera, size: tuple[int, int]) -> np.ndarray | None:
    """Return ``matched_sky`` without the glow of a sun that is only assumed in the picture.

    This is the geometric mean over where that sun may be (``fit.sun_spread``); ``None`` if no
    sun is assumed there.
    """
    x, y = camera.pixel(*fit.sun)  # NaN behind the camera
    inside = 0 <= x <= camera.width and 0 <= y <= camera.height
    if fit.sun_spread == 0 or not inside:
        return None
    turns = np.array(_TURNS) * np.clip(fit.sun_spread, _NARROWEST, _WIDEST)
    suns = [(fit.sun[0] + float(turn), fit.sun[1]) for turn in turns]
    coarse = size_within(size, _MODEL_SIDE // 2)
    logs = [_coarse_logs(dataclasses.replace(fit, sun=sun), camera, coarse) for sun in suns]
    return _enlarged(np.mean(logs, axis=0), size)


def _enlarged(logs: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    import cv2

    model = np.exp(cv2.resize(logs, size, interpolation=cv2.INTER_LINEAR))
    return np.asarray(model.reshape(size[1], size[0], 3), np.float32)


@lru_cache(maxsize=16)
def _coarse_logs(fit: SkyFit, camera: Camera, size: tuple[int, int]) -> np.ndarray:
    """March the model once per fit."""
    azimuth, elevation = view_angles(camera, *size)
    logs = np.log(fit.model(azimuth, np.maximum(elevation, 0.2))).astype(np.float32)
    logs.flags.writeable = False
    return logs


def _log_residual(scene_light: np.ndarray, model: np.ndarray) -> np.ndarray:
    ratio = np.maximum(scene_light, 1e-4) / np.maximum(model, 1e-6)
    return np.log(ratio).astype(np.float32)


def _dithered(encoded: np.ndarray) -> np.ndarray:
    """Add ±half an 8-bit level of fixed noise, since a slow sky would show bands."""
    noise = np.random.default_rng(20170601).random(encoded.shape, np.float32) - 0.5
    return np.clip(encoded + noise / 255, 0, 1).astype(np.float32)
