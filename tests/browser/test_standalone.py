"""The stand-alone page, opened from a file in a browser without network."""

import re

import numpy as np
import pytest
from chromium import PATIENCE, paste, picture_of
from PIL import Image

import sunwidget as sw

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]

SIZE = (384, 256)
HOSTILE = "</script><img src=x onerror=hacked()><!--\u2028'\".jpg"


@pytest.fixture(scope="module")
def scene():
    photo = sw.open(sw.sample("coast").preview(SIZE[0]))
    object.__setattr__(photo, "name", HOSTILE)
    return sw.analyze(photo)


@pytest.fixture(scope="module")
def path(scene, tmp_path_factory):
    stroke = sw.Stroke("sky", ((0.5, 0.1), (0.6, 0.1)), 0.02)
    edit = sw.Edit(sun_elevation=3, strokes=(stroke,))
    return sw.to_html(scene, edit, tmp_path_factory.mktemp("page") / "coast.html")


def opened(browser, path, query="", **options):
    """The page from its file: no network, and a record of all that it asks for or complains of."""
    context = browser.new_context(viewport={"width": 1180, "height": 860}, **options)
    context.set_offline(True)
    page = context.new_page()
    page.set_default_timeout(PATIENCE)
    page.requests, page.complaints = [], []
    page.on("request", lambda request: page.requests.append(request.url))
    page.on("pageerror", lambda error: page.complaints.append(str(error)))
    page.on(
        "console",
        lambda message: page.complaints.append(message.text) if message.type == "error" else None,
    )
    page.goto(path.as_uri() + query)
    return page


def quiet(page, path):
    """Nothing has left the page, and the policy had nothing to refuse."""
    assert {url.split(":")[0] for url in page.requests} <= {"file", "blob", "data"}
    assert [url for url in page.requests if url.startswith("file:")] == [path.as_uri()]
    assert page.complaints == []
    page.context.close()
    return True


@pytest.fixture
def page(browser, path):
    page = opened(browser, path, accept_downloads=True)
    page.locator(".sunwidget.sw-live").wait_for()
    page.wait_for_timeout(400)
    yield page
    assert quiet(page, path)


def canvas_of(page, selector=".sw-canvas"):
    script = "(s) => document.querySelector(s).toDataURL('image/png').split(',')[1]"
    return picture_of(page.evaluate(script, selector))


def drawn_like(page, picture, tolerance):
    """Wait until the canvas shows ``picture``; returns the mean difference in levels."""
    for _ in range(60):
        shown = canvas_of(page)
        if shown.shape == picture.shape:
            difference = np.abs(shown.astype(int) - picture).mean()
            if difference < tolerance:
                return difference
        page.wait_for_timeout(250)
    raise AssertionError(f"{shown.shape} against {picture.shape}: {difference}")


