"""Frames of SkyExplorer's canvas while something is dragged."""

from __future__ import annotations

from sunwidget.explorer.table import EXPLORER_PARAMETERS
from sunwidget.widgets.kernel.payload import parameter_json

from .canvas import hazes, suns
from .effort import Effort
from .page import dragged, opened
from .rows import Rows, of_times

KEYS = ("explorer sun drag", "explorer turbidity drag")
_MAKE = """async (parameters) => {
  const { SkyFrame } = await import("/sky_explorer.js");
  window.frame = new SkyFrame(document.createElement("canvas"), parameters);
}"""


def rows(effort: Effort) -> Rows:
    size = effort.frame
    what = f"explorer frame {size[0]}×{size[1]}"
    with opened() as page:
        page.evaluate(_MAKE, parameter_json(EXPLORER_PARAMETERS))
        for projection, key in (("camera", "explorer sun drag"), ("dome", "explorer dome")):
            times = dragged(page, suns(effort, projection=projection), size)
            yield of_times(key, f"{what}, sun drag, {projection}", times, "ms")
        times = dragged(page, hazes(effort), size)
        yield of_times("explorer turbidity drag", f"{what}, turbidity drag", times, "ms")
