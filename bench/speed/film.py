"""A sweep of the sun as MP4, and what drawing and encoding take of it."""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

import sunwidget as sw
from sunwidget.film.path import film_edits
from sunwidget.film.writer import Film, writer

from .effort import Effort
from .pictures import analysed
from .rows import Row, Rows

KEYS = ("film",)
ENDS = [sw.Edit(sun_elevation=14), sw.Edit(sun_elevation=-4)]


def rows(effort: Effort) -> Rows:
    count, size = effort.film
    scene = analysed(*size)
    edits = film_edits(scene, ENDS, frames=count)
    some = edits[::4]  # as dear as all of them
    kept: list[np.ndarray] = [sw.render(scene, edits[0], size=size)]

    def draw() -> None:
        for edit in some:
            frame = sw.render(scene, edit, size=size)
            if len(kept) < 24:
                kept.append(frame)

    def again() -> Iterator[np.ndarray]:
        return (kept[i % len(kept)] for i in range(count))

    with tempfile.TemporaryDirectory() as name:
        path = Path(name) / "film.mp4"
        seconds, processor = cost(lambda: sw.sweep(scene, ENDS, path, frames=count, size=size))
        shown = f"{size[0]}×{size[1]}"
        yield Row(
            "film",
            f"sweep of {count} frames at {shown} to MP4",
            count / seconds,
            "frames/s",
            note=f"{1000 * processor / count:.0f} ms of processor a frame",
        )
        plain = Film(size, 24, count, "forever", 85)
        encode = writer(path)
        for what, work, frames in (
            ("drawing", draw, len(some)),
            ("encoding", lambda: encode(again(), Path(name) / "encoded.mp4", plain), count),
        ):
            seconds, processor = cost(work)
            yield Row(
                f"film, {what} alone",
                f"{what} {shown} alone, a frame",
                1000 * seconds / frames,
                "ms",
                processor=1000 * processor / frames,
            )


def cost(work: Callable[[], Any]) -> tuple[float, float]:
    """Return seconds by the clock and of processors, those of ffmpeg too."""
    begin, before = time.perf_counter(), os.times()
    work()
    after = os.times()
    return time.perf_counter() - begin, sum(after[:4]) - sum(before[:4])
