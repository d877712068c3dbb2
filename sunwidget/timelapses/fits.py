"""The atmosphere and the camera's gain in every frame, smoothed in time.

Air and response are fitted to a few frames and shared by all. The gain is measured in each frame on
the same pixels. Its slow part is smoothed; jumps of the exposure are kept, since the photos have
them, too.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.clouds.clouds import ratio_index
from sunwidget.analysis.fit.fit import Response, SkyFit, fit_without_sky, model_sky, view_angles
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.networks.sun import look_for_sun
from sunwidget.analysis.pipeline import Steps, clouds_by_color, erased_for, fit_atmosphere
from sunwidget.analysis.scene import Scene
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.formats.color import LUMINANCE
from sunwidget.timelapses.sun import Direction, Sample, observation

METER_SIDE = 192
_PIXELS = 400
_LEAST_PIXELS = 40  # of sky to measure the gain; with fewer it is measured on land
_REACH = 3.0  # frames: standard deviation of the low-pass over gains
_LEVEL, _TURN = 0.5, 4.0  # natural log of exposure, degrees of sun: scales of unlike frames


class Key(NamedTuple):
    """The fit of one frame and its weight."""

    number: int
    fit: SkyFit
    weight: float


class Reading(NamedTuple):
    """Measurements of one frame.

    Log gain (3,), log exposure of the land relative to the other frames, and the sky's brightness:
    the 90th percentile of the encoded luminance, 1 without sky.
    """

    log_gain: np.ndarray
    exposure: float
    sky_light: float


def fit_key(sample: Sample, shared: Scene, sun: Direction, source: str) -> Key:
    """Fit air and camera to one frame with a known sun."""
    working = sample.working
    sky = np.asarray(resize(shared.sky, working.width, working.height), np.float32)
    seen = observation(sun, working, sky, shared.camera, shared.hints, source)
    erased = erased_for(working, look_for_sun(working), sky, seen)
    mask = seen.blot if seen.visible else None
    covers = clouds_by_color(erased.working, sky, shared.hints, mask)
    fit, _, _ = fit_atmosphere(
        working, erased, sky, covers, shared.camera, seen, shared.hints, Steps(None)
    )
    return Key(sample.number, fit, 0.05 + (fit.atmosphere.confidence or 0.0))


@dataclass(frozen=True, eq=False)
class Film:
    """The air and response shared by all frames, and a glare that may change.

    Fits of single frames differ by more than the air changes in a day, and a pulsating ring around
    the sun would spoil the film. The air is their median, weighted by confidence.
    """

    keys: tuple[Key, ...]
    atmosphere: Atmosphere
    response: Response

    @classmethod
    def of(cls, keys: Sequence[Key]) -> Film:
        """Return the air and response shared by the keys' frames."""
        votes: dict[Response, float] = defaultdict(float)
        for key in keys:
            votes[key.fit.response] += key.weight
        weight = np.array([key.weight for key in keys])
        airs = [key.fit.atmosphere for key in keys]
        depths = np.log([max(air.aerosol_optical_depth, 1e-3) for air in airs])
        atmosphere = airs[0].replace(
            aerosol_optical_depth=float(np.exp(weighted_median(depths, weight))),
            aerosol_asymmetry=weighted_median(
                np.array([air.aerosol_asymmetry for air in airs]), weight
            ),
            residual=float(np.median([air.residual or 0.0 for air in airs])),
            confidence=float(np.median([air.confidence or 0.0 for air in airs])),
        )
        return cls(tuple(keys), atmosphere, max(votes, key=lambda response: votes[response]))

    def fit(self, number: int, sun: Direction, log_gain: np.ndarray) -> SkyFit:
        """Return the fit of a frame with its sun and gain."""
        # Frames that do not show the sun have no glare.
        known = [key for key in self.keys if key.fit.glare[0] > 0] or list(self.keys)
        at = [key.number for key in known]
        height, width, power = (
            float(np.interp(number, at, [key.fit.glare[i] for key in known])) for i in range(3)
        )
        red, green, blue = (float(gain) for gain in np.exp(log_gain))
        return SkyFit(
            self.atmosphere, self.response, (red, green, blue), (height, width, power), sun
        )


