"""The command line's films: the flags that ``sweep`` and ``timelapse`` have in common."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any

from sunwidget.cli.edit_options import size
from sunwidget.film.path import EASINGS

STEPS = "recipe files or presets that the film passes through"
_OPTIONS = ("fps", "size", "easing", "loop", "quality", "overwrite")


def add_film(parser: argparse.ArgumentParser, loops: Sequence[str]) -> None:
    """Add the flags that say how a film is made; ``loops`` are what --loop may be."""
    parser.add_argument("--fps", type=float, default=24, help="frames a second (default 24)")
    parser.add_argument(
        "--size", type=size, metavar="WxH", help="pixels (default: ≤ 1920 a side, GIF ≤ 720)"
    )
    parser.add_argument(
        "--easing",
        choices=tuple(EASINGS),
        default="linear",
        help="how the sun starts and stops at each step",
    )
    parser.add_argument("--loop", choices=loops, default="forever", help="of GIF and WebP")
    parser.add_argument(
        "--quality", type=int, default=85, help="of MP4 and WebP, 1 to 100 (default 85)"
    )


def add_steps(group: Any, text: str = STEPS) -> None:
    """Add --steps to a parser or a group of flags that exclude one another."""
    group.add_argument("--steps", "--recipes", nargs="+", metavar="STEP", help=text)


def film_options(options: argparse.Namespace) -> dict[str, Any]:
    """Return what ``sweep`` and ``timelapse`` are to be called with, of those flags."""
    return {name: getattr(options, name) for name in _OPTIONS}
