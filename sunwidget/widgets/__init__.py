"""Widgets for Jupyter: traits and messages only; the picture is drawn in ``js/``."""

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sunwidget.widgets.compare.compare import Compare
    from sunwidget.widgets.editor.sun_editor import SunEditor
    from sunwidget.widgets.explorer.sky_explorer import SkyExplorer
    from sunwidget.widgets.study import Study

__all__ = ["Compare", "SkyExplorer", "Study", "SunEditor"]

_HOMES = {
    "Compare": "compare.compare",
    "SkyExplorer": "explorer.sky_explorer",
    "Study": "study",
    "SunEditor": "editor.sun_editor",
}


def __getattr__(name: str) -> Any:
    # Imported on first use, so that the first editor does not wait for the other widgets.
    if name not in _HOMES:
        raise AttributeError(f"module 'sunwidget.widgets' has no attribute {name!r}")
    return getattr(importlib.import_module(f"sunwidget.widgets.{_HOMES[name]}"), name)
