"""The light of an environment map under another sun: one model, new over old.

Clear sky, clouds and land change by the ratio of what the model has for them under the two suns;
the disc and the glare round it are taken out and a disc is drawn where the sun goes.
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
from sunwidget.dome.disc import disc_giving
from sunwidget.dome.sphere import angles, distance, irradiance, toward

if TYPE_CHECKING:
    from sunwidget.dome.source import Dome

Floats = NDArray[np.float32]

_GLARE = (2.5, 7.0)  # degrees round the old sun whose light is its own, its lens' and its aureole's
_LOGS = 4.0  # most that the sky's light is believed to differ from the model, as a logarithm
_ROWS, _COLUMNS = 73, 97  # of the table that the model's sky is read from
_LATE = 1.2  # degrees by which the horizon is lower for clouds
_BEYOND = (0.15, 0.7)  # of the sky beyond a cloud that comes through it, as in the photos' frame
_WALLS = np.arange(-180.0, 181, 15)  # azimuths of upright surfaces
_RISE = (-4.0, 3.0)  # degrees over which what is seen turns from lying to standing
_SMALL = 256  # width of the maps whose irradiance is asked
_NEAR_DISC = 1.0  # degrees round the sun in which clouds and land hide it
_RATIO = (1e-6, 1e6)
_HALF = 0.5
_WHITEST = 0.6  # albedo
_VEILED = (10.0, 30.0)  # degrees from the sun over which a lens' glare lies before the ground
_RINGS = (4.0, 90.0)  # degrees from the sun
_STEPS = 16
_BETWEEN_CLOUDS = 0.4  # quantile
_LOW = 4.0  # degrees under which haze and hills are no measure of a glow
_FEW = 40  # pixels of a ring
_MOST_GLOW = 2.5
_MOST_HAZE = 0.7
_SETS = (-6.0, 0.0)  # degrees


@dataclass(frozen=True)
class Relit:
    """Sky and sun of a moved dome apart, in the map's own unit.

    Parameters
    ----------
    sky : (H, W, 3) float32
        Radiance without the sun's disc, land included.
    disc : (H, W, 3) float32
        The disc alone.
    direct : (3,)
        Illuminance by the sun at right angles to it, by channel.
    direction : (azimuth, elevation)
        Of the sun, degrees.
    through : float
        Share of the sun's light past clouds, land and ``sun_visibility``.
    whole : (H, W, 3) float32
        Sky and disc together; of an unmoved dome the source to the bit.
    """

    sky: Floats
    disc: Floats
    direct: NDArray[np.float64]
    direction: tuple[float, float]
    through: float
    whole: Floats


class SkyModel:
    """The model's sky under one sun, in any direction, by a table over half of the sky."""

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
        """Return radiance (h, w, 3); below the horizon the horizon's."""
        import cv2

        turn = np.abs((azimuth - self.sun[0] + 180) % 360 - 180)
        x = (turn / 180) ** (2 / 3) * (_COLUMNS - 1)
        y = np.sqrt(np.clip(elevation, 0, 90) / 90) * (_ROWS - 1)
        at = x.astype(np.float32), y.astype(np.float32)
        found = cv2.remap(self._table, *at, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        return np.asarray(np.exp(found), np.float32)

    def level_irradiance(self) -> NDArray[np.float64]:
        """Return the irradiance (3,) of the level by the sky."""
        azimuth, elevation = angles(128)
        upper = self(azimuth, elevation) * (elevation > 0)[..., None]
        return np.asarray(irradiance(upper))


def relit(
    dome: Dome, air: SkyFit, sun_visibility: float = 1.0, *, light: Floats, sky: Floats
) -> Relit:
    """Return a dome's light under the sun and air of ``air``.

    ``light`` (H, W, 3) and ``sky`` (H, W) are the dome's at the size that is wanted.
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
            model * np.exp(_up(fit.sun) * glow(distance(fit.sun, *above)))
            for model, fit in ((old, own), (new, air))
        )
    clean = without_sun(light[upper], sky[upper], old, dome.sun, *above)
    if dome.closed < _HALF:
        hazy = old * np.exp(_band(clean, sky[upper], old))
        opacity = cloudiness(clean, own, *above, clear=hazy) * sky[upper]
    else:
        opacity = white_opacity(clean, sky[upper])
    cover = float((opacity * np.cos(np.radians(above[1]))).sum())
    cover /= max(float((sky[upper] * np.cos(np.radians(above[1]))).sum()), 1e-6)
    clouds = [
        _cloud(model, fit, cover, dome.sun_gain) for model, fit in ((before, own), (now, air))
    ]
    a = opacity[..., None]
    beyond = _BEYOND[0] + _BEYOND[1] * (1 - a)
    veiled = [
        (1 - a) * clear + a * (beyond * clear + (1 - beyond) * cloud)
        for clear, cloud in zip((old, new), clouds, strict=True)
    ]
    ratio = np.clip(veiled[1] / np.maximum(veiled[0], 1e-30), *_RATIO)
    through = sun_visibility * _open(air.sun, opacity, sky, above)
    direct = dome.sun_gain * sunlight(air.atmosphere, air.sun[1]) * through
    source = light.astype(np.float32).copy()
    source[upper] = clean
    land = _own_light(source, sky, dome, (azimuth, elevation))
    lit = source - land
    lit[upper] *= ratio
    lit[width // 4 :] *= ratio[-1:]
    result = lit + land * _land(source, lit, land, dome.direct, direct, (own.sun, air.sun))
    disc = disc_giving(direct, air.atmosphere, air.sun, width)
    result = np.maximum(result, 0)
    return Relit(result, disc, direct, air.sun, through, result + disc)


def without_sun_of(dome: Dome, light: Floats, sky: Floats) -> Floats:
    """Return an unmoved map (H, W, 3) without its sun's disc and the glare round it."""
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
    """Return what the sky round its sun is over the model: a logarithm (…, 3) of the angle.

    Haze has lobes of its own, and so have lenses. It goes where the sun goes.
    """
    apart = distance(sun, azimuth, elevation)
    usable = (sky > 0.9) & (elevation > _LOW)
    share = _over(light, model)
    rings = np.geomspace(*_RINGS, _STEPS)
    found = np.full((_STEPS, 3), np.nan)
    for i, ring in enumerate(rings):
        inside = usable & (np.abs(np.log(apart / ring)) < np.log(rings[1] / rings[0]))
        if np.count_nonzero(inside) >= _FEW:
            # Less than the median: clouds are brighter than the sky that they stand before.
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


def _over(light: Floats, model: Floats) -> NDArray[Any]:
    """Return by how much light is over the model's: a logarithm (…, 3)."""
    return np.asarray(np.log(np.maximum(light, 1e-30) / np.maximum(model, 1e-30)))


def _up(sun: tuple[float, float]) -> float:
    """Return how far a glow round the sun is left as it sets."""
    return float(smoothstep(*_SETS, sun[1]))


def without_sun(
    light: Floats,
    sky: Floats,
    model: Floats,
    sun: tuple[float, float],
    azimuth: NDArray[Any],
    elevation: NDArray[Any],
) -> Floats:
    """Return the upper half of a map (h, W, 3) with sky where the sun and its glare were.

    What the sky is over the model is continued into there from round about.
    """
    apart = distance(sun, azimuth, elevation)
    far = smoothstep(*_GLARE, apart)
    if float(far.min()) >= 1:
        return light
    known = np.asarray(far * (sky > 0.9), np.float32)
    if not known.any():
        return light
    share = _over(light, model)
    share = np.clip(share, -_LOGS, _LOGS).astype(np.float32)
    # The sun in the middle, so that the map's seam is far from it.
    shift = light.shape[1] // 2 - round((sun[0] / 360 + 0.5) * light.shape[1])
    share, weight = (np.roll(part, shift, axis=1) for part in (share, known))
    filled = np.roll(fill_by_pyramid(share, weight), -shift, axis=1)
    near = np.asarray((1 - far) * (sky > 0.02), np.float32)[..., None]
    # Never brighter than it was: what is filled in lies behind the glare.
    behind = np.minimum(np.exp(filled) * model, light)
    return np.asarray((1 - near) * light + near * behind, np.float32)


def _cloud(
    model: SkyModel, fit: SkyFit, cover: float, gain: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the radiance (3,) of a white cloud.

    Single clouds stand in the sun from any side, a closed layer is lit as level ground is; both
    lose it later than the ground.
    """
    height = fit.sun[1]
    beam = gain * sunlight(fit.atmosphere, height + _LATE)
    level = max(float(np.sin(np.radians(height + _LATE))), 0.0)
    return np.asarray(
        (model.level_irradiance() + ((1 - cover) * 0.5 + cover * level) * beam) / np.pi
    )


def _open(sun: tuple[float, float], opacity: Floats, sky: Floats, above: tuple[Any, Any]) -> float:
    """Return the share of the sun's light that passes clouds and land."""
    width = sky.shape[1]
    apart = distance(sun, *above)
    near = apart < max(_NEAR_DISC, 0.75 * 360 / width)
    if not near.any():
        return 1.0 if sun[1] <= 0 else 0.0
    upper = sky[: width // 4]
    return float((upper * (1 - opacity))[near].mean())


def _band(light: Floats, sky: Floats, model: Floats) -> NDArray[Any]:
    """Return by how much the sky of each height is over the model, a logarithm (h, 1, 3).

    The haze of the horizon is no cloud.
    """
    share = _over(light, model)
    share[sky < 0.9] = np.nan
    found = np.zeros((len(light), 1, 3))
    for row, values in enumerate(share):
        known = np.isfinite(values[:, 0])
        if known.sum() >= _FEW:
            found[row, 0] = np.clip(np.median(values[known], axis=0), -_MOST_HAZE, _MOST_HAZE)
    return found


def _land(
    source: Floats,
    lit: Floats,
    land: Floats,
    direct: NDArray[np.float64],
    direct_now: NDArray[np.float64],
    suns: tuple[tuple[float, float], tuple[float, float]],
) -> Floats:
    """Return the ratio (H, W, 3) of what falls on the land: lying below, facing us above.

    The old sun's shadows stay, as ever lit or dark. ``lit`` is the new sky, ``land`` the old land.
    """
    azimuth, elevation = angles(source.shape[1])
    before = _falling(source, direct, suns[0])
    # The land lights walls, too, and is lit by the sky: one round tells enough.
    ground = _falling(lit, direct_now, suns[1])[0] / np.maximum(before[0], 1e-30)
    now = _falling(np.asarray(lit + land * ground, np.float32), direct_now, suns[1])
    ratios = [
        np.log(np.clip(n / np.maximum(b, 1e-30), *_RATIO)) for n, b in zip(now, before, strict=True)
    ]
    walls = np.stack([np.interp(azimuth[0], _WALLS, ratios[1][:, i]) for i in range(3)], axis=-1)
    stands = smoothstep(*_RISE, elevation[:, :1])[..., None]
    return np.asarray(np.exp((1 - stands) * ratios[0] + stands * walls[None]), np.float32)


def _own_light(
    source: Floats, sky: Floats, dome: Dome, where: tuple[NDArray[Any], NDArray[Any]]
) -> Floats:
    """Return the land's part (H, W, 3) of a map's light.

    No land is brighter than white in its light. Near the sun and above the horizon what is
    brighter is the sky, or the glare before it, and goes with the sun.
    """
    azimuth, elevation = where
    lying, walls = _falling(source, dome.direct, dome.sun)
    white = np.stack([np.interp(azimuth[0], _WALLS, wall) for wall in walls.T], axis=-1)
    near = smoothstep(*_VEILED, distance(dome.sun, azimuth, elevation))[..., None]
    most = np.where(elevation[..., None] > 0, white, lying + near / np.maximum(1 - near, 1e-12))
    most = np.asarray(_WHITEST / np.pi * most, np.float32)
    return np.asarray((1 - sky[..., None]) * np.minimum(source, most), np.float32)


def _falling(
    light: Floats, direct: NDArray[np.float64], sun: tuple[float, float]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the irradiance (3,) of lying ground and (n, 3) of walls that face the middle."""
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
    # Trees and hills stand and lie.
    return np.asarray(lying), (np.array(walls) + lying) / 2
