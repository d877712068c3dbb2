"""The direction of the photographed sun in each frame of one camera.

With a clock and a place it is the solar position; suns visible in some frames give the camera's
heading and correct its error. Without a clock, visible suns are joined by straight lines. If no
frame shows the sun, one direction fitted to all sampled skies is used.
"""

from __future__ import annotations

import datetime as dt
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.hints import Hints
from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.sun import look_for_sun
from sunwidget.analysis.pipeline import grow_sun_mask
from sunwidget.analysis.sun.sun import SunObservation, find, observe
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera
from sunwidget.geometry.place import Place, sun_at, wrap_angle
from sunwidget.photo.place import date_and_hours

Direction = tuple[float, float]
_BURNT = 0.93  # encoded luminance that a disc reaches
_NEAR = 6.0  # degrees within which a bright spot matches the sun expected by the clock


class Sample(NamedTuple):
    """A sampled frame: its number, small copy, time, and the sun if it is visible."""

    number: int
    working: Working
    moment: dt.datetime | None
    seen: Direction | None


@dataclass(frozen=True, eq=False)
class SunTrack:
    """The sun of every frame.

    Attributes
    ----------
    samples : tuple of (index, azimuth, elevation)
        Directions joined by lines if there is no clock; degrees.
    place : Place or None
        With heading; None without a clock.
    correction : (azimuth, elevation)
        Degrees to add to the clock's sun, from the visible suns.
    source : str
        "clock", "seen", "told" or "assumed".
    """

    samples: tuple[tuple[int, float, float], ...]
    place: Place | None
    correction: Direction
    source: str

    def at(self, index: int, moment: dt.datetime | None) -> Direction:
        """Return azimuth from the camera's axis and apparent elevation, degrees."""
        if self.place is not None and moment is not None:
            date, hours = date_and_hours(moment)
            sun = sun_at(self.place.replace(date=date, time=hours))
            assert sun.azimuth is not None
            elevation = sun.elevation + self.correction[1]
            return wrap_angle(sun.azimuth + self.correction[0]), min(max(elevation, -12.0), 90.0)
        indices, azimuths, elevations = zip(*self.samples, strict=True)
        around = np.unwrap(np.radians(azimuths))
        azimuth = float(np.degrees(np.interp(index, indices, around)))
        return wrap_angle(azimuth), float(np.interp(index, indices, elevations))


def find_seen_sun(
    working: Working, sky: np.ndarray, camera: Camera, hints: Hints
) -> Direction | None:
    """Return the direction of the sun in a frame; None if it is not visible."""
    if hints.sun_outside:
        return None
    focal = camera.focal / working.zoom[1]
    peak = find(working, look_for_sun(working), sky)
    sun_mask = grow_sun_mask(working, sky, peak, focal, hints.method("sun"))
    sun = observe(None, sun_mask, sky, camera, working, peak)
    if sun is None or not sun.visible or sun.kind != "sun":
        return None
    return sun.azimuth, sun.elevation


def track_sun(
    samples: Sequence[Sample], place: Place | None, hinted: Direction | None, guess: Direction
) -> SunTrack:
    """Return the sun's track through the frames.

    Parameters
    ----------
    samples : sequence of Sample
        In the order of the film.
    place : Place or None
        Position of the camera; date and time are ignored. A missing heading follows from the
        visible suns, or else from placing the clock's sun at ``guess`` in the middle sample.
    hinted : (azimuth, elevation) or None
        Direction set by a hint.
    guess : (azimuth, elevation)
        Direction to use if nothing else is known.
    """
    timed = [s for s in samples if s.moment is not None]
    if place is not None and timed:
        return _by_clock(timed, place, guess)
    if hinted is not None:
        return SunTrack(((0, *hinted),), None, (0.0, 0.0), "told")
    seen = _on_one_way([(s.number, *s.seen) for s in samples if s.seen is not None])
    # A bright cloud is mistaken for the sun in a few frames; the sun itself is in many.
    if len(seen) >= max(2, math.ceil(len(samples) / 3)):
        return SunTrack(tuple(seen), None, (0.0, 0.0), "seen")
    return SunTrack(((0, *guess),), None, (0.0, 0.0), "assumed")


