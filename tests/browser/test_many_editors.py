"""Many editors in one page, as in a long notebook: all show their picture, few hold a context."""

import pytest
from chromium import count_contexts, drag_sun, live_contexts, widget_state

import sunwidget as sw
from sunwidget.widgets import SunEditor

pytestmark = [pytest.mark.browser, pytest.mark.timeout(300)]

EDITORS = 20
MOST_CONTEXTS = 4  # js/src/gl/pool.js
SPREAD = """i => {
  const canvas = document.querySelectorAll(".sw-canvas")[i];
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  let [least, most] = [255, 0];
  for (let i = 0; i < data.length; i += 4) {
    least = Math.min(least, data[i]);
    most = Math.max(most, data[i]);
  }
  return most - least;
}"""


@pytest.fixture(scope="module")
def state():
    return widget_state(SunEditor(sw.analyze(sw.sample("coast").preview(192))).wait())


def test_twenty_editors_in_one_page(page, state):
    count_contexts(page)
    page.evaluate(f"state => {{ for (let i = 0; i < {EDITORS}; i++) addEditor(state); }}", state)
    views = page.locator(".sunwidget")
    live = page.locator(".sw-live")
    assert views.count() == EDITORS
    # Those far below the window wait until they are scrolled to.
    views.first.and_(live).wait_for()
    assert live.count() < 4
    most = 0
    for i in range(EDITORS):
        views.nth(i).scroll_into_view_if_needed()
        views.nth(i).and_(live).wait_for()
        assert page.evaluate(SPREAD, i) > 100, f"editor {i} shows no picture"
        if i % 3 == 0:  # each could be; a few save time
            drag_sun(page, i)
            assert page.evaluate(f"models[{i}].get('sun_azimuth')") is not None
        most = max(most, live_contexts(page))
    assert 1 < most <= MOST_CONTEXTS
    # Those that had to give their context back still show their picture, and can be dragged.
    assert min(page.evaluate(SPREAD, i) for i in range(EDITORS)) > 100
    drag_sun(page, 0)
    assert live_contexts(page) <= MOST_CONTEXTS
    page.evaluate("closeAll()")
    assert live_contexts(page) == 0
    assert page.errors == []


def test_a_context_may_be_lost_at_any_moment_of_a_frame(page, state):
    page.evaluate("async state => makeFrame(state)", state)
    whole = page.evaluate("drawn({ sun_elevation: 4 })")
    # Lost within that call, counted over a frame from nothing to the canvas.
    for call, count in (
        ("compileShader", 3),
        ("linkProgram", 9),
        ("getActiveUniform", 20),
        ("texImage2D", 2),
        ("texStorage2D", 6),
        ("drawArrays", 1),
        ("drawArrays", 24),
    ):
        answer = page.evaluate(
            """([call, count]) => {
              frame.releaseContext();
              const prototype = WebGL2RenderingContext.prototype;
              const original = prototype[call];
              prototype[call] = function (...rest) {
                count -= 1;
                if (count === 0) this.getExtension("WEBGL_lose_context").loseContext();
                return original.apply(this, rest);
              };
              try {
                return [frame.draw({ sun_elevation: 4 }, frame.size), count <= 0];
              } catch (error) {
                return error.message;
              } finally {
                prototype[call] = original;
              }
            }""",
            [call, count],
        )
        assert answer == [False, True], f"lost in {call} {count}: {answer}"
        assert page.evaluate("drawn({ sun_elevation: 4 })") == whole
