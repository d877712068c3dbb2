"""Compare and Study in a real browser, without a notebook: a stand-in plays the model."""

import base64

import numpy as np
import pytest
from chromium import LOSE_ONCE, open_page, picture_of, widget_state
from skimage.color import deltaE_ciede2000, rgb2lab

import sunwidget as sw
import sunwidget.study
from sunwidget.widgets.compare.compare import Compare
from sunwidget.widgets.editor.sun_editor import SunEditor
from sunwidget.widgets.study import Study

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]


def encoded(value):
    """The value with its bytes as the page takes them."""
    if isinstance(value, (bytes, memoryview)):
        return {"base64": base64.b64encode(value).decode("ascii")}
    if isinstance(value, (list, tuple)):
        return [encoded(item) for item in value]
    if isinstance(value, dict):
        return {name: encoded(item) for name, item in value.items()}
    return value


def state_of(widget):
    """The widget's traits as the page takes them."""
    state = widget.get_state()
    return {name: encoded(v) for name, v in state.items() if name not in ("_esm", "_css", "layout")}


@pytest.fixture
def page(browser):
    context = browser.new_context(viewport={"width": 1180, "height": 860}, accept_downloads=True)
    page = open_page(context, "compare.html")
    page.set_default_timeout(40_000)
    yield page
    assert page.errors == []
    context.close()


def plain(level):
    return np.full((60, 90, 3), level, np.uint8)


def test_a_study_that_a_notebook_had_saved_gives_its_answers(page, tmp_path):
    study = Study({"a": plain(40), "b": plain(220)})
    answer = sunwidget.study.Answer("anna", 1, "", "a", "b", "left", 1.5, "2026-11-24T12:00:00Z")
    study.set_state({"_answers": [answer._asdict()]})
    page.evaluate(
        "(state) => show('study', state)", state_of(study) | {"_saved": True, "_pictures": []}
    )
    page.get_by_text("Save them before you run the cell").wait_for()
    page.locator(".sw-study-text img").wait_for()
    assert page.get_by_role("button", name="Start").count() == 0
    with page.expect_download() as download:
        page.get_by_role("button", name="Save answers").click()
    download.value.save_as(tmp_path / "answers.csv")
    assert sunwidget.study.read_csv(tmp_path / "answers.csv") == study.answers == [answer]


def test_a_study_from_start_to_strengths(page, tmp_path, screenshots):
    """Somebody who always takes the brighter picture; undo, save, and the next rater."""
    level = {"dark": 40, "grey": 120, "bright": 220}
    study = Study({name: plain(value) for name, value in level.items()}, repeats=2, seed=4)
    page.evaluate("(state) => show('study', state)", state_of(study))
    page.get_by_label("Your name or number").fill("<b>anna</b>")
    page.get_by_role("button", name="Start").click()

    def answer(press):
        """Find the brighter side on the screen, take it, and say which it was."""
        page.locator(".sw-study-picture img").nth(1).wait_for()
        left, right = page.evaluate(
            """() => [...document.querySelectorAll(".sw-study-picture img")].map((image) => {
                 const canvas = document.createElement("canvas");
                 const context = canvas.getContext("2d");
                 context.drawImage(image, 0, 0);
                 return context.getImageData(5, 5, 1, 1).data[0];
               })"""
        )
        side = "left" if left > right else "right"
        # Nothing on the page says what made the pictures.
        assert not any(name in page.content() for name in level)
        if press:
            page.keyboard.press("ArrowLeft" if side == "left" else "ArrowRight")
        else:
            page.locator(".sw-study-picture").nth(int(side == "right")).click()
        return side

    page.screenshot(path=screenshots / "study.png")
    sides = [answer(press) for press in (True, False, True)]
    page.get_by_text("4 of 6").wait_for()
    page.keyboard.press("Backspace")
    page.get_by_text("3 of 6").wait_for()
    assert answer(True) == sides[2]
    for _ in range(3):
        answer(True)
    page.get_by_text("You have answered all 6 pairs").wait_for()
    with page.expect_download() as download:
        page.get_by_role("button", name="Save answers").click()
    path = tmp_path / "answers.csv"
    download.value.save_as(path)

    study.set_state({"_answers": page.evaluate("model.get('_answers')")})
    assert sunwidget.study.read_csv(path) == study.answers
    assert [row.trial for row in study.answers] == [1, 2, 3, 4, 5, 6]
    assert [row.choice for row in study.answers[:3]] == sides
    assert {row.rater for row in study.answers} == {"<b>anna</b>"}
    assert all(0 < row.seconds < 60 for row in study.answers)
    found = study.results()
    assert found.methods == ("bright", "grey", "dark")
    assert found.wins[0].sum() == 4

    page.get_by_role("button", name="Next rater").click()
    page.get_by_label("Your name or number").fill("bert")
    page.get_by_role("button", name="Start").click()
    page.get_by_text("1 of 6").wait_for()
    assert len(page.evaluate("model.get('_answers')")) == 6


