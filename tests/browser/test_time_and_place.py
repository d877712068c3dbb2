"""The clock, the sun's path on the picture and the heading by the photo's sun, in a browser."""

import itertools
import math

import pytest
from chromium import widget_state

import sunwidget as sw
from sunwidget.geometry.place import sun_at
from sunwidget.widgets import SunEditor
from sunwidget.widgets.editor.place_clock import recorded_place

pytest.importorskip("pvlib")
pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]


@pytest.fixture(scope="module")
def widget(coast):
    """The coast at its own place and time; the clock stands at 17:00."""
    editor = SunEditor(coast).wait()
    editor._photo_place = recorded_place(sw.sample("coast"))
    told = editor._photo_place
    editor.set_place(*(told[n] for n in ("latitude", "longitude", "date", "time", "heading")))
    editor.time = 17.0
    return editor


@pytest.fixture(scope="module")
def state(widget):
    return widget_state(widget)


def show(page, state):
    page.evaluate("(state) => showEditor(state)", state)
    page.locator(".sunwidget.sw-live").wait_for()
    return page


def trait(page, name):
    return page.evaluate("(name) => model.get(name)", name)


def place_of(page):
    return sw.Place(**trait(page, "place"))


def on_its_path(page):
    """Assert that the sun stands where the kernel has it at the clock's time."""
    expected = sun_at(place_of(page))
    # The clock's time is rounded to a third of a second, in which the sun goes so far.
    assert trait(page, "sun_azimuth") == pytest.approx(expected.azimuth, abs=2e-3)
    assert trait(page, "sun_elevation") == pytest.approx(expected.elevation, abs=2e-3)


def hour_mark(page, text):
    """Where on the page an hour of the path is."""
    found = page.evaluate(
        """(text) => {
          const all = [...document.querySelectorAll(".sw-path-marks > *")];
          const at = all.findIndex((node) => node.textContent === text);
          const { x, y, width, height } = all[at - 1].getBoundingClientRect();
          return [x + width / 2, y + height / 2];
        }""",
        text,
    )
    return tuple(found)


def test_the_path_is_dragged_along_and_the_clock_goes_with_the_sun(page, state):
    show(page, state)
    before = place_of(page)
    steps = len(trait(page, "_history")["past"])
    x, y = hour_mark(page, "16:00")
    # The 16:00 mark on the overlay is where the camera sees the sun at that time.
    page.mouse.move(x, y)
    assert page.locator(".sw-path-ghost text").text_content() == "16:00"
    page.mouse.down()
    assert place_of(page).time == before.time or place_of(page).time == pytest.approx(16, abs=0.05)
    page.mouse.move(x + 30, y + 4, steps=4)
    page.mouse.up()
    assert 16.0 < place_of(page).time < 17.0
    assert place_of(page).replace(time=0) == before.replace(time=0)
    on_its_path(page)
    assert len(trait(page, "_history")["past"]) == steps + 1
    page.keyboard.press("Control+z")
    assert place_of(page) == before
    # A pixel is about a minute here, and never a jump.
    page.mouse.move(x, y)
    page.mouse.down()
    hours = []
    for i in range(1, 13):
        page.mouse.move(x + i, y + (i % 3))
        hours.append(float(page.locator(".sw-day-range").input_value()))
    assert max(abs(b - a) for a, b in itertools.pairwise(hours)) < 0.06
    assert hours[-1] > hours[0]
    page.keyboard.press("Escape")
    page.mouse.up()
    assert place_of(page) == before
    assert page.errors == []


def test_the_clock_needs_no_kernel_once_the_path_is_there(page, state):
    show(page, {**state, "_standalone": True})
    strip = page.get_by_role("slider", name="Time of day, UTC")
    strip.focus()
    page.keyboard.press("Shift+ArrowRight")
    page.keyboard.press("ArrowLeft")
    assert place_of(page).time == pytest.approx(18 - 5 / 60, abs=0.02)
    on_its_path(page)
    said = page.locator(".sw-day .sw-hint").text_content()
    sun = sun_at(place_of(page))
    assert f"Apparent elevation {sun.elevation:.1f}°, true {sun.true_elevation:.1f}°" in said
    # Another day or place is the kernel's to compute.
    assert page.get_by_label("Latitude").is_disabled()
    assert "Needs the kernel" in page.get_by_label("Date, UTC").get_attribute("title")
    page.get_by_role("button", name="Play the day").click()
    page.wait_for_timeout(600)
    page.get_by_role("button", name="Play the day").click()
    assert place_of(page).time > 18
    on_its_path(page)
    # Kept on its path, the sun itself turns the clock.
    page.get_by_role("switch", name="Keep the sun on the path").click()
    page.get_by_role("slider", name="Sun", exact=True).focus()
    time = place_of(page).time
    page.keyboard.press("ArrowLeft")
    assert place_of(page).time == pytest.approx(time - 5 / 60, abs=0.01)
    assert page.errors == []


def test_place_and_heading_come_from_the_photo(page, widget, state):
    plain = {**state, "place": None, "_day": {}, "sun_azimuth": None, "sun_elevation": None}
    told = {**state["_photo_place"], "heading": None, "time": state["_photo_place"]["time"] - 1}
    show(page, {**plain, "_photo_place": told})
    assert page.locator(".sw-path").get_attribute("visibility") == "hidden"
    page.get_by_text("Time and place").click()
    page.get_by_role("button", name="From the photo").click()
    assert trait(page, "place")["heading"] is None
    assert trait(page, "sun_azimuth") is None  # a place moves nothing
    # What the kernel answers to it.
    widget.place = place_of(page)
    page.evaluate("(day) => model.receive({ _day: day })", widget._day)
    page.get_by_role("button", name="Match the photo's sun").click()
    found = widget.heading_by_sun()
    assert trait(page, "place")["heading"] == pytest.approx(found.place.heading, abs=1e-3)
    # An hour's error of the clock: the browser says what the kernel says, and offers its times.
    note = page.locator(".sw-clock [role=status]")
    assert note.text_content().startswith(found.note.split("elevations agree")[0])
    best = found.agreeing[0]
    minutes = math.floor(best.time * 60 + 0.5)
    page.get_by_role("button", name=f"{minutes // 60:02d}:{minutes % 60:02d} UTC").click()
    assert trait(page, "place") == pytest.approx(vars(best), abs=2e-3)
    assert trait(page, "sun_azimuth") is None
    assert page.locator(".sw-path").get_attribute("visibility") == "visible"
    assert page.errors == []


def test_without_pvlib_the_section_says_what_to_install(page, state):
    day = {"key": state["_day"]["key"], "error": "Run: pip install 'sunwidget[solar]'"}
    show(page, {**state, "_day": day})
    assert page.get_by_text("Run: pip install 'sunwidget[solar]'").is_visible()
    assert page.get_by_label("Latitude").input_value() == str(state["place"]["latitude"])
    assert page.get_by_role("slider", name="Time of day, UTC").count() == 0
    assert page.errors == []
