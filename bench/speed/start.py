"""What a session costs once: the import, files that travel, and the shaders of its first frame."""

from __future__ import annotations

import compileall
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import sunwidget

from .effort import Effort
from .rows import Row, Rows, of_times
from .timing import Times

PACKAGE = Path(sunwidget.__file__).parent
BUNDLES = ("sun_editor", "sky_explorer", "compare", "study", "standalone")
KEYS = (
    *("import", *(f"bundle {name}" for name in BUNDLES), "network file"),
    *("first frame ever", "first frame"),
)
_FRAME = """
import sys, time
import sunwidget as sw
scene, edit = sw.analyze(sw.sample("coast")), sw.Edit(sun_elevation=5)
size = int(sys.argv[1]), int(sys.argv[2])
scene.transfer, scene.lamps  # what a frame asks of the analysis
begin = time.perf_counter()
sw.render(scene, edit, size=size)
print(time.perf_counter() - begin)
"""
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
    with tempfile.TemporaryDirectory() as compiled:
        for key, what in (
            ("first frame ever", "a machine's first frame: shaders compiled"),
            ("first frame", "a process's first frame: shaders read from disk"),
        ):
            yield Row(key, what, first_frame(compiled, effort), "s")


def first_frame(compiled: str, effort: Effort) -> float:
    """Draw one frame in a fresh process; Mesa keeps what it compiles in ``compiled``."""
    command = [sys.executable, "-c", _FRAME, *map(str, effort.frame)]
    kept = {**os.environ, "MESA_SHADER_CACHE_DIR": compiled}
    return float(subprocess.check_output(command, env=kept))


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
