"""Geometry, densities, phase functions, columns, transmittance; twin of ``atmosphere.glsl``.

Lengths are metres, ``h`` is an altitude above the ground, ``mu`` the cosine of a ray's zenith
angle, ``nu`` that of the angle between ray and sun. All functions broadcast and use float64.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sunwidget.atmosphere.constants import (
    GROUND_RADIUS,
    MESOSPHERE_ALTITUDE,
    MESOSPHERE_SCALE_HEIGHT,
    MOLECULES_PER_DOBSON,
    OZONE_LAYER,
    RAYLEIGH_EXPONENT,
    RAYLEIGH_SCALE_HEIGHT,
    SUN_ANGULAR_RADIUS_DEG,
    TOP_RADIUS,
    WAVELENGTHS,
    ozone_cross_section,
)
from sunwidget.atmosphere.parameters import STANDARD_HEIGHTS, Atmosphere, ScaleHeights
from sunwidget.atmosphere.rayleigh import rayleigh_coefficient

Array = NDArray[np.float64]

ATMOSPHERE_HEIGHT = TOP_RADIUS - GROUND_RADIUS
LONGEST_HORIZON = float(np.sqrt(TOP_RADIUS**2 - GROUND_RADIUS**2))
_VALUES_AT_ONCE = 1 << 15  # 256 kB stay in the cache
SUN_ANGULAR_RADIUS = float(np.radians(SUN_ANGULAR_RADIUS_DEG))


def rayleigh_phase(nu: ArrayLike) -> Array:
    """Return Rayleigh's phase function in 1/sr; its integral over the sphere is one."""
    return np.asarray(3 / (16 * np.pi) * (1 + np.square(nu)))


def cornette_shanks_phase(nu: ArrayLike, asymmetry: float) -> Array:
    """Return the phase function of Cornette & Shanks (1992, eq. 8) in 1/sr.

    ``asymmetry`` is its parameter g; the mean cosine is 3g(4 + g²) / (5(2 + g²)).
    """
    nu = np.asarray(nu, float)
    g = asymmetry
    base = np.maximum(1 + g * g - 2 * g * nu, 1e-6)
    return np.asarray(3 / (8 * np.pi) * (1 - g * g) * (1 + nu * nu) / ((2 + g * g) * base**1.5))


def altitude_along_ray(h: ArrayLike, mu: ArrayLike, t: ArrayLike) -> Array:
    """Return the altitude at distance ``t`` along a ray that starts at ``h``."""
    h, mu, t = (np.asarray(v, float) for v in (h, mu, t))
    q = np.maximum(h * (2 * GROUND_RADIUS + h) + t * (2 * (GROUND_RADIUS + h) * mu + t), 0)
    return np.asarray(q / (np.sqrt(GROUND_RADIUS**2 + q) + GROUND_RADIUS))


def distance_to_top(h: ArrayLike, mu: ArrayLike) -> Array:
    """Return the distance from ``h`` along ``mu`` to the top of the atmosphere."""
    h, mu = np.asarray(h, float), np.asarray(mu, float)
    r_mu = (GROUND_RADIUS + h) * mu
    shell = (ATMOSPHERE_HEIGHT - h) * (TOP_RADIUS + GROUND_RADIUS + h)
    return np.asarray(np.sqrt(r_mu**2 + shell) - r_mu)


def cosine_of_horizon(h: ArrayLike) -> Array:
    """Return the zenith cosine of the geometric horizon seen from ``h`` (zero or less)."""
    h = np.asarray(h, float)
    return np.asarray(-np.sqrt(h * (2 * GROUND_RADIUS + h)) / (GROUND_RADIUS + h))


def distance_to_boundary(h: ArrayLike, mu: ArrayLike) -> tuple[Array, NDArray[np.bool_]]:
    """Return the distance to the ground or the top, and whether the ray meets the ground."""
    h, mu = np.broadcast_arrays(np.asarray(h, float), np.asarray(mu, float))
    r_mu = (GROUND_RADIUS + h) * mu
    q = h * (2 * GROUND_RADIUS + h)
    root = np.sqrt(np.maximum(r_mu**2 - q, 0))
    ground = mu < cosine_of_horizon(h)
    with np.errstate(divide="ignore", invalid="ignore"):
        down = q / (root - r_mu)
    return np.where(ground, down, distance_to_top(h, mu)), ground


