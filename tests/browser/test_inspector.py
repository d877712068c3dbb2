"""Maps of the analysis over the picture, asked of a real widget."""

import base64
import io

import numpy as np
import pytest
from chromium import connect
from PIL import Image

import sunwidget as sw
from sunwidget.analysis.maps import MAPS, ramp_colors, scene_map, shares_of
from sunwidget.widgets import SunEditor

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]


@pytest.fixture
def editor(page, coast):
    connect(page, SunEditor(coast).wait(120))
    yield page
    assert page.errors == []


def show(page, name):
    page.get_by_label("Show").select_option(name)
    page.locator(".sw-legend:not(.sw-waiting)").wait_for()


def hover(page, x, y):
    box = page.locator(".sw-picture").bounding_box()
    page.mouse.move(box["x"] + x * box["width"], box["y"] + y * box["height"])


def painted(page):
    """The overlay (H, W, 4) as it was painted, before its opacity."""
    url = page.evaluate("document.querySelector('.sw-map').toDataURL()")
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(url.split(",")[1]))).convert("RGBA"))


def test_every_map_of_the_table_is_offered_and_drawn_in_its_colours(editor, coast):
    offered = editor.locator(".sw-show option").evaluate_all("(all) => all.map((o) => o.value)")
    assert offered == ["", *(entry.name for entry in MAPS)]
    for name in ("sky", "depth"):
        show(editor, name)
        assert editor.locator(".sw-legend b").text_content() == scene_map(name).title
        colors = painted(editor)
        shares = shares_of(coast, scene_map(name), coast.photo.size)
        wanted = 255 * ramp_colors(scene_map(name).ramp)[np.round(shares * 255).astype(int)]
        opaque = wanted[..., 3] > 60  # a canvas keeps colors times alpha
        assert np.abs(colors[..., 3].astype(float) - wanted[..., 3]).max() <= 1.5
        assert np.abs(colors[opaque] - wanted[opaque]).max() <= 6


def test_the_value_under_the_pointer_is_read_with_its_unit(editor, coast):
    show(editor, "sky")
    hover(editor, 0.5, 0.05)
    value = editor.get_by_label("Value at pointer")
    assert value.text_content() == f"{coast.sky[25, 384]:.2f}"
    hover(editor, 0.5, 0.97)
    assert value.text_content() == "0.00"
    show(editor, "elevation")
    hover(editor, 0.25, 0.2)
    elevation = coast.camera.angles(0.25 * 768, 0.2 * 512)[1]
    text = value.text_content().replace("−", "-").removesuffix("°")
    assert float(text) == pytest.approx(elevation, abs=0.3)
    editor.mouse.move(2, 2)
    assert value.text_content() == ""


def test_m_goes_through_the_maps_and_escape_closes(editor):
    editor.get_by_role("slider", name="Sun", exact=True).focus()
    editor.keyboard.press("m")
    assert editor.locator(".sw-legend b").text_content() == MAPS[0].title
    editor.keyboard.press("m")
    assert editor.get_by_label("Show").input_value() == MAPS[1].name
    editor.keyboard.press("Shift+M")
    editor.keyboard.press("Shift+M")
    assert editor.locator(".sw-legend").is_hidden()
    editor.keyboard.press("4")
    editor.keyboard.press("m")
    editor.keyboard.press("Escape")
    assert editor.locator(".sw-legend").is_hidden()
    assert editor.locator(".sunwidget").get_attribute("data-tool") == "sky"
    editor.keyboard.press("Escape")
    assert editor.locator(".sunwidget").get_attribute("data-tool") == "sun"


def test_a_map_travels_once_and_its_legend_leads_to_the_next(editor):
    editor.evaluate(
        """() => {
          window.asked = [];
          const { send } = model;
          model.send = (content, ...rest) => {
            if (content.action === "map") window.asked.push(content.name);
            return send(content, ...rest);
          };
        }"""
    )
    show(editor, MAPS[0].name)
    first = painted(editor)
    spread = editor.locator(".sw-legend-spread path").get_attribute("d")
    assert spread.startswith("M0 20L")
    editor.get_by_role("button", name="Next map").click()
    editor.locator(".sw-legend:not(.sw-waiting)").wait_for()
    assert editor.locator(".sw-legend b").text_content() == MAPS[1].title
    assert editor.locator(".sw-legend-position").text_content() == f"2 / {len(MAPS)}"
    assert editor.locator(".sw-legend-spread path").get_attribute("d") != spread
    editor.get_by_role("button", name="Previous map").click()
    assert np.array_equal(painted(editor), first)
    assert editor.evaluate("asked") == [MAPS[0].name, MAPS[1].name]


def test_opacity_and_closing(editor):
    show(editor, "sky")
    editor.get_by_label("Map opacity").fill("0.4")
    assert editor.locator(".sw-map").evaluate("(map) => getComputedStyle(map).opacity") == "0.4"
    editor.get_by_role("button", name="Close the map").click()
    assert editor.locator(".sw-map").is_hidden()
    assert editor.get_by_label("Show").input_value() == ""


def test_a_map_is_asked_for_again_when_the_scene_changes(editor):
    show(editor, "sky")
    before = painted(editor)
    points = [[0.3, 0.9], [0.7, 0.9]]
    editor.evaluate(
        """(points) => {
          model.set("strokes", [{ label: "sky", points, radius: 0.04 }]);
          model.save_changes();
        }""",
        points,
    )
    editor.wait_for_function(
        """() => {
          const canvas = document.querySelector(".sw-map");
          const at = [canvas.width / 2, Math.round(0.9 * canvas.height), 1, 1];
          return canvas.getContext("2d").getImageData(...at).data[3] > 100;
        }"""
    )
    assert before[int(0.9 * before.shape[0]), before.shape[1] // 2, 3] == 0


def test_a_photo_without_a_sun_says_so(page):
    grey = np.full((64, 96, 3), 128, np.uint8)
    grey[:32] = (90, 130, 200)
    mask = np.repeat([1.0, 0.0], 32)[:, None] * np.ones(96)
    scene = sw.analyze(grey, sky=mask)
    assert scene.sun is None
    connect(page, SunEditor(scene).wait(120))
    show(page, "sun")
    page.wait_for_function("document.querySelector('.sw-legend-help').textContent.includes('none')")
    assert page.get_by_role("alert").count() == 0
    show(page, "sky")
    assert page.locator(".sw-legend-help").text_content() == scene_map("sky").help


def test_the_maps_are_pictured(editor, screenshots):
    show(editor, "clouds")
    hover(editor, 0.4, 0.3)
    editor.wait_for_timeout(400)
    editor.screenshot(path=screenshots / "editor-map.png")
    assert painted(editor).std() > 10
