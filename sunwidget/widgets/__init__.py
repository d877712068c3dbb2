"""Widgets for Jupyter: traits and messages only; the picture is drawn in ``js/``."""

from sunwidget.widgets.sky_explorer import SkyExplorer
from sunwidget.widgets.sun_editor import SunEditor

__all__ = ["SkyExplorer", "SunEditor"]
