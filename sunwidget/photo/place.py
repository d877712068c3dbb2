"""Where, when and in which direction a photo was taken, as its file records or suggests it."""

from __future__ import annotations

import datetime as dt
from typing import TYPE_CHECKING, Any, NamedTuple

from sunwidget.geometry.place import Place

if TYPE_CHECKING:
    from sunwidget.photo.photo import Photo


class PhotoPlace(NamedTuple):
    """Place, time and heading as a photo's file records them.

    Attributes
    ----------
    latitude, longitude : float or None
        Degrees; both None where the file has no position.
    moment : datetime.datetime or None
        UTC.
    clock : datetime.datetime or None
        Time on the camera's clock, without a time zone.
    heading : float or None
        Degrees from north, clockwise.
    source : str
        Source of UTC: "offset" (the tag), "gps" (the GPS time stamp), "longitude" (a guess), or
        "" if UTC is unknown.
    notes : tuple of str
        Which values are guesses, and why.
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
        """The Place if the file records position and time, else None."""
        if self.latitude is None or self.longitude is None or self.moment is None:
            return None
        return Place(**self.values())

    def values(self) -> dict[str, Any]:
        """Return the values by the names of a Place's fields; None for each that is unknown."""
        date, hours = (None, None) if self.moment is None else date_and_hours(self.moment)
        return {
            "latitude": self.latitude,
            "longitude": self.longitude,
            "heading": self.heading,
            "date": date,
            "time": hours,
        }


def from_photo(photo: Photo, longitude: float | None = None) -> PhotoPlace:
    """Return place, time and heading from the EXIF of ``photo``.

    The offset of the camera's clock from UTC is the file's offset tag, else derived from the GPS
    time stamp, else guessed from the longitude at one hour per 15°.

    Parameters
    ----------
    photo : Photo
    longitude : float, optional
        Degrees east, for a photo whose file records none.
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
            f"The photo records no time zone. {zone_name(offset)} is guessed from the longitude; "
            "daylight saving time may add an hour."
        )
    elif moment is not None:
        moment = None
        notes.append("The photo records no time zone, and no place from which to guess it.")
    if facts.heading is not None and facts.heading_magnetic:
        notes.append(
            "The photo's heading is relative to magnetic north, which can differ from true north "
            "by some degrees."
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
    """Return a moment as date and hours in UTC; a moment without a zone is taken as UTC."""
    utc = moment.replace(tzinfo=moment.tzinfo or dt.UTC).astimezone(dt.UTC)
    seconds = utc.hour * 3600 + utc.minute * 60 + utc.second + utc.microsecond / 1e6
    return utc.date().isoformat(), round(seconds / 3600, 4)


def zone_name(offset: float) -> str:
    """Return an offset from UTC in hours as UTC+5:30."""
    minutes = round(abs(offset) * 60)
    rest = f":{minutes % 60:02d}" if minutes % 60 else ""
    return f"UTC{'-' if offset < 0 else '+'}{minutes // 60}{rest}"
