"""In a real JupyterLab: the whole way of a photo; a kernel restarted, a page loaded again and two
tabs on one kernel, without a loss; and the SkyExplorer."""

import json
import tempfile
from pathlib import Path

import numpy as np
import pytest
from chromium import picture_of
from lab import canvas_of, jupyterlab, lab_page, notebook_page, run_cell, run_cell_that_writes
from PIL import Image

pytestmark = [pytest.mark.browser, pytest.mark.timeout(600)]

WAY = [
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
KEPT = [
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
# The sun's place is written with the next frame.
SHOWS = "(text) => document.querySelector('.sw-readout')?.textContent === text"
EXPLORER = [
    "import sunwidget as sw\nexplorer = sw.SkyExplorer(sun_size=0)\nexplorer",
    """import json
from pathlib import Path
from PIL import Image
width, height = json.loads(Path("size.json").read_text())
Image.fromarray(explorer.render(size=(width, height))).save("kernel.png")
Path("kernel.json").write_text(json.dumps([explorer.sun_azimuth, explorer.sun_elevation]))""",
    """explorer.set_place(41.0, 29.0, "2024-06-21")
explorer.time = 17.25
Path("evening.json").write_text(json.dumps(explorer.sun_elevation))""",
    """code = "PASTED"
again = eval(code.split("\\n")[-1])
Path("again.json").write_text(json.dumps([again.sun_elevation, again.date, again.show_ozone]))""",
]


@pytest.fixture(scope="module")
def lab_folder(tmp_path_factory):
    return tmp_path_factory.mktemp("lab")


@pytest.fixture(scope="module")
def lab_url(lab_folder, root):
    """One server for all tests: starting one takes longer than what most of them do."""
    with jupyterlab(lab_folder, root) as url:
        yield url


@pytest.fixture
def folder(lab_folder):
    """Where a test's notebook lies, and what its cells write."""
    return Path(tempfile.mkdtemp(dir=lab_folder))


def test_dragging_the_sun_in_jupyterlab_shows_what_the_kernel_exports(
    browser, folder, root, lab_url, screenshots
):
    failed, size = screenshots / "lab-failed.png", {"width": 1400, "height": 1000}
    with notebook_page(
        browser, folder, root, WAY, url=lab_url, failed=failed, viewport=size
    ) as page:
        editor = page.locator(".sunwidget")
        editor.locator(".sw-has-photo").wait_for()
        page.screenshot(path=screenshots / "lab-1-photo.png")
        page.locator(".sunwidget.sw-live[data-stage='ready']").wait_for()
        editor.scroll_into_view_if_needed()
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
        page.screenshot(path=screenshots / "lab-4-dragged.png")
        canvas = canvas_of(page)
        assert np.abs(canvas.astype(int) - photo).mean() > 2, "the drag moved nothing"

        edit = json.loads(run_cell_that_writes(page, 1, folder / "kernel.json"))
        assert {"sun_azimuth", "sun_elevation"} <= edit.keys()
        kernel = np.asarray(Image.open(folder / "kernel.png"))
        assert kernel.shape == canvas.shape
        away = np.abs(canvas.astype(int) - kernel)
        print(f"canvas against export: mean {away.mean():.4f}/255, max {away.max()}/255")
        assert away.mean() <= 1
        assert away.max() <= 3

        # One drag is one step, also for Python.
        undone = json.loads(run_cell_that_writes(page, 2, folder / "undone.json"))
        assert undone == {"version": 1}

        # What Python sets is shown, what it must not set is refused.
        answer = run_cell_that_writes(page, 3, folder / "refused.txt")
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
        stroked = json.loads(run_cell_that_writes(page, 4, folder / "stroked.json"))
        assert [stroke["label"] for stroke in stroked["strokes"]] == ["sky", "sky"]
        page.screenshot(path=screenshots / "lab-7-answered.png")


def test_no_edit_is_lost_when_the_kernel_restarts_and_the_page_is_loaded_again(
    browser, folder, root, lab_url, screenshots
):
    failed, size = screenshots / "restart-failed.png", {"width": 1300, "height": 1000}
    with notebook_page(
        browser, folder, root, KEPT, url=lab_url, failed=failed, viewport=size
    ) as page:
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
        editor.get_by_text("The editor's kernel is gone").wait_for()
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
        page.wait_for_function(SHOWS, arg=readout)
        kept = json.loads(run_cell_that_writes(page, 1, folder / "kept.json"))
        assert {"sun_azimuth", "sun_elevation"} <= kept["edit"].keys()
        # Lab's question takes the focus from the sun, so the drag may be two steps.
        steps = [set(step) - {"version"} for step in kept["past"]]
        assert steps[:2] == [set(), {"sun_azimuth"}]
        assert kept["versions"] == {"warm": kept["edit"]}

        # Wherever the focus is, this saves the notebook.
        editor.get_by_role("slider", name="Elevation").focus()
        page.keyboard.press("Control+s")
        page.wait_for_timeout(1500)
        page.reload()
        page.locator(".sunwidget.sw-live[data-stage='ready']").wait_for()
        page.wait_for_function(SHOWS, arg=readout)
        assert editor.get_by_role("button", name="Restore").count() == 0
        page.screenshot(path=screenshots / "restart-3-loaded-again.png")

        # Another tab on the same kernel: both follow what is done in either.
        tab = lab_page(page.context)
        tab.goto(lab_url(f"{folder.name}/cells.ipynb", f"{folder.name}-2"))
        tab.locator(".sunwidget.sw-live[data-stage='ready']").wait_for()
        tab.wait_for_function(SHOWS, arg=readout)
        tab.get_by_role("slider", name="Elevation").focus()
        tab.keyboard.press("ArrowRight")
        tab.wait_for_function(SHOWS.replace("===", "!=="), arg=readout)
        page.bring_to_front()
        page.wait_for_function(SHOWS, arg=tab.locator(".sw-readout").text_content())
        undo.click()
        for one in (page, tab):
            one.wait_for_function(SHOWS, arg=readout)
        tab.close()

        assert undo.get_attribute("title") == "Undo: Sun moved (Ctrl+Z)"
        undo.click()
        (folder / "kept.json").unlink()
        undone = json.loads(run_cell_that_writes(page, 1, folder / "kept.json"))
        assert undone["edit"] == kept["past"][-1] | {"version": 1}
        assert undone["versions"] == kept["versions"]


def test_the_explorer_in_jupyterlab_draws_what_the_kernel_draws(
    browser, folder, root, lab_url, screenshots
):
    with notebook_page(
        browser,
        folder,
        root,
        EXPLORER,
        url=lab_url,
        failed=screenshots / "lab-explorer-failed.png",
        viewport={"width": 1400, "height": 1100},
        permissions=["clipboard-read", "clipboard-write"],
    ) as page:
        explorer = page.locator(".sw-explorer")
        page.locator(".sw-explorer.sw-live").wait_for()
        explorer.scroll_into_view_if_needed()
        settled = "!document.querySelector('.sw-explorer [aria-busy=true]')"
        page.wait_for_function(settled)
        page.screenshot(path=screenshots / "lab-explorer-1.png")

        # Drag the sun to the west, 30° up.
        picture = explorer.locator(".sw-sky-picture").bounding_box()
        ring = explorer.locator(".sw-sun-ring").bounding_box()
        x, y = picture["x"] + picture["width"] / 2, picture["y"] + picture["height"] / 2
        page.mouse.move(ring["x"] + ring["width"] / 2, ring["y"] + ring["height"] / 2)
        page.mouse.down()
        page.mouse.move(x + 0.94 * picture["width"] / 3, y, steps=8)
        page.mouse.up()
        page.wait_for_timeout(300)
        page.wait_for_function(settled)
        page.screenshot(path=screenshots / "lab-explorer-2-dragged.png")
        canvas = page.evaluate(
            """() => {
              const sky = document.querySelector(".sw-sky-canvas");
              const over = document.createElement("canvas");
              [over.width, over.height] = [sky.width, sky.height];
              const context = over.getContext("2d");
              context.fillStyle = "rgb(20 22 27)";  // what the kernel draws around
              context.fillRect(0, 0, over.width, over.height);
              context.drawImage(sky, 0, 0);
              return over.toDataURL("image/png").split(",")[1];
            }"""
        )
        shown = picture_of(canvas)
        (folder / "size.json").write_text(json.dumps(shown.shape[1::-1]))
        azimuth, elevation = json.loads(run_cell_that_writes(page, 1, folder / "kernel.json"))
        assert azimuth == pytest.approx(-90, abs=1.5)
        assert elevation == pytest.approx(30, abs=1.5)
        drawn = np.asarray(Image.open(folder / "kernel.png")).astype(int)
        away = np.abs(shown - drawn)
        print(f"canvas against render: mean {away.mean():.3f}/255")
        assert shown.std() > 20
        # The rim is blended by the browser in eight bits, by the kernel before rounding.
        assert away.mean() <= 1
        assert np.percentile(away, 99) <= 3

        # What Python sets is shown: the place, the day's clock, the sun.
        evening = json.loads(run_cell_that_writes(page, 2, folder / "evening.json"))
        page.wait_for_function(
            "text => document.querySelector('.sw-readout').textContent.includes(text)",
            arg=f"elevation {evening:.1f}°",
        )
        explorer.get_by_role("switch", name="Ozone").click()
        explorer.get_by_role("button", name="Copy code").click()
        explorer.locator(".sw-said", has_text="Copied").wait_for()
        page.screenshot(path=screenshots / "lab-explorer-3-evening.png")

        # The code that was copied makes the same explorer again.
        cell = page.locator(".jp-Notebook .jp-CodeCell").nth(3)
        cell.locator(".cm-content").click()
        code = page.evaluate("navigator.clipboard.readText()")
        page.keyboard.press("Control+a")
        page.keyboard.insert_text(EXPLORER[3].replace('"PASTED"', repr(code)))
        again = json.loads(run_cell_that_writes(page, 3, folder / "again.json"))
        assert again == [pytest.approx(evening), "2024-06-21", False]
