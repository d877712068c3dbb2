"""The command line's sky for 3D: ``sunwidget dome``."""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import Any

from sunwidget.cli_edit import add_edit, edit_of_flags, edit_of_scene
from sunwidget.cli_photo import add_photo, refuse_existing, scene_to_draw
from sunwidget.cli_place import add_place


def add_dome(commands: Any) -> None:
    """Add the command ``dome`` to a parser's commands."""
    dome = commands.add_parser(
        "dome", help="write the sky all the way round, as light for 3D, and its sun as .json"
    )
    add_photo(dome)
    dome.add_argument("-o", "--output", type=Path, required=True, help=".exr or .hdr")
    dome.add_argument(
        "--width", type=int, default=2048, metavar="N", help="pixels, twice the height (2048)"
    )
    dome.add_argument(
        "--no-sun", action="store_true", help="leave the disc out: the .json has it as a lamp"
    )
    add_place(dome)
    add_edit(dome)
    dome.set_defaults(run=_dome)


def _dome(options: argparse.Namespace) -> int:
    import sunwidget as sw
    from sunwidget.export.environment import check_map, checked_size

    edit = edit_of_flags(options)  # what is wrong with it shows before the work
    beside = options.output.with_suffix(".json")
    for path in (options.output, beside):
        refuse_existing(path, options.overwrite)
    check_map(options.output)
    checked_size((options.width, options.width // 2))
    scene = scene_to_draw(options)
    edit = edit_of_scene(options, scene, edit)
    begin = time.perf_counter()
    sw.to_dome(
        scene,
        edit,
        options.output,
        width=options.width,
        sun=not options.no_sun,
        overwrite=options.overwrite,
    )
    print(f"{options.output}  ({time.perf_counter() - begin:.1f} s)")
    print(beside)
    return 0
