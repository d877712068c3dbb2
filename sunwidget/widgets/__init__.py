"""Widgets for Jupyter: traits and messages only; the picture is drawn in ``js/``."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sunwidget.widgets.compare.compare import Compare
    from sunwidget.widgets.editor.sun_editor import SunEditor
    from sunwidget.widgets.explorer.sky_explorer import SkyExplorer
    from sunwidget.widgets.study import Study

__all__ = ["Compare", "SkyExplorer", "Study", "SunEditor"]


def __getattr__(name: str) -> Any:
    # On first use: a person waits for the first editor, which needs none of the other widgets.
    if name not in __all__:
        raise AttributeError(f"module 'sunwidget.widgets' has no attribute {name!r}")
    import sunwidget

    return getattr(sunwidget, name)
