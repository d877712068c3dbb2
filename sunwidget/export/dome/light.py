"""The light of a dome: the photo's edited sky where visible, elsewhere its mirror and the model.

A sky pixel is composed of the model and of clouds (picture.py). Where the photo shows the sky, the
two reproduce the photo. Outside, ratio and clouds are mirrored from the photo (mirror.py) and the
model is evaluated for that direction. A mirrored cloud is therefore as bright as its original even
in front of the darker blue overhead, and the clear sky keeps the model's gradient. Linear Rec. 709
in kcd m⁻².
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from sunwidget.analysis.correct import corrected
from sunwidget.analysis.images.working_copy import smoothstep
from sunwidget.dome.disc import sun_disc
from sunwidget.dome.sphere import angles, distance, irradiance, solid_angles
from sunwidget.edit.table import Edit
from sunwidget.export.dome.mirror import Mirror, mirror_of
from sunwidget.export.dome.picture import OVERCAST, Picture, light_of, picture_of, tint
from sunwidget.export.environment import (
    MOON_OVER_SUN,
    air_of,
    environment,
    explorer_values,
    is_moonlit,
)

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.geometry.camera import Camera

Floats = NDArray[np.float32]

_UNVEILED = (4.0, 14.0)  # degrees around an unseen sun that are kept free of mirrored clouds
_FEATHER = 3.0  # degrees within the picture's border
_TRUST_RANGE = 15.0  # degrees from the picture over which trust in the photo decays by e
_ALBEDOS = (0.03, 0.7)
_GRASS = 0.15  # for a photo without land
_SMALL = 256  # width of the dome that the land's albedo is computed with


@dataclass(frozen=True)
class DomeLight:
    """The separate sky, sun and ground of a dome.

    Parameters
    ----------
    sky : (H, W, 3) float32
        Radiance without the sun's disc, the ground below the horizon; kcd m⁻².
    disc : (H, W, 3) float32
        The sun's disc alone.
    seen : (H, W) float32
        Share of ``sky`` that comes from the photo, [0, 1].
    mirrored : bool
        Whether the rest above the horizon has the photo's clouds mirrored, or is the model alone.
    direct : (3,)
        Illuminance by the sun at right angles to it, klx by channel.
    direction : (azimuth, elevation)
        Direction of the sun, degrees.
    through : float
        Share of the sun's light that passes clouds and ``sun_visibility``.
    albedo : (3,)
        Albedo of the ground.
    """

    sky: Floats
    disc: Floats
    seen: Floats
    mirrored: bool
    direct: NDArray[np.float64]
    direction: tuple[float, float]
    through: float
    albedo: NDArray[np.float64]


def dome_light(scene: Scene, edit: Edit, width: int) -> DomeLight:
    """Return the light of a dome ``width`` pixels wide and half as high."""
    upper = _upper(scene, edit, width)
    albedo = _land_albedo(scene, edit)
    lit = irradiance(upper.sky) + max(np.sin(np.radians(upper.direction[1])), 0) * upper.direct
    sky = upper.sky.copy()
    sky[_below(width)] = albedo * lit / np.pi
    return DomeLight(
        sky,
        upper.disc,
        np.where(_below(width)[:, None], np.float32(0), upper.seen),
        upper.mirrored,
        upper.direct,
        upper.direction,
        upper.through,
        albedo,
    )


def _below(width: int) -> NDArray[np.bool_]:
    return np.arange(width // 2) >= width // 4


def _upper(scene: Scene, edit: Edit, width: int) -> DomeLight:
    """Return the dome without its ground."""
    scene = corrected(scene, edit)
    size = (width, width // 2)
    values = explorer_values(scene, edit)
    direction = (values["sun_azimuth"], values["sun_elevation"])
    model = tint(scene, environment(scene, edit, size, sun=False))
    disc = sun_disc(air_of(values), *direction, size)
    if is_moonlit(scene, edit):
        disc = disc * MOON_OVER_SUN
    sky, seen, through, mirrored = _with_photo(scene, edit, model, direction)
    through *= edit.sun_visibility
    disc *= through
    direct = (disc * solid_angles(width)[..., None]).sum((0, 1))
    return DomeLight(
        np.asarray(sky, np.float32),
        np.asarray(disc, np.float32),
        np.asarray(seen, np.float32),
        mirrored,
        direct,
        direction,
        through,
        np.zeros(3),
    )


def _with_photo(
    scene: Scene, edit: Edit, model: Floats, sun: tuple[float, float]
) -> tuple[Floats, Floats, float, bool]:
    """Blend the photo over the model; return light, seen share, sun's share, whether mirrored."""
    width = model.shape[1]
    if scene.fitted is None or not (scene.small_sky > 0.5).any():
        return model, np.zeros(model.shape[:2], np.float32), 1.0, False
    picture = picture_of(scene, edit, sun, width)
    azimuth, elevation = angles(width)
    camera = scene.camera.resized(picture.width, picture.height)
    x, y = camera.pixel(azimuth, elevation)
    own = picture.read(x, y)
    margin = np.minimum.reduce([x, y, camera.width - x, camera.height - y])
    inside = smoothstep(0, _FEATHER, np.degrees(margin / camera.focal))
    seen = np.asarray(np.nan_to_num(inside, nan=0.0) * own.known * (elevation > 0), np.float32)
    mirror = mirror_of(camera)
    rest = model if mirror is None else _continue_sky(mirror, picture, camera, model, sun)
    light = seen[..., None] * own.light + (1 - seen[..., None]) * rest
    cover = picture.mean_opacity
    hidden = picture.opacity_at(*camera.pixel(*sun))
    if hidden is None:
        hidden = cover if cover > OVERCAST else 0.0
    return np.asarray(np.maximum(light, 0), np.float32), seen, 1 - hidden, mirror is not None


