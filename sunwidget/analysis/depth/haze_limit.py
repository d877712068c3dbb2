"""The greatest possible distance of land, from its darkness: air in front of it would be visible.

The darkest places nearby have little light except that of the air in front of them (dark channel:
He, Sun & Tang, "Single Image Haze Removal Using Dark Channel Prior", CVPR 2009). Where a guessed
depth gives more air than they show, the land is nearer, or its air is clearer; both are equivalent
in the frame.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.fit.fit import SkyFit
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera

_SIDE = 320  # longer side of the copy in pixels
_PATCH = 0.03  # of the longer side: a neighborhood that contains something dark
_AIR_SCATTERING = np.array([7.5e-6, 1.17e-5, 2.32e-5])  # as shaders/atmosphere/extinction.glsl
_STEPS = np.array([0.154, -0.0026, -0.242])
_FARTHEST_AIR = 15000.0  # as shaders/land/read_air.glsl
_NO_LAND = 1e6  # scene-linear light of ignored pixels
_ANYWHERE = 12.0  # ln(metres)
_JUST_ABOVE = 0.6  # degrees over the horizon


def log_limit(working: Working, land: np.ndarray, camera: Camera, fit: SkyFit) -> np.ndarray:
    """Return the natural logarithm of each pixel's greatest distance, (h, w) float32.

    Parameters
    ----------
    working : Working
        The photo's small copy.
    land : (h, w) bool
        Its land.
    camera : Camera
        Camera for any size.
    fit : SkyFit
        The sky's model, which gives the light of an endless path of air.

    Returns
    -------
    (h, w) float32
        ln(metres); 12, beyond all relevant air, where the land is no darker than air.
    """
    import cv2

    scale = min(1.0, _SIDE / max(working.width, working.height))
    columns, rows = (max(1, round(scale * n)) for n in (working.width, working.height))
    light = fit.response.scene_light(resize(working.linear, columns, rows)) @ LUMINANCE
    # Only land counts as dark.
    light = np.where(resize(land.astype(np.float32), columns, rows) > 0.99, light, _NO_LAND)
    side = 2 * max(1, round(0.5 * _PATCH * max(columns, rows))) + 1
    dark = cv2.erode(light.astype(np.float32), np.ones((side, side), np.uint8))
    share = np.minimum(dark / _air(camera.resized(columns, rows), fit), 1)
    share = cv2.blur(np.asarray(share, np.float32), (side, side))
    air = fit.atmosphere
    extinction = air.air_density * _AIR_SCATTERING
    extinction += (
        air.aerosol_optical_depth
        / air.aerosol_scale_height
        * np.exp2(-air.angstrom_exponent * _STEPS)
    )
    bent = -np.log(np.maximum(1 - share, 1e-3)) / float(extinction @ LUMINANCE)
    metres = bent * _FARTHEST_AIR / np.maximum(_FARTHEST_AIR - bent, 1e-3)
    limit = np.where(bent < _FARTHEST_AIR, np.log(np.maximum(metres, 1.0)), _ANYWHERE)
    return resize(limit.astype(np.float32), working.width, working.height)


def _air(camera: Camera, fit: SkyFit) -> np.ndarray:
    """Return the luminance of the model's sky at the horizon in each column, (w,) float32."""
    x = np.arange(camera.width) + 0.5
    azimuth, _ = camera.angles(x, np.full_like(x, 0.5 * camera.height))
    sky = fit.model(azimuth, np.full_like(x, _JUST_ABOVE))
    return np.asarray(np.maximum(sky @ LUMINANCE, 1e-6), np.float32)
