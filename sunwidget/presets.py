"""Presets: times of day as plain data, and the edits that they give for a photo.

A preset sets the sun's position, the light source, the exposure and the lamps behind windows. The
rest of an edit (strokes, hints, strengths, the air) stays as it is.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from sunwidget.analysis.correct import corrected
from sunwidget.analysis.scene import checked_scene
from sunwidget.edit.recipe import edit_of
from sunwidget.edit.table import Edit
from sunwidget.errors import EditError
from sunwidget.messages import did_you_mean, short_repr

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene


class Preset(NamedTuple):
    """A time of day.

    Parameters
    ----------
    name, label, help : str
    parameters : mapping
        Values by name of a parameter of ``Edit``; every preset sets the same ones. The azimuth
        depends on the photo (``azimuth``).
    in_view : bool
        Whether a sun behind the camera is moved into the picture.
    """

    name: str
    label: str
    help: str
    parameters: Mapping[str, float | str]
    in_view: bool


def _preset(
    name: str,
    label: str,
    text: str,
    elevation: float,
    *,
    exposure: float = 0.0,
    light: str = "sun",
    windows: float = 0.0,
    in_view: bool = True,
) -> Preset:
    parameters: dict[str, float | str] = {
        "sun_elevation": elevation,
        "light_source": light,
        "exposure": exposure,
        "window_lights": windows,
    }
    return Preset(name, label, text, MappingProxyType(parameters), in_view)


# fmt: off
PRESETS: tuple[Preset, ...] = (
    _preset("dawn", "Dawn", "A little before sunrise: a cool sky with a warm edge, no shadows.",
        -3.0),
    _preset("golden_hour", "Golden hour", "A low, warm sun over a sky that is still blue.", 4.0,
        exposure=-0.4),
    _preset("noon", "Noon", "A high sun: neutral colors, short shadows.", 55.0, in_view=False),
    _preset("sunset", "Sunset", "The sun at the horizon.", 0.8, exposure=-0.6),
    _preset("blue_hour", "Blue hour", "The sun well below the horizon: an even, deep blue.", -5.5,
        exposure=-0.5),
    _preset("dusk_lights", "Lights on", "Dusk, and lamps behind the windows that the photo "
        "shows.", -4.5, exposure=-0.6, windows=1.0),
    _preset("moonlight", "Moonlight", "Night, with a full moon where the sun would be.", 18.0,
        exposure=-0.2, light="moon"),
)
# fmt: on

NAMES: tuple[str, ...] = tuple(preset.name for preset in PRESETS)
_BY_NAME = {preset.name: preset for preset in PRESETS}
# A sun moved into the picture stands a third of the width from the left or right edge.
_THIRD = 1 / 3


def find(name: str) -> Preset:
    """Return the preset of this name.

    Raises
    ------
    EditError
        For an unknown name; the nearest spelling is suggested.
    """
    if isinstance(name, str) and name in _BY_NAME:
        return _BY_NAME[name]
    spelled = name[:80].strip().lower() if isinstance(name, str) else ""
    spelled = spelled.replace(" ", "_").replace("-", "_")
    hint = did_you_mean(spelled, NAMES, f"There are {', '.join(NAMES)}.")
    raise EditError(f"Unknown preset {short_repr(name)}.{hint}")


def azimuth(preset: Preset, scene: Scene) -> float:
    """Return the sun's azimuth in degrees, relative to the camera's heading.

    The photo's own azimuth stays if that sun stands in front of the camera, or if the preset does
    not need the sun in view. Otherwise the sun goes a third of the width from the edge with more
    open sky at its height; at equal openness, from the edge nearer to the photo's own sun.
    """
    own = scene.automatic["sun_azimuth"]
    if not preset.in_view or abs(own) <= 90:
        return own
    elevation = float(preset.parameters["sun_elevation"])
    height = max(elevation, 1.0)
    sides = []
    for share in (_THIRD, 1 - _THIRD):
        x = share * scene.width
        place = scene.camera.angles(x, scene.camera.pixel(0.0, height)[1])[0]
        sides.append((_openness(scene, x, height), share, float(place)))
    nearer = 1 - _THIRD if own > 0 else _THIRD
    best = max(sides, key=lambda side: (round(side[0], 1), side[1] == nearer))
    return round(best[2], 1)


def _openness(scene: Scene, x: float, elevation: float) -> float:
    """Return the share of sky in column ``x``, from this elevation to the top edge."""
    row = int(min(max(scene.camera.pixel(0.0, elevation)[1], 1), scene.height))
    return float(scene.sky[:row, min(int(x), scene.width - 1)].mean())


def values(name: str, scene: Scene) -> dict[str, Any]:
    """Return the values that a preset sets in this photo, by parameter name; see ``edit``."""
    preset = find(name)
    return {"sun_azimuth": azimuth(preset, scene), **preset.parameters}


def edit(name: str, scene: Scene, base: Edit | dict[str, Any] | None = None) -> Edit:
    """Return the edit that shows a photo at another time of day.

    Parameters
    ----------
    name : {"dawn", "golden_hour", "noon", "sunset", "blue_hour", "dusk_lights", "moonlight"}
    scene : Scene
        The result of ``analyze``.
    base : Edit or dict, optional
        The edit to start from: its other parameters stay, including strokes and hints.

    Returns
    -------
    Edit

    Raises
    ------
    EditError
        For an unknown name; the nearest spelling is suggested.

    Examples
    --------
    >>> sw.render(scene, sw.preset("sunset", scene))
    """
    found = values(name, checked_scene(scene))
    base = edit_of(base)
    if base.sun_hint or base.horizon_hint or base.fov_hint:
        found["sun_azimuth"] = azimuth(find(name), corrected(scene, base))
    return base.replace(**found)
