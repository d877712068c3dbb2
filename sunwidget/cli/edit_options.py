"""Flags for an edit: one for every parameter, the recipe and the preset."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sunwidget import presets
from sunwidget.cli.photo_options import flag, pick_given
from sunwidget.cli.place_options import is_placed, place_sun
from sunwidget.edit.recipe import read_recipe
from sunwidget.edit.table import PARAMETERS, Edit, Parameter
from sunwidget.errors import EditError

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene


def add_edit(parser: argparse.ArgumentParser) -> None:
    """Add --recipe, --preset and a flag for every parameter."""
    parser.add_argument("--recipe", type=Path, help="JSON recipe; flags override it")
    parser.add_argument(
        "--preset",
        metavar="NAME",
        type=_preset,
        help=f"time of day: {', '.join(presets.NAMES)}; overrides the recipe, flags override it",
    )
    group = parser.add_argument_group("parameters")
    for p in PARAMETERS:
        if p.kind == "number":
            add_number(group, p, "")
        elif p.kind == "choice":
            group.add_argument(flag(p.name), choices=p.choices, help=_percent_safe(p.help))


def add_number(group: Any, p: Parameter, prefix: str) -> None:
    """Add the flag of a number; with a prefix (``to_``) it is hidden from the help."""
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


def size(text: str) -> tuple[int, int]:
    """Parse 1920x1080."""
    width, separator, height = text.lower().partition("x")
    if not (separator and width.isdecimal() and height.isdecimal()):
        raise argparse.ArgumentTypeError(f"{text!r} is not of the form 1920x1080")
    return int(width), int(height)


def _preset(text: str) -> str:
    try:
        return presets.find(text).name
    except EditError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def add_headroom(parser: argparse.ArgumentParser) -> None:
    """Add --headroom, for stills."""
    parser.add_argument(
        "--headroom",
        type=float,
        default=0.0,
        metavar="STOPS",
        help="stops of light above white to keep, 0 to 8: as a gain map in .jpg; in .exr, .hdr, "
        "32-bit .tif",
    )


def recipe(options: argparse.Namespace) -> Edit:
    """Return the edit of --recipe; without the flag, the default edit."""
    if options.recipe is None:
        return Edit()
    return read_recipe(options.recipe)


def edit_of_flags(options: argparse.Namespace, prefix: str = "", start: Edit | None = None) -> Edit:
    """Return ``start``, by default the recipe, with the values of the parameter flags."""
    start = recipe(options) if start is None else start
    return start.replace(**pick_given(options, (p.name for p in PARAMETERS), prefix))


def warn_if_unmoved(*, moved: bool) -> None:
    """Warn when the command line sets no edit, so that pictures are written unchanged."""
    if not moved:
        print(
            "sunwidget: Nothing moves, so the picture stays as it is. Add --sun-elevation 3, "
            "--preset sunset or --recipe FILE.",
            file=sys.stderr,
        )


def edit_of_scene(options: argparse.Namespace, scene: Scene, edit: Edit) -> Edit:
    """Return ``edit`` with the preset or clock, which depend on the photo; flags override both."""
    if options.preset is not None:
        edit = edit_of_flags(options, start=presets.edit(options.preset, scene, recipe(options)))
    if is_placed(options):
        edit = edit_of_flags(options, start=place_sun(options, scene, edit))
    return edit
