"""Film flags that the commands ``sweep`` and ``timelapse`` share."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any

from sunwidget.cli.edit_options import size
from sunwidget.film.path import EASINGS

STEPS = "recipe files or presets that the film passes through"
_OPTIONS = ("fps", "size", "easing", "loop", "quality", "overwrite")


def add_film(parser: argparse.ArgumentParser, loops: Sequence[str]) -> None:
    """Add the flags for writing a film; ``loops`` are the choices of --loop."""
    parser.add_argument("--fps", type=float, default=24, help="frames per second (default 24)")
    parser.add_argument(
        "--size",
        type=size,
        metavar="WxH",
        help="pixels (default: at most 1920 per side, GIF 720)",
    )
    parser.add_argument(
        "--easing",
        choices=tuple(EASINGS),
        default="linear",
        help="how the sun speeds up and slows down at each step",
    )
    parser.add_argument("--loop", choices=loops, default="forever", help="for GIF and WebP")
    parser.add_argument(
        "--quality", type=int, default=85, help="for MP4 and WebP, 1 to 100 (default 85)"
    )


def add_steps(group: Any, text: str = STEPS) -> None:
    """Add --steps to a parser or a mutually exclusive group."""
    group.add_argument("--steps", "--recipes", nargs="+", metavar="STEP", help=text)


def film_options(options: argparse.Namespace) -> dict[str, Any]:
    """Return the keyword arguments of ``sweep`` and ``timelapse`` that these flags set."""
    return {name: getattr(options, name) for name in _OPTIONS}
