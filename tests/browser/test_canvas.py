"""The picture in a real browser: zoom, pan, split, full screen, by mouse, touch and key."""

import io
from contextlib import contextmanager

import numpy as np
import pytest
from chromium import connect, open_page, picture_of, widget_state
from PIL import Image

import sunwidget as sw
from sunwidget.widgets import SunEditor
from sunwidget.widgets.kernel import payload

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]

# What lies over the picture, out of sight, and out of the way of comparisons by pixels.
BARE = """
  .sw-overlay, .sw-own-sun, .sw-zoom-control, .sw-divider, .sw-window::after {
    opacity: 0 !important;
  }
"""
UNTOUCHED = {"sun_azimuth": None, "sun_elevation": None, "sun_hint": None, "strokes": []}


@contextmanager
def shown(browser, scene, **options):
    context = browser.new_context(**options)
    page = open_page(context)
    page.evaluate("(state) => showEditor(state)", widget_state(SunEditor(scene).wait()))
    page.locator(".sunwidget.sw-live").wait_for()
    page.wait_for_timeout(400)  # the canvas fades in
    yield page
    assert page.errors == []
    context.close()


@pytest.fixture(scope="module")
def only_page(browser, coast):
    with shown(browser, coast, viewport={"width": 1180, "height": 860}) as page:
        yield page


@pytest.fixture
def editor(only_page):
    """One page for all: every test finds the whole picture, and nothing moved."""
    yield only_page
    only_page.locator(".sw-percent").focus()
    only_page.keyboard.press("Escape")
    only_page.keyboard.press("0")
    only_page.evaluate("(untouched) => model.receive(untouched)", UNTOUCHED)


def trait(page, name):
    return page.evaluate("(name) => model.get(name)", name)


def box(page, selector):
    return page.locator(selector).bounding_box()


def place_on_picture(page, x, y):
    """Fractions of the picture's width and height at a point of the window."""
    picture = box(page, ".sw-picture")
    return (x - picture["x"]) / picture["width"], (y - picture["y"]) / picture["height"]


def middle(page, selector):
    at = box(page, selector)
    return at["x"] + at["width"] / 2, at["y"] + at["height"] / 2


def on_picture(page, x, y):
    picture = box(page, ".sw-picture")
    return picture["x"] + x * picture["width"], picture["y"] + y * picture["height"]


def zoom_in(page, x, y, notches=3):
    """Ctrl and the wheel over a place of the picture."""
    page.mouse.move(*on_picture(page, x, y))
    page.keyboard.down("Control")
    for _ in range(notches):
        page.mouse.wheel(0, -200)
    page.keyboard.up("Control")
    page.locator(".sw-zoomed").wait_for()


def levels(page):
    canvas = "document.querySelector('.sw-canvas')"
    return picture_of(page.evaluate(f"{canvas}.toDataURL('image/png').split(',')[1]"))


def on_screen(page, ratio=1):
    """What is seen of the picture, bare, and where in the picture that begins: device pixels."""
    style = page.add_style_tag(content=BARE)
    screen = np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("RGB"))
    style.evaluate("(node) => node.remove()")
    picture, stage = box(page, ".sw-picture"), box(page, ".sw-stage")
    cut = []
    for at, length in (("x", "width"), ("y", "height")):
        low = max(picture[at], stage[at]) * ratio
        high = min(picture[at] + picture[length], stage[at] + stage[length]) * ratio
        cut.append((round(low), round(high), round(low - picture[at] * ratio)))
    (x0, x1, dx), (y0, y1, dy) = cut
    return screen[y0:y1, x0:x1], (dx, dy)


