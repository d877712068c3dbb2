"""Many editors in one page: what a frame of the last one takes, and what they hold together."""

from __future__ import annotations

import statistics
from pathlib import Path
from typing import Any

import sunwidget as sw

from .effort import Effort
from .page import opened, widget_state
from .pictures import picture
from .rows import Row, Rows, of_times
from .timing import Times

KEYS = ("20 editors, frame", "20 editors, contexts")
# As a slider of the kernel's would move the sun: set, then read the canvas once it has followed.
_MOVE = """async ([i, elevations]) => {
  const canvas = document.querySelectorAll(".sw-canvas")[i];
  const context = canvas.getContext("2d");
  const middle = () =>
    context.getImageData(canvas.width / 2 - 8, canvas.height / 4, 16, 16).data.join();
  const next = () => new Promise(requestAnimationFrame);
  const seconds = [];
  for (const sun_elevation of elevations) {
    const before = middle();
    const begin = performance.now();
    models[i].receive({ sun_elevation });
    while (middle() === before && performance.now() - begin < 20_000) await next();
    seconds.push((performance.now() - begin) / 1000);
  }
  return seconds;
}"""


def rows(effort: Effort) -> Rows:
    side = max(effort.frame) * 3 // 4
    width, height = side, side * 2 // 3
    state = widget_state(sw.SunEditor(sw.analyze(picture(width, height))).wait())
    with opened() as page:
        from chromium import count_contexts, live_contexts

        count_contexts(page)
        one: list[float] = []
        for i in range(effort.editors):
            page.evaluate("state => addEditor(state)", state)
            view = page.locator(".sunwidget").nth(i)
            view.scroll_into_view_if_needed()
            view.and_(page.locator(".sw-live")).wait_for()
            if i == 0:
                one = moved(page, 0, effort)
        many = moved(page, effort.editors - 1, effort)
        shown = f"{effort.editors} editors of {width}×{height}"
        yield of_times(
            "1 editor, frame", f"one editor of {width}×{height}, sun set", Times(one, []), "ms"
        )
        yield of_times("20 editors in ms", f"the last of {shown}, sun set", Times(many, []), "ms")
        yield Row(
            "20 editors, frame",
            f"the last of {shown}, over one alone",
            statistics.median(many) / statistics.median(one),
            "×",
            runs=len(many),
        )
        page.locator(".sunwidget").first.scroll_into_view_if_needed()
        back = page.evaluate(_MOVE, [0, [3.0]])
        yield of_times("20 editors, back", f"back at the first of {shown}", Times(back, []), "s")
        contexts = live_contexts(page)
        yield Row("20 editors, contexts", f"WebGL contexts of {shown}", contexts, "")
        yield Row("20 editors, memory", f"browser's memory, {shown}", memory(page), "GB")


def moved(page: Any, i: int, effort: Effort) -> list[float]:
    """Seconds from setting the sun of editor ``i`` until its canvas shows it."""
    elevations = [2 + 1.3 * k % 15 for k in range(effort.runs + 2)]
    seconds: list[float] = page.evaluate(_MOVE, [i, elevations])
    return seconds[2:]


def memory(page: Any) -> float:
    """Return the resident memory of the browser's processes in GB; NaN where it is not told."""
    session = page.context.browser.new_browser_cdp_session()
    processes = session.send("SystemInfo.getProcessInfo")["processInfo"]
    session.detach()
    total = 0
    for process in processes:
        status = Path(f"/proc/{process['id']}/status")
        if not status.exists():
            return float("nan")
        facts = dict(line.split(":", 1) for line in status.read_text().splitlines())
        total += int(facts["VmRSS"].split()[0]) if "VmRSS" in facts else 0
    return total / 1e6
