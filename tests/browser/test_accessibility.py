"""Both widgets by keyboard, by finger, in either theme, and as axe-core judges them."""

import pytest
from chromium import open_page, widget_state

from sunwidget.widgets import SkyExplorer, SunEditor

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]

# What axe asks of whole pages is no matter of a widget in one.
OF_PAGES = ("region", "page-has-heading-one", "landmark-one-main")


@pytest.fixture(scope="module")
def state(coast):
    return widget_state(SunEditor(coast).wait())


@pytest.fixture(scope="session")
def axe(root):
    script = root / "js" / "node_modules" / "axe-core" / "axe.min.js"
    assert script.is_file(), f"{script} is missing: run `npm ci --prefix js`"
    return script.read_text("utf-8")


@pytest.fixture
def open_editor(browser, page, state):
    """Open the editor: ``open_editor(width, color_scheme=…)``, elsewhere for other options."""
    contexts = []

    def opened(width=1180, traits=None, color_scheme="light", **options):
        shown = page
        if options:
            contexts.append(browser.new_context(**options))
            shown = open_page(contexts[-1])
        shown.set_viewport_size({"width": width, "height": 860})
        shown.emulate_media(color_scheme=color_scheme)
        shown.evaluate("(state) => showEditor(state)", {**state, **(traits or {})})
        shown.locator(".sunwidget.sw-live").wait_for()
        return shown

    yield opened
    for context in contexts:
        context.close()


def violations(page, axe, *, only_colors=False, within=".sunwidget"):
    """What axe finds, as text; and that it looked at something."""
    page.evaluate(f"{axe};0")
    tags = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]
    found = page.evaluate(
        """([within, tags, skipped]) => axe.run(within, {
          runOnly: tags,
          rules: Object.fromEntries(skipped.map((id) => [id, { enabled: false }])),
        })""",
        [within, ["color-contrast"] if only_colors else tags, OF_PAGES],
    )
    read = next(rule for rule in found["passes"] if rule["id"] == "color-contrast")
    assert len(read["nodes"]) > 10, "axe found no text to judge"
    return [
        f"{rule['impact']} {rule['id']}: {node['html'][:160]}"
        for rule in found["violations"]
        for node in rule["nodes"]
    ]


def unfold(page):
    page.evaluate(
        """() => {
          const folded = ".sw-fold[aria-expanded=false], .sw-panel details:not([open]) > summary";
          for (const node of document.querySelectorAll(folded)) node.click();
        }"""
    )


def trait(page, name):
    return page.evaluate("(name) => model.get(name)", name)


def press(page, *keys):
    for key in keys:
        page.keyboard.press(key)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_in_the_editor(open_editor, axe, scheme):
    frames = [{"seconds": at, "recipe": {"sun_elevation": 5 - at}} for at in (0, 2)]
    page = open_editor(color_scheme=scheme, traits={"key_frames": frames})
    only_colors = scheme == "dark"  # all else is the same in both
    unfold(page)
    page.locator(".sw-sun").focus()
    press(page, "ArrowUp", "4")
    page.evaluate(
        "model.fire('msg:custom', { type: 'error', error: 'The file is gone. Open another.' })"
    )
    page.locator(".sw-message").wait_for()
    press(page, "e", "ArrowRight")  # the export's films
    page.locator(".sw-key-frame").first.wait_for()
    assert violations(page, axe, only_colors=only_colors) == []
    press(page, "ArrowLeft")  # its stills
    page.set_viewport_size({"width": 360, "height": 860})
    if not only_colors:
        assert violations(page, axe) == []
    press(page, "?")
    page.locator("dialog").wait_for()
    assert violations(page, axe, only_colors=only_colors, within="dialog") == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing_in_the_explorer(browser, axe, scheme):
    context = browser.new_context(color_scheme=scheme)
    page = open_page(context, "explorer.html")
    page.evaluate("(state) => showExplorer(state)", widget_state(SkyExplorer()))
    page.locator(".sunwidget.sw-live").wait_for()
    unfold(page)
    assert violations(page, axe, only_colors=scheme == "dark") == []
    page.locator(".sw-sun").focus()
    press(page, "2", "]")
    assert (trait(page, "projection"), trait(page, "view_azimuth")) == ("panorama", 15)
    press(page, "?")
    assert "Turn right" in page.get_by_role("dialog").inner_text()
    assert page.errors == []
    context.close()


