"""Against a straight NumPy and OpenCV version of the thesis' equations.

The peer is the one that the tests compare the shaders with: one full-size array a step, no thought
of speed, in 64-bit floats. It looks its sky up in what our own sky pass drew, so that the equations
alone are compared; its own sky would cost it more.
"""

from __future__ import annotations

import numpy as np

import sunwidget as sw

from .effort import Effort
from .pictures import analysed
from .rows import Row, Rows, of_times
from .thesis import thesis_frame
from .timing import in_turn

KEYS = ("thesis in NumPy",)


def rows(effort: Effort) -> Rows:
    width, height = effort.frame
    scene = analysed(width, height)

    def edit(i: int) -> sw.Edit:
        return sw.Edit(sun_elevation=1 + 0.7 * i % 17, method="thesis")

    ours, theirs = in_turn(
        lambda i: sw.render(scene, edit(i)),
        lambda i: thesis_frame(scene, edit(i), sky="passes"),
        effort.runs,
        max(1, effort.runs // 5),
    )
    levels = np.abs(
        thesis_frame(scene, edit(5), sky="passes").astype(int) - sw.render(scene, edit(5))
    )
    yield Row(
        "thesis in NumPy",
        f"thesis frame {width}×{height}: NumPy + OpenCV over ours",
        theirs.median / ours.median,
        "×",
        runs=len(theirs.wall),
        note=f"difference {levels.mean():.2f} of 255 levels on average",
    )
    yield of_times(
        "thesis frame",
        f"thesis frame {width}×{height}, beside NumPy + OpenCV",
        ours,
        "ms",
        peer=1000 * theirs.median,
        ratio=theirs.median / ours.median,
    )
