"""The field of scattered light around a point, as moments: twin of ``atmosphere/multiple.glsl``.

Hillaire 2020 keeps only the field's mean and scatters it evenly. Rayleigh's phase function depends
only on moments up to second order, a haze's mostly. The first two orders of scattering use them;
the rest is a geometric series of even scattering. Axes in ``einsum``: h altitude, s sun, m zenith
angle, a azimuth, t step, k moment, w wavelength.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sunwidget.atmosphere import optics
from sunwidget.atmosphere.constants import GROUND_RADIUS, RAYLEIGH_SCALE_HEIGHT
from sunwidget.atmosphere.parameters import STANDARD_HEIGHTS, Atmosphere, ScaleHeights

Array = NDArray[np.float64]

NIGHT_COSINE = -0.35
NIGHT_SHARE = 0.65
TWILIGHT_SCALE_HEIGHT = 24_000.0  # in standard air
MOMENTS = 7
_LOBE_SAMPLES = 5
_EIGENVALUE_ROW = 6 / 19  # of the table: 3 km
_WAVELENGTHS_AT_ONCE = 8
_AIRS_KEPT = 4


@dataclass(frozen=True)
class Quality:
    """Sample counts: the table's suns and altitudes, its directions and steps, the view's steps.

    ``zeniths`` is even: half of the rays go up. Each of ``groups`` groups of ``group_steps`` steps
    shares one look-up of the field.
    """

    suns: int = 40
    altitudes: int = 20
    zeniths: int = 8
    azimuths: int = 8
    steps: int = 20
    second_azimuths: int = 4
    second_steps: int = 12
    groups: int = 16
    group_steps: int = 2


SHADER = Quality()
FAST = Quality(altitudes=12, steps=12, second_azimuths=3, second_steps=6, groups=9, group_steps=3)


class Window(NamedTuple):
    """Indices of the first and last sun of the whole range that a table holds."""

    first: int
    last: int


def window_for(sun_elevation: Array, quality: Quality) -> Window:
    """Return the suns that views of the sky under ``sun_elevation`` (radians) can need.

    Along the longest ray through the air, the zenith turns by up to 10°.
    """
    margin = np.radians(12)
    low = np.sin(np.maximum(sun_elevation.min() - margin, -np.pi / 2))
    high = np.sin(np.minimum(sun_elevation.max() + margin, np.pi / 2))
    x = sun_coordinate(np.array([low, high])) * (quality.suns - 1)
    first = max(min(int(np.floor(x[0])), quality.suns - 2), 0)
    return Window(first, min(max(int(np.ceil(x[1])), first + 1), quality.suns - 1))


def sun_coordinate(mu_s: Array) -> Array:
    """Map the cosine of the sun's zenith angle to [0, 1], densest at the terminator and below."""
    night = NIGHT_SHARE * (1 - np.clip(mu_s / NIGHT_COSINE, 0, 1) ** (2 / 3))
    day = NIGHT_SHARE + (1 - NIGHT_SHARE) * np.sqrt(np.maximum(mu_s, 0))
    return np.where(mu_s < 0, night, day)


def suns_of(quality: Quality, window: Window) -> Array:
    """Return the cosines of the sun's zenith angle that a table holds."""
    x = np.linspace(0, 1, quality.suns)[window.first : window.last + 1]
    night = np.maximum(1 - x / NIGHT_SHARE, 0)
    day = np.maximum(x - NIGHT_SHARE, 0) / (1 - NIGHT_SHARE)
    return NIGHT_COSINE * night**1.5 + day**2


def twilight(mu_s: Array, heights: ScaleHeights = STANDARD_HEIGHTS) -> Array:
    """Return a rough guess of how the light falls after sunset (a factor e per degree).

    Interpolation applies to the light divided by this guess.
    """
    scale = TWILIGHT_SCALE_HEIGHT * (heights.air / RAYLEIGH_SCALE_HEIGHT)
    return np.asarray(np.exp(-0.5 * GROUND_RADIUS / scale * np.minimum(mu_s, 0) ** 2))


