"""Compare and Study in a real browser, without a notebook: a stand-in plays the model."""

import base64

import numpy as np
import pytest
from chromium import open_page

import sunwidget.study
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
    yield page
    assert page.errors == []
    context.close()


def plain(level):
    return np.full((60, 90, 3), level, np.uint8)


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
    page.get_by_text("All 6 pairs are answered").wait_for()
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
