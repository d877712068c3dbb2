"""Frames that the kernel draws while something is dragged; the sky network; a stroke."""

from __future__ import annotations

import sunwidget as sw
from sunwidget.analysis import correct
from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.segmentation import coarse_sky

from .effort import Effort
from .pictures import analysed
from .rows import Rows, of_times
from .timing import timed

KEYS = ("kernel frame", "kernel turbidity drag", "network", "stroke")


def rows(effort: Effort) -> Rows:
    width, height = effort.frame
    scene = analysed(width, height)
    for method in ("ratio", "thesis"):
        drag = timed(
            lambda i, m=method: sw.render(scene, sw.Edit(sun_elevation=1 + i % 17, method=m)),
            effort.runs,
        )
        key = "kernel frame" if method == "ratio" else f"kernel frame, {method}"
        yield of_times(key, f"kernel frame {width}×{height}, sun drag, {method}", drag, "ms")
    haze = timed(
        lambda i: sw.render(scene, sw.Edit(sun_elevation=5, aerosol_optical_depth=0.02 * i)),
        effort.runs,
    )
    yield of_times(
        "kernel turbidity drag", f"kernel frame {width}×{height}, turbidity drag", haze, "ms"
    )
    # A working copy remembers what the network said of it.
    copies = [Working.of(sw.sample("coast")) for _ in range(effort.runs + 1)]
    network = timed(lambda i: coarse_sky.network(copies[i]), effort.runs)
    yield of_times("network", "sky network at 384×384", network, "s")
    strokes = [
        sw.Stroke("sky", ((0.4 + 0.02 * i, 0.7), (0.45 + 0.02 * i, 0.7)), 0.005) for i in range(6)
    ]
    corrected = timed(
        lambda i: correct.corrected(scene, sw.Edit(strokes=tuple(strokes[: 1 + i]))),
        min(5, effort.runs),
    )
    yield of_times("stroke", f"a brush stroke answered, {width}×{height}", corrected, "s")