def _continue_sky(
    mirror: Mirror, picture: Picture, camera: Camera, model: Floats, sun: tuple[float, float]
) -> Floats:
    """Return the sky beyond the picture: the model behind mirrored clouds."""
    azimuth, elevation = angles(model.shape[1])
    above = np.maximum(elevation, 0)
    around = picture.read(*camera.pixel(*mirror.around(azimuth, above)))
    overhead = picture.read(*camera.pixel(*mirror.overhead(azimuth, above)))
    share = np.asarray(mirror.overhead_share(above), np.float32)[..., None]
    ratio = (1 - share) * around.ratio + share * overhead.ratio
    opacity = (1 - share) * around.opacity[..., None] + share * overhead.opacity[..., None]
    clouds = (1 - share) * around.clouds + share * overhead.clouds
    far = _distance_from(camera, azimuth, elevation)
    trust = np.exp(-far / _TRUST_RANGE)[..., None]
    ratio = np.exp(trust * ratio + (1 - trust) * picture.mean_ratio)
    if picture.mean_opacity <= OVERCAST and not picture.holds_sun:
        open_sky = smoothstep(*_UNVEILED, distance(sun, azimuth, elevation))[..., None]
        opacity, clouds = opacity * open_sky, clouds * open_sky
    return np.asarray((1 - opacity) * ratio * model + clouds, np.float32)


def _land_albedo(scene: Scene, edit: Edit) -> NDArray[np.float64]:
    """Return the albedo (3,) of the photo's land: its mean light over the light on level ground."""
    scene = corrected(scene, edit)
    fit = scene.fitted
    land = (scene.small_sky < 0.1) & (scene.small_water < 0.3)
    if fit is None or np.count_nonzero(land) < 100:
        return np.full(3, _GRASS)
    before = _upper(scene, Edit(), _SMALL)
    beam = max(np.sin(np.radians(before.direction[1])), 0) * before.direct
    lit = irradiance(before.sky) + beam
    light = light_of(scene, scene.working.linear[land]).mean(0)
    return np.clip(np.pi * light / np.maximum(lit, 1e-12), *_ALBEDOS)


def _distance_from(
    camera: Camera, azimuth: NDArray[np.float64], elevation: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the approximate degrees from the picture, taken as a cone around its longer side."""
    half = np.degrees(np.arctan(max(camera.width, camera.height) / 2 / camera.focal))
    return np.maximum(distance((0.0, camera.pitch), azimuth, elevation) - half, 0)
