"""What goes wrong around an editor: graphics contexts, kernels, photos that change under the hand,
odd sizes of pictures and screens. Nothing that was done is lost, and what is wrong is said."""

import numpy as np
import pytest
from chromium import at_rest, count_contexts, drag_sun, live_contexts, widget_state

import sunwidget as sw
from sunwidget.widgets import SunEditor

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]

# Takes every context away that the page has, as a driver does that is reset.
LOSE = """() => {
  for (const gl of contexts) gl.getExtension("WEBGL_lose_context")?.loseContext();
}"""
# What becomes of contexts from now on: `after(context)` is what the page gets.
MEDDLE = """(after) => {
  const change = eval(after);
  const original = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    const context = original.call(this, kind, ...rest);
    return kind === "webgl2" ? change(context) : context;
  };
}"""
WIDTH = "width => document.querySelector('.sw-live .sw-canvas')?.width === width"


def analysed(photo):
    return widget_state(SunEditor(sw.analyze(photo)).wait())


@pytest.fixture(scope="module")
def state():
    return analysed(sw.sample("coast").preview(192))


@pytest.fixture(scope="module")
def other(state):
    """The same editor with another photo, mirrored and smaller, and nothing done to it."""
    taken = analysed(sw.sample("coast").preview(160)[:, ::-1])
    return taken | {"_history": {"past": [], "future": []}}


@pytest.fixture
def editor(page, state):
    count_contexts(page)
    return shown(page, state)


def shown(page, state):
    page.evaluate("(state) => showEditor(state)", state)
    page.locator(".sunwidget.sw-live").wait_for()
    at_rest(page)
    return page


def trait(page, name):
    return page.evaluate("(name) => model.get(name)", name)


def take(page, selector):
    """Press the mouse on the middle of a thing; returns where."""
    box = page.locator(selector).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    return x, y


def test_five_editors_lose_their_contexts_twice_and_draw_anew(page, state):
    count_contexts(page)
    page.evaluate("(state) => { for (let i = 0; i < 5; i++) addEditor(state); }", state)
    for i in range(5):
        page.locator(".sunwidget").nth(i).scroll_into_view_if_needed()
        page.locator(".sunwidget").nth(i).and_(page.locator(".sw-live")).wait_for()
    for way in (-60, 40):
        page.evaluate(LOSE)
        assert live_contexts(page) == 0
        for i in range(5):
            drag_sun(page, i, by=(way, 10))
    assert page.locator(".sw-message:visible").count() == 0
    assert page.errors == []


def test_a_context_lost_while_the_next_photo_loads_is_made_anew(editor, other):
    editor.evaluate(LOSE)
    editor.evaluate("(state) => model.receive(decoded(state))", other)
    editor.wait_for_function(WIDTH, arg=160)
    assert editor.locator(".sw-message:visible").count() == 0
    assert editor.errors == []


def test_a_context_that_does_not_come_back_is_said_until_it_does(fresh_page, state):
    page = fresh_page
    count_contexts(page)
    shown(page, state)
    page.evaluate(MEDDLE, "(context) => (window.back ? context : null)")
    page.evaluate(LOSE)
    x, y = take(page, ".sw-sun-ring")
    page.mouse.move(x - 60, y + 20, steps=3)
    page.mouse.up()
    page.get_by_role("alert").get_by_text("Reload the page; your edit is kept.").wait_for()
    assert trait(page, "sun_azimuth") is not None
    page.evaluate("window.back = true")
    page.get_by_role("button", name="Undo").click()
    page.locator(".sw-message").wait_for(state="hidden")
    assert page.errors == []


def test_a_browser_that_takes_every_context_away_is_not_asked_for_ever(fresh_page, state):
    page = fresh_page
    page.evaluate(
        MEDDLE,
        """(context) => {
          window.made = (window.made ?? 0) + 1;
          context.getExtension("WEBGL_lose_context").loseContext();
          return context;
        }""",
    )
    page.evaluate("(state) => showEditor(state)", state)
    page.get_by_role("alert").get_by_text("took the graphics context away").wait_for()
    made = page.evaluate("() => new Promise((done) => setTimeout(() => done(made), 200))")
    assert 3 <= made < 10
    assert page.evaluate("() => new Promise((done) => setTimeout(() => done(made), 300))") == made
    assert page.locator(".sw-has-photo .sw-photo").is_visible()
    assert page.errors == []


