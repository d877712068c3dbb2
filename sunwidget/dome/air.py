"""The air of an environment map: the sky model for photos, fitted to linear light."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.analysis.clouds.clouds import ratio_index
from sunwidget.analysis.clouds.unmix import cloud_white, unmix
from sunwidget.analysis.fit.confidence import HEIGHTS, TURNS, nowhere
from sunwidget.analysis.fit.fit import Response, SkyFit, airs_to_try, compare, model_sky, search_sun
from sunwidget.analysis.images.working_copy import encode, smoothstep
from sunwidget.atmosphere.color import spectral_to_rec709
from sunwidget.atmosphere.optics import direct_irradiance
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.dome.sphere import distance, sample
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.place import wrap_angle

Floats = NDArray[np.float32]

_SAMPLES = 700  # directions over the sphere
_LOWEST = 2.0  # degrees of elevation
_BESIDE_THE_SUN = 8.0  # degrees; nearer to the sun, lens glare and bright clouds are excluded
_BRIGHT, _SHOWN = 0.9, 0.7  # quantile of the sky's light, and the display light that it maps to
_CLEAR = 0.25  # highest opacity of a clear sample
_FEW = 60  # least number of samples
_SUNLIT = 0.015  # error of an air whose sun differs from the measured one by a factor of 2
_GLOW = 5.0  # degrees over which the sky is smoothed to find its glow
_WHITE = (0.75, 0.9)  # encoded red over blue of clear sky and of cloud, in an overcast sky
_CLOSED = (0.5, 0.75)  # white share of the sky over which it becomes overcast
_USUAL = Atmosphere(
    aerosol_optical_depth=0.12, aerosol_asymmetry=0.76, angstrom_exponent=1.3, aerosol_albedo=0.9
)
_UNDER_CLOUD = 0.4  # light of an overcast sky over that of a white cloud in the sun
# Brightest over median light of an overcast sky, and the sun's elevation: from twelve rendered
# skies.
_GLOWS = (1.6, 2.2, 2.8), (35.0, 20.0, 5.0)
_UNSURE = 0.3, 60.0  # confidence and spread of that elevation
_HALF = 0.5
_ASIDE = 30.0  # degrees of azimuth within which the glow is preferred to the sky's colors


def sunlight(air: Atmosphere, elevation: float) -> NDArray[np.float64]:
    """Return the clear sun's illuminance (3,) on a plane facing it, klx; 0 below the horizon."""
    return np.maximum(spectral_to_rec709(direct_irradiance(air, elevation)).reshape(3), 0)


def fit_air(
    light: NDArray[Any],
    sky: NDArray[Any],
    sun: tuple[float, float],
    measured: NDArray[np.float64] | None,
    closed: float,
) -> SkyFit:
    """Fit the air to the clear sky and, if it is known, to the sun's light.

    ``measured`` is the sun's illuminance (3,), in the unit of ``light`` times sr. An overcast sky
    (``closed``) does not determine the air: it gets a typical one, scaled by its gaps or clouds.
    """
    azimuth, elevation = directions()
    if closed > _HALF:
        return _under_cloud(light, sky, sun)
    shown, scale, usable = _samples(light, sky, sun, azimuth, elevation)
    azimuth, elevation, shown = azimuth[usable], elevation[usable], shown[usable]
    clear = np.ones(len(shown), bool)
    fit = None
    for _ in range(2):
        where = azimuth[clear], elevation[clear]
        errors = []
        for air in airs_to_try():
            error, gain = compare(shown[clear], model_sky(air, *where, sun), Response())
            if measured is not None:
                expected = float(sunlight(air, sun[1]) * gain @ LUMINANCE) / scale
                apart = np.log2(max(float(measured @ LUMINANCE), 1e-12) / max(expected, 1e-12))
                error += _SUNLIT * min(abs(float(apart)), 2)
            errors.append((error, air, gain / scale))
        error, air, gain = min(errors, key=lambda found: found[0])
        fit = SkyFit(
            air.replace(residual=float(error)),
            Response(0.0, 1.0),
            (float(gain[0]), float(gain[1]), float(gain[2])),
            (0.0, 3.0, 2.0),
            sun,
        )
        seen = Response().scene_light(shown) / scale
        opacity = cloudiness(seen[:, None], fit, azimuth[:, None], elevation[:, None])[:, 0]
        clear = opacity < _CLEAR
        if clear.sum() < _FEW:
            break
    assert fit is not None
    return fit


def cloudiness(
    light: NDArray[Any],
    fit: SkyFit,
    azimuth: NDArray[Any],
    elevation: NDArray[Any],
    clear: NDArray[Any] | None = None,
) -> Floats:
    """Return the opacity (h, w) of clouds by unmixing."""
    model = fit.model(azimuth, np.maximum(elevation, 0.2)) if clear is None else clear
    found, _ = unmix(
        np.asarray(light, np.float32),
        np.asarray(model, np.float32),
        cloud_white(fit),
        np.ones(light.shape[:2], np.float32),
    )
    return found


def closedness(light: NDArray[Any], sky: NDArray[Any]) -> float:
    """Return how overcast a sky is, [0, 1]: 1 if it is white nearly everywhere."""
    shown, _, usable = _samples(light, sky, None, *directions())
    share = float(np.mean(whiteness(shown[usable]) > sum(_WHITE) / 2))
    return float(smoothstep(*_CLOSED, share))


