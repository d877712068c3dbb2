"""Clouds by un-mixing: every sky pixel is clear sky, partly covered by white cloud.

With the clear sky S from the fit and w the light of a white cloud in it, per pixel

    I = (1 - a) S + a k w,    0 <= a <= 1 (opacity),  0 <= k <= 1.5 (self-shade)

by least squares. Unlike a red/blue ratio it distinguishes a dark thick base, a bright top and a
thin veil, and it is soft. Where the sky itself is white (sunset, overcast, around the sun), S and
w are parallel and color is no evidence; there the local contrast decides.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.fit.fit import SkyFit, model_sky
from sunwidget.analysis.images.working_copy import channel_sum
from sunwidget.formats.color import LUMINANCE

_LARGEST_SHADE = 1.5
_RIDGE = 0.02  # weight of "no cloud", as a share of the squared contrast between S and w


def cloud_white(fit: SkyFit) -> np.ndarray:
    """Return the light (3,) of a white cloud: the mean of the sky, and half the sun."""
    azimuth, elevation = np.meshgrid(np.arange(-165, 181, 30.0), np.array([10.0, 30, 50, 70]))
    sky = model_sky(fit.atmosphere, azimuth, elevation, fit.sun) * np.array(fit.gain)
    weight = np.cos(np.radians(elevation))[..., None]
    mean = (sky * weight).sum((0, 1)) / weight.sum()
    # The sun adds about twice the sky's light by day and nothing at the horizon; its color is
    # white, to the accuracy that an opacity needs.
    height = np.clip(np.sin(np.radians(max(fit.sun[1], 0.0))) / 0.25, 0, 1)
    return np.asarray(mean + 2.0 * height * float(mean @ LUMINANCE), np.float32)


def cloud_gain(fit: SkyFit) -> tuple[float, float, float]:
    """Return the scene-linear light (r, g, b) of a cloud per kcd m⁻² of the model's cloud.

    It has the brightness of the sky's gain, but is gray: the camera's picture style makes skies
    bluer than the model but keeps white things white. Daylight as a whole is white in Rec. 709.
    """
    azimuth, elevation = np.meshgrid(np.arange(-165, 181, 30.0), np.array([10.0, 30, 50, 70]))
    sky = model_sky(fit.atmosphere, azimuth, elevation, fit.sun).mean((0, 1)) @ np.diag(LUMINANCE)
    level = float(sky @ np.array(fit.gain) / sky.sum())
    return (level, level, level)


def unmix(
    scene_light: np.ndarray, clear: np.ndarray, white: np.ndarray, sky: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Split the sky's pixels into clear sky and cloud.

    Parameters
    ----------
    scene_light : (h, w, 3) float32
        The photo, scene-linear.
    clear : (h, w, 3) float32
        The fitted clear sky.
    white : (3,) float32
        Light of a white cloud.
    sky : (h, w) float32
        Sky matte.

    Returns
    -------
    opacity, shade : (h, w) float32
        a and k; a is 0 outside the sky.
    """
    # Relative to the clear sky's luminance, so that dusk and noon have the same weight.
    level = np.maximum(clear @ LUMINANCE, 1e-6)[..., None]
    difference = np.minimum(scene_light / level, 8) - clear / level
    down, up = -clear / level, np.broadcast_to(white, clear.shape) / level
    # Normal equations of difference = a down + b up, b = a k, with a ridge towards no cloud.
    dd, uu, du = (channel_sum(x) for x in (down * down, up * up, down * up))
    dx, ux = channel_sum(down * difference), channel_sum(up * difference)
    ridge = _RIDGE * dd
    determinant = (dd + ridge) * (uu + ridge) - du * du
    a = ((uu + ridge) * dx - du * ux) / determinant
    b = ((dd + ridge) * ux - du * dx) / determinant
    a, b = np.maximum(a, 0), np.maximum(b, 0)
    # A cloud no brighter than k allows needs at least this opacity.
    a = np.clip(np.maximum(a, b / _LARGEST_SHADE), 0, 1)
    # Residuals of the fit in a clear sky are not clouds.
    opacity = a * np.clip((a - 0.08) / 0.2, 0, 1)
    shade = np.clip(b / np.maximum(a, 1e-3), 0, _LARGEST_SHADE)
    return (opacity * sky).astype(np.float32), shade.astype(np.float32)