def test_a_device_without_float_targets_shows_the_photo_and_says_why(fresh_page, state):
    page = fresh_page
    page.evaluate(MEDDLE, "(context) => Object.assign(context, { getExtension: (name) => null })")
    page.evaluate("(state) => showEditor(state)", state)
    page.get_by_role("alert").get_by_text("EXT_color_buffer_float").wait_for()
    assert page.locator(".sw-has-photo .sw-photo").is_visible()
    page.get_by_role("slider", name="Elevation").focus()
    page.keyboard.press("ArrowRight")
    assert trait(page, "sun_elevation") is not None
    assert page.errors == []


def test_another_photo_in_the_middle_of_a_drag_takes_nothing_of_it_over(editor, other):
    x, y = take(editor, ".sw-sun-ring")
    editor.mouse.move(x - 60, y + 20, steps=3)
    editor.evaluate("(state) => model.receive(decoded(state))", other)
    editor.mouse.move(x - 90, y + 30, steps=3)
    editor.mouse.up()
    editor.wait_for_function(WIDTH, arg=160)
    editor.get_by_role("slider", name="Elevation").focus()
    editor.keyboard.press("ArrowRight")
    assert trait(editor, "sun_elevation") is not None
    assert trait(editor, "sun_azimuth") is None
    assert trait(editor, "_history")["past"] == [{}]
    assert editor.errors == []


def test_of_two_photos_the_later_is_shown_whichever_is_decoded_first(page, state, other):
    page.evaluate(
        """([first, second]) => {
          const { decode } = HTMLImageElement.prototype;
          let waits = 0;
          HTMLImageElement.prototype.decode = async function () {
            waits += 1;
            if (waits === 1) await new Promise((done) => { window.goOn = done; });
            else HTMLImageElement.prototype.decode = decode;
            return decode.call(this);
          };
          showEditor({ ...first, _scene: {} });
          model.receive(decoded({ ...second, _scene: {} }));
        }""",
        [state, other],
    )
    width = "document.querySelector('.sw-photo').naturalWidth"
    page.wait_for_function(f"{width} === 160")
    page.evaluate("() => { goOn(); return new Promise((done) => setTimeout(done, 100)); }")
    assert page.evaluate(width) == 160
    assert page.errors == []


@pytest.mark.parametrize("key", ["2", "4"])
def test_another_tool_in_the_middle_of_a_drag_gives_the_drag_up(editor, key):
    x, y = take(editor, ".sw-sun-ring")
    editor.mouse.move(x - 40, y + 20, steps=3)
    editor.keyboard.press(key)
    editor.mouse.move(x - 80, y + 40, steps=3)
    editor.mouse.up()
    assert trait(editor, "sun_azimuth") is None
    assert trait(editor, "_history")["past"] == []
    assert trait(editor, "strokes") == []
    assert editor.errors == []


def test_a_kernel_that_goes_ends_what_it_was_asked_and_the_stroke_that_was_begun(editor):
    editor.get_by_role("button", name="Save", exact=True).click()
    editor.keyboard.press("4")
    x, y = take(editor, ".sw-picture")
    editor.mouse.move(x - 40, y, steps=2)
    editor.evaluate(
        "Object.assign(model, { widget_manager: {}, comm_live: false }).fire('comm_live_update')"
    )
    editor.locator("[data-kernel='lost']").wait_for()
    editor.mouse.move(x - 80, y + 20, steps=2)
    editor.mouse.up()
    editor.get_by_text("Saving failed: The kernel is gone.").wait_for()
    assert editor.get_by_role("button", name="Save", exact=True).is_enabled()
    assert trait(editor, "strokes") == []
    assert trait(editor, "_history")["past"] == []
    assert editor.errors == []


