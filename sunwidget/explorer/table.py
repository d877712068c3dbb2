"""The table of SkyExplorer's parameters, with rows like the Edit's.

The rows of sun and air are the Edit's, with the values of the default atmosphere instead of "found
in the photo". Two kinds of rows are specific to SkyExplorer: ``"switch"`` (a bool, 0 or 1 as a
uniform) and data for place and time.
"""

from __future__ import annotations

import datetime as dt
from typing import Any

from sunwidget.atmosphere.parameters import RANGES, Atmosphere
from sunwidget.edit import table
from sunwidget.edit.table import Parameter
from sunwidget.errors import EditError
from sunwidget.messages import did_you_mean

MODELS = ("multiple", "single", "bruneton", "reference")
COMPARISONS = ("none", *MODELS)
PROJECTIONS = ("dome", "panorama", "camera")
GRIDS = ("96×80", "128×128", "256×128")
AIR = tuple(RANGES)
"""The rows that are fields of ``Atmosphere``."""
PLACE = ("date", "latitude", "longitude")
"""The rows that determine the sun's path over the day if all are set."""


def _air_row(name: str) -> Parameter:
    row = table.parameter(name)
    return row._replace(default=getattr(Atmosphere(), name), section="air")


def _number(
    name: str,
    default: float,
    span: tuple[float, float],
    step: float,
    unit: str,
    label: str,
    section: str,
    text: str,
) -> Parameter:
    low, high = map(float, span)
    return Parameter(
        name, "number", default, low, high, step, unit, label, section, text, (), False, False
    )


def _choice(
    name: str, choices: tuple[str, ...], default: str, label: str, section: str, text: str
) -> Parameter:
    return Parameter(
        name, "choice", default, 0.0, 0.0, 0.0, "", label, section, text, choices, False, False
    )


def _switch(name: str, label: str, text: str) -> Parameter:
    return Parameter(
        name, "switch", True, 0.0, 1.0, 1.0, "", label, "terms", text, (), False, False
    )


def _data(name: str, *row: Any) -> Parameter:
    """Return a row like ``_number`` for a value that is not a uniform and may be None."""
    return _number(name, 0.0, *row)._replace(kind="data", default=None)


# fmt: off
EXPLORER_PARAMETERS: tuple[Parameter, ...] = (
    table.parameter("sun_elevation")._replace(default=20.0),
    table.parameter("sun_azimuth")._replace(default=0.0,
        help="Sun's azimuth, clockwise; 0 is north once a place is set."),
    table.parameter("sun_size"),
    _data("date", (0, 0), 0, "", "Date", "place",
        "Day of the sky in UTC, as YYYY-MM-DD."),
    _data("time", (0, 24), 1 / 60, "h", "Time", "place",
        "Hours of the day in UTC; moves the sun along its path over the place."),
    _data("latitude", (-90, 90), 0.01, "°", "Latitude", "place",
        "Latitude of the place, positive to the north."),
    _data("longitude", (-180, 180), 0.01, "°", "Longitude", "place",
        "Longitude of the place, positive to the east."),
    *(_air_row(name) for name in AIR),
    _switch("show_rayleigh", "Air molecules", "Off: no scattering by molecules (Rayleigh)."),
    _switch("show_aerosol", "Aerosol", "Off: no haze (Mie scattering)."),
    _switch("show_ozone", "Ozone", "Off: no absorption by ozone."),
    _switch("show_single", "Single scattering", "Light scattered once on its way to the eye."),
    _switch("show_multiple", "Multiple scattering", "Light scattered more than once."),
    _choice("model", MODELS, "multiple", "Model", "model",
        "How the sky is computed: all orders after Hillaire 2020, single scattering after Nishita "
        "1993, Bruneton 2008's table, or path tracing as the reference."),
    _choice("compare", COMPARISONS, "none", "Compare with", "model",
        "Model that draws the right half of the picture."),
    table.parameter("scattering_orders")._replace(section="model"),
    _choice("grid", GRIDS, GRIDS[0], "Sky table", "model",
        "Columns and rows of the table that the sky is read from; 128×128 is Wenzel's."),
    _choice("projection", PROJECTIONS, "dome", "Projection", "view",
        "dome: fisheye of the whole sky, zenith in the middle; panorama: all azimuths side by "
        "side; camera: perspective."),
    _number("view_azimuth", 0.0, (-180, 180), 1, "°", "View azimuth", "view",
        "Azimuth in the middle of the panorama and of the camera's picture, clockwise."),
    _number("view_elevation", 12.0, (-30, 90), 1, "°", "View elevation", "view",
        "Elevation in the middle of the camera's picture."),
    _number("fov", 60.0, (10, 120), 1, "°", "Field of view", "view",
        "Vertical field of view of the camera."),
    _number("exposure", 0.0, (-6, 6), 0.05, "EV", "Exposure", "view",
        "Exposure compensation, relative to the automatic exposure."),
    _number("auto_exposure", 0.9, (0, 1), 0.01, "", "Automatic exposure", "view",
        "How far the eye adapts as the light falls: 0 keeps the exposure of noon, 1 adapts fully."),
    _data("scan", (0, 1000), 1, "", "Measured scan", "measured",
        "Index of the measured scan that is shown over the sky."),
)
# fmt: on
_BY_NAME = {p.name: p for p in EXPLORER_PARAMETERS}


def parameter(name: str) -> Parameter:
    """Return the table's row for ``name``; raises EditError with the nearest spelling."""
    if name not in _BY_NAME:
        raise EditError(unknown_name_message(name))
    return _BY_NAME[name]


def unknown_name_message(name: str, others: tuple[str, ...] = ()) -> str:
    """Return the message for an unknown parameter, with the nearest spelling."""
    hint = did_you_mean(name, [*_BY_NAME, *others], f"Choose among {', '.join(_BY_NAME)}.")
    return f"Unknown parameter {str(name)[:80]!r}.{hint}"


def checked(row: Parameter, value: Any) -> Any:
    """Return ``value`` checked and normalized.

    Parameters
    ----------
    row : Parameter
        Row of ``EXPLORER_PARAMETERS``.
    value : object
        A number, a choice's name, a bool, a date (``datetime.date`` or "YYYY-MM-DD") or, for
        data, None.

    Raises
    ------
    EditError
        For a value that the row does not accept; the message says what it accepts.
    """
    if row.kind == "switch":
        # JSON hosts send true and 1 alike.
        if not isinstance(value, (bool, int)) or value not in (0, 1):
            raise EditError(f"{row.name} must be True or False, not {value!r:.80}.")
        return bool(value)
    if row.kind == "data":
        return None if value is None else _checked_data(row, value)
    return table.checked(row, value)


def _checked_data(row: Parameter, value: Any) -> Any:
    if row.name == "date":
        return _checked_date(value)
    number = table.checked(row._replace(kind="number"), value)
    if row.name != "scan":
        return number
    if number != int(number):
        raise EditError(f"scan must be the index of a scan, 0, 1, 2 …, not {number:g}.")
    return int(number)


def _checked_date(value: Any) -> str:
    if isinstance(value, dt.date):  # includes datetime
        return value.strftime("%Y-%m-%d")
    try:
        return dt.date.fromisoformat(value).isoformat()
    except (TypeError, ValueError):
        raise EditError(f"date must have the form YYYY-MM-DD, not {value!r:.80}.") from None
