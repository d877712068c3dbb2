"""The editor's view in a real browser, without a notebook: a stand-in plays the model."""

import numpy as np
import pytest
from chromium import at_rest, count_contexts, picture_of, widget_state

from sunwidget.widgets import SunEditor

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]

DRAG_BUDGET = (1024, 698)


@pytest.fixture(scope="module")
def state(coast):
    return widget_state(SunEditor(coast).wait())


@pytest.fixture
def editor(page, state):
    count_contexts(page)
    page.evaluate("(state) => showEditor(state)", state)
    page.locator(".sunwidget.sw-live").wait_for()
    at_rest(page)
    yield page
    assert page.errors == []


def canvas_of(page):
    return picture_of(
        page.evaluate("document.querySelector('.sw-canvas').toDataURL('image/png').split(',')[1]")
    )


def trait(page, name):
    return page.evaluate("(name) => model.get(name)", name)


def grab_sun(page):
    box = page.locator(".sw-sun-ring").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    return x, y


def settled(page, before):
    """Wait until the canvas shows another full frame than ``before``, and rests."""
    last = before
    for _ in range(150):
        page.wait_for_timeout(150)
        now = canvas_of(page)
        if now.shape == before.shape and not np.array_equal(now, before):
            if np.array_equal(now, last):
                return now
            last = now
    raise AssertionError("the canvas did not change")


def test_the_canvas_is_a_picture(editor):
    assert canvas_of(editor).std() > 10


def test_the_photo_is_shown_before_the_analysis(page, state):
    page.evaluate(
        "(state) => showEditor(state)",
        {
            **state,
            "_scene": {},
            "_layers": "",
            "_status": {"stage": "analysing", "fraction": 0.4, "message": "Finding the sky …"},
        },
    )
    page.locator(".sw-has-photo .sw-photo").wait_for()
    assert page.locator(".sw-progress.sw-shown .sw-progress-text").text_content() == (
        "Finding the sky …"
    )
    assert page.locator(".sunwidget.sw-live").count() == 0
    late = {name: state[name] for name in ("_scene", "_layers", "_status")}
    page.evaluate("(state) => model.receiveOneByOne(decoded(state))", late)
    page.locator(".sunwidget.sw-live").wait_for()
    assert page.locator(".sw-progress.sw-shown").count() == 0
    assert page.errors == []


def test_dragging_the_sun_moves_traits_and_picture_in_one_step(editor):
    before = canvas_of(editor)
    x, y = grab_sun(editor)
    editor.mouse.move(x - 150, y + 60, steps=6)
    editor.mouse.up()
    assert settled(editor, before).std() > 10
    assert trait(editor, "sun_azimuth") is not None
    assert len(trait(editor, "_history")["past"]) == 1


def test_a_drag_there_and_back_changes_no_pixel(editor):
    before = canvas_of(editor)
    x, y = grab_sun(editor)
    editor.mouse.move(x - 150, y + 60, steps=4)
    editor.mouse.up()
    settled(editor, before)
    moved = canvas_of(editor)
    editor.get_by_role("button", name="Undo").click()
    assert trait(editor, "sun_azimuth") is None
    assert np.array_equal(settled(editor, moved), before)


def test_the_sun_can_leave_the_picture_and_waits_at_the_edge(editor):
    x, y = grab_sun(editor)
    editor.mouse.move(x, y - 900, steps=4)
    editor.mouse.up()
    assert trait(editor, "sun_elevation") > 40
    ring = editor.locator(".sw-sun-ring").bounding_box()
    stage = editor.locator(".sw-stage").bounding_box()
    assert stage["y"] <= ring["y"] <= stage["y"] + 40
    assert editor.locator(".sw-sun-arrow").get_attribute("visibility") == "visible"


def test_escape_gives_a_drag_up(editor):
    x, y = grab_sun(editor)
    editor.mouse.move(x - 150, y + 60, steps=4)
    editor.keyboard.press("Escape")
    editor.mouse.move(x - 200, y + 90, steps=4)
    editor.mouse.up()
    assert trait(editor, "sun_azimuth") is None
    assert trait(editor, "_history")["past"] == []


