"""The command line's clock: flags of place and time, and the edit that they make."""

from __future__ import annotations

import argparse
import re
import sys
from typing import TYPE_CHECKING, Any

from sunwidget.edit.recipe import read_recipe
from sunwidget.edit.table import Edit
from sunwidget.geometry.place import Place

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.photo.photo import Photo
    from sunwidget.photo.place import PhotoPlace

_TIME = re.compile(r"(\d{1,2})(?::([0-5]\d))?$")


def add_place(parser: argparse.ArgumentParser, *, end: bool = False) -> None:
    """Add the flags of place and time; with ``end`` also the time at which a film ends."""
    group = parser.add_argument_group(
        "time and place (what is not given comes from the recipe or the photo's file)"
    )
    group.add_argument(
        "--place",
        dest="coordinates",
        type=coordinates,
        metavar="LAT,LON",
        help="degrees, north and east positive",
    )
    group.add_argument("--date", type=_date, metavar="YYYY-MM-DD", help="day in UTC")
    group.add_argument(
        *("--time", "--start-time")[: 2 if end else 1],
        dest="time",
        type=_time,
        metavar="HH:MM",
        help="UTC; the sun goes where it is",
    )
    group.add_argument(
        "--heading",
        type=_heading,
        metavar="DEG",
        help="where the camera looks, clockwise from north (default: by the photo's own sun)",
    )
    if end:
        group.add_argument(
            "--to-time",
            "--end-time",
            dest="to_time",
            type=_time,
            metavar="HH:MM",
            help="time of the last frame",
        )


def is_placed(options: argparse.Namespace) -> bool:
    """Whether a flag of place or time was given."""
    names = ("coordinates", "date", "time", "heading", "to_time")
    return any(getattr(options, name, None) is not None for name in names)


def placed(options: argparse.Namespace, scene: Scene, edit: Edit) -> Edit:
    """Return ``edit`` with the sun where the flags of place and time put it.

    Raises
    ------
    ValueError
        When place, date or time are neither given nor known, or the heading cannot be found.
    ImportError
        Without pvlib; the message names the extra that brings it.
    """
    return edit.at(place_of(options, scene, edit))


def place_of(options: argparse.Namespace, scene: Scene, edit: Edit) -> Place:
    """Return the place of the flags, completed by the edit and the photo's file.

    Raises
    ------
    ValueError
        When place, date or time are neither given nor known, or the heading cannot be found.
    """
    told, values = _values(options, scene.photo, edit.place)
    if values["heading"] is None or options.time is None:
        for note in told.notes:
            print(f"sunwidget: {note}", file=sys.stderr)
    place = Place(**values)
    own = told.values()
    return place if place.heading is not None else _facing(scene, place, own["date"], own["time"])


def refuse_unplaced(options: argparse.Namespace, photo: Photo) -> None:
    """Fail before the analysis when the clock is asked for and place, day or time are unknown."""
    if is_placed(options) or _whole_day(options):
        recipe = None if options.recipe is None else read_recipe(options.recipe)
        _values(options, photo, recipe.place if recipe else None)


def _values(
    options: argparse.Namespace, photo: Photo, place: Place | None
) -> tuple[PhotoPlace, dict[str, Any]]:
    """Return what the photo's file tells, and the fields of the Place that flags are to give."""
    from sunwidget.photo.place import from_photo

    latitude, longitude = options.coordinates or (None, None)
    told = from_photo(photo, longitude)
    values = told.values()
    given = {
        "latitude": latitude,
        "longitude": longitude,
        "date": options.date,
        "time": options.time,
        "heading": options.heading,
    }
    known = vars(place) if place is not None else {}
    for source in (known, given):
        values |= {name: value for name, value in source.items() if value is not None}
    if values["time"] is None and values["longitude"] is not None and _whole_day(options):
        values["time"] = (12 - values["longitude"] / 15) % 24  # any hour while the sun is up
    _refuse_missing(values)
    return told, values


def _refuse_missing(values: dict[str, Any]) -> None:
    needed = {
        "latitude": ("the place", "--place LAT,LON"),
        "date": ("the day", "--date YYYY-MM-DD"),
        "time": ("the time", "--time HH:MM"),
    }
    missing = [words for name, words in needed.items() if values[name] is None]
    if missing:
        what, flags = (" and ".join(words) for words in zip(*missing, strict=True))
        raise ValueError(
            f"The sun's position needs place, day and time, but neither the photo's file "
            f"nor a recipe gives {what}. Give {flags}."
        )


def _whole_day(options: argparse.Namespace) -> bool:
    return bool(getattr(options, "day", False))


def _facing(scene: Scene, place: Place, date: str | None, time: float | None) -> Place:
    """Return the place with the heading that the photo's sun gives at the photo's own time."""
    from sunwidget.analysis.heading import heading_by_sun

    if date is None or time is None:
        raise ValueError(
            "Which way the camera looks is found by the photo's sun at the photo's own time, "
            "which its file does not record. Give --heading, degrees from north."
        )
    found = heading_by_sun(scene, place.replace(date=date, time=time))
    print(f"sunwidget: Heading {found.place.heading:.1f}°. {found.note}", file=sys.stderr)
    return place.replace(heading=found.place.heading)


def coordinates(text: str) -> tuple[float, float]:
    """Parse 50.09,14.42."""
    try:
        latitude, longitude = (float(part) for part in text.split(","))
        Place(latitude, longitude, "2000-01-01", 0)
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"{text!r} is not latitude,longitude in degrees, as 50.09,14.42"
        ) from None
    return latitude, longitude


def _date(text: str) -> str:
    try:
        return Place(0, 0, text, 0).date
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a day as 2024-06-21") from None


def _time(text: str) -> float:
    found = _TIME.match(text)
    hours = int(found[1]) + int(found[2] or 0) / 60 if found else -1.0
    if not 0 <= hours <= 24:
        raise argparse.ArgumentTypeError(f"{text!r} is not a time of day in UTC as 17:30")
    return hours


def _heading(text: str) -> float:
    try:
        heading = Place(0, 0, "2000-01-01", 0, float(text)).heading
    except ValueError:
        heading = None
    if heading is None:
        raise argparse.ArgumentTypeError(f"{text!r} is not a heading from 0 to 360 degrees")
    return heading
