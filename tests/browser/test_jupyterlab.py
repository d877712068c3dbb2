"""The whole way in a real JupyterLab: open, drag the sun, and the kernel exports the same frame."""

import json

import numpy as np
import pytest
from lab import canvas_of, notebook_page, run_cell_that_writes
from PIL import Image

pytestmark = [pytest.mark.browser, pytest.mark.timeout(600)]

CELLS = [
    "import sunwidget as sw\neditor = sw.SunEditor(sw.sample('coast'))\neditor",
    """import json
from pathlib import Path
from PIL import Image
Image.fromarray(editor.render()).save("kernel.png")
Path("kernel.json").write_text(json.dumps(editor.edit.to_dict()))""",
    """editor.undo()
Path("undone.json").write_text(json.dumps(editor.edit.to_dict()))""",
    """editor.sun_elevation = 21.5
try:
    editor.sun_elevation = 300
except Exception as error:
    refused = str(error)
Path("refused.txt").write_text(f"{editor.sun_elevation} {refused}")""",
    'Path("stroked.json").write_text(json.dumps(editor.edit.to_dict()))',
]


def test_dragging_the_sun_in_jupyterlab_shows_what_the_kernel_exports(
    browser, tmp_path, root, screenshots
):
    failed, size = screenshots / "lab-failed.png", {"width": 1400, "height": 1000}
    with notebook_page(browser, tmp_path, root, CELLS, failed=failed, viewport=size) as page:
        editor = page.locator(".sunwidget")
        editor.locator(".sw-has-photo").wait_for()
        page.screenshot(path=screenshots / "lab-1-photo.png")
        page.locator(".sunwidget.sw-live[data-stage='ready']").wait_for()
        editor.scroll_into_view_if_needed()
        page.wait_for_timeout(1000)
        page.screenshot(path=screenshots / "lab-2-analysed.png")

        photo = canvas_of(page)
        assert photo.std() > 10, "the canvas is uniform"

        box = editor.locator(".sw-sun-ring").bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x - 120, y + 60, steps=12)
        page.screenshot(path=screenshots / "lab-3-dragging.png")
        page.mouse.up()
        # The frame settles at full size.
        page.wait_for_function(
            "w => document.querySelector('.sunwidget .sw-canvas').width === w", arg=1536
        )
        page.wait_for_timeout(1500)
        page.screenshot(path=screenshots / "lab-4-dragged.png")
        canvas = canvas_of(page)
        assert np.abs(canvas.astype(int) - photo).mean() > 2, "the drag moved nothing"

        edit = json.loads(run_cell_that_writes(page, 1, tmp_path / "kernel.json"))
        assert {"sun_azimuth", "sun_elevation"} <= edit.keys()
        kernel = np.asarray(Image.open(tmp_path / "kernel.png"))
        assert kernel.shape == canvas.shape
        away = np.abs(canvas.astype(int) - kernel)
        print(f"canvas against export: mean {away.mean():.4f}/255, max {away.max()}/255")
        assert away.mean() <= 1
        assert away.max() <= 3

        # One drag is one step, also for Python.
        undone = json.loads(run_cell_that_writes(page, 2, tmp_path / "undone.json"))
        assert undone == {"version": 1}

        # What Python sets is shown, what it must not set is refused.
        answer = run_cell_that_writes(page, 3, tmp_path / "refused.txt")
        assert answer.startswith("21.5 sun_elevation = 300 is outside -12 to 90")
        page.wait_for_function(
            "document.querySelector('.sw-readout').textContent.includes('21.5°')"
        )
        page.screenshot(path=screenshots / "lab-5-from-python.png")

        # A map comes when it is asked for, and a stroke changes it.
        editor.get_by_label("Show").select_option("sky")
        editor.locator(".sw-legend:not(.sw-waiting)").wait_for()
        clear = "a => document.querySelector('.sw-map').getContext('2d').getImageData(...a)"
        place = page.evaluate(
            """() => {
              const { width, height } = document.querySelector(".sw-map");
              return [Math.round(0.5 * width), Math.round(0.93 * height), 1, 1];
            }"""
        )
        assert page.evaluate(f"({clear})({place}).data[3]") < 60
        editor.get_by_role("radio", name="Brush: sky").click()
        box = editor.locator(".sw-picture").bounding_box()
        row = box["y"] + 0.93 * box["height"]
        page.mouse.move(box["x"] + 0.4 * box["width"], row)
        page.mouse.down()
        page.mouse.move(box["x"] + 0.6 * box["width"], row, steps=8)
        page.mouse.up()
        # The next stroke does not wait for the answer to this one.
        assert editor.get_attribute("data-stage") == "analysing"
        page.mouse.move(box["x"] + 0.1 * box["width"], row)
        page.mouse.down()
        page.mouse.move(box["x"] + 0.3 * box["width"], row, steps=4)
        page.mouse.up()
        page.screenshot(path=screenshots / "lab-6-stroke.png")
        page.wait_for_function(f"({clear})({place}).data[3] > 100")
        stroked = json.loads(run_cell_that_writes(page, 4, tmp_path / "stroked.json"))
        assert [stroke["label"] for stroke in stroked["strokes"]] == ["sky", "sky"]
        page.screenshot(path=screenshots / "lab-7-answered.png")
