"""Edit: the one frozen table of every number a person can set.

Traits, sliders, shader uniforms, command-line flags, recipes and the parameter page
of the documentation all derive from the fields below; nothing else lists them.
A field whose default is ``None`` is *automatic*: it takes the value that the analysis
found in the photo (``Scene.automatic``), so an edit that names nothing moves nothing.
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
from sunwidget.messages import called, did_you_mean, shown

RECIPE_VERSION = 1
METHODS = ("ratio", "thesis", "thesis_literal")
LIGHTS = ("sun", "moon", "automatic")
COLOUR_LOSSES = ("luminance", "power")
# "analysed": as ``analyze`` chose. The others are the names in ``analysis.clouds.METHODS``.
CLOUD_METHODS = ("analysed", "rb_ratio", "rb_difference", "saturation", "learned", "unmix")
StrokeLabel = Literal["sky", "not_sky", "water", "not_water"]
STROKE_LABELS: tuple[StrokeLabel, ...] = ("sky", "not_sky", "water", "not_water")
OUTSIDE: Literal["outside"] = "outside"
"""Said of the photo's sun when nothing in the picture is it."""

Point = tuple[float, float]
SunHint = Point | Literal["outside"]


class Parameter(NamedTuple):
    """One row of the table, as seen by sliders, uniforms, flags and the docs.

    ``kind`` is ``"number"``, ``"choice"`` or ``"data"`` (strokes, hints and the place: kept in
    the recipe, never a slider or a uniform). ``analysis`` says that the photo's maps follow the
    parameter, so that a host has to ask ``correct.corrected`` for them when it changes.
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
        What the person says lies under the brush.
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
        ranges. ``None`` is what the photo has.

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
        "Diameter of the drawn disc in units of the photo's own, of 0.533° without one; 0: none.",
        advanced=True)
    sun_visibility: float = _number(1.0, (0, 1), 0.01, "", "Disc's light", "sun",
        "Share of the disc's light that comes through; 0 is no sun, as behind a thick cloud.",
        advanced=True)
    light_source: str = _choice("automatic", LIGHTS, "Light", "sun",
        "sun, or moon: a full moon that stands where the sun would; automatic as in the photo.")
    sky_strength: float = _number(1.0, (0, 1), 0.01, "", "Sky strength", "sky",
        "How far the sky follows the moved sun; 0 is exactly off.")
    aerosol_optical_depth: float | None = _number(None, (0, 0.6), 0.005, "", "Haze", "sky",
        "Aerosol optical depth at 550 nm (AOD).")
    angstrom_exponent: float | None = _number(None, (0, 2), 0.05, "", "Ångström exponent", "sky",
        "How much more aerosol scatters blue than red: large for fine smoke, 0 for fog.",
        advanced=True)
    aerosol_asymmetry: float | None = _number(None, (0, 0.95), 0.01, "", "Forward lobe g", "sky",
        "Cornette–Shanks asymmetry of the aerosol: how tight the white ring round the sun is.",
        advanced=True)
    aerosol_albedo: float | None = _number(None, (0.7, 1), 0.01, "", "Aerosol albedo", "sky",
        "Single-scattering albedo of the aerosol; below 1 it absorbs.", advanced=True)
    ozone: float | None = _number(None, (0, 500), 5, "DU", "Ozone", "sky",
        "Ozone column in Dobson units; it makes the blue hour blue.", advanced=True)
    ground_albedo: float | None = _number(None, (0, 1), 0.01, "", "Ground albedo", "sky",
        "Share of light that the land reflects back into the sky.", advanced=True)
    altitude: float | None = _number(None, (0, 30000), 10, "m", "Altitude", "sky",
        "Camera's height above sea level.", advanced=True)
    air_density: float | None = _number(None, (0, 2), 0.01, "×", "Air density", "sky",
        "Molecules of the air over those of the standard atmosphere; 0 takes the blue away.",
        advanced=True)
    rayleigh_exponent: float | None = _number(None, (0, 6), 0.01, "", "Rayleigh exponent", "sky",
        "How much more molecules scatter blue than red: λ to minus this, 4.09 in air.",
        advanced=True)
    rayleigh_scale_height: float | None = _number(None, (3000, 15000), 10, "m",
        "Air scale height", "sky", "Height over which the air thins by a factor e.", advanced=True)
    aerosol_scale_height: float | None = _number(None, (200, 6000), 10, "m",
        "Haze scale height", "sky", "Height over which the haze thins by a factor e.",
        advanced=True)
    scattering_orders: float = _number(0.0, (0, 16), 1, "", "Scattering orders", "sky",
        "How often light may be scattered: 0 any number of times, 1 once, n up to n times.",
        advanced=True)
    cloud_strength: float = _number(1.0, (0, 1), 0.01, "", "Cloud strength", "clouds",
        "How far the clouds follow the moved sun; 0 is exactly off.")
    silver_lining: float = _number(1.0, (0, 3), 0.05, "", "Silver lining", "clouds",
        "Forward scattering in thin cloud edges near the sun.")
    cloud_method: str = _choice("analysed", CLOUD_METHODS, "Found by", "clouds",
        "How clouds are separated from clear sky; analysed keeps the method given to analyze().",
        analysis=True)
    cloud_opacity: float = _number(1.0, (0, 2), 0.01, "×", "Opacity", "clouds",
        "Opacity of the photo's own clouds in units of what it is; 0 removes them.")
    cloud_softness: float = _number(0.0, (0, 1), 0.01, "", "Softness", "clouds",
        "How far the edges of the photo's own clouds dissolve.")
    added_clouds: float = _number(0.0, (0, 1), 0.01, "", "Added clouds", "clouds",
        "Share of the sky that a layer of added clouds covers; 0 adds none.")
    added_cloud_size: float = _number(1.0, (0.2, 5), 0.05, "km", "Added size", "clouds",
        "Size of the added clouds.")
    added_cloud_height: float = _number(1.5, (0.5, 10), 0.1, "km", "Added height", "clouds",
        "Height of the added clouds' layer above the camera.", advanced=True)
    cloud_pattern: float = _number(0.0, (0, 100), 0.1, "", "Added pattern", "clouds",
        "Which of many patterns the added clouds take; neighbours flow into each other.",
        advanced=True)
    wind_speed: float = _number(5.0, (0, 15), 0.1, "m/s", "Wind", "clouds",
        "Wind: it drives the added clouds and roughens water.")
    wind_direction: float = _number(0.0, (-180, 180), 1, "°", "Wind towards", "clouds",
        "Where the wind blows to, relative to the camera's heading, positive to the right.",
        advanced=True)
    wind_time: float = _number(0.0, (-60, 60), 0.1, "min", "Drift", "clouds",
        "How long the wind has driven the added clouds.", advanced=True)
    land_strength: float = _number(1.0, (0, 1), 0.01, "", "Land strength", "land",
        "How far the land follows the moved sun; 0 is exactly off.")
    land_facing: float = _number(0.15, (0, 1), 0.01, "", "Upright surfaces", "land",
        "Share of the land's surfaces that face the camera; the rest faces the zenith.",
        advanced=True)
    colourfulness: float = _number(0.5, (0, 1), 0.01, "", "Colour loss in shade", "land",
        "How much colour the land loses when the sun's disc is hidden (thesis eq. 3.8).")
    colour_loss: str = _choice("luminance", COLOUR_LOSSES, "Colour loss by", "land",
        "luminance, which it keeps, or power, as in eq. 3.8 of the thesis.", advanced=True)
    shading: float = _number(1.0, (0, 1), 0.01, "", "Shading", "land",
        "How far the light follows the slope of the land; 0 is exactly off.")
    gloss: float = _number(1.0, (0, 1), 0.01, "", "Gleam", "land",
        "How far rough ground gleams towards the sun; 0 is exactly off.")
    cast_shadows: float = _number(1.0, (0, 1), 0.01, "", "Cast shadows", "land",
        "How far shadows in the land leave the old sun and follow the new one; 0 is exactly off.")
    cloud_shadows: float = _number(0.5, (0, 1), 0.01, "", "Cloud shadows", "land",
        "How far the clouds' shadows on the land follow the sun; 0 is exactly off.")
    aerial_perspective: float = _number(1.0, (0, 1), 0.01, "", "Aerial perspective", "land",
        "How far the air before distant land follows the sun; 0 is exactly off.")
    window_lights: float = _number(0.0, (0, 4), 0.05, "×", "Lit windows", "land",
        "Light of lamps behind the windows that the photo shows, in units of a usual room's; it "
        "drowns by day and shows at dusk. 0 is exactly off.")
    window_temperature: float = _number(2900.0, (1700, 6500), 50, "K", "Lamps' colour", "land",
        "Colour temperature of those lamps: candles 1900, bulbs 2900, cold tubes 5000.",
        advanced=True)
    water_strength: float = _number(1.0, (0, 1), 0.01, "", "Water strength", "water",
        "How far water mirrors the changed sky; 0 lights it as land.")
    glitter: float = _number(1.0, (0, 3), 0.05, "", "Glitter", "water",
        "The sun's glints on water: 1 as the waves of this wind make them.")
    glow: float = _number(1.0, (0, 3), 0.05, "", "Glow", "effects",
        "Glare of the camera round the moved sun, before sky and land: 1 as cameras have it.")
    light_shafts: float = _number(0.25, (0, 1), 0.01, "", "Light shafts", "effects",
        "Beams in the haze where land and clouds let the sun through.")
    lens_flare: float = _number(0.0, (0, 1), 0.01, "", "Lens flare", "effects",
        "Reflections in the lens on the line from the sun through the picture's centre.")
    grain: float = _number(1.0, (0, 2), 0.05, "", "Grain", "effects",
        "The photo's own noise on what was filled, so that it does not look smooth.")
    exposure: float = _number(0.0, (-4, 4), 0.05, "EV", "Exposure", "camera",
        "Exposure compensation of the moved picture.")
    auto_exposure: float = _number(0.9, (0, 1), 0.01, "", "Automatic exposure", "camera",
        "How far the camera re-exposes as the light falls: 0 locked, 1 fully automatic.")
    method: str = _choice("ratio", METHODS, "Method", "match",
        "ratio (default), thesis (corrected equations) or thesis_literal (as printed).")
    sun_sky_ratio: float = _number(1000.0, (0, 5000), 10, "×", "Sun to sky ratio", "advanced",
        "F^s: weight of sun pixels in the sky's mean colour (methods thesis*).", advanced=True)
    thesis_saturation: float = _number(1.0, (0, 1), 0.01, "", "Contrast s", "advanced",
        "s of eq. 3.8 when the sun is fully hidden (methods thesis*).", advanced=True)
    cloud_ratio_min: float = _number(0.62, (0, 2), 0.01, "", "Cloud r/b minimum", "advanced",
        "m_min of eq. 3.5: red/blue, or its like for the method, above which sky is cloud.",
        advanced=True, analysis=True)
    cloud_ratio_max: float = _number(1.0, (0, 3), 0.01, "", "Cloud r/b maximum", "advanced",
        "m_max of eq. 3.6: red/blue, or its like, at which softness reaches 1.",
        advanced=True, analysis=True)
    blend_distance: float = _number(0.35, (0.01, 2), 0.01, "", "Blend distance d_m", "advanced",
        "d_m of eq. 3.12, in picture widths.", advanced=True)
    blend_power: float = _number(1.0, (0.1, 8), 0.1, "", "Blend power B_fp", "advanced",
        "B_fp of eq. 3.12.", advanced=True)
    strokes: tuple[Stroke, ...] = _data((), "Strokes",
        "Sky, not-sky, water and not-water strokes, replayed in order.")
    sun_hint: SunHint | None = _data(None, "Sun in the photo",
        "Where the person says the photo's own sun is, in fractions of width and height; outside "
        "when nothing in the picture is the sun.")
    horizon_hint: tuple[Point, Point] | None = _data(None, "Horizon in the photo",
        "Two points of the horizon that the person set, in fractions of width and height.")
    fov_hint: float | None = _data(None, "Vertical field of view",
        "Vertical field of view in degrees that the person set.")
    place: Place | None = _data(None, "Time and place",
        "Latitude, longitude, date, hours UTC and the camera's heading; the editor's clock moves "
        "the sun by them, they alone move nothing.", "place", analysis=False)
    # fmt: on

    def __new__(cls, **values: Any) -> Self:
        """Refuse unknown keywords with a suggestion, which the generated __init__ cannot."""
        _refuse_unknown(values)
        return super().__new__(cls)

    def __post_init__(self) -> None:
        for parameter in PARAMETERS:
            value = checked(parameter, getattr(self, parameter.name))
            object.__setattr__(self, parameter.name, value)

    def __repr__(self) -> str:
        return called("Edit", self.changed())

    def replace(self, **changes: Any) -> Edit:
        """Return a copy with ``changes`` to the parameters that they name.

        Raises
        ------
        EditError
            For an unknown name (the nearest spelling is suggested) or a value out of range.
        """
        _refuse_unknown(changes)
        return dataclasses.replace(self, **changes)

    def at(self, place: Place) -> Edit:
        """Return a copy with the sun where it stands at a place and its time.

        Parameters
        ----------
        place : Place
            Without a heading the azimuth stays as it is. Below −12° the sun is held there.

        Returns
        -------
        Edit

        Raises
        ------
        ImportError
            Without pvlib; the message names the extra that brings it.

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
            When the recipe is not a mapping, comes from a newer version, or holds an
            unknown name or an impossible value.
        """
        if not isinstance(recipe, Mapping):
            raise EditError(
                f"A recipe is a JSON object, not {type(recipe).__name__}. "
                "Pass what Edit.to_dict() returned."
            )
        version = recipe.get("version", RECIPE_VERSION)
        if isinstance(version, bool) or not isinstance(version, int) or version < 1:
            raise EditError(f"Recipe version {shown(version)} is not a positive whole number.")
        if version > RECIPE_VERSION:
            raise EditError(
                f"This recipe has version {shown(version)}, this sunwidget reads up to "
                f"{RECIPE_VERSION}. Update sunwidget to open it."
            )
        values = {k: v for k, v in recipe.items() if k != "version"}
        _refuse_unknown(values)
        return cls(**values)

    def to_json(self) -> str:
        """Return the recipe as indented JSON text."""
        return json.dumps(self.to_dict(), indent=2)

    @classmethod
    def from_json(cls, text: str | bytes) -> Edit:
        """Return the Edit of a recipe as JSON ``text``; raises EditError like ``from_dict``.

        Of a name that stands there twice the last value counts, as in the browser.
        """
        try:
            # Editors on Windows begin a file with a mark of its byte order; bytes may have one.
            recipe = json.loads(text.removeprefix("\ufeff") if isinstance(text, str) else text)
        # TypeError: no text at all; ValueError: bad syntax, bad UTF-8, numbers of 5000 digits.
        except (TypeError, ValueError, RecursionError) as error:
            raise EditError(f"The recipe is not valid JSON: {error}") from error
        return cls.from_dict(recipe)

    def to_code(self) -> str:
        """Return runnable Python that builds this Edit (``import sunwidget as sw`` first)."""
        return called("Edit", self.changed(), "sw.")


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
# Names of what the photo's maps follow.
CORRECTIONS: tuple[str, ...] = tuple(p.name for p in PARAMETERS if p.analysis)
_BY_NAME = {p.name: p for p in PARAMETERS}


def parameter(name: str) -> Parameter:
    """Return the table's row for ``name``; raises EditError with the nearest spelling."""
    _refuse_unknown([name])
    return _BY_NAME[name]