def test_arrow_keys_move_the_sun(editor):
    editor.get_by_role("slider", name="Sun", exact=True).focus()
    found = trait(editor, "_scene")["automatic"]
    editor.keyboard.press("ArrowUp")
    editor.keyboard.press("ArrowLeft")
    assert trait(editor, "sun_elevation") == pytest.approx(found["sun_elevation"] + 0.5, abs=1e-3)
    assert trait(editor, "sun_azimuth") == pytest.approx(found["sun_azimuth"] - 0.5, abs=1e-3)
    editor.keyboard.press("Home")
    assert trait(editor, "sun_elevation") is None


def test_a_slider_sets_its_parameter_and_a_double_click_resets_it(editor):
    editor.locator("[data-section='camera'] .sw-fold").click()
    slider = editor.get_by_role("slider", name="Exposure in EV")
    slider.focus()
    for _ in range(4):
        editor.keyboard.press("ArrowRight")
    assert trait(editor, "exposure") == pytest.approx(0.2)
    editor.locator("[data-parameter='exposure'] .sw-label").dblclick()
    assert trait(editor, "exposure") == 0


def test_a_preset_is_a_chip_that_stays_pressed_while_it_holds(editor, state):
    chips = editor.get_by_role("group", name="Presets").get_by_role("button")
    sent = state["_scene"]["presets"]
    assert chips.all_text_contents() == [preset["label"] for preset in sent]
    pressed = "(all) => all.map((chip) => chip.getAttribute('aria-pressed'))"
    assert "true" not in chips.evaluate_all(pressed)
    before = canvas_of(editor)
    chips.nth(3).focus()
    editor.keyboard.press("Enter")
    for name, value in sent[3]["values"].items():
        assert trait(editor, name) == value
    assert chips.evaluate_all(pressed).index("true") == 3
    assert settled(editor, before).std() > 10
    chips.nth(4).click()
    assert len(trait(editor, "_history")["past"]) == 2
    editor.get_by_role("button", name="Undo").click()
    assert chips.evaluate_all(pressed).index("true") == 3
    # A preset that is no longer in force is not pressed.
    editor.locator("[data-section='camera'] .sw-fold").click()
    editor.get_by_role("slider", name="Exposure in EV").focus()
    editor.keyboard.press("ArrowRight")
    assert "true" not in chips.evaluate_all(pressed)
    editor.get_by_role("button", name="Undo").click()
    editor.get_by_role("button", name="Undo").click()
    assert trait(editor, "sun_elevation") is None


def test_a_button_that_is_disabled_at_its_press_does_not_take_the_keys_with_it(editor):
    editor.locator(".sw-sun").focus()
    editor.keyboard.press("ArrowUp")
    moved = trait(editor, "sun_elevation")
    assert moved is not None
    undo = editor.get_by_role("button", name="Undo").first
    undo.focus()
    editor.keyboard.press("Enter")
    assert undo.is_disabled()
    assert trait(editor, "sun_elevation") is None
    editor.evaluate("() => new Promise((done) => requestAnimationFrame(() => setTimeout(done)))")
    editor.keyboard.press("Control+Shift+z")
    assert trait(editor, "sun_elevation") == moved
    assert undo.evaluate("(node) => node === document.activeElement")


def test_a_typed_value_is_clamped_and_nonsense_is_refused(editor):
    field = editor.get_by_label("Elevation, value")
    field.fill("500")
    field.press("Enter")
    assert trait(editor, "sun_elevation") == 90
    field.fill("high")
    field.press("Enter")
    assert trait(editor, "sun_elevation") == 90
    assert field.input_value() == "90.0"
    assert editor.get_by_text("“high” is not a number").is_visible(), "refused, and it is seen"
    assert field.get_attribute("aria-invalid") == "true"
    field.fill("12°")
    field.press("Enter")
    assert trait(editor, "sun_elevation") == 12
    assert field.get_attribute("aria-invalid") is None
    field = editor.get_by_label("Azimuth, value")
    field.fill("190")
    field.press("Enter")
    assert trait(editor, "sun_azimuth") == -170