def whiteness(shown: NDArray[Any]) -> NDArray[Any]:
    """Return red over blue (…) of display light (…, 3), encoded."""
    return ratio_index(encode(np.clip(shown, 0, 1)))


def white_opacity(light: NDArray[Any], sky: NDArray[Any]) -> Floats:
    """Return the opacity (h, w) of an overcast sky's clouds, from their whiteness."""
    level = light @ LUMINANCE
    inside = sky > 0.5
    scale = _SHOWN / max(float(np.quantile(level[inside], _BRIGHT)) if inside.any() else 1, 1e-12)
    white = whiteness(Response().display_light(np.asarray(light, np.float64) * scale))
    return np.asarray(smoothstep(*_WHITE, white) * sky, np.float32)


def _under_cloud(light: NDArray[Any], sky: NDArray[Any], sun: tuple[float, float]) -> SkyFit:
    azimuth, elevation = directions()
    shown, scale, usable = _samples(light, sky, sun, azimuth, elevation)
    gap = usable & (whiteness(shown) < _WHITE[0])
    seen = Response().scene_light(shown) / scale
    plain = SkyFit(_USUAL, Response(0.0, 1.0), (1.0, 1.0, 1.0), (0.0, 3.0, 2.0), sun)
    if gap.sum() >= _FEW:
        model = model_sky(_USUAL, azimuth[gap], elevation[gap], sun)
        level = float(np.median((seen[gap] @ LUMINANCE) / (model @ LUMINANCE)))
    else:
        cloud = _UNDER_CLOUD * float(cloud_white(plain) @ LUMINANCE)
        level = float(np.median(seen[usable] @ LUMINANCE)) / cloud
    return dataclasses.replace(plain, gain=(level, level, level))


def hidden_sun(
    light: NDArray[Any], sky: NDArray[Any], closed: float
) -> tuple[tuple[float, float], float, float]:
    """Return the likely position of a sun without a disc, its confidence and its spread.

    The azimuth follows from the sky's glow; in an open sky the elevation follows from its colors,
    as in a photo.
    """
    import cv2

    from sunwidget.analysis.images.working_copy import resize

    small = resize(np.asarray(light, np.float32), 360, 180)
    known = (resize(np.asarray(sky, np.float32), 360, 180) > 0.5).astype(np.float32)
    level = (small @ LUMINANCE).astype(np.float32) * known
    glow = cv2.GaussianBlur(level, (0, 0), _GLOW) / np.maximum(
        cv2.GaussianBlur(known, (0, 0), _GLOW), 0.2
    )
    row, column = np.unravel_index(int(np.argmax(glow[:90])), (90, 360))
    at = column + 0.5 - 180.0, 89.5 - row
    if closed > _HALF:
        shown, _, usable = _samples(light, sky, None, *directions())
        level = shown[usable] @ LUMINANCE
        height = float(np.interp(level.max() / np.median(level), *_GLOWS))
        return (float(at[0]), height), *_UNSURE
    turns, heights = np.meshgrid(TURNS, HEIGHTS)
    bright = sample(np.asarray(glow, np.float32), turns, np.maximum(heights, 4.0))
    expected = np.square(bright / max(float(bright.max()), 1e-12)) + 1e-3
    azimuth, elevation = directions()
    shown, _, usable = _samples(light, sky, None, azimuth, elevation)
    where = azimuth[usable], elevation[usable]
    best, sure, spread = search_sun(shown[usable], where, expected, nowhere, lambda _share: None)
    aside = abs(wrap_angle(best[0] - at[0]))
    return (float(at[0]) if aside < _ASIDE else best[0], best[1]), sure, spread


def directions(count: int = _SAMPLES) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return azimuths and elevations (n,) spread evenly over the sky (a golden spiral)."""
    index = np.arange(count) + 0.5
    elevation = np.degrees(np.arcsin(index / count))
    azimuth = (index * 137.50776405) % 360 - 180
    low = elevation > _LOWEST
    return np.asarray(azimuth[low]), np.asarray(elevation[low])


def _samples(
    light: NDArray[Any],
    sky: NDArray[Any],
    sun: tuple[float, float] | None,
    azimuth: NDArray[np.float64],
    elevation: NDArray[np.float64],
) -> tuple[NDArray[np.float64], float, NDArray[np.bool_]]:
    """Return display light (n, 3), its scale, and a mask of the directions that show sky."""
    from sunwidget.analysis.images.working_copy import resize

    small = resize(np.asarray(light, np.float32), 360, 180)
    mask = resize(np.asarray(sky, np.float32), 360, 180)
    seen = sample(small, azimuth, elevation).astype(float)
    usable = sample(mask, azimuth, elevation) > 0.95
    if sun is not None:
        usable &= distance(sun, azimuth, elevation) > _BESIDE_THE_SUN
    if not usable.any():
        usable = sample(mask, azimuth, elevation) > 0.5
    level = seen @ LUMINANCE
    scale = _SHOWN / max(float(np.quantile(level[usable], _BRIGHT)), 1e-12)
    shown = np.clip(Response().display_light(seen * scale), 1e-6, None)
    return np.asarray(shown, np.float64), scale, usable


def with_air(fit: SkyFit, air: Atmosphere, sun: tuple[float, float]) -> SkyFit:
    """Return the fit with other air and another sun, for the same camera."""
    return dataclasses.replace(fit, atmosphere=air, sun=sun)
