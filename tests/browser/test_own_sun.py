"""What the editor says of the photo's own sun, and how a person corrects it, in a real browser."""

import dataclasses

import numpy as np
import pytest
from chromium import connect, widget_state

import sunwidget as sw
from sunwidget.analysis import correct
from sunwidget.widgets import SunEditor

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]

RING = ".sw-own-sun-ring"
LABEL = ".sw-own-sun-label"


@pytest.fixture(scope="module")
def scene(coast):
    """A sun that was found, and is believed by 93 in 100."""
    return dataclasses.replace(coast, sun=dataclasses.replace(coast.sun, confidence=0.93))


@pytest.fixture(scope="module")
def state(scene):
    return widget_state(SunEditor(scene).wait(120))


@pytest.fixture
def editor(page, state):
    page.evaluate("(state) => showEditor(state)", state)
    page.locator(".sunwidget.sw-live").wait_for()
    yield page
    assert page.errors == []


@pytest.fixture
def connected(page, scene):
    """An editor with a kernel that answers: the page, and its widget."""
    widget = SunEditor(scene).wait(120)
    connect(page, widget)
    yield page, widget
    assert page.errors == []


def trait(page, name):
    return page.evaluate("(name) => model.get(name)", name)


def middle(page, selector):
    box = page.locator(selector).bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def on_picture(page, x, y):
    box = page.locator(".sw-picture").bounding_box()
    return box["x"] + x * box["width"], box["y"] + y * box["height"]


def hover(page, at):
    """A hand is never quite still."""
    page.mouse.move(*at)
    page.mouse.move(at[0] + 1, at[1])


def notes(page):
    return page.locator(".sw-note span").all_text_contents()


def answered(page):
    page.wait_for_function("document.querySelector('.sunwidget').dataset.stage === 'ready'")


def test_a_ring_marks_the_found_sun_and_says_how_sure_that_is(editor, scene):
    at = scene.sun.x / scene.width, scene.sun.y / scene.height
    assert middle(editor, RING) == pytest.approx(on_picture(editor, *at), abs=1)
    label = editor.locator(LABEL)
    assert label.is_hidden()
    hover(editor, middle(editor, RING))
    label.wait_for()
    assert label.locator("span").first.text_content() == "The photo’s sun, 93\xa0% sure"
    # The way from the ring to the label does not close it; away from both it goes.
    hover(editor, middle(editor, f"{LABEL} > span >> nth=0"))
    editor.wait_for_timeout(600)
    assert label.is_visible()
    hover(editor, on_picture(editor, 0.1, 0.9))
    label.wait_for(state="hidden")


def test_a_sun_that_is_sure_has_no_percentage(page, coast):
    hinted = dataclasses.replace(coast, sun=dataclasses.replace(coast.sun, confidence=1.0))
    page.evaluate("(state) => showEditor(state)", widget_state(SunEditor(hinted).wait(120)))
    page.locator(".sunwidget.sw-live").wait_for()
    assert page.locator(RING).get_attribute("aria-label") == "The photo’s sun"


def test_the_ring_takes_no_drag_from_the_handle_and_is_gone_while_it_lasts(editor):
    x, y = middle(editor, RING)
    editor.mouse.move(x + 3, y)
    editor.mouse.down()
    editor.mouse.move(x - 120, y - 40, steps=4)
    ring = editor.locator(RING)
    ring.wait_for(state="hidden")
    editor.mouse.up()
    ring.wait_for()
    assert trait(editor, "sun_azimuth") is not None
    assert trait(editor, "sun_hint") is None
    # It stays where the photo's sun is, and now takes clicks itself.
    assert middle(editor, RING) == pytest.approx((x, y), abs=1)
    moved = trait(editor, "sun_azimuth")
    editor.mouse.click(x, y)
    editor.locator(LABEL).wait_for()
    assert trait(editor, "sun_azimuth") == moved


def test_not_the_sun_leaves_the_photo_without_one_and_can_be_undone(connected):
    page, widget = connected
    hover(page, middle(page, RING))
    page.locator(LABEL).get_by_role("button", name="Not the sun").click()
    said = page.get_by_text("You said that the sun is not in the picture.")
    said.wait_for()
    answered(page)
    assert widget.sun_hint == "outside"
    assert widget.scene.sun is None
    assert page.locator(RING).is_hidden()
    assert not any("sun=" in note for note in notes(page))
    page.get_by_role("button", name="Undo that").click()
    page.locator(RING).wait_for()
    said.wait_for(state="detached")
    assert widget.sun_hint is None
    assert widget.scene.sun is not None
    assert len(trait(page, "_history")["past"]) == 2


