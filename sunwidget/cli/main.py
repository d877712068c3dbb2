"""The command line: ``sunwidget render | sweep | html | analyze | replace-sky | …``.

Every parameter flag comes from the table in ``edit/table.py``. An error is one line on stderr,
without a traceback (``--debug`` shows it). Exit status: 2 after an error, 1 when part of the work
failed, 130 after Ctrl-C, 143 after SIGTERM.
"""

from __future__ import annotations

import argparse
import sys
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from sunwidget.cli.batch import add_batch
from sunwidget.cli.dome import add_dome
from sunwidget.cli.edit_options import add_edit, edit_of_flags, edit_of_scene
from sunwidget.cli.ending import (
    StoppedError,
    accept_any_file_name,
    discard_output,
    one_line,
    raise_on_signals,
)
from sunwidget.cli.parser import Parser
from sunwidget.cli.photo_options import Progress, add_methods, add_photo, refuse_existing, scene_of
from sunwidget.cli.place_options import add_place
from sunwidget.cli.render import add_render
from sunwidget.cli.sweep import add_sweep
from sunwidget.cli.timelapse import add_timelapse
from sunwidget.cli.transfer import add_transfer


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    parser = _parser()
    arguments = sys.argv[1:] if arguments is None else arguments
    if not arguments:
        parser.print_help(sys.stderr)
        return 2
    options = parser.parse_args(arguments)
    accept_any_file_name()
    try:
        with warnings.catch_warnings(), raise_on_signals():
            warnings.showwarning = _one_line_warning
            result: int = options.run(options)
    except (KeyboardInterrupt, StoppedError) as stop:
        print("sunwidget: stopped; no half-written file was left.", file=sys.stderr)
        return stop.status if isinstance(stop, StoppedError) else 130
    except BrokenPipeError:
        return discard_output()
    except Exception as error:  # at a prompt the message helps, the stack does not
        if "debug" in options:
            raise
        print(f"sunwidget: {one_line(error)}", file=sys.stderr)
        return 2
    return result


def _parser() -> argparse.ArgumentParser:
    import sunwidget

    parser = Parser(prog="sunwidget", description="Move the sun in a photograph.")
    parser.add_argument("--version", action="version", version=sunwidget.__version__)
    commands = parser.add_subparsers(metavar="COMMAND", required=True)

    add_render(commands)
    add_sweep(commands)
    add_timelapse(commands)
    add_batch(commands)

    add_dome(commands)

    page = commands.add_parser(
        "html", help="write a page in which the sun can be moved; needs no kernel or network"
    )
    add_photo(page)
    page.add_argument("-o", "--output", type=Path, required=True, help=".html")
    page.add_argument("--title", help="page title (default: the photo's name)")
    add_place(page)
    add_edit(page)
    page.set_defaults(run=_html)

    analyze = commands.add_parser("analyze", help="write every map of a photo and scene.json")
    add_photo(analyze)
    analyze.add_argument("-o", "--output", type=Path, required=True, help="folder for the maps")
    add_methods(analyze)
    analyze.set_defaults(run=_analyze)

    add_transfer(commands)

    doctor = commands.add_parser("doctor", help="report what this machine has and what is missing")
    doctor.set_defaults(run=_doctor)

    demo = commands.add_parser("demo", help="write maps, a still and a sunset film of a sample")
    demo.add_argument("-o", "--output", type=Path, default=Path("sunwidget-demo"), help="folder")
    demo.set_defaults(run=_demo)
    return parser


def _html(options: argparse.Namespace) -> int:
    import sunwidget as sw

    edit = edit_of_flags(options)
    refuse_existing(options.output, options.overwrite)
    scene = scene_of(options)
    edit = edit_of_scene(options, scene, edit)
    sw.to_html(scene, edit, options.output, title=options.title, overwrite=options.overwrite)
    print(f"{options.output}  ({options.output.stat().st_size / 1e6:.1f} MB)")
    return 0


def _analyze(options: argparse.Namespace) -> int:
    from sunwidget.export.maps import save_maps

    scene = scene_of(options)
    for path in save_maps(scene, options.output, overwrite=options.overwrite):
        print(path)
    return 0


def _doctor(_options: argparse.Namespace) -> int:
    from sunwidget.cli.doctor import findings, print_report

    return 0 if print_report(findings()) else 1


def _demo(options: argparse.Namespace) -> int:
    from sunwidget.cli.demo import demo

    with Progress("demo") as progress:
        paths = demo(options.output, progress)
    for path, what in paths:
        print(f"{path}  {what}")
    return 0


def _one_line_warning(message: Warning | str, *_rest: Any, **_more: Any) -> None:
    print(f"sunwidget: {one_line(message)}", file=sys.stderr)
