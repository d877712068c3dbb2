"""SkyExplorer in a real JupyterLab: both sides follow each other and draw the same sky."""

import json

import numpy as np
import pytest
from chromium import picture_of
from lab import notebook_page, run_cell_that_writes
from PIL import Image

pytestmark = [pytest.mark.browser, pytest.mark.timeout(600)]

CELLS = [
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


def test_the_explorer_in_jupyterlab_draws_what_the_kernel_draws(
    browser, tmp_path, root, screenshots
):
    with notebook_page(
        browser,
        tmp_path,
        root,
        CELLS,
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
        (tmp_path / "size.json").write_text(json.dumps(shown.shape[1::-1]))
        azimuth, elevation = json.loads(run_cell_that_writes(page, 1, tmp_path / "kernel.json"))
        assert azimuth == pytest.approx(-90, abs=1.5)
        assert elevation == pytest.approx(30, abs=1.5)
        drawn = np.asarray(Image.open(tmp_path / "kernel.png")).astype(int)
        away = np.abs(shown - drawn)
        print(f"canvas against render: mean {away.mean():.3f}/255")
        assert shown.std() > 20
        # The rim is blended by the browser in eight bits, by the kernel before rounding.
        assert away.mean() <= 1
        assert np.percentile(away, 99) <= 3

        # What Python sets is shown: the place, the day's clock, the sun.
        evening = json.loads(run_cell_that_writes(page, 2, tmp_path / "evening.json"))
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
        page.keyboard.insert_text(CELLS[3].replace('"PASTED"', repr(code)))
        again = json.loads(run_cell_that_writes(page, 3, tmp_path / "again.json"))
        assert again == [pytest.approx(evening), "2024-06-21", False]
