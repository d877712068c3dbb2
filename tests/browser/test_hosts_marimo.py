"""The short way in marimo: open, drag the sun, and the cells that read the editor run again."""

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from chromium import COUNT_CONTEXTS, PATIENCE, drag_sun, live_contexts, picture_of
from marimo_host import marimo, write_notebook

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]

CELLS = [
    "import json\nfrom pathlib import Path\nimport marimo as mo\nimport sunwidget as sw",
    """scene = sw.analyze(sw.sample("coast").preview(256))
editor = mo.ui.anywidget(sw.SunEditor(sw.sample("coast").preview(256)))
editor""",
    """_ = Path("edit.json").write_text(json.dumps(editor.edit.to_dict()))""",
    "sw.SunEditor(scene)",
]


def canvas_of(view):
    canvas = view.locator(".sw-canvas")
    return picture_of(canvas.evaluate("c => c.toDataURL('image/png').split(',')[1]")).astype(int)


def test_dragging_the_sun_in_marimo(browser, tmp_path, root, screenshots):
    write_notebook(tmp_path / "short.py", CELLS)
    with marimo(tmp_path, root, "short.py") as url:
        context = browser.new_context(viewport={"width": 1300, "height": 1000})
        context.add_init_script(COUNT_CONTEXTS)
        page = context.new_page()
        page.set_default_timeout(PATIENCE)
        try:
            page.goto(url)
            views = page.locator(".sunwidget")
            ready = page.locator(".sw-live[data-stage='ready']")
            # As marimo's element, and as the widget itself.
            for i in range(2):
                views.nth(i).scroll_into_view_if_needed()
                views.nth(i).and_(ready).wait_for()
                photo = canvas_of(views.nth(i))
                assert photo.std() > 10, "the canvas is uniform"
                drag_sun(page, i)
                assert np.abs(canvas_of(views.nth(i)) - photo).mean() > 2
                assert views.nth(i).get_by_role("alert").count() == 0
                page.screenshot(path=screenshots / f"marimo-{i + 1}.png")
            # The cell that reads the editor has run again, with the last value.
            said = views.first.locator(".sw-readout").text_content()
            for _ in range(PATIENCE // 250):
                edit = json.loads((tmp_path / "edit.json").read_text())
                if f"{edit.get('sun_elevation', 0):.1f}° elevation" in said:
                    break
                page.wait_for_timeout(250)
            else:
                raise AssertionError(f"the cell has {edit}, the editor {said}")
            # Running the cells again leaves nothing of the first editors.
            views.first.evaluate("view => { view.dataset.run = 'first'; }")
            page.locator(".cm-content").nth(1).click()
            page.keyboard.press("Control+Enter")
            views.first.and_(page.locator(":not([data-run])")).and_(ready).wait_for()
            assert live_contexts(page) <= 2
        except BaseException:
            page.screenshot(path=screenshots / "marimo-failed.png")
            raise
        finally:
            context.close()


def test_render_static_stays_live_in_the_page_that_marimo_exports(browser, tmp_path, screenshots):
    cell = """import sunwidget as sw
sw.SunEditor(sw.sample("coast").preview(256)).render_static()"""
    write_notebook(tmp_path / "page.py", [cell])
    command = [sys.executable, "-m", "marimo", "export", "html", "page.py", "-o", "page.html"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-4000:]
    context = browser.new_context(viewport={"width": 1100, "height": 1000})
    context.set_default_timeout(PATIENCE)
    page = context.new_page()
    page.route(re.compile("^https:"), from_package)
    page.goto((tmp_path / "page.html").as_uri())
    inner = page.locator("iframe[srcdoc]").content_frame
    inner.locator(".sunwidget.sw-live").wait_for()
    readout = inner.locator(".sw-readout").first
    before = readout.text_content()
    inner.get_by_role("slider", name="Elevation").first.focus()
    page.keyboard.press("ArrowRight")
    page.wait_for_timeout(500)
    page.screenshot(path=screenshots / "marimo-export.png")
    assert readout.text_content() != before
    context.close()


def from_package(route):
    """Answer what an exported page asks of a network with the same file of marimo itself."""
    import marimo

    found = re.search(r"/@marimo-team/frontend@[^/]*/dist/([^?]*)", route.request.url)
    file = Path(marimo.__file__).parent / "_static" / (found[1] if found else "missing")
    if not file.is_file():
        route.abort()
        return
    route.fulfill(path=file, headers={"Access-Control-Allow-Origin": "*"})
