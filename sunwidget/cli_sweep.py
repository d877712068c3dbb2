"""The command line's films: ``sunwidget sweep``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from sunwidget.cli_edit import add_edit, add_number, edit_of_flags, edit_of_scene, size
from sunwidget.cli_photo import Progress, add_photo, refuse_existing, scene_of
from sunwidget.cli_place import add_place, places_of_day
from sunwidget.edit import NUMBERS, Edit


def add_sweep(commands: Any) -> None:
    """Add the command ``sweep`` to a parser's commands."""
    sweep = commands.add_parser(
        "sweep",
        help="write a film of the sun moving",
        description="The parameter flags set the first frame, the --to-… flags the last.",
    )
    add_photo(sweep)
    sweep.add_argument("-o", "--output", type=Path, required=True, help=".mp4, .gif or .webp")
    sweep.add_argument("--size", type=size, metavar="WxH", help="pixels (default: ≤ 1920 a side)")
    sweep.add_argument("--fps", type=float, default=24, help="frames a second (default 24)")
    sweep.add_argument("--frames", type=int, help="number of frames (default: 5 seconds)")
    add_place(sweep, end=True)
    add_edit(sweep)
    end = sweep.add_argument_group("end of the film")
    for p in NUMBERS:
        add_number(end, p, "to_")
    sweep.set_defaults(run=_sweep)


def _sweep(options: argparse.Namespace) -> int:
    import sunwidget as sw

    start = edit_of_flags(options)
    moves = options.preset is not None or options.to_time is not None
    if start == edit_of_flags(options, "to_", start) and not moves:
        raise ValueError("Nothing moves: name an end, for example --to-sun-elevation -4.")
    refuse_existing(options.output, options.overwrite)
    scene = scene_of(options)
    start = edit_of_scene(options, scene, start)
    end = edit_of_flags(options, "to_", start)
    edits = [start, end]
    if options.to_time is not None:
        edits = _day(options, scene, start, end)
    elif start == end:
        raise ValueError("Nothing moves: name an end, for example --to-sun-elevation -4.")
    with Progress("film") as progress:
        sw.sweep(
            scene,
            edits,
            options.output,
            fps=options.fps,
            frames=options.frames,
            size=options.size,
            overwrite=options.overwrite,
            progress=progress,
        )
    print(options.output)
    return 0


def _day(options: argparse.Namespace, scene: Any, start: Edit, end: Edit) -> list[Edit]:
    """Return an edit a frame: the sun on its path, all else on the straight way to the end."""
    from sunwidget.export.sweep import DEFAULT_SECONDS, between

    count = options.frames or max(3, round(DEFAULT_SECONDS * options.fps))
    row = []
    for i, place in enumerate(places_of_day(options, scene, start, count)):
        edit = between(start, end, i / (count - 1), scene.automatic)
        row.append(edit_of_flags(options, start=edit.at(place)))
    return row