def visible_fraction(above: ArrayLike) -> Array:
    """Return the share of the sun's disc above the horizon; its center is ``above`` it, radians."""
    x = np.clip(np.asarray(above, float) / SUN_ANGULAR_RADIUS, -1, 1)
    return np.asarray(0.5 + (x * np.sqrt(1 - x * x) + np.arcsin(x)) / np.pi)


def density(h: ArrayLike, heights: ScaleHeights = STANDARD_HEIGHTS) -> Array:
    """Return relative densities of air, aerosol and ozone at ``h``, shape (..., 3)."""
    h = np.asarray(h, float)
    low, peak, high = OZONE_LAYER
    ozone = np.maximum(0, np.minimum((h - low) / (peak - low), (high - h) / (high - peak)))
    # The mesosphere's scale height changes in proportion to the one below.
    thin = RAYLEIGH_SCALE_HEIGHT / MESOSPHERE_SCALE_HEIGHT - 1
    air = np.exp(-(h + np.maximum(h - MESOSPHERE_ALTITUDE, 0) * thin) / heights.air)
    return np.stack([air, np.exp(-h / heights.aerosol), ozone], axis=-1)


def extinction_coefficients(
    atmosphere: Atmosphere, wavelength_nm: ArrayLike = WAVELENGTHS
) -> Array:
    """Return extinction of air, aerosol and ozone at full density, 1/m, shape (3, wavelengths)."""
    nm = np.asarray(wavelength_nm, float)
    low, _, high = OZONE_LAYER
    aerosol = atmosphere.aerosol_optical_depth * (nm / 550) ** -atmosphere.angstrom_exponent
    tilt = (nm / 550) ** (RAYLEIGH_EXPONENT - atmosphere.rayleigh_exponent)
    molecules = atmosphere.ozone * MOLECULES_PER_DOBSON / (0.5 * (high - low))
    return np.stack(
        [
            atmosphere.air_density * rayleigh_coefficient(nm) * tilt,
            aerosol / atmosphere.aerosol_scale_height,
            molecules * ozone_cross_section(nm),
        ]
    )


def integrate_columns(
    h: ArrayLike, mu: ArrayLike, heights: ScaleHeights = STANDARD_HEIGHTS, *, steps: int = 400
) -> Array:
    """Return path lengths of air, aerosol and ozone to the top in metres, shape (..., 3).

    Steps are t = d u², densest where the air is dense, sampled at the mean of u² over each step.
    That removes the midpoint rule's error at the dense end (first Euler–Maclaurin term).
    """
    h, mu = np.broadcast_arrays(np.asarray(h, float), np.asarray(mu, float))
    d = distance_to_top(h, mu)[..., None]
    u = (np.arange(steps) + 0.5) / steps
    along = altitude_along_ray(h[..., None], mu[..., None], d * (u**2 + 1 / (12 * steps**2)))
    return np.asarray(np.sum(density(along, heights) * (2 * d * u / steps)[..., None], axis=-2))


def relative_air_mass(elevation_deg: ArrayLike, h: float = 0.0) -> Array:
    """Return slant over vertical columns of air, aerosol and ozone, shape (..., 3)."""
    mu = np.sin(np.radians(np.asarray(elevation_deg, float)))
    return integrate_columns(h, mu, steps=4000) / integrate_columns(h, 1.0, steps=4000)


def columns_to_top(h: ArrayLike, mu: ArrayLike, heights: ScaleHeights = STANDARD_HEIGHTS) -> Array:
    """Look up ``integrate_columns`` in a table (0.1 %); rays below the horizon are raised to it."""
    h = np.asarray(h, float)
    mu = np.maximum(mu, cosine_of_horizon(h))
    rho = np.sqrt(h * (2 * GROUND_RADIUS + h))
    d_min = ATMOSPHERE_HEIGHT - h
    x = (distance_to_top(h, mu) - d_min) / (rho + LONGEST_HORIZON - d_min)
    return bilinear(_columns_table(heights), np.sqrt(rho / LONGEST_HORIZON), x)


