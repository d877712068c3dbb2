"""A batch of photos on one worker and two, with one killed, and the plain loop beside them.

usage: python bench/batch.py [FOLDER...] [--photos 60] [--long-edge 1024] [--json FILE]

Every variant starts cold: a batch includes the start of its workers, the loop its imports (it runs
first). Their pictures are compared byte by byte.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import psutil
from PIL import Image

import sunwidget as sw

EDIT = sw.Edit(sun_elevation=3)
SHARED = Path(os.environ.get("SUNWIDGET_SHARED", Path(__file__).resolve().parents[2] / "shared"))


def copies(folders: list[Path], count: int, long_edge: int, into: Path) -> list[Path]:
    """Shrink photos into a folder; if there are too few, add mirrored copies."""
    found = sorted(p for folder in folders for p in folder.rglob("*.jpg"))
    if not found:
        sys.exit(f"No photos in {', '.join(map(str, folders))}. Name folders that hold some.")
    made = []
    for i in range(count):
        with Image.open(found[i % len(found)]) as picture:
            small = picture.convert("RGB")
        small.thumbnail((long_edge, long_edge))
        if i >= len(found):
            small = small.transpose(Image.Transpose.FLIP_LEFT_RIGHT)
        path = into / f"{i:03}.jpg"
        small.save(path, quality=92)
        made.append(path)
    return made


def loop(photos: list[Path], out: Path) -> list[str]:
    """Run the loop that a user would write without a batch."""
    out.mkdir()
    failed = []
    for photo in photos:
        try:
            scene = sw.analyze(sw.open(photo))
            sw.save((scene, EDIT), out / f"{photo.stem}-sun.jpg")
        except (sw.PhotoError, sw.AnalysisError, OSError) as error:
            failed.append(f"{photo.name}: {error}")
    return failed


def kill_one(fraction_at: float) -> Callable[[float, str], None]:
    """Return a progress callable that kills a worker process once, mid-run."""
    killed: list[int] = []

    def progress(fraction: float, _message: str) -> None:
        if fraction < fraction_at or killed:
            return
        for child in psutil.Process().children(recursive=True):
            if "multiprocessing.spawn" in " ".join(child.cmdline()):
                child.send_signal(signal.SIGKILL)
                killed.append(child.pid)
                return

    return progress


def same_files(first: Path, second: Path) -> str:
    """Count the pictures that are identical in two folders, byte by byte."""
    names = sorted(p.name for p in first.glob("*.jpg"))
    same = sum((first / n).read_bytes() == (second / n).read_bytes() for n in names)
    extra = len(list(second.glob("*.jpg"))) - len(names)
    return f"{same} of {len(names)}" + (f", {extra} more" if extra else "")


def main() -> int:
    """Run every variant and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", nargs="*", type=Path, default=[SHARED / "data" / "photos"])
    parser.add_argument("--photos", type=int, default=60)
    parser.add_argument("--long-edge", type=int, default=1024)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    table: list[dict[str, Any]] = []
    with tempfile.TemporaryDirectory(prefix="bench-batch-") as name:
        folder = Path(name)
        (folder / "photos").mkdir()
        photos = copies(options.folders, options.photos, options.long_edge, folder / "photos")

        def note(way: str, out: str, done: int, begin: float) -> None:
            seconds = time.perf_counter() - begin
            row = {
                "way": way,
                "seconds": round(seconds, 1),
                "photos_per_minute": round(60 * len(photos) / seconds, 1),
                "done": done,
                "same_as_loop": same_files(folder / "loop", folder / out),
                "load": round(os.getloadavg()[0], 1),
            }
            table.append(row)
            print(row, flush=True)

        begin = time.perf_counter()
        failed = loop(photos, folder / "loop")
        note("plain loop", "loop", len(photos) - len(failed), begin)
        ways: list[tuple[str, int, Callable[[float, str], None] | None]] = [
            ("2 workers", 2, None),
            ("2 workers, one killed", 2, kill_one(0.3)),
            ("1 worker", 1, None),
        ]
        for number, (way, workers, progress) in enumerate(ways):
            begin = time.perf_counter()
            report = sw.batch(
                photos, EDIT, folder / str(number), workers=workers, progress=progress
            )
            note(way, str(number), len(report.done), begin)
        begin = time.perf_counter()
        report = sw.batch(photos, EDIT, folder / "0", workers=2)
        note("2 workers again (all skipped)", "0", len(report.skipped), begin)
    if options.json:
        options.json.write_text(json.dumps(table, indent=2))
    print(f"\n{'way':32}{'seconds':>9}{'a minute':>10}{'done':>6}  same as the loop")
    for row in table:
        print(
            f"{row['way']:32}{row['seconds']:9}{row['photos_per_minute']:10}{row['done']:6}"
            f"  {row['same_as_loop']}"
        )
    return 0


if __name__ == "__main__":
    sys.exit(main())
