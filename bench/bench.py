"""Measure sunwidget's speed: a table on stdout and build/bench.json.

usage: python bench/bench.py [--quick] [--only TEXT]

Medians over several runs, on whatever machine this is; the load average is printed
because a busy machine makes every time longer. Ratios are measured in one run.
"""

from __future__ import annotations

import argparse
import gc
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import cv2
import numpy as np

import sunwidget as sw

ROOT = Path(__file__).resolve().parents[1]


class Row(NamedTuple):
    """One measurement; ``goal`` is an upper bound, or a lower one where ``more`` is true."""

    what: str
    value: float
    unit: str
    goal: float | None = None
    more: bool = False

    @property
    def met(self) -> bool | None:
        if self.goal is None:
            return None
        return self.value >= self.goal if self.more else self.value <= self.goal


def median_ms(task: Callable[[int], Any], runs: int) -> float:
    """Median time of ``task(i)`` in milliseconds, after one run that is not counted."""
    task(0)
    times = []
    for i in range(1, runs + 1):
        begin = time.perf_counter()
        task(i)
        times.append(time.perf_counter() - begin)
    return statistics.median(times) * 1000


def picture(width: int, height: int) -> np.ndarray:
    """Return the sample at another size, with a little grain so that nothing is flat."""
    small = sw.sample("coast").preview(4096)
    large = cv2.resize(small, (width, height), interpolation=cv2.INTER_CUBIC).astype(np.int16)
    grain = np.random.default_rng(1).integers(-2, 3, (height, width, 1), dtype=np.int16)
    return np.clip(large + grain, 0, 255).astype(np.uint8)


def start_up() -> Iterator[Row]:
    code = "import time; t = time.perf_counter(); import sunwidget; print(time.perf_counter() - t)"
    times = [float(subprocess.check_output([sys.executable, "-c", code])) for _ in range(5)]
    yield Row("import sunwidget", statistics.median(times), "s", 0.5)
    for bundle in sorted((ROOT / "sunwidget" / "static").glob("*.js")):
        yield Row(f"bundle {bundle.name}", bundle.stat().st_size / 1000, "kB", 120)
    model = ROOT / "sunwidget" / "analysis" / "models" / "sky.onnx"
    if model.exists():
        yield Row("sky.onnx", model.stat().st_size / 1e6, "MB", 5)


def sky_network(runs: int) -> Iterator[Row]:
    from sunwidget.analysis import sky
    from sunwidget.analysis.working import Working

    working = Working.of(sw.sample("coast"))
    milliseconds = median_ms(lambda _i: sky.network(working), runs)
    yield Row("sky network at 384×384", milliseconds / 1000, "s", 0.15)


def frames(runs: int) -> Iterator[Row]:
    small = sw.analyze(picture(1024, 698))
    for method in ("ratio", "thesis"):
        drag = median_ms(
            lambda i, m=method: sw.render(small, sw.Edit(sun_elevation=1 + i % 17, method=m)), runs
        )
        goal = 40 if method == "ratio" else None
        yield Row(f"kernel frame 1024×698, sun drag, {method}", drag, "ms", goal)
    haze = median_ms(
        lambda i: sw.render(small, sw.Edit(sun_elevation=5, aerosol_optical_depth=0.01 * i)), runs
    )
    yield Row("kernel frame 1024×698, haze drag", haze, "ms", 120)
    yield from against_numpy(small, runs)
    for megapixels, size in ((12, (4243, 2828)), (24, (6000, 4000))):
        scene = sw.analyze(picture(*size))
        seconds = median_ms(lambda i, s=scene: sw.render(s, sw.Edit(sun_elevation=i + 1)), 2) / 1000
        yield Row(f"kernel frame {megapixels} MP", seconds, "s", megapixels / 8)
        del scene
        gc.collect()