class Meter:
    """Measures the gain and exposure of frames on the same pixels.

    Parameters
    ----------
    shared : Scene
        The frames' shared scene.
    film : Film
    """

    def __init__(self, shared: Scene, film: Film) -> None:
        small = shared.working.shrunk(METER_SIDE)
        self.size = small.width, small.height
        self.film = film
        self.sky = np.asarray(resize(shared.sky, *self.size), np.float32)
        azimuth, elevation = view_angles(shared.camera, *self.size)
        self.inside = _some((self.sky > 0.98) & (elevation > 0.3))
        self.where = azimuth.ravel()[self.inside], elevation.ravel()[self.inside]
        self.still = _some(self.sky < 0.02)
        if self.still.size < _LEAST_PIXELS:
            self.still = self.inside
        self.usual = _log_light(small.luminance, self.still)

    def read(self, working: Working, sun: Direction) -> Reading:
        """Return the measurements of a frame of any size."""
        light = np.asarray(resize(working.linear, *self.size), np.float32)
        level = _log_light(light @ LUMINANCE, self.still) - self.usual
        exposure = float(np.median(level))
        if self.inside.size < _LEAST_PIXELS:
            fit = fit_without_sky(light, self.sky, sun)
            return Reading(np.log(fit.gain), exposure, 1.0)
        seen = light.reshape(-1, 3)[self.inside]
        encoded = np.asarray(resize(working.encoded, *self.size)).reshape(-1, 3)[self.inside]
        # White and clipped pixels get little weight, but not zero, so that weights do not jump.
        cloud = np.clip((ratio_index(encoded) - 0.62) / 0.1 + 0.5, 0, 1)
        weight = np.square(1 - cloud) * np.clip((0.97 - seen.max(-1)) / 0.05, 0, 1) + 0.01
        model = model_sky(self.film.atmosphere, *self.where, sun)
        logs = np.log(self.film.response.scene_light(seen)) - np.log(model)
        gain = np.array([weighted_median(logs[:, i], weight) for i in range(3)])
        bright = float(np.quantile(encoded @ LUMINANCE, 0.9))
        return Reading(gain, exposure, bright)


def steady(
    readings: Sequence[Reading | None], suns: Sequence[Direction | None]
) -> tuple[np.ndarray, np.ndarray]:
    """Low-pass the gains, except for the camera's jumps of exposure.

    Parameters
    ----------
    readings : sequence of n
        None for unreadable frames, which are interpolated.
    suns : sequence of n

    Returns
    -------
    log_gain (n, 3), exposure (n,) : float64
        The gains, and the log exposures with missing ones interpolated.
    """
    known = np.array([i for i, reading in enumerate(readings) if reading is not None])
    gains = np.array([r.log_gain for r in readings if r is not None])
    exposures = np.array([r.exposure for r in readings if r is not None])
    every = np.arange(len(readings))
    exposure = np.interp(every, known, exposures)
    gain = np.stack([np.interp(every, known, gains[:, i]) for i in range(3)], axis=-1)
    weights = likeness(exposure, suns)
    # A frame's jump is the exposure of its land over that of its neighbors.
    jump = exposure - _low_pass(exposure[:, None], weights)[:, 0]
    slow = _low_pass(gain - jump[:, None], weights)
    return slow + jump[:, None], exposure


def likeness(exposure: np.ndarray, suns: Sequence[Direction | None]) -> np.ndarray:
    """Return how likely frames i and i + j, |j| ≤ 8, are of one take: (n, 17) in [0, 1]."""
    count, reach = len(exposure), 8
    angles = np.array([(np.nan, np.nan) if sun is None else sun for sun in suns], float)
    found = np.zeros((count, 2 * reach + 1))
    for step in range(-reach, reach + 1):
        other = np.arange(count) + step
        inside = (other >= 0) & (other < count)
        other = np.clip(other, 0, count - 1)
        turn = (angles[:, 0] - angles[other, 0] + 180) % 360 - 180
        turn = turn * np.cos(np.radians(angles[:, 1]))
        apart = np.nan_to_num(np.hypot(turn, angles[:, 1] - angles[other, 1]))
        level = exposure - exposure[other]
        found[:, step + reach] = inside * np.exp(
            -0.5 * (np.square(level / _LEVEL) + np.square(apart / _TURN))
        )
    return found


def _low_pass(values: np.ndarray, weights: np.ndarray) -> np.ndarray:
    reach = weights.shape[1] // 2
    total, sums = np.zeros(len(values)), np.zeros_like(values)
    for step in range(-reach, reach + 1):
        weight = weights[:, step + reach] * np.exp(-0.5 * (step / _REACH) ** 2)
        other = np.clip(np.arange(len(values)) + step, 0, len(values) - 1)
        total += weight
        sums += weight[:, None] * values[other]
    return sums / total[:, None]


def weighted_median(values: np.ndarray, weight: np.ndarray) -> float:
    """Return the value below which half of the weight lies."""
    order = np.argsort(values)
    below = np.cumsum(weight[order])
    return float(np.interp(0.5 * below[-1], below - 0.5 * weight[order], values[order]))


def _some(mask: np.ndarray) -> np.ndarray:
    index = np.flatnonzero(mask)
    return index[:: max(1, index.size // _PIXELS)]


def _log_light(luminance: np.ndarray, index: np.ndarray) -> np.ndarray:
    return np.asarray(np.log(np.clip(luminance.ravel()[index], 2e-3, 0.98)))
