"""The command line's sky for 3D: ``sunwidget dome``."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sunwidget.cli.edit_options import add_edit, edit_of_flags, edit_of_scene
from sunwidget.cli.ending import one_line
from sunwidget.cli.photo_options import add_photo, given, opened, refuse_existing, scene_to_draw
from sunwidget.cli.place_options import add_place, is_placed, place_of

if TYPE_CHECKING:
    from sunwidget.edit.table import Edit
    from sunwidget.photo.photo import Photo

_LENS = ("horizon", "fov", "sky_label", "preset")


def add_dome(commands: Any) -> None:
    """Add the command ``dome`` to a parser's commands."""
    dome = commands.add_parser(
        "dome",
        help="write the sky all the way round, as light for 3D, and its sun as .json",
        description="Of a photo: its sky all the way round. Of an environment map (.hdr or .exr, "
        "twice as wide as high): the same map with its sun elsewhere.",
    )
    add_photo(dome)
    dome.add_argument("-o", "--output", type=Path, required=True, help=".exr or .hdr")
    dome.add_argument(
        "--width",
        type=int,
        metavar="N",
        help="pixels, twice the height (2048, or as wide as the environment map)",
    )
    dome.add_argument(
        "--no-sun", action="store_true", help="leave the disc out: the .json has it as a lamp"
    )
    add_place(dome)
    add_edit(dome)
    dome.set_defaults(run=_dome)


def _dome(options: argparse.Namespace) -> int:
    import sunwidget as sw
    from sunwidget.dome.source import is_dome
    from sunwidget.export.environment import check_map, checked_size

    edit = edit_of_flags(options)  # what is wrong with it shows before the work
    beside = options.output.with_suffix(".json")
    for path in (options.output, beside):
        refuse_existing(path, options.overwrite)
    check_map(options.output)
    if options.width is not None:
        checked_size((options.width, options.width // 2))
    photo = opened(options.photo)
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
    """Return the dome of an environment map, and its edit with the clock's sun."""
    import sunwidget as sw
    from sunwidget.export.dome.moved import check_edit

    if others := given(options, _LENS):
        flags = ", ".join("--" + name.replace("_", "-") for name in others)
        raise ValueError(
            f"{photo.name} is twice as wide as high, so it is taken for an environment map, and "
            f"{flags} is for photos."
        )
    if is_placed(options) and options.heading is None:
        raise ValueError(
            "Where the sun of an environment map goes follows from the clock only with --heading, "
            "where its middle column looks, degrees from north."
        )
    check_edit(edit)
    dome = sw.analyze_dome(photo, **given(options, ("sun", "sky")))
    for warning in dome.warnings:
        print(f"sunwidget: {one_line(warning)}", file=sys.stderr)
    azimuth, elevation = dome.sun
    print(f"sun of {photo.name}: azimuth {azimuth:.1f}°, elevation {elevation:.1f}°")
    if is_placed(options):
        edit = edit_of_flags(options, start=edit.at(place_of(options, dome, edit)))  # type: ignore[arg-type]
    return dome, edit
