"""Widgets for Jupyter: traits and messages only; the picture is drawn in ``js/``."""

from sunwidget.widgets.compare import Compare
from sunwidget.widgets.sky_explorer import SkyExplorer
from sunwidget.widgets.study import Study
from sunwidget.widgets.sun_editor import SunEditor

__all__ = ["Compare", "SkyExplorer", "Study", "SunEditor"]
