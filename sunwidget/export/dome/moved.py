"""The light and the JSON of an environment map whose sun was moved."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.atmosphere.parameters import RANGES
from sunwidget.dome.air import with_air
from sunwidget.dome.relight import Relit, relight, without_sun_of
from sunwidget.dome.source import plain_light, sky_share
from sunwidget.dome.sphere import irradiance
from sunwidget.errors import EditError
from sunwidget.export.dome.facts import FORMAT, PROJECTION, digits, rounded, sun_facts
from sunwidget.formats.color import LUMINANCE

if TYPE_CHECKING:
    from sunwidget.dome.source import Dome
    from sunwidget.edit.table import Edit

Floats = NDArray[np.float32]

_EDITABLE = ("sun_azimuth", "sun_elevation", "sun_visibility", *RANGES)
_WITHOUT_EFFECT = ("place",)  # its sun is already in sun_azimuth and sun_elevation


def check_edit(edit: Edit) -> None:
    """Raise EditError, naming the parameters, for an edit that a dome does not support."""
    others = [name for name in edit.changed() if name not in (*_EDITABLE, *_WITHOUT_EFFECT)]
    if others or edit.strokes:
        names = ", ".join([*others, *(["strokes"] if edit.strokes else [])])
        raise EditError(
            f"An edit of a dome can change its sun and air (sun_azimuth, sun_elevation, "
            f"sun_visibility, {', '.join(RANGES)}), not {names}."
        )


def move_sun(dome: Dome, edit: Edit, width: int) -> Relit:
    """Return a dome's light under an edit, ``width`` pixels wide.

    If the edit moves nothing, ``sky`` and ``disc`` add up to the map itself.
    """
    from sunwidget.analysis.images.working_copy import resize

    check_edit(edit)
    own = dome.fit
    size = (width, width // 2)
    raw = np.asarray(dome.photo.light(), np.float32)
    light, sky = plain_light(raw), dome.sky
    direction = (
        dome.sun[0] if edit.sun_azimuth is None else edit.sun_azimuth,
        dome.sun[1] if edit.sun_elevation is None else edit.sun_elevation,
    )
    changes = {name: getattr(edit, name) for name in RANGES}
    air = own.atmosphere.replace(**{k: v for k, v in changes.items() if v is not None})
    resized = np.asarray(resize(light, *size), np.float32)
    sky = np.asarray(resize(sky, *size), np.float32)
    if direction == dome.sun and air == own.atmosphere and edit.sun_visibility == 1:
        raw = raw if width == dome.photo.width else resized
        clean = without_sun_of(dome, resized, sky)
        return Relit(clean, raw - clean, dome.direct, dome.sun, 1.0, raw)
    return relight(dome, with_air(own, air, direction), edit.sun_visibility, light=resized, sky=sky)


def describe_moved(
    dome: Dome, edit: Edit, light: Relit, name: str, *, drawn: bool
) -> dict[str, Any]:
    """Return the JSON of a moved dome; ``docs/guide/dome.md`` explains it."""
    unit = float(np.array(dome.fit.gain) @ LUMINANCE)
    heading = edit.place.heading if edit.place is not None else None
    share = sky_share(dome)
    sky = light.sky.copy()
    sky[len(sky) // 2 :] = 0
    return {
        "format": FORMAT,
        "dome": name,
        "projection": PROJECTION | {"middle_column": "that of the source"},
        "unit": {
            "colour": "linear Rec. 709, the source's own white balance",
            "radiance": "the source's",
            "kcd_per_unit": digits(1 / unit),
            "absolute": False,
            "scale": "lux by the fitted model: a map does not record its exposure",
        },
        "source": {
            "name": dome.photo.name,
            "sun_azimuth_deg": round(dome.sun[0], 4),
            "sun_elevation_deg": round(dome.sun[1], 4),
            "sun_kind": dome.sun_kind,
            "sun_illuminance_lux": digits(1000 / unit * float(dome.direct @ LUMINANCE)),
            "closed_by_clouds": round(dome.closed, 3),
            "warnings": list(dome.warnings),
        },
        "sun": sun_facts(
            light.direction,
            light.direct,
            heading=heading,
            drawn=drawn,
            through=light.through,
            confidence=dome.sun_confidence,
            spread=dome.sun_spread,
            klx=1 / unit,
        ),
        "sky": {
            "illuminance_level_lux": digits(1000 / unit * float(irradiance(sky) @ LUMINANCE)),
            "seen_sr": round(2 * np.pi * share, 5),
            "seen_share_of_sky": round(share, 5),
            "modelled_share_of_sky": 0.0,
            "outside_the_photo": "nothing",
        },
        "ground": {"albedo": rounded(_albedo(dome)), "lit_by": "ratio of new to old light"},
        "camera": None,
        "horizon": {"elevation_deg": 0.0, "photo_row": dome.photo.height / 2, "confidence": 1.0},
        "recipe": edit.to_dict(),
    }


def _albedo(dome: Dome) -> NDArray[np.float64]:
    """Return the mean albedo (3,) of the source below the horizon."""
    light = plain_light(dome.photo.light())
    half = len(light) // 2
    upper, lower = light.copy(), light.copy()
    upper[half:], lower[:half] = 0, 0
    # A clipped sun lit the ground although the map does not contain its light.
    lit = irradiance(upper)
    if dome.sun_kind == "clipped":
        lit = lit + max(float(np.sin(np.radians(dome.sun[1]))), 0) * dome.direct
    return np.clip(irradiance(lower, (0, 0, -1)) / np.maximum(lit, 1e-30), 0, 1)
