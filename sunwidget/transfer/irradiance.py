"""The light on a scene's land, from its fitted atmosphere, in the photo's own exposure.

The NumPy twin of shaders/atmosphere/light.glsl and sky/daylight.glsl, for one comparison of two
photos: the sky's light is the model summed over the sky, the sun's follows from its transmittance.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from sunwidget.analysis.fit.fit import model_sky
from sunwidget.analysis.images.working_copy import resize
from sunwidget.analysis.sun.search import night
from sunwidget.atmosphere.color import spectral_to_rec709
from sunwidget.atmosphere.optics import direct_irradiance
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.formats.color import LUMINANCE

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene

_ROUGHNESS = 0.35  # of soft_cosine.glsl; chosen for two photos, less than kRoughness there


class LandLight(NamedTuple):
    """Irradiance (3,), linear Rec. 709, of level surfaces and of those facing the camera.

    In total and by the sky alone.
    """

    lying: np.ndarray
    upright: np.ndarray
    lying_by_sky: np.ndarray
    upright_by_sky: np.ndarray


def land_light(scene: Scene) -> LandLight:
    """Return the light on the land of ``scene``, in its scene-linear unit times π.

    At night there is no sun, whatever the fit found.
    """
    assert scene.fitted is not None
    azimuth, elevation = scene.fitted.sun
    sky, sun = _light(scene.fitted.atmosphere.replace(residual=None), azimuth, elevation)
    visible = sun_share(scene)
    az, el = np.radians(azimuth), np.radians(elevation)
    gain = np.array(scene.fitted.gain)
    return LandLight(
        gain * (sky[0] + visible * _rough(np.sin(el)) * sun),
        gain * (sky[1] + visible * _rough(-np.cos(el) * np.cos(az)) * sun),
        gain * sky[0],
        gain * sky[1],
    )


def sun_share(scene: Scene) -> float:
    """Return the share of the direct sun that passes the clouds, 0 to 1.

    1 if the sun is visible; otherwise from the mean opacity of all clouds.
    """
    small = scene.working
    opacity = resize(scene.clouds, small.width, small.height)
    weight = resize(scene.sky, small.width, small.height)
    if is_night(scene):
        return 0.0
    if scene.shows_sun:
        return 1.0  # unmixing may take the visible sun's glare for cloud
    total = float(weight.sum())
    return 1.0 - float((opacity * weight).sum()) / total if total > 1 else 1.0


def is_night(scene: Scene) -> bool:
    """Return whether the sky is too dark for sunlight."""
    small = scene.working
    return night(small.encoded @ LUMINANCE, resize(scene.sky, small.width, small.height))


@lru_cache(maxsize=16)
def _light(
    atmosphere: Atmosphere, azimuth: float, elevation: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return the sky's irradiance of level and upright surfaces (2, 3), and the sun's (3,)."""
    height = np.arange(3.0, 90, 6)[:, None]
    around = np.arange(7.5, 360, 15)[None, :]
    towards, up = np.broadcast_arrays(around, height)
    radiance = model_sky(atmosphere, towards, up, (azimuth, elevation))
    el, az = np.radians(height), np.radians(around)
    solid = np.cos(el) * np.radians(6) * np.radians(15)
    lying = np.sin(el) * solid + 0 * az
    upright = np.maximum(-np.cos(el) * np.cos(az), 0) * solid
    sky = np.stack([(radiance * weight[..., None]).sum((0, 1)) for weight in (lying, upright)])
    sun = np.maximum(spectral_to_rec709(direct_irradiance(atmosphere, elevation)), 0)
    return np.maximum(sky, 1e-12), np.asarray(sun).reshape(3)


def _rough(cosine: float) -> float:
    return float(0.5 * (cosine + np.hypot(cosine, _ROUGHNESS)))