def unknown_name_message(name: str, others: tuple[str, ...] = ()) -> str:
    """Say that ``name`` is no parameter and suggest the nearest spelling, also of ``others``."""
    hint = did_you_mean(name, [*_BY_NAME, *others], "See sunwidget.PARAMETERS for the list.")
    return f"Unknown parameter {shown(name)}.{hint}"


def _refuse_unknown(names: Any) -> None:
    for name in names:
        if not isinstance(name, str) or name not in _BY_NAME:
            raise UnknownParameterError(unknown_name_message(name))


def checked(p: Parameter, value: Any) -> Any:
    """Return ``value`` as an Edit holds it; raises EditError where the row does not take it."""
    if p.kind == "choice":
        if not isinstance(value, str) or value not in p.choices:
            raise EditError(f"{p.name} must be one of {', '.join(p.choices)}, not {shown(value)}.")
        return p.choices[p.choices.index(value)]  # a plain str, whose repr is its own
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
        raise EditError(f"{p.name} needs two points with different x, not {shown(value)}.")
    return points


def _check_number(name: str, value: Any, low: float, high: float, unit: str = "") -> float:
    try:
        number = math.nan if isinstance(value, (str, bytes, bool)) else float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not math.isfinite(number):
        raise EditError(f"{name} must be a number from {low:g} to {high:g}, not {shown(value)}.")
    if not low <= number <= high:
        raise EditError(f"{name} = {number:g} is outside {low:g} to {high:g} {unit}".rstrip() + ".")
    return number


