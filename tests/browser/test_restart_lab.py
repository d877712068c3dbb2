"""Nothing is lost in a real JupyterLab: the kernel restarts in the middle of a drag, the cell runs
again, and the page is loaded again while the kernel lives."""

import json

import pytest
from lab import notebook_page, run_cell, run_cell_that_writes

pytestmark = [pytest.mark.browser, pytest.mark.timeout(600)]

CELLS = [
    "import sunwidget as sw\neditor = sw.SunEditor(sw.sample('coast').preview(384))\neditor",
    """import json
from pathlib import Path
Path("kept.json").write_text(json.dumps({
    "edit": editor.edit.to_dict(),
    "past": editor._history["past"],
    "versions": {name: edit.to_dict() for name, edit in editor.versions.items()},
}))""",
]
# As a person's click does, but while the mouse button is down on the sun.
RESTART = """async () => {
  document
    .querySelector('[data-command="notebook:restart-kernel"]')
    .dispatchEvent(new MouseEvent("mousedown", { bubbles: true }));
  let accept;
  while (!(accept = document.querySelector(".jp-Dialog .jp-mod-accept"))) {
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  accept.click();
}"""


def test_no_edit_is_lost_when_the_kernel_restarts_and_the_page_is_loaded_again(
    browser, tmp_path, root, screenshots
):
    failed, size = screenshots / "restart-failed.png", {"width": 1300, "height": 1000}
    with notebook_page(browser, tmp_path, root, CELLS, failed=failed, viewport=size) as page:
        editor = page.locator(".sunwidget")
        page.locator(".sunwidget.sw-live[data-stage='ready']").wait_for()
        editor.scroll_into_view_if_needed()

        slider = editor.get_by_role("slider", name="Azimuth")
        slider.focus()
        page.keyboard.press("ArrowRight")
        undo = editor.get_by_role("button", name="Undo", exact=True)
        assert undo.get_attribute("title") == "Undo: Sun azimuth (Ctrl+Z)"
        box = editor.locator(".sw-sun-ring").bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x - 60, y + 20, steps=3)
        page.evaluate(RESTART)
        page.locator(".sunwidget[data-kernel='lost']").wait_for()
        page.mouse.move(x - 120, y + 40, steps=3)
        page.mouse.up()
        editor.get_by_text("The kernel of this editor is gone").wait_for()
        editor.get_by_role("button", name="Versions").click()
        editor.get_by_label("Name of the version").fill("warm")
        page.keyboard.press("Enter")
        page.keyboard.press("Escape")
        readout = editor.locator(".sw-readout").text_content()
        page.screenshot(path=screenshots / "restart-1-kernel-gone.png")

        page.evaluate("document.querySelector('.sunwidget').dataset.run = 'first'")
        run_cell(page, 0)
        page.locator(".sunwidget.sw-live:not([data-run])").wait_for()
        assert editor.locator(".sw-readout").text_content() != readout
        page.screenshot(path=screenshots / "restart-2-offered.png")
        editor.get_by_role("button", name="Restore").click()
        assert editor.locator(".sw-readout").text_content() == readout
        kept = json.loads(run_cell_that_writes(page, 1, tmp_path / "kept.json"))
        assert {"sun_azimuth", "sun_elevation"} <= kept["edit"].keys()
        # Lab's question takes the focus from the sun, so the drag may be two steps.
        steps = [set(step) - {"version"} for step in kept["past"]]
        assert steps[:2] == [set(), {"sun_azimuth"}]
        assert kept["versions"] == {"warm": kept["edit"]}

        page.keyboard.press("Control+s")
        page.wait_for_timeout(1500)
        page.reload()
        page.locator(".sunwidget.sw-live[data-stage='ready']").wait_for()
        assert editor.locator(".sw-readout").text_content() == readout
        assert editor.get_by_role("button", name="Restore").count() == 0
        page.screenshot(path=screenshots / "restart-3-loaded-again.png")
        assert undo.get_attribute("title") == "Undo: Sun moved (Ctrl+Z)"
        undo.click()
        (tmp_path / "kept.json").unlink()
        undone = json.loads(run_cell_that_writes(page, 1, tmp_path / "kept.json"))
        assert undone["edit"] == kept["past"][-1] | {"version": 1}
        assert undone["versions"] == kept["versions"]
