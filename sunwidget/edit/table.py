"""Edit: the one table of every parameter that a user can set.

Traits, sliders, shader uniforms, command-line flags, recipes and the parameter page of the
documentation derive from the fields below; they are listed nowhere else. A field whose default
is ``None`` is *automatic*: it takes the value that the analysis found in the photo
(``Scene.automatic``), so an edit without values moves nothing.
"""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Literal, NamedTuple, Self

from sunwidget.errors import EditError, UnknownParameterError
from sunwidget.geometry.place import Place, sun_at
from sunwidget.messages import did_you_mean, format_call, short_repr

RECIPE_VERSION = 1
METHODS = ("ratio", "thesis", "thesis_literal")
LIGHTS = ("sun", "moon", "automatic")
COLOUR_LOSSES = ("luminance", "power")
# "analysed": the method given to ``analyze``. The others are names of ``analysis.clouds.METHODS``.
CLOUD_METHODS = ("analysed", "rb_ratio", "rb_difference", "saturation", "learned", "unmix")
StrokeLabel = Literal["sky", "not_sky", "water", "not_water"]
STROKE_LABELS: tuple[StrokeLabel, ...] = ("sky", "not_sky", "water", "not_water")
OUTSIDE: Literal["outside"] = "outside"
"""The sun hint of a photo whose sun is not in the picture."""

Point = tuple[float, float]
SunHint = Point | Literal["outside"]


class Parameter(NamedTuple):
    """One row of the table, as sliders, uniforms, flags and the docs read it.

    ``kind`` is ``"number"``, ``"choice"`` or ``"data"`` (strokes, hints and the place: kept in
    the recipe, never a slider or a uniform). ``analysis`` is true if the photo's maps depend on
    the parameter: when it changes, a host has to call ``correct.corrected`` for new maps.
    """

    name: str
    kind: str
    default: Any
    minimum: float
    maximum: float
    step: float
    unit: str
    label: str
    section: str
    help: str
    choices: tuple[str, ...]
    advanced: bool
    analysis: bool


def _number(
    default: float | None,
    span: tuple[float, float],
    step: float,
    unit: str,
    label: str,
    section: str,
    text: str,
    *,
    advanced: bool = False,
    analysis: bool = False,
) -> Any:
    return field(
        default=default,
        metadata={
            "kind": "number",
            "span": span,
            "step": step,
            "unit": unit,
            "label": label,
            "section": section,
            "help": text,
            "advanced": advanced,
            "analysis": analysis,
        },
    )


def _choice(
    default: str,
    choices: tuple[str, ...],
    label: str,
    section: str,
    text: str,
    *,
    advanced: bool = False,
    analysis: bool = False,
) -> Any:
    return field(
        default=default,
        metadata={
            "kind": "choice",
            "choices": choices,
            "label": label,
            "section": section,
            "help": text,
            "advanced": advanced,
            "analysis": analysis,
        },
    )


def _data(
    default: Any, label: str, text: str, section: str = "corrections", *, analysis: bool = True
) -> Any:
    return field(
        default=default,
        metadata={
            "kind": "data",
            "label": label,
            "section": section,
            "help": text,
            "analysis": analysis,
        },
    )


@dataclass(frozen=True)
class Stroke:
    """A brush stroke that corrects a map.

    Parameters
    ----------
    label : {"sky", "not_sky", "water", "not_water"}
        What lies under the brush.
    points : tuple of (x, y)
        Polyline in fractions of the picture's width and height, 0–1.
    radius : float
        Brush radius in fractions of the picture's longer side.
    """

    label: StrokeLabel
    points: tuple[Point, ...]
    radius: float = 0.01


