"""The command ``sunwidget timelapse``."""

from __future__ import annotations

import argparse
import contextlib
import datetime as dt
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from sunwidget.cli.edit_options import add_edit, edit_of_flags
from sunwidget.cli.film_options import STEPS, add_film, add_steps, film_options
from sunwidget.cli.photo_options import Progress, pick_given
from sunwidget.cli.place_options import coordinates
from sunwidget.edit.table import Edit
from sunwidget.geometry.place import Place
from sunwidget.timelapses.timelapse import BROKEN, LOOPS, FramesWarning


def add_timelapse(commands: Any) -> None:
    """Add the command ``timelapse`` to a parser's commands."""
    command = commands.add_parser(
        "timelapse",
        help="move the sun in every frame of a fixed camera's time-lapse",
        description="Pass the frames as a folder, a quoted glob, or two or more files. They are "
        "sorted in natural order (img2 before img10).",
    )
    command.add_argument("frames", nargs="+", help="folder, 'frames/*.jpg' or files")
    command.add_argument(
        "-o",
        "--output",
        type=Path,
        required=True,
        help=".mp4, .gif, .webp, frames/%%04d.png, or a folder for stills with their metadata",
    )
    command.add_argument("--overwrite", action="store_true", help="replace existing files")
    add_film(command, LOOPS)
    command.add_argument("--format", help="file extension of stills (default: the frames' own)")
    command.add_argument(
        "--broken",
        choices=BROKEN,
        default="hold",
        help="for an unreadable frame: repeat the one before it, leave it out, or stop",
    )
    add_steps(command, f"{STEPS}, instead of one edit")
    camera = command.add_argument_group("camera (default: from the files)")
    camera.add_argument(
        "--place",
        type=coordinates,
        metavar="LAT,LON",
        help="position, degrees north and east",
    )
    camera.add_argument(
        "--heading", type=float, metavar="DEG", help="viewing direction, clockwise from north"
    )
    camera.add_argument(
        "--times",
        metavar="PATTERN",
        help="pattern of the UTC time in the frames' names, such as %%Y%%m%%d_%%H%%M%%S",
    )
    camera.add_argument(
        "--start",
        type=_moment,
        metavar="TIME",
        help="UTC of the first frame: 2024-06-21T17:30",
    )
    camera.add_argument("--interval", type=float, metavar="SECONDS", help="time between frames")
    camera.add_argument("--sky", type=Path, help="mask image, white = sky")
    camera.add_argument("--horizon", type=float, metavar="ROW", help="row at the picture's center")
    camera.add_argument("--fov", type=float, metavar="DEG", help="vertical field of view")
    add_edit(command)
    command.set_defaults(run=_timelapse)


def _timelapse(options: argparse.Namespace) -> int:
    import sunwidget as sw

    edit = _edit(options)
    with _collect_frames_warnings() as lost, Progress("time-lapse") as progress:
        made = sw.timelapse(
            _frames(options.frames),
            edit,
            options.output,
            format=options.format,
            place=_camera(options),
            times=_times(options),
            broken=options.broken,
            progress=progress,
            **film_options(options),
            **pick_given(options, ("sky", "horizon", "fov")),
        )
    print(made)
    return _status(lost)


@contextlib.contextmanager
def _collect_frames_warnings() -> Iterator[list[FramesWarning]]:
    """Yield a list that collects every FramesWarning; each is still shown at once."""
    lost: list[FramesWarning] = []
    with warnings.catch_warnings():
        show = warnings.showwarning

        def note(message: Warning | str, *rest: Any, **more: Any) -> None:
            if isinstance(message, FramesWarning):
                lost.append(message)
            show(message, *rest, **more)

        warnings.showwarning = note
        yield lost


def _status(lost: list[FramesWarning]) -> int:
    """Return 1, with a message, when more than half of the frames could not be used."""
    for found in lost:
        if found.unusable > found.count / 2:
            print(
                f"sunwidget: Most frames ({found.unusable} of {found.count}) could not be used; "
                "the reasons are above.",
                file=sys.stderr,
            )
            return 1
    return 0


def _edit(options: argparse.Namespace) -> Any:
    edit = edit_of_flags(options)
    if options.steps:
        if edit != Edit() or options.preset is not None:
            raise ValueError("--steps sets the whole film. Leave out the other parameter flags.")
        if len(options.steps) < 2:
            raise ValueError("--steps needs two or more recipe files or presets.")
        return options.steps
    if options.preset is None:
        return edit
    if edit != Edit():
        raise ValueError("--preset excludes other parameters in a time-lapse. Use --recipe.")
    return options.preset


def _frames(names: list[str]) -> Any:
    """Return one folder or glob as it is; sort files that the shell listed in natural order."""
    from sunwidget.timelapses.frames import natural_key

    return names[0] if len(names) == 1 else sorted(map(Path, names), key=natural_key)


def _camera(options: argparse.Namespace) -> Place | None:
    if options.place is None:
        if options.heading is not None:
            raise ValueError("--heading needs --place LAT,LON.")
        return None
    # Each frame has its own day; this one is unused.
    latitude, longitude = options.place
    return Place(latitude, longitude, "2000-01-01", 0, options.heading)


def _times(options: argparse.Namespace) -> Any:
    if (options.start is None) != (options.interval is None):
        raise ValueError("--start and --interval go together.")
    if options.start is None:
        return options.times
    if options.times is not None:
        raise ValueError("--times and --start both set the times of the frames. Leave one out.")
    return options.start, options.interval


def _moment(text: str) -> dt.datetime:
    try:
        return dt.datetime.fromisoformat(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form 2024-06-21T17:30") from None