def sun_cosine(h: Array | float, mu_s: Array, nu: Array, t: Array, h_t: Array | float) -> Array:
    """Return the cosine of the sun's zenith angle at distance ``t`` along a ray from ``h``."""
    ahead = (GROUND_RADIUS + np.asarray(h)) * mu_s + t * nu
    return np.clip(ahead / (GROUND_RADIUS + np.asarray(h_t)), -1, 1)


def sun_share(h: Array | float, mu_s: Array) -> Array:
    """Return the share of the sun's disc above the horizon, by smoothstep as in the shaders.

    The error is within 0.02.
    """
    x = np.clip((mu_s - optics.cosine_of_horizon(h)) / optics.SUN_ANGULAR_RADIUS, -1, 1)
    x = 0.5 * (x + 1)
    return np.asarray(x * x * (3 - 2 * x))


@dataclass(frozen=True)
class Field:
    """Moments over altitude, sun, moment and wavelength, shape (h, s, 7, w), 1/sr."""

    moments: Array
    quality: Quality
    window: Window
    heights: ScaleHeights

    def look_up(self, h: Array, mu_s: Array) -> Array:
        """Return the moments at altitudes and sun cosines, shape (..., 7, w)."""
        rows, suns, _, wavelengths = self.moments.shape
        place = sun_coordinate(mu_s) * (self.quality.suns - 1) - self.window.first
        guess = twilight(suns_of(self.quality, self.window), self.heights)
        table = (self.moments / guess[:, None, None]).reshape(rows, suns, -1)
        found = optics.bilinear(table, np.cbrt(h / optics.ATMOSPHERE_HEIGHT), place / (suns - 1))
        found *= twilight(mu_s, self.heights)[..., None]
        return found.reshape(*found.shape[:-1], MOMENTS, wavelengths)


def light_field(
    a: Atmosphere, extinction: Array, quality: Quality, window: Window, orders: int = 0
) -> Field:
    """Return the field of scattered light for ``extinction`` (3, wavelengths).

    It has all orders, or orders 1 to ``orders`` - 1, which the view ray scatters once more.
    """
    chunks = range(0, extinction.shape[1], _WAVELENGTHS_AT_ONCE)
    parts = [
        _moments(a, extinction[:, c : c + _WAVELENGTHS_AT_ONCE], quality, window, orders)
        for c in chunks
    ]
    return Field(np.concatenate(parts, axis=-1), quality, window, a.heights)


def scattering(a: Atmosphere, extinction: Array, density: Array) -> tuple[Array, Array, Array]:
    """Return the scattering of air and of aerosol, and total extinction, in 1/m, (..., w)."""
    rayleigh = density[..., :1] * extinction[0]
    mie = density[..., 1:2] * extinction[1]
    total = rayleigh + mie + density[..., 2:] * extinction[2]
    return rayleigh, mie * a.aerosol_albedo, total


def attenuate(total: Array, dt: Array) -> tuple[Array, Array]:
    """Integrate transmittance over each step of rays (..., t, w); return also the total."""
    depth = total * dt[..., None]
    before = np.cumsum(depth, axis=-2) - depth
    return np.exp(-before) * -np.expm1(-depth) / np.maximum(total, 1e-30), np.exp(
        -depth.sum(axis=-2)
    )


def mie_moments(asymmetry: float) -> tuple[float, float, float]:
    """Return the first three Legendre moments of the Cornette–Shanks phase function."""
    g = asymmetry
    scale = 1.5 / (2 + g * g)
    first = g + (2 * g**3 + 3 * g) / 5
    second = g**2 + 12 / 35 * g**4 + 11 / 21 * g**2 + 2 / 15
    third = g**3 + 20 / 63 * g**5 + 23 / 45 * g**3 + 6 / 35 * g
    return scale * first, scale * second, scale * third


def lobe(nu: Array, asymmetry: float) -> Array:
    """Return the sun's lobe after a second scattering in haze, beyond its second moment.

    A lobe of moments χ_l has moments χ_l² after a second scattering. It is approximated by the
    Henyey–Greenstein function of the same third moment, minus that function's first three terms,
    per unit of the field's third moment.
    """
    third = mie_moments(asymmetry)[2]
    g = np.cbrt(third * third)
    whole = (1 - g * g) / (1 + g * g - 2 * g * nu) ** 1.5
    kept = 1 + 3 * g * nu + 2.5 * g * g * (3 * nu * nu - 1)
    return np.asarray((whole - kept) / max(third, 1e-3))


