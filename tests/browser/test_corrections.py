"""Brushes, eraser, horizon, cloud thresholds and notes, in a real browser."""

import base64

import numpy as np
import pytest
from chromium import connect, widget_state

from sunwidget.formats.png import encode_png
from sunwidget.widgets import SunEditor

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]


@pytest.fixture(scope="module")
def state(coast):
    return widget_state(SunEditor(coast).wait(120))


@pytest.fixture
def editor(page, state):
    page.evaluate("(state) => showEditor(state)", state)
    page.locator(".sunwidget.sw-live").wait_for()
    yield page
    assert page.errors == []


def trait(page, name):
    return page.evaluate("(name) => model.get(name)", name)


def choose(page, name):
    page.get_by_role("radio", name=name).click()


def move(page, x, y, steps=1):
    box = page.locator(".sw-picture").bounding_box()
    page.mouse.move(box["x"] + x * box["width"], box["y"] + y * box["height"], steps=steps)


def drag(page, start, end, steps=6):
    move(page, *start)
    page.mouse.down()
    move(page, *end, steps=steps)
    page.mouse.up()


def test_strokes_stay_in_sight_while_a_brush_is_chosen(editor):
    choose(editor, "Brush: not sky")
    drag(editor, (0.2, 0.3), (0.4, 0.3))
    choose(editor, "Brush: sky")
    drag(editor, (0.6, 0.8), (0.8, 0.8))
    lines = editor.locator(".sw-strokes polyline")
    lines.nth(1).wait_for(state="attached")
    classes = lines.evaluate_all("(all) => all.map((line) => line.getAttribute('class'))")
    assert classes == ["sw-stroke sw-stroke-not_sky", "sw-stroke sw-stroke-sky"]
    # Drawn where it was painted, as wide as the brush was.
    box = editor.locator(".sw-picture").bounding_box()
    drawn = lines.first.bounding_box()
    assert drawn["x"] - box["x"] == pytest.approx(0.2 * box["width"], abs=20)
    assert drawn["width"] == pytest.approx(0.2 * box["width"], abs=40)
    choose(editor, "Move the sun")
    assert lines.first.is_hidden()


def test_every_stroke_is_a_step_of_its_own(editor):
    choose(editor, "Brush: sky")
    for y in (0.7, 0.8, 0.9):
        drag(editor, (0.3, y), (0.5, y))
    assert len(trait(editor, "strokes")) == 3
    editor.keyboard.press("Control+z")
    assert [stroke["points"][0][1] for stroke in trait(editor, "strokes")] == pytest.approx(
        [0.7, 0.8], abs=0.01
    )


def test_a_stroke_made_while_the_kernel_works_is_not_lost(editor, state):
    choose(editor, "Brush: sky")
    drag(editor, (0.3, 0.7), (0.5, 0.7))
    analysing = {"stage": "analysing", "fraction": 0.5, "message": "Applying the correction …"}
    editor.evaluate("(status) => model.receive({ _status: status })", analysing)
    assert editor.locator(".sw-progress-text").text_content() == "Applying the correction …"
    move(editor, 0.3, 0.8)
    editor.mouse.down()
    move(editor, 0.4, 0.8, steps=3)
    # The answer to the first stroke comes in the middle of the second.
    scene = {**state["_scene"], "revision": 99}
    editor.evaluate(
        """([scene, strokes]) => model.receive({ _scene: scene, strokes,
             _status: { stage: "ready", fraction: 1, message: "" } })""",
        [scene, trait(editor, "strokes")],
    )
    editor.wait_for_function("document.querySelector('.sunwidget').dataset.stage === 'ready'")
    move(editor, 0.5, 0.8, steps=3)
    editor.mouse.up()
    rows = [stroke["points"][0][1] for stroke in trait(editor, "strokes")]
    assert rows == pytest.approx([0.7, 0.8], abs=0.01)
    assert trait(editor, "strokes")[1]["points"][-1][0] == pytest.approx(0.5, abs=0.02)


def test_the_eraser_takes_the_strokes_it_meets_in_one_step(editor):
    choose(editor, "Brush: sky")
    for y in (0.6, 0.7, 0.9):
        drag(editor, (0.3, y), (0.5, y))
    choose(editor, "Erase strokes")
    move(editor, 0.4, 0.9)
    doomed = editor.locator(".sw-strokes .sw-doomed")
    assert doomed.count() == 1
    drag(editor, (0.4, 0.55), (0.4, 0.75))
    (left,) = trait(editor, "strokes")
    assert left["points"][0][1] == pytest.approx(0.9, abs=0.01)
    editor.keyboard.press("Control+z")
    assert len(trait(editor, "strokes")) == 3
    drag(editor, (0.9, 0.2), (0.95, 0.2))
    assert len(trait(editor, "strokes")) == 3


