"""The flags of place and time, and the edit that results from them."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from sunwidget.edit.recipe import read_recipe
from sunwidget.edit.table import Edit
from sunwidget.geometry.place import Place, clock_hours

if TYPE_CHECKING:
    from sunwidget.analysis.place_resolver import ResolvedPlace
    from sunwidget.analysis.scene import Scene
    from sunwidget.photo.photo import Photo

_REMEDIES = {
    "latitude": "--place LAT,LON",
    "longitude": "--place LAT,LON",
    "date": "--date YYYY-MM-DD",
    "time": "--time HH:MM",
    "heading": "--heading DEG, clockwise from north",
}


def add_place(parser: argparse.ArgumentParser, *, end: bool = False) -> None:
    """Add the flags of place and time, and with ``end`` the time of a film's last frame."""
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


def place_sun(options: argparse.Namespace, scene: Scene, edit: Edit) -> Edit:
    """Return ``edit`` with the sun at the place and time of the flags.

    Raises
    ------
    ValueError
        If place, date or time is neither given nor recorded, or the heading cannot be derived.
    ImportError
        Without pvlib; the message names the extra that installs it.
    """
    return edit.at(place_of(options, scene, edit))


def place_of(options: argparse.Namespace, scene: Scene, edit: Edit) -> Place:
    """Return the place of the flags, completed by the edit and the photo's file.

    Raises
    ------
    ValueError
        If place, date or time is neither given nor recorded, or the heading cannot be derived.
    """
    resolved = _resolved(options, scene.photo, edit.place)
    if resolved.place.heading is None or options.time is None:
        for note in resolved.notes:
            print(f"sunwidget: {note}", file=sys.stderr)
    place, match = resolved.with_heading(scene)
    if match is not None:
        print(f"sunwidget: Heading {place.heading:.1f}°. {match.note}", file=sys.stderr)
    return place


def refuse_unplaced(options: argparse.Namespace, photo: Photo) -> None:
    """Fail before the analysis if a required field of the place is missing."""
    if is_placed(options) or _whole_day(options):
        recipe = None if options.recipe is None else read_recipe(options.recipe)
        _resolved(options, photo, recipe.place if recipe else None)


def _resolved(options: argparse.Namespace, photo: Photo, place: Place | None) -> ResolvedPlace:
    from sunwidget.analysis.place_resolver import resolve_place

    latitude, longitude = options.coordinates or (None, None)
    return resolve_place(
        photo,
        _REMEDIES,
        given={"latitude": latitude, "longitude": longitude, "heading": options.heading},
        place=place,
        moved_to={"date": options.date, "time": options.time},
        whole_day=_whole_day(options),
    )


def _whole_day(options: argparse.Namespace) -> bool:
    return bool(getattr(options, "day", False))


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
    try:
        return clock_hours(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not a time of day in UTC as 17:30") from None


def _heading(text: str) -> float:
    try:
        heading = Place(0, 0, "2000-01-01", 0, float(text)).heading
    except ValueError:
        heading = None
    if heading is None:
        raise argparse.ArgumentTypeError(f"{text!r} is not a heading from 0 to 360 degrees")
    return heading
