"""Time and peak memory against the pixel count: each photo in a process of its own."""

from __future__ import annotations

import json
import math
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from .effort import Effort
from .pictures import photo_file, size_of
from .rows import Row, Rows, not_measured, of_times
from .timing import Times

KEYS = (
    "kernel frame 12 MP",
    "kernel frame 24 MP",
    "peak memory 24 MP",
    "time against pixels",
    "memory against pixels",
)
GOALS_AT = {"kernel frame 12 MP": 12, "kernel frame 24 MP": 24, "peak memory 24 MP": 24}
STEPS = ("open", "analyse", "frame")
LARGE = 2.0  # MP: below, what costs the same at any size hides how cost grows


def rows(effort: Effort) -> Rows:
    found = []
    for megapixels in effort.megapixels:
        width, height = size_of(megapixels)
        row = measured(megapixels)
        found.append(row | {"pixels": width * height / 1e6})
        what = f"{megapixels:g} MP"
        for step in STEPS:
            times = Times(row[step], row[f"{step} processor"])
            yield of_times(f"kernel {step} {what}", f"kernel {step} {what}", times, "s")
        yield Row(
            f"peak memory {what}",
            f"peak memory of opening, analyzing and drawing {what}",
            row["frame memory"],
            "GB",
            note=f"{row['begin memory']:.2f} GB before; after analysis {row['analyse memory']:.2f}",
        )
    for key, megapixels in GOALS_AT.items():
        if megapixels not in effort.megapixels:
            yield not_measured(key, f"{megapixels} MP is not among the sizes of this run")
    large = [row for row in found if row["pixels"] >= LARGE]
    large = large if len(large) > 1 else found
    reach = f"{large[0]['pixels']:.2g} to {large[-1]['pixels']:.2g} MP"
    for step in STEPS:
        power = exponent(large, lambda row, s=step: statistics.median(row[f"{s} processor"]))
        key = "time against pixels" if step == "frame" else f"{step} against pixels"
        yield Row(key, f"{step}: time grows as pixels to the power of", power, "", note=reach)
    power = exponent(large, lambda row: row["frame memory"] - row["begin memory"])
    yield Row(
        "memory against pixels",
        "memory above the interpreter's grows as the power of",
        power,
        "",
        note=reach,
    )


def exponent(found: list[dict[str, Any]], of: Any) -> float:
    """Slope of the logarithm of a cost over that of the pixel count, least squares."""
    x = [math.log(row["pixels"]) for row in found]
    y = [math.log(max(of(row), 1e-9)) for row in found]
    middle = statistics.fmean(x)
    spread = sum((a - middle) ** 2 for a in x)
    return sum((a - middle) * b for a, b in zip(x, y, strict=True)) / spread


def measured(megapixels: float) -> dict[str, Any]:
    """Open, analyse and draw a photo of so many pixels in another process."""
    with tempfile.TemporaryDirectory() as name:
        photo = photo_file(Path(name), megapixels)
        command = [sys.executable, "-m", "speed.one_size", str(photo)]
        here = Path(__file__).resolve().parents[1]
        run = subprocess.run(command, cwd=here, capture_output=True, text=True, check=False)
    if run.returncode:
        raise RuntimeError(f"{megapixels:g} MP: {run.stderr.strip().splitlines()[-1]}")
    found: dict[str, Any] = json.loads(run.stdout)
    return found