def _on_one_way(seen: list[tuple[int, float, float]]) -> list[tuple[int, float, float]]:
    """Drop the suns that lie off the straight line of most others."""
    if len(seen) < 3:
        return seen
    numbers = np.array([number for number, _, _ in seen], float)
    off = np.zeros(len(seen))
    for values in (np.unwrap(np.radians([s[1] for s in seen])), np.radians([s[2] for s in seen])):
        # The median slope over all pairs (Theil 1950, Sen 1968).
        rise = np.subtract.outer(values, values)[np.triu_indices(len(seen), 1)]
        run = np.subtract.outer(numbers, numbers)[np.triu_indices(len(seen), 1)]
        rest = values - np.median(rise / run) * numbers
        off = np.maximum(off, np.abs(np.degrees(rest - np.median(rest))))
    return [s for s, degrees in zip(seen, off, strict=True) if degrees < _NEAR]


def _by_clock(timed: Sequence[Sample], place: Place, guess: Direction) -> SunTrack:
    north = SunTrack((), place.replace(heading=0.0), (0.0, 0.0), "clock")
    shown = [(s.seen, north.at(s.number, s.moment)) for s in timed if s.seen is not None]
    heading = place.heading
    if heading is None:
        pairs = shown or [
            (guess, north.at(timed[len(timed) // 2].number, timed[len(timed) // 2].moment))
        ]
        heading = _middle_angle([true[0] - seen[0] for seen, true in pairs if seen])
    facing = place.replace(heading=heading)
    track = SunTrack((), facing, (0.0, 0.0), "clock")
    off = [
        (wrap_angle(seen[0] - expected[0]), seen[1] - expected[1])
        for s in timed
        if (seen := s.seen) is not None
        and math.dist(seen, expected := track.at(s.number, s.moment)) < _NEAR
    ]
    correction = (0.0, 0.0)
    if off:
        correction = float(np.median([a for a, _ in off])), float(np.median([e for _, e in off]))
    track = SunTrack((), facing, correction, "clock")
    # For frames whose file has no time.
    known = tuple((s.number, *track.at(s.number, s.moment)) for s in timed)
    return SunTrack(known, facing, correction, "clock")


def _middle_angle(degrees: Sequence[float]) -> float:
    """Return the angle with the least total distance to the others."""
    angles = np.array(degrees)
    apart = np.abs((angles[:, None] - angles + 180) % 360 - 180)
    return float(angles[apart.sum(axis=1).argmin()] % 360)


def middle_direction(directions: Sequence[Direction], weights: Sequence[float]) -> Direction:
    """Return the direction with the least weighted total distance to the others."""
    azimuth, elevation = np.radians(np.array(directions, float)).T
    rays = np.stack(
        [
            np.cos(elevation) * np.sin(azimuth),
            np.cos(elevation) * np.cos(azimuth),
            np.sin(elevation),
        ]
    )
    apart = np.arccos(np.clip(rays.T @ rays, -1, 1))
    return directions[int((apart @ np.array(weights, float)).argmin())]


def observation(
    sun: Direction, working: Working, sky: np.ndarray, camera: Camera, hints: Hints, source: str
) -> SunObservation:
    """Return the observation of a sun in a frame whose direction is known.

    It is visible if the sky is clipped at its position. Behind land or cloud or outside the frame
    it is not visible and has no pixels.
    """
    size = camera.width, camera.height
    x, y = camera.pixel(*sun)
    small_x, small_y = x / working.zoom[0], y / working.zoom[1]
    inside = 0 <= small_x < working.width and 0 <= small_y < working.height
    if inside:
        focal = camera.focal / working.zoom[1]
        reach = max(2, round(0.02 * max(sky.shape)))
        row, column = int(small_y), int(small_x)
        window = (
            slice(max(row - reach, 0), row + reach + 1),
            slice(max(column - reach, 0), column + reach + 1),
        )
        burnt = (working.encoded[window] @ LUMINANCE > _BURNT) & (sky[window] > 0.5)
        if burnt.any():
            sun_mask = grow_sun_mask(working, sky, (small_x, small_y), focal, hints.method("sun"))
            if sun_mask is not None and sun_mask.mask.any():
                radius = sun_mask.radius * working.zoom[1]
                return SunObservation(x, y, radius, *sun, sun_mask.mask, size, True, source)
    none = np.zeros(sky.shape, np.float32)
    return SunObservation(x, y, 0.0, *sun, none, size, False, source)
