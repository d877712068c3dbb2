"""SkyExplorer's view in a real browser, without a notebook: a stand-in plays the model."""

import re

import numpy as np
import pytest
from chromium import LOSE_ONCE, at_rest, open_page, picture_of, widget_state

from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.presets import PRESETS
from sunwidget.atmosphere.sky import sky_radiance
from sunwidget.widgets.explorer.sky_explorer import SkyExplorer

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]


@pytest.fixture(scope="module")
def shared(browser):
    """One page for all tests: its shaders take longer to compile than most tests to run."""
    context = browser.new_context(viewport={"width": 1180, "height": 1200})
    page = open_page(context, "explorer.html")
    page.evaluate("(state) => showExplorer(state)", widget_state(SkyExplorer()))
    page.locator(".sunwidget.sw-live").wait_for()
    yield page
    context.close()


@pytest.fixture
def explorer(shared):
    """Show a state as if Python had set it: ``explorer(sun_elevation=4)``."""

    def show(changes=None, **parameters):
        fresh = {"_history": {"past": [], "future": []}}
        state = {**widget_state(SkyExplorer(**parameters)), **fresh, **(changes or {})}
        shared.evaluate("(state) => { model.sent.length = 0; model.receive(state); }", state)
        shared.mouse.move(2, 2)
        settled(shared)
        return shared

    yield show
    assert shared.errors == []
    assert shared.locator(".sw-message:visible").count() == 0


def canvas_of(page):
    return picture_of(
        page.evaluate(
            "document.querySelector('.sw-sky-canvas').toDataURL('image/png').split(',')[1]"
        )
    )


def trait(page, name):
    return page.evaluate("(name) => model.get(name)", name)


def centre(box):
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def drag(page, start, end, steps=6):
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(*end, steps=steps)
    page.mouse.up()


def settled(page):
    """Wait until the picture and the plots after the last change are drawn."""
    page.wait_for_timeout(50)
    page.wait_for_function("!document.querySelector('[aria-busy=true]')")


def unfold(page, title):
    page.evaluate(
        """(title) => {
          for (const section of document.querySelectorAll(".sw-panel details"))
            if (section.querySelector("summary").textContent === title) section.open = true;
        }""",
        title,
    )


def card(page, title):
    return page.locator(".sw-card", has_text=title).first


def plot_pixels(page):
    """Each plot's canvas as PNG text, in the order of the page."""
    return page.evaluate(
        "[...document.querySelectorAll('.sw-chart canvas')].map(c => c.toDataURL())"
    )


def blue_over_red(page):
    """Of the dome, halfway between zenith and horizon on the side away from the sun."""
    picture = canvas_of(page).astype(float)
    height, width = picture.shape[:2]
    x, y = width // 2, round(0.72 * height)
    red, _, blue = picture[y - 4 : y + 4, x - 4 : x + 4].mean((0, 1))
    return blue / max(red, 1)


def test_a_graphics_context_that_is_lost_in_a_frame_is_made_anew(explorer):
    page = explorer(sun_elevation=12)
    expected = canvas_of(page)
    explorer(sun_elevation=40)
    page.evaluate(LOSE_ONCE)
    explorer(sun_elevation=12)
    assert np.array_equal(canvas_of(page), expected)


def test_it_opens_with_a_sky_and_six_plots(explorer):
    page = explorer()
    picture = canvas_of(page)
    assert picture.std() > 20, "the canvas is uniform"
    assert blue_over_red(page) > 1.2
    plots = plot_pixels(page)
    assert len(plots) == 6
    assert len(set(plots)) == 6
    for name in ("Dome", "Panorama", "Camera"):
        page.get_by_role("radio", name=name).click()
        settled(page)
        assert trait(page, "projection") == name.lower()
        assert canvas_of(page).std() > 20


