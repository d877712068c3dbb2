"""Widgets in the boxes of ipywidgets, which ask their content how wide it is."""

import pytest
from chromium import STATIC, VIEWPORT

pytestmark = [pytest.mark.browser, pytest.mark.timeout(120)]

# As ipywidgets lays them out: its own margins, sizes and classes.
PAGE = """
<style>
  body {{ margin: 0 }}
  .jupyter-widgets {{ box-sizing: border-box; margin: 2px; overflow: visible }}
  .widget-box {{ display: flex; overflow: auto }}
  .widget-hbox {{ flex-direction: row }}
  .widget-vbox {{ flex-direction: column }}
  .widget-slider {{ width: 300px }}
  {css}
</style>
<div class="jupyter-widgets widget-box {kind}" style="width: 900px">
  <div class="jupyter-widgets" id="view" style="{layout}"><div class="sunwidget"></div></div>
  {beside}
</div>
"""
SLIDER = '<div class="jupyter-widgets widget-slider"></div>'


@pytest.fixture(scope="module")
def blank(browser):
    page = browser.new_page(viewport=VIEWPORT)
    yield page
    page.close()


@pytest.mark.parametrize("name", ["sun_editor", "sky_explorer", "compare", "study"])
@pytest.mark.parametrize(
    ("kind", "beside", "layout", "width"),
    [
        ("widget-hbox", SLIDER, "", 900 - 300 - 8),
        ("widget-hbox", 2 * SLIDER, "", 340),
        ("widget-hbox", SLIDER, "width: 400px", 400),
        ("", "", "", 900 - 8),
        ("widget-vbox", SLIDER, "", 900 - 8),
    ],
)
def test_a_widget_in_a_box_takes_what_the_others_leave(blank, name, kind, beside, layout, width):
    css = (STATIC / f"{name}.css").read_text("utf-8")
    blank.set_content(PAGE.format(css=css, kind=kind, beside=beside, layout=layout))
    assert blank.locator("#view").bounding_box()["width"] == pytest.approx(width, abs=5)
    assert blank.locator(".widget-box").evaluate("box => box.scrollWidth <= box.clientWidth")
