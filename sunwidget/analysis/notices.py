"""Notices for the user about an analysis; each says what to do."""

from __future__ import annotations

from typing import Self

import numpy as np

from sunwidget.analysis.fit.confidence import UNKNOWN
from sunwidget.analysis.fit.fit import SkyFit
from sunwidget.analysis.hints import Hints
from sunwidget.analysis.horizon.horizon import Horizon
from sunwidget.analysis.sun.sun import SunObservation
from sunwidget.atmosphere.constants import SUN_ANGULAR_RADIUS_DEG
from sunwidget.geometry.camera import Camera, Point
from sunwidget.photo.photo import Photo

UNSURE = 0.3  # confidence of the fit below which the user gets a notice
NO_SKY = 0.005  # share of the picture below which the photo counts as without sky


class Notice(str):
    """A notice for Python users: a text that also names its subject.

    Parameters
    ----------
    text : str
    about : str
        Subject, by which front ends choose the remedy that they offer, e.g. "horizon".
    plain : str
        The text for an editor, which has tools instead of arguments.
    flags : str
        The text for the command line.
    """

    __slots__ = ("about", "flags", "plain")
    about: str
    plain: str
    flags: str

    def __new__(cls, text: str, about: str = "", plain: str = "", flags: str = "") -> Self:
        """Make a notice; ``plain`` and ``flags`` default to ``text``."""
        notice = super().__new__(cls, text)
        notice.about, notice.plain, notice.flags = about, plain or text, flags or text
        return notice


def _notice(fact: str, advice: str, about: str, plain: str, flags: str) -> Notice:
    """Return a notice of one fact with advice for Python and for the command line."""
    return Notice(f"{fact} {advice}", about, plain, f"{fact} {flags}")


def notices(
    photo: Photo,
    sky: np.ndarray,
    sun: SunObservation | None,
    horizon: Horizon,
    camera: Camera,
    hints: Hints,
    moon: Point | None = None,
    fit: SkyFit | None = None,
) -> tuple[Notice, ...]:
    """Return a notice for each uncertain result.

    ``sky`` is the matte at working size, ``moon`` the position of a detected moon in fractions of
    the picture, ``fit`` the fit to the sky.
    """
    share = float(np.mean(sky > 0.5))
    notes = [
        _about_sky(photo, share),
        _about_sun(photo, sun, camera, hints, moon, fit),
        _about_air(photo, share, sun, fit),
        _about_horizon(photo, sky, horizon, camera),
    ]
    if hints.fov is None and photo.field_of_view.source == "assumed":
        degrees = f"{camera.fov_vertical_deg:.3g}°"
        assumed = camera.fov_vertical_deg == photo.field_of_view.vertical
        how = "is assumed" if assumed else "follows from the size of the sun's disc"
        notes.append(
            _notice(
                f"{photo.name} has no focal length: a vertical field of view of {degrees} {how}.",
                "Pass fov= in degrees.",
                "field_of_view",
                f"The photo has no focal length: a field of view of {degrees} from top to bottom "
                f"{how}.",
                "Pass --fov DEG.",
            )
        )
    return tuple(note for note in notes if note is not None)


def _about_sky(photo: Photo, share: float) -> Notice | None:
    if share < NO_SKY:
        return _notice(
            f"No sky found in {photo.name} ({100 * share:.1f} % of pixels): its light is "
            "unknown, so the whole picture changes evenly, and only a little.",
            "Draw a sky stroke or pass sky=mask.",
            "sky",
            "No sky was found, so the light of the picture is unknown: the whole picture changes "
            "evenly, and only a little. If there is some sky, paint over it.",
            "If there is some sky, pass a mask: --sky MASK.png.",
        )
    return None


def _about_sun(
    photo: Photo,
    sun: SunObservation | None,
    camera: Camera,
    hints: Hints,
    moon: Point | None,
    fit: SkyFit | None,
) -> Notice | None:
    if sun is None:
        return _about_unseen_sun(photo, hints, moon, fit)
    if sun.kind == "moon":
        return _notice(
            f"The point marked as the sun of {photo.name} lies in a night sky and may be the "
            "moon. It is treated as the sun;",
            "if it is the moon, clear the hint.",
            "night_sun",
            "The point marked as the sun lies in a night sky and may be the moon. It is "
            "treated as the sun.",
            "if it is the moon, omit --sun.",
        )
    if sun.visible:
        true = camera.focal * np.tan(np.radians(SUN_ANGULAR_RADIUS_DEG))
        covered = float(sun.blot.mean())
        if covered > 0.02 and covered * camera.width * camera.height > 60 * np.pi * true**2:
            return _notice(
                f"The sun's mask covers {100 * covered:.0f} % of {photo.name}, "
                "far more than a sun.",
                "Click the sun's center, or pass sun_method='disc_fit'.",
                "sun_mask",
                f"The area detected as the sun covers {100 * covered:.0f} % of the picture, far "
                "more than a sun. Click the sun's center.",
                "Pass its center, --sun X,Y, or --sun-method disc_fit.",
            )
    return None