def test_right_after_a_shutdown_saving_says_what_is_the_matter(editor):
    # As JupyterLab does before it tells its widgets that the kernel is gone.
    editor.evaluate("() => { model.send = () => { throw new Error('Cannot send'); }; }")
    editor.get_by_role("button", name="Save", exact=True).click()
    editor.get_by_text("Saving failed: The kernel is gone. Run the cell again.").wait_for()
    editor.locator("[data-kernel='lost']").wait_for()
    assert editor.get_by_role("radio", name="Brush: sky").is_disabled()
    assert editor.errors == []


def test_a_screen_that_becomes_denser_shows_a_pixel_on_each_of_its_own(fresh_page, state):
    page = fresh_page
    page.evaluate(
        """() => {
          const { matchMedia } = window;
          window.queries = [];
          window.matchMedia = (text) => {
            const query = matchMedia.call(window, text);
            window.queries.push(query);
            return query;
          };
        }"""
    )
    shown(page, state)
    page.locator(".sw-percent").click()
    width = "document.querySelector('.sw-picture').getBoundingClientRect().width"
    assert page.evaluate(width) == 192
    screen = {"width": 1180, "height": 860, "deviceScaleFactor": 2, "mobile": False}
    page.context.new_cdp_session(page).send("Emulation.setDeviceMetricsOverride", screen)
    # The emulated screen tells no query of the change, as a real one does.
    page.evaluate("for (const query of [...queries]) query.dispatchEvent(new Event('change'))")
    assert page.evaluate(width) == 96
    assert page.errors == []


def test_a_tab_out_of_sight_draws_what_was_done_when_it_is_seen_again(fresh_page, state):
    page = shown(fresh_page, state)
    drawn = "document.querySelector('.sw-canvas').toDataURL()"
    before = page.evaluate(drawn)
    # A browser calls no frames for a page that nobody sees.
    page.evaluate(
        """() => {
          const due = [];
          const { requestAnimationFrame: request } = window;
          window.requestAnimationFrame = (work) => due.push(work);
          window.seen = () => {
            window.requestAnimationFrame = request;
            for (const work of due.splice(0)) request(work);
          };
          for (let i = 1; i < 20; i++) model.receive({ sun_elevation: i });
        }"""
    )
    assert page.evaluate(drawn) == before
    page.evaluate("seen()")
    page.wait_for_function(
        "(before) => document.querySelector('.sw-canvas').toDataURL() !== before", arg=before
    )
    assert page.locator(".sw-readout").text_content().endswith("19.0° elevation")
    assert page.errors == []


@pytest.mark.parametrize("size", [(1, 1), (300, 1), (8, 1024)])
def test_pictures_of_odd_sizes_are_shown_and_edited(page, size):
    slope = np.linspace(230, 60, size[0])[:, None, None] * np.ones((*size, 3))
    shown(page, analysed(slope.astype(np.uint8)))
    page.get_by_role("slider", name="Elevation").focus()
    for key in ("ArrowRight", "s", "z", "+", "0", "4", "Escape"):
        page.keyboard.press(key)
    canvas = page.locator(".sw-canvas")
    assert canvas.evaluate("canvas => [canvas.height, canvas.width]") == list(size)
    assert trait(page, "sun_elevation") is not None
    assert page.locator(".sw-message:visible").count() == 0
    assert page.errors == []


def test_a_crash_of_the_graphics_process_leaves_neither_picture_nor_presets_black(
    browser, fresh_page, state
):
    page = fresh_page
    shown(page, state)
    bright = """() => [...document.querySelectorAll(".sw-canvas, .sw-thumbnail.sw-drawn")].filter(
      (canvas) => {
        const { width, height } = canvas;
        const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
        return data.some((level, i) => i % 4 < 3 && level > 30);
      }).length"""
    page.wait_for_function("document.querySelectorAll('.sw-thumbnail.sw-drawn').length === 6")
    page.evaluate(
        """() => document.addEventListener("contextlost", () => (window.lost = true), true)"""
    )
    browser.new_browser_cdp_session().send("Browser.crashGpuProcess")
    page.wait_for_function("window.lost")
    # Seldom asked: the presets' pictures wait until the page has nothing to do.
    for _ in range(15):
        page.wait_for_timeout(2000)
        if (seen := page.evaluate(bright)) == 7:
            break
    assert seen == 7
    assert page.locator(".sw-message:visible").count() == 0
    assert page.errors == []
