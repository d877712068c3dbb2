"""From an environment map to its Dome: ``sunwidget.analyze_dome``."""

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

_WIDEST = 1024  # pixels of the copy that is looked at
_LEAST_SKY = 0.2  # of the upper half that must be sky for sure
_SURE = 0.9
_CUT_OFF = 0.35  # of the light of a clear sun: a disc with less is clipped or veiled
_MOST = 2.5
_TINT = 1.6
_HALF = 0.5


@dataclass(frozen=True, eq=False)
class Dome:
    """An environment map whose sun can be moved. Made by ``analyze_dome``.

    Parameters
    ----------
    photo : Photo
        The map as it was opened, twice as wide as high.
    sky : (H, W) float32
        How much of a pixel is sky, [0, 1]; 0 below the horizon, which is the middle row.
    fit : SkyFit
        The air that explains the sky, and the map's light per kcd m⁻² of the model.
    sun : (azimuth, elevation)
        Degrees; azimuth from the middle column, to the right.
    sun_kind : {"disc", "veiled", "clipped", "hidden"}
        "disc": found with its light. "veiled": found behind clouds. "clipped": found, but the map
        holds no light as high as its own, which is the model's then. "hidden": not seen; where it
        stands is a guess by the sky's glow and colours, unless it was told.
    direct : (3,)
        Illuminance by the sun on a plane that faces it, in the map's unit times sr.
    sun_gain : (3,)
        The map's light per klx of the model's sun, by channel: measured, or as grey as that of the
        sky is in all.
    closed : float
        How far the sky is closed by clouds, [0, 1].
    sun_confidence, sun_spread : float
        As those of a Scene: 1 and 0 of a disc.
    warnings : tuple of str
        What is doubtful.
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
    """Tell a picture that may be an environment map: linear light, twice as wide as high."""
    return photo.encoded.dtype.kind == "f" and photo.width == 2 * photo.height


def analyze_dome(source: Any, *, sun: SunHint | None = None, sky: Any = None) -> Dome:
    """Find sky, sun and air in an environment map (HDRI) of an outdoor place.

    Parameters
    ----------
    source : Photo or anything that ``sunwidget.open`` takes
        Equirectangular linear light, twice as wide as high, horizon in the middle row: ``.hdr``,
        ``.exr`` or an array (H, 2 H, 3) of floats, in any unit.
    sun : (x, y) or "outside", optional
        Where its sun is, in pixels: the disc within 3° of it is taken, else the place itself.
        "outside": no disc is to be seen. Default: looked for.
    sky : mask (H, W) or path of its picture, optional
        White where there is sky; default: found by the network in twelve views.

    Returns
    -------
    Dome
        For ``sunwidget.to_dome``.

    Raises
    ------
    PhotoError
        For what is no environment map.
    AnalysisError
        When less than a fifth of the upper half is sky (a room, a wood), or a hint is wrong.
    """
    photo = open_photo(source)
    if not is_dome(photo):
        kind = "" if photo.encoded.dtype.kind == "f" else " of 8- or 16-bit code values"
        raise PhotoError(
            f"{photo.name} is not an environment map: that is linear light (.hdr, .exr, floats), "
            f"twice as wide as high, and this is a picture{kind} of {photo.width} × {photo.height} "
            "pixels. Of a photo, sw.analyze makes what to_dome takes."
        )
    light = plain_light(photo.light())
    mask = _sky_of(light, sky, photo)
    small, small_sky = _shrunk(light, mask)
    found, told = _sun_of(small, small_sky, sun, photo)
    return _understood(photo, mask, small, small_sky, found, told)


def plain_light(light: NDArray[Any]) -> Floats:
    """Return light without what is negative or no number."""
    return np.maximum(np.nan_to_num(np.asarray(light, np.float32), posinf=3e38), 0)


def _sky_of(light: Floats, sky: Any, photo: Photo) -> Floats:
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
            f"No sky found in {photo.name} ({100 * share:.0f} % of its upper half): the sun of a "
            "room is not moved. If there is sky, pass sky=mask (--sky MASK.png), white where it is."
        )
    return mask


def _shrunk(light: Floats, sky: Floats) -> tuple[Floats, Floats]:
    from sunwidget.analysis.images.working_copy import resize

    width = min(light.shape[1], _WIDEST)
    width -= width % 4
    return tuple(np.asarray(resize(part, width, width // 2)) for part in (light, sky))  # type: ignore[return-value]


def _sun_of(
    light: Floats, sky: Floats, hint: SunHint | None, photo: Photo
) -> tuple[FoundSun | None, tuple[float, float] | None]:
    """Return the disc that is found, and the place that was told and shows none."""
    if hint is None or hint == OUTSIDE:
        found = find_disc(light, sky) if hint is None else None
        return (found if found is not None and found.stands_out else None), None
    try:
        x, y = (float(value) for value in hint)
    except (TypeError, ValueError):
        x = y = np.nan
    if not (0 <= x <= photo.width and 0 <= y <= photo.height):
        raise AnalysisError(
            f"sun={hint!r:.80} is not a place in {photo.name}: two numbers, 0 to {photo.width} and "
            f"0 to {photo.height} pixels, or {OUTSIDE!r}."
        )
    place = (x / photo.width - 0.5) * 360, 90 - y / photo.height * 180
    found = find_disc(light, sky, near=place)
    return (found, None) if found.stands_out else (None, place)


def _understood(
    photo: Photo,
    mask: Floats,
    light: Floats,
    sky: Floats,
    found: FoundSun | None,
    told: tuple[float, float] | None,
) -> Dome:
    closed = closedness(light, sky)
    sure, spread, warnings = 1.0, 0.0, []
    if found is not None:
        sun = (found.azimuth, found.elevation)
    elif told is not None:
        sun = told
    else:
        sun, sure, spread = hidden_sun(light, sky, closed)
        warnings.append(
            f"No sun's disc stands out in {photo.name}: azimuth {sun[0]:.0f}° and elevation "
            f"{sun[1]:.0f}° are a guess. Tell where it is with sun=(x, y) (--sun X,Y), in pixels."
        )
    known = found is not None and not found.clipped
    measured = found.illuminance if found is not None and known else None
    fit = fit_air(light, sky, sun, measured, closed)
    kind, direct, gain = _light_of(found, fit, closed)
    if kind == "clipped":
        share = float(found.illuminance @ LUMINANCE / (direct @ LUMINANCE)) if found else 0.0
        warnings.append(
            f"{photo.name} holds {100 * share:.0f} % of the light of a clear sun: the rest was "
            "cut off or hidden. The moved sun has the model's light."
        )
    return Dome(photo, mask, fit, sun, kind, direct, gain, closed, sure, spread, tuple(warnings))


def _light_of(
    found: FoundSun | None, fit: SkyFit, closed: float
) -> tuple[str, NDArray[np.float64], NDArray[np.float64]]:
    """Return the sun's kind, its illuminance, and its light per klx of the model's."""
    grey = np.full(3, float(np.array(fit.gain) @ LUMINANCE))
    clear = sunlight(fit.atmosphere, fit.sun[1])
    if found is None:
        return "hidden", np.zeros(3), grey
    if closed > _HALF:
        return "veiled", found.illuminance, grey
    level = float(found.illuminance @ LUMINANCE) / max(float(clear @ LUMINANCE), 1e-30)
    if (found.clipped or level < _CUT_OFF * grey[0]) and level < grey[0]:
        return "clipped", grey * clear, grey
    level = min(level, _MOST * grey[0])
    gain = found.illuminance / np.maximum(clear, 1e-30)
    # A lens' white and the model's red err: colours differ by less than that.
    return "disc", found.illuminance, np.clip(gain, level / _TINT, level * _TINT)


def sky_share(dome: Dome) -> float:
    """Return the share of the upper half-sphere that is sky."""
    width = dome.photo.width
    weight = np.where(angles(width)[1] > 0, solid_angles(width), 0)
    return float((dome.sky * weight).sum()) / (2 * np.pi)
