"""The editor's panel in a real browser: sections, filter, presets as pictures, histogram."""

import numpy as np
import pytest
from chromium import open_page, picture_of, widget_state
from PIL import Image

import sunwidget as sw
from sunwidget.widgets import SunEditor

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]

# One number of four sections each.
MOVED = {"sun_azimuth": -6.0, "aerosol_optical_depth": 0.2, "cloud_pattern": 12.0, "exposure": -1.0}


@pytest.fixture(scope="module")
def state(coast):
    return widget_state(SunEditor(coast).wait())


@pytest.fixture(scope="module")
def shared(browser, state):
    """One view for all tests; it counts what is drawn."""
    context = browser.new_context(viewport={"width": 1180, "height": 860})
    page = open_page(context)
    page.evaluate(
        """() => {
          window.passes = 0;
          const { prototype } = WebGL2RenderingContext;
          const draw = prototype.drawArrays;
          prototype.drawArrays = function (...rest) {
            window.passes += 1;
            return draw.apply(this, rest);
          };
          window.pictures = [];
          const { drawImage } = CanvasRenderingContext2D.prototype;
          CanvasRenderingContext2D.prototype.drawImage = function (...rest) {
            window.pictures.push(this.canvas.className);
            return drawImage.apply(this, rest);
          };
        }"""
    )
    page.evaluate("(state) => showEditor(state)", state)
    page.locator(".sunwidget.sw-live").wait_for()
    yield page
    context.close()


@pytest.fixture
def panel(shared, state):
    """The view with nothing changed and nothing filtered."""
    defaults = {p["name"]: p["default"] for p in state["_parameters"]}
    shared.evaluate(
        "(edit) => model.receive({ ...edit, _history: { past: [], future: [] } })", defaults
    )
    yield shared
    shared.locator(".sw-filter-field").fill("")
    if shared.locator(".sw-changed").get_attribute("aria-pressed") == "true":
        shared.locator(".sw-changed").click()
    assert shared.errors == []


def receive(page, **edit):
    page.evaluate("(edit) => model.receive(edit)", edit)


def trait(page, name):
    return page.evaluate("(name) => model.get(name)", name)


def fold(page, name):
    return page.locator(f"[data-section='{name}'] .sw-fold")


def rows(page):
    """Names of the parameters in sight."""
    return page.locator("[data-parameter]").evaluate_all(
        "(all) => all.filter((n) => n.checkVisibility()).map((n) => n.dataset.parameter)"
    )


def drawn_thumbnails(page):
    """How many were drawn since ``pictures`` was emptied."""
    return page.evaluate("pictures.filter((name) => name.includes('sw-thumbnail')).length")


def thumbnails(page, fresh=False):
    """The presets' pictures, (H, W, 3) each; ``fresh`` waits until all are drawn again."""
    page.wait_for_function("document.querySelectorAll('.sw-thumbnail.sw-drawn').length === 6")
    if fresh:
        page.wait_for_function(
            "pictures.filter((name) => name.includes('sw-thumbnail')).length >= 6"
        )
    urls = page.locator(".sw-thumbnail.sw-drawn").evaluate_all(
        "(all) => all.map((c) => c.toDataURL())"
    )
    return [picture_of(url.split(",")[1]) for url in urls]


def test_few_things_are_open_and_a_section_says_what_is_changed(panel, state):
    assert fold(panel, "sun").get_attribute("aria-expanded") == "true"
    for name in ("sky", "clouds", "land", "water", "effects", "camera", "match", "advanced"):
        assert fold(panel, name).get_attribute("aria-expanded") == "false"
    assert rows(panel) == ["sun_azimuth", "sun_elevation", "light_source"]
    assert panel.locator(".sw-section-head .sw-count:visible").count() == 0
    receive(panel, **MOVED)
    sky = panel.locator("[data-section='sky']")
    assert sky.locator(".sw-count").text_content() == "1"
    assert sky.locator(".sw-count").get_attribute("title") == "Changed: Haze"
    assert panel.locator(".sw-changed .sw-count").text_content() == "4"
    clouds = panel.locator("[data-section='clouds']")
    assert clouds.locator(".sw-more summary").text_content() == "More· 1 changed"
    panel.get_by_role("button", name="Reset Sky").click()
    assert trait(panel, "aerosol_optical_depth") is None
    assert trait(panel, "exposure") == -1
    assert len(trait(panel, "_history")["past"]) == 1
    assert sky.locator(".sw-count").is_hidden()


