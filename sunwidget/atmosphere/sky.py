"""The clear sky in NumPy: what the shaders are compared with and the analysis fits.

Structure after Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering
Technique" (2020): single scattering is marched along each view ray, all further orders come
from a table over altitude and sun height. Radiance is in W m⁻² sr⁻¹ nm⁻¹, float64, at any
wavelengths; the sun's disc is not part of it. Sun and view elevations are apparent ones.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sunwidget.atmosphere import optics
from sunwidget.atmosphere.constants import GROUND_RADIUS, WAVELENGTHS, solar_irradiance
from sunwidget.atmosphere.parameters import Atmosphere

Array = NDArray[np.float64]

NIGHT_COSINE = -0.4


@dataclass(frozen=True)
class Quality:
    """Sample counts of a ``SkyTable``.

    ``suns`` × ``altitudes`` is the table of multiple scattering, ``zeniths`` (even) ×
    ``azimuths`` its directions, ``table_steps`` its march, ``steps`` that of a view ray.
    """

    suns: int
    altitudes: int
    zeniths: int
    azimuths: int
    table_steps: int
    steps: int


SHADER = Quality(suns=64, altitudes=32, zeniths=8, azimuths=8, table_steps=20, steps=32)
FAST = Quality(suns=20, altitudes=10, zeniths=8, azimuths=4, table_steps=10, steps=24)


class SkyTable:
    """All that a sky needs apart from the sun's place: build once, look anywhere.

    Parameters
    ----------
    atmosphere : Atmosphere
        What is in the air, and the camera's altitude.
    wavelengths : array_like, shape (n,), default the shaders' four
        In nanometres, 360–830.
    quality : Quality, default FAST
        ``FAST`` takes about 15 ms and errs 1 % by day; ``SHADER`` samples as the shaders do.
    multiple : bool, default True
        False leaves single scattering alone (Nishita 1993's model).

    See Also
    --------
    sky_radiance : the same for unit vectors, in one call.
    """

    def __init__(
        self,
        atmosphere: Atmosphere,
        wavelengths: ArrayLike = WAVELENGTHS,
        *,
        quality: Quality = FAST,
        multiple: bool = True,
    ) -> None:
        self.atmosphere = atmosphere
        self.wavelengths = np.asarray(wavelengths, float)
        self.quality = quality
        self._extinction = optics.extinction_coefficients(atmosphere, self.wavelengths)
        self._multiple = _multiple_scattering(atmosphere, self._extinction, quality)
        if not multiple:
            self._multiple = np.zeros_like(self._multiple)

    def radiance(
        self, view_elevation: ArrayLike, view_azimuth: ArrayLike, sun_elevation: ArrayLike
    ) -> Array:
        """Return the sky's radiance.

        Parameters
        ----------
        view_elevation : array_like
            Elevation of the view in degrees; below the horizon the ground is seen.
        view_azimuth : array_like
            Azimuth of the view minus that of the sun, in degrees.
        sun_elevation : array_like
            Elevation of the sun's centre in degrees, -12 to 90.

        Returns
        -------
        ndarray, shape (..., n), float64
            W m⁻² sr⁻¹ nm⁻¹, for the broadcast shape of the arguments.
        """
        elevation, azimuth, sun = np.broadcast_arrays(
            *(
                np.radians(np.asarray(v, float))
                for v in (view_elevation, view_azimuth, sun_elevation)
            )
        )
        mu, mu_s = np.sin(elevation), np.sin(sun)
        nu = mu * mu_s + np.cos(elevation) * np.cos(sun) * np.cos(azimuth)
        radiance = self._march(mu.ravel(), mu_s.ravel(), nu.ravel())
        return radiance.reshape(*mu.shape, -1) * solar_irradiance(self.wavelengths)

    def _march(self, mu: Array, mu_s: Array, nu: Array) -> Array:
        a = self.atmosphere
        h = optics.camera_height(a)
        steps = self.quality.steps
        u = (np.arange(steps) + 0.5) / steps
        d, ground = optics.distance_to_boundary(h, mu)
        t = d[:, None] * u**2
        dt = 2 * d[:, None] * u / steps
        h_t = optics.altitude_along_ray(h, mu[:, None], t)
        mu_s_t = _sun_cosine(h, mu_s[:, None], nu[:, None], t, h_t)

        rayleigh, mie, extinction = _coefficients(a, self._extinction, h_t)
        single = transmittance_to_sun(self._extinction, h_t, mu_s_t) * (
            rayleigh * optics.rayleigh_phase(nu)[:, None, None]
            + mie * optics.cornette_shanks_phase(nu, a.aerosol_asymmetry)[:, None, None]
        )
        source = single + (rayleigh + mie) * _look_up(self._multiple, h_t, mu_s_t)
        depth = extinction * dt[..., None]
        before = np.cumsum(depth, axis=1) - depth
        seen = np.exp(-before) * -np.expm1(-depth) / extinction
        radiance = np.sum(seen * source, axis=1)

        below = self._ground(_sun_cosine(h, mu_s, nu, d, 0.0))
        through = np.exp(-depth.sum(axis=1))
        return np.asarray(radiance + np.where(ground[:, None], through * below, 0))

    def _ground(self, mu_s: Array) -> Array:
        """Radiance that the ground sends up where the sun has cosine ``mu_s``."""
        albedo = self.atmosphere.ground_albedo
        sun = np.maximum(mu_s, 0)[:, None] * transmittance_to_sun(self._extinction, 0.0, mu_s)
        mean = _look_up(self._multiple, np.ones_like(mu_s), mu_s)
        sky = np.maximum(2 * np.pi * mean - albedo * sun, 0) / (1 + albedo)
        return np.asarray(albedo / np.pi * (sun + sky))


def sky_radiance(
    atmosphere: Atmosphere,
    directions: ArrayLike,
    sun_elevation: float,
    sun_azimuth: float = 0.0,
    wavelengths: ArrayLike = WAVELENGTHS,
    *,
    quality: Quality = SHADER,
    multiple: bool = True,
) -> Array:
    """Return the sky's radiance towards unit vectors.

    Parameters
    ----------
    atmosphere : Atmosphere
        What is in the air, and the camera's altitude.
    directions : array_like, shape (N, 3)
        Unit vectors in the camera's level frame: x right, y up, z heading.
    sun_elevation, sun_azimuth : float
        Degrees; azimuth relative to the heading, positive to the right.
    wavelengths : array_like, shape (n,)
        Nanometres, 360–830.
    quality, multiple
        See ``SkyTable``.

    Returns
    -------
    ndarray, shape (N, n), float64
        W m⁻² sr⁻¹ nm⁻¹.
    """
    x, y, z = np.asarray(directions, float).T
    elevation = np.degrees(np.arcsin(np.clip(y, -1, 1)))
    azimuth = np.degrees(np.arctan2(x, z)) - sun_azimuth
    table = SkyTable(atmosphere, wavelengths, quality=quality, multiple=multiple)
    return table.radiance(elevation, azimuth, sun_elevation)


def transmittance_to_sun(extinction: Array, h: ArrayLike, mu_s: Array) -> Array:
    """Return transmittance to the sun times the share of its disc above the horizon.

    The share is the shaders' smooth step, within 0.02 of ``optics.visible_fraction``.
    """
    x = np.clip((mu_s - optics.cosine_of_horizon(h)) / optics.SUN_ANGULAR_RADIUS, -1, 1)
    x = 0.5 * (x + 1)
    share = x * x * (3 - 2 * x)
    return np.asarray(share[..., None] * np.exp(-(optics.columns_to_top(h, mu_s) @ extinction)))


def _coefficients(a: Atmosphere, full: Array, h: Array) -> tuple[Array, Array, Array]:
    """Scattering of air, scattering of aerosol, and extinction at altitudes ``h``, in 1/m."""
    density = optics.density(h)
    rayleigh = density[..., :1] * full[0]
    mie = density[..., 1:2] * full[1]
    return rayleigh, mie * a.aerosol_albedo, rayleigh + mie + density[..., 2:] * full[2]


def _sun_cosine(h: ArrayLike, mu_s: Array, nu: Array, t: Array, h_t: ArrayLike) -> Array:
    """Cosine of the sun's zenith angle at distance ``t`` along a ray that starts at ``h``."""
    ahead = (GROUND_RADIUS + np.asarray(h)) * mu_s + t * nu
    return np.clip(ahead / (GROUND_RADIUS + np.asarray(h_t)), -1, 1)


def _look_up(table: Array, h: Array, mu_s: Array) -> Array:
    night = -np.sqrt(np.clip(mu_s / NIGHT_COSINE, 0, 1))
    root = np.where(mu_s < 0, night, np.sqrt(np.maximum(mu_s, 0)))
    return optics.bilinear(table, np.sqrt(h / optics.ATMOSPHERE_HEIGHT), 0.5 + 0.5 * root)


def _multiple_scattering(a: Atmosphere, full: Array, quality: Quality) -> Array:
    """Mean radiance of all orders over altitude (rows) and sun cosine (columns), 1/sr.

    Second order by quadrature with the first scattering's true phase function, then the
    geometric series 1 / (1 - f) of isotropic scattering (Hillaire 2020, eq. 10), where f also
    holds the ground's reflection.
    """
    root = np.linspace(-1, 1, quality.suns)
    mu_s = (root**2 * np.where(root < 0, NIGHT_COSINE, 1))[None, :, None, None, None]
    height = np.linspace(0, 1, quality.altitudes) ** 2 * optics.ATMOSPHERE_HEIGHT
    h = np.maximum(height, 1.0)[:, None, None, None, None]

    nodes, weights = np.polynomial.legendre.leggauss(quality.zeniths // 2)
    half = (nodes + 1) / 2
    mu = np.concatenate([half, -half])[None, None, :, None, None]
    weight = np.concatenate([weights, weights]) / 4
    azimuth = np.pi * (np.arange(quality.azimuths) + 0.5) / quality.azimuths
    nu = mu * mu_s + np.sqrt((1 - mu**2) * (1 - mu_s**2)) * np.cos(azimuth)[:, None]

    rayleigh_phase = optics.rayleigh_phase(nu)
    mie_phase = optics.cornette_shanks_phase(nu, a.aerosol_asymmetry)
    # Keep the energy of a lobe that falls between the nodes.
    energy = 4 * np.pi * np.einsum("hsmak,m->hsk", mie_phase, weight) / quality.azimuths
    mie_phase = mie_phase / energy[:, :, None, None, :]

    steps = quality.table_steps
    u = (np.arange(steps) + 0.5) / steps
    d, ground = optics.distance_to_boundary(h, mu)
    t, dt = d * u**2, 2 * d * u / steps
    h_t = optics.altitude_along_ray(h, mu, t)
    rayleigh, mie, extinction = (c[:, 0, :, 0] for c in _coefficients(a, full, h_t))
    depth = extinction * dt[:, 0, :, 0, :, None]
    before = np.cumsum(depth, axis=-2) - depth
    seen = np.exp(-before) * -np.expm1(-depth) / extinction
    through = np.exp(-depth.sum(axis=-2)) * ground[:, 0, :, 0]

    # Axes: h altitude, s sun, m zenith, a azimuth, t step, w wavelength.
    mu_s_t = _sun_cosine(h, mu_s, nu, t, h_t)
    lit = transmittance_to_sun(full, np.broadcast_to(h_t, mu_s_t.shape), mu_s_t)
    by_air = np.einsum("hsma,hsmatw->hsmtw", rayleigh_phase[..., 0], lit)
    by_haze = np.einsum("hsma,hsmatw->hsmtw", mie_phase[..., 0], lit)
    mean = weight / quality.azimuths
    second = np.einsum("m,hmtw,hmtw,hsmtw->hsw", mean, seen, rayleigh, by_air)
    second += np.einsum("m,hmtw,hmtw,hsmtw->hsw", mean, seen, mie, by_haze)
    mu_s_ground = _sun_cosine(h, mu_s, nu, d, 0.0)[..., 0]
    reflected = np.maximum(mu_s_ground, 0)[..., None] * transmittance_to_sun(
        full, np.zeros_like(mu_s_ground), mu_s_ground
    )
    second += a.ground_albedo / np.pi * np.einsum("m,hmw,hsmaw->hsw", mean, through, reflected)
    transfer = np.einsum("m,hmtw->hw", weight, seen * (rayleigh + mie))
    transfer += a.ground_albedo * np.einsum("m,hmw->hw", weight, through)
    return np.asarray(second / (1 - np.minimum(transfer, 0.999))[:, None])
