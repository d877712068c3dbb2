"""Backward Monte Carlo path tracing: all orders of scattering with their true phase functions.

Slow and noisy, but without the approximations of ``atmosphere/sky.py``, whose errors it measures.
Paths start at the camera. At every scattering event the sun is sampled directly (next-event
estimation). Instead of being absorbed or lost to space, a path loses weight. Single scattering
comes from the deterministic march, so that noise affects only the higher orders.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sunwidget.atmosphere import optics
from sunwidget.atmosphere.constants import GROUND_RADIUS, WAVELENGTHS, solar_irradiance
from sunwidget.atmosphere.parameters import Atmosphere, ScaleHeights
from sunwidget.atmosphere.sky import Quality, sky_radiance

Array = NDArray[np.float64]

_STEPS = 48
_DARK = 1e-30  # 1/m; prevents division by zero in thin air
_EXACT = Quality(groups=100)


def trace(
    atmosphere: Atmosphere,
    directions: ArrayLike,
    sun_elevation: float,
    sun_azimuth: float = 0.0,
    wavelengths: ArrayLike = WAVELENGTHS,
    *,
    paths: int = 1000,
    bounces: int = 12,
    seed: int = 0,
) -> tuple[Array, Array]:
    """Return the sky's radiance and its standard error.

    Parameters
    ----------
    atmosphere, directions, sun_elevation, sun_azimuth, wavelengths
        As in ``sky.sky_radiance``.
    paths : int, default 1000
        Paths for each direction and wavelength.
    bounces : int, default 12
        Total orders of scattering and reflection: 2 is single scattering and the second order.
    seed : int, default 0
        Seed of the random numbers.

    Returns
    -------
    radiance, error : ndarray, shape (N, n), float64
        W m⁻² sr⁻¹ nm⁻¹.
    """
    directions = np.asarray(directions, float)
    nm = np.asarray(wavelengths, float)
    azimuth, elevation = np.radians([sun_azimuth, sun_elevation])
    level = np.cos(elevation)
    sun = np.array([level * np.sin(azimuth), np.sin(elevation), level * np.cos(azimuth)])
    shape = (len(directions), len(nm), paths)
    view = np.broadcast_to(directions[:, None, None], (*shape, 3)).reshape(-1, 3)
    band = np.broadcast_to(np.arange(len(nm))[:, None], shape).ravel()
    extinction = optics.extinction_coefficients(atmosphere, nm).T[band]
    light = _higher_orders(atmosphere, view, sun, extinction, bounces, np.random.default_rng(seed))
    samples = light.reshape(shape) * solar_irradiance(nm)[:, None]
    single = sky_radiance(
        atmosphere,
        directions,
        sun_elevation,
        sun_azimuth,
        nm,
        quality=_EXACT,
        multiple_scattering=False,
    )
    error = samples.std(axis=-1) / np.sqrt(paths)
    return single + samples.mean(axis=-1), error


def _higher_orders(
    a: Atmosphere,
    view: Array,
    sun: Array,
    extinction: Array,
    bounces: int,
    rng: np.random.Generator,
) -> Array:
    """Return the light of second and higher orders along ``view`` (N, 3), one path each."""
    radius = GROUND_RADIUS + optics.camera_height(a)
    place = np.zeros_like(view)
    place[:, 1] = radius
    weight = np.ones(len(view))
    light = np.zeros(len(view))
    for order in range(bounces):
        r = np.linalg.norm(place, axis=1)
        h = np.maximum(r - GROUND_RADIUS, 0.01)
        up = place / r[:, None]
        mu = np.clip(np.einsum("ij,ij->i", up, view), -1, 1)
        distance, on_ground, reach = _next_event(h, mu, extinction, a.heights, rng)
        weight *= reach
        place = place + view * distance[:, None]
        r = np.linalg.norm(place, axis=1)
        h = np.where(on_ground, 0.0, np.maximum(r - GROUND_RADIUS, 0.0))
        up = place / r[:, None]
        mu_s = up @ sun

        density = optics.density(h, a.heights)
        rayleigh = density[:, 0] * extinction[:, 0]
        mie = density[:, 1] * extinction[:, 1]
        total = rayleigh + mie + density[:, 2] * extinction[:, 2]
        mie *= a.aerosol_albedo
        albedo = np.where(on_ground, a.ground_albedo, (rayleigh + mie) / np.maximum(total, _DARK))
        weight *= albedo
        nu = view @ sun
        phase = (
            rayleigh * optics.rayleigh_phase(nu)
            + mie * optics.cornette_shanks_phase(nu, a.aerosol_asymmetry)
        ) / np.maximum(rayleigh + mie, _DARK)
        reflected = np.maximum(mu_s, 0) / np.pi
        share = _smooth_share(mu_s - optics.cosine_of_horizon(h))
        columns = optics.columns_to_top(h, mu_s, a.heights)
        lit = share * np.exp(-np.einsum("ij,ij->i", columns, extinction))
        # The march of ``sky_radiance`` covers sunlight at the first event in the air.
        if order > 0:
            light += weight * lit * np.where(on_ground, reflected, phase)
        by_air = rng.random(len(view)) * (rayleigh + mie) < rayleigh
        scattered = _scatter(view, by_air, a.aerosol_asymmetry, rng)
        view = np.where(on_ground[:, None], _lambert(up, rng), scattered)
    return light


def _smooth_share(above: Array) -> Array:
    x = np.clip(0.5 + 0.5 * above / optics.SUN_ANGULAR_RADIUS, 0, 1)
    return x * x * (3 - 2 * x)


def _next_event(
    h: Array, mu: Array, extinction: Array, heights: ScaleHeights, rng: np.random.Generator
) -> tuple[Array, NDArray[np.bool_], Array]:
    """Return the distance to the next event, whether it is the ground, and the path's weight."""
    d, ground = optics.distance_to_boundary(h, mu)
    # Steps are dense at both ends: a ray may leave dense air and enter it again.
    v = np.linspace(0, 1, _STEPS + 1)
    edges = np.where(ground[:, None], v * v * (3 - 2 * v), v * v) * d[:, None]
    middle = 0.5 * (edges[:, 1:] + edges[:, :-1])
    density = optics.density(optics.altitude_along_ray(h[:, None], mu[:, None], middle), heights)
    depth = np.einsum("ijk,ik->ij", density, extinction) * np.diff(edges, axis=1)
    total = np.cumsum(depth, axis=1)
    opaque = -np.expm1(-total[:, -1])
    random = rng.random(len(h))
    # Rays to space are forced to scatter; rays to the ground scatter by their transmittance.
    on_ground = ground & (random > opaque)
    within = np.where(ground, np.minimum(random, opaque), random * opaque)
    target = -np.log1p(-np.minimum(within, opaque * (1 - 1e-12)))
    step = np.minimum((total < target[:, None]).sum(axis=1), _STEPS - 1)
    rows = np.arange(len(h))
    part = 1 - (total[rows, step] - target) / np.maximum(depth[rows, step], _DARK)
    distance = edges[rows, step] + part * (edges[rows, step + 1] - edges[rows, step])
    return np.where(on_ground, d, distance), on_ground, np.where(ground, 1.0, opaque)