def test_every_tool_works_without_a_pointer(open_editor):
    page = open_editor()
    page.locator(".sw-sun").focus()
    # Horizon: its key goes to the left handle.
    press(page, "2", "ArrowDown")
    (left, right) = trait(page, "horizon_hint")
    assert left[1] != right[1]
    # A stroke: Enter puts the brush down, arrow keys paint, Enter lifts it.
    press(page, "4", "Enter", "ArrowRight", "ArrowRight", "Shift+ArrowDown")
    assert trait(page, "strokes") == []
    press(page, "Enter")
    (stroke,) = trait(page, "strokes")
    assert stroke["label"] == "sky"
    assert len(stroke["points"]) == 3  # an L: what lies on a line is left out
    # What was begun can be given up.
    press(page, "5", "Space", "ArrowLeft", "Escape", "ArrowLeft")
    assert len(trait(page, "strokes")) == 1
    assert page.locator(".sunwidget").get_attribute("data-tool") == "not_sky"
    # The cross stands beside the stroke; back on it, it is taken away.
    press(page, "6", "ArrowRight", "ArrowRight", "Enter")
    assert trait(page, "strokes") == []
    # Where the photo's sun is.
    press(page, "3", "Shift+ArrowUp", "Shift+ArrowUp", "Enter")
    x, y = trait(page, "sun_hint")
    assert 0 < x < 1
    assert 0 < y < 0.5
    # The sun: its key goes to its handle.
    press(page, "1", "ArrowUp")
    assert trait(page, "sun_elevation") is not None
    assert page.errors == []


def test_the_focus_is_seen_wherever_it_goes(open_editor):
    page = open_editor()
    page.evaluate("document.activeElement.blur()")
    seen = []
    for _ in range(200):
        press(page, "Tab")
        stop = page.evaluate(
            """() => {
              const node = document.activeElement;
              if (!node.closest(".sunwidget")) return null;
              const shown = (part) => {
                const style = getComputedStyle(part);
                return style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 2;
              };
              const ring = node.querySelector?.(".sw-sun-ring, circle");
              const marked = ring && getComputedStyle(ring).stroke !== "rgb(255, 255, 255)";
              const name = node.getAttribute("aria-label") || node.textContent.trim() || node.title;
              return [name || node.outerHTML.slice(0, 80), shown(node) || Boolean(marked)];
            }"""
        )
        if stop is None:
            break
        seen.append(stop)
    else:
        raise AssertionError("Tab does not leave the editor")
    names = [name for name, _ in seen]
    assert [name for name, shown in seen if not shown] == []
    for name in (
        "Move the sun",
        "Before",
        "Save",
        "Sun",
        "Azimuth in °",
        "Sky",
        "Find a parameter",
    ):
        assert any(name in other for other in names), (name, names)


def test_the_help_shows_the_keys_and_gives_the_focus_back(open_editor):
    page = open_editor()
    page.locator(".sw-sun").focus()
    press(page, "Shift+?")
    dialog = page.get_by_role("dialog")
    dialog.wait_for()
    text = dialog.inner_text()
    for told in ("Move the sun", "Undo", "Larger brush", "Ctrl"):
        assert told in text
    # Keys belong to the dialog, and the focus stays in it.
    press(page, "5", "Tab", "Tab", "Tab", "Tab")
    assert page.evaluate("!document.activeElement.matches('.sunwidget *:not(dialog *)')")
    press(page, "Escape")
    assert dialog.count() == 0
    assert page.locator(".sunwidget").get_attribute("data-tool") == "sun"
    assert page.evaluate("document.activeElement.matches('.sw-sun')")