def test_every_number_of_the_table_has_a_slider(editor, state):
    names = {p["name"] for p in state["_parameters"] if p["kind"] != "data"}
    drawn = editor.evaluate(
        "[...document.querySelectorAll('[data-parameter]')].map((e) => e.dataset.parameter)"
    )
    assert set(drawn) == names
    assert len(drawn) == len(names)


def test_a_brush_stroke_travels_as_fractions_of_the_picture(editor):
    editor.get_by_role("radio", name="Brush: not sky").click()
    box = editor.locator(".sw-picture").bounding_box()
    editor.mouse.move(box["x"] + 0.25 * box["width"], box["y"] + 0.5 * box["height"])
    editor.mouse.down()
    editor.mouse.move(box["x"] + 0.75 * box["width"], box["y"] + 0.5 * box["height"], steps=10)
    editor.mouse.up()
    (stroke,) = trait(editor, "strokes")
    assert stroke["label"] == "not_sky"
    assert stroke["points"][0] == pytest.approx([0.25, 0.5], abs=0.01)
    assert stroke["points"][-1] == pytest.approx([0.75, 0.5], abs=0.02)
    assert 0.0005 <= stroke["radius"] <= 0.5


def test_the_horizon_handles_send_two_points(editor):
    editor.get_by_role("radio", name="Set the horizon").click()
    handle = editor.get_by_label("Horizon, right end").bounding_box()
    x, y = handle["x"] + handle["width"] / 2, handle["y"] + handle["height"] / 2
    editor.mouse.move(x, y)
    editor.mouse.down()
    editor.mouse.move(x, y + 30, steps=3)
    editor.mouse.up()
    left, right = trait(editor, "horizon_hint")
    height = editor.locator(".sw-picture").bounding_box()["height"]
    assert right[1] - left[1] == pytest.approx(30 / height, abs=0.01)


def test_before_shows_the_photo_while_held(editor):
    button = editor.get_by_role("button", name="Before").bounding_box()
    editor.mouse.move(button["x"] + 10, button["y"] + 10)
    editor.mouse.down()
    assert editor.locator(".sunwidget.sw-before").count() == 1
    editor.wait_for_timeout(500)  # longer than a click, which keeps it
    editor.mouse.up()
    assert editor.locator(".sunwidget.sw-before").count() == 0


def test_before_that_is_kept_is_named_and_goes_with_the_next_edit(editor):
    said = "getComputedStyle(document.querySelector('.sw-window'), '::after').content"
    assert editor.evaluate(said) == "none"
    editor.get_by_role("button", name="Before").click()
    editor.get_by_role("button", name="Before", pressed=True).wait_for()
    assert editor.evaluate(said) == '"Before"'
    editor.get_by_role("slider", name="Sun", exact=True).focus()
    assert editor.locator(".sunwidget.sw-before").count() == 1
    editor.keyboard.press("ArrowUp")
    editor.get_by_role("button", name="Before", pressed=False).wait_for()
    assert editor.locator(".sunwidget.sw-before").count() == 0
    # Held, it stays: who holds it wants to see the photo, whatever Python sets meanwhile.
    editor.keyboard.down("b")
    editor.evaluate("model.receive({sun_elevation: 20})")
    assert editor.locator(".sunwidget.sw-before").count() == 1
    editor.keyboard.up("b")


def test_what_the_kernel_sets_is_shown(editor):
    before = canvas_of(editor)
    editor.evaluate("model.receive({sun_azimuth: -12, sun_elevation: 2.5})")
    settled(editor, before)
    assert editor.locator(".sw-readout").text_content() == "Sun 12.0° left · 2.5° elevation"
    assert trait(editor, "_history")["past"] == []


def test_an_error_of_the_kernel_is_shown_as_text(editor):
    hostile = "<img src=x onerror=alert(1)>.jpg: not found"
    editor.evaluate("(error) => model.fire('msg:custom', {type: 'error', error})", hostile)
    assert editor.get_by_role("alert").text_content() == hostile
    assert editor.locator(".sw-message img").count() == 0