@pytest.fixture(scope="module")
def methods(coast):
    return Compare(coast, ["photo", "ratio", "thesis"], sun_azimuth=-6, sun_elevation=5).wait()


@pytest.fixture
def comparison(page, methods):
    page.evaluate(
        """() => {
          window.contexts = [];
          const original = HTMLCanvasElement.prototype.getContext;
          HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
            const context = original.call(this, kind, ...rest);
            if (kind === "webgl2") window.contexts.push(context);
            return context;
          };
          // The photo by itself is decoded last.
          const decode = window.createImageBitmap;
          let calls = 0;
          window.createImageBitmap = async (...options) => {
            const late = calls++ === 0;
            if (late) await new Promise((resolve) => setTimeout(resolve, 1000));
            return decode(...options);
          };
        }"""
    )
    page.evaluate("(state) => show('compare', state)", state_of(methods))
    page.locator(".sunwidget.sw-live").wait_for()
    return page


def pictures(page):
    """What the canvases in sight hold, once they are drawn in full."""
    page.locator('.sw-compare-grid[aria-busy="false"]').wait_for()
    found = page.evaluate(
        """() => [...document.querySelectorAll(".sw-compare-cell:not([hidden]) canvas")]
                   .map((canvas) => canvas.toDataURL("image/png").split(",")[1])"""
    )
    return [picture_of(picture) for picture in found]


def test_all_pictures_follow_one_sun_and_are_the_kernels(comparison, methods, screenshots):
    page = comparison
    page.get_by_role("button", name="Difference").click()
    page.get_by_role("button", name="Zoom: ").click()  # a pixel for a pixel
    before = pictures(page)
    for found, kernel in zip(before, methods.render().values(), strict=True):
        assert found.shape == kernel.shape
        assert np.abs(found.astype(int) - kernel).max() <= 1
    assert len(page.evaluate("contexts.filter((gl) => !gl.isContextLost())")) == 1

    # The read-out against another implementation of CIEDE2000, on the whole pictures.
    page.locator(".sw-compare-difference:visible").nth(1).wait_for()
    said = page.locator(".sw-compare-difference:visible").all_inner_texts()
    first, *others = (rgb2lab(picture) for picture in before)
    for text, other in zip(said, others, strict=True):
        assert float(text.split()[1]) == pytest.approx(
            deltaE_ciede2000(first, other).mean(), abs=0.4
        )

    # A drag in the last picture moves the sun of all; the photo stays.
    page.keyboard.press("0")
    fitted = pictures(page)
    cells = page.locator(".sw-compare-cell")
    box = cells.nth(2).bounding_box()
    page.mouse.move(box["x"] + 0.7 * box["width"], box["y"] + 0.3 * box["height"])
    page.mouse.down()
    page.evaluate(LOSE_ONCE)  # a graphics context that is lost meanwhile changes nothing
    page.mouse.move(box["x"] + 0.75 * box["width"], box["y"] + 0.35 * box["height"], steps=3)
    page.mouse.up()
    after = pictures(page)
    page.screenshot(path=screenshots / "compare.png")
    assert np.array_equal(after[0], fitted[0])
    for one, other in zip(after[1:], fitted[1:], strict=True):
        assert np.abs(one.astype(int) - other).mean() > 1
    x = 0.75 * methods.scene.width
    expected = methods.scene.camera.angles(x, 0.35 * methods.scene.height)
    sun = page.evaluate("[model.get('sun_azimuth'), model.get('sun_elevation')]")
    assert sun == pytest.approx(expected, abs=0.2)
    suns = page.locator(".sw-sun").evaluate_all("(all) => all.map((s) => s.ariaValueText)")
    assert len(set(suns)) == 1

    # One step of the history.
    page.get_by_role("button", name="Undo").click()
    assert page.evaluate("model.get('sun_elevation')") == 5
    for one, other in zip(pictures(page), fitted, strict=True):
        assert np.array_equal(one, other)