def test_a_changed_value_is_marked_and_an_automatic_one_says_so(panel, state):
    row = panel.locator("[data-parameter='sun_elevation']")
    assert row.locator(".sw-found").is_visible()
    assert row.get_by_role("button").count() == 0
    found = state["_scene"]["automatic"]["sun_elevation"]
    slider = row.get_by_role("slider")
    assert slider.get_attribute("aria-valuetext") == f"{found:.1f}°, automatic"
    slider.focus()
    panel.keyboard.press("ArrowRight")
    assert trait(panel, "sun_elevation") == pytest.approx(found + 0.1, abs=0.06)
    assert row.locator(".sw-found").is_hidden()
    row.get_by_role("button", name="Reset Elevation").click()
    assert trait(panel, "sun_elevation") is None
    assert slider.evaluate("(node) => node === document.activeElement")


def test_the_filter_finds_rows_by_their_words_and_puts_everything_back(panel):
    before = rows(panel)
    field = panel.get_by_role("searchbox", name="Find a parameter")
    panel.locator(".sw-stage").focus()
    panel.keyboard.press("/")
    panel.keyboard.type("ozone")
    assert rows(panel) == ["ozone"]
    field.fill("CLOUD added")  # all words, in any place
    assert set(rows(panel)) == {
        "added_clouds", "added_cloud_size", "added_cloud_height", "cloud_pattern",
        "wind_speed", "wind_time",
    }  # fmt: skip
    field.fill("nonsense")
    assert rows(panel) == []
    assert panel.get_by_text("No parameter matches.").is_visible()
    field.press("Escape")
    assert rows(panel) == before
    assert fold(panel, "clouds").get_attribute("aria-expanded") == "false"


def test_only_what_is_changed_can_be_shown(panel):
    button = panel.locator(".sw-changed")
    assert button.is_disabled()
    receive(panel, **MOVED)
    button.click()
    assert rows(panel) == ["sun_azimuth", "aerosol_optical_depth", "cloud_pattern", "exposure"]
    panel.get_by_role("button", name="Reset Exposure").click()
    # The row that has the focus stays, so that nothing jumps under the hand.
    assert "exposure" in rows(panel)
    button.click()
    assert fold(panel, "camera").get_attribute("aria-expanded") == "false"


def test_a_new_view_of_the_editor_is_folded_as_the_last_was_left(panel):
    fold(panel, "water").click()
    panel.evaluate(
        """async () => {
          const { default: editor } = await import("/sun_editor.js");
          const el = document.createElement("div");
          el.id = "again";
          document.body.append(el);
          window.closeAgain = editor.render({ model, el });
        }"""
    )
    again = panel.locator("#again")
    assert fold(again, "water").get_attribute("aria-expanded") == "true"
    fold(again, "water").click()
    assert fold(panel.locator("#host"), "water").get_attribute("aria-expanded") == "true"
    panel.evaluate("() => { closeAgain(); document.getElementById('again').remove(); }")
    fold(panel, "water").click()


def test_presets_show_what_they_make_of_the_photo(panel, coast, state):
    shown = thumbnails(panel)
    for picture, preset in zip(shown, state["_scene"]["presets"], strict=True):
        edit = sw.Edit(**preset["values"])
        size = picture.shape[1], picture.shape[0]
        wanted = Image.fromarray(sw.render(coast, edit)).resize(size, Image.Resampling.BOX)
        # Few of the picture's pixels were drawn, so single ones differ; areas do not.
        blocks = [
            np.asarray(Image.fromarray(p).resize((16, 11), Image.Resampling.BOX), float)
            for p in (picture, np.asarray(wanted))
        ]
        assert np.abs(blocks[0] - blocks[1]).mean() < 3, preset["label"]
    # The same for every place of the sun, but not for other air.
    panel.evaluate("window.pictures.length = 0")
    receive(panel, sun_elevation=4.0)
    panel.wait_for_timeout(1500)
    assert drawn_thumbnails(panel) == 0
    receive(panel, aerosol_optical_depth=0.4)
    for old, new in zip(shown, thumbnails(panel, fresh=True), strict=True):
        assert not np.array_equal(old, new)


