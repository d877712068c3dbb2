"""Conversion of SkyExplorer's parameters to uniforms; the browser's twin is ``explorer/values.js``.

Switches are applied here: a shader receives an atmosphere without haze, not a switch. The frame
graph has two states: ``edit``, the chosen atmosphere, and ``single``, the same with only the first
order of scattering.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from sunwidget.explorer.table import EXPLORER_PARAMETERS

# Parameters that a switch sets to zero when it is off.
SWITCHED_OFF = {
    "show_rayleigh": "air_density",
    "show_aerosol": "aerosol_optical_depth",
    "show_ozone": "ozone",
}


def effective_values(parameters: Mapping[str, Any]) -> dict[str, dict[str, float]]:
    """Return the values of every uniform in both states.

    Parameters
    ----------
    parameters : mapping
        Value of every row of ``EXPLORER_PARAMETERS`` by name.

    Returns
    -------
    dict
        ``{"edit": {name: number}, "single": {name: number}}``: numbers unchanged, the index of a
        choice, 0 or 1 for a switch. Data (place, date, scan) are not uniforms.
    """
    values: dict[str, float] = {}
    for row in EXPLORER_PARAMETERS:
        value = parameters[row.name]
        if row.kind == "choice":
            values[row.name] = float(row.choices.index(value))
        elif row.kind != "data":
            values[row.name] = float(value)
    for switch, name in SWITCHED_OFF.items():
        if not parameters[switch]:
            values[name] = 0.0
    # When compared with another model, the state "edit" belongs to that model.
    if parameters["model"] == "single" and parameters["compare"] in ("none", "single"):
        values["scattering_orders"] = 1.0
    return {"edit": values, "single": {**values, "scattering_orders": 1.0}}
