"""The sun's position at a time and place: NREL's algorithm, computed by pvlib.

Reda & Andreas, "Solar position algorithm for solar radiation applications", Solar Energy 76
(2004), accurate to 0.0003° from the year -2000 to 6000. Azimuths are clockwise from north.
"""

from __future__ import annotations

import datetime as dt
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sunwidget.atmosphere.sun import refraction

Array = NDArray[np.float64]

# Bennett's formula ends at -1° (sun.refraction). Below, refraction falls to zero at this true
# elevation, where civil twilight ends.
_UNREFRACTED_DEG = -6.0


class SolarPosition(NamedTuple):
    """The sun's position in degrees: numbers, or arrays for several times."""

    azimuth: Any
    true_elevation: Any
    apparent_elevation: Any


def solar_position(when: Any, latitude: float, longitude: float) -> SolarPosition:
    """Return the position of the sun's center.

    Parameters
    ----------
    when : datetime.datetime, str or sequence of them
        Time with its zone (``2013-05-27T12:30-04:00``); UTC without a zone.
    latitude, longitude : float
        Degrees, positive to the north and to the east.

    Returns
    -------
    SolarPosition
        Azimuth 0-360° clockwise from north, true (geometric) elevation, and apparent elevation,
        with refraction; floats for one time, arrays for several.

    Raises
    ------
    ImportError
        Without pvlib; the message names the extra that installs it.
    ValueError
        For a latitude or longitude out of range, or a time that cannot be parsed.
    """
    _check_place(latitude, longitude)
    pandas, solarposition = _pvlib()
    single = isinstance(when, (str, dt.datetime, np.datetime64))
    times = pandas.DatetimeIndex(
        [pandas.to_datetime(t, utc=True) for t in ([when] if single else when)]
    )
    table = solarposition.spa_python(times, latitude, longitude)
    true = table["elevation"].to_numpy(float)
    found = SolarPosition(table["azimuth"].to_numpy(float) % 360, true, apparent_elevation(true))
    return SolarPosition(*(float(values[0]) for values in found)) if single else found


def day_path(
    date: dt.date | str,
    latitude: float,
    longitude: float,
    step_minutes: float = 5,
    start: float = 0.0,
) -> Array:
    """Return the sun's path over one day, counted in UTC.

    Parameters
    ----------
    date : datetime.date or str
        The day, as a date or as ``YYYY-MM-DD``.
    latitude, longitude : float
        Degrees, positive to the north and to the east.
    step_minutes : float, default 5
        Step, a divisor of the day's 1440 minutes.
    start : float, default 0
        Hours after the day's midnight in UTC at which the path begins; may be negative.

    Returns
    -------
    ndarray, shape (n, 4), float64
        Hours UTC from ``start`` to ``start`` + 24, azimuth 0-360°, apparent and true elevation
        in degrees.

    Raises
    ------
    ImportError, ValueError
        As ``solar_position``.
    """
    day = dt.date.fromisoformat(date) if isinstance(date, str) else date
    steps = round(1440 / step_minutes)
    if steps < 1 or abs(steps * step_minutes - 1440) > 1e-6:
        raise ValueError(f"step_minutes must divide the day's 1440, not {step_minutes!r}.")
    midnight = dt.datetime(day.year, day.month, day.day, tzinfo=dt.UTC)
    minutes = [60 * start + step_minutes * i for i in range(steps + 1)]
    sun = solar_position([midnight + dt.timedelta(minutes=m) for m in minutes], latitude, longitude)
    hours = np.array(minutes) / 60
    return np.stack([hours, sun.azimuth, sun.apparent_elevation, sun.true_elevation], axis=1)


def sun_on_path(path: ArrayLike, hours: float) -> tuple[float, float]:
    """Return azimuth (-180 to 180) and apparent elevation at a time of ``day_path``.

    The two neighboring rows are mixed as unit vectors, so that the step from 360° to 0° and a
    sun at the zenith need no special case. The browser does the same (``day.js``).
    """
    table = np.asarray(path, float)
    last = len(table) - 2
    i = int(np.clip(np.searchsorted(table[:, 0], hours, side="right") - 1, 0, last))
    t = (hours - table[i, 0]) / (table[i + 1, 0] - table[i, 0])
    azimuth, elevation = np.radians(table[i : i + 2, 1:3]).T
    level = np.cos(elevation)
    vectors = np.stack([level * np.sin(azimuth), level * np.cos(azimuth), np.sin(elevation)])
    east, north, up = vectors @ [1 - t, t]
    found = np.degrees([np.arctan2(east, north), np.arctan2(up, np.hypot(east, north))])
    return float(found[0]), float(found[1])


def apparent_elevation(true_elevation: ArrayLike) -> Array:
    """Return the apparent elevation of a sun of given true elevation, in degrees.

    Inverse of ``sun.true_elevation`` down to -1°, where Bennett's formula ends. Twilight is
    computed without refraction: below -1° refraction fades linearly to zero at a true -6°, so
    that the setting sun neither jumps nor turns back.
    """
    true = np.asarray(true_elevation, float)
    apparent = true.copy()
    # Refraction changes by at most a fifth of the elevation, so each round gains about a digit.
    for _ in range(30):
        apparent = true + refraction(apparent)
    lowest = -1.0 - float(refraction(-1.0))
    share = np.clip((true - _UNREFRACTED_DEG) / (lowest - _UNREFRACTED_DEG), 0, 1)
    return np.where(true >= lowest, apparent, true + share * refraction(-1.0))


def _check_place(latitude: float, longitude: float) -> None:
    for name, value, limit in (("latitude", latitude, 90), ("longitude", longitude, 180)):
        if not -limit <= value <= limit:
            raise ValueError(f"{name} must be a number from -{limit} to {limit}, not {value!r}.")


def _pvlib() -> tuple[Any, Any]:
    try:
        import pandas as pd
        from pvlib import solarposition
    except ImportError as error:
        raise ImportError(
            "The sun's position at a date and time needs pvlib, which is not installed. "
            "Run: pip install 'sunwidget[solar]'"
        ) from error
    return pd, solarposition