@dataclass(frozen=True, kw_only=True)
class Edit:
    """Every parameter of one edit. ``Edit()`` moves nothing.

    Parameters
    ----------
    **values
        Any row of ``PARAMETERS`` by name; docs/guide/parameters.md lists them with units and
        ranges. ``None`` keeps the photo's own value.

    Raises
    ------
    EditError
        For an unknown name (the nearest spelling is suggested) or a value out of range.

    Examples
    --------
    >>> sw.Edit(sun_elevation=3, cloud_opacity=0.5)
    """

    # fmt: off
    sun_azimuth: float | None = _number(None, (-180, 180), 0.1, "°", "Azimuth", "sun",
        "Sun's azimuth, relative to the camera's heading, positive to the right.")
    sun_elevation: float | None = _number(None, (-12, 90), 0.1, "°", "Elevation", "sun",
        "Sun's apparent elevation above the horizon; negative is twilight.")
    sun_size: float = _number(1.0, (0, 5), 0.05, "×", "Disc size", "sun",
        "Diameter of the drawn disc, relative to the disc in the photo, or to 0.533° if the photo "
        "shows none; 0 draws no disc.", advanced=True)
    sun_visibility: float = _number(1.0, (0, 1), 0.01, "", "Disc light", "sun",
        "Share of the disc's light that comes through; 0 hides the sun, as a thick cloud does.",
        advanced=True)
    light_source: str = _choice("automatic", LIGHTS, "Light", "sun",
        "sun; moon, a full moon in the sun's position; or automatic, as in the photo.")
    sky_strength: float = _number(1.0, (0, 1), 0.01, "", "Sky strength", "sky",
        "How much the sky follows the moved sun; 0 turns it off exactly.")
    aerosol_optical_depth: float | None = _number(None, (0, 0.6), 0.005, "", "Haze", "sky",
        "Aerosol optical depth at 550 nm (AOD).")
    angstrom_exponent: float | None = _number(None, (0, 2), 0.05, "", "Ångström exponent", "sky",
        "How much more aerosol scatters blue than red: large for fine smoke, 0 for fog.",
        advanced=True)
    aerosol_asymmetry: float | None = _number(None, (0, 0.95), 0.01, "", "Forward lobe g", "sky",
        "Cornette–Shanks asymmetry of the aerosol: the higher, the tighter the white ring around "
        "the sun.", advanced=True)
    aerosol_albedo: float | None = _number(None, (0.7, 1), 0.01, "", "Aerosol albedo", "sky",
        "Single-scattering albedo of the aerosol; below 1 it absorbs.", advanced=True)
    ozone: float | None = _number(None, (0, 500), 5, "DU", "Ozone", "sky",
        "Ozone column in Dobson units; ozone makes the blue hour blue.", advanced=True)
    ground_albedo: float | None = _number(None, (0, 1), 0.01, "", "Ground albedo", "sky",
        "Share of light that the land reflects back into the sky.", advanced=True)
    altitude: float | None = _number(None, (0, 30000), 10, "m", "Altitude", "sky",
        "Camera's height above sea level.", advanced=True)
    air_density: float | None = _number(None, (0, 2), 0.01, "×", "Air density", "sky",
        "Density of air molecules, relative to the standard atmosphere; 0 removes the blue.",
        advanced=True)
    rayleigh_exponent: float | None = _number(None, (0, 6), 0.01, "", "Rayleigh exponent", "sky",
        "How much more molecules scatter blue than red: λ to the power of minus this; 4.09 in air.",
        advanced=True)
    rayleigh_scale_height: float | None = _number(None, (3000, 15000), 10, "m",
        "Air scale height", "sky", "Height over which the air thins by a factor e.", advanced=True)
    aerosol_scale_height: float | None = _number(None, (200, 6000), 10, "m",
        "Haze scale height", "sky", "Height over which the haze thins by a factor e.",
        advanced=True)
    scattering_orders: float = _number(0.0, (0, 16), 1, "", "Scattering orders", "sky",
        "How often light may be scattered: 0 any number of times, n up to n times.",
        advanced=True)
    cloud_strength: float = _number(0.5, (0, 1), 0.01, "", "Cloud strength", "clouds",
        "How much the clouds follow the model; 0 turns it off exactly, and 1 flattens them.")
    silver_lining: float = _number(1.0, (0, 3), 0.05, "", "Silver lining", "clouds",
        "Forward scattering in thin cloud edges near the sun.")
    cloud_method: str = _choice("analysed", CLOUD_METHODS, "Cloud detection", "clouds",
        "Method that separates clouds from clear sky; analysed keeps the one given to analyze().",
        analysis=True)
    cloud_opacity: float = _number(1.0, (0, 2), 0.01, "×", "Opacity", "clouds",
        "Opacity of the photo's own clouds, relative to the photo; 0 removes them.")
    cloud_softness: float = _number(0.0, (0, 1), 0.01, "", "Softness", "clouds",
        "How much the edges of the photo's own clouds dissolve.")
    added_clouds: float = _number(0.0, (0, 1), 0.01, "", "Added clouds", "clouds",
        "Share of the sky that a layer of added clouds covers.")
    added_cloud_size: float = _number(1.0, (0.2, 5), 0.05, "km", "Added size", "clouds",
        "Size of the added clouds.")
    added_cloud_height: float = _number(1.5, (0.5, 10), 0.1, "km", "Added height", "clouds",
        "Height of the layer of added clouds above the camera.", advanced=True)
    cloud_pattern: float = _number(0.0, (0, 100), 0.1, "", "Added pattern", "clouds",
        "Pattern of the added clouds; neighboring values blend into each other.",
        advanced=True)
    wind_speed: float = _number(5.0, (0, 15), 0.1, "m/s", "Wind", "clouds",
        "Wind speed: wind moves the added clouds and roughens water.")
    wind_direction: float = _number(0.0, (-180, 180), 1, "°", "Wind towards", "clouds",
        "Direction towards which the wind blows, relative to the camera's heading, positive to "
        "the right.", advanced=True)
    wind_time: float = _number(0.0, (-60, 60), 0.1, "min", "Drift", "clouds",
        "Minutes that the wind has moved the added clouds.", advanced=True)
    land_strength: float = _number(1.0, (0, 1), 0.01, "", "Land strength", "land",
        "How much the land follows the moved sun; 0 turns it off exactly.")
    land_facing: float = _number(0.15, (0, 1), 0.01, "", "Upright surfaces", "land",
        "Share of the land's surfaces that face the camera; the rest face the zenith.",
        advanced=True)
    colourfulness: float = _number(0.25, (0, 1), 0.01, "", "Color loss in shade", "land",
        "How much color the land loses when the sun's disc is hidden (thesis eq. 3.8).")
    colour_loss: str = _choice("luminance", COLOUR_LOSSES, "Color loss by", "land",
        "luminance, which keeps the luminance, or power, as in eq. 3.8 of the thesis.",
        advanced=True)
    shading: float = _number(1.0, (0, 1), 0.01, "", "Shading", "land",
        "How much the light follows the slope of the land; 0 turns it off exactly.")
    gloss: float = _number(1.0, (0, 1), 0.01, "", "Gloss", "land",
        "How much rough ground shines towards the sun; 0 turns it off exactly.")
    cast_shadows: float = _number(1.0, (0, 1), 0.01, "", "Cast shadows", "land",
        "How much the shadows on the land move with the sun; 0 turns it off exactly.")
    cloud_shadows: float = _number(0.5, (0, 1), 0.01, "", "Cloud shadows", "land",
        "How much the clouds' shadows on the land move with the sun; 0 turns it off exactly.")
    aerial_perspective: float = _number(1.0, (0, 1), 0.01, "", "Aerial perspective", "land",
        "How much the air in front of distant land follows the sun; 0 turns it off exactly.")
    window_lights: float = _number(0.0, (0, 4), 0.05, "×", "Lit windows", "land",
        "Light of lamps behind the windows in the photo, relative to a typical room; faint by "
        "day, visible at dusk. 0 turns it off exactly.")
    window_temperature: float = _number(2900.0, (1700, 6500), 50, "K", "Lamp color", "land",
        "Color temperature of those lamps: candles 1900, bulbs 2900, cold tubes 5000.",
        advanced=True)
    water_strength: float = _number(1.0, (0, 1), 0.01, "", "Water strength", "water",
        "How much water reflects the changed sky; 0 lights it as land.")
    glitter: float = _number(1.0, (0, 3), 0.05, "", "Glitter", "water",
        "Strength of the sun's glints on water; 1 matches the waves of this wind.")
    glow: float = _number(1.0, (0, 3), 0.05, "", "Glow", "effects",
        "Camera glare around the moved sun, over sky and land; 1 matches real cameras.")
    starburst: float = _number(1.0, (0, 1), 0.01, "", "Starburst", "effects",
        "Rays that the lens draws around a new sun in a blue sky by day.")
    light_shafts: float = _number(0.0, (0, 1), 0.01, "", "Light shafts", "effects",
        "Beams in the haze where land and clouds let the sun through.")
    lens_flare: float = _number(0.0, (0, 1), 0.01, "", "Lens flare", "effects",
        "Reflections in the lens, on the line from the sun through the picture's center.")
    grain: float = _number(1.0, (0, 2), 0.05, "", "Grain", "effects",
        "The photo's own noise, added to filled areas so that they do not look smooth.")
    exposure: float = _number(0.0, (-4, 4), 0.05, "EV", "Exposure", "camera",
        "Exposure compensation of the picture with the moved sun.")
    auto_exposure: float = _number(0.9, (0, 1), 0.01, "", "Automatic exposure", "camera",
        "How much the camera adapts its exposure as the light falls: 0 locked, 1 fully automatic.")
    method: str = _choice("ratio", METHODS, "Method", "match",
        "ratio (default), thesis (corrected equations) or thesis_literal (as printed).")
    sun_sky_ratio: float = _number(1000.0, (0, 5000), 10, "×", "Sun to sky ratio", "advanced",
        "F^s: weight of sun pixels in the sky's mean color (methods thesis*).", advanced=True)
    thesis_saturation: float = _number(1.0, (0, 1), 0.01, "", "Contrast s", "advanced",
        "s of eq. 3.8 when the sun is fully hidden (methods thesis*).", advanced=True)
    cloud_ratio_min: float = _number(0.62, (0, 2), 0.01, "", "Cloud r/b minimum", "advanced",
        "m_min of eq. 3.5: red/blue, or the method's own index, above which sky is cloud.",
        advanced=True, analysis=True)
    cloud_ratio_max: float = _number(1.0, (0, 3), 0.01, "", "Cloud r/b maximum", "advanced",
        "m_max of eq. 3.6: red/blue, or the method's own index, at which softness reaches 1.",
        advanced=True, analysis=True)
    blend_distance: float = _number(0.35, (0.01, 2), 0.01, "", "Blend distance d_m", "advanced",
        "d_m of eq. 3.12, in picture widths.", advanced=True)
    blend_power: float = _number(1.0, (0.1, 8), 0.1, "", "Blend power B_fp", "advanced",
        "B_fp of eq. 3.12.", advanced=True)
    strokes: tuple[Stroke, ...] = _data((), "Strokes",
        "Sky, not-sky, water and not-water strokes, replayed in order.")
    sun_hint: SunHint | None = _data(None, "Sun in the photo",
        "Position of the photo's own sun, set by the user, in fractions of width and height; "
        "outside if the sun is not in the picture.")
    horizon_hint: tuple[Point, Point] | None = _data(None, "Horizon in the photo",
        "Two points of the horizon, set by the user, in fractions of width and height.")
    fov_hint: float | None = _data(None, "Vertical field of view",
        "Vertical field of view in degrees, set by the user.")
    place: Place | None = _data(None, "Time and place",
        "Latitude, longitude, date, hours UTC and the camera's heading. The editor's clock moves "
        "the sun by them; by themselves they move nothing.", "place", analysis=False)
    # fmt: on

    def __new__(cls, **values: Any) -> Self:
        """Reject unknown keywords with a suggestion, which the generated __init__ cannot give."""
        _refuse_unknown(values)
        return super().__new__(cls)

    def __post_init__(self) -> None:
        for parameter in PARAMETERS:
            value = checked(parameter, getattr(self, parameter.name))
            object.__setattr__(self, parameter.name, value)

    def __repr__(self) -> str:
        return format_call("Edit", self.changed())

    def replace(self, **changes: Any) -> Edit:
        """Return a copy with ``changes`` to parameters by name.

        Raises
        ------
        EditError
            For an unknown name (the nearest spelling is suggested) or a value out of range.
        """
        _refuse_unknown(changes)
        return dataclasses.replace(self, **changes)

    def at(self, place: Place) -> Edit:
        """Return a copy with the sun's position at a place and its time.

        Parameters
        ----------
        place : Place
            Without a heading the azimuth stays as it is. Elevations below −12° become −12°.

        Returns
        -------
        Edit

        Raises
        ------
        ImportError
            Without pvlib; the message names the extra that installs it.

        Examples
        --------
        >>> place = sw.Place(41.0, 29.0, "2024-06-21", time=16.5, heading=270)
        >>> sw.sweep(scene, [sw.Edit().at(place.replace(time=t)) for t in (15, 16, 17)], "day.mp4")
        """
        place = _check_place(place)
        sun = sun_at(place)
        changes: dict[str, Any] = {"place": place, "sun_elevation": round(sun.elevation, 4)}
        if sun.azimuth is not None:
            changes["sun_azimuth"] = round(sun.azimuth, 4)
        return self.replace(**changes)

    def changed(self) -> dict[str, Any]:
        """Return the parameters that differ from their defaults, by name."""
        return {
            p.name: getattr(self, p.name) for p in PARAMETERS if getattr(self, p.name) != p.default
        }

    def to_dict(self) -> dict[str, Any]:
        """Return the recipe: plain JSON types, ``version`` first, non-default values only."""
        recipe: dict[str, Any] = {"version": RECIPE_VERSION}
        for name, value in self.changed().items():
            recipe[name] = plain(value)
        return recipe

    @classmethod
    def from_dict(cls, recipe: Mapping[str, Any]) -> Edit:
        """Return the Edit that a recipe describes. Never executes anything.

        Parameters
        ----------
        recipe : dict
            As ``to_dict`` returns it.

        Returns
        -------
        Edit

        Raises
        ------
        EditError
            When the recipe is not a mapping, comes from a newer version, or has an unknown
            name or an impossible value.
        """
        if not isinstance(recipe, Mapping):
            raise EditError(
                f"A recipe must be a JSON object, not {type(recipe).__name__}. "
                "Pass the result of Edit.to_dict()."
            )
        version = recipe.get("version", RECIPE_VERSION)
        if isinstance(version, bool) or not isinstance(version, int) or version < 1:
            raise EditError(f"Recipe version {short_repr(version)} is not a positive whole number.")
        if version > RECIPE_VERSION:
            raise EditError(
                f"This recipe has version {short_repr(version)}; this sunwidget reads versions up "
                f"to {RECIPE_VERSION}. Update sunwidget to open it."
            )
        values = {k: v for k, v in recipe.items() if k != "version"}
        _refuse_unknown(values)
        return cls(**values)

    def to_json(self) -> str:
        """Return the recipe as indented JSON text."""
        return json.dumps(self.to_dict(), indent=2)

    @classmethod
    def from_json(cls, text: str | bytes) -> Edit:
        """Return the Edit of a recipe in JSON ``text``; raises EditError like ``from_dict``.

        If a name occurs twice, the last value counts, as in the browser.
        """
        try:
            # Editors on Windows start a file with a byte order mark; json accepts it in bytes.
            recipe = json.loads(text.removeprefix("\ufeff") if isinstance(text, str) else text)
        # TypeError: not text; ValueError: bad syntax, bad UTF-8, numbers of 5000 digits.
        except (TypeError, ValueError, RecursionError) as error:
            raise EditError(f"The recipe is not valid JSON: {error}") from error
        return cls.from_dict(recipe)

    def to_code(self) -> str:
        """Return runnable Python that builds this Edit (``import sunwidget as sw`` first)."""
        return format_call("Edit", self.changed(), "sw.")


