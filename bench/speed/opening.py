"""From opening a photo to its picture on the page and to an editor that follows the hand.

In a real JupyterLab: the time runs from the key that runs the cell. What the kernel does of it is
measured beside, in this process.
"""

from __future__ import annotations

import compileall
import tempfile
from pathlib import Path
from typing import Any

import sunwidget as sw
from sunwidget.widgets.kernel.payload import MAP_TRAITS, encode_maps, encode_preview, scene_json

from .effort import Effort
from .page import chromium, widget_state
from .pictures import photo_file
from .rows import Row, Rows, of_times
from .timing import Times, clock

KEYS = ("first picture", "editable")
ROOT = Path(__file__).resolve().parents[2]
IMPORT = "import sunwidget as sw"
EDITOR = 'editor = sw.SunEditor("{photo}")\neditor'
# Moments at which the editor first shows the photo, and first a frame of its own.
WATCH = """
window.moments = {};
const note = () => {
  for (const [name, selector] of [["picture", ".sw-has-photo"], ["editable", ".sw-live"]]) {
    if (!(name in moments) && document.querySelector(selector)) moments[name] = performance.now();
  }
};
addEventListener("keydown", ({ key }) => {
  if (key === "Enter") window.begin = performance.now();
}, { capture: true });
const all = { subtree: true, childList: true, attributeFilter: ["class"] };
new MutationObserver(note).observe(document, all);
"""


def rows(effort: Effort) -> Rows:
    what = f"{effort.photo:g} MP"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        photo = photo_file(folder, effort.photo)
        yield from in_kernel(photo, what)
        seconds = in_lab(folder, photo)
    yield Row("first picture", f"JupyterLab: open {what} → first picture", seconds["picture"], "s")
    yield Row(
        "editable", f"JupyterLab: open {what} → analyzed and editable", seconds["editable"], "s"
    )
    yield Row("run again", "JupyterLab: the cell again → editable", seconds["again"], "s")


def in_kernel(photo: Path, what: str) -> Rows:
    """What each step takes in the kernel."""
    steps: dict[str, Times] = {}

    def step(name: str, work: Any) -> Any:
        times = steps[name] = Times([], [])
        with clock(times):
            return work()

    opened = step("open the file", lambda: sw.open(photo))
    step("make and encode the preview", lambda: encode_preview(opened))
    scene = step("analyse", lambda: sw.analyze(opened))
    step("encode the maps", lambda: encode_maps(scene))
    step("describe the scene", lambda: scene_json(scene, 1))
    for name, times in steps.items():
        yield of_times(f"kernel: {name}", f"  kernel, {what}: {name}", times, "s")
    for name, seconds in scene.timings.items():
        yield Row(f"analyse: {name}", f"    {name}", seconds, "s")
    state = widget_state(sw.SunEditor(scene).wait())
    for name in ("_photo", *MAP_TRAITS):
        size = len(state[name]) * 3 / 4 / 1e6
        yield Row(f"message {name}", f"  kernel → page: {name[1:]}", size, "MB")


def in_lab(folder: Path, photo: Path) -> dict[str, float]:
    """Seconds from running the cell in a real JupyterLab until the page shows this and that."""
    from lab import notebook_page, run_cell

    compileall.compile_dir(ROOT / "sunwidget", quiet=2)  # as in an installed package
    cell = EDITOR.format(photo=photo.name)
    seconds: dict[str, float] = {}
    with (
        chromium() as browser,
        notebook_page(
            browser,
            folder,
            ROOT,
            [IMPORT, cell, cell],
            failed=ROOT / "build" / "bench-opening.png",
            script=WATCH,
            viewport={"width": 1300, "height": 1000},
        ) as page,
    ):
        page.wait_for_timeout(1500)  # the import, and JupyterLab's own start
        for number, wanted in (
            (1, {"picture": "picture", "editable": "editable"}),
            (2, {"editable": "again"}),
        ):
            page.evaluate("document.querySelector('.sunwidget')?.remove(); window.moments = {}")
            run_cell(page, number)
            page.wait_for_function("'editable' in window.moments", timeout=120_000)
            for name, kept in wanted.items():
                found = page.evaluate("name => (moments[name] - begin) / 1000", name)
                seconds[kept] = float(found)
    return seconds
