"""Films: frames a second of rendering, of encoding and of both, file sizes, and a probe.

usage: python bench/film.py [--frames 120] [--size 1920x1080] [--keep FOLDER]

Rendering and encoding work at the same time, so the film should take little longer than the
slower of the two. Processor time of the whole process tree is printed beside the clock's: on a
busy machine it is what the work costs, and divided by the cores what it takes on an idle one.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

import sunwidget as sw
from sunwidget.export.film import Film, writer
from sunwidget.export.sun_path import film_edits

ENDS = [sw.Edit(sun_elevation=14), sw.Edit(sun_elevation=-4)]


def cost(work: Callable[[], Any]) -> tuple[float, float]:
    """Return seconds by the clock and of processors, ffmpeg's too."""
    begin, before = time.perf_counter(), os.times()
    work()
    after = os.times()
    return time.perf_counter() - begin, sum(after[:4]) - sum(before[:4])


def row(name: str, frames: int, wall: float, processor: float) -> None:
    ideal = processor / frames / (os.cpu_count() or 1)
    print(
        f"{name:34s} {frames / wall:6.2f} frames/s   {processor / frames * 1000:6.0f} ms of "
        f"processor a frame   {1 / ideal:6.2f} frames/s if all {os.cpu_count()} cores were its own"
    )


def probe(path: Path) -> str:
    """Return what another program says of a film: ffprobe, else MediaInfo."""
    if shutil.which("ffprobe"):
        wanted = (
            "stream=codec_name,profile,level,width,height,pix_fmt,color_range,color_space,"
            "color_transfer,color_primaries,r_frame_rate,nb_frames,duration"
        )
        command = ["ffprobe", "-v", "error", "-show_entries", wanted, "-of", "json", str(path)]
        told = json.loads(subprocess.check_output(command))["streams"][0]
        return " ".join(f"{name}={value}" for name, value in told.items())
    try:
        from pymediainfo import MediaInfo
    except ImportError:
        return "not probed: neither ffprobe nor pymediainfo is here"
    track = MediaInfo.parse(path).video_tracks[0]
    names = "format format_profile width height chroma_subsampling matrix_coefficients frame_rate"
    return " ".join(f"{name}={getattr(track, name)}" for name in names.split())


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--frames", type=int, default=120)
    parser.add_argument("--size", default="1920x1080")
    parser.add_argument("--keep", type=Path, help="folder to leave the films in")
    options = parser.parse_args()
    width, height = (int(n) for n in options.size.split("x"))
    count, size = options.frames, (width, height)
    scene = sw.analyze(sw.sample("coast"))
    edits = film_edits(scene, ENDS, frames=count)
    kept: list[np.ndarray] = []

    def render() -> None:
        for edit in edits:
            frame = sw.render(scene, edit, size=size)
            if len(kept) < 24:
                kept.append(frame)

    def again() -> Iterator[np.ndarray]:
        return (kept[i % len(kept)] for i in range(count))

    sw.render(scene, edits[0], size=size)  # shaders and the unmoved sun's own sky
    row("rendering alone", count, *cost(render))
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        film = Film(size, 24, count, "forever", 85)
        for suffix in (".mp4", ".webp", ".gif"):
            path = folder / f"encoded{suffix}"
            write = writer(path)
            row(
                f"encoding {suffix} alone",
                count,
                *cost(lambda w=write, p=path: w(again(), p, film)),
            )
            path.unlink()
        for name, choices in {
            "film.mp4": {"size": size},
            "film.webp": {"size": (960, 640)},
            "film.gif": {},
        }.items():
            path = folder / name
            spent = cost(
                lambda p=path, c=choices: sw.sweep(
                    scene, ENDS, p, frames=count, overwrite=True, **c
                )
            )
            row(f"sweep to {name}", count, *spent)
            print(f"    {path.stat().st_size / 1e6:.1f} MB  {probe(path)}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
