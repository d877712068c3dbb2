"""The sun's disc and the air's refraction."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sunwidget.atmosphere.constants import (
    SUN_ANGULAR_RADIUS_DEG,
    WAVELENGTHS,
    solar_irradiance,
)
from sunwidget.atmosphere.optics import camera_height, cosine_of_horizon, transmittance_to_top
from sunwidget.atmosphere.parameters import Atmosphere

Array = NDArray[np.float64]


def limb_darkening_exponent(wavelength_nm: ArrayLike = WAVELENGTHS) -> Array:
    """Return the exponent a of the disc's profile μ^a: 0.397, 0.503, 0.652 at 680, 550, 440 nm.

    Linear in between (Neckel & Labs, "Solar limb darkening 1986-1990", 1994, as a power law).
    """
    nm = np.asarray(wavelength_nm, float)
    return np.interp(nm, [440.0, 550.0, 680.0], [0.652, 0.503, 0.397])


def limb_darkening(radius: ArrayLike, wavelength_nm: ArrayLike = WAVELENGTHS) -> Array:
    """Return the disc's brightness over its mean at ``radius``, in units of the disc's radius.

    μ^a averages 2 / (a + 2) over the disc; shape (..., wavelengths), zero outside.
    """
    x = np.asarray(radius, float)[..., None]
    a = limb_darkening_exponent(wavelength_nm)
    mu = np.sqrt(np.clip(1 - x * x, 0, 1))
    return np.where(x <= 1, mu**a * (1 + a / 2), 0.0)


def disc_radiance(
    atmosphere: Atmosphere,
    view_elevation: ArrayLike,
    distance: ArrayLike,
    wavelengths: ArrayLike = WAVELENGTHS,
) -> Array:
    """Return the disc's radiance as the camera sees it, W m⁻² sr⁻¹ nm⁻¹.

    Parameters
    ----------
    atmosphere : Atmosphere
        What is in the air, and the camera's altitude.
    view_elevation : array_like
        Elevation of the view in degrees; each direction is reddened by its own path.
    distance : array_like
        Angle between the view and the disc's center in degrees.
    wavelengths : array_like, shape (n,)
        Nanometres, 360-830.

    Returns
    -------
    ndarray, shape (..., n)
        Zero outside the disc and below the horizon.
    """
    mu = np.sin(np.radians(np.asarray(view_elevation, float)))
    h = camera_height(atmosphere)
    solid_angle = np.pi * np.radians(SUN_ANGULAR_RADIUS_DEG) ** 2
    profile = limb_darkening(np.asarray(distance) / SUN_ANGULAR_RADIUS_DEG, wavelengths)
    above = (mu >= cosine_of_horizon(h))[..., None]
    transmittance = transmittance_to_top(atmosphere, h, mu, wavelengths)
    return np.asarray(above * profile * transmittance * solar_irradiance(wavelengths) / solid_angle)


def refraction(apparent_elevation: ArrayLike) -> Array:
    """Return how far the air lifts the sun, in degrees, from its apparent elevation in degrees.

    Bennett, "The Calculation of Astronomical Refraction in Marine Navigation", J. Navigation 35
    (1982): R' = cot(h + 7.31 / (h + 4.4)), 34′ at the horizon, for 10 °C and 1010 hPa. Below -1°
    the sun is invisible; the value at -1° is kept.
    """
    h = np.maximum(np.asarray(apparent_elevation, float), -1.0)
    minutes = 1 / np.tan(np.radians(h + 7.31 / (h + 4.4)))
    return np.asarray(np.maximum(minutes, 0.0) / 60)


def true_elevation(apparent_elevation: ArrayLike) -> Array:
    """Return the geometric elevation for an apparent elevation, both in degrees."""
    return np.asarray(apparent_elevation, float) - refraction(apparent_elevation)