def _scatter(
    view: Array, by_air: NDArray[np.bool_], asymmetry: float, rng: np.random.Generator
) -> Array:
    """Draw new directions from the phase functions of air or aerosol."""
    nodes = np.cos(np.linspace(np.pi, 0, 4001))
    random = rng.random(len(view))
    cosine = np.empty(len(view))
    for chosen, values in (
        (by_air, optics.rayleigh_phase(nodes)),
        (~by_air, optics.cornette_shanks_phase(nodes, asymmetry)),
    ):
        cumulative = np.concatenate([[0], np.cumsum(np.diff(nodes) * (values[1:] + values[:-1]))])
        cosine[chosen] = np.interp(random[chosen], cumulative / cumulative[-1], nodes)
    return _around(view, cosine, rng)


def _lambert(up: Array, rng: np.random.Generator) -> Array:
    return _around(up, np.sqrt(rng.random(len(up))), rng)


def _around(axis: Array, cosine: Array, rng: np.random.Generator) -> Array:
    """Draw unit vectors at a given cosine from ``axis`` and a random angle around it."""
    helper = np.where(np.abs(axis[:, :1]) < 0.5, [[1.0, 0, 0]], [[0, 1.0, 0]])
    first = np.cross(axis, helper)
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(axis, first)
    turn = 2 * np.pi * rng.random(len(axis))
    sine = np.sqrt(1 - cosine**2)
    drawn = axis * cosine[:, None]
    drawn += (sine * np.cos(turn))[:, None] * first + (sine * np.sin(turn))[:, None] * second
    return np.asarray(drawn / np.linalg.norm(drawn, axis=1)[:, None])
