"""The short way in Notebook 7: open, drag the sun, read the edit in Python."""

import json

import numpy as np
import pytest
from chromium import COUNT_CONTEXTS, drag_sun, live_contexts
from lab import canvas_of, notebook_page, run_cell, run_cell_that_writes

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]

CELLS = [
    "import sunwidget as sw\neditor = sw.SunEditor(sw.sample('coast').preview(384))\neditor",
    # What the drag has sent is taken in by another thread than the one that runs cells.
    """import json, time
from pathlib import Path
until = time.monotonic() + 60
while editor.sun_elevation is None and time.monotonic() < until:
    time.sleep(0.1)
time.sleep(0.1)
Path("edit.json").write_text(json.dumps(editor.edit.to_dict()))""",
]


def test_dragging_the_sun_in_notebook_7(browser, tmp_path, root, screenshots):
    with notebook_page(
        browser,
        tmp_path,
        root,
        CELLS,
        failed=screenshots / "notebook7-failed.png",
        app="notebook",
        script=COUNT_CONTEXTS,
        viewport={"width": 1300, "height": 1000},
    ) as page:
        page.locator(".sunwidget.sw-live[data-stage='ready']").wait_for()
        photo = canvas_of(page)
        assert photo.std() > 10, "the canvas is uniform"
        drag_sun(page)
        assert np.abs(canvas_of(page).astype(int) - photo).mean() > 2
        edit = json.loads(run_cell_that_writes(page, 1, tmp_path / "edit.json"))
        assert {"sun_azimuth", "sun_elevation"} <= edit.keys()
        page.screenshot(path=screenshots / "notebook7.png")
        # Running the cell again leaves nothing of the first editor.
        page.evaluate("document.querySelector('.sunwidget').dataset.run = 'first'")
        run_cell(page, 0)
        page.locator(".sunwidget.sw-live:not([data-run])").wait_for()
        assert page.locator("[data-run]").count() == 0
        assert live_contexts(page) == 1