def test_a_brush_paints_water_when_told_so_and_the_eraser_takes_it_away(editor):
    choose(editor, "Brush: sky")
    editor.keyboard.press("w")
    assert (
        editor.locator(".sw-toolbar")
        .get_by_role("button", name="Water")
        .get_attribute("aria-pressed")
        == "true"
    )
    drag(editor, (0.3, 0.8), (0.5, 0.8))
    choose(editor, "Brush: not water")
    drag(editor, (0.3, 0.3), (0.5, 0.3))
    editor.locator(".sw-toolbar").get_by_role("button", name="Water").click()
    choose(editor, "Brush: not sky")
    drag(editor, (0.3, 0.5), (0.5, 0.5))
    said = [stroke["label"] for stroke in trait(editor, "strokes")]
    assert said == ["water", "not_water", "not_sky"]
    lines = editor.locator(".sw-strokes polyline")
    lines.nth(2).wait_for(state="attached")
    classes = lines.evaluate_all("(all) => all.map((line) => line.getAttribute('class'))")
    assert classes == [f"sw-stroke sw-stroke-{label}" for label in said]
    editor.keyboard.press("Control+z")
    choose(editor, "Erase strokes")
    drag(editor, (0.4, 0.75), (0.4, 0.85))
    assert [stroke["label"] for stroke in trait(editor, "strokes")] == ["not_water"]


def test_the_water_tint_is_the_water_of_the_scene_also_where_the_land_is_near(page, state, coast):
    size = (512, 768)
    surface = np.zeros((*size, 4), np.uint8)
    surface[300:, :, 1] = 200  # alpha 0: as near as the depth can be
    page.evaluate(
        "(state) => showEditor(state)",
        {**state, "_surface": base64.b64encode(encode_png(surface)).decode("ascii")},
    )
    page.locator(".sunwidget.sw-live").wait_for()
    page.get_by_role("slider", name="Sun", exact=True).focus()
    page.keyboard.press("w")
    alpha = page.evaluate(
        """[100, 400].map((y) =>
          document.querySelector(".sw-mask").getContext("2d").getImageData(384, y, 1, 1).data[3])"""
    )
    assert alpha == [0, 90]


def test_the_brush_ring_has_the_brushs_size_and_leaves_with_the_pointer(editor):
    choose(editor, "Brush: sky")
    move(editor, 0.5, 0.5)
    ring = editor.locator(".sw-brush.sw-stroke-sky")
    before = float(ring.get_attribute("r"))
    editor.keyboard.press("]")
    assert float(ring.get_attribute("r")) == pytest.approx(1.25 * before, rel=0.01)
    editor.get_by_label("Brush size").fill("0.03")
    width = editor.locator(".sw-picture").bounding_box()["width"]
    assert float(ring.get_attribute("r")) == pytest.approx(0.03 * width, rel=0.01)
    editor.mouse.move(2, 2)
    assert ring.is_hidden()


def test_a_finger_paints(browser, state):
    from chromium import open_page

    context = browser.new_context(has_touch=True, viewport={"width": 900, "height": 800})
    page = open_page(context)
    page.evaluate("(state) => showEditor(state)", state)
    page.locator(".sunwidget.sw-live").wait_for()
    choose(page, "Brush: sky")
    box = page.locator(".sw-picture").bounding_box()
    session = context.new_cdp_session(page)
    for kind, x in (("touchStart", 0.2), ("touchMove", 0.3), ("touchMove", 0.5), ("touchEnd", 0)):
        points = [{"x": box["x"] + x * box["width"], "y": box["y"] + 0.8 * box["height"]}]
        session.send(
            "Input.dispatchTouchEvent",
            {"type": kind, "touchPoints": [] if kind == "touchEnd" else points},
        )
    page.wait_for_function("model.get('strokes').length === 1")
    (stroke,) = trait(page, "strokes")
    assert stroke["points"][0] == pytest.approx([0.2, 0.8], abs=0.02)
    assert stroke["points"][-1] == pytest.approx([0.5, 0.8], abs=0.02)
    context.close()