def test_save_downloads_what_the_kernel_answers(editor):
    editor.get_by_role("button", name="Save").click()
    (request,) = editor.evaluate("model.sent")
    assert request["action"] == "save"
    with editor.expect_download() as download:
        editor.evaluate(
            """(id) => model.fire("msg:custom",
              {type: "response", id, result: {name: "beach-sun.png", type: "image/png"}},
              [new DataView(new ArrayBuffer(8))])""",
            request["id"],
        )
    assert download.value.suggested_filename == "beach-sun.png"


def test_two_views_of_one_editor_follow_each_other(editor):
    editor.evaluate(
        """async () => {
          const { default: editor } = await import("/sun_editor.js");
          const el = document.createElement("div");
          document.body.append(el);
          editor.render({ model, el });
        }"""
    )
    editor.locator(".sunwidget.sw-live").nth(1).wait_for()
    editor.get_by_label("Elevation, value").first.fill("7")
    editor.keyboard.press("Enter")
    assert editor.get_by_label("Elevation, value").nth(1).input_value() == "7.0"
    # The history is one, the chosen tool is each view's own.
    editor.get_by_role("radio", name="Set the horizon").first.click()
    tools = editor.locator(".sunwidget").evaluate_all("views => views.map((v) => v.dataset.tool)")
    assert tools == ["horizon", "sun"]
    editor.get_by_role("button", name="Undo").nth(1).click()
    assert trait(editor, "sun_elevation") is None
    shown = editor.locator(".sw-readout").all_text_contents()
    assert shown[0] == shown[1]
    assert editor.get_by_role("button", name="Undo").first.is_disabled()


def test_a_closed_view_leaves_no_listener(editor):
    editor.evaluate("close_view()")
    left = editor.evaluate("[...model.listeners.values()].reduce((n, s) => n + s.size, 0)")
    assert left == 0
    assert editor.locator(".sunwidget").count() == 0


def test_a_lost_context_keeps_the_last_frame_and_comes_back(page, state):
    page.evaluate("async (state) => makeFrame(state)", state)
    first = picture_of(page.evaluate("drawn({sun_elevation: 4})"))
    page.evaluate("frame.graph.gl.getExtension('WEBGL_lose_context').loseContext()")
    page.wait_for_timeout(300)
    kept = picture_of(page.evaluate("frame.canvas.toDataURL('image/png').split(',')[1]"))
    assert np.array_equal(kept, first)
    assert np.array_equal(picture_of(page.evaluate("drawn({sun_elevation: 4})")), first)
    moved = picture_of(page.evaluate("drawn({sun_elevation: 20})"))
    assert np.abs(moved.astype(int) - first).mean() > 1


def test_two_sizes_in_turn_draw_the_unmoved_picture_once_each(page, state):
    page.evaluate("async (state) => makeFrame(state)", state)
    fresh = picture_of(page.evaluate("drawn({sun_elevation: 9})"))
    page.evaluate("async (state) => makeFrame(state)", state)
    page.evaluate("drawn({sun_elevation: 4})")
    for size in ([300, 200], [400, 270]):
        page.evaluate("(size) => drawn({sun_elevation: 6}, size)", size)
    before = page.evaluate("({...frame.graph.runs})")
    again = picture_of(page.evaluate("drawn({sun_elevation: 9})"))
    page.evaluate("drawn({sun_elevation: 7}, [400, 270])")
    page.evaluate("drawn({sun_elevation: 8})")
    after = page.evaluate("frame.graph.runs")
    drawn = {name for name in after if after[name] > before.get(name, 0)}
    assert "frame" in drawn
    assert not {"retouched", "sky_source", "sky_behind", "scene_light"} & drawn
    assert np.array_equal(again, fresh)


def test_dragging_runs_no_pass_of_the_unmoved_picture_again(page, state):
    page.evaluate("async (state) => makeFrame(state)", state)
    page.evaluate("drawn({sun_elevation: 4})")
    before = page.evaluate("({...frame.graph.runs})")
    page.evaluate("drawn({sun_elevation: 5})")
    after = page.evaluate("frame.graph.runs")
    again = {name for name in after if after[name] > before.get(name, 0)}
    assert {"sky_view_edit", "frame"} <= again
    assert not {name for name in again if name.endswith("_source")}
    assert not again & {"columns_source", "columns_edit", "multiple_scattering_edit"}


