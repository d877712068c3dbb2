"""Walk through the editor in a real JupyterLab, with a screenshot at every step.

usage: python scripts/tour.py [--theme light] [--photo beach.jpg] [-o build/tour]

For looking, not for judging: what must hold is asserted in tests/browser. It opens a photo,
drags the sun, paints a stroke, sets the horizon, takes a preset, undoes, plays with the clock,
zooms, splits, compares, exports, copies the code and runs it, restarts the kernel and reloads
the page.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "browser"))

# The tests' browser and notebook server, which lie in a folder and not in a package.
from chromium import chromium  # noqa: E402
from lab import jupyterlab, lab_page, run_cell, write_notebook  # noqa: E402

SIZE = {"width": 1400, "height": 1000}
PLACE = {"latitude": 43.3, "longitude": 16.4, "date": "2026-06-21"}


def cells(photo: str | None) -> list[str]:
    """Return the notebook's cells."""
    source = f"sw.open({photo!r})" if photo else "sw.sample('coast')"
    return [
        f"import sunwidget as sw\neditor = sw.SunEditor({source})\neditor",
        "editor.save('evening.png', overwrite=True)",
        "exec(CODE)\nedit == editor.edit",
        "sw.Compare(editor.scene, ['ratio', 'thesis', 'thesis_literal'])",
        f"editor.set_place(**{PLACE}, time=17.2)\neditor.time = 17.9",
    ]


class Tour:
    """One walk; ``step(name)`` takes a picture and says how long it took to get there."""

    def __init__(self, page: Any, folder: Path) -> None:
        self.page, self.folder, self.number = page, folder, 0
        self.since = time.perf_counter()
        self.editor = page.locator(".sunwidget").first

    def step(self, name: str) -> None:
        """Let the page come to rest and take its picture."""
        self.page.wait_for_timeout(900)
        self.number += 1
        path = self.folder / f"{self.number:02d}-{name}.png"
        self.page.screenshot(path=path)
        now = time.perf_counter()
        print(f"{path.name}: {now - self.since:.1f} s")
        self.since = now

    def drag(self, start: tuple[float, float], by: tuple[float, float], shot: str = "") -> None:
        """Drag from a place by CSS pixels; ``shot`` is a step taken before the hand lets go."""
        mouse = self.page.mouse
        mouse.move(*start)
        mouse.down()
        mouse.move(start[0] + by[0], start[1] + by[1], steps=12)
        if shot:
            self.step(shot)
        mouse.up()

    def middle(self, selector: str) -> tuple[float, float]:
        """Return where the middle of a part of the editor is."""
        box = self.editor.locator(selector).first.bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def on_picture(self, x: float, y: float) -> tuple[float, float]:
        """Return where a place of the picture, in fractions of it, is."""
        box = self.editor.locator(".sw-picture").bounding_box()
        return box["x"] + x * box["width"], box["y"] + y * box["height"]

    def ready(self) -> None:
        """Wait until the kernel has answered."""
        self.page.locator(".sunwidget.sw-live[data-stage='ready']").first.wait_for()


def walk(page: Any, address: str, folder: Path) -> None:
    """Take all steps on a page of JupyterLab."""
    page.goto(address)
    page.locator(".jp-Notebook .jp-CodeCell").first.wait_for()
    tour = Tour(page, folder)
    keys = page.keyboard
    run_cell(page, 0)
    tour.editor.locator(".sw-has-photo").wait_for()
    tour.step("open")
    tour.ready()
    tour.editor.scroll_into_view_if_needed()
    tour.step("analysed")

    tour.drag(tour.middle(".sw-sun-ring"), (-160, 70), "dragging")
    tour.step("dragged")

    tour.editor.get_by_role("radio", name="Brush: not sky").click()
    tour.drag(tour.on_picture(0.06, 0.4), (110, 12), "stroke")
    tour.ready()
    tour.step("stroke-answered")

    tour.editor.get_by_role("radio", name="Set the horizon").click()
    tour.step("horizon")
    tour.editor.get_by_role("radio", name="Move the sun").click()

    tour.editor.locator(".sw-presets button").nth(3).click()
    tour.step("preset-sunset")
    keys.press("Control+z")
    tour.step("undone")
    tour.editor.locator(".sw-presets button").nth(3).click()

    run_cell(page, 4)
    tour.ready()
    tour.editor.scroll_into_view_if_needed()
    tour.step("time-and-sun-path")

    page.mouse.move(*tour.on_picture(0.5, 0.6))
    tour.editor.locator(".sw-sun").focus()
    keys.press("s")
    tour.step("split")
    keys.press("s")
    keys.press("z")
    tour.step("zoom-100")
    keys.press("0")
    keys.press("?")
    tour.step("keys")
    keys.press("Escape")
    tour.editor.get_by_role("button", name="Menu").first.click()
    tour.step("menu")
    keys.press("Escape")

    tour.editor.get_by_role("button", name="Menu").first.click()
    page.get_by_role("menuitem", name="Copy as Python").click()
    code = page.evaluate("navigator.clipboard.readText()")
    print(code)
    cell = page.locator(".jp-Notebook .jp-CodeCell").nth(2).locator(".cm-content")
    cell.click()
    keys.press("Control+a")
    keys.insert_text(f"CODE = {code!r}\n{cells(None)[2]}")
    run_cell(page, 2)
    tour.step("code-copied-and-run")
    run_cell(page, 1)
    tour.step("exported")
    run_cell(page, 3)
    page.locator(".sw-compare").first.wait_for()
    page.wait_for_timeout(4000)
    page.locator(".sw-compare").first.scroll_into_view_if_needed()
    tour.step("compare")

    tour.editor.scroll_into_view_if_needed()
    page.get_by_role("menuitem", name="Kernel").first.click()
    page.get_by_role("menuitem", name="Restart Kernel…").first.click()
    # The question is answered by the page itself before its next click.
    page.locator(".jp-Notebook .cm-content").last.click()
    page.wait_for_timeout(6000)
    tour.editor.scroll_into_view_if_needed()
    tour.step("kernel-restarted")
    tour.drag(tour.middle(".sw-sun-ring"), (60, -40))
    tour.step("dragged-without-kernel")
    run_cell(page, 0)
    page.wait_for_timeout(3000)
    tour.ready()
    tour.step("cell-run-again")
    restore = tour.editor.get_by_role("button", name="Restore")
    if restore.count():
        restore.first.click()
    tour.step("edit-restored")

    keys.press("Control+s")
    page.wait_for_timeout(2000)
    page.reload()
    page.locator(".sunwidget").first.wait_for()
    tour.ready()
    page.locator(".sunwidget").first.scroll_into_view_if_needed()
    tour.step("page-reloaded")


def main() -> None:
    """Take the tour that the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--theme", choices=["dark", "light"], default="dark")
    parser.add_argument("--photo")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "build" / "tour")
    given = parser.parse_args()
    folder = given.output / given.theme
    folder.mkdir(parents=True, exist_ok=True)
    theme = f"JupyterLab {given.theme.title()}"
    with tempfile.TemporaryDirectory() as home, chromium() as browser:
        notebooks = Path(home)
        write_notebook(notebooks / "tour.ipynb", cells(given.photo))
        with jupyterlab(notebooks, ROOT, theme=theme) as url:
            context = browser.new_context(
                viewport=SIZE,
                color_scheme=given.theme,
                permissions=["clipboard-read", "clipboard-write"],
            )
            page = lab_page(context)
            try:
                walk(page, url("tour.ipynb"), folder)
            except BaseException:
                page.screenshot(path=folder / "failed.png")
                raise


if __name__ == "__main__":
    main()