def test_the_sun_is_dragged_and_the_kernel_would_render_the_same(page, scene, path, screenshots):
    strokes = (sw.Stroke("sky", ((0.5, 0.1), (0.6, 0.1)), 0.02),)
    first = sw.render(scene, sw.Edit(sun_elevation=3, strokes=strokes))
    assert drawn_like(page, first, 0.1) < 0.1
    ring = page.locator(".sw-sun-ring").bounding_box()
    x, y = ring["x"] + ring["width"] / 2, ring["y"] + ring["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 180, y - 60, steps=5)
    page.mouse.up()
    azimuth = float(page.get_by_label("Azimuth, value").input_value())
    elevation = float(page.get_by_label("Elevation, value").input_value())
    assert elevation > 5
    assert azimuth < scene.automatic["sun_azimuth"] - 5
    # Typed, since the fields round what the pointer said.
    for name, value in (("Azimuth", azimuth), ("Elevation", elevation)):
        page.get_by_label(f"{name}, value").fill(str(value))
        page.keyboard.press("Enter")
    edit = sw.Edit(sun_azimuth=azimuth, sun_elevation=elevation, strokes=strokes)
    moved = sw.render(scene, edit)
    assert np.abs(moved.astype(int) - first).mean() > 2
    assert drawn_like(page, moved, 0.1) < 0.1
    page.screenshot(path=screenshots / "standalone-light.png")
    page.emulate_media(color_scheme="dark")
    page.screenshot(path=screenshots / "standalone-dark.png")


def test_what_needs_a_kernel_is_disabled_and_says_so(page, scene):
    for name in ("Set the horizon", "Point at the photo's sun", "Brush: sky", "Erase strokes"):
        tool = page.get_by_role("radio", name=name)
        assert tool.is_disabled()
        assert "kernel" in tool.get_attribute("title")
    assert page.get_by_label("Show", exact=True).is_disabled()
    page.locator(".sunwidget").press("4")
    assert page.get_by_role("radio", name="Move the sun").get_attribute("aria-checked") == "true"
    paste(page, "sw.Edit(exposure=1)")
    page.get_by_role("alert").filter(has_text="Paste the recipe as JSON").wait_for()
    paste(page, '{"exposure": 1}')
    page.get_by_text("Recipe applied.").wait_for()
    # Everything back to the photo, but for the stroke: its maps would stay as they are.
    page.get_by_role("button", name="Reset", exact=True).click()
    photo = sw.render(scene, sw.Edit(strokes=(sw.Stroke("sky", ((0.5, 0.1), (0.6, 0.1)), 0.02),)))
    assert drawn_like(page, photo, 0.1) < 0.1
    assert page.locator(".sw-stroke").count() >= 1


def test_save_downloads_the_canvas(page, scene):
    with page.expect_download() as download:
        page.get_by_role("button", name="Save", exact=True).click()
    assert download.value.suggested_filename.endswith("-sun.png")
    saved = np.asarray(Image.open(download.value.path()).convert("RGB"))
    assert np.array_equal(saved, canvas_of(page))
    assert saved.shape == (SIZE[1], SIZE[0], 3)


def test_timings_are_shown_where_the_address_asks_for_them(browser, page, path, screenshots):
    assert page.locator(".sw-timings").count() == 0
    timed = opened(browser, path, "?timings")
    width, height = SIZE
    told = re.compile(
        rf"{width} × {height} in [\d.]+ ms \((fence|timer query), median of \d+\) · .+"
    )
    timed.locator(".sw-timings").filter(has_text=told).wait_for()
    first = timed.locator(".sw-timings").inner_text()
    timed.locator(".sw-sun").press("ArrowUp")
    timed.wait_for_function(
        "first => document.querySelector('.sw-timings').innerText !== first", arg=first
    )
    timed.screenshot(path=screenshots / "timings.png")
    timed.keyboard.press("?")
    assert re.search(
        f"Drawing here: .*{width} × {height}", timed.locator(".sw-dialog").inner_text()
    )
    timed.screenshot(path=screenshots / "timings-help.png")
    assert timed.complaints == []
    timed.context.close()


def test_a_hostile_name_is_text(page):
    assert page.locator("h1").text_content().startswith("</script><img src=x onerror=hacked()>")
    assert page.title().startswith("</script><img")
    assert page.locator("header img").count() == 0


@pytest.mark.parametrize(
    ("options", "lack", "said"),
    [
        ({"java_script_enabled": False}, "", "nothing leaves it"),
        ({}, "HTMLCanvasElement.prototype.getContext = () => null", "has no WebGL2"),
    ],
)
def test_where_it_cannot_run_the_picture_stays(browser, path, options, lack, said):
    context = browser.new_context(offline=True, **options)
    if lack:
        context.add_init_script(lack)
    page = context.new_page()
    page.goto(path.as_uri())
    page.get_by_text(said).wait_for(timeout=20_000)
    still = page.locator("#still img")
    assert still.is_visible()
    assert still.bounding_box()["width"] == SIZE[0]
    context.close()


def test_an_explorer_runs_in_its_page(browser, tmp_path, screenshots):
    path = sw.SkyExplorer(sun_elevation=3).to_html(tmp_path / "sky.html")
    page = opened(browser, path)
    page.locator(".sw-sky-canvas").wait_for()

    def sky():
        return canvas_of(page, ".sw-sky-canvas").astype(int)

    for _ in range(80):
        if sky().std() > 10:
            break
        page.wait_for_timeout(250)
    before = sky()
    assert before.std() > 10
    page.get_by_label("Elevation, value", exact=True).fill("60")
    page.keyboard.press("Enter")
    for _ in range(80):
        now = sky()
        if now.shape == before.shape and np.abs(now - before).mean() > 2:
            break
        page.wait_for_timeout(250)
    assert np.abs(sky() - before).mean() > 2
    page.screenshot(path=screenshots / "standalone-explorer.png")
    assert quiet(page, path)