def _check_point(name: str, value: Any) -> Point:
    if not isinstance(value, (tuple, list)) or len(value) != 2:
        raise EditError(f"{name} must be a pair (x, y), not {shown(value)}.")
    return (
        _check_number(f"{name} x", value[0], -10, 10),
        _check_number(f"{name} y", value[1], -10, 10),
    )


def _check_sun_hint(name: str, value: Any) -> SunHint:
    if isinstance(value, str) and value == OUTSIDE:
        return OUTSIDE
    if isinstance(value, (tuple, list)) and len(value) == 2:
        return _check_point(name, value)
    raise EditError(f"{name} must be a pair (x, y) or {OUTSIDE!r}, not {shown(value)}.")


def _check_points(name: str, value: Any) -> tuple[Point, ...]:
    if not isinstance(value, (tuple, list)) or not value:
        raise EditError(f"{name} must be a list of (x, y) pairs, not {shown(value)}.")
    return tuple(_check_point(name, point) for point in value)


def _check_strokes(value: Any) -> tuple[Stroke, ...]:
    if not isinstance(value, (tuple, list)):
        raise EditError(f"strokes must be a list of strokes, not {shown(value)}.")
    checked = []
    for stroke in value:
        if isinstance(stroke, Stroke):
            stroke = vars(stroke)
        if not isinstance(stroke, dict) or not {"label", "points"} <= stroke.keys():
            raise EditError(f"A stroke needs a label and points, not {shown(stroke)}.")
        label = stroke["label"]
        if not isinstance(label, str) or label not in STROKE_LABELS:
            raise EditError(
                f"A stroke's label is one of {', '.join(STROKE_LABELS)}, not {shown(label)}."
            )
        extra = stroke.keys() - {"label", "points", "radius"}
        if extra:
            raise EditError(f"A stroke has no {shown(min(map(str, extra)))}.")
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
