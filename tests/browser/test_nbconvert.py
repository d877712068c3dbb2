"""What ``nbconvert`` makes of a notebook, opened from a file in a browser without network."""

import re
import subprocess
import sys

import nbformat
import numpy as np
import pytest
from chromium import PATIENCE, picture_of
from lab import write_notebook

import sunwidget as sw

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]

NBCONVERT = [sys.executable, "-m", "nbconvert", "--to=html"]
CELLS = {
    "editor": """import sunwidget as sw
photo = sw.open(sw.sample("coast").preview(384))
sw.SunEditor(photo, sun_elevation=-6)""",
    "explorer": "sw.SkyExplorer(sun_elevation=20)",
    "compare": 'sw.Compare(photo, ["photo", "thesis"], sun_elevation=-6)',
}


def converted(folder, cells):
    """Run a notebook of ``cells`` and return the address of its page."""
    write_notebook(folder / "cells.ipynb", cells.values())
    command = [*NBCONVERT, "--execute", "cells.ipynb"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-4000:]
    return (folder / "cells.html").as_uri()


def offline_page(browser):
    """An empty page without network."""
    context = browser.new_context(viewport={"width": 1100, "height": 1400})
    context.set_offline(True)
    page = context.new_page()
    page.set_default_timeout(PATIENCE)
    return page


@pytest.fixture(scope="module")
def outputs(browser, tmp_path_factory, screenshots):
    """The place of each cell's output on the page, by name."""
    folder = tmp_path_factory.mktemp("nbconvert")
    page = offline_page(browser)
    page.goto(converted(folder, CELLS))
    page.screenshot(path=screenshots / "nbconvert.png", full_page=True)
    places = page.locator(".jp-CodeCell .jp-Cell-outputArea")
    yield {name: places.nth(i) for i, name in enumerate(CELLS)}
    page.context.close()


@pytest.mark.parametrize("name", CELLS)
def test_each_widget_shows_its_picture(outputs, name):
    picture = outputs[name].locator("img")
    assert picture.evaluate("(img) => img.complete && img.naturalWidth") > 300
    assert picture.bounding_box()["width"] > 300, "the page gives the picture no room"
    assert pixels(outputs[name]).std() > 10, "the picture is uniform"


def test_the_editor_shows_its_edit_and_not_the_photo(outputs):
    photo = sw.sample("coast").preview(384)
    # The sun has set. An editor without an edit would show the photo to the bit.
    assert pixels(outputs["editor"]).mean() < 0.8 * photo.mean()


def test_the_comparison_shows_all_its_pictures(outputs):
    shown = pixels(outputs["compare"])
    left, right = np.array_split(shown, 2, axis=1)
    assert right.mean() < 0.8 * left.mean()  # the photo, and by another method after its sunset


def test_of_a_notebook_saved_with_its_widgets_the_picture_can_be_had(tmp_path):
    # As ``docs/guide/export.md`` tells it.
    data = {
        "image/png": "cGljdHVyZQ==",
        "application/vnd.jupyter.widget-view+json": {"model_id": "7"},
    }
    shown = nbformat.v4.new_output("display_data", data=data)
    saved = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("editor", outputs=[shown])])
    state = {"state": {"7": {"model_name": "AnyModel", "model_module": "anywidget", "state": {}}}}
    saved.metadata.widgets = {"application/vnd.jupyter.widget-state+json": state}
    nbformat.write(saved, tmp_path / "saved.ipynb")
    command = [*NBCONVERT, "saved.ipynb"]
    for flags, picture in (([], False), (["--ClearMetadataPreprocessor.enabled=True"], True)):
        subprocess.run([*command, *flags], cwd=tmp_path, capture_output=True, check=True)
        page = (tmp_path / "saved.html").read_text("utf-8")
        assert ("data:image/png;base64,cGljdHVyZQ==" in page) == picture


STATIC = {
    "editor": """import sunwidget as sw
sw.SunEditor(sw.open(sw.sample("coast").preview(384)), sun_elevation=-6).render_static()""",
    "explorer": "sw.SkyExplorer(sun_elevation=20).render_static()",
    "compare": """photo = sw.open(sw.sample("coast").preview(384))
sw.Compare(photo, ["photo", "ratio"], sun_elevation=3).render_static()""",
    "study": """sw.Study({"a": photo.preview(384), "b": photo.preview(384)}).render_static()""",
}


def test_render_static_stays_live_in_the_page_without_network(browser, tmp_path, screenshots):
    page = offline_page(browser)
    errors = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(converted(tmp_path, STATIC))
    for i, name in enumerate(STATIC):
        outer = page.locator("iframe[srcdoc]").nth(i)
        outer.scroll_into_view_if_needed()
        inner = outer.content_frame
        inner.locator(".sw-study" if name == "study" else ".sunwidget.sw-live").wait_for()
        page.wait_for_timeout(500)
        assert is_as_tall_as_its_content(outer)
        if name == "study":
            answer(page, inner)
            page.wait_for_timeout(300)
            assert is_as_tall_as_its_content(outer)
        else:
            move_the_sun(page, inner)
        page.screenshot(path=screenshots / f"static-{name}.png")
    assert errors == []
    page.context.close()


def is_as_tall_as_its_content(frame):
    """Nothing scrolls in it."""
    body = frame.content_frame.locator("body")
    tall = body.evaluate("(body) => body.getBoundingClientRect().height")
    return frame.bounding_box()["height"] == pytest.approx(tall, abs=1.5)


def move_the_sun(page, inner):
    readout = inner.locator(".sw-readout").first
    before = readout.text_content()
    # A slider of the panel, or a comparison's handle.
    inner.get_by_role("slider", name=re.compile("^(Elevation|Sun in ratio)")).first.focus()
    page.keyboard.press("ArrowRight")
    page.wait_for_timeout(500)
    assert readout.text_content() != before


def answer(page, inner):
    inner.get_by_role("button", name="Start").click()
    pair = inner.locator(".sw-study-picture")
    # Each takes half of the frame's width: their height does not follow the frame's own.
    assert pair.first.bounding_box()["width"] > 0.4 * page.viewport_size["width"] - 40
    stage = inner.locator(".sw-study-stage").bounding_box()
    assert stage["height"] == pytest.approx(0.46 * stage["width"], rel=0.02)
    pair.first.click()
    inner.get_by_text("Thank you").wait_for()


def pixels(output):
    """What the output's only picture holds, (H, W, 3) uint8."""
    assert output.locator("img").count() == 1
    kind, _, data = output.locator("img").get_attribute("src").partition(",")
    assert kind == "data:image/png;base64"
    return picture_of(data).astype(int)