def test_dragging_the_sun_over_the_dome_moves_traits_and_picture_in_one_step(explorer):
    page = explorer()
    before = canvas_of(page)
    box = page.locator(".sw-sky-picture").bounding_box()
    x, y = centre(box)
    start = centre(page.locator(".sw-sun-ring").bounding_box())
    # Halfway to the horizon in the east, which is to the left for one who looks up.
    drag(page, start, (x - 0.5 * 0.94 * box["width"] / 2, y))
    assert trait(page, "sun_azimuth") == pytest.approx(90, abs=1.5)
    assert trait(page, "sun_elevation") == pytest.approx(45, abs=1.5)
    assert len(trait(page, "_history")["past"]) == 1
    settled(page)
    after = canvas_of(page)
    assert after.shape == before.shape
    assert np.abs(after.astype(int) - before).mean() > 5
    page.keyboard.press("Control+z")
    assert trait(page, "sun_elevation") == 20


def test_beyond_the_rim_the_sun_sinks_below_the_horizon_and_no_farther_than_it_may(explorer):
    page = explorer(sun_elevation=2)
    box = page.locator(".sw-sky-picture").bounding_box()
    x, y = centre(box)
    start = centre(page.locator(".sw-sun-ring").bounding_box())
    radius = 0.94 * box["width"] / 2
    drag(page, start, (x, y - radius * (1 + 6 / 90)))
    assert trait(page, "sun_elevation") == pytest.approx(-6, abs=0.7)
    drag(page, (x, y - radius * (1 + 6 / 90)), (x, y - 3 * radius))
    assert -12 <= trait(page, "sun_elevation") <= -11.8


def test_arrow_keys_move_the_sun(explorer):
    page = explorer(projection="camera", sun_elevation=10)
    page.get_by_role("slider", name="Sun", exact=True).focus()
    page.keyboard.press("ArrowUp")
    page.keyboard.press("Shift+ArrowRight")
    assert trait(page, "sun_elevation") == pytest.approx(10.5)
    assert trait(page, "sun_azimuth") == pytest.approx(5)


def test_dragging_the_camera_elsewhere_turns_it_and_leaves_the_sun(explorer):
    page = explorer(projection="camera", sun_elevation=10)
    box = page.locator(".sw-sky-picture").bounding_box()
    start = (box["x"] + 0.2 * box["width"], box["y"] + 0.2 * box["height"])
    drag(page, start, (start[0] + 60, start[1] + 30))
    assert trait(page, "sun_azimuth") == 0
    assert trait(page, "view_azimuth") < -3
    assert trait(page, "view_elevation") > 14


def test_without_air_molecules_the_sky_is_not_blue(explorer):
    page = explorer()
    blue = blue_over_red(page)
    page.get_by_role("switch", name="Air molecules").click()
    settled(page)
    assert trait(page, "show_rayleigh") is False
    assert blue_over_red(page) < 0.8 * blue


def test_turbidity_moves_the_aerosol_optical_depth(explorer):
    page = explorer()
    field = page.get_by_label("Turbidity, value")
    field.fill("3")
    field.press("Enter")
    assert trait(page, "aerosol_optical_depth") == pytest.approx(
        Atmosphere().with_turbidity(3).aerosol_optical_depth, rel=1e-6
    )
    assert float(page.get_by_label("Visibility, value").input_value()) == pytest.approx(
        Atmosphere().with_turbidity(3).visibility / 1000, abs=0.51
    )


def test_a_preset_is_one_step_and_shows_as_chosen(explorer):
    page = explorer()
    button = page.get_by_role("group", name="Presets").get_by_role("button", name="Polluted")
    button.click()
    for name, value in PRESETS["polluted"].parameters().items():
        assert trait(page, name) == pytest.approx(value)
    assert button.get_attribute("aria-pressed") == "true"
    assert len(trait(page, "_history")["past"]) == 1


def test_plots_follow_the_sun(explorer):
    page = explorer(sun_elevation=60)
    before = plot_pixels(page)

    def read_values(title, pattern):
        text = card(page, title).locator(".sw-card-value").text_content()
        return [float(number) for number in re.findall(pattern, text)]

    (noon,) = read_values("The sun's color", r"^[\d.]+")
    page.get_by_role("button", name="Blue hour").click()
    settled(page)
    after = plot_pixels(page)
    assert sum(a != b for a, b in zip(before, after, strict=True)) >= 5  # all but the phases
    assert 90 < noon < 125  # klx of direct sun at 60° in clear air
    assert "sun below −1°" in card(page, "The sun's color").text_content()
    assert "the sun is down" in card(page, "Sunlight that arrives").text_content()
    x, y = read_values("Zenith in CIE x, y", r"[\d.]+")
    # As docs/methods/atmosphere.md has the zenith at −6°.
    assert (x, y) == (pytest.approx(0.235, abs=0.01), pytest.approx(0.235, abs=0.01))