def _table() -> tuple[Parameter, ...]:
    rows = []
    for f in fields(Edit):
        m = f.metadata
        low, high = m.get("span", (0.0, 0.0))
        rows.append(
            Parameter(
                name=f.name,
                kind=m["kind"],
                default=f.default,
                minimum=float(low),
                maximum=float(high),
                step=float(m.get("step", 0)),
                unit=m.get("unit", ""),
                label=m["label"],
                section=m["section"],
                help=m["help"],
                choices=m.get("choices", ()),
                advanced=m.get("advanced", False),
                analysis=m["analysis"],
            )
        )
    return tuple(rows)


PARAMETERS: tuple[Parameter, ...] = _table()
NUMBERS: tuple[Parameter, ...] = tuple(p for p in PARAMETERS if p.kind == "number")
# Names of the parameters that change the photo's maps.
CORRECTIONS: tuple[str, ...] = tuple(p.name for p in PARAMETERS if p.analysis)
_BY_NAME = {p.name: p for p in PARAMETERS}


def parameter(name: str) -> Parameter:
    """Return the table's row for ``name``; raises EditError with the nearest spelling."""
    _refuse_unknown([name])
    return _BY_NAME[name]


def unknown_name_message(name: str, others: tuple[str, ...] = ()) -> str:
    """Return the message for an unknown name, with the nearest spelling, also of ``others``."""
    hint = did_you_mean(name, [*_BY_NAME, *others], "See sunwidget.PARAMETERS for the list.")
    return f"Unknown parameter {short_repr(name)}.{hint}"


