"""What a cell's output holds: the widget, and a picture for viewers that run no widgets."""

from __future__ import annotations

import base64
import contextlib
import sys
from collections.abc import Callable
from typing import Any

from sunwidget.errors import RendererError

WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
# nbclient, which nbconvert runs notebooks with, starts kernels so.
_OF_NBCLIENT = "--HistoryManager.hist_file=:memory:"


def unattended() -> bool:
    """Return whether the running cell was sent by a program that only stores what it shows.

    True in the kernels of nbclient (``jupyter nbconvert --execute``). Both of its marks must be
    there, so that a kernel which somebody keeps from writing a history is not taken for one:
    notebooks name the cell in what they send.
    """
    kernel: Any = getattr(_shell(), "kernel", None)
    if _OF_NBCLIENT not in sys.argv or not hasattr(kernel, "get_parent"):
        return False
    return not kernel.get_parent().get("metadata")


def _shell() -> Any:
    interactive = sys.modules.get("IPython")
    return interactive.get_ipython() if interactive else None


def with_picture(bundle: Any, picture: Callable[[], bytes]) -> Any:
    """Return a display bundle with the PNG that viewers without widgets show, as GitHub does.

    Without EGL there may be none, and the widget works all the same. In an unattended kernel
    the picture stands alone: nbconvert would write the widget instead, which is an empty place
    in a page that cannot load its manager from the network.
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