def test_a_pointer_on_the_sky_reads_it_and_marks_the_phase_functions(explorer):
    page = explorer(sun_elevation=50)
    page.mouse.move(*centre(page.locator(".sw-sky-picture").bounding_box()))
    settled(page)
    text = page.locator(".sw-foot").text_content()
    assert "40° from the sun" in text
    value = float(re.search(r"([\d.]+) kcd/m²", text)[1])
    assert 1 < value < 20  # clear zenith, sun at 50°
    assert "40°" in card(page, "Phase functions").locator(".sw-card-value").text_content()
    # And a place in a plot is marked on the sky: the zenith, half-way along the principal plane.
    page.mouse.move(
        *centre(card(page, "Along the principal plane").locator(".u-over").bounding_box())
    )
    settled(page)
    spot = page.locator(".sw-spot")
    assert spot.get_attribute("visibility") == "visible"
    sky = centre(page.locator(".sw-sky-picture").bounding_box())
    assert centre(spot.bounding_box()) == pytest.approx(sky, abs=6)


def test_dragging_in_a_plot_moves_the_sun(explorer):
    page = explorer()
    over = card(page, "The sun's color").locator(".u-over").bounding_box()
    x, y = centre(over)
    drag(page, (x, y), (over["x"] + over["width"] * np.sqrt(6 / 91), y))
    assert trait(page, "sun_elevation") == pytest.approx(5, abs=0.6)


def test_the_clock_moves_the_sun_without_a_kernel(explorer):
    widget = SkyExplorer()
    widget.set_place(41.0, 29.0, "2024-06-21")
    place = {n: getattr(widget, n) for n in ("latitude", "longitude", "date")}
    page = explorer(**place)
    unfold(page, "Place and time")
    field = page.get_by_label("Time, UTC, value")
    for hours in (5.02, 17.5):
        field.fill(str(hours))
        field.press("Enter")
        widget.time = hours
        assert trait(page, "sun_elevation") == pytest.approx(widget.sun_elevation, abs=2e-4)
        assert trait(page, "sun_azimuth") == pytest.approx(widget.sun_azimuth, abs=2e-4)
    page.get_by_role("button", name="Play the day").click()
    page.wait_for_timeout(700)
    page.get_by_role("button", name="Play the day").click()
    assert trait(page, "time") > 17.6
    page.get_by_role("button", name="Quito").click()
    assert trait(page, "latitude") == pytest.approx(-0.18)
    assert trait(page, "date") == "2024-06-21"
    # A hand on the sun stops the clock.
    page.get_by_role("button", name="Sunset").click()
    assert trait(page, "time") is None


def copied(page):
    """Copy the code and paste it as a person would."""
    page.get_by_role("button", name="Copy code").click()
    page.locator(".sw-said", has_text="Copied").wait_for()
    page.evaluate("document.body.append(document.createElement('textarea'))")
    page.locator("body > textarea").focus()
    page.keyboard.press("Control+v")
    return page.evaluate(
        """() => {
          const field = document.querySelector("body > textarea");
          field.remove();
          document.querySelector(".sw-said").textContent = "";
          return field.value;
        }"""
    )


def test_code_without_a_kernel_is_the_kernels(explorer):
    page = explorer()
    page.get_by_role("switch", name="Ozone").click()
    page.get_by_label("Model", exact=True).select_option("single")
    widget = SkyExplorer(show_ozone=False, model="single")
    assert copied(page) == f"import sunwidget as sw\n\n{widget.code()}"
    page.get_by_role("button", name="Golden hour").click()
    widget.sun_elevation = 4
    assert "sun_elevation=4.0" in widget.code()
    assert copied(page) == f"import sunwidget as sw\n\n{widget.code()}"