def _refuse_unknown(names: Any) -> None:
    for name in names:
        if not isinstance(name, str) or name not in _BY_NAME:
            raise UnknownParameterError(unknown_name_message(name))


def checked(p: Parameter, value: Any) -> Any:
    """Return ``value`` in the form that an Edit stores; raises EditError if the row rejects it."""
    if p.kind == "choice":
        if not isinstance(value, str) or value not in p.choices:
            raise EditError(
                f"{p.name} must be one of {', '.join(p.choices)}, not {short_repr(value)}."
            )
        return p.choices[p.choices.index(value)]  # a plain str, even for a subclass of str
    if p.kind == "number":
        if value is None and p.default is None:
            return None
        return _check_number(p.name, value, p.minimum, p.maximum, p.unit)
    if p.name == "strokes":
        return _check_strokes(value)
    if value is None:
        return None
    if p.name == "fov_hint":
        return _check_number(p.name, value, 1, 150, "°")
    if p.name == "place":
        return _check_place(value)
    if p.name == "sun_hint":
        return _check_sun_hint(p.name, value)
    points = _check_points(p.name, value)
    if len(points) != 2 or points[0][0] == points[1][0]:
        raise EditError(f"{p.name} needs two points with different x, not {short_repr(value)}.")
    return points


def _check_number(name: str, value: Any, low: float, high: float, unit: str = "") -> float:
    try:
        number = math.nan if isinstance(value, (str, bytes, bool)) else float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not math.isfinite(number):
        raise EditError(
            f"{name} must be a number from {low:g} to {high:g}, not {short_repr(value)}."
        )
    if not low <= number <= high:
        raise EditError(f"{name} = {number:g} is outside {low:g} to {high:g} {unit}".rstrip() + ".")
    return number


