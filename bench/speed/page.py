"""The built front end in Chromium, on the page that the browser tests use."""

from __future__ import annotations

import statistics
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from .timing import Times

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "browser"))

from chromium import chromium, open_page, widget_state

DRAG = 5  # frames that are drawn in a row
# Frames follow each other as in a drag, each waited for by reading a pixel where it is drawn. The
# visible canvas, a copy, is read once at the end: reading it each time would cost as much again.
# The sum of some of its levels tells whether it changed.
_DRAW = """([edits, size]) => {
  const begin = performance.now();
  for (const edit of edits) {
    frame.draw(edit, size);
    const { gl } = frame.graph;
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
  const { data } = frame.context.getImageData(0, 0, size[0], Math.min(size[1], 64));
  const seconds = (performance.now() - begin) / edits.length / 1000;
  return [seconds, data.reduce((sum, level) => sum + level, 0)];
}"""
_RENDERER = """() => {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  return gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
}"""


@contextmanager
def opened() -> Iterator[Any]:
    """Open the page in a browser of its own."""
    with chromium() as browser:
        yield open_page(browser.new_context(viewport={"width": 1180, "height": 860}))


def browser_seconds(page: Any) -> float:
    """Return the processor time of all of the browser's processes so far."""
    session = page.context.browser.new_browser_cdp_session()
    processes = session.send("SystemInfo.getProcessInfo")["processInfo"]
    session.detach()
    return float(sum(process["cpuTime"] for process in processes))


def dragged(page: Any, edits: list[dict[str, Any]], size: tuple[int, int]) -> Times:
    """Draw ``edits`` in turn with the page's ``frame``; seconds a frame.

    The first frame is not counted: it compiles the shaders and draws what the drag leaves alone.
    """
    page.evaluate(_DRAW, [edits[:1], list(size)])
    times, seen = Times([], []), set()
    for i in range(1, len(edits), DRAG):
        some = edits[i : i + DRAG]
        before = browser_seconds(page)
        seconds, light = page.evaluate(_DRAW, [some, list(size)])
        times.wall.append(seconds)
        times.processor.append((browser_seconds(page) - before) / len(some))
        seen.add(light)
    if len(times.wall) > 1 and len(seen) == 1:
        raise RuntimeError("The canvas never changed: nothing was measured.")
    # Chromium tells processor time in steps; over all drags they hardly count.
    mean = statistics.fmean(times.processor)
    return Times(times.wall, [mean] * len(times.wall))


def driver(page: Any) -> str:
    """Return the name of the browser's WebGL2 renderer."""
    return str(page.evaluate(_RENDERER))


__all__ = [
    "browser_seconds",
    "chromium",
    "dragged",
    "driver",
    "open_page",
    "opened",
    "widget_state",
]
