"""Processor time of each pass of the editor's sun drag, on software rendering.

usage: python bench/passes.py [--size 1024x698] [--runs 20] [--method ratio] [--scene scene.pickle]

llvmpipe draws in threads of this process, so their total processor time is the cost of a pass,
whatever else runs on the machine; divided by the number of cores it is the waiting time on an idle
one. On a graphics card the figures are meaningless. Memory is shared: other busy processes still
slow down the large passes, so compare runs that alternate.
"""

from __future__ import annotations

import argparse
import pickle
import statistics
import time
from pathlib import Path
from typing import Any

import sunwidget as sw
from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.graph import FrameGraph, Programs
from sunwidget.renderer.offscreen import draw_part, scene_textures


class TimedGraph(FrameGraph):
    """A frame graph that waits for each pass and records its processor time in milliseconds."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.times: dict[str, list[float]] = {}

    def _run_pass(self, row: dict[str, Any], *rest: Any) -> None:
        before = self.runs.get(row["name"], 0)
        self.context.finish()
        begin = time.process_time()
        super()._run_pass(row, *rest)
        self.context.finish()
        spent = time.process_time() - begin
        if self.runs.get(row["name"], 0) > before:
            self.times.setdefault(row["name"], []).append(spent * 1000)


def pass_times(scene: Any, edits: list[Any], size: tuple[int, int]) -> dict[str, float]:
    """Return the median of each pass that ``edits`` draw one after the other, and of all."""

    def task(context: Any) -> dict[str, list[float]]:
        graph = TimedGraph(Programs(context), scene_textures(scene, size))
        draw_part(graph, scene, edits[0], size, "uint8")
        graph.times = {}
        whole = []
        for edit in edits[1:]:
            begin = time.process_time()
            draw_part(graph, scene, edit, size, "uint8")
            whole.append((time.process_time() - begin) * 1000)
        return {**graph.times, "all, with the read-back": whole}

    return {name: statistics.median(spent) for name, spent in on_gl_thread(task).items()}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", default="1024x698")
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--method", default="ratio")
    parser.add_argument("--scene", type=Path, help="a pickled Scene instead of the sample's")
    options = parser.parse_args()
    width, height = (int(n) for n in options.size.split("x"))
    if options.scene:
        scene = pickle.loads(options.scene.read_bytes())
    else:
        scene = sw.analyze(sw.sample("coast"))
    edits = [
        sw.Edit(sun_elevation=1 + 0.7 * i % 17, method=options.method)
        for i in range(options.runs + 1)
    ]
    for name, spent in pass_times(scene, edits, (width, height)).items():
        print(f"{name:30}{spent:8.1f} ms")


if __name__ == "__main__":
    main()