def test_wheel_button_and_fingers_zoom_and_shift_all_pictures_and_move_no_sun(browser, methods):
    context = browser.new_context(viewport={"width": 1180, "height": 860}, has_touch=True)
    page = open_page(context, "compare.html")
    page.evaluate("(state) => show('compare', state)", state_of(methods))
    page.locator(".sunwidget.sw-live").wait_for()
    cells = [page.locator(".sw-compare-cell").nth(i).bounding_box() for i in range(3)]
    x, y = cells[1]["x"] + 0.7 * cells[1]["width"], cells[1]["y"] + 0.3 * cells[1]["height"]

    def picture():
        """Where every picture lies in its cell: all alike."""
        pictures = page.locator(".sw-compare-picture")
        boxes = [pictures.nth(i).bounding_box() for i in range(3)]
        places = [
            (box["x"] - cell["x"], box["y"] - cell["y"], box["width"])
            for box, cell in zip(boxes, cells, strict=True)
        ]
        assert places[1:] == [pytest.approx(places[0], abs=0.1)] * 2
        return boxes[1]

    def under(x, y):
        box = picture()
        return (x - box["x"]) / box["width"], (y - box["y"]) / box["height"]

    page.mouse.move(x, y)
    page.mouse.wheel(0, -200)
    page.wait_for_timeout(100)
    fitted = picture()["width"]
    assert fitted == pytest.approx(cells[1]["width"])
    page.keyboard.down("Control")
    page.mouse.wheel(0, -200)
    page.mouse.wheel(0, -200)
    page.keyboard.up("Control")
    page.wait_for_timeout(100)
    wheeled = picture()
    assert wheeled["width"] == pytest.approx(np.exp(0.8) * fitted, rel=0.01)
    assert under(x, y) == pytest.approx((0.7, 0.3), abs=0.005)

    page.mouse.down(button="middle")
    page.mouse.move(x - 30, y + 20, steps=3)
    page.mouse.up(button="middle")
    assert under(x - 30, y + 20) == pytest.approx((0.7, 0.3), abs=0.005)

    send = context.new_cdp_session(page).send

    def touch(kind, *points):
        fingers = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]
        send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})

    held = under(x, y)
    touch("touchStart", (x - 20, y))
    touch("touchStart", (x - 20, y), (x + 20, y))
    touch("touchMove", (x - 30, y), (x + 30, y))
    touch("touchMove", (x - 50, y + 10), (x + 30, y + 10))
    page.wait_for_timeout(100)
    assert picture()["width"] == pytest.approx(2 * wheeled["width"], rel=0.01)
    assert under(x - 10, y + 10) == pytest.approx(held, abs=0.005)
    touch("touchEnd")
    sun = page.evaluate("[model.get('sun_azimuth'), model.get('sun_elevation')]")
    assert sun == [-6, 5]
    assert page.errors == []
    context.close()


