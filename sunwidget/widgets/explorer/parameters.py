"""The parameters of SkyExplorer as traits."""

from __future__ import annotations

from typing import Any

import traitlets

from sunwidget.explorer import table
from sunwidget.explorer.table import EXPLORER_PARAMETERS
from sunwidget.explorer.values import effective_values
from sunwidget.widgets.kernel.edit_traits import ChangedByBrowser, edit_traits
from sunwidget.widgets.kernel.payload import parameter_json

NAMES = tuple(p.name for p in EXPLORER_PARAMETERS)


class ExplorerParameters(ChangedByBrowser):
    """A widget with one trait for each row of the explorer's table."""

    _parameters: traitlets.List = traitlets.List(read_only=True).tag(sync=True)

    # A class body's locals() is the class's own dictionary. Traits that are set by name are
    # declared for the type checker.
    sun_azimuth: float
    sun_elevation: float
    time: float | None
    locals().update(edit_traits(EXPLORER_PARAMETERS, table.checked))

    @traitlets.default("_parameters")
    def _default_parameters(self) -> list[dict[str, Any]]:
        return parameter_json(EXPLORER_PARAMETERS)

    def parameters(self) -> dict[str, Any]:
        """Return the value of every parameter by name, data such as place and date included."""
        return {name: getattr(self, name) for name in NAMES}

    def values(self) -> dict[str, dict[str, float]]:
        """Return what the shaders get, by state and name; see ``explorer.values``."""
        return effective_values(self.parameters())