def scatter_field(
    moments: Array, x: Array, z: Array, nu: Array, asymmetry: float
) -> tuple[Array, Array]:
    """Return the light of the field that air and aerosol scatter towards the viewer.

    ``moments`` is (..., 7, w), ``x`` and ``z`` are the view's components towards the sun and the
    zenith, ``nu`` its cosine with the sun. Returns two arrays (..., w), per unit scattering.
    """
    x, z = x[..., None], z[..., None]
    y2 = np.maximum(1 - x * x - z * z, 0)
    mean, dip_x, dip_z, xx, zz, xz, third = (moments[..., k, :] for k in range(MOMENTS))
    quadrupole = xx * (x * x - y2) + zz * (z * z - y2) + 2 * xz * x * z
    dipole = dip_x * x + dip_z * z
    chi = mie_moments(asymmetry)
    by_haze = mean + 3 * chi[0] * dipole + 7.5 * chi[1] * quadrupole
    by_haze = by_haze + np.maximum(third, 0) * lobe(nu, asymmetry)[..., None]
    return mean + 0.75 * quadrupole, np.maximum(by_haze, 0.1 * mean)


def field_irradiance(moments: Array) -> Array:
    """Return the irradiance of the field (..., 7, w) on level ground."""
    series = moments[..., 0, :] + 2 * moments[..., 2, :] + 1.875 * moments[..., 4, :]
    return np.asarray(np.pi * np.maximum(series, 0))


def direction_in_field(mu: Array, mu_s: Array, nu: Array) -> tuple[Array, Array]:
    """Return the components towards the sun's azimuth and the zenith of a view (mu, nu)."""
    x = (nu - mu * mu_s) / np.sqrt(np.maximum(1 - mu_s**2, 1e-8))
    return np.clip(x, -1, 1), mu