def test_two_pictures_and_a_divider(comparison):
    page = comparison
    page.get_by_role("radio", name="Wipe").click()
    page.get_by_label("Right picture").select_option("thesis")
    pictures(page)
    divider = page.get_by_role("slider", name="Divider")
    assert "photo" in divider.get_attribute("aria-valuetext")
    over = page.locator(".sw-over canvas")
    assert over.get_attribute("aria-label") == "thesis"
    assert "50%" in over.evaluate("(canvas) => canvas.style.clipPath")
    divider.focus()
    page.keyboard.press("Shift+ArrowRight")
    assert "60%" in over.evaluate("(canvas) => canvas.style.clipPath")
    page.keyboard.press("w")
    assert page.evaluate("model.get('arrangement')") == "side_by_side"
    assert over.count() == 0
    page.evaluate("closeView()")
    assert page.evaluate("contexts.every((gl) => gl.isContextLost())")
    assert page.locator(".sunwidget").count() == 0


def test_own_suns_give_way_to_the_one_that_is_dragged(page, coast):
    recipes = {"<i>low</i>": {"sun_elevation": 2}, "high": {"sun_elevation": 30}}
    page.evaluate("(state) => show('compare', state)", state_of(Compare(coast, recipes).wait()))
    page.locator(".sunwidget.sw-live").wait_for()
    own = page.get_by_role("button", name="Own suns")
    assert own.get_attribute("aria-pressed") == "true"
    page.get_by_role("slider", name="Sun in <i>low</i>").focus()
    page.keyboard.press("ArrowUp")
    page.keyboard.press("Tab")
    assert own.get_attribute("aria-pressed") == "false"
    assert page.evaluate("[model.get('one_sun'), model.get('sun_elevation')]") == [True, 2.5]
    own.click()
    assert page.evaluate("model.get('one_sun')") is False


def test_pages_need_no_kernel_and_no_network(browser, methods, tmp_path):
    context = browser.new_context(viewport={"width": 900, "height": 700}, accept_downloads=True)
    context.set_offline(True)
    page = context.new_page()
    page.set_default_timeout(40_000)
    page.goto(methods.to_html(tmp_path / "compare.html").as_uri())
    page.locator(".sunwidget.sw-live").wait_for()
    page.get_by_role("slider", name="Sun in thesis").focus()
    page.keyboard.press("Shift+ArrowUp")
    page.get_by_role("button", name="Zoom: ").click()
    found = pictures(page)[1]
    edit = methods.edits["ratio"].replace(sun_elevation=methods.sun_elevation + 5)
    kernel = sw.render(methods.scene, edit)
    assert np.abs(found.astype(int) - kernel).max() <= 1

    study = Study({"a": plain(40), "b": plain(220)})
    page.goto(study.to_html(tmp_path / "study.html").as_uri())
    page.get_by_role("button", name="Start").click()
    page.locator(".sw-study-picture").nth(1).click()
    with page.expect_download() as download:
        page.get_by_role("button", name="Save answers").click()
    download.value.save_as(tmp_path / "answers.csv")
    assert [row.choice for row in sunwidget.study.read_csv(tmp_path / "answers.csv")] == ["right"]
    context.close()


def test_edits_in_turn_make_their_tables_once(browser, coast):
    """Two airs side by side: a sun's drag must not make the air anew for every picture."""
    context = browser.new_context()
    page = open_page(context)
    page.evaluate("(state) => makeFrame(state)", widget_state(SunEditor(coast).wait()))
    counts = page.evaluate(
        """() => [1, 2].map((turns) => {
             frame.turns = turns;
             frame.releaseContext();
             const draw = (sun) => ["a", "b"].map((_, i) => drawn(
               { aerosol_optical_depth: 0.1 + 0.2 * i, sun_elevation: sun }, [96, 64]));
             const first = draw(20);
             draw(12);
             const again = draw(20);
             const { multiple_scattering_edit, sky_view_edit } = frame.graph.runs;
             const same = String(first) === String(again);
             return [multiple_scattering_edit, sky_view_edit, same];
           })"""
    )
    context.close()
    (alone, views, same), (kept, *rest) = counts
    assert (alone, kept) == (6, 2)
    assert rest == [views, same] == [6, True]
