"""The command ``sunwidget batch``, which edits many photos."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from sunwidget.batches.request import Request
from sunwidget.cli.edit_options import add_edit, add_headroom, recipe, warn_if_unmoved
from sunwidget.cli.photo_options import Progress, add_methods, methods_of_stages, pick_given
from sunwidget.edit.table import PARAMETERS, Edit


def add_batch(commands: Any) -> None:
    """Add the command ``batch`` to a parser's commands."""
    batch = commands.add_parser(
        "batch",
        help="edit many photos with one recipe, on all cores or on many machines",
        description="A photo that fails is reported and the others are still written; the exit "
        "status is then 1. Repeat an interrupted command to resume it.",
    )
    batch.add_argument(
        "photos", nargs="+", help="files, folders, or quoted patterns: 'photos/**/*.jpg'"
    )
    batch.add_argument(
        "-o", "--output", type=Path, required=True, help="output folder; created if missing"
    )
    batch.add_argument(
        "--format", metavar="ENDING", help="png, jpg, tif … (default: the photo's own)"
    )
    batch.add_argument(
        "--name",
        default="{name}-sun",
        metavar="TEMPLATE",
        help="file name, from {name}, {folder}, {number}, {ending} (default {name}-sun)",
    )
    batch.add_argument("--long-edge", type=int, metavar="N", help="limit of the longer side")
    batch.add_argument(
        "--quality", type=int, metavar="N", help="for JPEG and WebP, 1 to 100 (default 95)"
    )
    batch.add_argument("--bit-depth", type=int, choices=(8, 16, 32), help="bits per channel")
    add_headroom(batch)
    batch.add_argument("--layers", action="store_true", help="also write sky, clouds, land, matte")
    batch.add_argument(
        "--corrections",
        action="store_true",
        help="also apply the recipe's strokes and hints, for a series from one fixed camera",
    )
    batch.add_argument("--overwrite", action="store_true", help="replace files that no batch wrote")
    batch.add_argument(
        "--no-resume", action="store_true", help="write pictures again that an earlier run finished"
    )
    batch.add_argument("--csv", type=Path, metavar="FILE", help="also write the table to this file")
    where = batch.add_argument_group("workers (Dask: pip install 'sunwidget[batch]')")
    where.add_argument(
        "--workers",
        type=int,
        metavar="N",
        help="processes on this machine (default: one per core); 0: one photo after another",
    )
    where.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="address of a running Dask scheduler, such as tcp://host:8786",
    )
    where.add_argument(
        "--retries",
        type=int,
        default=2,
        metavar="N",
        help="further attempts at a photo whose worker dies (default 2)",
    )
    batch.add_argument(
        "--fov", type=float, metavar="DEG", help="vertical field of view of all photos"
    )
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
    request = Request(
        recipe(options), options.preset, pick_given(options, (p.name for p in PARAMETERS))
    )
    warn_if_unmoved(moved=request != Request(Edit()))
    saving = pick_given(options, ("quality", "bit_depth"))
    if options.layers:
        saving["layers"] = True
    if options.headroom:
        saving["headroom"] = options.headroom
    with Progress("batch") as progress:
        report = sw.batch(
            options.photos,
            request,
            options.output,
            scheduler=options.scheduler,
            workers=options.workers,
            analysis=pick_given(options, ("fov", *methods_of_stages())),
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
