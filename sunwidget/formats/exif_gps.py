"""Read a photo's place, time and heading from EXIF.

Tags of Exif 3.0 (CIPA DC-008-2023), sections 4.6.5 (time) and 4.6.6 (GPS). As in ``exif``, every
reader returns None for nonsense and never raises.
"""

from __future__ import annotations

import datetime as dt
from typing import Any

from sunwidget.formats.exif_values import number, text

_DATE_TIME, _OFFSET_TIME = 0x0132, 0x9010
_DATE_TIME_ORIGINAL, _OFFSET_TIME_ORIGINAL = 0x9003, 0x9011
_DATE_TIME_DIGITIZED, _OFFSET_TIME_DIGITIZED = 0x9004, 0x9012
_FIRST_PHOTO, _LAST_YEAR = 1826, 2199  # a clock outside these years is not set
_OFFSETS = (-12.0, 14.0)  # hours; range of the world's time zones


def facts(exif: Any, shot: dict[int, Any], gps: dict[int, Any]) -> dict[str, Any]:
    """Return the fields of ``exif.CameraFacts`` for place, time and heading."""
    latitude = _degrees(gps.get(2), gps.get(1), "S", 90)
    longitude = _degrees(gps.get(4), gps.get(3), "W", 180)
    if latitude == 0 and longitude == 0:  # what a receiver without a fix writes
        latitude = longitude = None
    clock, tagged = _clock(exif, shot)
    stamp = _gps_time(gps)
    offset = _offset_to(clock, stamp) if tagged is None else tagged
    return {
        "latitude": latitude,
        "longitude": longitude,
        "altitude": _altitude(gps),
        "heading": _heading(gps),
        "heading_magnetic": text(gps.get(16)).upper() == "M",
        "time": best_time(clock, offset, stamp),
        "clock": clock,
        "utc_offset": offset,
        "offset_tagged": tagged is not None,
        "gps_time": stamp,
    }


def best_time(
    clock: dt.datetime | None, offset: float | None, stamp: dt.datetime | None
) -> dt.datetime | None:
    """Return the time of the shot: with a zone if one is known, else local and naive.

    The camera's clock with its offset comes first: the GPS time stamp is that of the last fix,
    which may be old if the camera was just taken out of the bag.
    """
    if clock is not None and offset is not None:
        return clock.replace(tzinfo=dt.timezone(dt.timedelta(hours=offset)))
    return stamp if stamp is not None else clock


def _clock(exif: Any, shot: dict[int, Any]) -> tuple[dt.datetime | None, float | None]:
    """Return the camera's clock, and the hours ahead of UTC from the tag that belongs to it."""
    for value, offset in (
        (shot.get(_DATE_TIME_ORIGINAL), shot.get(_OFFSET_TIME_ORIGINAL)),
        (shot.get(_DATE_TIME_DIGITIZED), shot.get(_OFFSET_TIME_DIGITIZED)),
        (exif.get(_DATE_TIME), shot.get(_OFFSET_TIME)),
    ):
        try:
            clock = dt.datetime.strptime(text(value)[:19], "%Y:%m:%d %H:%M:%S")  # noqa: DTZ007
        except ValueError:
            continue
        if _FIRST_PHOTO <= clock.year <= _LAST_YEAR:
            return clock, _zone(text(offset))
    return None, None


def _zone(offset: str) -> float | None:
    try:
        zone = dt.datetime.strptime(offset, "%z").utcoffset()
    except ValueError:
        return None
    hours = zone.total_seconds() / 3600 if zone is not None else None
    return hours if hours is not None and _OFFSETS[0] <= hours <= _OFFSETS[1] else None


def _gps_time(gps: dict[int, Any]) -> dt.datetime | None:
    stamp = gps.get(7)
    if not gps.get(29) or not isinstance(stamp, (tuple, list)) or len(stamp) != 3:
        return None
    parts = [number(part) for part in stamp]
    try:
        day = dt.datetime.strptime(text(gps[29]) + " +0000", "%Y:%m:%d %z")
        seconds = sum(part * step for part, step in zip(parts, (3600, 60, 1), strict=True) if part)
        found = day.astimezone(dt.UTC) + dt.timedelta(seconds=seconds)
        return found if _FIRST_PHOTO <= found.year <= _LAST_YEAR else None
    except (ValueError, OverflowError):
        return None


def _offset_to(clock: dt.datetime | None, stamp: dt.datetime | None) -> float | None:
    """Return the hours that the clock is ahead of the GPS, in quarters, as time zones are.

    None if the difference is too far from a quarter for a late fix: the clock is not set to the
    time of any zone, or the stamp is not from this shot.
    """
    if clock is None or stamp is None:
        return None
    ahead = (clock - stamp.replace(tzinfo=None)).total_seconds() / 3600
    offset = round(ahead * 4) / 4
    # Half a quarter would accept anything; five minutes accepts a set clock and a recent fix.
    fits = abs(ahead - offset) <= 5 / 60 and _OFFSETS[0] <= offset <= _OFFSETS[1]
    return offset if fits else None


def _degrees(value: Any, reference: Any, negative: str, limit: float) -> float | None:
    if not isinstance(value, (tuple, list)) or not 1 <= len(value) <= 3:
        return None
    parts = [number(part) for part in value]
    if any(part is None for part in parts):
        return None
    degrees = sum(part / 60**power for power, part in enumerate(parts) if part is not None)
    if not 0 <= degrees <= limit:
        return None
    return -degrees if text(reference).upper().startswith(negative) else degrees


def _altitude(gps: dict[int, Any]) -> float | None:
    metres = number(gps.get(6))
    if metres is None:
        return None
    below = gps.get(5) in (1, b"\x01")
    return -metres if below else metres


def _heading(gps: dict[int, Any]) -> float | None:
    degrees = number(gps.get(17))
    return degrees % 360 if degrees is not None and 0 <= degrees <= 360 else None
