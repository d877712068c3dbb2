"""Where, when and which way a photo was taken, as its file tells it or lets it be guessed."""

from __future__ import annotations

import datetime as dt
from typing import TYPE_CHECKING, Any, NamedTuple

from sunwidget.geometry.place import Place

if TYPE_CHECKING:
    from sunwidget.photo.photo import Photo


class PhotoPlace(NamedTuple):
    """What a photo's file says of place, time and heading.

    Attributes
    ----------
    latitude, longitude : float or None
        Degrees; both None where the file has no position.
    moment : datetime.datetime or None
        UTC.
    clock : datetime.datetime or None
        What the camera's clock showed, without a zone.
    heading : float or None
        Degrees from north, clockwise.
    source : str
        Where UTC is known from: "offset" (the tag), "gps" (the GPS' time stamp), "longitude" (a
        guess), or "" where it is not.
    notes : tuple of str
        What of it is a guess, and why.
    """

    latitude: float | None
    longitude: float | None
    moment: dt.datetime | None
    clock: dt.datetime | None
    heading: float | None
    source: str
    notes: tuple[str, ...]

    @property
    def place(self) -> Place | None:
        """The Place, when the file tells position and time."""
        if self.latitude is None or self.longitude is None or self.moment is None:
            return None
        return Place(**self.values())

    def values(self) -> dict[str, Any]:
        """Return what is told by the names of a Place's fields; what is not told is None."""
        date, hours = (None, None) if self.moment is None else date_and_hours(self.moment)
        return {
            "latitude": self.latitude,
            "longitude": self.longitude,
            "heading": self.heading,
            "date": date,
            "time": hours,
        }


def from_photo(photo: Photo, longitude: float | None = None) -> PhotoPlace:
    """Return what the EXIF of ``photo`` says of place, time and heading.

    The offset of the camera's clock from UTC is the one that the file names; else the one that
    the GPS' time stamp shows; else a guess by the longitude, an hour each 15°.

    Parameters
    ----------
    photo : Photo
    longitude : float, optional
        Degrees east, for a photo whose file has none.
    """
    facts = photo.facts
    notes = []
    east = facts.longitude if facts.longitude is not None else longitude
    moment, source = facts.time, ""
    if facts.clock is not None and facts.utc_offset is not None:
        source = "offset" if facts.offset_tagged else "gps"
    elif facts.gps_time is not None:
        source = "gps"
    elif moment is not None and east is not None:
        offset = round(east / 15)
        moment, source = (moment - dt.timedelta(hours=offset)).replace(tzinfo=dt.UTC), "longitude"
        notes.append(
            f"The photo's clock names no time zone. {zone_name(offset)} is a guess by the "
            "longitude; daylight saving time may make it an hour more."
        )
    elif moment is not None:
        moment = None
        notes.append("The photo's clock names no time zone, and its file no place to guess it by.")
    if facts.heading is not None and facts.heading_magnetic:
        notes.append(
            "The photo's heading is from magnetic north, which may be some degrees off true north."
        )
    return PhotoPlace(
        None if facts.latitude is None else round(facts.latitude, 6),
        None if facts.longitude is None else round(facts.longitude, 6),
        moment.astimezone(dt.UTC) if moment is not None else None,
        facts.clock,
        facts.heading,
        source,
        tuple(notes),
    )


def date_and_hours(moment: dt.datetime) -> tuple[str, float]:
    """Return a moment as date and hours in UTC; without a zone it is UTC."""
    utc = moment.replace(tzinfo=moment.tzinfo or dt.UTC).astimezone(dt.UTC)
    seconds = utc.hour * 3600 + utc.minute * 60 + utc.second + utc.microsecond / 1e6
    return utc.date().isoformat(), round(seconds / 3600, 4)


def zone_name(offset: float) -> str:
    """Return an offset from UTC in hours as UTC+5:30."""
    minutes = round(abs(offset) * 60)
    rest = f":{minutes % 60:02d}" if minutes % 60 else ""
    return f"UTC{'-' if offset < 0 else '+'}{minutes // 60}{rest}"
