"""A notebook that is saved with its widgets' state, and what it shows when it is opened."""

import json

import pytest
from kept import CELLS, READY, megabytes, page_of_widgets, run_by_nbclient, save, states_of
from lab import notebook_page, run_cell

pytestmark = [pytest.mark.browser, pytest.mark.timeout(400)]

MOST = 0.6  # MB of a notebook's file, a widget
SHUT_DOWN = "jupyterapp.serviceManager.sessions.shutdownAll()"


def test_a_saved_notebook_is_small_and_shows_its_pictures_without_a_kernel(
    browser, tmp_path, root, screenshots
):
    failed = screenshots / "saved-failed.png"
    view = {"width": 1366, "height": 900}
    with page_of_widgets(browser, tmp_path, root, failed=failed, viewport=view) as page:
        save(page)
        sizes = megabytes(tmp_path / "cells.ipynb")
        print("saved by JupyterLab:", {name: f"{size:.2f} MB" for name, size in sizes.items()})
        assert max(sizes.values()) <= MOST

        # The kernel still has everything.
        page.reload()
        page.locator(READY["SunEditor"]).wait_for()
        page.locator(".sw-compare").scroll_into_view_if_needed()
        page.locator(READY["Compare"]).wait_for()
        page.locator(".sw-study").get_by_role("button", name="Start").click()
        assert page.locator(".sw-study-picture img").first.evaluate("(i) => i.naturalWidth") > 1000

        page.evaluate(SHUT_DOWN)
        page.wait_for_timeout(2000)
        page.reload()
        editor, compare = page.locator(".sw-editor"), page.locator(".sw-compare")
        editor.get_by_text("a saved picture").wait_for()
        photo = editor.locator(".sw-photo")
        assert photo.evaluate("(image) => image.naturalWidth") == 640
        assert editor.locator(".sw-panel").evaluate("(panel) => panel.inert"), "no map follows it"
        editor.scroll_into_view_if_needed()
        page.wait_for_timeout(500)
        page.screenshot(path=screenshots / "saved-editor.png")
        compare.get_by_text("a saved picture").wait_for()
        widths = compare.locator(".sw-compare-canvas").evaluate_all(
            "(all) => all.map((c) => c.width)"
        )
        assert len(widths) == 3
        assert all(300 < width <= 554 for width in widths)  # 960 pixels are shared by three
        compare.scroll_into_view_if_needed()
        page.screenshot(path=screenshots / "saved-compare.png")
        study = page.locator(".sw-study")
        study.get_by_text("Run the cell to start").wait_for()
        pair = study.get_by_role("img")
        assert pair.evaluate("(image) => image.naturalWidth") == 804  # 400 pixels each
        study.scroll_into_view_if_needed()
        page.screenshot(path=screenshots / "saved-study.png")
        run_cell(page, 0)
        page.locator(READY["SunEditor"]).wait_for()


def test_an_editor_that_was_never_shown_is_saved_as_lightly(browser, tmp_path, root, screenshots):
    cells = ['import sunwidget as sw\neditor = sw.SunEditor(sw.sample("coast")).wait()']
    failed = screenshots / "saved-unseen-failed.png"
    with notebook_page(browser, tmp_path, root, cells, failed=failed) as page:
        page.wait_for_function("window.jupyterapp", timeout=20_000)
        page.locator(".jp-InputPrompt", has_text="[1]:").first.wait_for()
        page.wait_for_timeout(2000)
        save(page)
        assert '"_saved": true' in (tmp_path / "cells.ipynb").read_text("utf-8")
        assert (tmp_path / "cells.ipynb").stat().st_size / 1e6 <= MOST


def test_what_a_program_runs_and_saves_is_as_small(tmp_path):
    path = run_by_nbclient(tmp_path)
    sizes = megabytes(path)
    print("run by nbclient:", {name: f"{size:.2f} MB" for name, size in sizes.items()})
    assert max(sizes.values()) <= MOST
    notebook = json.loads(path.read_text("utf-8"))
    for name, cell in zip(CELLS, notebook["cells"], strict=True):
        assert any("image/png" in output.get("data", {}) for output in cell["outputs"]), name
    states = states_of(notebook)
    assert states["SunEditor"]["state"]["sun_elevation"] == -3
    assert states["SunEditor"]["state"]["_saved"] == "photo"
    # The front end is there: an editor inside a container is shown by it.
    assert len(states["SunEditor"]["state"]["_esm"]) > 100_000
