"""The command line: ``sunwidget render | sweep | analyze | doctor | demo``.

Every parameter flag comes from the one table in ``edit.py``. Errors are one line on
stderr and exit status 2, without a traceback (``--debug`` shows it).
"""

from __future__ import annotations

import argparse
import re
import sys
import time
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NoReturn, Self

from sunwidget.edit import NUMBERS, PARAMETERS, Edit, Parameter

_HINTS = ("sun", "horizon", "fov", "sky", "sky_label")


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
    _add_photo(render)
    render.add_argument("-o", "--output", type=Path, required=True, help=".png, .jpg, .tif …")
    render.add_argument("--size", type=_size, metavar="WxH", help="pixels (default: the photo's)")
    _add_edit(render)
    render.set_defaults(run=_render)

    sweep = commands.add_parser(
        "sweep",
        help="write a film of the sun moving",
        description="The parameter flags set the first frame, the --to-… flags the last.",
    )
    _add_photo(sweep)
    sweep.add_argument("-o", "--output", type=Path, required=True, help=".mp4, .gif or .webp")
    sweep.add_argument("--size", type=_size, metavar="WxH", help="pixels (default: ≤ 1920 a side)")
    sweep.add_argument("--fps", type=float, default=24, help="frames a second (default 24)")
    sweep.add_argument("--frames", type=int, help="number of frames (default: 5 seconds)")
    _add_edit(sweep)
    end = sweep.add_argument_group("end of the film")
    for p in NUMBERS:
        _add_number(end, p, "to_")
    sweep.set_defaults(run=_sweep)

    analyze = commands.add_parser("analyze", help="write every map of a photo and scene.json")
    _add_photo(analyze)
    analyze.add_argument("-o", "--output", type=Path, required=True, help="folder for the maps")
    _add_methods(analyze)
    analyze.set_defaults(run=_analyze)

    doctor = commands.add_parser("doctor", help="what was found on this machine, what is missing")
    doctor.set_defaults(run=_doctor)

    demo = commands.add_parser("demo", help="maps, a still and a sunset film of a bundled photo")
    demo.add_argument("-o", "--output", type=Path, default=Path("sunwidget-demo"), help="folder")
    demo.set_defaults(run=_demo)
    return parser


def _add_photo(parser: argparse.ArgumentParser) -> None:
    from sunwidget.analysis import sky

    parser.add_argument("photo", help="picture file, or sample:NAME for a bundled one")
    parser.add_argument("--overwrite", action="store_true", help="replace existing files")
    hints = parser.add_argument_group("hints (win over detection)")
    hints.add_argument("--sun", type=_numbers(2), metavar="X,Y", help="the photo's sun, in pixels")
    hints.add_argument(
        "--horizon",
        type=_numbers(1, 4),
        metavar="ROW",
        help="row at the centre, or X1,Y1,X2,Y2",
    )
    hints.add_argument("--fov", type=float, metavar="DEG", help="vertical field of view")
    hints.add_argument(
        "--sky",
        help=f"mask picture (white = sky), .onnx network, or a method: {', '.join(sky.METHODS)}",
    )
    hints.add_argument(
        "--sky-label",
        type=_label,
        metavar="CLASS",
        help="which class of that network is sky: index from 0, or name (ADE20K: 2)",
    )


def _methods() -> dict[str, tuple[Sequence[str], str]]:
    """Names and default of every stage with a choice, by the parameter of ``analyze``."""
    import inspect

    from sunwidget.analysis import stages
    from sunwidget.analysis.scene import analyze

    parameters = inspect.signature(analyze).parameters
    found: dict[str, tuple[Sequence[str], str]] = {}
    for stage, methods in stages.METHODS.items():
        # "sun" and "horizon" are hints: their methods have names of their own.
        name = stage if f"{stage}_method" not in parameters else f"{stage}_method"
        if len(methods) > 1:
            found[name] = (tuple(methods), parameters[name].default)
    return found


