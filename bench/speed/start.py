"""What a session costs before anything is opened: the import, and files that travel."""

from __future__ import annotations

import compileall
import subprocess
import sys
from pathlib import Path

import sunwidget

from .effort import Effort
from .rows import Row, Rows, of_times
from .timing import Times

PACKAGE = Path(sunwidget.__file__).parent
BUNDLES = ("sun_editor", "sky_explorer", "compare", "study", "standalone")
KEYS = ("import", *(f"bundle {name}" for name in BUNDLES), "network file")
_IMPORT = (
    "import time; w, c = time.perf_counter(), time.process_time(); import {module}; "
    "print(time.perf_counter() - w, time.process_time() - c)"
)


def rows(effort: Effort) -> Rows:
    yield of_times("import", "import sunwidget", import_time("sunwidget", effort), "s")
    widgets = import_time("sunwidget.widgets.editor.sun_editor", effort)
    yield of_times("import widgets", "first use of an editor: its imports", widgets, "s")
    for name in BUNDLES:
        size = (PACKAGE / "static" / f"{name}.js").stat().st_size / 1000
        yield Row(f"bundle {name}", f"front end {name}.js, minified", size, "kB")
    network = (PACKAGE / "analysis" / "models" / "sky.onnx").stat().st_size / 1e6
    yield Row("network file", "sky network", network, "MB")


def import_time(module: str, effort: Effort) -> Times:
    """Import in fresh interpreters; bytecode lies ready as in an installed package."""
    compileall.compile_dir(PACKAGE, quiet=2)
    times = Times([], [])
    for _ in range(min(5, effort.runs)):
        command = [sys.executable, "-c", _IMPORT.format(module=module)]
        wall, processor = subprocess.check_output(command).split()
        times.wall.append(float(wall))
        times.processor.append(float(processor))
    return times