class _Rays:
    """Directions from every altitude under every sun; depends on the air's scale heights only."""

    def __init__(
        self, quality: Quality, window: Window, heights: ScaleHeights, azimuths: int, steps: int
    ) -> None:
        mu_s = suns_of(quality, window)[None, :, None, None, None]
        height = np.linspace(0, 1, quality.altitudes) ** 3 * optics.ATMOSPHERE_HEIGHT
        h = np.maximum(height, 1.0)[:, None, None, None, None]
        nodes, weights = np.polynomial.legendre.leggauss(quality.zeniths // 2)
        half = (nodes + 1) / 2
        self.edges = np.concatenate([[0], np.cumsum(weights / 2)])
        self.weight = np.concatenate([weights, weights]) / 4 / azimuths
        mu = np.concatenate([half, -half])[None, None, :, None, None]
        azimuth = np.pi * (np.arange(azimuths) + 0.5) / azimuths
        x = np.sqrt(1 - mu**2) * np.cos(azimuth)[:, None]
        nu = mu * mu_s + x * np.sqrt(1 - mu_s**2)
        d, ground = optics.distance_to_boundary(h, mu)
        u = (np.arange(steps) + 0.5) / steps
        t = d * u**2
        h_t = optics.altitude_along_ray(h, mu, t)
        mu_s_t = sun_cosine(h, mu_s, nu, t, h_t)
        mu_t = np.clip(((GROUND_RADIUS + h) * mu + t) / (GROUND_RADIUS + h_t), -1, 1)

        self._kept: dict[tuple[float, float, bytes], tuple[Array, Array, Array]] = {}
        self.heights = heights
        self.mu_s = mu_s[0, :, 0, 0, 0]
        self.nu = nu[0, ..., 0]  # (s, m, a)
        self.h_t, self.mu_s_t = np.broadcast_arrays(h_t, mu_s_t)  # (h, s, m, a, t)
        self.view = direction_in_field(mu_t, mu_s_t, nu)
        self.density = optics.density(h_t[:, 0, :, 0], heights)  # (h, m, t, 3)
        self.dt = 2 * d[:, 0, :, 0] * u / steps  # (h, m, t)
        self.ground = ground[:, 0, :, 0]  # (h, m, 1)
        self.mu_s_ground = sun_cosine(h, mu_s, nu, d, 0.0)[..., 0]  # (h, s, m, a)
        x_m, z_m = x[0, 0, ..., 0], np.broadcast_to(mu[0, 0, ..., 0], x[0, 0, ..., 0].shape)
        third = 1 / 3
        self.basis = np.stack(
            [np.ones_like(x_m), x_m, z_m, x_m**2 - third, z_m**2 - third, x_m * z_m]
        )

    @cached_property
    def sun(self) -> tuple[Array, Array]:
        """Columns to the sun (..., 3) and its visible share at every step."""
        columns = optics.columns_to_top(self.h_t, self.mu_s_t, self.heights)
        return columns, sun_share(self.h_t, self.mu_s_t)

    @cached_property
    def sun_on_ground(self) -> tuple[Array, Array]:
        """The same where rays meet the ground; the share is times the cosine of incidence."""
        low = np.zeros_like(self.mu_s_ground)
        share = sun_share(low, self.mu_s_ground) * np.maximum(self.mu_s_ground, 0)
        return optics.columns_to_top(low, self.mu_s_ground, self.heights), share

    def once_scattered(self, a: Atmosphere, extinction: Array) -> tuple[Array, Array, Array]:
        """Return sunlight scattered once by air, haze and ground, (h, s, m, a, w) each.

        Air and haze are without their phase functions. The last few results are kept, since a
        fit tries several phase functions with the same air.
        """
        key = (a.aerosol_albedo, a.ground_albedo, extinction.tobytes())
        found = self._kept.get(key)
        if found is None:
            found = self._once_scattered(a, extinction)
            while len(self._kept) >= _AIRS_KEPT:
                self._kept.pop(next(iter(self._kept)), None)
            self._kept[key] = found
        return found

    def _once_scattered(self, a: Atmosphere, extinction: Array) -> tuple[Array, Array, Array]:
        rayleigh, mie, total = scattering(a, extinction, self.density)
        seen, through = attenuate(total, self.dt)
        columns, share = self.sun
        lit = share[..., None] * np.exp(-(columns @ extinction))
        by_air = np.einsum("hmtw,hsmatw->hsmaw", seen * rayleigh, lit)
        by_haze = np.einsum("hmtw,hsmatw->hsmaw", seen * mie, lit)
        columns, share = self.sun_on_ground
        reflected = share[..., None] * np.exp(-(columns @ extinction))
        albedo = a.ground_albedo / np.pi * self.ground * through
        return by_air, by_haze, np.einsum("hmw,hsmaw->hsmaw", albedo, reflected)

    def moments_of(self, radiance: Array) -> Array:
        """Return the moments (h, s, k, w) of a radiance (h, s, m, a, w)."""
        low = np.einsum("kma,m,hsmaw->hskw", self.basis, self.weight, radiance, optimize=True)
        third = 0.5 * self.nu * (5 * self.nu**2 - 3)
        lobe = np.einsum("sma,m,hsmaw->hsw", third, self.weight, radiance, optimize=True)
        return np.concatenate([low, lobe[:, :, None]], axis=2)


# Entries for a window and its neighbors, plus two for the high suns of the eigenvalue.
_rays = lru_cache(maxsize=10)(_Rays)


def _moments(
    a: Atmosphere, extinction: Array, quality: Quality, window: Window, orders: int
) -> Array:
    first, second, transfer = _drawn_orders(a, extinction, quality, window, orders)
    if orders == 2:
        return first
    # Light spreads from order to order, until each order falls by the same factor: the largest
    # eigenvalue of scattering, see shaders/atmosphere/multiple_scattering.glsl.
    eigenvalue = np.minimum(_eigenvalue(a, extinction, quality), 0.95)
    third = second[:, :, :1] * np.sqrt(_gain(first, second) * eigenvalue)
    # The share of the series after its first n - 3 terms; zero for the infinite series.
    omitted = 0.0 if orders == 0 else eigenvalue ** (orders - 3)
    shape = transfer / np.maximum(transfer[:, :1], 1e-30)
    total = first + second
    total[:, :, : transfer.shape[1]] += shape[:, None] * third * (1 - omitted) / (1 - eigenvalue)
    return np.asarray(total)


def _eigenvalue(a: Atmosphere, extinction: Array, quality: Quality) -> Array:
    """Return the factor (w,) by which late orders fall.

    It is the geometric mean of two shares, 3 km up under a high sun: that of even light that
    returns after one more scattering, and that of the second order in the first.
    """
    high_suns = Window(quality.suns - 2, quality.suns - 1)
    first, second, transfer = _drawn_orders(a, extinction, quality, high_suns)
    row = int(_EIGENVALUE_ROW * (quality.altitudes - 1) + 0.5)
    return np.asarray(np.sqrt(transfer[row, 0] * _gain(first, second)[row, -1, 0]))


def _gain(first: Array, second: Array) -> Array:
    """Return the mean of the second order relative to that of the first."""
    return np.minimum(second[:, :, :1] / np.maximum(first[:, :, :1], 1e-30), 1.0)


def _drawn_orders(
    a: Atmosphere, extinction: Array, quality: Quality, window: Window, orders: int = 0
) -> tuple[Array, Array, Array]:
    """Return moments of two orders (h, s, k, w), and (h, k, w) of even light scattered once.

    The second order and the transfer stay empty if ``orders`` is 2.
    """
    rays = _rays(quality, window, a.heights, quality.azimuths, quality.steps)
    first = rays.moments_of(_first_order(a, extinction, rays))
    if orders == 2:
        return first, first[:0], first[:0, 0]
    rays = _rays(quality, window, a.heights, quality.second_azimuths, quality.second_steps)
    rayleigh, mie, total = scattering(a, extinction, rays.density)
    seen, through = attenuate(total, rays.dt)
    reflected = a.ground_albedo * rays.ground * through

    field = Field(first, quality, window, a.heights)
    by_air, by_haze = scatter_field(
        field.look_up(rays.h_t, rays.mu_s_t), *rays.view, rays.nu[..., None], a.aerosol_asymmetry
    )
    second = np.einsum("hmtw,hsmatw->hsmaw", seen * rayleigh, by_air)
    second += np.einsum("hmtw,hsmatw->hsmaw", seen * mie, by_haze)
    ground = field.look_up(np.zeros_like(rays.mu_s_ground), rays.mu_s_ground)
    second += np.einsum("hmw,hsmaw->hsmaw", reflected / np.pi, field_irradiance(ground))
    even = np.einsum("hmtw->hmw", seen * (rayleigh + mie)) + reflected
    transfer = np.einsum("kma,m,hmw->hkw", rays.basis, rays.weight, even, optimize=True)
    return first, rays.moments_of(second), transfer


def _first_order(a: Atmosphere, extinction: Array, rays: _Rays) -> Array:
    """Return the once-scattered radiance in every direction, shape (h, s, m, a, w)."""
    by_air, by_haze, by_ground = rays.once_scattered(a, extinction)
    radiance = optics.rayleigh_phase(rays.nu)[..., None] * by_air
    radiance += _mean_mie_phase(rays, a.aerosol_asymmetry)[..., None] * by_haze
    return np.asarray(radiance + by_ground)


def _mean_mie_phase(rays: _Rays, asymmetry: float) -> Array:
    """Return the aerosol's phase function, averaged over the cell of directions of each node."""
    azimuths = rays.nu.shape[2]
    part = (np.arange(_LOBE_SAMPLES) + 0.5) / _LOBE_SAMPLES
    mu = rays.edges[:-1, None] + np.diff(rays.edges)[:, None] * part
    mu = np.concatenate([mu, -mu])[None, :, None, :, None]
    turn = np.pi * (np.arange(azimuths)[:, None] + part) / azimuths
    turn = turn[None, None, :, None, :]
    mu_s = rays.mu_s[:, None, None, None, None]
    nu = mu * mu_s + np.sqrt((1 - mu**2) * (1 - mu_s**2)) * np.cos(turn)
    return np.asarray(optics.cornette_shanks_phase(nu, asymmetry).mean(axis=(-2, -1)))
