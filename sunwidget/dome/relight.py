"""Relighting an environment map under another sun, by the model's ratio of new to old.

Clear sky, clouds and land are multiplied by the ratio of the model's light for them under the two
suns. The old disc and the glare around it are removed, and a disc is drawn at the new position.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.analysis.fit.fit import SkyFit, model_sky
from sunwidget.analysis.images.fill import fill_by_pyramid
from sunwidget.analysis.images.working_copy import smoothstep
from sunwidget.dome.air import cloudiness, sunlight, white_opacity
from sunwidget.dome.disc import disc_with_illuminance
from sunwidget.dome.sphere import angles, distance, irradiance, toward

if TYPE_CHECKING:
    from sunwidget.dome.source import Dome

Floats = NDArray[np.float32]

_GLARE = (2.5, 7.0)  # degrees around the old sun that its disc, lens glare and aureole cover
_LOGS = 4.0  # limit of the logarithm of the sky's light over the model
_ROWS, _COLUMNS = 73, 97  # of the table that holds the model's sky
_LATE = 1.2  # degrees by which the horizon is lower for clouds
_BEYOND = (0.15, 0.7)  # share of the sky behind a cloud that passes through it, as in the frame
_WALLS = np.arange(-180.0, 181, 15)  # azimuths of upright surfaces
_RISE = (-4.0, 3.0)  # degrees of elevation over which land turns from level to upright
_SMALL = 256  # width of the maps that irradiance is computed from
_NEAR_DISC = 1.0  # degrees around the sun in which clouds and land hide it
_RATIO = (1e-6, 1e6)
_HALF = 0.5
_WHITEST = 0.6  # highest albedo of land
_VEILED = (10.0, 30.0)  # degrees from the sun over which lens glare in front of the ground fades
_RINGS = (4.0, 90.0)  # degrees from the sun
_STEPS = 16
_BETWEEN_CLOUDS = 0.4  # quantile
_LOW = 4.0  # degrees of elevation below which haze and hills would falsify the glow
_FEW = 40  # least pixels of a ring
_MOST_GLOW = 2.5  # logarithm
_MOST_HAZE = 0.7  # logarithm
_SETS = (-6.0, 0.0)  # degrees of elevation over which the glow fades


@dataclass(frozen=True)
class Relit:
    """The separate sky and sun of a moved dome, in the map's own unit.

    Parameters
    ----------
    sky : (H, W, 3) float32
        Radiance without the sun's disc, land included.
    disc : (H, W, 3) float32
        The disc alone.
    direct : (3,)
        Illuminance by the sun at right angles to it, by channel.
    direction : (azimuth, elevation)
        Direction of the sun, degrees.
    through : float
        Share of the sun's light that passes clouds, land and ``sun_visibility``.
    whole : (H, W, 3) float32
        Sky and disc together; for an unmoved dome exactly the source.
    """

    sky: Floats
    disc: Floats
    direct: NDArray[np.float64]
    direction: tuple[float, float]
    through: float
    whole: Floats


class SkyModel:
    """The model's sky under one sun in any direction, from a table over half of the sky."""

    def __init__(self, fit: SkyFit) -> None:
        self.sun = fit.sun
        heights = 90 * (np.arange(_ROWS) / (_ROWS - 1)) ** 2
        turns = 180 * (np.arange(_COLUMNS) / (_COLUMNS - 1)) ** 1.5
        light = model_sky(
            fit.atmosphere.replace(residual=None, confidence=None),
            *np.meshgrid(turns, heights),
            (0.0, fit.sun[1]),
        )
        self._table = np.log(np.maximum(light * np.array(fit.gain), 1e-30)).astype(np.float32)

    def __call__(self, azimuth: NDArray[Any], elevation: NDArray[Any]) -> Floats:
        """Return radiance (h, w, 3); below the horizon, that of the horizon."""
        import cv2

        turn = np.abs((azimuth - self.sun[0] + 180) % 360 - 180)
        x = (turn / 180) ** (2 / 3) * (_COLUMNS - 1)
        y = np.sqrt(np.clip(elevation, 0, 90) / 90) * (_ROWS - 1)
        at = x.astype(np.float32), y.astype(np.float32)
        found = cv2.remap(self._table, *at, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        return np.asarray(np.exp(found), np.float32)

    def level_irradiance(self) -> NDArray[np.float64]:
        """Return the sky's irradiance (3,) on level ground."""
        azimuth, elevation = angles(128)
        upper = self(azimuth, elevation) * (elevation > 0)[..., None]
        return np.asarray(irradiance(upper))


def relight(
    dome: Dome, air: SkyFit, sun_visibility: float = 1.0, *, light: Floats, sky: Floats
) -> Relit:
    """Return a dome's light under the sun and air of ``air``.

    ``light`` (H, W, 3) and ``sky`` (H, W) are the dome's, at the size of the result.
    """
    width = light.shape[1]
    azimuth, elevation = angles(width)
    upper = slice(0, width // 4)
    own = dome.fit
    before, now = SkyModel(own), SkyModel(air)
    above = azimuth[upper], elevation[upper]
    old, new = before(*above), now(*above)
    if dome.closed < _HALF:
        glow = _glow(light[upper], sky[upper], old, own.sun, *above)
        old, new = (
            model * np.exp(_sun_fade(fit.sun) * glow(distance(fit.sun, *above)))
            for model, fit in ((old, own), (new, air))
        )
    clean = without_sun(light[upper], sky[upper], old, dome.sun, *above)
    if dome.closed < _HALF:
        hazy = old * np.exp(_haze_band(clean, sky[upper], old))
        opacity = cloudiness(clean, own, *above, clear=hazy) * sky[upper]
    else:
        opacity = white_opacity(clean, sky[upper])
    cover = float((opacity * np.cos(np.radians(above[1]))).sum())
    cover /= max(float((sky[upper] * np.cos(np.radians(above[1]))).sum()), 1e-6)
    clouds = [
        _cloud_radiance(model, fit, cover, dome.sun_gain)
        for model, fit in ((before, own), (now, air))
    ]
    a = opacity[..., None]
    beyond = _BEYOND[0] + _BEYOND[1] * (1 - a)
    veiled = [
        (1 - a) * clear + a * (beyond * clear + (1 - beyond) * cloud)
        for clear, cloud in zip((old, new), clouds, strict=True)
    ]
    ratio = np.clip(veiled[1] / np.maximum(veiled[0], 1e-30), *_RATIO)
    through = sun_visibility * _unhidden_share(air.sun, opacity, sky, above)
    direct = dome.sun_gain * sunlight(air.atmosphere, air.sun[1]) * through
    source = light.astype(np.float32).copy()
    source[upper] = clean
    land = _land_light(source, sky, dome, (azimuth, elevation))
    lit = source - land
    lit[upper] *= ratio
    lit[width // 4 :] *= ratio[-1:]
    result = lit + land * _land_ratio(source, lit, land, dome.direct, direct, (own.sun, air.sun))
    disc = disc_with_illuminance(direct, air.atmosphere, air.sun, width)
    result = np.maximum(result, 0)
    return Relit(result, disc, direct, air.sun, through, result + disc)


def without_sun_of(dome: Dome, light: Floats, sky: Floats) -> Floats:
    """Return an unmoved map (H, W, 3) without its sun's disc and the glare around it."""
    azimuth, elevation = angles(light.shape[1])
    upper = slice(0, len(light) // 2)
    above = azimuth[upper], elevation[upper]
    result = light.copy()
    if dome.sun_kind != "hidden":
        old = SkyModel(dome.fit)(*above)
        result[upper] = without_sun(light[upper], sky[upper], old, dome.sun, *above)
    return result


def _glow(
    light: Floats,
    sky: Floats,
    model: Floats,
    sun: tuple[float, float],
    azimuth: NDArray[Any],
    elevation: NDArray[Any],
) -> Callable[[NDArray[Any]], NDArray[Any]]:
    """Return the glow: log of the sky over the model (…, 3), as a function of the sun's distance.

    The lobes of haze and lens glare, which the model lacks, move with the sun.
    """
    apart = distance(sun, azimuth, elevation)
    usable = (sky > 0.9) & (elevation > _LOW)
    share = _log_ratio(light, model)
    rings = np.geomspace(*_RINGS, _STEPS)
    found = np.full((_STEPS, 3), np.nan)
    for i, ring in enumerate(rings):
        inside = usable & (np.abs(np.log(apart / ring)) < np.log(rings[1] / rings[0]))
        if np.count_nonzero(inside) >= _FEW:
            # Below the median, since clouds are brighter than the sky behind them.
            found[i] = np.quantile(share[inside], _BETWEEN_CLOUDS, axis=0)
    known = np.isfinite(found[:, 0])
    if known.sum() < _STEPS // 2:
        return lambda angle: np.zeros((*np.shape(angle), 3))
    values = np.stack([np.interp(rings, rings[known], f) for f in found[known].T], axis=-1)
    values -= values[-1]
    for _ in range(2):
        values[1:-1] = values[:-2] / 4 + values[1:-1] / 2 + values[2:] / 4
    values = np.clip(values, -_MOST_GLOW, _MOST_GLOW)
    return lambda angle: np.stack([np.interp(angle, rings, v) for v in values.T], axis=-1)


def _log_ratio(light: Floats, model: Floats) -> NDArray[Any]:
    """Return the logarithm (…, 3) of light over the model's light."""
    return np.asarray(np.log(np.maximum(light, 1e-30) / np.maximum(model, 1e-30)))


def _sun_fade(sun: tuple[float, float]) -> float:
    """Return the share of the sun's glow that remains as it sets."""
    return float(smoothstep(*_SETS, sun[1]))


def without_sun(
    light: Floats,
    sky: Floats,
    model: Floats,
    sun: tuple[float, float],
    azimuth: NDArray[Any],
    elevation: NDArray[Any],
) -> Floats:
    """Return the upper half of a map (h, W, 3) with the sun and its glare replaced by sky.

    The sky's ratio to the model is filled in there from around it.
    """
    apart = distance(sun, azimuth, elevation)
    far = smoothstep(*_GLARE, apart)
    if float(far.min()) >= 1:
        return light
    known = np.asarray(far * (sky > 0.9), np.float32)
    if not known.any():
        return light
    share = _log_ratio(light, model)
    share = np.clip(share, -_LOGS, _LOGS).astype(np.float32)
    # Roll the sun to the middle, far from the map's seam.
    shift = light.shape[1] // 2 - round((sun[0] / 360 + 0.5) * light.shape[1])
    share, weight = (np.roll(part, shift, axis=1) for part in (share, known))
    filled = np.roll(fill_by_pyramid(share, weight), -shift, axis=1)
    near = np.asarray((1 - far) * (sky > 0.02), np.float32)[..., None]
    # Never brighter than before: the filled-in sky lies behind the glare.
    behind = np.minimum(np.exp(filled) * model, light)
    return np.asarray((1 - near) * light + near * behind, np.float32)


def _cloud_radiance(
    model: SkyModel, fit: SkyFit, cover: float, gain: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the radiance (3,) of a white cloud.

    The sun lights single clouds from any side and a closed layer like level ground. Both lose it
    later than the ground does.
    """
    height = fit.sun[1]
    beam = gain * sunlight(fit.atmosphere, height + _LATE)
    level = max(float(np.sin(np.radians(height + _LATE))), 0.0)
    return np.asarray(
        (model.level_irradiance() + ((1 - cover) * 0.5 + cover * level) * beam) / np.pi
    )


def _unhidden_share(
    sun: tuple[float, float], opacity: Floats, sky: Floats, above: tuple[Any, Any]
) -> float:
    """Return the share of the sun's light that passes clouds and land."""
    width = sky.shape[1]
    apart = distance(sun, *above)
    near = apart < max(_NEAR_DISC, 0.75 * 360 / width)
    if not near.any():
        return 1.0 if sun[1] <= 0 else 0.0
    upper = sky[: width // 4]
    return float((upper * (1 - opacity))[near].mean())


def _haze_band(light: Floats, sky: Floats, model: Floats) -> NDArray[Any]:
    """Return the log of sky over model at each elevation (h, 1, 3): haze at the horizon."""
    share = _log_ratio(light, model)
    share[sky < 0.9] = np.nan
    found = np.zeros((len(light), 1, 3))
    for row, values in enumerate(share):
        known = np.isfinite(values[:, 0])
        if known.sum() >= _FEW:
            found[row, 0] = np.clip(np.median(values[known], axis=0), -_MOST_HAZE, _MOST_HAZE)
    return found


def _land_ratio(
    source: Floats,
    lit: Floats,
    land: Floats,
    direct: NDArray[np.float64],
    direct_now: NDArray[np.float64],
    suns: tuple[tuple[float, float], tuple[float, float]],
) -> Floats:
    """Return the new over old irradiance (H, W, 3) of land, level below and upright above.

    The old sun's shadows stay. ``lit`` is the new sky, ``land`` the old land.
    """
    azimuth, elevation = angles(source.shape[1])
    before = _irradiances(source, direct, suns[0])
    # The land also lights walls and is lit by the sky; one bounce is enough.
    ground = _irradiances(lit, direct_now, suns[1])[0] / np.maximum(before[0], 1e-30)
    now = _irradiances(np.asarray(lit + land * ground, np.float32), direct_now, suns[1])
    ratios = [
        np.log(np.clip(n / np.maximum(b, 1e-30), *_RATIO)) for n, b in zip(now, before, strict=True)
    ]
    walls = np.stack([np.interp(azimuth[0], _WALLS, ratios[1][:, i]) for i in range(3)], axis=-1)
    stands = smoothstep(*_RISE, elevation[:, :1])[..., None]
    return np.asarray(np.exp((1 - stands) * ratios[0] + stands * walls[None]), np.float32)


def _land_light(
    source: Floats, sky: Floats, dome: Dome, where: tuple[NDArray[Any], NDArray[Any]]
) -> Floats:
    """Return the land's part (H, W, 3) of a map's light.

    Land cannot be brighter than a white surface in the same light. Brighter pixels near the sun and
    above the horizon are sky or glare, which move with the sun.
    """
    azimuth, elevation = where
    lying, walls = _irradiances(source, dome.direct, dome.sun)
    white = np.stack([np.interp(azimuth[0], _WALLS, wall) for wall in walls.T], axis=-1)
    near = smoothstep(*_VEILED, distance(dome.sun, azimuth, elevation))[..., None]
    most = np.where(elevation[..., None] > 0, white, lying + near / np.maximum(1 - near, 1e-12))
    most = np.asarray(_WHITEST / np.pi * most, np.float32)
    return np.asarray((1 - sky[..., None]) * np.minimum(source, most), np.float32)


def _irradiances(
    light: Floats, direct: NDArray[np.float64], sun: tuple[float, float]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the irradiance (3,) of level ground and (n, 3) of walls facing the camera."""
    from sunwidget.analysis.images.working_copy import resize

    small = resize(np.asarray(light, np.float32), _SMALL, _SMALL // 2)
    beam = toward(*sun)
    upper = small.copy()
    upper[_SMALL // 4 :] = 0
    lying = irradiance(upper) + max(float(beam[2]), 0) * direct
    normals = -toward(_WALLS, 0 * _WALLS)
    walls = [
        irradiance(small, (float(n[0]), float(n[1]), 0.0)) + max(float(n @ beam), 0) * direct
        for n in normals
    ]
    # Trees and hills are half upright, half level.
    return np.asarray(lying), (np.array(walls) + lying) / 2
