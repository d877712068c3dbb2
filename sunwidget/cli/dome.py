"""The command ``sunwidget dome``, which writes skies for 3D programs."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sunwidget.cli.edit_options import add_edit, edit_of_flags, edit_of_scene
from sunwidget.cli.ending import one_line
from sunwidget.cli.photo_options import (
    add_photo,
    open_picture,
    pick_given,
    refuse_existing,
    scene_to_draw,
)
from sunwidget.cli.place_options import add_place, is_placed, place_of

if TYPE_CHECKING:
    from sunwidget.edit.table import Edit
    from sunwidget.photo.photo import Photo

_LENS = ("horizon", "fov", "sky_label", "preset")


def add_dome(commands: Any) -> None:
    """Add the command ``dome`` to a parser's commands."""
    dome = commands.add_parser(
        "dome",
        help="write the whole sky as an environment map for 3D, and its sun as .json",
        description="For a photo: write its sky, extended all the way round. For an environment "
        "map (.hdr or .exr, twice as wide as high): write the map with its sun moved.",
    )
    add_photo(dome)
    dome.add_argument("-o", "--output", type=Path, required=True, help=".exr or .hdr")
    dome.add_argument(
        "--width",
        type=int,
        metavar="N",
        help="in pixels, twice the height (default: 2048, or the environment map's own)",
    )
    dome.add_argument(
        "--no-sun",
        action="store_true",
        help="leave out the sun's disc: the .json has it as a lamp",
    )
    add_place(dome)
    add_edit(dome)
    dome.set_defaults(run=_dome)


def _dome(options: argparse.Namespace) -> int:
    import sunwidget as sw
    from sunwidget.dome.source import is_dome
    from sunwidget.export.environment import check_map, checked_size

    edit = edit_of_flags(options)  # report a bad edit before the analysis
    beside = options.output.with_suffix(".json")
    for path in (options.output, beside):
        refuse_existing(path, options.overwrite)
    check_map(options.output)
    if options.width is not None:
        checked_size((options.width, options.width // 2))
    photo = open_picture(options.photo)
    source: Any
    if is_dome(photo):
        source, edit = _environment(options, photo, edit)
    else:
        source = scene_to_draw(options, photo)
        edit = edit_of_scene(options, source, edit)
    begin = time.perf_counter()
    sw.to_dome(
        source,
        edit,
        options.output,
        width=options.width,
        sun=not options.no_sun,
        overwrite=options.overwrite,
    )
    print(f"{options.output}  ({time.perf_counter() - begin:.1f} s)")
    print(beside)
    return 0


def _environment(options: argparse.Namespace, photo: Photo, edit: Edit) -> tuple[Any, Edit]:
    """Return the dome of an environment map and the edit, its sun set by the clock if given."""
    import sunwidget as sw
    from sunwidget.export.dome.moved import check_edit

    if others := pick_given(options, _LENS):
        flags = ", ".join("--" + name.replace("_", "-") for name in others)
        raise ValueError(
            f"{photo.name} is twice as wide as high, so it is treated as an environment map. Leave "
            f"out {flags}, which is for photos."
        )
    if is_placed(options) and options.heading is None:
        raise ValueError(
            "To place the sun of an environment map by the clock, add --heading: the direction of "
            "its middle column, degrees from north."
        )
    check_edit(edit)
    dome = sw.analyze_dome(photo, **pick_given(options, ("sun", "sky")))
    for warning in dome.warnings:
        print(f"sunwidget: {one_line(warning)}", file=sys.stderr)
    azimuth, elevation = dome.sun
    print(f"sun of {photo.name}: azimuth {azimuth:.1f}°, elevation {elevation:.1f}°")
    if is_placed(options):
        edit = edit_of_flags(options, start=edit.at(place_of(options, dome, edit)))  # type: ignore[arg-type]
    return dome, edit