def test_ctrl_and_wheel_zoom_at_the_pointer_and_the_wheel_alone_does_not(editor):
    before = box(editor, ".sw-picture")
    at = on_picture(editor, 0.7, 0.3)
    editor.mouse.move(*at)
    editor.mouse.wheel(0, -300)
    editor.wait_for_timeout(100)
    assert box(editor, ".sw-picture") == before
    zoom_in(editor, 0.7, 0.3)
    assert box(editor, ".sw-picture")["width"] > 2 * before["width"]
    # A pixel of the screen is 1/1800 of the zoomed picture.
    assert place_on_picture(editor, *at) == pytest.approx((0.7, 0.3), abs=1e-3)
    editor.locator(".sw-percent").focus()
    editor.keyboard.press("0")
    assert box(editor, ".sw-picture") == before


def test_handles_stay_on_the_picture_at_every_zoom(editor):
    sun = place_on_picture(editor, *middle(editor, ".sw-sun-ring"))
    zoom_in(editor, *sun)
    at = place_on_picture(editor, *middle(editor, ".sw-sun-ring"))
    assert at == pytest.approx(sun, abs=1e-3)
    # The sun is out of sight below and to the right: its handle waits at an edge.
    editor.locator(".sw-percent").click()
    zoom_in(editor, 0.3, 0.05)
    stage, ring = box(editor, ".sw-stage"), box(editor, ".sw-sun-ring")
    assert editor.locator(".sw-sun-arrow").get_attribute("visibility") == "visible"
    right = stage["x"] + stage["width"] - ring["x"] - ring["width"]
    below = stage["y"] + stage["height"] - ring["y"] - ring["height"]
    assert min(right, below) == pytest.approx(15, abs=3)
    assert max(right, below) < max(stage["width"], stage["height"]) / 2
    # Both handles of the horizon are in sight, and on the line.
    editor.keyboard.press("2")
    for end in ("left", "right"):
        handle = box(editor, f"[aria-label='Horizon, {end} end'] circle")
        assert stage["x"] < handle["x"] < stage["x"] + stage["width"] - handle["width"]


def test_a_zoomed_picture_is_dragged_in_full_size(editor):
    editor.set_viewport_size({"width": 420, "height": 860})
    # The handle follows once the page is laid out anew.
    editor.wait_for_function(
        "document.querySelector('.sw-sun-ring').getBoundingClientRect().right < 420"
    )
    # Every size that is drawn: on a slow machine none stays long enough to be asked for. Its clock
    # stands, so that no frame is late and made smaller for that.
    editor.evaluate(
        """() => {
          performance.now = () => 0;
          const canvas = document.querySelector(".sw-canvas");
          window.widths = [];
          const note = () => window.widths.push(canvas.width);
          const what = { attributes: true, attributeFilter: ["width"] };
          new MutationObserver(note).observe(canvas, what);
        }"""
    )

    def dragged():
        at = middle(editor, ".sw-sun-ring")
        editor.evaluate("window.widths.length = 0")
        editor.mouse.move(*at)
        editor.mouse.down()
        editor.mouse.move(at[0] - 20, at[1] + 4, steps=4)
        editor.wait_for_timeout(500)
        editor.mouse.up()
        editor.wait_for_function("document.querySelector('.sw-canvas').width === 768")
        return editor.evaluate("window.widths")

    assert min(dragged()) < 768
    zoom_in(editor, 0.5, 0.4)
    assert min(dragged(), default=768) == 768
    editor.evaluate("void delete performance.now")
    editor.set_viewport_size({"width": 1180, "height": 860})


def test_the_middle_button_and_the_space_bar_pan_and_move_no_sun(editor):
    zoom_in(editor, 0.5, 0.5)
    before = box(editor, ".sw-picture")
    x, y = on_picture(editor, 0.5, 0.5)
    editor.mouse.move(x, y)
    editor.mouse.down(button="middle")
    editor.mouse.move(x + 60, y - 40, steps=3)
    editor.mouse.up(button="middle")
    after = box(editor, ".sw-picture")
    assert (after["x"] - before["x"], after["y"] - before["y"]) == pytest.approx((60, -40), abs=1)
    editor.keyboard.down(" ")
    editor.mouse.down()
    editor.mouse.move(x, y, steps=3)
    editor.mouse.up()
    editor.keyboard.up(" ")
    assert box(editor, ".sw-picture")["x"] == pytest.approx(before["x"], abs=1)
    assert trait(editor, "sun_azimuth") is None
    # The hand has given the picture the focus, but the wheel is still the page's.
    editor.mouse.wheel(0, -200)
    editor.wait_for_timeout(100)
    assert box(editor, ".sw-picture")["width"] == before["width"]


