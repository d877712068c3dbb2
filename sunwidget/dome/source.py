"""Analysis of an environment map into a Dome: ``sunwidget.analyze_dome``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.analysis.fit.fit import SkyFit
from sunwidget.analysis.segmentation.coarse_sky import mask_from
from sunwidget.dome.air import closedness, fit_air, hidden_sun, sunlight
from sunwidget.dome.sky import find_sky
from sunwidget.dome.sphere import angles, solid_angles
from sunwidget.dome.sun import FoundSun, find_disc
from sunwidget.edit.table import OUTSIDE
from sunwidget.errors import AnalysisError, PhotoError
from sunwidget.formats.color import LUMINANCE
from sunwidget.photo.photo import Photo, open_photo

if TYPE_CHECKING:
    from sunwidget.edit.table import SunHint

Floats = NDArray[np.float32]

_WIDEST = 1024  # width in pixels of the analyzed copy
_LEAST_SKY = 0.2  # share of the upper half that must be sky
_SURE = 0.9  # mask value from which a pixel counts as sky
_CUT_OFF = 0.35  # share of a clear sun's light; a disc with less is clipped or veiled
_MOST = 2.5  # highest ratio of the sun's light to the clear model's
_TINT = 1.6  # highest ratio of one channel's gain to the mean
_HALF = 0.5


@dataclass(frozen=True, eq=False)
class Dome:
    """An environment map whose sun can be moved; the result of ``analyze_dome``.

    Parameters
    ----------
    photo : Photo
        The opened map, twice as wide as high.
    sky : (H, W) float32
        Share of sky in a pixel, [0, 1]; 0 below the horizon, which is the middle row.
    fit : SkyFit
        The air that fits the sky, and the map's light per kcd m⁻² of the model.
    sun : (azimuth, elevation)
        Degrees; azimuth from the middle column, to the right.
    sun_kind : {"disc", "veiled", "clipped", "hidden"}
        "disc": found, with its light. "veiled": found behind clouds. "clipped": found, but the map
        clips its light; the model's is used. "hidden": not visible; the position is a guess from
        the sky's glow and colors, unless a hint gives it.
    direct : (3,)
        Illuminance by the sun on a plane facing it, in the map's unit times sr.
    sun_gain : (3,)
        The map's light per klx of the model's sun, by channel: measured, or gray with the
        luminance of the sky's gain.
    closed : float
        How overcast the sky is, [0, 1].
    sun_confidence, sun_spread : float
        As in a Scene; 1 and 0 for a disc.
    warnings : tuple of str
        Doubts about the analysis.
    """

    photo: Photo
    sky: Floats
    fit: SkyFit
    sun: tuple[float, float]
    sun_kind: str
    direct: NDArray[np.float64]
    sun_gain: NDArray[np.float64]
    closed: float
    sun_confidence: float
    sun_spread: float
    warnings: tuple[str, ...]

    def __repr__(self) -> str:
        width, height = self.photo.size
        azimuth, elevation = self.sun
        return (
            f"<Dome {self.photo.name!r} {width}×{height}, {self.sun_kind} sun at "
            f"{azimuth:.1f}°, {elevation:.1f}°>"
        )


def is_dome(photo: Photo) -> bool:
    """Return whether a photo may be an environment map: linear light, twice as wide as high."""
    return photo.encoded.dtype.kind == "f" and photo.width == 2 * photo.height


def analyze_dome(source: Any, *, sun: SunHint | None = None, sky: Any = None) -> Dome:
    """Find sky, sun and air in an environment map (HDRI) of an outdoor place.

    Parameters
    ----------
    source : Photo or anything that ``sunwidget.open`` takes
        Equirectangular linear light, twice as wide as high, horizon in the middle row: ``.hdr``,
        ``.exr`` or an array (H, 2 H, 3) of floats, in any unit.
    sun : (x, y) or "outside", optional
        Position of the sun in pixels. A disc within 3° of it is used, otherwise the position
        itself. "outside": no disc is visible. Default: found automatically.
    sky : mask (H, W) or path of its picture, optional
        White where there is sky. Default: found by the network in twelve views.

    Returns
    -------
    Dome
        Input for ``sunwidget.to_dome``.

    Raises
    ------
    PhotoError
        When the source is not an environment map.
    AnalysisError
        When less than a fifth of the upper half is sky (a room, a forest), or a hint is wrong.
    """
    photo = open_photo(source)
    if not is_dome(photo):
        kind = "" if photo.encoded.dtype.kind == "f" else " of 8- or 16-bit code values"
        raise PhotoError(
            f"{photo.name} is not an environment map: expected linear light (.hdr, .exr, floats), "
            f"twice as wide as high, not a picture{kind} of {photo.width} × {photo.height} pixels. "
            "For a photo, pass the result of sw.analyze to to_dome."
        )
    light = plain_light(photo.light())
    mask = _find_sky(light, sky, photo)
    small, small_sky = _shrink(light, mask)
    found, hinted = _find_sun(small, small_sky, sun, photo)
    return _make_dome(photo, mask, small, small_sky, found, hinted)


def plain_light(light: NDArray[Any]) -> Floats:
    """Return light with negative values and NaN replaced by 0."""
    return np.maximum(np.nan_to_num(np.asarray(light, np.float32), posinf=3e38), 0)


def _find_sky(light: Floats, sky: Any, photo: Photo) -> Floats:
    from sunwidget.analysis.images.working_copy import resize

    if sky is None:
        mask = find_sky(light)
    else:
        if isinstance(sky, str) or hasattr(sky, "__fspath__"):
            sky = open_photo(sky).encoded[..., 1]
        mask = np.asarray(mask_from(sky, photo.size), np.float32)
        mask = resize(mask, photo.width, photo.height).copy()
        mask[photo.height // 2 :] = 0
    upper = slice(0, photo.height // 2)
    solid = np.broadcast_to(solid_angles(photo.width), mask.shape)[upper]
    share = float(solid[mask[upper] > _SURE].sum()) / (2 * np.pi)
    least = _LEAST_SKY if sky is None else 1e-3
    if share < least:
        raise AnalysisError(
            f"No sky found in {photo.name} ({100 * share:.0f} % of its upper half); a dome needs "
            "open sky. If there is sky, pass sky=mask (--sky MASK.png), white where it is."
        )
    return mask


def _shrink(light: Floats, sky: Floats) -> tuple[Floats, Floats]:
    from sunwidget.analysis.images.working_copy import resize

    width = min(light.shape[1], _WIDEST)
    width -= width % 4
    return tuple(np.asarray(resize(part, width, width // 2)) for part in (light, sky))  # type: ignore[return-value]


def _find_sun(
    light: Floats, sky: Floats, hint: SunHint | None, photo: Photo
) -> tuple[FoundSun | None, tuple[float, float] | None]:
    """Return the disc if one is found, or the hinted position if it shows no disc."""
    if hint is None or hint == OUTSIDE:
        found = find_disc(light, sky) if hint is None else None
        return (found if found is not None and found.stands_out else None), None
    try:
        x, y = (float(value) for value in hint)
    except (TypeError, ValueError):
        x = y = np.nan
    if not (0 <= x <= photo.width and 0 <= y <= photo.height):
        raise AnalysisError(
            f"sun={hint!r:.80} is not a position in {photo.name}. Pass two numbers, 0 to "
            f"{photo.width} and 0 to {photo.height} pixels, or {OUTSIDE!r}."
        )
    place = (x / photo.width - 0.5) * 360, 90 - y / photo.height * 180
    found = find_disc(light, sky, near=place)
    return (found, None) if found.stands_out else (None, place)


def _make_dome(
    photo: Photo,
    mask: Floats,
    light: Floats,
    sky: Floats,
    found: FoundSun | None,
    hinted: tuple[float, float] | None,
) -> Dome:
    closed = closedness(light, sky)
    sure, spread, warnings = 1.0, 0.0, []
    if found is not None:
        sun = (found.azimuth, found.elevation)
    elif hinted is not None:
        sun = hinted
    else:
        sun, sure, spread = hidden_sun(light, sky, closed)
        warnings.append(
            f"No sun's disc stands out in {photo.name}: azimuth {sun[0]:.0f}° and elevation "
            f"{sun[1]:.0f}° are a guess. Set its position with sun=(x, y) (--sun X,Y), in pixels."
        )
    known = found is not None and not found.clipped
    measured = found.illuminance if found is not None and known else None
    fit = fit_air(light, sky, sun, measured, closed)
    kind, direct, gain = _measure_sun(found, fit, closed)
    if kind == "clipped":
        share = float(found.illuminance @ LUMINANCE / (direct @ LUMINANCE)) if found else 0.0
        warnings.append(
            f"{photo.name} contains {100 * share:.0f} % of the light of a clear sun; the rest was "
            "clipped or hidden. The moved sun has the model's light."
        )
    return Dome(photo, mask, fit, sun, kind, direct, gain, closed, sure, spread, tuple(warnings))


def _measure_sun(
    found: FoundSun | None, fit: SkyFit, closed: float
) -> tuple[str, NDArray[np.float64], NDArray[np.float64]]:
    """Return the sun's kind, its illuminance, and its light per klx of the model's."""
    gray = np.full(3, float(np.array(fit.gain) @ LUMINANCE))
    clear = sunlight(fit.atmosphere, fit.sun[1])
    if found is None:
        return "hidden", np.zeros(3), gray
    if closed > _HALF:
        return "veiled", found.illuminance, gray
    level = float(found.illuminance @ LUMINANCE) / max(float(clear @ LUMINANCE), 1e-30)
    if (found.clipped or level < _CUT_OFF * gray[0]) and level < gray[0]:
        return "clipped", gray * clear, gray
    level = min(level, _MOST * gray[0])
    gain = found.illuminance / np.maximum(clear, 1e-30)
    # White balance and the model's red have errors; the true tint is smaller than that limit.
    return "disc", found.illuminance, np.clip(gain, level / _TINT, level * _TINT)


def sky_share(dome: Dome) -> float:
    """Return the share of the upper half-sphere that is sky."""
    width = dome.photo.width
    weight = np.where(angles(width)[1] > 0, solid_angles(width), 0)
    return float((dome.sky * weight).sum()) / (2 * np.pi)