def test_a_real_kernel_answers_a_stroke(page, coast):
    widget = SunEditor(coast).wait(120)
    connect(page, widget)
    choose(page, "Brush: sky")
    drag(page, (0.3, 0.9), (0.7, 0.9))
    page.wait_for_function("document.querySelector('.sunwidget').dataset.stage === 'ready'")
    page.wait_for_function(
        """() => {
          const mask = document.querySelector(".sw-mask");
          const at = [mask.width / 2, Math.round(0.9 * mask.height), 1, 1];
          return mask.getContext("2d").getImageData(...at).data[3] > 60;
        }"""
    )
    assert len(widget.edit.strokes) == 1
    assert widget.scene.sky[int(0.9 * coast.height), coast.width // 2] == 1


def test_shift_levels_the_horizon_and_a_double_click_returns_it(editor):
    choose(editor, "Set the horizon")
    handle = editor.get_by_label("Horizon, left end").bounding_box()
    x, y = handle["x"] + handle["width"] / 2, handle["y"] + handle["height"] / 2
    editor.mouse.move(x, y)
    editor.mouse.down()
    editor.mouse.move(x, y + 40, steps=3)
    editor.wait_for_function(
        "document.querySelector('.sw-horizon-label').textContent.endsWith('to the left')"
    )
    editor.keyboard.down("Shift")
    editor.mouse.move(x, y + 42)
    editor.mouse.up()
    editor.keyboard.up("Shift")
    left, right = trait(editor, "horizon_hint")
    assert left[1] == pytest.approx(right[1], abs=1e-5)
    editor.mouse.dblclick(x + 200, y + 100)
    assert trait(editor, "horizon_hint") is None


def test_a_click_alone_sets_no_horizon(editor):
    choose(editor, "Set the horizon")
    move(editor, 0.5, 0.2)
    editor.mouse.down()
    editor.mouse.up()
    assert trait(editor, "horizon_hint") is None
    assert trait(editor, "_history")["past"] == []


def test_the_whole_line_goes_where_it_is_dragged_also_out_of_the_picture(editor):
    choose(editor, "Set the horizon")
    editor.evaluate("model.receive({ horizon_hint: [[0, 0.5], [1, 0.6]] })")
    drag(editor, (0.5, 0.3), (0.5, 0.9))
    left, right = trait(editor, "horizon_hint")
    assert left[1] == pytest.approx(0.5 + 0.1 * 0.12 + 0.6, abs=0.01)
    assert right[1] == pytest.approx(0.5 + 0.1 * 0.88 + 0.6, abs=0.01)
    # Both handles wait at the stage's lower edge, and come with the pointer when they are taken.
    handle = editor.get_by_label("Horizon, left end").bounding_box()
    stage = editor.locator(".sw-stage").bounding_box()
    assert handle["y"] + handle["height"] <= stage["y"] + stage["height"] + 1
    assert "below the picture" in editor.locator(".sw-horizon-label").text_content()
    x, y = handle["x"] + handle["width"] / 2, handle["y"] + handle["height"] / 2
    editor.mouse.move(x, y)
    editor.mouse.down()
    move(editor, 0.12, 0.7, steps=4)
    editor.mouse.up()
    assert trait(editor, "horizon_hint")[0] == pytest.approx([0.12, 0.7], abs=0.01)


def test_what_other_methods_see_is_shown_beside_the_horizon(page, coast):
    connect(page, SunEditor(coast).wait(120))
    choose(page, "Set the horizon")
    page.locator(".sw-horizon-other").first.wait_for(state="attached")
    said = page.locator(".sw-horizon-other text").all_text_contents()
    assert "thesis row" in said


def test_names_of_lines_that_meet_do_not_lie_on_each_other(editor):
    choose(editor, "Set the horizon")
    editor.evaluate(
        """() => {
          const { id } = model.sent.findLast(({ action }) => action === "horizons");
          const same = [0.5, 0.5];
          const result = { row_argmax: same, robust_line: [0.5, 0.51], water_line: same };
          model.fire("msg:custom", { type: "response", id, result }, []);
        }"""
    )
    names = editor.locator(".sw-horizon-other text")
    names.nth(2).wait_for(state="attached")
    tops = names.evaluate_all("(all) => all.map((text) => Number(text.getAttribute('y')))")
    assert np.diff(sorted(tops)).min() >= 13


def test_a_guessed_horizon_is_dashed_and_a_given_one_is_not(editor, state):
    tool = editor.locator(".sw-horizon-tool")
    choose(editor, "Set the horizon")
    expected = ((0.1, True, "Guessed"), (0.4, False, "Found, uncertain"), (0.9, False, "Found ·"))
    for confidence, guessed, said in expected:
        horizon = {**state["_scene"]["horizon"], "confidence": confidence}
        scene = {**state["_scene"], "horizon": horizon, "revision": confidence}
        editor.evaluate("(scene) => model.receive({ _scene: scene })", scene)
        editor.wait_for_function(
            "(said) => document.querySelector('.sw-horizon-label').textContent.startsWith(said)",
            arg=said,
        )
        assert ("sw-guessed" in tool.get_attribute("class")) == guessed
    editor.evaluate("model.receive({ horizon_hint: [[0, 0.5], [1, 0.5]] })")
    editor.get_by_text("Set by hand · level", exact=True).wait_for(state="attached")
    assert "sw-guessed" not in tool.get_attribute("class")


def test_the_histogram_counts_the_sky_and_its_lines_set_the_thresholds(editor, state):
    # Un-mixed clouds need no thresholds, and the panel says so.
    assert "un-mixed" in editor.locator(".sw-histogram-text").text_content()
    editor.locator("[data-section='clouds'] .sw-fold").click()
    editor.locator(".sw-more:has(.sw-histogram) > summary").click()
    whiteness = {**state["_scene"]["whiteness"], "method": "rb_ratio"}
    scene = {**state["_scene"], "whiteness": whiteness, "revision": 7}
    editor.evaluate("(scene) => model.receive({ _scene: scene })", scene)
    editor.locator(".sw-softness:not(.sw-idle)").wait_for()
    text = editor.locator(".sw-histogram-text").text_content()
    shares = [float(part) for part in text.replace("·", " ").split() if part.isdigit()]
    assert sum(shares) == pytest.approx(100, abs=2)
    editor.locator(".sw-histogram").scroll_into_view_if_needed()
    histogram = editor.locator(".sw-histogram").bounding_box()

    def at(ratio):
        return histogram["x"] + ratio / 1.6 * histogram["width"]

    middle = histogram["y"] + histogram["height"] / 2
    editor.mouse.move(at(0.63), middle)
    editor.mouse.down()
    editor.mouse.move(at(0.4), middle, steps=4)
    editor.mouse.up()
    assert trait(editor, "cloud_ratio_min") == pytest.approx(0.4, abs=0.02)
    assert len(trait(editor, "_history")["past"]) == 1
    # m_max stays above m_min.
    editor.mouse.move(at(0.99), middle)
    editor.mouse.down()
    editor.mouse.move(at(0.1), middle, steps=4)
    editor.mouse.up()
    assert trait(editor, "cloud_ratio_max") > trait(editor, "cloud_ratio_min")
    assert "Not spread" in editor.locator(".sw-histogram-text").text_content()
    handle = editor.locator(".sw-histogram-line").nth(1)
    handle.focus()
    before = trait(editor, "cloud_ratio_max")
    editor.keyboard.press("Shift+ArrowRight")
    assert trait(editor, "cloud_ratio_max") == pytest.approx(before + 0.1)
    editor.mouse.dblclick(at(1.5), middle)
    assert (trait(editor, "cloud_ratio_min"), trait(editor, "cloud_ratio_max")) == (0.62, 1.0)


def test_how_sure_the_atmosphere_is_stands_under_the_picture(editor, state):
    scene = {**state["_scene"], "sureness": 0.804, "revision": 21}
    editor.evaluate("(scene) => model.receive({ _scene: scene })", scene)
    said = editor.get_by_text("Atmosphere: fits well", exact=True)
    said.wait_for()
    editor.evaluate(
        "(scene) => model.receive({ _scene: scene })", {**scene, "sureness": None, "revision": 22}
    )
    said.wait_for(state="detached")


def test_notes_can_be_put_away_and_brought_back(editor, state):
    notes = editor.locator(".sw-note span")
    first = "The horizon is a <b>guess</b>. Drag it."
    rows = [{"about": "horizon", "text": first}, {"about": "", "text": "No lens."}]
    sure = {**state["_scene"]["sun"], "confidence": 1}  # of which no note is made
    scene = {**state["_scene"], "sun": sure, "notes": rows, "revision": 5}
    editor.evaluate("(scene) => model.receive({ _scene: scene })", scene)
    editor.get_by_text(first, exact=True).wait_for()
    assert notes.all_text_contents() == [first, "No lens."]
    editor.get_by_role("button", name="Dismiss this note").first.click()
    assert notes.all_text_contents() == ["No lens."]
    # Put away means away, also when the scene comes again.
    editor.evaluate("(scene) => model.receive({ _scene: scene })", {**scene, "revision": 6})
    editor.wait_for_timeout(400)
    assert notes.all_text_contents() == ["No lens."]
    editor.get_by_role("button", name="1 note").click()
    assert notes.count() == 2