def test_changes_out_of_the_focus_are_said_once_they_rest(open_editor):
    page = open_editor()
    said = page.locator(".sw-spoken")
    assert said.get_attribute("aria-live") == "polite"
    page.locator(".sw-sun").focus()
    press(page, "4", "W")
    said.get_by_text("Brush: water", exact=True).wait_for(state="attached")
    page.evaluate("model.set('sun_azimuth', -20); model.set('sun_elevation', 4)")
    said.get_by_text("Sun 20.0° left · 4.0° elevation").wait_for(state="attached")


def test_keys_of_what_needs_a_kernel_say_so_where_there_is_none(open_editor):
    page = open_editor(traits={"_standalone": True})
    page.locator(".sw-sun").focus()
    press(page, "2", "m")
    page.locator(".sw-spoken").get_by_text("Needs a kernel").wait_for(state="attached")
    assert page.locator(".sunwidget").get_attribute("data-tool") == "sun"
    page.get_by_role("radio", name="Move the sun").focus()
    press(page, "ArrowRight")
    assert page.locator(".sunwidget").get_attribute("data-tool") == "sun"
    assert page.errors == []


def test_it_has_room_in_every_width_and_targets_for_a_finger(open_editor):
    page = open_editor(360, has_touch=True)
    assert page.evaluate("matchMedia('(pointer: coarse)').matches")
    unfold(page)
    small = page.evaluate(
        """() => [...document.querySelectorAll(".sunwidget :is(button, input, select, summary)")]
          .map((node) => [node, node.getBoundingClientRect()])
          .filter(([, box]) => box.width && box.height && Math.min(box.width, box.height) < 31.5)
          .map(([node, box]) => `${node.outerHTML.slice(0, 90)} ${box.width}×${box.height}`)"""
    )
    assert small == []
    page = open_editor(1600)
    for width in (1600, 1180, 861, 700, 520, 340):
        page.set_viewport_size({"width": width, "height": 860})
        over = """() => {
          const root = document.querySelector(".sunwidget").getBoundingClientRect();
          return [...document.querySelectorAll(".sunwidget :is(button, input, select, canvas)")]
            .filter((node) => node.checkVisibility())
            .map((node) => [node.outerHTML.slice(0, 90), node.getBoundingClientRect()])
            .filter(([, box]) => box.left < root.left - 0.5 || box.right > root.right + 0.5)
            .map(([html]) => html);
        }"""
        # What lies on the picture follows with the next frame, which a busy machine draws late.
        page.wait_for_timeout(100)
        for _ in range(30):
            if not page.evaluate(over):
                break
            page.wait_for_timeout(100)
        assert (width, page.evaluate(over)) == (width, [])
        picture = page.locator(".sw-picture").bounding_box()["width"]
        assert picture >= (0.85 if width < 860 else 0.55) * (width - 26)


def test_the_theme_is_the_hosts_before_the_systems(open_editor):
    page = open_editor(color_scheme="dark", reduced_motion="reduce")
    dark = """() => {
      const [red] = getComputedStyle(document.querySelector(".sunwidget"))
        .backgroundColor.match(/\\d+/g);
      return Number(red) < 128;
    }"""
    assert page.evaluate(dark)
    for attribute, value, expected in (
        ("data-jp-theme-light", "true", False),
        ("data-jp-theme-light", "false", True),
        ("class", "vscode-light", False),
        ("class", "vscode-high-contrast", True),
        ("class", "light", False),
        ("data-theme", "light", False),
    ):
        page.evaluate(
            "([name, value]) => document.body.setAttribute(name, value)", [attribute, value]
        )
        assert page.evaluate(dark) == expected, (attribute, value)
        page.evaluate("(name) => document.body.removeAttribute(name)", attribute)
    # Who wants less motion sees none.
    moving = """() => [...document.querySelectorAll(".sunwidget *")].filter((node) => {
      const { transitionDuration, animationName } = getComputedStyle(node);
      return transitionDuration !== "0s" || animationName !== "none";
    }).length"""
    assert page.evaluate(moving) == 0
    page.emulate_media(reduced_motion="no-preference")
    assert page.evaluate(moving) > 0