def _about_unseen_sun(photo: Photo, hints: Hints, moon: Point | None, fit: SkyFit | None) -> Notice:
    if moon is not None:
        return _notice(
            f"The disc at ({moon[0] * photo.width:.0f}, {moon[1] * photo.height:.0f}) of "
            f"{photo.name} is treated as the moon, since the sky around it is dark; it lights "
            "the picture.",
            "If it is the sun, click it or pass sun=(x, y).",
            "moon",
            "The bright disc is treated as the moon, since the sky around it is dark; it lights "
            "the picture.",
            "If it is the sun, pass --sun X,Y.",
        )
    if hints.sun_outside:
        fact = f"According to the hint, the sun is not in {photo.name}{_unknown(fit)}. Its "
        fact += f"position is assumed{_within(fit)};"
        known = "in pixels if you know it (outside the picture is fine)."
        text = f"{fact} pass sun=(x, y) {known}"
        return Notice(text, "told_outside", text, f"{fact} pass --sun X,Y {known}")
    fact = f"No sun found in {photo.name}{_unknown(fit)}. Its position is assumed{_within(fit)};"
    pixels = "in pixels (outside the picture is fine)."
    text = f"{fact} click the sun, or pass sun=(x, y) {pixels}"
    return Notice(text, "unseen_sun", text, f"{fact} pass --sun X,Y {pixels}")


def _about_air(
    photo: Photo, share: float, sun: SunObservation | None, fit: SkyFit | None
) -> Notice | None:
    confidence = None if fit is None else fit.atmosphere.confidence
    if share < NO_SKY or confidence is None or confidence >= UNSURE:
        return None
    first = "Click the sun" if sun is None else "Check the sun"
    why = "too little clear sky is visible, or no modeled atmosphere matches it"
    return _notice(
        f"How the sky of {photo.name} changes with the sun is a guess: {why}.",
        f"{first} and the horizon, then set the haze by hand.",
        "air",
        f"How this sky changes with the sun is a guess: {why}. Check the sun and the horizon, "
        "then set the haze by hand.",
        "Pass --sun X,Y and --horizon ROW, then set the haze: --aerosol-optical-depth N.",
    )


def _about_horizon(
    photo: Photo, sky: np.ndarray, horizon: Horizon, camera: Camera
) -> Notice | None:
    if horizon.confidence < 0.3:
        return _notice(
            f"The horizon of {photo.name} is a guess (row {horizon.row:.0f}).",
            "Drag it, or pass horizon=row.",
            "horizon",
            "The horizon is a guess. Drag it to its true position.",
            "Pass --horizon ROW.",
        )
    if horizon.confidence < 0.5 or _sky_below(sky, horizon, camera):
        # Thesis 5.1 and its figure: the sky is then drawn too far down, as in a sunset.
        return _notice(
            f"The horizon of {photo.name} (row {horizon.row:.0f}) may be the edge of a roof or "
            "hill. That is too high, and gives the light of a lower sun.",
            "If so, drag it down, or pass horizon=row.",
            "horizon",
            "The horizon may be the edge of a roof or hill. That is too high, and gives the light "
            "of a lower sun. If so, drag it down.",
            "If so, pass --horizon ROW, a row further down.",
        )
    return None


def _unknown(fit: SkyFit | None) -> str:
    unknown = fit is not None and fit.sun_spread >= UNKNOWN
    return ", and the photo does not show where it is" if unknown else ""


def _within(fit: SkyFit | None) -> str:
    if fit is None or fit.sun_spread >= UNKNOWN:
        return ""
    return f" (within {fit.sun_spread:.0f}°, with 80 % probability)"


def _sky_below(sky: np.ndarray, horizon: Horizon, camera: Camera) -> bool:
    """Return whether in a tenth of the columns the sky is 3 % of the height below the horizon."""
    if horizon.source == "hint" or not 0 < horizon.row < camera.height:
        return False
    height, width = sky.shape
    slope = np.tan(np.radians(horizon.roll))
    columns = (np.arange(width) + 0.5) * camera.width / width - camera.width / 2
    line = (horizon.row + slope * columns) * height / camera.height
    below = (np.arange(height)[:, None] > line + 0.03 * height) & (sky > 0.5)
    return float(below.any(axis=0).mean()) > 0.1
