"""What SkyExplorer's parameters are as uniforms; the browser's twin is ``explorer/values.js``.

Switches are applied here, so that a shader knows an atmosphere without haze and not a switch
that hides it. Two states of the frame graph: ``edit``, the atmosphere as chosen, and ``single``,
the same with the first order of scattering alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from sunwidget.explorer.table import EXPLORER_PARAMETERS

# What a switch that is off sets to zero.
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
        ``{"edit": {name: number}, "single": {name: number}}``: numbers as they are, a choice's
        index, 0 or 1 for a switch. Data (place, date, scan) are no uniforms.
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
    # Beside another model, the state "edit" is that model's.
    if parameters["model"] == "single" and parameters["compare"] in ("none", "single"):
        values["scattering_orders"] = 1.0
    return {"edit": values, "single": {**values, "scattering_orders": 1.0}}
