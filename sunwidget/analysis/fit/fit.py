"""Fit the sky model to the photo: aerosol, exposure, white balance, camera response, glare.

The fit is made once, at the photo's own sun, on clear-sky pixels, and then frozen. It compares
encoded values, in which a photo's noise is even, and is robust: pixels that the model cannot
explain (thin cloud, haze banks) count as errors of at most a tenth of the scale.
"""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeVar

import numpy as np

from sunwidget.analysis.fit.confidence import (
    HEIGHTS,
    SUN_ODDS,
    SUN_ODDS_BESIDE,
    TURNS,
    Evidence,
    Seen,
    confidence_of_fit,
    confidence_of_sun,
    doubt,
    likeliest_sun,
    spread_of_angles,
)
from sunwidget.analysis.images.working_copy import Working, encode, saturation
from sunwidget.atmosphere.constants import SPECTRAL_TO_REC709
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.sky import SkyTable
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera

T = TypeVar("T")
Done = Callable[[float], object]

# Search grid. Finer steps make no visible difference: gain and contrast absorb the rest.
_OPTICAL_DEPTHS = (0.01, 0.03, 0.06, 0.12, 0.25, 0.5)
_ASYMMETRIES = (0.6, 0.76, 0.88)
_SHOULDERS = (0.5, 0.8, 0.95, 0.99)
_CONTRASTS = (0.7, 0.85, 1.0, 1.15)
_SAMPLES = 250
_ANGSTROM, _ALBEDO = 1.3, 0.9
_LARGEST_ERROR = 0.1
ANYWHERE = np.ones((HEIGHTS.size, TURNS.size))
"""Uniform prior ``expected`` of an unseen sun."""
_GREY = 0.05  # median HSI saturation below which a sky is overcast (overcast.py)
_NIGHT = 0.02  # median display light below which a sky's colors are noise and lamps
_HIDES = 10.0  # degrees: clouds may hide a lower sun
DEFAULT_SHOULDER = 0.9


@dataclass(frozen=True)
class Response:
    """The camera's response x = (1 - exp(-w r)) / w, r = light ** contrast (response.glsl).

    Parameters
    ----------
    shoulder : float
        w, 0 (straight line) to 0.995.
    contrast : float
        Exponent between scene light and r.
    """

    shoulder: float = DEFAULT_SHOULDER
    contrast: float = 1.0

    def scene_light(self, display: np.ndarray) -> np.ndarray:
        """Convert display-linear [0, 1] to scene-linear light."""
        w = max(self.shoulder, 1e-4)
        r = -np.log(np.maximum(1 - w * np.maximum(display, 0), 0.003)) / w
        return np.asarray(np.power(np.maximum(r, 1e-6), 1 / self.contrast), np.float32)

    def display_light(self, scene: np.ndarray) -> np.ndarray:
        """Convert scene-linear light to display-linear."""
        w = max(self.shoulder, 1e-4)
        r = np.power(np.maximum(scene, 1e-9), self.contrast)
        return np.asarray((1 - np.exp(-w * r)) / w, np.float32)


@dataclass(frozen=True)
class SkyFit:
    """Result of the fit.

    Parameters
    ----------
    atmosphere : Atmosphere
        Its residual is the mean absolute error of the encoded sky, [0, 1].
    response : Response
    gain : tuple of 3 floats
        Scene-linear light per kcd m⁻² of the model, for R, G, B.
    glare : tuple of 3 floats
        Moffat profile (a in scene-linear luminance, b in degrees, c) of the camera's glare
        around the sun (camera_glare.py).
    sun : (azimuth, elevation)
        Degrees; the given sun, or the one that explains the sky best.
    sun_confidence : float
        Probability that this sun is near the true one, [0, 1]; 1 if it was given.
    sun_spread : float
        Angle in degrees from this sun that contains the true one with 80 % probability; 0 if it
        was given, 180 if the sky gives no evidence.
    """

    atmosphere: Atmosphere
    response: Response
    gain: tuple[float, float, float]
    glare: tuple[float, float, float]
    sun: tuple[float, float]
    sun_confidence: float = 1.0
    sun_spread: float = 0.0

    def model(self, azimuth: np.ndarray, elevation: np.ndarray) -> np.ndarray:
        """Return the matched clear sky (..., 3) in scene-linear light, without glare."""
        return model_sky(self.atmosphere, azimuth, elevation, self.sun) * np.array(self.gain)


def model_sky(
    atmosphere: Atmosphere,
    azimuth: np.ndarray,
    elevation: np.ndarray,
    sun: tuple[float, float],
) -> np.ndarray:
    """Return the model's sky (..., 3) in linear Rec. 709, kcd m⁻²; angles in degrees."""
    # Cached, since each fit uses the same airs repeatedly.
    table = _table(atmosphere.replace(residual=None, confidence=None))
    spectral = table.radiance(elevation, azimuth - sun[0], sun[1])
    color = spectral @ np.asarray(SPECTRAL_TO_REC709).reshape(3, 4).T
    # As matched_sky.glsl: saturated spectra keep a share of the luminance in each channel.
    luminance = np.maximum(color @ LUMINANCE, 1e-12)[..., None]
    return np.asarray(np.maximum(color, 0.02 * luminance))


