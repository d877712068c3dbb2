"""The short way in marimo: open, drag the sun, and the cells that read the editor run again."""

import json

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