def test_at_100_percent_a_pixel_of_the_preview_is_one_of_the_screen(editor):
    editor.locator(".sw-percent").click()
    seen, (x, y) = on_screen(editor)
    assert np.array_equal(seen, levels(editor)[y : y + len(seen), x : x + seen.shape[1]])


def test_100_percent_is_sharp_on_a_dense_screen(browser, coast):
    options = {"viewport": {"width": 700, "height": 500}, "device_scale_factor": 2}
    with shown(browser, coast, **options) as page:
        page.locator(".sw-percent").click()
        assert box(page, ".sw-picture")["width"] == 768 / 2
        page.evaluate("window.scrollTo(0, document.body.scrollHeight)")
        page.locator(".sw-stage").scroll_into_view_if_needed()
        seen, _ = on_screen(page, ratio=2)
        whole = levels(page)
        assert seen.std() > 10
        assert np.array_equal(seen, whole[: len(seen), : seen.shape[1]])


@pytest.mark.parametrize(("aspect", "height"), [((150, 100), 700), ((100, 150), 700)])
def test_it_fits_the_windows_height_portraits_too(browser, aspect, height):
    width, tall = aspect
    slope = np.linspace(230, 60, tall)[:, None, None] * np.ones((tall, width, 3))
    scene = sw.analyze(slope.astype(np.uint8))
    with shown(browser, scene, viewport={"width": 1366, "height": height}) as page:
        assert box(page, ".sw-stage")["height"] <= 0.76 * height
        assert box(page, ".sunwidget")["height"] <= height
        page.set_viewport_size({"width": 1366, "height": 500})
        page.wait_for_function(
            "document.querySelector('.sw-stage').getBoundingClientRect().height <= 380"
        )


def test_a_divider_shows_the_photo_on_its_left(editor):
    editor.evaluate("model.receive({sun_azimuth: -12, sun_elevation: 2.5})")
    editor.wait_for_timeout(500)
    after, _ = on_screen(editor)
    editor.locator(".sw-percent").focus()
    editor.keyboard.down("b")
    editor.wait_for_timeout(400)
    before, _ = on_screen(editor)
    editor.keyboard.up("b")
    editor.wait_for_timeout(400)  # the canvas fades in again
    assert np.abs(before.astype(int) - after).mean() > 5
    editor.keyboard.press("s")
    divider = editor.get_by_role("slider", name="Divider between before and after")
    divider.focus()
    for _ in range(5):
        editor.keyboard.press("Shift+ArrowLeft")
    assert divider.get_attribute("aria-valuenow") == "0"
    editor.keyboard.press("Shift+ArrowRight")
    x, y = middle(editor, ".sw-divider")
    editor.mouse.move(x, y)
    editor.mouse.down()
    editor.mouse.move(on_picture(editor, 0.25, 0)[0], y, steps=3)
    editor.mouse.up()
    assert divider.get_attribute("aria-valuenow") == "25"
    assert trait(editor, "sun_azimuth") == -12
    split, _ = on_screen(editor)
    at = round(0.25 * split.shape[1])
    # A clipped canvas is put together elsewhere in the browser, which may round otherwise.
    assert np.abs(split[:, : at - 2].astype(int) - before[:, : at - 2]).max() <= 1
    assert np.abs(split[:, at + 2 :].astype(int) - after[:, at + 2 :]).max() <= 1
    # However it is zoomed, the divider is in sight, and divides there.
    zoom_in(editor, 0.9, 0.5)
    stage = box(editor, ".sw-stage")
    assert stage["x"] < middle(editor, ".sw-divider")[0] < stage["x"] + stage["width"]
    editor.keyboard.press("s")
    assert not divider.is_visible()


