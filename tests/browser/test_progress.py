"""Progress of the kernel's work: said by name, cancelled, tried again."""

import pytest
from chromium import widget_state

from sunwidget.widgets import SunEditor

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]


@pytest.fixture(scope="module")
def state(coast):
    return widget_state(SunEditor(coast).wait())


def sent(page):
    return page.evaluate("model.sent")


def say(page, stage, message, fraction=0.82):
    status = {"stage": stage, "fraction": fraction, "message": message}
    page.evaluate("(status) => model.receive({_status: status})", status)


def test_an_analysis_is_cancelled_and_tried_again(page, state, screenshots):
    page.evaluate("(state) => showEditor(state)", {**state, "_scene": {}, "_layers": ""})
    say(page, "analysing", "Fitting the atmosphere …")
    page.locator(".sw-has-photo .sw-photo").wait_for()
    assert page.locator(".sw-progress-line").text_content().startswith("Fitting the atmosphere …")
    page.screenshot(path=screenshots / "progress-light.png")
    page.get_by_role("button", name="Cancel").click()
    assert sent(page)[-1]["action"] == "cancel"
    assert page.get_by_role("button", name="Cancel").is_disabled()
    say(page, "cancelled", "The analysis was cancelled.", 1)
    assert not page.locator(".sw-progress-cancel").is_visible()
    page.emulate_media(color_scheme="dark")
    page.screenshot(path=screenshots / "progress-cancelled-dark.png")
    page.get_by_role("button", name="Try again").click()
    assert sent(page)[-1]["action"] == "retry"
    say(page, "analysing", "Finding the sky …")
    assert page.get_by_role("button", name="Cancel").is_enabled()
    say(page, "error", "sky: expected a mask of 768 × 512 pixels.", 1)
    assert page.get_by_role("alert").text_content().startswith("sky: expected a mask")
    page.get_by_role("button", name="Try again").wait_for()
    say(page, "ready", "", 1)
    assert page.get_by_role("button", name="Try again").count() == 0
    assert page.errors == []


def test_an_export_is_cancelled_and_tried_again(page, state):
    page.evaluate("(state) => showEditor(state)", state)
    page.locator(".sunwidget.sw-live").wait_for()
    page.get_by_role("button", name="Save", exact=True).click()
    request = sent(page)[-1]
    progress = {"type": "progress", "fraction": 0.4, "message": "Rendering …"}
    page.evaluate(
        "(message) => model.fire('msg:custom', message, [])", {**progress, "id": request["id"]}
    )
    assert page.locator(".sw-progress-text").text_content() == "Rendering …"
    page.get_by_role("button", name="Cancel").click()
    assert sent(page)[-1] == {"type": "cancel", "id": request["id"]}
    page.get_by_text("Saving was canceled.").wait_for()
    assert page.get_by_role("button", name="Save", exact=True).is_enabled()
    # What the kernel says of it from now on is nobody's business.
    page.evaluate(
        "(message) => model.fire('msg:custom', message, [])",
        {**progress, "id": request["id"], "fraction": 0.9},
    )
    assert page.locator(".sw-progress.sw-shown").count() == 0
    page.get_by_role("button", name="Try again").click()
    again = sent(page)[-1]
    assert again["action"] == "save"
    assert again["id"] != request["id"]
    assert page.errors == []
