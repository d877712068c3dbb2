"""Recipes, named versions, dropped photos, and edits that outlive kernel and page."""

import json

import numpy as np
import pytest
from chromium import ORIGIN, connect, paste, picture_of, widget_state
from PIL import Image

import sunwidget as sw
from sunwidget.widgets import SunEditor

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]


@pytest.fixture(scope="module")
def state(coast):
    return widget_state(SunEditor(coast).wait())


@pytest.fixture(scope="module")
def one_step_right(coast):
    """The sun's azimuth after a press of an arrow key, which moves it to a tenth of a degree."""
    return round(coast.sun.azimuth + 0.1, 1)


def show(page, state, session="first", **changes):
    """Show the editor as the cell does when it is run: in a session of its own."""
    source = {**state["_source"], "session": session}
    page.evaluate("(state) => showEditor(state)", {**state, "_source": source, **changes})
    page.locator(".sunwidget.sw-live").wait_for()


def trait(page, name):
    return page.evaluate("(name) => model.get(name)", name)


def choose(page, entry):
    page.get_by_role("button", name="Menu").click()
    page.get_by_role("menuitem", name=entry).click()


def test_an_edit_outlives_kernel_and_page_and_is_never_forced_on_anybody(
    page, state, one_step_right, screenshots
):
    show(page, state)
    page.get_by_role("slider", name="Azimuth").focus()
    page.keyboard.press("ArrowRight")
    paste(page, '{"exposure": 0.5}')
    page.keyboard.press("v")
    page.keyboard.type("warm")
    page.keyboard.press("Enter")
    page.keyboard.press("Escape")
    frames = [{"seconds": at, "recipe": {"exposure": at}} for at in (0, 2)]
    page.evaluate("(key_frames) => model.receive({ key_frames })", frames)
    before = trait(page, "_history")
    assert before["past"] == [{}, {"sun_azimuth": one_step_right}]
    page.reload()  # the page is left at once: what was done last is kept all the same
    page.wait_for_function("window.ready")

    # Another photo, and an editor that is alive beside this one, are not asked about.
    show(page, state, "other", _source={"name": "", "session": "x", "fingerprint": "0" * 32})
    assert page.get_by_role("button", name="Restore").count() == 0
    page.evaluate("close_view()")

    show(page, state, "second", sun_elevation=5)
    notice = page.locator(".sw-notice")
    assert "a moment ago" in notice.text_content()
    assert "(Camera exposure, a moment ago)" in notice.text_content(), "it says which edit"
    assert "differs from the recipe in your code" in notice.text_content()
    assert trait(page, "exposure") == 0, "a recipe that code gives is not replaced unasked"
    page.screenshot(path=screenshots / "restore-light.png")
    page.get_by_role("button", name="Restore").click()
    assert trait(page, "exposure") == 0.5
    assert trait(page, "sun_elevation") is None
    assert [version["name"] for version in trait(page, "_versions")] == ["warm"]
    assert trait(page, "key_frames") == frames
    assert page.get_by_role("button", name="Restore").count() == 0
    page.keyboard.press("Control+z")
    assert trait(page, "sun_elevation") == 5, "what was given is a step, not lost"
    page.evaluate("close_view()")

    # A cell that runs again may show its new editor before the last one goes. Put away, the edit
    # is not offered again, but can still be had.
    show(page, state, "living")
    paste(page, '{"exposure": 2}')
    page.evaluate("window.close_last = close_view")
    show(page, state, "third")
    page.evaluate("close_last()")
    page.locator(".sw-notice").get_by_text("is kept").wait_for()
    page.get_by_role("button", name="Dismiss this notice").click()
    page.evaluate("close_view()")
    show(page, state, "fourth")
    assert page.get_by_role("button", name="Restore").count() == 0
    choose(page, "Restore last edit")
    assert trait(page, "exposure") == 2
    assert page.errors == []


def test_a_further_view_of_an_editor_at_work_does_not_offer_what_the_first_one_does(page, state):
    show(page, state, "first")
    paste(page, '{"exposure": 1}')
    page.evaluate("close_view()")
    show(page, state, "second")
    page.get_by_role("button", name="Restore").wait_for()
    page.evaluate("window.close_first = close_view; window.first = model")
    show(page, state, "second")
    page.wait_for_timeout(1800)  # longer than it waits for a view that goes late
    assert page.locator(".sunwidget").count() == 2
    assert page.get_by_role("button", name="Restore").count() == 1
    page.evaluate("close_first()")  # or its session counts as alive in the tests that follow
    assert page.errors == []


def test_an_editor_speaks_to_the_kernel_before_anybody_does_anything(page, state):
    # JupyterLab opens the way past busy cells with a widget's first message.
    show(page, state)
    assert page.evaluate("model.asked") == 1