def test_an_unmoved_picture_shown_small_is_as_sharp_as_the_photo(editor):
    editor.set_viewport_size({"width": 420, "height": 860})
    editor.locator(".sw-percent").focus()
    editor.wait_for_timeout(300)
    after, _ = on_screen(editor)
    assert after.shape[1] < 0.6 * 768
    editor.keyboard.press("b")
    before, _ = on_screen(editor)
    editor.keyboard.press("b")
    # Dither is one level; browsers make images smaller more softly than canvases.
    assert np.abs(before.astype(int) - after).max() <= 2
    editor.set_viewport_size({"width": 1180, "height": 860})


def test_the_keyboards_cross_pans_and_uses_the_tool(editor):
    stage = editor.locator(".sw-stage")
    zoom_in(editor, 0.5, 0.5)
    before = box(editor, ".sw-picture")
    stage.focus()
    editor.keyboard.press("Shift+ArrowRight")
    assert box(editor, ".sw-picture")["x"] == pytest.approx(before["x"] - 160, abs=1)
    cross = place_on_picture(editor, *middle(editor, ".sw-cross"))
    editor.keyboard.press("3")
    editor.keyboard.press("Enter")
    assert trait(editor, "sun_hint") == pytest.approx(cross, abs=2e-3)
    editor.keyboard.press("0")
    editor.keyboard.press("4")
    stage.focus()
    editor.keyboard.press("Enter")
    for _ in range(4):
        editor.keyboard.press("ArrowDown")
    assert trait(editor, "strokes") == []
    editor.keyboard.press("Enter")
    [stroke] = trait(editor, "strokes")
    (x0, y0), (x1, y1) = stroke["points"]
    assert x0 == x1
    assert (y1 - y0) * box(editor, ".sw-picture")["height"] == pytest.approx(64, abs=1)


def test_the_readout_says_direction_and_colour_under_the_pointer(editor, coast):
    editor.evaluate("model.receive({sun_azimuth: -12, sun_elevation: 2.5})")
    editor.wait_for_timeout(500)
    editor.mouse.move(*on_picture(editor, 0.3, 0.2))
    editor.locator(".sw-hover.sw-shown").wait_for()
    # The pointer stands between two pixels of the stage: half of one either way.
    azimuth, elevation = coast.camera.angles(0.3 * coast.camera.width, 0.2 * coast.camera.height)
    text = editor.locator(".sw-hover-direction").text_content()
    side, height = text.split(" · ")
    assert side.endswith(" left")
    assert float(side.split("°")[0]) == pytest.approx(-azimuth, abs=0.11)
    assert float(height.rstrip("°")) == pytest.approx(elevation, abs=0.11)
    photo, now = (
        np.array([int(level) for level in text.split()])
        for text in editor.locator(".sw-rgb").all_text_contents()
    )
    picture = levels(editor)
    y, x = round(0.2 * 512), round(0.3 * 768)
    near = picture[y - 2 : y + 3, x - 2 : x + 3].reshape(-1, 3)
    assert (near == now).all(axis=1).any()
    preview = np.asarray(coast.photo.preview(768))
    near = preview[y - 2 : y + 3, x - 2 : x + 3].reshape(-1, 3)
    assert (near == photo).all(axis=1).any()
    editor.mouse.move(5, 5)
    editor.wait_for_function("!document.querySelector('.sw-hover.sw-shown')")


