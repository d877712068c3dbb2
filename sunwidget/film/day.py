"""A real day at a place, as the path of a film."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from sunwidget.edit.table import Edit
from sunwidget.geometry.place import Place, at_hours, clock_hours, day_table, hours_of_day

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene

Between = Callable[[Edit, Edit, float, "Scene"], Edit]

CIVIL_TWILIGHT = -6.0
"""Degrees of the sun's centre below the horizon at civil dawn and dusk."""

_REMEDIES = dict.fromkeys(
    ("latitude", "longitude", "date", "time", "heading"),
    "the day its place: sunwidget.Day(sunwidget.Place(latitude, longitude, date, time))",
)


@dataclass(frozen=True)
class Day:
    """A day, or some hours of it, with the sun at its true position in each frame.

    Parameters
    ----------
    place : Place, optional
        Position, day and camera heading. Default: the edit's place, or the one that the photo's
        file records. If neither has a heading, the photo's own sun gives it, at the time that
        the file records, or else at the place's time.
    start, end : float or "HH:MM", optional
        Hours UTC of the first and the last frame. An end before the start is on the next day.
        Default: civil dawn and civil dusk, when the sun stands 6° below the horizon.
    edit : Edit
        All parameters but the sun.
    last : Edit, optional
        All parameters but the sun at the last frame, if they change along the way.

    Raises
    ------
    ValueError
        For an invalid time of day.

    Examples
    --------
    >>> sw.sweep(scene, sw.Day(start="15:00", end="18:30"), "evening.mp4", seconds=10)
    """

    place: Place | None = None
    start: float | str | None = None
    end: float | str | None = None
    edit: Edit = field(default_factory=Edit)
    last: Edit | None = None

    def __post_init__(self) -> None:
        if self.place is not None and not isinstance(self.place, Place):
            raise ValueError(f"place must be a sunwidget.Place, not {type(self.place).__name__}.")
        for edit in (self.edit, self.last):
            if not (edit is None or isinstance(edit, Edit)):
                raise ValueError(f"A day's edit is a sunwidget.Edit, not {type(edit).__name__}.")
        for name in ("start", "end"):
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, clock_hours(value))

    def edits(self, scene: Scene, shares: Sequence[float], between: Between) -> list[Edit]:
        """Return the edits along the day.

        Parameters
        ----------
        scene : Scene
            What ``analyze`` returned.
        shares : sequence of float
            Positions between the start (0) and the end (1).
        between : callable
            ``between(edit, last, share, scene)`` returns the edit at a share; it is called if the
            day has a ``last``. The sun's position is set afterwards.

        Returns
        -------
        list of Edit
            One per share.

        Raises
        ------
        ValueError
            If place, day or heading is unknown, or the sun does not rise that day.
        ImportError
            Without pvlib; the message names the extra that installs it.
        """
        place, first, last = self._hours(self._place(scene))
        row = []
        for share in shares:
            edit = self.edit
            if self.last is not None:
                edit = between(self.edit, self.last, share, scene)
            row.append(edit.at(at_hours(place, first + (last - first) * share)))
        return row

    def _place(self, scene: Scene) -> Place:
        from sunwidget.analysis.place_resolver import resolve_place

        place = self.place or self.edit.place
        return resolve_place(scene.photo, _REMEDIES, place=place).with_heading(scene)[0]

    def _hours(self, place: Place) -> tuple[Place, float, float]:
        """Return a place on the film's day, and its first and last hour as in ``day_table``."""
        if self.start is not None:
            place = place.replace(time=self.start)
        if self.start is not None and self.end is not None:
            first = hours_of_day(place)
            last = first + (float(self.end) - first) % 24
        else:
            table = day_table(place)
            up = np.flatnonzero(table[:, 2] > CIVIL_TWILIGHT)
            if not up.size:
                raise ValueError(
                    f"On {place.date} the sun stays more than 6° below the horizon there. Give "
                    "the film's hours: Day(start='10:00', end='14:00')."
                )
            dawn, dusk = _crossing(table, int(up[0]), -1), _crossing(table, int(up[-1]), 1)
            first = dawn if self.start is None else hours_of_day(place)
            if self.end is None:
                last = dusk if dusk > first else dusk + 24
            else:
                last = first + (float(self.end) - first) % 24
        if last == first:
            raise ValueError("The film's start and end are the same time; give another end.")
        return place, first, last


def _crossing(table: np.ndarray, row: int, step: int) -> float:
    """Return the hour between ``row`` and ``row + step`` at which the sun crosses −6°."""
    other = row + step
    if not 0 <= other < len(table):
        return float(table[row, 0])
    inside, outside = table[row, 2], table[other, 2]
    share = (inside - CIVIL_TWILIGHT) / (inside - outside)
    return float(table[row, 0] + share * (table[other, 0] - table[row, 0]))
