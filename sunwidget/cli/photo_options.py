"""Flags for a photo, its hints and its methods, and the scene that they describe."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, Self

from sunwidget.cli.ending import one_line
from sunwidget.cli.parser import Parser
from sunwidget.cli.place_options import refuse_unplaced
from sunwidget.edit.table import OUTSIDE
from sunwidget.progress import with_time_left

_HINTS = ("sun", "horizon", "fov", "sky", "sky_label")


def add_photo(parser: Parser) -> None:
    """Add the photo and the hints that override detection."""
    from sunwidget.analysis.segmentation import coarse_sky

    parser.several = "takes one photo."
    parser.add_argument("photo", help="picture file, or sample:NAME for a bundled one")
    parser.add_argument("--overwrite", action="store_true", help="replace existing files")
    hints = parser.add_argument_group("hints (override detection)")
    hints.add_argument(
        "--sun",
        type=_sun,
        metavar="X,Y",
        help="the photo's sun in pixels, or 'outside' when the sun is not in the picture",
    )
    hints.add_argument(
        "--horizon",
        type=_numbers(1, 4),
        metavar="ROW",
        help="row at the center of the picture, or X1,Y1,X2,Y2",
    )
    hints.add_argument("--fov", type=float, metavar="DEG", help="vertical field of view")
    hints.add_argument(
        "--sky",
        help=f"mask (white = sky), .onnx network, or a method: {', '.join(coarse_sky.METHODS)}",
    )
    hints.add_argument(
        "--sky-label",
        type=_label,
        metavar="CLASS",
        help="the network's class for sky: index from 0, or name (ADE20K: 2)",
    )


def methods_of_stages() -> dict[str, tuple[Sequence[str], str]]:
    """Return the method names and default of each stage with a choice, by ``analyze`` parameter."""
    import inspect

    from sunwidget.analysis import pipeline
    from sunwidget.analysis.analyze import analyze

    parameters = inspect.signature(analyze).parameters
    found: dict[str, tuple[Sequence[str], str]] = {}
    for stage, methods in pipeline.METHODS.items():
        # "sun" and "horizon" are hints, so their methods are sun_method and horizon_method.
        name = stage if f"{stage}_method" not in parameters else f"{stage}_method"
        if len(methods) > 1:
            found[name] = (tuple(methods), parameters[name].default or next(iter(methods)))
    return found


def add_methods(parser: argparse.ArgumentParser) -> None:
    """Add a flag for the method of every stage that has more than one."""
    group = parser.add_argument_group("methods of the stages")
    for name, (choices, default) in methods_of_stages().items():
        group.add_argument(
            flag(name),
            choices=choices,
            metavar="NAME",
            help=f"{', '.join(choices)} (default {default})",
        )


def flag(name: str) -> str:
    """Return the flag of a parameter: --sun-elevation for sun_elevation."""
    return "--" + name.replace("_", "-")


def pick_given(
    options: argparse.Namespace, names: Iterable[str], prefix: str = ""
) -> dict[str, Any]:
    """Return the values of the flags among ``names`` that the command line sets."""
    values = {name: getattr(options, prefix + name, None) for name in names}
    return {name: value for name, value in values.items() if value is not None}


def _label(text: str) -> int | str:
    return int(text) if text.isdecimal() else text


def _numbers(*counts: int) -> Callable[[str], tuple[float, ...]]:
    def parse(text: str) -> tuple[float, ...]:
        try:
            values = tuple(float(part) for part in text.split(","))
        except ValueError:
            values = ()
        if len(values) not in counts:
            wanted = " or ".join(str(n) for n in counts)
            raise argparse.ArgumentTypeError(f"{text!r} is not {wanted} comma-separated numbers")
        return values

    return parse


def _sun(text: str) -> tuple[float, ...] | str:
    return text if text == OUTSIDE else _numbers(2)(text)


def open_picture(name: str) -> Any:
    """Open a picture file, or a bundled sample as sample:NAME."""
    import sunwidget as sw

    prefix, _, sample = name.partition("sample:")
    return sw.sample(sample) if sample and not prefix else sw.open(name)


def refuse_existing(path: Path, overwrite: bool) -> None:
    """Raise FileExistsError before the work instead of after it."""
    from sunwidget.files import target

    if target(path, overwrite=True).exists() and not overwrite:
        raise FileExistsError(f"{path} exists already. Add --overwrite to replace it.")


def scene_to_draw(options: argparse.Namespace, photo: Any = None) -> Any:
    """Return ``scene_of``, after checking that this machine can render."""
    from sunwidget.renderer.gl_thread import require_renderer

    require_renderer()
    return scene_of(options, photo)


def scene_of(options: argparse.Namespace, photo: Any = None) -> Any:
    """Analyze the photo with the flags' hints and methods; print the scene's warnings."""
    import sunwidget as sw

    photo = open_picture(options.photo) if photo is None else photo
    refuse_unplaced(options, photo)
    hints = pick_given(options, (*_HINTS, *methods_of_stages()))
    if "horizon" in hints:
        hints["horizon"] = _horizon(hints["horizon"])
    if "sky" in hints:
        hints["sky"] = _sky(hints["sky"])
    with Progress("analysis") as progress:
        scene = sw.analyze(photo, progress=progress, **hints)
    for warning in scene.warnings:
        words = getattr(warning, "flags", warning)  # a Notice names flags as the remedy here
        print(f"sunwidget: {one_line(words)}", file=sys.stderr)
    return scene


def _horizon(values: tuple[float, ...]) -> Any:
    return values[0] if len(values) == 1 else (values[:2], values[2:])


def _sky(text: str) -> Any:
    """Return a mask as an array; keep a method's name or a network's path as text."""
    path = Path(text)
    if path.suffix.lower() == ".onnx" or not path.suffix:
        return text
    import numpy as np

    import sunwidget as sw

    return sw.open(path).preview(long_edge=2**31).astype(np.float32)[..., 1] / 255


class Progress:
    """A progress callback: one line with the time left on a terminal, nothing elsewhere."""

    def __init__(self, what: str) -> None:
        self.what = what
        self.shown = sys.stderr.isatty()
        self._report = with_time_left(self._show)

    def __enter__(self) -> Self:
        return self

    def __call__(self, fraction: float, message: str) -> None:
        """Show the progress."""
        self._report(fraction, message)

    def _show(self, fraction: float, message: str) -> None:
        if self.shown:
            print(f"\r\x1b[K{self.what} {fraction:4.0%} {message}", end="", file=sys.stderr)

    def __exit__(self, *_error: object) -> None:
        if self.shown:
            print("\r\x1b[K", end="", file=sys.stderr)
