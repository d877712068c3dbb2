"""Time and peak memory against the pixel count, as a drawing."""

from __future__ import annotations

import re
from pathlib import Path

from .rows import Row

_ROW = re.compile(r"^(kernel open|kernel analyse|kernel frame|peak memory) ([\d.]+) MP$")
NAMES = {
    "kernel open": "open",
    "kernel analyse": "analyse",
    "kernel frame": "one frame",
    "peak memory": "peak memory",
}


def series(rows: list[Row]) -> dict[str, list[tuple[float, float]]]:
    """Return (megapixels, value) of what was measured at several sizes."""
    found: dict[str, list[tuple[float, float]]] = {}
    for row in rows:
        match = _ROW.match(row.key)
        if match and not row.error:
            found.setdefault(match[1], []).append((float(match[2]), row.value))
    return {name: sorted(points) for name, points in found.items() if len(points) > 1}


def against_pixels(rows: list[Row], path: Path) -> bool:
    """Draw the series into ``path``; False when there are none, or no matplotlib."""
    found = series(rows)
    try:
        import matplotlib as mpl
        from matplotlib.figure import Figure
    except ImportError:
        print("No plot: matplotlib is not installed (pip install -e '.[test]').")
        return False
    if not found:
        return False
    mpl.rcParams["svg.hashsalt"] = "sunwidget"
    figure = Figure(figsize=(9, 3.6), layout="constrained")
    time, memory = figure.subplots(1, 2)
    colors = dict(zip(NAMES, ("#4477aa", "#228833", "#cc6633", "#aa3377"), strict=True))
    for name, points in found.items():
        axes = memory if name == "peak memory" else time
        axes.plot(*zip(*points, strict=True), "o-", color=colors[name], label=NAMES[name])
    guide = found.get("kernel frame")
    if guide:
        ends = guide[0][0], guide[-1][0]
        level = guide[-1][1] / guide[-1][0]
        time.plot(ends, [level * x for x in ends], ":", color="grey", label="in proportion")
    memory.axhline(1.5, linestyle=":", color="grey", label="goal at 24 MP")
    for axes, label in ((time, "seconds"), (memory, "GB")):
        axes.set(xlabel="megapixels", ylabel=label)
        axes.spines[["top", "right"]].set_visible(False)
        axes.legend(frameon=False)
    time.set(xscale="log", yscale="log", title="Time")
    memory.set(title="Peak memory of the process", ylim=(0, None))
    figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)
    return True