def _check_point(name: str, value: Any) -> Point:
    if not isinstance(value, (tuple, list)) or len(value) != 2:
        raise EditError(f"{name} must be a pair (x, y), not {short_repr(value)}.")
    return (
        _check_number(f"{name} x", value[0], -10, 10),
        _check_number(f"{name} y", value[1], -10, 10),
    )


def _check_sun_hint(name: str, value: Any) -> SunHint:
    if isinstance(value, str) and value == OUTSIDE:
        return OUTSIDE
    if isinstance(value, (tuple, list)) and len(value) == 2:
        return _check_point(name, value)
    raise EditError(f"{name} must be a pair (x, y) or {OUTSIDE!r}, not {short_repr(value)}.")


def _check_points(name: str, value: Any) -> tuple[Point, ...]:
    if not isinstance(value, (tuple, list)) or not value:
        raise EditError(f"{name} must be a list of (x, y) pairs, not {short_repr(value)}.")
    return tuple(_check_point(name, point) for point in value)


def _check_strokes(value: Any) -> tuple[Stroke, ...]:
    if not isinstance(value, (tuple, list)):
        raise EditError(f"strokes must be a list of strokes, not {short_repr(value)}.")
    checked = []
    for stroke in value:
        if isinstance(stroke, Stroke):
            stroke = vars(stroke)
        if not isinstance(stroke, dict) or not {"label", "points"} <= stroke.keys():
            raise EditError(f"A stroke needs a label and points, not {short_repr(stroke)}.")
        label = stroke["label"]
        if not isinstance(label, str) or label not in STROKE_LABELS:
            raise EditError(
                f"A stroke's label must be one of {', '.join(STROKE_LABELS)}, "
                f"not {short_repr(label)}."
            )
        extra = stroke.keys() - {"label", "points", "radius"}
        if extra:
            raise EditError(
                f"A stroke has label, points and radius, but no {short_repr(min(map(str, extra)))}."
            )
        checked.append(
            Stroke(
                STROKE_LABELS[STROKE_LABELS.index(label)],
                _check_points("stroke", stroke["points"]),
                _check_number("stroke radius", stroke.get("radius", 0.01), 0.0005, 0.5),
            )
        )
    return tuple(checked)


def _check_place(value: Any) -> Place:
    if isinstance(value, Place):
        return value
    try:
        return Place.from_dict(value)
    except ValueError as error:
        raise EditError(str(error)) from None


def plain(value: Any) -> Any:
    """Return a parameter's value as plain JSON types: lists for tuples, objects for strokes."""
    if dataclasses.is_dataclass(value):
        return {f.name: plain(getattr(value, f.name)) for f in fields(value)}
    if isinstance(value, tuple):
        return [plain(item) for item in value]
    return value