def test_two_views_of_one_model_stay_in_step_and_say_each_thing_once(explorer):
    page = explorer()
    page.evaluate("showAgain()")
    page.locator(".sunwidget").nth(1).scroll_into_view_if_needed()
    page.locator(".sunwidget.sw-live").nth(1).wait_for()
    settled(page)
    page.evaluate("model.saved.length = 0")
    page.locator(".sunwidget").nth(0).get_by_role("button", name="Golden hour").click()
    page.locator(".sunwidget").nth(1).get_by_role("switch", name="Aerosol").click()
    settled(page)
    for i in (0, 1):
        view = page.locator(".sunwidget").nth(i)
        assert view.get_by_label("Elevation, value", exact=True).input_value() == "4.0"
        switch = view.get_by_role("switch", name="Aerosol")
        assert switch.get_attribute("aria-checked") == "false"
    page.evaluate("closeAgain()")
    told = [name for saved in page.evaluate("model.saved") for name in saved]
    assert sorted(name for name in told if name != "_history") == ["show_aerosol", "sun_elevation"]


def test_copies_of_the_bundle_as_hosts_load_them_share_no_name(explorer):
    page = explorer()
    page.evaluate("async () => showAgain((await import('/sky_explorer.js?copy')).default)")
    page.locator(".sunwidget").nth(1).scroll_into_view_if_needed()
    page.locator(".sunwidget.sw-live").nth(1).wait_for()
    names = page.locator("clipPath").evaluate_all("(all) => all.map(({ id }) => id)")
    assert len(names) == len(set(names)) == 2
    page.evaluate("closeAgain(); scrollTo(0, 0)")


def test_a_view_out_of_sight_draws_when_it_comes_into_sight(explorer):
    page = explorer()
    page.evaluate("showAgain(); document.body.lastElementChild.style.marginTop = '4000px'")
    page.get_by_role("button", name="Golden hour").first.click()
    settled(page)
    assert page.locator(".sunwidget").count() == 2
    assert page.locator(".sunwidget.sw-live").count() == 1
    page.locator(".sunwidget").nth(1).scroll_into_view_if_needed()
    page.locator(".sunwidget.sw-live").nth(1).wait_for()
    page.evaluate("closeAgain(); scrollTo(0, 0)")


def test_a_scan_that_the_model_made_has_no_error(explorer):
    """The model's radiance, as NumPy computes it, in place of a measured one."""
    azimuth, elevation = np.meshgrid(np.arange(-160.0, 180.0, 40.0), [15.0, 45.0, 75.0])
    directions = np.stack([azimuth.ravel(), elevation.ravel()], axis=1)
    a, e = np.radians(directions.T)
    vectors = np.stack([np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a)], axis=1)
    radiance = sky_radiance(Atmosphere(), vectors, 35.0)
    radiance[0] *= 2
    scan = {
        "time": "2013-05-27T12:00:00",
        "sun_elevation": 35,
        "sun_azimuth": 0,
        "directions": directions.tolist(),
        "radiance": radiance.tolist(),
    }
    listed = [{"index": 0, "label": "made up", "sun_elevation": 35}]
    page = explorer(sun_elevation=35, changes={"scan": 0, "_measured": scan, "_scans": listed})
    settled(page)
    errors = [
        float(re.search(r"([+−]\d+) %", text)[1].replace("−", "-"))
        for text in page.locator(".sw-measured circle title").all_text_contents()
    ]
    assert len(errors) == len(directions)
    # Measured twice as bright: half as much is too dark by a half. Texels against NumPy: 2 %.
    assert errors[0] == pytest.approx(-50, abs=2)
    assert np.abs(errors[1:]).max() <= 2
    assert "rms 10 %" in page.locator(".sw-error-legend").text_content()  # 0.5 / √27


def test_without_measured_skies_it_says_how_to_get_them_and_asks_first(explorer):
    page = explorer(changes={"_scans": []})
    unfold(page, "Measured")
    assert "public repository" in page.locator(".sw-panel").text_content()
    page.get_by_role("button", name="Download …").click()
    assert page.evaluate("model.sent.length") == 0
    page.get_by_role("button", name="Yes, download").click()
    assert page.evaluate("model.sent.map(m => m.action)") == ["download_measurements"]


