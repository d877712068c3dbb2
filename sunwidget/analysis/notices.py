"""What a person should know about an analysis; each notice says what to do."""

from __future__ import annotations

import numpy as np

from sunwidget.analysis import sun as sun_stage
from sunwidget.analysis.fit import SkyFit
from sunwidget.analysis.hints import Hints
from sunwidget.analysis.horizon import Horizon
from sunwidget.analysis.sun import SunObservation
from sunwidget.camera import Camera, Point
from sunwidget.photo import Photo

UNSURE = 0.3  # confidence of the fit below which a person should know
NO_SKY = 0.005  # share of the picture below which the photo counts as without sky


def notices(
    photo: Photo,
    sky: np.ndarray,
    sun: SunObservation | None,
    horizon: Horizon,
    camera: Camera,
    hints: Hints,
    doubted: float = 0.0,
    moon: Point | None = None,
    fit: SkyFit | None = None,
) -> tuple[str, ...]:
    """Return one sentence for each doubt.

    ``sky`` is the matte at working size, ``doubted`` the share of the picture that was dropped
    from the sky as unlikely (plausible.py), ``moon`` where one was found, in fractions of the
    picture, ``fit`` what was fitted to the sky.
    """
    notes = []
    share = float(np.mean(sky > 0.5))
    if share < NO_SKY and doubted > NO_SKY:
        notes.append(
            f"No sky found in {photo.name}: what looked a little like it ({100 * doubted:.0f} % of "
            "pixels) is rather a wall or ceiling. If it is sky, draw a sky stroke or pass "
            "sky='network', which is not doubted."
        )
    elif doubted > NO_SKY:
        notes.append(
            f"A patch of {photo.name} that looks like sky ({100 * doubted:.1f} % of pixels) was "
            "left out as unlikely. Draw a sky stroke over it if it is sky."
        )
    elif share < NO_SKY:
        notes.append(
            f"No sky found in {photo.name} ({100 * share:.1f} % of pixels). "
            "Draw a sky stroke or pass sky=mask."
        )
    if sun is None and moon is not None:
        notes.append(
            f"The disc at ({moon[0] * photo.width:.0f}, {moon[1] * photo.height:.0f}) of "
            f"{photo.name} is taken for the moon, as the sky round it is dark; it lights "
            "the picture. If it is the sun, click it or pass sun=(x, y)."
        )
    elif sun is None:
        notes.append(
            f"No sun found in {photo.name}. Its place is assumed{_sure(fit)}; click where it is, "
            "or pass sun=(x, y) in pixels (outside the picture is fine)."
        )
    elif sun.kind == "moon":
        notes.append(
            f"What was pointed at as the sun of {photo.name} stands in a night sky and may be the "
            "moon. It is treated as a sun; if it is none, take the hint back."
        )
    elif sun.visible:
        true = camera.focal * np.tan(np.radians(sun_stage.RADIUS_DEG))
        covered = float(sun.blot.mean())
        if covered > 0.02 and covered * camera.width * camera.height > 60 * np.pi * true**2:
            notes.append(
                f"The sun's mask covers {100 * covered:.0f} % of {photo.name}, "
                "far more than a sun. Click on its centre, or pass sun_method='disc_fit'."
            )
    sureness = None if fit is None else fit.atmosphere.confidence
    if share >= NO_SKY and sureness is not None and sureness < UNSURE:
        first = "Click the sun" if sun is None else "Check the sun"
        notes.append(
            f"How the sky of {photo.name} changes with the sun is a guess "
            f"({100 * sureness:.0f} % sure): it shows too little clear sky, or one that no "
            f"atmosphere explains. {first} and the horizon, then set the haze by hand."
        )
    if horizon.confidence < 0.3:
        notes.append(
            f"The horizon of {photo.name} is a guess (row {horizon.row:.0f}). "
            "Drag it, or pass horizon=row."
        )
    elif horizon.confidence < 0.5 or _sky_below(sky, horizon, camera):
        # Thesis 5.1 and its figure: the sky is then drawn too far down, as in a sunset.
        notes.append(
            f"The horizon of {photo.name} (row {horizon.row:.0f}) may be the edge of a roof or "
            "hill, which lies too high and makes the light that of a lower sun. Drag it down if "
            "so, or pass horizon=row."
        )
    if hints.fov is None and photo.field_of_view.source == "assumed":
        if camera.fov_vertical_deg != photo.field_of_view.vertical:
            told = f"by the size of the sun's disc it is {camera.fov_vertical_deg:.1f}°"
            notes.append(
                f"{photo.name} names no focal length: {told}, vertically. Pass fov= in degrees if "
                "the lens is known."
            )
            return tuple(notes)
        notes.append(
            f"{photo.name} names no focal length: {camera.fov_vertical_deg:.0f}° vertical field "
            "of view is assumed. Pass fov= in degrees."
        )
    return tuple(notes)


def _sure(fit: SkyFit | None) -> str:
    return "" if fit is None else f" ({100 * fit.sun_confidence:.0f} % sure)"


def _sky_below(sky: np.ndarray, horizon: Horizon, camera: Camera) -> bool:
    """Whether the sky reaches below the horizon by 3 % of the height in a tenth of the columns."""
    if horizon.source == "hint" or not 0 < horizon.row < camera.height:
        return False
    height, width = sky.shape
    slope = np.tan(np.radians(horizon.roll))
    columns = (np.arange(width) + 0.5) * camera.width / width - camera.width / 2
    line = (horizon.row + slope * columns) * height / camera.height
    below = (np.arange(height)[:, None] > line + 0.03 * height) & (sky > 0.5)
    return float(below.any(axis=0).mean()) > 0.1
