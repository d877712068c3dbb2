"""The command line: ``sunwidget render | sweep | html | analyze | replace-sky | …``.

Every parameter flag comes from the one table in ``edit.py``. Errors are one line on
stderr and exit status 2, without a traceback (``--debug`` shows it).
"""

from __future__ import annotations

import argparse
import re
import sys
import time
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn

from sunwidget import presets
from sunwidget.cli_photo import (
    Progress,
    add_methods,
    add_photo,
    flag,
    refuse_existing,
    scene_of,
)
from sunwidget.cli_place import add_place, is_placed, placed, places_of_day
from sunwidget.cli_transfer import add_transfer
from sunwidget.edit import NUMBERS, PARAMETERS, Edit, EditError, Parameter


class _Parser(argparse.ArgumentParser):
    """An ArgumentParser whose errors are one line and whose flags are never guessed."""

    def __init__(self, **options: Any) -> None:
        super().__init__(allow_abbrev=False, **options)
        # A sun left of the picture, --sun -300,200, is a value and no flag.
        self._negative_number_matcher = re.compile(r"-\d[\d.,e+-]*$", re.IGNORECASE)
        self.add_argument(
            "--debug", action="store_true", default=argparse.SUPPRESS, help="show an error's stack"
        )

    def error(self, message: str) -> NoReturn:
        self.exit(2, f"{self.prog}: {message}\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    parser = _parser()
    options = parser.parse_args(arguments)
    try:
        with warnings.catch_warnings():
            warnings.showwarning = _one_line_warning
            result: int = options.run(options)
    except KeyboardInterrupt:
        print("sunwidget: stopped; nothing half-written was left.", file=sys.stderr)
        return 130
    except Exception as error:  # a person at a prompt wants the sentence, not the stack
        if "debug" in options:
            raise
        sentence = " ".join(str(error).split()) or type(error).__name__
        print(f"sunwidget: {sentence}", file=sys.stderr)
        return 2
    return result


def _parser() -> argparse.ArgumentParser:
    import sunwidget

    parser = _Parser(prog="sunwidget", description="Move the sun in a photograph.")
    parser.add_argument("--version", action="version", version=sunwidget.__version__)
    commands = parser.add_subparsers(metavar="COMMAND", required=True)

    render = commands.add_parser("render", help="write the photo with its sun moved")
    add_photo(render)
    render.add_argument("-o", "--output", type=Path, required=True, help=".png, .jpg, .tif …")
    render.add_argument("--size", type=_size, metavar="WxH", help="pixels (default: the photo's)")
    add_place(render)
    _add_edit(render)
    render.set_defaults(run=_render)

    sweep = commands.add_parser(
        "sweep",
        help="write a film of the sun moving",
        description="The parameter flags set the first frame, the --to-… flags the last.",
    )
    add_photo(sweep)
    sweep.add_argument("-o", "--output", type=Path, required=True, help=".mp4, .gif or .webp")
    sweep.add_argument("--size", type=_size, metavar="WxH", help="pixels (default: ≤ 1920 a side)")
    sweep.add_argument("--fps", type=float, default=24, help="frames a second (default 24)")
    sweep.add_argument("--frames", type=int, help="number of frames (default: 5 seconds)")
    add_place(sweep, end=True)
    _add_edit(sweep)
    end = sweep.add_argument_group("end of the film")
    for p in NUMBERS:
        _add_number(end, p, "to_")
    sweep.set_defaults(run=_sweep)

    page = commands.add_parser(
        "html", help="write a page in which the sun can be moved, without kernel or network"
    )
    add_photo(page)
    page.add_argument("-o", "--output", type=Path, required=True, help=".html")
    page.add_argument("--title", help="of the page (default: the photo's name)")
    add_place(page)
    _add_edit(page)
    page.set_defaults(run=_html)

    analyze = commands.add_parser("analyze", help="write every map of a photo and scene.json")
    add_photo(analyze)
    analyze.add_argument("-o", "--output", type=Path, required=True, help="folder for the maps")
    add_methods(analyze)
    analyze.set_defaults(run=_analyze)

    add_transfer(commands)

    doctor = commands.add_parser("doctor", help="what was found on this machine, what is missing")
    doctor.set_defaults(run=_doctor)

    demo = commands.add_parser("demo", help="maps, a still and a sunset film of a bundled photo")
    demo.add_argument("-o", "--output", type=Path, default=Path("sunwidget-demo"), help="folder")
    demo.set_defaults(run=_demo)
    return parser


def _add_edit(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--recipe", type=Path, help="JSON recipe; flags win over it")
    parser.add_argument(
        "--preset",
        metavar="NAME",
        type=_preset,
        help=f"time of day: {', '.join(presets.NAMES)}; wins over the recipe, flags win over it",
    )
    group = parser.add_argument_group("parameters")
    for p in PARAMETERS:
        if p.kind == "number":
            _add_number(group, p, "")
        elif p.kind == "choice":
            group.add_argument(flag(p.name), choices=p.choices, help=_percent_safe(p.help))


def _add_number(group: Any, p: Parameter, prefix: str) -> None:
    unit = f" {p.unit}" if p.unit else ""
    default = "from the photo" if p.default is None else f"{p.default:g}"
    text = f"{p.help} {p.minimum:g} to {p.maximum:g}{unit}, default {default}."
    group.add_argument(
        flag(prefix + p.name),
        type=float,
        metavar="N",
        help=argparse.SUPPRESS if prefix else _percent_safe(text),
    )


def _percent_safe(text: str) -> str:
    return text.replace("%", "%%")


def _size(text: str) -> tuple[int, int]:
    width, separator, height = text.lower().partition("x")
    if not (separator and width.isdecimal() and height.isdecimal()):
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form 1920x1080")
    return int(width), int(height)


def _preset(text: str) -> str:
    try:
        return presets.find(text).name
    except EditError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def _recipe(options: argparse.Namespace) -> Edit:
    if options.recipe is None:
        return Edit()
    return Edit.from_json(options.recipe.read_text("utf-8"))


def _edit(options: argparse.Namespace, prefix: str = "", start: Edit | None = None) -> Edit:
    """Return ``start``, or the recipe, with the flags that were given, the flags winning."""
    start = _recipe(options) if start is None else start
    given = {p.name: getattr(options, prefix + p.name, None) for p in PARAMETERS}
    return start.replace(**{name: value for name, value in given.items() if value is not None})


def _render(options: argparse.Namespace) -> int:
    import sunwidget as sw

    edit = _edit(options)  # what is wrong with it shows before the work
    refuse_existing(options.output, options.overwrite)
    scene = scene_of(options)
    edit = _edit_of_scene(options, scene, edit)
    begin = time.perf_counter()
    if options.size is None:
        sw.save((scene, edit), options.output, overwrite=options.overwrite)
    else:
        picture = sw.render(scene, edit, size=options.size)
        sw.save(picture, options.output, like=scene, overwrite=options.overwrite)
    print(f"{options.output}  ({time.perf_counter() - begin:.1f} s)")
    return 0


def _html(options: argparse.Namespace) -> int:
    import sunwidget as sw

    edit = _edit(options)
    refuse_existing(options.output, options.overwrite)
    scene = scene_of(options)
    edit = _edit_of_scene(options, scene, edit)
    sw.to_html(scene, edit, options.output, title=options.title, overwrite=options.overwrite)
    print(f"{options.output}  ({options.output.stat().st_size / 1e6:.1f} MB)")
    return 0


def _edit_of_scene(options: argparse.Namespace, scene: Any, edit: Edit) -> Edit:
    """Return ``edit`` with a preset or a clock, which look at the photo; the flags win."""
    if options.preset is not None:
        edit = _edit(options, start=presets.edit(options.preset, scene, _recipe(options)))
    if is_placed(options):
        edit = _edit(options, start=placed(options, scene, edit))
    return edit


def _sweep(options: argparse.Namespace) -> int:
    import sunwidget as sw

    start = _edit(options)
    moves = options.preset is not None or options.to_time is not None
    if start == _edit(options, "to_", start) and not moves:
        raise ValueError("Nothing moves: name an end, for example --to-sun-elevation -4.")
    refuse_existing(options.output, options.overwrite)
    scene = scene_of(options)
    start = _edit_of_scene(options, scene, start)
    end = _edit(options, "to_", start)
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
        row.append(_edit(options, start=edit.at(place)))
    return row


def _analyze(options: argparse.Namespace) -> int:
    from sunwidget.export.maps import save_maps

    scene = scene_of(options)
    for path in save_maps(scene, options.output, overwrite=options.overwrite):
        print(path)
    return 0


def _doctor(_options: argparse.Namespace) -> int:
    from sunwidget.doctor import findings, print_report

    return 0 if print_report(findings()) else 1


def _demo(options: argparse.Namespace) -> int:
    from sunwidget.demo import demo

    with Progress("demo") as progress:
        paths = demo(options.output, progress)
    for path, what in paths:
        print(f"{path}  {what}")
    return 0


def _one_line_warning(message: Warning | str, *_rest: Any, **_more: Any) -> None:
    print(f"sunwidget: {message}", file=sys.stderr)
