"""Frames of the editor's canvas while something is dragged, without a notebook."""

from __future__ import annotations

from typing import Any

import sunwidget as sw

from .effort import Effort
from .machine import is_software
from .page import dragged, driver, opened, widget_state
from .pictures import analysed
from .rows import Rows, not_measured, of_times

KEYS = ("canvas sun drag", "canvas sun drag, graphics card", "canvas turbidity drag")


def rows(effort: Effort) -> Rows:
    size = effort.frame
    what = f"canvas frame {size[0]}×{size[1]}"
    editor = sw.SunEditor(analysed(*size)).wait()
    with opened() as page:
        page.evaluate("async state => makeFrame(state)", widget_state(editor))
        card = driver(page)
        for method in ("ratio", "thesis", "thesis_literal"):
            times = dragged(page, suns(effort, method=method), size)
            if method != "ratio":
                yield of_times(
                    f"canvas sun drag, {method}", f"{what}, sun drag, {method}", times, "ms"
                )
            elif is_software(card):
                yield of_times("canvas sun drag", f"{what}, sun drag", times, "ms", note=card)
                yield not_measured("canvas sun drag, graphics card", f"no graphics card: {card}")
            else:
                yield not_measured("canvas sun drag", f"a graphics card draws: {card}")
                key = "canvas sun drag, graphics card"
                yield of_times(key, f"{what}, sun drag, graphics card", times, "ms", note=card)
        times = dragged(page, hazes(effort), size)
        yield of_times("canvas turbidity drag", f"{what}, turbidity drag", times, "ms")


def suns(effort: Effort, **more: Any) -> list[dict[str, Any]]:
    """Edits of a drag of the sun, one more than is counted."""
    count = 5 * max(2, effort.runs // 5) + 1
    return [{**more, "sun_elevation": 1 + i * 0.7 % 17} for i in range(count)]


def hazes(effort: Effort, **more: Any) -> list[dict[str, Any]]:
    """Edits of a drag of the turbidity."""
    count = 5 * max(2, effort.runs // 5) + 1
    return [
        {**more, "aerosol_optical_depth": 0.02 * i % 0.6, "sun_elevation": 5} for i in range(count)
    ]