def test_preset_pictures_wait_for_the_hand(panel):
    thumbnails(panel)
    box = panel.locator(".sw-sun-ring").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    panel.mouse.move(x, y)
    panel.mouse.down()
    panel.mouse.move(x - 20, y, steps=3)
    panel.evaluate("window.pictures.length = 0")
    receive(panel, aerosol_optical_depth=0.3)
    panel.wait_for_timeout(1500)
    assert drawn_thumbnails(panel) == 0
    panel.mouse.up()
    thumbnails(panel, fresh=True)


def test_a_small_picture_costs_the_next_frames_nothing(panel, state):
    counts = panel.evaluate(
        """async (state) => {
          const { Sketch } = await import("/sun_editor.js");
          await makeFrame(state);
          const [full, half] = [[768, 512], [384, 256]];
          const passes = (draw) => {
            window.passes = 0;
            if (!draw()) throw new Error("nothing was drawn");
            return window.passes;
          };
          // As a drag does and its end: two sizes in turn, of an edit that few passes follow.
          const drag = (from) =>
            [half, full, half].map((size, i) =>
              passes(() => frame.draw({ exposure: (from + i) / 10 }, size)),
            );
          const first = passes(() => frame.draw({}, full));
          drag(1);
          const before = drag(4);
          const canvas = document.createElement("canvas");
          const sketch = new Sketch(frame);
          let waits = 0; // for all that is under way
          const { prototype } = WebGL2RenderingContext;
          const { checkFramebufferStatus } = prototype;
          prototype.checkFramebufferStatus = function (...rest) {
            waits += 1;
            return checkFramebufferStatus.apply(this, rest);
          };
          const small = passes(() =>
            sketch.draw(frame.describe({ sun_elevation: 4 }, [300, 200]), canvas),
          );
          prototype.checkFramebufferStatus = checkFramebufferStatus;
          const after = drag(7);
          sketch.freeTargets();
          const rested = drag(10);
          frame.dispose();
          frame.canvas.remove();
          return { first, before, small, waits, after, rested };
        }""",
        state,
    )
    assert counts["before"] == counts["after"] == counts["rested"]
    assert counts["waits"] == 0
    # The air's tables are the frame's own.
    assert 5 < counts["small"] < counts["first"] - 10


def test_the_histogram_follows_the_canvas_and_marks_what_is_clipped(panel):
    def heights(channel):
        path = panel.locator(f".sw-levels-{channel}").get_attribute("d")
        return np.array([float(point.split()[1]) for point in path.split("L")[1:-1]])

    receive(panel, exposure=3.25)
    panel.wait_for_function(
        "/([\\d.]+) % white/.exec(document.querySelector('.sw-levels-text').textContent)?.[1] > 5"
    )
    panel.locator(".sw-clipped-white.sw-on").wait_for()
    light = 56 - heights("luminance")
    assert light @ np.arange(64) / light.sum() > 32
    assert "Highlights clipped" in panel.locator(".sw-clipped-white").get_attribute("title")
    canvas = picture_of(
        panel.evaluate("document.querySelector('.sw-canvas').toDataURL().split(',')[1]")
    )
    share = (canvas == 255).any(axis=2).mean()
    said = panel.locator(".sw-levels-text").text_content()
    assert float(said.split()[-3]) == pytest.approx(100 * share, abs=3)
    # Its title has room beside what both ends say.
    free = panel.evaluate(
        """() => {
          const text = document.querySelector(".sw-levels-text");
          text.textContent = "10.0 % black, 10.0 % white";
          const title = document.createRange();
          title.selectNodeContents(text.parentElement);
          title.setEndBefore(text);
          return text.getBoundingClientRect().left - title.getBoundingClientRect().right;
        }"""
    )
    assert free >= 0
    # The photo's own luminance stays, as a line, and is darker.
    photo = 56 - heights("before")
    assert photo @ np.arange(64) / photo.sum() < light @ np.arange(64) / light.sum()
