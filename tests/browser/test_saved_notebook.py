"""A notebook that JupyterLab saves with its widgets' state, and what it shows when it is opened."""

import pytest
from lab import notebook_page, run_cell

pytestmark = [pytest.mark.browser, pytest.mark.timeout(400)]

EDITOR = [
    """import sunwidget as sw
editor = sw.SunEditor(sw.sample("coast"), sun_elevation=-3)
editor""",
    "sw.SkyExplorer()",
]
SAVE_STATE = "jupyterapp.commands.execute('@jupyter-widgets/jupyterlab-manager:saveWidgetState')"
SAVE = "jupyterapp.commands.execute('docmanager:save')"
SHUT_DOWN = "jupyterapp.serviceManager.sessions.shutdownAll()"
LIVE = ".sw-editor.sw-live[data-stage='ready']"


def test_a_saved_notebook_is_small_and_shows_its_picture_without_a_kernel(
    browser, tmp_path, root, screenshots
):
    failed = screenshots / "saved-failed.png"
    view = {"width": 1366, "height": 700}
    with notebook_page(browser, tmp_path, root, EDITOR, failed=failed, viewport=view) as page:
        page.wait_for_function("window.jupyterapp", timeout=20_000)
        page.locator(LIVE).wait_for()
        run_cell(page, 1)
        page.locator(".sw-explorer.sw-live").wait_for()
        page.locator(LIVE).scroll_into_view_if_needed()
        page.screenshot(path=screenshots / "saved-1-before.png")
        page.evaluate(SAVE_STATE)
        page.wait_for_timeout(1000)
        page.evaluate(SAVE)
        page.wait_for_timeout(2500)
        text = (tmp_path / "cells.ipynb").read_text("utf-8")
        assert '"_saved": true' in text, "the widgets' state was not saved"
        size = len(text.encode()) / 1e6
        print(f"a saved notebook with editor and explorer: {size:.2f} MB")
        assert size <= 1.0, "half a megabyte a widget"

        # The kernel still has everything.
        page.reload()
        page.locator(LIVE).wait_for()
        page.evaluate(SHUT_DOWN)
        page.wait_for_timeout(2000)
        page.evaluate("window.left = true")
        page.reload()
        editor = page.locator(".sw-editor")
        editor.get_by_text("as it was saved").wait_for()
        photo = editor.locator(".sw-photo")
        assert photo.evaluate("(image) => image.naturalWidth") == 640
        editor.scroll_into_view_if_needed()
        page.wait_for_timeout(500)
        page.screenshot(path=screenshots / "saved-2-opened.png")
        run_cell(page, 0)
        page.locator(LIVE).wait_for()
