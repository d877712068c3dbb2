"""A camera's heading, derived from the sun in its photo.

The photo's sun was detected at azimuth a from the camera's axis; time and place give its true
azimuth A. The heading is A − a. The difference of the elevations checks time and place: it is
large if the clock or its time zone is wrong.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from sunwidget.geometry.place import Place, at_hours, day_table, hours_of_day, sun_at, wrap_angle

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene

AGREES = 3.0
"""Largest difference of the elevations in degrees: the accuracy of horizon and field of view."""


class HeadingMatch(NamedTuple):
    """A heading from the photo's sun, and the evidence for it.

    Attributes
    ----------
    place : Place
        The requested place, with its heading.
    mismatch : float
        Apparent elevation of the photo's sun minus that at the place's time, in degrees.
    agreeing : tuple of Place
        The place at the times of that day at which the elevations agree, each with the matching
        heading, nearest first; empty if the sun does not reach the photo's elevation that day.
    seen : bool
        Whether the photo shows its sun; otherwise sun position and heading are guesses.
    note : str
        The result in words.
    """

    place: Place
    mismatch: float
    agreeing: tuple[Place, ...]
    seen: bool
    note: str

    @property
    def agrees(self) -> bool:
        """Whether time and place fit the photo's sun."""
        return abs(self.mismatch) <= AGREES


def heading_by_sun(scene: Scene, place: Place) -> HeadingMatch:
    """Return the heading that places the photo's sun where it stood at the given time and place.

    Parameters
    ----------
    scene : Scene
        The analysed photo.
    place : Place
        Where and when the photo was taken; its heading is ignored.

    Raises
    ------
    ValueError
        If the photo shows the moon, for which the sun's path is no evidence.
    ImportError
        Without pvlib; the message names the extra that installs it.
    """
    if scene.lit_by_moon:
        raise ValueError(
            "The photo shows the moon, but a heading can only be derived from the sun. Give the "
            "heading, degrees clockwise from north."
        )
    found = scene.automatic
    return match(place, found["sun_azimuth"], found["sun_elevation"], seen=scene.shows_sun)


def match(place: Place, azimuth: float, elevation: float, *, seen: bool = True) -> HeadingMatch:
    """Return the heading for a sun seen at ``azimuth`` from the camera's axis, in degrees.

    ``elevation`` is apparent; everything else is as in ``heading_by_sun``.
    """
    here = _with_heading(place, azimuth)
    mismatch = elevation - sun_at(here).elevation
    table, now = day_table(place), hours_of_day(place)
    times = sorted(_crossings(table[:, 0], table[:, 2], elevation), key=lambda h: abs(h - now))
    agreeing = tuple(_with_heading(at_hours(place, hours), azimuth) for hours in times)
    note = _note(here, mismatch, [(hours - now) for hours in times], agreeing, elevation)
    if not seen:
        note = (
            "The photo does not show its sun: its position is a guess, and so is the heading. "
            + note
        )
    return HeadingMatch(here, mismatch, agreeing, seen, note)


def clock(hours: float) -> str:
    """Return hours as 14:05."""
    minutes = math.floor(hours * 60 + 0.5) % 1440
    return f"{minutes // 60:02d}:{minutes % 60:02d}"


def _with_heading(place: Place, azimuth: float) -> Place:
    north = place.replace(heading=0.0)
    true = sun_at(north).azimuth
    assert true is not None
    return place.replace(heading=round(wrap_angle(true - azimuth) % 360, 4) % 360)


def _crossings(hours: np.ndarray, heights: np.ndarray, level: float) -> list[float]:
    """Return the hours at which the elevation passes a level, interpolated between rows."""
    above = heights - level
    found = []
    for i in np.flatnonzero(above[:-1] * above[1:] < 0):
        share = above[i] / (above[i] - above[i + 1])
        found.append(float(hours[i] + share * (hours[i + 1] - hours[i])))
    return found


def _note(
    place: Place, mismatch: float, apart: list[float], agreeing: tuple[Place, ...], level: float
) -> str:
    way = "higher" if mismatch > 0 else "lower"
    at = f"{clock(place.time)} UTC"
    if abs(mismatch) <= AGREES:
        return f"Time and place agree with the photo's sun to within {abs(mismatch):.1f}°."
    start = f"The photo's sun is {abs(mismatch):.1f}° {way} than at {at}. "
    if not agreeing:
        return f"{start}On this day the sun is never at {level:.1f}°: check the date and place."
    times = " and ".join(f"{clock(p.time)} UTC" for p in agreeing)
    times = times.replace(" UTC", f" UTC{_shift(apart[0])}", 1)
    return f"{start}Is the clock or its time zone wrong? The elevations agree at {times}."


def _shift(hours: float) -> str:
    """Describe a difference of nearly whole hours, as between time zones; else return ""."""
    whole = round(hours)
    if whole == 0 or abs(hours - whole) > 0.2:
        return ""
    return f" ({abs(whole)} h {'later' if whole > 0 else 'earlier'})"
