"""The clear sky in NumPy: the model that the analysis fits and the reference for the shaders.

Structure after Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering
Technique" (2020): single scattering is marched along each view ray, and all further orders come
from a table over altitude and sun height (``multiple.py``). Radiance is in W m⁻² sr⁻¹ nm⁻¹,
float64, at any wavelengths, without the sun's disc. Sun and view elevations are apparent.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sunwidget.atmosphere import multiple, optics
from sunwidget.atmosphere.constants import GROUND_RADIUS, WAVELENGTHS, solar_irradiance
from sunwidget.atmosphere.multiple import FAST, SHADER, Quality
from sunwidget.atmosphere.parameters import Atmosphere

__all__ = ["FAST", "SHADER", "Quality", "SkyTable", "sky_radiance"]

Array = NDArray[np.float64]


class SkyTable:
    """Tables of a sky for any sun: build once, evaluate in any direction.

    Parameters
    ----------
    atmosphere : Atmosphere
        What is in the air, and the camera's altitude.
    wavelengths : array_like, shape (n,), default the shaders' four
        In nanometres, 360–830.
    quality : Quality, default FAST
        ``FAST`` is for fitting (1 % by day); ``SHADER`` samples as the shaders do.
    multiple_scattering : bool, default True
        False keeps single scattering only (the model of Nishita 1993), as ``orders`` 1 does.
    orders : int, default 0
        Orders of scattering: 0 for all of them, n for the first n (Nishita et al. 1996).

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
        multiple_scattering: bool = True,
        orders: int = 0,
    ) -> None:
        if orders < 0 or orders != int(orders):
            raise ValueError(f"orders must be 0 (all) or a number of orders, not {orders!r}")
        self.atmosphere = atmosphere
        self.wavelengths = np.asarray(wavelengths, float)
        self.quality = quality
        self.orders = int(orders) if multiple_scattering else 1
        self._extinction = optics.extinction_coefficients(atmosphere, self.wavelengths)
        self._fields: dict[multiple.Window, multiple.Field] = {}

    def radiance(
        self, view_elevation: ArrayLike, view_azimuth: ArrayLike, sun_elevation: ArrayLike
    ) -> Array:
        """Return the sky's radiance.

        Parameters
        ----------
        view_elevation : array_like
            Elevation of the view in degrees; below the horizon the view shows the ground.
        view_azimuth : array_like
            Azimuth of the view minus that of the sun, in degrees.
        sun_elevation : array_like
            Elevation of the sun's center in degrees, -12 to 90. One sun, or suns close
            together, take the least time: the table covers the requested suns only.

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
        field = None if self.orders == 1 else self._field(sun)
        radiance = self._march(mu.ravel(), mu_s.ravel(), nu.ravel(), field)
        return radiance.reshape(*mu.shape, -1) * solar_irradiance(self.wavelengths)

    def _field(self, sun: Array) -> multiple.Field:
        window = multiple.window_for(sun, self.quality)
        if window not in self._fields:
            self._fields[window] = multiple.light_field(
                self.atmosphere, self._extinction, self.quality, window, self.orders
            )
        return self._fields[window]

    def _march(self, mu: Array, mu_s: Array, nu: Array, field: multiple.Field | None) -> Array:
        a = self.atmosphere
        h = optics.camera_height(a)
        groups, size = self.quality.groups, self.quality.group_steps
        u = (np.arange(groups * size) + 0.5) / (groups * size)
        d, ground = optics.distance_to_boundary(h, mu)
        dt = 2 * d[:, None] * u / (groups * size)
        h_t, mu_s_t, _ = _along(h, mu, mu_s, nu, d[:, None] * u**2)
        density = optics.density(h_t, a.heights)
        rayleigh, mie, total = multiple.scattering(a, self._extinction, density)
        sun = self._sunlight(h_t, mu_s_t)
        by_air = sun * optics.rayleigh_phase(nu)[:, None, None]
        by_haze = sun * optics.cornette_shanks_phase(nu, a.aerosol_asymmetry)[:, None, None]
        mu_s_ground = multiple.sun_cosine(h, mu_s, nu, d, 0.0)
        irradiance = np.maximum(mu_s_ground, 0)[:, None] * self._sunlight(0.0, mu_s_ground)
        if field is not None:
            center = (np.arange(groups) + 0.5) / groups
            h_g, mu_s_g, mu_g = _along(h, mu, mu_s, nu, d[:, None] * center**2)
            view = multiple.direction_in_field(mu_g, mu_s_g, nu[:, None])
            more = multiple.scatter_field(
                field.look_up(h_g, mu_s_g), *view, nu[:, None], a.aerosol_asymmetry
            )
            by_air += np.repeat(more[0], size, axis=1)
            by_haze += np.repeat(more[1], size, axis=1)
            around = field.look_up(np.zeros_like(mu_s_ground), mu_s_ground)
            irradiance = irradiance + multiple.field_irradiance(around)
        seen, through = multiple.attenuate(total, dt)
        radiance = np.sum(seen * (rayleigh * by_air + mie * by_haze), axis=1)
        below = through * a.ground_albedo / np.pi * irradiance
        return np.asarray(radiance + np.where(ground[:, None], below, 0))

    def _sunlight(self, h: Array | float, mu_s: Array) -> Array:
        columns = optics.columns_to_top(h, mu_s, self.atmosphere.heights)
        return multiple.sun_share(h, mu_s)[..., None] * np.exp(-(columns @ self._extinction))


def sky_radiance(
    atmosphere: Atmosphere,
    directions: ArrayLike,
    sun_elevation: float,
    sun_azimuth: float = 0.0,
    wavelengths: ArrayLike = WAVELENGTHS,
    *,
    quality: Quality = SHADER,
    multiple_scattering: bool = True,
    orders: int = 0,
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
    quality, multiple_scattering, orders
        See ``SkyTable``.

    Returns
    -------
    ndarray, shape (N, n), float64
        W m⁻² sr⁻¹ nm⁻¹.
    """
    x, y, z = np.asarray(directions, float).T
    elevation = np.degrees(np.arcsin(np.clip(y, -1, 1)))
    azimuth = np.degrees(np.arctan2(x, z)) - sun_azimuth
    table = SkyTable(
        atmosphere,
        wavelengths,
        quality=quality,
        multiple_scattering=multiple_scattering,
        orders=orders,
    )
    return table.radiance(elevation, azimuth, sun_elevation)


def _along(h: float, mu: Array, mu_s: Array, nu: Array, t: Array) -> tuple[Array, Array, Array]:
    """Return altitude, sun cosine and view cosine at distances ``t`` (N, steps) along rays."""
    h_t = optics.altitude_along_ray(h, mu[:, None], t)
    mu_s_t = multiple.sun_cosine(h, mu_s[:, None], nu[:, None], t, h_t)
    mu_t = ((GROUND_RADIUS + h) * mu[:, None] + t) / (GROUND_RADIUS + h_t)
    return h_t, mu_s_t, np.clip(mu_t, -1, 1)
