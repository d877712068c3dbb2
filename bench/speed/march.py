"""The peer's sky in NumPy: ``march.glsl`` again, for arrays of rays."""

from __future__ import annotations

import numpy as np

from sunwidget.atmosphere import optics
from sunwidget.atmosphere.constants import GROUND_RADIUS, solar_irradiance
from sunwidget.atmosphere.parameters import Atmosphere

STEPS, LIGHT_STEPS = 32, 8


def march(air: Atmosphere, mu: np.ndarray, mu_s: float, nu: np.ndarray) -> np.ndarray:
    """Return once-scattered radiance (N, 4) in W m⁻² sr⁻¹ nm⁻¹ along rays from the camera.

    ``mu`` (N,) is the sine of the rays' elevation, ``mu_s`` that of the sun's, ``nu`` (N,) the
    cosine of the angle between ray and sun.
    """
    h = optics.camera_height(air)
    extinction = optics.extinction_coefficients(air)
    rayleigh = optics.rayleigh_phase(nu)[:, None] * extinction[0]
    mie = optics.cornette_shanks_phase(nu, air.aerosol_asymmetry)[:, None] * extinction[1]
    mie = mie * air.aerosol_albedo
    d, ground = optics.distance_to_boundary(h, mu)
    transmittance = np.ones((len(mu), 4))
    radiance = np.zeros((len(mu), 4))
    for i in range(STEPS):
        u = (i + 0.5) / STEPS
        t, dt = d * u * u, 2 * d * u / STEPS
        h_t = optics.altitude_along_ray(h, mu, t)
        mu_s_t = np.clip(((GROUND_RADIUS + h) * mu_s + t * nu) / (GROUND_RADIUS + h_t), -1, 1)
        density = optics.density(h_t, air.heights)
        scattered = density[:, :1] * rayleigh + density[:, 1:2] * mie
        lost = density @ extinction
        through = np.exp(-lost * dt[:, None])
        part = (1 - through) / np.maximum(lost, 1e-30)
        radiance += transmittance * scattered * to_sun(air, extinction, h_t, mu_s_t) * part
        transmittance *= through
    mu_s_ground = np.clip(((GROUND_RADIUS + h) * mu_s + d * nu) / GROUND_RADIUS, -1, 1)
    sunlight = to_sun(air, extinction, np.zeros_like(mu), mu_s_ground)
    lit = air.ground_albedo / np.pi * np.maximum(mu_s_ground, 0)[:, None] * sunlight
    return solar_irradiance() * (radiance + np.where(ground[:, None], transmittance * lit, 0))


def to_sun(air: Atmosphere, extinction: np.ndarray, h: np.ndarray, mu_s: np.ndarray) -> np.ndarray:
    """Return what reaches each point of the sun's light, (N, 4)."""
    d, ground = optics.distance_to_boundary(h, mu_s)
    column = np.zeros((len(mu_s), 3))
    for i in range(LIGHT_STEPS):
        u = (i + 0.5) / LIGHT_STEPS
        altitude = optics.altitude_along_ray(h, mu_s, d * u * u)
        column += optics.density(altitude, air.heights) * (2 * d * u / LIGHT_STEPS)[:, None]
    return np.where(ground[:, None], 0, np.exp(-(column @ extinction)))
