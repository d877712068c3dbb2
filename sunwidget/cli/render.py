"""The command ``sunwidget render``, which writes stills."""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import Any

from sunwidget.cli.edit_options import (
    add_edit,
    add_headroom,
    edit_of_flags,
    edit_of_scene,
    size,
    warn_if_unmoved,
)
from sunwidget.cli.photo_options import Progress, add_photo, refuse_existing, scene_to_draw
from sunwidget.cli.place_options import add_place
from sunwidget.edit.table import Edit
from sunwidget.progress import with_time_left


def add_render(commands: Any) -> None:
    """Add the command ``render`` to a parser's commands."""
    render = commands.add_parser("render", help="write the photo with its sun moved")
    add_photo(render)
    render.several = "takes one photo; for many: sunwidget batch PHOTO … -o FOLDER."
    render.add_argument(
        "-o",
        "--output",
        type=Path,
        required=True,
        help="output file: .png, .jpg, .tif, .webp; linear light: .exr, .hdr",
    )
    render.add_argument("--size", type=size, metavar="WxH", help="pixels (default: the photo's)")
    render.add_argument(
        "--bit-depth",
        type=int,
        choices=(8, 16, 32),
        help="bits per channel (default: the photo's); 32: floats in .tif and .exr",
    )
    render.add_argument(
        "--quality",
        type=int,
        choices=range(1, 101),
        default=95,
        metavar="N",
        help="for JPEG and WebP, 1 to 100 (default 95)",
    )
    add_headroom(render)
    render.add_argument(
        "--layers",
        action="store_true",
        help="also write sky, clouds, land and matte: in a .tif or .exr, beside a .png or .webp",
    )
    render.add_argument(
        "--environment",
        type=Path,
        metavar="FILE",
        help="also write the whole clear sky as an environment map (.hdr, .exr)",
    )
    add_place(render)
    add_edit(render)
    render.set_defaults(run=_render)


def _render(options: argparse.Namespace) -> int:
    import sunwidget as sw
    from sunwidget.export.environment import check_map
    from sunwidget.export.formats import check_format
    from sunwidget.renderer.offscreen import checked_headroom, checked_size

    edit = edit_of_flags(options)  # report a bad edit before the analysis
    refuse_existing(options.output, options.overwrite)
    headroom = checked_headroom(options.headroom)
    check_format(options.output, options.bit_depth, layers=options.layers, headroom=headroom)
    if options.size is not None:
        checked_size(options.size)
    if options.environment is not None:
        refuse_existing(options.environment, options.overwrite)
        check_map(options.environment)
    scene = scene_to_draw(options)
    edit = edit_of_scene(options, scene, edit)
    warn_if_unmoved(moved=edit != Edit())
    begin = time.perf_counter()
    with Progress("picture") as progress:
        sw.save(
            (scene, edit),
            options.output,
            size=options.size,
            bit_depth=options.bit_depth,
            quality=options.quality,
            layers=options.layers,
            headroom=headroom,
            overwrite=options.overwrite,
            progress=with_time_left(progress),
        )
    print(f"{options.output}  ({time.perf_counter() - begin:.1f} s)")
    if options.environment is not None:
        begin = time.perf_counter()
        sw.environment_map(scene, edit, options.environment, overwrite=options.overwrite)
        print(f"{options.environment}  ({time.perf_counter() - begin:.1f} s)")
    return 0