def answer(page, action, result, floats=0):
    """Answer the view's open request as a kernel would, with a buffer of so many ones."""
    page.wait_for_function("a => model.sent.some(m => m.action === a)", arg=action)
    page.evaluate(
        """([action, result, floats]) => {
          const { id } = model.sent.find((m) => m.action === action);
          const buffers = floats ? [new DataView(new Float32Array(floats).fill(1).buffer)] : [];
          model.fire("msg:custom", { type: "response", id, result, error: null }, buffers);
        }""",
        [action, result, floats],
    )


def test_brunetons_table_says_its_cost_and_waits_to_be_asked_for(explorer):
    page = explorer(model="bruneton", compare="single")
    assert "no table yet" in page.locator(".sw-guides").text_content()
    note = page.locator(".sw-readout-note")
    assert "not computed yet" in note.text_content()
    answer(page, "bruneton_cost", {"cached": False, "seconds": 38.2})
    button = page.get_by_role("button", name="Compute table (≈ 38 s)")
    button.wait_for()
    assert [m["action"] for m in page.evaluate("model.sent")] == ["bruneton_cost"]
    before = canvas_of(page)
    button.click()
    sent = page.evaluate("model.sent.find(m => m.action === 'bruneton')")
    assert sent["parameters"]["ozone"] == 300
    answer(page, "bruneton", {"rows": 40, "cols": 32, "seconds": 38}, 4 * 40 * 32)
    page.wait_for_function("!document.querySelector('.sw-readout-note').textContent")
    settled(page)
    assert not np.array_equal(canvas_of(page), before)
    assert button.count() == 0
    assert page.locator(".sw-guides").text_content().startswith("NESW30°60°BrunetonSingle")
    # Other air needs another table.
    page.get_by_role("switch", name="Ozone").click()
    settled(page)
    assert page.get_by_text("The air has changed since").is_visible()


def test_the_reference_gathers_paths_until_it_is_paused(explorer):
    page = explorer(projection="panorama")
    page.set_viewport_size({"width": 600, "height": 1200})  # few pixels: paths are slow
    page = explorer(projection="panorama", compare="reference")

    def paths():
        return int(page.locator(".sw-readout-note").text_content().split()[0])

    page.wait_for_function(
        "Number.parseInt(document.querySelector('.sw-readout-note').textContent) > 2"
    )
    page.get_by_role("button", name="Pause").click()
    page.locator(".sw-readout-note", has_text="paused").wait_for()
    at_rest(page)  # a frame that was on its way is drawn
    count = paths()
    before = canvas_of(page)
    resume = page.get_by_role("button", name="Resume")
    place = resume.bounding_box()
    page.mouse.move(*centre(page.locator(".sw-sky-picture").bounding_box()))
    page.wait_for_timeout(300)
    assert page.locator(".sw-readout", has_text="from the sun").is_visible()
    # Otherwise it would move away from a pointer that comes from the sky.
    assert resume.bounding_box() == place
    assert paths() == count
    assert np.array_equal(canvas_of(page), before)
    resume.click()
    page.wait_for_function(
        f"Number.parseInt(document.querySelector('.sw-readout-note').textContent) > {count}"
    )
    page.set_viewport_size({"width": 1180, "height": 1200})


def test_while_the_sun_is_dragged_plots_are_drawn_ten_times_a_second_at_most(explorer):
    page = explorer()
    page.evaluate(
        """() => {
          window.draws = [];
          const original = CanvasRenderingContext2D.prototype.clearRect;
          const plot = document.querySelectorAll('.sw-chart canvas')[1];
          CanvasRenderingContext2D.prototype.clearRect = function (...box) {
            if (this.canvas === plot) window.draws.push(performance.now());
            return original.apply(this, box);
          };
        }"""
    )
    x, y = centre(page.locator(".sw-sun-ring").bounding_box())
    page.mouse.move(x, y)
    page.mouse.down()
    for i in range(15):
        page.mouse.move(x + 5 * i, y + 3 * i)
        page.wait_for_timeout(30)
    page.mouse.up()
    settled(page)
    # The last drawing shows where the sun has come to.
    told = card(page, "Sunlight that arrives").locator(".sw-card-value").text_content()
    assert told == f"sun at {trait(page, 'sun_elevation'):.1f}°"
    gaps = np.diff(page.evaluate("window.draws"))
    # One drawing clears more than once, within a few milliseconds; a timer may be early by one.
    assert gaps[gaps > 20].min() > 95
