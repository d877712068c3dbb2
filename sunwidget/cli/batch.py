"""The command line's many photos: ``sunwidget batch``."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from sunwidget.batches.request import Wish
from sunwidget.cli.edit_options import add_edit, add_headroom, recipe, told_unmoved
from sunwidget.cli.photo_options import Progress, add_methods, given, methods_of_stages
from sunwidget.edit.table import PARAMETERS, Edit


def add_batch(commands: Any) -> None:
    """Add the command ``batch`` to a parser's commands."""
    batch = commands.add_parser(
        "batch",
        help="many photos with one recipe, on all cores or on many machines",
        description="A photo that fails is reported and the rest is done; exit status 1 then. The "
        "same command goes on where an interrupted one stopped.",
    )
    batch.add_argument(
        "photos", nargs="+", help="files, folders, or patterns in quotes: 'photos/**/*.jpg'"
    )
    batch.add_argument(
        "-o", "--output", type=Path, required=True, help="folder for the pictures; made if missing"
    )
    batch.add_argument(
        "--format", metavar="ENDING", help="png, jpg, tif … (default: the photo's own)"
    )
    batch.add_argument(
        "--name",
        default="{name}-sun",
        metavar="TEMPLATE",
        help="of a picture, from {name}, {folder}, {number}, {ending} (default {name}-sun)",
    )
    batch.add_argument("--long-edge", type=int, metavar="N", help="most pixels on the longer side")
    batch.add_argument(
        "--quality", type=int, metavar="N", help="of JPEG and WebP, 1 to 100 (default 95)"
    )
    batch.add_argument("--bit-depth", type=int, choices=(8, 16, 32), help="bits a channel")
    add_headroom(batch)
    batch.add_argument("--layers", action="store_true", help="also sky, clouds, land and matte")
    batch.add_argument(
        "--corrections",
        action="store_true",
        help="apply the recipe's strokes and hints too: for a series of one fixed camera",
    )
    batch.add_argument(
        "--overwrite", action="store_true", help="replace files that this command did not make"
    )
    batch.add_argument(
        "--no-resume", action="store_true", help="make pictures again that are there already"
    )
    batch.add_argument("--csv", type=Path, metavar="FILE", help="write the table there as well")
    where = batch.add_argument_group("who does it (Dask: pip install 'sunwidget[batch]')")
    where.add_argument(
        "--workers",
        type=int,
        metavar="N",
        help="processes on this machine; 0: one photo after another (default: one for each core)",
    )
    where.add_argument(
        "--scheduler", metavar="ADDRESS", help="of a running Dask scheduler, as tcp://host:8786"
    )
    where.add_argument(
        "--retries",
        type=int,
        default=2,
        metavar="N",
        help="how often a photo is tried again when its worker dies (default 2)",
    )
    batch.add_argument("--fov", type=float, metavar="DEG", help="vertical field of view of all")
    add_methods(batch)
    add_edit(batch)
    batch.set_defaults(run=_batch)


def _batch(options: argparse.Namespace) -> int:
    import sunwidget as sw
    from sunwidget.batches.report import is_table
    from sunwidget.files import target

    replaced = options.overwrite or (options.csv is not None and is_table(options.csv))
    if options.csv is not None:
        target(options.csv, overwrite=replaced)
    wish = Wish(recipe(options), options.preset, given(options, (p.name for p in PARAMETERS)))
    told_unmoved(moved=wish != Wish(Edit()))
    saving = given(options, ("quality", "bit_depth"))
    if options.layers:
        saving["layers"] = True
    if options.headroom:
        saving["headroom"] = options.headroom
    with Progress("batch") as progress:
        report = sw.batch(
            options.photos,
            wish,
            options.output,
            scheduler=options.scheduler,
            workers=options.workers,
            analysis=given(options, ("fov", *methods_of_stages())),
            format=options.format,
            name=options.name,
            long_edge=options.long_edge,
            corrections=options.corrections,
            overwrite=options.overwrite,
            resume=not options.no_resume,
            retries=options.retries,
            progress=progress,
            **saving,
        )
    print(report)
    if options.csv is not None:
        report.to_csv(options.csv, overwrite=replaced)
    return 1 if report.failed else 0