def test_a_note_leads_to_the_tool_that_points_at_the_sun(page, coast):
    """The trap it mends: a click while the first tool was chosen moved the new sun."""
    unseen = correct.corrected(coast, sw.Edit(sun_hint="outside"))
    hints = dataclasses.replace(unseen.hints, sun=None)
    widget = SunEditor(dataclasses.replace(unseen, hints=hints)).wait(120)
    connect(page, widget)
    assert page.locator(RING).is_hidden()
    page.get_by_text("No sun").wait_for()
    page.get_by_role("button", name="The sun is here").click()
    assert page.evaluate("document.querySelector('.sunwidget').dataset.tool") == "pick"
    page.get_by_text("Click where the photo’s sun is.").wait_for()
    place = coast.sun.x / coast.width, coast.sun.y / coast.height
    page.mouse.click(*on_picture(page, *place))
    page.get_by_text("The photo’s sun is set:").wait_for()
    answered(page)
    assert widget.sun_hint == pytest.approx(place, abs=2e-3)
    assert widget.scene.sun.visible
    assert widget.sun_azimuth is None
    assert not any("sun" in note.lower() for note in notes(page))
    assert page.evaluate("document.querySelector('.sunwidget').dataset.tool") == "sun"
    assert page.locator(RING).get_attribute("aria-label") == "The photo’s sun, set by you"


def test_the_mark_is_reached_and_used_by_keyboard_alone(connected):
    page, widget = connected
    page.locator(RING).focus()
    label = page.locator(LABEL)
    label.wait_for()
    page.keyboard.press("Tab")
    assert label.get_by_role("button", name="Not the sun").evaluate(
        "(node) => node === document.activeElement"
    )
    page.keyboard.press("Escape")
    label.wait_for(state="hidden")
    page.keyboard.press("Enter")
    label.wait_for()
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    assert page.evaluate("document.querySelector('.sunwidget').dataset.tool") == "pick"
    # The cross is there, and points.
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    page.get_by_text("The photo’s sun is set:").wait_for()
    answered(page)
    assert widget.sun_hint[0] > 0.5


def test_a_finger_that_taps_the_sun_asks_about_it(browser, state):
    from chromium import open_page

    context = browser.new_context(has_touch=True, viewport={"width": 400, "height": 800})
    page = open_page(context)
    page.evaluate("(state) => showEditor(state)", state)
    page.locator(".sunwidget.sw-live").wait_for()
    page.touchscreen.tap(*middle(page, RING))
    label = page.locator(LABEL)
    label.wait_for()
    box, stage = label.bounding_box(), page.locator(".sw-stage").bounding_box()
    assert stage["x"] <= box["x"]
    assert box["x"] + box["width"] <= stage["x"] + stage["width"]
    assert trait(page, "sun_azimuth") is None
    assert page.errors == []
    context.close()


def test_a_page_without_a_kernel_tells_and_offers_nothing(page, state):
    unsure = {**state["_scene"], "sun": {**state["_scene"]["sun"], "confidence": 0.4}}
    page.evaluate("(state) => showEditor(state)", {**state, "_scene": unsure, "_standalone": True})
    page.locator(".sunwidget.sw-live").wait_for()
    page.locator(RING).focus()
    assert page.locator(LABEL).text_content().startswith("The photo’s sun, 40\xa0% sure")
    assert page.locator(f"{LABEL} button").first.is_hidden()
    assert page.locator(".sw-note").count() == 0


def test_the_mark_is_in_no_picture(editor):
    """It lies over the canvas, which is what is downloaded and recorded."""
    inside = editor.evaluate(
        "document.querySelector('.sw-picture').contains(document.querySelector('.sw-own-sun'))"
    )
    assert inside is False


def test_no_note_speaks_of_code(page):
    dull = np.full((48, 64, 3), 90, np.uint8)
    bare = sw.analyze(dull, sky=np.zeros((48, 64)))
    page.evaluate("(state) => showEditor(state)", widget_state(SunEditor(bare).wait(120)))
    page.locator(".sw-note").first.wait_for()
    assert len(notes(page)) == 4
    assert not any("=" in note or "pass " in note.lower() for note in notes(page))


@pytest.mark.parametrize("by", [(60, 5), (-60, 5), (45, 40)])
def test_the_label_lies_beside_the_sun_that_was_dragged_near_its_mark(editor, by):
    x, y = middle(editor, RING)
    editor.mouse.move(x, y)
    editor.mouse.down()
    editor.mouse.move(x + by[0], y + by[1], steps=4)
    editor.mouse.up()
    hover(editor, middle(editor, RING))
    editor.locator(LABEL).wait_for()
    handle = middle(editor, ".sw-sun-ring")
    assert handle == pytest.approx((x + by[0], y + by[1]), abs=2)
    on = editor.evaluate(
        "at => document.elementFromPoint(...at).closest('.sw-overlay')?.tagName", handle
    )
    assert on is not None