def test_of_several_edits_the_last_is_offered_and_older_ones_by_the_menu_alone(page, state):
    for session, exposure in [("first", 1), ("second", 2)]:
        show(page, state, session)
        paste(page, f'{{"exposure": {exposure}}}')
        page.evaluate("close_view()")
    show(page, state, "third")
    page.locator(".sw-notice").get_by_text("(Camera exposure, a moment ago)").wait_for()
    page.get_by_role("button", name="Restore").click()
    assert trait(page, "exposure") == 2
    page.wait_for_timeout(1800)  # longer than it waits for a view that goes late
    assert page.get_by_role("button", name="Restore").count() == 0
    choose(page, "Restore last edit")
    assert trait(page, "exposure") == 1
    assert page.errors == []


def test_a_page_without_kernel_goes_on_and_keeps_what_is_done(
    page, state, one_step_right, screenshots
):
    page.evaluate(
        """(state) => {
          const make = window.makeModel;
          const lost = { widget_manager: {}, comm_live: false };
          window.makeModel = (state) => Object.assign(make(state), lost);
          showEditor(state);
        }""",
        state,
    )
    page.locator(".sunwidget.sw-live").wait_for()
    assert "The editor's kernel is gone" in page.locator(".sw-notice").text_content()
    assert page.get_by_role("radio", name="Brush: sky").is_disabled()
    page.get_by_role("slider", name="Azimuth").focus()
    page.keyboard.press("ArrowRight")
    page.emulate_media(color_scheme="dark")
    page.screenshot(path=screenshots / "kernel-gone-dark.png")
    page.wait_for_timeout(700)
    page.goto(f"{ORIGIN}/page.html")
    page.wait_for_function("window.ready")
    show(page, state, "next")
    page.get_by_role("button", name="Restore").click()
    assert trait(page, "sun_azimuth") == pytest.approx(one_step_right)
    assert page.errors == []


def test_a_browser_without_storage_edits_as_ever(fresh_page, state):
    page = fresh_page
    page.evaluate(
        "Object.defineProperty(window, 'localStorage', { get() { throw new Error('no'); } })"
    )
    show(page, state)
    paste(page, '{"exposure": 1}')
    page.wait_for_timeout(700)
    assert trait(page, "exposure") == 1
    page.evaluate("close_view()")
    assert page.errors == []


def test_versions_are_kept_renamed_gone_to_and_deleted(page, state, screenshots):
    show(page, state)
    for number, exposure in enumerate((0.5, 1), 1):
        paste(page, json.dumps({"exposure": exposure}))
        page.get_by_role("button", name="Versions").click()
        field = page.get_by_label("Name of the version")
        assert field.input_value() == f"Version {number}"
        page.keyboard.press("Enter")
        page.keyboard.press("Escape")
    page.get_by_role("button", name="Versions").click()
    field.fill("Version 1")
    page.keyboard.press("Enter")
    assert page.locator(".sw-versions [role=alert]").text_content() == (
        "“Version 1” already exists. Choose another name."
    )
    page.get_by_role("button", name="Rename “Version 1”").click()
    page.keyboard.type("<b>dim</b>")
    page.keyboard.press("Enter")
    page.screenshot(path=screenshots / "versions-light.png")
    page.get_by_role("button", name="<b>dim</b>", exact=True).click()
    assert trait(page, "exposure") == 0.5
    page.get_by_role("button", name="Delete “<b>dim</b>”").click()
    page.keyboard.press("Escape")
    assert [version["name"] for version in trait(page, "_versions")] == ["Version 2"]
    page.get_by_role("button", name="Keep it").click()
    kept = [version["name"] for version in trait(page, "_versions")]
    assert kept == ["<b>dim</b>", "Version 2"]
    undo = page.get_by_role("button", name="Undo", exact=True)
    assert undo.get_attribute("title") == "Undo: Camera exposure (Ctrl+Z)"
    undo.click()
    assert trait(page, "exposure") == 1, "going to a version is one step"
    assert page.errors == []


