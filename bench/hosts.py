"""Measure leaks of widgets in a notebook: contexts, memory, listeners, blob URLs.

usage: python bench/hosts.py [--runs 20] [--editors 20]

Runs one cell again and again in a real JupyterLab, and shows many editors in one page. Heap and
listeners are counted after a garbage collection; memory is that of Chromium's processes.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from pathlib import Path
from typing import Any

import sunwidget as sw

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "browser"))

from chromium import (  # noqa: E402 - a folder of the tests
    COUNT_CONTEXTS,
    chromium,
    live_contexts,
    open_page,
    widget_state,
)
from lab import jupyterlab, lab_page, write_notebook  # noqa: E402
from speed.many_editors import memory  # noqa: E402

CELL = """import sunwidget as sw
scene = globals().get("scene") or sw.analyze(sw.sample("coast").preview({side}))
editor = sw.SunEditor(scene)
editor"""
# Blob URLs that were made and not revoked.
COUNT_URLS = """(() => {
  window.urls = new Set();
  const [make, revoke] = [URL.createObjectURL, URL.revokeObjectURL];
  URL.createObjectURL = (blob) => {
    const url = make.call(URL, blob);
    urls.add(url);
    return url;
  };
  URL.revokeObjectURL = (url) => {
    urls.delete(url);
    revoke.call(URL, url);
  };
})()"""


def left(page: Any) -> dict[str, float]:
    """Return the page's resources after a garbage collection."""
    session = page.context.new_cdp_session(page)
    for _ in range(3):
        session.send("HeapProfiler.collectGarbage")
        page.wait_for_timeout(300)
    session.send("Performance.enable")
    metrics = {m["name"]: m["value"] for m in session.send("Performance.getMetrics")["metrics"]}
    session.detach()
    return {
        "contexts": live_contexts(page),
        "blob URLs": page.evaluate("urls.size"),
        "heap MB": metrics["JSHeapUsedSize"] / 1e6,
        "listeners": metrics["JSEventListeners"],
        "nodes": metrics["Nodes"],
        "browser MB": 1000 * memory(page),
    }


def rerun(browser: Any, runs: int, side: int) -> dict[str, dict[str, float]]:
    """Run one cell ``runs`` times in JupyterLab; return the resources after the second and last."""
    found = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_notebook(folder / "again.ipynb", [CELL.format(side=side)])
        with jupyterlab(folder, ROOT) as url:
            context = browser.new_context(viewport={"width": 1300, "height": 1000})
            context.add_init_script(COUNT_CONTEXTS)
            context.add_init_script(COUNT_URLS)
            page = lab_page(context)
            page.goto(url("again.ipynb"))
            cell = page.locator(".jp-Notebook .jp-CodeCell").first
            fresh = page.locator(".sunwidget.sw-live:not([data-run])")
            for run in range(1, runs + 1):
                for _ in range(10):
                    cell.locator(".cm-content").click()
                    page.keyboard.press("Control+Enter")
                    try:
                        fresh.wait_for(timeout=30_000)
                        break
                    except Exception:  # noqa: BLE001 - the kernel was not yet listening
                        continue
                page.wait_for_timeout(500)
                if run in {2, runs}:
                    found[f"run {run}"] = left(page)
                page.evaluate("document.querySelector('.sunwidget').dataset.run = 'old'")
            context.close()
    return found


def many(browser: Any, editors: int, side: int) -> dict[str, dict[str, float]]:
    """Scroll through a page of editors; return the resources with one, all, and after closing."""
    found = {}
    context = browser.new_context(viewport={"width": 1180, "height": 860})
    context.add_init_script(COUNT_CONTEXTS)
    context.add_init_script(COUNT_URLS)
    page = open_page(context)
    state = widget_state(sw.SunEditor(sw.analyze(sw.sample("coast").preview(side))).wait())
    found["empty page"] = left(page)
    for i in range(editors):
        page.evaluate("state => addEditor(state)", state)
        view = page.locator(".sunwidget").nth(i)
        view.scroll_into_view_if_needed()
        view.and_(page.locator(".sw-live")).wait_for()
        if i == 0:
            found["1 editor"] = left(page)
    found[f"{editors} editors"] = left(page)
    page.evaluate("closeAll(); models.length = 0;")
    page.wait_for_timeout(500)
    found["closed"] = left(page)
    context.close()
    return found


def show(title: str, found: dict[str, dict[str, float]]) -> None:
    print(f"\n{title}")
    names = list(next(iter(found.values())))
    print(f"{'':14}" + "".join(f"{name:>12}" for name in names))
    for label, row in found.items():
        cells = (f"{row[n]:.1f}" if n.endswith("MB") else f"{row[n]:.0f}" for n in names)
        print(f"{label:14}" + "".join(f"{cell:>12}" for cell in cells))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--editors", type=int, default=20)
    parser.add_argument("--side", type=int, default=768, help="longer side of the photo")
    parser.add_argument("--only", choices=("rerun", "many"))
    options = parser.parse_args()
    results = {}
    with chromium() as browser:
        if options.only != "rerun":
            results["many"] = many(browser, options.editors, options.side)
            show(f"{options.editors} editors in one page", results["many"])
        if options.only != "many":
            results["rerun"] = rerun(browser, options.runs, options.side)
            show("one cell of JupyterLab, run again", results["rerun"])
    path = ROOT / "build" / "hosts.json"
    path.parent.mkdir(exist_ok=True)
    path.write_text(json.dumps(results, indent=1))
    print(f"\nwritten to {path.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
