"""Parts of a dome's JSON file that photos and environment maps share."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.dome.sphere import toward
from sunwidget.formats.color import LUMINANCE

FORMAT = 1
"""Version of the JSON format; it increases when a name changes its meaning."""
PROJECTION = {
    "kind": "equirectangular",
    "middle_column": "camera heading",
    "to_the_right": "azimuth grows clockwise seen from above",
    "top_row": "zenith",
    "frame": "right-handed; x camera heading, y left, z up",
}


def sun_facts(
    direction: tuple[float, float],
    direct: NDArray[np.float64],
    *,
    heading: float | None,
    drawn: bool,
    through: float,
    confidence: float,
    spread: float,
    klx: float = 1.0,
) -> dict[str, Any]:
    """Return the JSON entry of the sun; ``direct`` times ``klx`` is in klx."""
    from sunwidget.atmosphere.constants import SUN_ANGULAR_RADIUS_DEG

    azimuth, elevation = direction
    level = klx * float(direct @ LUMINANCE)
    brightest = max(float(direct.max()), 1e-30)
    return {
        "in_the_map": drawn,
        "azimuth_deg": round(azimuth, 4),
        "elevation_deg": round(elevation, 4),
        "compass_deg": None if heading is None else round((heading + azimuth) % 360, 4),
        "direction": rounded(toward(azimuth, elevation)),
        "illuminance_lux": digits(1000 * level),
        "irradiance": [digits(value) for value in direct],
        "color": rounded(direct / brightest),
        "angular_diameter_deg": round(2 * SUN_ANGULAR_RADIUS_DEG, 4),
        "share_through_clouds": round(through, 4),
        "photo_sun_confidence": round(confidence, 3),
        "photo_sun_spread_deg": round(spread, 2),
    }


def rounded(values: NDArray[Any] | list[Any]) -> list[float]:
    """Return numbers rounded to five decimal places."""
    return [round(float(value), 5) for value in values]


def digits(value: float) -> float:
    """Return a number rounded to six significant digits."""
    return float(f"{value:.6g}")