def against_numpy(scene: Any, runs: int) -> Iterator[Row]:
    """Compare with a straight NumPy and OpenCV version of the thesis equations, in one run."""
    sys.path.insert(0, str(ROOT / "tests" / "unit"))
    from thesis_reference import thesis_frame

    edit = sw.Edit(sun_elevation=5, method="thesis")
    slow = median_ms(lambda _i: thesis_frame(scene, edit, sky="passes"), max(2, runs // 4))
    fast = median_ms(lambda i: sw.render(scene, edit.replace(sun_elevation=1 + i % 17)), runs)
    yield Row("thesis frame, NumPy time / kernel time", slow / fast, "×", 30, more=True)


def canvas(runs: int) -> Iterator[Row]:
    from canvas import frame_times

    scene = sw.analyze(picture(1024, 698))
    suns = [{"sun_elevation": 1 + i * 0.7 % 17, "method": "ratio"} for i in range(runs + 1)]
    milliseconds, driver = frame_times(scene, suns)
    yield Row(f"canvas frame 1024×698, sun drag ({driver[:40]})", milliseconds, "ms", 33)
    for method in ("thesis", "thesis_literal"):
        milliseconds, _ = frame_times(scene, [{**sun, "method": method} for sun in suns])
        yield Row(f"canvas frame 1024×698, sun drag, {method}", milliseconds, "ms")
    hazes = [{"aerosol_optical_depth": 0.02 * i % 0.6, "sun_elevation": 5} for i in range(runs + 1)]
    milliseconds, _ = frame_times(scene, hazes)
    yield Row("canvas frame 1024×698, haze drag", milliseconds, "ms", 120)


def explorer(runs: int) -> Iterator[Row]:
    from canvas import sky_frame_times

    size = (1024, 698)
    for projection in ("dome", "camera"):
        view = {"projection": projection}
        suns = [{**view, "sun_elevation": 1 + i * 0.7 % 17} for i in range(runs + 1)]
        milliseconds, _ = sky_frame_times(suns, size)
        yield Row(f"explorer frame 1024×698, sun drag, {projection}", milliseconds, "ms", 33)
    hazes = [{"aerosol_optical_depth": 0.02 * i % 0.6, "sun_elevation": 5} for i in range(runs + 1)]
    milliseconds, _ = sky_frame_times(hazes, size)
    yield Row("explorer frame 1024×698, haze drag", milliseconds, "ms", 120)


def first_picture() -> Iterator[Row]:
    from PIL import Image

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "photo.jpg"
        Image.fromarray(picture(4243, 2828)).save(path, quality=92)
        begin = time.perf_counter()
        photo = sw.open(path)
        photo.preview(2048)
        yield Row("open 12 MP and make its preview", time.perf_counter() - begin, "s", 1)
        begin = time.perf_counter()
        scene = sw.analyze(photo)
        yield Row("analyse 12 MP", time.perf_counter() - begin, "s", 5)
        for stage, seconds in scene.timings.items():
            yield Row(f"  {stage}", seconds, "s")


def memory() -> Iterator[Row]:
    """Peak memory of one 24 MP render, in a process of its own."""
    code = """
import resource, sys
sys.path.insert(0, "bench")
from bench import picture, sw
scene = sw.analyze(picture(6000, 4000))
sw.render(scene, sw.Edit(sun_elevation=3))
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024**2)
"""
    peak = float(subprocess.check_output([sys.executable, "-c", code], cwd=ROOT))
    yield Row("peak memory, analyse and render 24 MP", peak, "GB", 1.5)


def film(count: int) -> Iterator[Row]:
    scene = sw.analyze(sw.sample("coast"))
    ends = [sw.Edit(sun_elevation=14), sw.Edit(sun_elevation=-4)]
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        sw.sweep(scene, ends, Path(folder) / "film.mp4", frames=count, size=(1920, 1080))
        rate = count / (time.perf_counter() - begin)
    yield Row(f"sweep of {count} frames at 1080p to MP4", rate, "frames/s", 12, more=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="fewer runs")
    parser.add_argument("--only", default="", help="groups whose name contains this")
    options = parser.parse_args()
    runs = 5 if options.quick else 20
    groups: dict[str, Callable[[], Iterator[Row]]] = {
        "start": start_up,
        "network": lambda: sky_network(runs),
        "frames": lambda: frames(runs),
        "canvas": lambda: canvas(runs),
        "explorer": lambda: explorer(runs),
        "first": first_picture,
        "memory": memory,
        "film": lambda: film(24 if options.quick else 120),
    }
    rows: list[Row] = []
    for name, group in groups.items():
        if options.only in name:
            for row in group():
                rows.append(row)
                print_row(row)
    machine = {
        "cpu_count": os.cpu_count(),
        "load_average": os.getloadavg(),
        "python": platform.python_version(),
        "renderer": renderer(),
        "sunwidget": sw.__version__,
        "time": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
    }
    load = machine["load_average"][0]
    print(f"{machine['renderer']}, {machine['cpu_count']} cores, load average {load:.1f}")
    out = ROOT / "build" / "bench.json"
    out.parent.mkdir(exist_ok=True)
    table = [{**row._asdict(), "met": row.met} for row in rows]
    out.write_text(json.dumps({"machine": machine, "rows": table}, indent=2) + "\n")
    print(out.relative_to(ROOT))
    return 0


def print_row(row: Row) -> None:
    goal = "" if row.goal is None else f"{'≥' if row.more else '≤'} {row.goal:g} {row.unit}"
    mark = {True: "met", False: "MISSED", None: ""}[row.met]
    print(f"{row.what:60}{row.value:10.3g} {row.unit:9}{goal:16}{mark}", flush=True)


def renderer() -> str:
    from sunwidget.renderer.gl_thread import on_gl_thread

    return str(on_gl_thread(lambda context: context.info["GL_RENDERER"]))


if __name__ == "__main__":
    sys.exit(main())