_table = lru_cache(maxsize=64)(SkyTable)


def prepare() -> None:
    """Compute what fits of all photos share, 0.3 s; the first fit does it otherwise."""
    model_sky(airs_to_try()[0], np.zeros(1), np.full(1, 10.0), (0.0, 10.0))


def fit_sky(
    working: Working,
    sky: np.ndarray,
    clouds: np.ndarray,
    camera: Camera,
    sun: tuple[float, float] | None,
    expected: np.ndarray | None = None,
    done: Done = lambda _share: None,
    sure_of_sun: float = 1.0,
    spread: float = 0.0,
) -> SkyFit:
    """Fit model and camera to the clear sky of a photo.

    Parameters
    ----------
    working : Working
        The small photo.
    sky, clouds : (h, w) float32
        Sky matte and cloud opacity at the size of ``working``.
    camera : Camera
        The photo's camera, at any size; only its angles are used.
    sun : (azimuth, elevation) or None
        The photo's own sun in degrees, or ``None`` to find it from the sky's colors.
    expected : (6, 12) float, optional
        Prior probability of each of ``confidence.HEIGHTS`` and ``TURNS`` for a sun to be found;
        uniform by default.
    done : callable, optional
        Called with the share of the work done, 0 to 1. Exceptions that it raises cancel the fit.
    sure_of_sun : float
        Probability that a detected ``sun`` is near the true one, [0, 1].
    spread : float
        The ``sun_spread`` of a detected ``sun``.

    Returns
    -------
    SkyFit
        Defaults without a residual if the photo has too little sky.
    """
    azimuth, elevation = view_angles(camera, working.width, working.height)
    light = working.linear
    odds = SUN_ODDS if expected is None else SUN_ODDS_BESIDE
    expected = ANYWHERE if expected is None else expected
    usable = (sky > 0.98) & (light.max(-1) < 0.95) & (elevation > 0.3)
    clear = usable & (clouds < 0.2)
    chosen = clear if clear.sum() >= 200 else usable
    if chosen.sum() < 60:
        return fit_without_sky(light, sky, sun, expected)
    index = np.flatnonzero(chosen)
    # A regular stride instead of random samples: the same photo always gives the same fit.
    index = index[:: max(1, index.size // _SAMPLES)]
    where = (azimuth.ravel()[index], elevation.ravel()[index])
    display = light.reshape(-1, 3)[index].astype(np.float64)
    searched = 0.0
    if sun is None:
        searched = 0.5
        sun, sure_of_sun, spread = search_sun(
            display,
            where,
            expected,
            lambda *direction: would_be_seen(camera, sky, *direction),
            lambda share: done(searched * share),
            odds,
        )
        dark = np.median(display @ LUMINANCE) < _NIGHT
        if dark or np.median(saturation(encode(display))) < _GREY:
            spread = 180.0  # the colors of night and overcast skies fit by chance only

    # First fit the air with a medium response, then the response with the likeliest airs.
    candidates = airs_to_try()
    models = _side_by_side(
        lambda air: model_sky(air, *where, sun),
        candidates,
        lambda share: done(searched + (1 - searched) * share),
    )
    airs = [
        (compare(display, model, Response())[0], air, model)
        for air, model in zip(candidates, models, strict=True)
    ]
    airs.sort(key=lambda air: air[0])
    evidence = Evidence(
        residual=airs[0][0],
        share=float(clear.mean()),
        spread=spread_of_angles(*where, sun),
        doubt=doubt(
            np.array([air[0] for air in airs]),
            np.log2([air[1].aerosol_optical_depth for air in airs]),
        ),
        sun_confidence=sure_of_sun,
    )
    trials = []
    for _, atmosphere, model in airs[:4]:
        for shoulder, contrast in itertools.product(_SHOULDERS, _CONTRASTS):
            response = Response(shoulder, contrast)
            error, gain = compare(display, model, response)
            # Prefer a plain response: a bent one needs a clearly smaller error.
            error += 0.015 * abs(contrast - 1) + 0.004 * abs(shoulder - DEFAULT_SHOULDER)
            trials.append((error, atmosphere, response, gain))
    error, atmosphere, response, gain = min(trials, key=lambda trial: trial[0])
    confidence = confidence_of_fit(dataclasses.replace(evidence, residual=float(error)))
    return SkyFit(
        atmosphere.replace(residual=float(error), confidence=confidence),
        response,
        (float(gain[0]), float(gain[1]), float(gain[2])),
        (0.0, 3.0, 2.0),
        sun,
        sure_of_sun,
        spread,
    )


def airs_to_try() -> list[Atmosphere]:
    """Return the candidate airs of a fit."""
    return [
        Atmosphere(
            aerosol_optical_depth=depth,
            aerosol_asymmetry=asymmetry,
            angstrom_exponent=_ANGSTROM,
            aerosol_albedo=_ALBEDO,
        )
        for depth, asymmetry in itertools.product(_OPTICAL_DEPTHS, _ASYMMETRIES)
    ]


def _side_by_side(task: Callable[[T], np.ndarray], items: list[T], done: Done) -> list[np.ndarray]:
    """Map over two threads, since the user waits; NumPy releases the interpreter lock."""
    results = []
    pool = ThreadPoolExecutor(2)
    try:
        for result in pool.map(task, items):
            results.append(result)
            done(len(results) / len(items))
    finally:
        pool.shutdown(cancel_futures=True)
    return results


def view_angles(camera: Camera, width: int, height: int) -> tuple[np.ndarray, np.ndarray]:
    """Return azimuth and elevation (height, width) in degrees of a shrunk picture's pixels."""
    rows, columns = np.mgrid[:height, :width] + 0.5
    azimuth, elevation = camera.angles(
        columns * camera.width / width, rows * camera.height / height
    )
    return np.asarray(azimuth), np.asarray(elevation)


def would_be_seen(
    camera: Camera, sky: np.ndarray, azimuth: np.ndarray, elevation: np.ndarray
) -> np.ndarray:
    """Return whether a sun in each of these directions, (n,) degrees, would be in plain view.

    A bank of cloud may hide a low one. ``sky`` is the matte (h, w).
    """
    height, width = sky.shape
    x, y = camera.pixel(azimuth, elevation)
    column, row = x * width / camera.width, y * height / camera.height
    inside = (elevation > _HIDES) & (column >= 0) & (column < width) & (row >= 0) & (row < height)
    at = (np.where(inside, row, 0).astype(int), np.where(inside, column, 0).astype(int))
    return np.asarray(inside & (sky[at] > 0.5))


def compare(display: np.ndarray, model: np.ndarray, response: Response) -> tuple[float, np.ndarray]:
    """Return the mean truncated error of encoded values, and the best gain per channel."""
    logs = np.log(response.scene_light(display)) - np.log(model)
    gain = np.exp(np.median(logs, 0))
    predicted = np.clip(response.display_light(model * gain), 0, 1)
    error = np.abs(predicted ** (1 / 2.2) - display ** (1 / 2.2))
    # White balance explains a tint, but not a sunset: a red sky needs a low sun, not a red gain.
    tint = max(0.0, abs(float(np.log(gain[0] / gain[2]))) - 0.4)
    return float(np.minimum(error, _LARGEST_ERROR).mean()) + 0.02 * tint, gain


def search_sun(
    display: np.ndarray,
    where: tuple[np.ndarray, np.ndarray],
    expected: np.ndarray,
    seen: Seen,
    done: Done,
    odds: float = SUN_ODDS,
) -> tuple[tuple[float, float], float, float]:
    """Return the direction of an unseen sun, its confidence, and its spread."""
    step = max(1, display.shape[0] // 120)
    display, where = display[::step], (where[0][::step], where[1][::step])
    response = Response()
    airs = [
        Atmosphere(
            aerosol_optical_depth=depth,
            aerosol_asymmetry=0.76,
            angstrom_exponent=_ANGSTROM,
            aerosol_albedo=_ALBEDO,
        )
        for depth in (0.03, 0.12)
    ]

    def march(task: tuple[Atmosphere, float]) -> np.ndarray:
        # Suns of the same height are marched together, since they share the air's table.
        air, height = task
        return model_sky(air, where[0] - TURNS[:, None], where[1], (0.0, height))

    tasks = list(itertools.product(airs, HEIGHTS.tolist()))
    errors: dict[tuple[float, float], float] = {}
    found = _side_by_side(march, tasks, done)
    for (_, height), skies in zip(tasks, found, strict=True):
        for azimuth, sky in zip(TURNS.tolist(), skies, strict=True):
            error, _ = compare(display, sky, response)
            errors[azimuth, height] = min(error, errors.get((azimuth, height), np.inf))
    best, spread = likeliest_sun(errors, expected, seen, odds)
    return best, confidence_of_sun(best, errors), spread


def fit_without_sky(
    light: np.ndarray,
    sky: np.ndarray,
    sun: tuple[float, float] | None,
    expected: np.ndarray | None = None,
) -> SkyFit:
    """Return defaults, exposed so that gray land under this sun has the land's mean light."""
    if sun is None:
        expected = ANYWHERE if expected is None else expected
        alike = dict.fromkeys(itertools.product(TURNS.tolist(), HEIGHTS.tolist()), 0.0)
        sun, _ = likeliest_sun(alike, expected)
    response = Response()
    atmosphere = Atmosphere()
    overhead = model_sky(atmosphere, np.array([0.0]), np.array([45.0]), sun)[0]
    land = sky < 0.5
    seen = response.scene_light(light[land] if land.any() else light.reshape(-1, 3))
    level = float(np.median(seen @ LUMINANCE))
    gain = max(level, 1e-3) / max(float(overhead @ LUMINANCE) * 0.5, 1e-9)
    # Nothing was compared, so the defaults have no confidence.
    atmosphere = atmosphere.replace(confidence=0.0)
    return SkyFit(atmosphere, response, (gain, gain, gain), (0.0, 3.0, 2.0), sun, 0.0, 180.0)