def test_full_screen_or_where_it_is_forbidden_the_window(editor):
    before = box(editor, ".sunwidget")
    editor.locator(".sw-percent").focus()
    editor.keyboard.press("f")
    editor.wait_for_function("document.fullscreenElement?.matches('.sunwidget')")
    editor.keyboard.press("f")
    editor.wait_for_function("!document.querySelector('.sw-full')")
    assert box(editor, ".sunwidget") == before
    editor.evaluate(
        "void (Element.prototype.requestFullscreen = async () => { throw new TypeError() })"
    )
    editor.keyboard.press("f")
    editor.wait_for_function("document.querySelector('.sw-full')")
    filled = box(editor, ".sunwidget")
    assert (filled["width"], filled["height"]) == (1180, 860)
    picture, stage = box(editor, ".sw-picture"), box(editor, ".sw-stage")
    assert picture["y"] >= stage["y"]
    assert picture["y"] + picture["height"] <= stage["y"] + stage["height"]
    editor.keyboard.press("Escape")
    assert box(editor, ".sunwidget") == before


def test_zoomed_past_the_preview_the_kernel_draws_what_is_in_sight(
    browser, coast, monkeypatch, screenshots
):
    monkeypatch.setattr(payload, "PREVIEW_EDGE", 384)
    widget = SunEditor(coast, sun_elevation=3).wait()
    context = browser.new_context(viewport={"width": 1180, "height": 860})
    page = open_page(context)
    connect(page, widget)
    zoom_in(page, 0.45, 0.5)
    page.locator(".sw-detail:visible").wait_for()
    page.screenshot(path=screenshots / "detail.png")
    found = page.locator(".sw-detail").evaluate(
        """canvas => {
             const { left, top, width, height } = canvas.style;
             const share = [left, top, width, height].map((text) => Number.parseFloat(text) / 100);
             return [canvas.toDataURL().split(",")[1], ...share];
           }"""
    )
    left, top = round(found[1] * 768), round(found[2] * 512)
    shown = picture_of(found[0])
    assert shown.shape[1] == round(found[3] * 768) < 700
    full = sw.render(coast, sw.Edit(sun_elevation=3))
    assert np.array_equal(shown, full[top : top + shown.shape[0], left : left + shown.shape[1]])
    # Of another edit it is never seen.
    page.get_by_role("slider", name="Elevation").focus()
    page.keyboard.press("ArrowRight")
    assert page.locator(".sw-detail:visible").count() == 0
    page.locator(".sw-detail:visible").wait_for()
    again = page.locator(".sw-detail").evaluate("canvas => canvas.toDataURL().split(',')[1]")
    assert not np.array_equal(picture_of(again), shown)
    page.get_by_role("button", name="Split").click()
    assert page.locator(".sw-detail:visible").count() == 0
    assert page.errors == []
    context.close()


def test_two_fingers_zoom_and_pan_and_one_moves_the_sun(browser, coast):
    options = {"viewport": {"width": 420, "height": 800}, "has_touch": True}
    with shown(browser, coast, **options, device_scale_factor=2) as page:
        send = page.context.new_cdp_session(page).send

        def touch(kind, *points):
            fingers = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]
            send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})

        width = box(page, ".sw-picture")["width"]
        x, y = on_picture(page, 0.4, 0.5)
        touch("touchStart", (x - 20, y))
        touch("touchStart", (x - 20, y), (x + 20, y))
        for apart in (30, 40, 50):
            touch("touchMove", (x - apart, y), (x + apart, y))
        page.wait_for_timeout(100)
        assert box(page, ".sw-picture")["width"] == pytest.approx(2.5 * width, rel=0.01)
        assert place_on_picture(page, x, y) == pytest.approx((0.4, 0.5), abs=0.005)
        touch("touchMove", (x - 30, y + 10), (x + 70, y + 10))
        page.wait_for_timeout(100)
        assert place_on_picture(page, x + 20, y + 10) == pytest.approx((0.4, 0.5), abs=0.005)
        touch("touchEnd")
        page.wait_for_timeout(100)
        assert trait(page, "sun_azimuth") is None
        assert trait(page, "_history")["past"] == []
        touch("touchStart", (x, y))
        touch("touchEnd")
        page.wait_for_timeout(100)
        assert trait(page, "sun_azimuth") is not None
        assert len(trait(page, "_history")["past"]) == 1
