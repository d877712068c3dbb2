"""The output of a cell: the widget, and a picture for viewers without widgets."""

from __future__ import annotations

import base64
import contextlib
import sys
from collections.abc import Callable
from typing import Any

from sunwidget.errors import RendererError

WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
# nbclient, which executes notebooks for nbconvert, starts kernels with this argument.
_NBCLIENT_ARGUMENT = "--HistoryManager.hist_file=:memory:"


def unattended() -> bool:
    """Return whether a program, not a person, runs the cell and only stores its output.

    True in the kernels of nbclient (``jupyter nbconvert --execute``), which have two marks: the
    argument above, which a person may also set to disable the history, and requests without
    metadata, in which notebooks name the cell.
    """
    kernel: Any = getattr(_shell(), "kernel", None)
    if _NBCLIENT_ARGUMENT not in sys.argv or not hasattr(kernel, "get_parent"):
        return False
    return not kernel.get_parent().get("metadata")


def _shell() -> Any:
    interactive = sys.modules.get("IPython")
    return interactive.get_ipython() if interactive else None


def with_picture(bundle: Any, picture: Callable[[], bytes]) -> Any:
    """Return a display bundle with a PNG for viewers without widgets, such as GitHub.

    Without EGL there may be no picture; the widget still works. In an unattended kernel the picture
    replaces the widget: nbconvert would prefer the widget, which stays empty in a page that cannot
    load the widget manager from the network.
    """
    if bundle is None:
        return None
    data, metadata = bundle
    with contextlib.suppress(RendererError):
        data["image/png"] = base64.b64encode(picture()).decode("ascii")
        if unattended():
            data.pop(WIDGET_VIEW, None)
            metadata.pop(WIDGET_VIEW, None)
    return data, metadata
