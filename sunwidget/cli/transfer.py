"""The commands ``sunwidget replace-sky`` and ``sunwidget transfer-look``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from sunwidget.cli.photo_options import Progress, open_picture, refuse_existing

_PICTURE = "picture file, or sample:NAME for a bundled one"


def add_transfer(commands: Any) -> None:
    """Add both commands."""
    sky = commands.add_parser("replace-sky", help="put the sky of another photo into a photo")
    _add_files(sky)
    sky.add_argument(
        "--sky", required=True, metavar="DONOR", help=f"photo with the sky: {_PICTURE}"
    )
    sky.add_argument("--turn", type=float, default=0.0, metavar="DEG", help="turn the new sky")
    sky.set_defaults(run=_replace_sky)

    look = commands.add_parser(
        "transfer-look",
        help="apply the change between two pictures to a photo",
        description="BEFORE and AFTER must show the same view, pixel by pixel.",
    )
    _add_files(look)
    look.add_argument("--before", required=True, help=_PICTURE)
    look.add_argument("--after", required=True, help=_PICTURE)
    look.set_defaults(run=_transfer_look)


def _add_files(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("photo", help=_PICTURE)
    parser.add_argument("-o", "--output", type=Path, required=True, help=".png, .jpg, .tif …")
    parser.add_argument("--overwrite", action="store_true", help="replace existing files")
    parser.add_argument(
        "--strength", type=float, default=1.0, metavar="N", help="0 to 1 (default 1)"
    )


def _replace_sky(options: argparse.Namespace) -> int:
    import sunwidget as sw

    refuse_existing(options.output, options.overwrite)
    photo, donor = open_picture(options.photo), open_picture(options.sky)
    with Progress("sky") as progress:
        out = sw.replace_sky(
            photo, donor, turn=options.turn, strength=options.strength, progress=progress
        )
    print(sw.save(out, options.output, overwrite=options.overwrite))
    return 0


def _transfer_look(options: argparse.Namespace) -> int:
    import sunwidget as sw

    refuse_existing(options.output, options.overwrite)
    photo, before, after = (open_picture(p) for p in (options.photo, options.before, options.after))
    with Progress("look") as progress:
        out = sw.transfer_look(photo, before, after, strength=options.strength, progress=progress)
    print(sw.save(out, options.output, overwrite=options.overwrite))
    return 0