def test_recipes_are_pasted_copied_and_saved_by_the_menus_keys(page, state):
    show(page, state)
    text = '{"sun_elevation": 3, "exposure": -0.5}'
    paste(page, text)
    assert (trait(page, "sun_elevation"), trait(page, "exposure")) == (3, -0.5)
    page.get_by_role("button", name="Revert").click()
    assert trait(page, "exposure") == 0
    paste(page, text)
    page.get_by_text("Recipe applied.").wait_for()
    for text, said in [
        ('{"exposure": 9}', "exposure is a number from -4 to 4 EV, not 9."),
        ("<img src=x onerror=alert(1)>", "No recipe found"),
    ]:
        paste(page, text)
        assert said in page.get_by_role("alert").first.text_content()
        assert trait(page, "exposure") == -0.5
        assert page.get_by_text("Recipe applied.").count() == 0
    menu = page.get_by_role("button", name="Menu")
    menu.focus()
    page.keyboard.press("ArrowDown")
    assert menu.get_attribute("aria-expanded") == "true"
    page.keyboard.press("s")
    assert page.evaluate("document.activeElement.textContent") == "Save recipe"
    with page.expect_download() as download:
        page.keyboard.press("Enter")
    assert menu.get_attribute("aria-expanded") == "false"
    assert page.evaluate("document.activeElement.getAttribute('aria-label')") == "Menu"
    saved = download.value.path().read_text("utf-8")
    assert sw.Edit.from_json(saved) == sw.Edit(sun_elevation=3, exposure=-0.5)
    # The test's page has no encryption and so no clipboard of its own: what is selected is copied.
    page.evaluate(
        "addEventListener('copy', () => { window.copied = document.activeElement.value; })"
    )
    choose(page, "Copy as Python")
    space = {}
    page.wait_for_function("window.copied")
    exec(page.evaluate("copied"), space)
    assert space["edit"] == sw.Edit.from_json(saved)
    assert page.errors == []


def test_pasted_python_is_read_by_the_kernel_and_never_run(page, coast):
    connect(page, SunEditor(coast).wait(120))
    paste(page, "import sunwidget as sw\nedit = sw.Edit(sun_elevation=3, exposure=-0.5)")
    page.get_by_text("Recipe applied.").wait_for()
    assert (trait(page, "sun_elevation"), trait(page, "exposure")) == (3, -0.5)
    lost = "Object.assign(model, { widget_manager: {}, comm_live: false })"
    for text, said in [
        ("sw.Edit(exposure=9)", "Nothing was changed. exposure = 9 is outside -4 to 4 EV."),
        ("sw.Edit(exposure=__import__('os'))", "is not a plain value."),
        ("sw.Edit(exposure=1)", "Paste the recipe as JSON"),
    ]:
        if "JSON" in said:
            page.evaluate(f"{lost}.fire('comm_live_update')")
        paste(page, text)
        page.get_by_role("alert").filter(has_text=said).wait_for()
        assert trait(page, "exposure") == -0.5
        assert page.locator(".sw-notice", has_text="The kernel is reading").count() == 0
    assert page.errors == []


DROP = """([name, bytes]) => {
  const dataTransfer = new DataTransfer();
  dataTransfer.items.add(new File([new Uint8Array(bytes)], name));
  for (const type of ["dragenter", "dragover", "drop"]) {
    const event = new DragEvent(type, { dataTransfer, bubbles: true, cancelable: true });
    document.querySelector(".sw-stage").dispatchEvent(event);
  }
}"""


def test_a_dropped_photo_takes_the_place_of_the_last_whose_edit_is_back_with_it(
    page, coast, tmp_path
):
    editor = SunEditor(coast).wait(120)
    connect(page, editor)
    page.evaluate(DROP, ["warm.json", list(b'{"version": 1, "exposure": 1}')])
    page.wait_for_function("model.get('exposure') === 1")
    page.wait_for_timeout(700)
    page.evaluate(DROP, ["broken.png", list(b"no picture")])
    page.locator(".sw-message:not([hidden])").wait_for()
    assert "broken.png could not be opened" in page.locator(".sw-message").text_content()
    assert editor.edit == sw.Edit(exposure=1)

    small = sw.sample("coast").preview(200)
    Image.fromarray(small[:, ::-1]).save(tmp_path / "turned.png")
    page.evaluate(DROP, ["turned.png", list((tmp_path / "turned.png").read_bytes())])
    for _ in range(200):
        page.wait_for_timeout(100)
        if editor.photo is not coast.photo:
            break
    assert editor.photo.name == "turned.png"
    assert np.array_equal(editor.photo.encoded, small[:, ::-1])
    assert editor.edit == sw.Edit()
    page.evaluate("(state) => model.receive(decoded(state))", widget_state(editor.wait(120)))
    page.wait_for_function(
        "n => document.querySelector('.sunwidget.sw-live .sw-canvas')?.width === n",
        arg=small.shape[1],
    )
    page.wait_for_timeout(500)
    data = page.evaluate("document.querySelector('.sw-canvas').toDataURL().split(',')[1]")
    assert np.abs(picture_of(data).astype(int) - small[:, ::-1]).max() <= 2
    assert trait(page, "exposure") == 0
    assert page.evaluate("model.get('_history').past.length") == 0

    editor.open(coast)
    assert editor.edit == sw.Edit(exposure=1)
    page.evaluate("(state) => model.receive(decoded(state))", widget_state(editor.wait(120)))
    page.wait_for_function("document.querySelector('.sw-canvas').width === 768")
    assert trait(page, "exposure") == 1
    assert page.get_by_role("button", name="Restore").count() == 0
    assert page.errors == []