def _add_methods(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("methods of the stages")
    for name, (choices, default) in _methods().items():
        group.add_argument(
            _flag(name),
            choices=choices,
            metavar="NAME",
            help=f"{', '.join(choices)} (default {default})",
        )


def _add_edit(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--recipe", type=Path, help="JSON recipe; flags win over it")
    group = parser.add_argument_group("parameters")
    for p in PARAMETERS:
        if p.kind == "number":
            _add_number(group, p, "")
        elif p.kind == "choice":
            group.add_argument(_flag(p.name), choices=p.choices, help=_percent_safe(p.help))


def _add_number(group: Any, p: Parameter, prefix: str) -> None:
    unit = f" {p.unit}" if p.unit else ""
    default = "from the photo" if p.default is None else f"{p.default:g}"
    text = f"{p.help} {p.minimum:g} to {p.maximum:g}{unit}, default {default}."
    group.add_argument(
        _flag(prefix + p.name),
        type=float,
        metavar="N",
        help=argparse.SUPPRESS if prefix else _percent_safe(text),
    )


def _flag(name: str) -> str:
    return "--" + name.replace("_", "-")


def _percent_safe(text: str) -> str:
    return text.replace("%", "%%")


def _label(text: str) -> int | str:
    return int(text) if text.isdecimal() else text


def _size(text: str) -> tuple[int, int]:
    width, separator, height = text.lower().partition("x")
    if not (separator and width.isdecimal() and height.isdecimal()):
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form 1920x1080")
    return int(width), int(height)


def _numbers(*counts: int) -> Callable[[str], tuple[float, ...]]:
    def parse(text: str) -> tuple[float, ...]:
        try:
            values = tuple(float(part) for part in text.split(","))
        except ValueError:
            values = ()
        if len(values) not in counts:
            wanted = " or ".join(str(n) for n in counts)
            raise argparse.ArgumentTypeError(f"{text!r} is not {wanted} numbers joined by commas")
        return values

    return parse


def _edit(options: argparse.Namespace, prefix: str = "", start: Edit | None = None) -> Edit:
    """Return the Edit of a recipe and the flags that were given, the flags winning."""
    if start is None:
        start = Edit()
        if options.recipe is not None:
            start = Edit.from_json(options.recipe.read_text("utf-8"))
    given = {p.name: getattr(options, prefix + p.name, None) for p in PARAMETERS}
    return start.replace(**{name: value for name, value in given.items() if value is not None})


def _scene(options: argparse.Namespace) -> Any:
    import sunwidget as sw

    prefix, _, name = options.photo.partition("sample:")
    photo = sw.sample(name) if name and not prefix else sw.open(options.photo)
    named = (*_HINTS, *_methods())
    given = {name: getattr(options, name, None) for name in named}
    hints: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
    if "horizon" in hints:
        hints["horizon"] = _horizon(hints["horizon"])
    if "sky" in hints:
        hints["sky"] = _sky(hints["sky"])
    with _Progress("analysis") as progress:
        scene = sw.analyze(photo, progress=progress, **hints)
    for warning in scene.warnings:
        print(f"sunwidget: {warning}", file=sys.stderr)
    return scene


def _horizon(values: tuple[float, ...]) -> Any:
    return values[0] if len(values) == 1 else (values[:2], values[2:])


def _sky(text: str) -> Any:
    """Return a mask as an array; a method's name or a network's path stays text."""
    path = Path(text)
    if path.suffix.lower() == ".onnx" or not path.suffix:
        return text
    import numpy as np

    import sunwidget as sw

    return sw.open(path).preview(long_edge=2**31).astype(np.float32)[..., 1] / 255


def _render(options: argparse.Namespace) -> int:
    import sunwidget as sw

    edit = _edit(options)
    _refuse_existing(options.output, options.overwrite)
    scene = _scene(options)
    begin = time.perf_counter()
    if options.size is None:
        sw.save((scene, edit), options.output, overwrite=options.overwrite)
    else:
        picture = sw.render(scene, edit, size=options.size)
        sw.save(picture, options.output, like=scene, overwrite=options.overwrite)
    print(f"{options.output}  ({time.perf_counter() - begin:.1f} s)")
    return 0


def _sweep(options: argparse.Namespace) -> int:
    import sunwidget as sw

    start = _edit(options)
    end = _edit(options, "to_", start)
    if start == end:
        raise ValueError("Nothing moves: name an end, for example --to-sun-elevation -4.")
    _refuse_existing(options.output, options.overwrite)
    scene = _scene(options)
    with _Progress("film") as progress:
        sw.sweep(
            scene,
            [start, end],
            options.output,
            fps=options.fps,
            frames=options.frames,
            size=options.size,
            overwrite=options.overwrite,
            progress=progress,
        )
    print(options.output)
    return 0


def _analyze(options: argparse.Namespace) -> int:
    from sunwidget.export.maps import save_maps

    scene = _scene(options)
    for path in save_maps(scene, options.output, overwrite=options.overwrite):
        print(path)
    return 0


def _doctor(_options: argparse.Namespace) -> int:
    from sunwidget.doctor import findings, print_report

    return 0 if print_report(findings()) else 1


def _demo(options: argparse.Namespace) -> int:
    from sunwidget.demo import demo

    with _Progress("demo") as progress:
        paths = demo(options.output, progress)
    for path, what in paths:
        print(f"{path}  {what}")
    return 0


def _refuse_existing(path: Path, overwrite: bool) -> None:
    """Fail before the work, not after it."""
    from sunwidget.export.files import target

    if path.exists() and not overwrite:
        raise FileExistsError(f"{path} exists already. Add --overwrite to replace it.")
    target(path, overwrite=True)


def _one_line_warning(message: Warning | str, *_rest: Any, **_more: Any) -> None:
    print(f"sunwidget: {message}", file=sys.stderr)


class _Progress:
    """A progress callback that keeps one line on a terminal, and is silent elsewhere."""

    def __init__(self, what: str) -> None:
        self.what = what
        self.shown = sys.stderr.isatty()

    def __enter__(self) -> Self:
        return self

    def __call__(self, fraction: float, message: str) -> None:
        if self.shown:
            print(f"\r\x1b[K{self.what} {fraction:4.0%} {message}", end="", file=sys.stderr)

    def __exit__(self, *_error: object) -> None:
        if self.shown:
            print("\r\x1b[K", end="", file=sys.stderr)
