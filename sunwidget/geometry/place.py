"""Where and when a photo is taken, the camera's heading, and the resulting position of the sun.

A ``Place`` is part of the edit and does not move the sun by itself. The kernel and the browser
read its sun path, ``day_table``, in the same way, so that the clock moves the sun equally in both.
"""

from __future__ import annotations

import dataclasses
import datetime as dt
import functools
import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from sunwidget.messages import short_repr

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


_LOWEST, _HIGHEST = -12.0, 90.0  # valid elevations of an edit
_CLOCK = re.compile(r"(\d{1,2})(?::([0-5]\d))?$")


@dataclass(frozen=True)
class Place:
    """Position, date, time and camera heading.

    Parameters
    ----------
    latitude, longitude : float
        Degrees, positive to the north (−90 … 90) and to the east (−180 … 180).
    date : datetime.date or "YYYY-MM-DD"
        Day in UTC; kept as text.
    time : float
        Hours UTC, 0 … 24.
    heading : float, optional
        Direction of the camera, degrees clockwise from true north (0 ≤ heading < 360). None means
        unknown: then the time changes only the sun's elevation.

    Raises
    ------
    ValueError
        If a value is missing or out of range; the message says what is expected.
    """

    latitude: float
    longitude: float
    date: str
    time: float
    heading: float | None = None

    def __post_init__(self) -> None:
        _set(self, "latitude", _number("latitude", self.latitude, 90))
        _set(self, "longitude", _number("longitude", self.longitude, 180))
        _set(self, "date", _day(self.date))
        _set(self, "time", _number("time", self.time, 24, low=0))
        if self.heading is not None:
            _set(self, "heading", _number("heading", self.heading, 360) % 360)

    def replace(self, **changes: Any) -> Place:
        """Return a copy with ``changes`` to its fields; raises ValueError as ``Place`` does."""
        return dataclasses.replace(self, **changes)

    @classmethod
    def from_dict(cls, values: Any) -> Place:
        """Return the Place with ``values`` by field; raises ValueError if they do not form one."""
        names = [field.name for field in dataclasses.fields(cls)]
        if not isinstance(values, dict) or not set(names[:4]) <= values.keys() <= set(names):
            raise ValueError(
                f"place needs {', '.join(names[:4])} and may have {names[4]}, "
                f"not {short_repr(values)}."
            )
        return cls(**values)

    @property
    def moment(self) -> dt.datetime:
        """Date and time, in UTC."""
        midnight = dt.datetime.combine(dt.date.fromisoformat(self.date), dt.time(), dt.UTC)
        return midnight + dt.timedelta(hours=self.time)

    @property
    def solar_time(self) -> float:
        """Hours of local mean solar time, 0 … 24: the sun is highest within a quarter of 12."""
        return (self.time + self.longitude / 15) % 24


class SunOfDay(NamedTuple):
    """Position of the sun in degrees.

    ``azimuth`` is relative to the camera, or None if the heading is unknown. ``elevation`` is
    apparent: it includes refraction.
    """

    azimuth: float | None
    elevation: float
    true_elevation: float


def solar_day(place: Place) -> str:
    """Return the solar day, from one solar midnight to the next, that contains the place's time.

    In half of the world a UTC day begins in daylight; a day in local mean solar time begins and
    ends at night.
    """
    shift = math.floor((place.time + place.longitude / 15) / 24)
    return _later(place.date, shift)


def day_table(place: Place) -> NDArray[np.float64]:
    """Return the sun's path over the solar day of ``place``.

    Returns
    -------
    ndarray, shape (289, 4), float64, read-only
        Hours UTC from midnight of ``solar_day(place)`` (some are below 0 or above 24), azimuth
        0–360°, apparent and true elevation in degrees. From NREL's SPA (Reda & Andreas 2004) in
        pvlib.

    Raises
    ------
    ImportError
        Without pvlib; the message names the extra that installs it.
    """
    return _table(place.latitude, place.longitude, solar_day(place))


def sun_at(place: Place) -> SunOfDay:
    """Return the position of the sun at the time of ``place``, in the ranges of an edit.

    The elevation is limited to −12 … 90°. Raises ImportError as ``day_table`` does.
    """
    import numpy as np

    from sunwidget.geometry.solar import sun_on_path

    table = day_table(place)
    hours = hours_of_day(place)
    azimuth, elevation = sun_on_path(table, hours)
    true = float(np.interp(hours, table[:, 0], table[:, 3]))
    relative = None if place.heading is None else wrap_angle(azimuth - place.heading)
    return SunOfDay(relative, min(max(elevation, _LOWEST), _HIGHEST), true)


def hours_of_day(place: Place) -> float:
    """Return the place's time in the hours of ``day_table``."""
    shift = dt.date.fromisoformat(place.date) - dt.date.fromisoformat(solar_day(place))
    return place.time + 24 * shift.days


def at_hours(place: Place, hours: float) -> Place:
    """Return ``place`` at a time in the hours of ``day_table``, with the matching UTC date."""
    days = math.floor(hours / 24)
    time = round(hours - 24 * days, 4)
    return place.replace(date=_later(solar_day(place), days), time=time)


def clock_hours(value: float | str) -> float:
    """Return a time of day as hours, 0–24.

    Raises
    ------
    ValueError
        If the value is neither hours nor "HH:MM".
    """
    found = _CLOCK.match(value.strip()) if isinstance(value, str) else None
    if found:
        hours = int(found[1]) + int(found[2] or 0) / 60
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        hours = float(value)
    else:
        hours = math.nan
    if not 0 <= hours <= 24:
        raise ValueError(f"A time of day is hours UTC from 0 to 24 or 'HH:MM', not {value!r:.40}.")
    return hours


def wrap_angle(degrees: float) -> float:
    """Return the same angle in [−180, 180)."""
    return (degrees + 180) % 360 - 180


@functools.lru_cache(maxsize=64)
def _table(latitude: float, longitude: float, day: str) -> NDArray[np.float64]:
    import numpy as np

    from sunwidget.geometry.solar import day_path

    # Rounded as for transport, so that the browser reads exactly the same numbers.
    table = np.round(day_path(day, latitude, longitude, start=-longitude / 15), 6)
    table.flags.writeable = False
    return table


def _later(date: str, days: int) -> str:
    return (dt.date.fromisoformat(date) + dt.timedelta(days=days)).isoformat()


def _set(place: Place, name: str, value: Any) -> None:
    object.__setattr__(place, name, value)


def _number(name: str, value: Any, high: float, low: float | None = None) -> float:
    least = -high if low is None else low
    try:
        number = math.nan if isinstance(value, (str, bytes, bool)) else float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not least <= number <= high:
        raise ValueError(
            f"place: {name} must be a number from {least:g} to {high:g}, not {short_repr(value)}."
        )
    return number


def _day(value: Any) -> str:
    if isinstance(value, dt.datetime):
        value = value.date()
    try:
        day = value if isinstance(value, dt.date) else dt.date.fromisoformat(value)
    except (TypeError, ValueError):
        day = None
    # Years within the range of pandas' nanosecond timestamps, with a day to spare.
    if day is None or not 1700 <= day.year <= 2200:
        raise ValueError(f"place: date must be a day as YYYY-MM-DD, not {short_repr(value)}.")
    return day.isoformat()