@lru_cache(maxsize=8)
def _columns_table(heights: ScaleHeights) -> Array:
    """Return columns by distance to the horizon (rows) and top (columns), as the shaders do."""
    rho = np.linspace(0, 1, 192)[:, None] ** 2 * LONGEST_HORIZON
    h = rho**2 / (np.sqrt(GROUND_RADIUS**2 + rho**2) + GROUND_RADIUS)
    d_min = ATMOSPHERE_HEIGHT - h
    d = d_min + np.linspace(0, 1, 256) * (rho + LONGEST_HORIZON - d_min)
    shell = (ATMOSPHERE_HEIGHT - h) * (TOP_RADIUS + GROUND_RADIUS + h)
    with np.errstate(divide="ignore", invalid="ignore"):
        mu = (shell - d * d) / (2 * (GROUND_RADIUS + h) * d)
    mu = np.clip(np.where(d > 0, mu, 1), -1, 1)
    # Two rows at a time stay in the cache: a sixth of the time.
    pairs = (slice(row, row + 2) for row in range(0, len(h), 2))
    return np.concatenate([integrate_columns(h[p], mu[p], heights, steps=48) for p in pairs])


def bilinear(table: Array, row: ArrayLike, column: ArrayLike) -> Array:
    """Sample ``table`` (rows, columns, ...) at coordinates in [0, 1], with samples at both ends."""
    height, width = table.shape[:2]
    y, x = np.broadcast_arrays(
        np.clip(row, 0, 1) * (height - 1), np.clip(column, 0, 1) * (width - 1)
    )
    i = np.minimum(y.astype(np.intp), height - 2)
    j = np.minimum(x.astype(np.intp), width - 2)
    flat = table.reshape(height * width, -1)
    corners = (i * width + j).ravel()
    y, x = (y - i).reshape(-1, 1), (x - j).reshape(-1, 1)
    out = np.empty((corners.size, flat.shape[1]))
    step = max(1, _VALUES_AT_ONCE // flat.shape[1])
    for first in range(0, corners.size, step):
        part = slice(first, first + step)
        corner, right = corners[part], x[part]
        left = 1 - right
        upper, beside = flat.take(corner, axis=0), flat.take(corner + 1, axis=0)
        upper *= left
        beside *= right
        upper += beside
        lower, beside = flat.take(corner + width, axis=0), flat.take(corner + width + 1, axis=0)
        lower *= left
        beside *= right
        lower += beside
        upper *= 1 - y[part]
        lower *= y[part]
        np.add(upper, lower, out=out[part])
    return out.reshape(*i.shape, -1)


def transmittance_to_top(
    atmosphere: Atmosphere,
    h: ArrayLike,
    mu: ArrayLike,
    wavelength_nm: ArrayLike = WAVELENGTHS,
) -> Array:
    """Return the transmittance from ``h`` along ``mu`` out of the air, shape (..., wavelengths)."""
    extinction = extinction_coefficients(atmosphere, wavelength_nm)
    return np.exp(-(columns_to_top(h, mu, atmosphere.heights) @ extinction))


def direct_irradiance(
    atmosphere: Atmosphere,
    sun_elevation_deg: ArrayLike,
    wavelength_nm: ArrayLike = WAVELENGTHS,
) -> Array:
    """Return the sun's irradiance at normal incidence at the camera, W m⁻² nm⁻¹.

    It includes the visible share of the disc; shape (..., wavelengths).
    """
    from sunwidget.atmosphere.constants import solar_irradiance

    elevation = np.radians(np.asarray(sun_elevation_deg, float))
    h = camera_height(atmosphere)
    share = visible_fraction(elevation - np.arcsin(cosine_of_horizon(h)))
    transmittance = transmittance_to_top(atmosphere, h, np.sin(elevation), wavelength_nm)
    return np.asarray(share[..., None] * transmittance * solar_irradiance(wavelength_nm))


def camera_height(atmosphere: Atmosphere) -> float:
    """Return the altitude from which the sky is computed: at least one metre above the ground."""
    return float(np.clip(atmosphere.altitude, 1.0, 0.99 * ATMOSPHERE_HEIGHT))