def test_a_shader_that_does_not_compile_shows_its_line(page, state):
    page.evaluate("async (state) => makeFrame(state)", state)
    page.evaluate("drawn({})")
    message = page.evaluate(
        """() => {
          const graph = frame.graph;
          graph.programs.made.delete("frame/frame");
          const text = "void main() {\\n  nonsense = 1.0;\\n}";
          graph.programs.files = { ...graph.programs.files, "frame/frame.glsl": text };
          try { drawn({}); } catch (error) { return error.message; }
        }"""
    )
    assert 'Shader "frame/frame" does not compile' in message
    assert "nonsense = 1.0;" in message


def test_missing_float_targets_are_said(fresh_page, state):
    fresh_page.evaluate("async (state) => makeFrame(state)", state)
    message = fresh_page.evaluate(
        """() => {
          WebGL2RenderingContext.prototype.getExtension = () => null;
          try { drawn({}); } catch (error) { return error.message; }
        }"""
    )
    assert "EXT_color_buffer_float" in message


def test_without_webgl2_the_photo_stays_and_the_reason_is_said(fresh_page, state):
    page = fresh_page
    page.evaluate(
        """(state) => {
          const original = HTMLCanvasElement.prototype.getContext;
          HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
            return kind === "webgl2" ? null : original.call(this, kind, ...rest);
          };
          showEditor(state);
        }""",
        state,
    )
    page.get_by_role("alert").wait_for()
    assert "WebGL2" in page.get_by_role("alert").text_content()
    assert page.locator(".sw-has-photo .sw-photo").is_visible()
    assert page.errors == []


def test_a_context_lost_in_a_drag_is_drawn_anew(editor):
    before = canvas_of(editor)  # at rest: a drag's frames may be smaller
    x, y = grab_sun(editor)
    editor.mouse.move(x - 40, y, steps=2)
    editor.evaluate(
        """() => {
          for (const gl of contexts) gl.getExtension("WEBGL_lose_context").loseContext();
        }"""
    )
    editor.mouse.move(x - 150, y + 60, steps=4)
    editor.mouse.up()
    assert settled(editor, before).std() > 10
    assert editor.evaluate("contexts.length") == 2  # the lost one, and the one made in its stead
    assert editor.get_by_role("alert").count() == 0


def test_a_drag_frame_at_1024_by_698(page, state):
    page.evaluate("async (state) => makeFrame(state)", state)
    times = page.evaluate(
        """(size) => {
          const times = [];
          for (let i = 0; i < 19; i++) {
            const begin = performance.now();
            frame.draw({ sun_azimuth: i / 3, sun_elevation: 8 - i / 5 }, size);
            frame.context.getImageData(0, 0, 1, 1); // wait until it is really drawn
            times.push(performance.now() - begin);
          }
          return times.slice(4);
        }""",
        list(DRAG_BUDGET),
    )
    print(f"drag frame at {DRAG_BUDGET[0]}×{DRAG_BUDGET[1]}: median {np.median(times):.1f} ms")
    # Machines are shared, with other tests too: the goal is 33 ms, what fails is an accident of
    # another order, and the best frame tells most of it.
    assert min(times) < 1000


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_editor_is_pictured(page, state, screenshots, theme):
    page.set_viewport_size({"width": 1180, "height": 760})
    page.emulate_media(color_scheme=theme)
    page.evaluate("(state) => showEditor(state)", state)
    page.locator(".sunwidget.sw-live").wait_for()
    at_rest(page)
    page.screenshot(path=screenshots / f"editor-{theme}.png")
    panel = page.evaluate("getComputedStyle(document.querySelector('.sunwidget')).backgroundColor")
    lightness = sum(int(n) for n in panel[4:-1].split(",")) / 3
    assert (lightness < 128) == (theme == "dark")
