"""The command ``sunwidget sweep``, which writes films of one photo."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sunwidget import presets
from sunwidget.cli.edit_options import add_edit, add_number, edit_of_flags, edit_of_scene
from sunwidget.cli.film_options import add_film, add_steps, film_options
from sunwidget.cli.photo_options import Progress, add_photo, refuse_existing, scene_to_draw
from sunwidget.cli.place_options import add_place, is_placed, place_of
from sunwidget.edit.table import NUMBERS, Edit, parameter
from sunwidget.errors import EditError
from sunwidget.export.formats import check_format, check_quality
from sunwidget.film.path import (
    DEFAULT_SECONDS,
    Day,
    SunPath,
    check_rate,
    frame_count,
    named_edit,
    step,
)
from sunwidget.film.writer import LOOPS, film_size, is_sequence, sequence_target
from sunwidget.film.writer import writer as check_film

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene


def add_sweep(commands: Any) -> None:
    """Add the command ``sweep`` to a parser's commands."""
    sweep = commands.add_parser(
        "sweep",
        help="write a film of the sun moving",
        description="The parameter flags set the first frame, the --to-… flags the last one. "
        "Instead of --to-…, use --steps, --key-frame, --to-time or --day.",
    )
    add_photo(sweep)
    sweep.add_argument(
        "-o", "--output", type=Path, help=".mp4, .gif, .webp, or frames/%%04d.png for single images"
    )
    sweep.add_argument(
        "--sheet",
        type=Path,
        metavar="FILE",
        help="write twelve frames as one picture; -o may be left out",
    )
    add_film(sweep, LOOPS)
    length = sweep.add_mutually_exclusive_group()
    length.add_argument("--frames", type=int, help="number of frames")
    length.add_argument(
        "--seconds", type=float, help="length (default: the time of the last key frame, else 5)"
    )
    way = sweep.add_mutually_exclusive_group()
    add_steps(way)
    way.add_argument(
        "--key-frame",
        type=_key_frame,
        action="append",
        metavar="SECONDS:NAME=N,…",
        help="parameters at that second, as in 2.5:sun_elevation=3,exposure=1, or a preset, as in "
        "4:sunset; repeat the flag for each key frame",
    )
    way.add_argument("--day", action="store_true", help="from civil dawn to civil dusk")
    add_place(sweep, end=True)
    add_edit(sweep)
    end = sweep.add_argument_group("end of the film")
    for p in NUMBERS:
        add_number(end, p, "to_")
    sweep.set_defaults(run=_sweep)


def _sweep(options: argparse.Namespace) -> int:
    import sunwidget as sw

    start = edit_of_flags(options)
    _check(options, start)
    scene = scene_to_draw(options)
    path = _path(options, scene, edit_of_scene(options, scene, start))
    if options.output is not None:
        with Progress("film") as progress:
            made = sw.sweep(
                scene,
                path,
                options.output,
                frames=options.frames,
                seconds=options.seconds,
                progress=progress,
                **film_options(options),
            )
        print(made)
    if options.sheet is not None:
        with Progress("sheet") as progress:
            sw.contact_sheet(
                scene,
                path,
                options.sheet,
                easing=options.easing,
                overwrite=options.overwrite,
                progress=progress,
            )
        print(options.sheet)
    return 0


def _check(options: argparse.Namespace, start: Edit) -> None:
    """Report errors in the flags before the photo is analyzed."""
    if options.output is None and options.sheet is None:
        raise ValueError("Nothing to write. Add -o FILE, --sheet FILE or both.")
    if options.output is not None:
        check_film(options.output)
        if is_sequence(options.output):
            sequence_target(options.output, overwrite=options.overwrite)
        else:
            refuse_existing(options.output, options.overwrite)
        check_rate(options.fps)
        frame_count(options.fps, options.frames, options.seconds, DEFAULT_SECONDS)
        check_quality(options.quality)
        film_size((2, 2), options.size)
    if options.sheet is not None:
        refuse_existing(options.sheet, options.overwrite)
        check_format(options.sheet)
    ends = [p.name for p in NUMBERS if getattr(options, f"to_{p.name}") is not None]
    stations = bool(options.steps or options.key_frame)
    for what in [*(options.steps or ()), *(what for _, what in options.key_frame or ())]:
        if isinstance(what, dict):
            start.replace(**what)
        elif what not in presets.NAMES:
            named_edit(what)
    if stations and (ends or options.to_time is not None):
        way = "--steps" if options.steps else "--key-frame"
        raise ValueError(f"{way} and --to-… both set the film's end. Leave one of them out.")
    clock = options.day or options.to_time is not None
    suns = ("sun_azimuth", "sun_elevation")
    if clock and any(getattr(options, name) is not None or name in ends for name in suns):
        raise ValueError("The clock moves the sun. Leave out --sun-… and --to-sun-….")
    if not (stations or clock or options.preset is not None):
        _refuse_equal(start, edit_of_flags(options, "to_", start))


def _path(options: argparse.Namespace, scene: Scene, start: Edit) -> SunPath:
    if options.steps:
        steps = [step(scene, what, start) for what in options.steps]
        return [(float(i), edit_of_flags(options, start=edit)) for i, edit in enumerate(steps)]
    if options.key_frame:
        return [(seconds, _key_edit(scene, what, start)) for seconds, what in options.key_frame]
    end = edit_of_flags(options, "to_", start)
    if options.day or options.to_time is not None:
        place = start.place if is_placed(options) else place_of(options, scene, start)
        assert place is not None
        own = options.time if options.day else place.time
        return Day(place, own, options.to_time, start, end)
    _refuse_equal(start, end)
    return [start, end]


def _key_edit(scene: Scene, what: str | dict[str, float], start: Edit) -> Edit:
    return start.replace(**what) if isinstance(what, dict) else step(scene, what, start)


def _refuse_equal(start: Edit, end: Edit) -> None:
    if start == end:
        raise ValueError("Nothing moves. Set an end, for example --to-sun-elevation -4.")


def _key_frame(text: str) -> tuple[float, str | dict[str, float]]:
    seconds, _, what = text.partition(":")
    try:
        at = float(seconds)
        if what and "=" not in what:
            return at, what
        values = {}
        for pair in what.split(","):
            name, equals, value = pair.partition("=")
            if not equals:
                raise ValueError
            row = parameter(name.strip().lstrip("-").replace("-", "_"))
            if row.kind != "number":
                raise EditError(f"{row.name} is not a number, so it cannot change gradually.")
            values[row.name] = float(value)
    except EditError as error:
        raise argparse.ArgumentTypeError(str(error)) from error
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"{text!r} is not of the form 2.5:sun_elevation=3,exposure=1"
        ) from None
    return at, values
