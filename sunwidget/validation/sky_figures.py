"""Figures of the clear sky that ``validation`` compares with published ones."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sunwidget.atmosphere import optics
from sunwidget.atmosphere.color import chromaticity, spectral_to_xyz
from sunwidget.atmosphere.constants import GROUND_RADIUS, solar_irradiance
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.sky import SHADER, SkyTable, sky_radiance
from sunwidget.validation.path_tracer import trace

Array = NDArray[np.float64]


def over_the_sphere(
    phase: Callable[[float], ArrayLike], weight: Callable[[float], float] = lambda _: 1.0
) -> float:
    """Return the integral of a phase function times ``weight`` over all directions."""
    from scipy.integrate import quad

    # The points mark the lobe's peak, which the integration might miss.
    found = quad(
        lambda mu: float(np.asarray(phase(mu))) * weight(mu), -1, 1, points=[0.9, 0.99, 0.999]
    )
    return 2 * math.pi * float(found[0])


def along_a_ray(elevation: float, far: float = 12_000.0) -> float:
    """Return the relative error of the columns to ``far`` plus those beyond, against the whole."""
    mu = math.sin(math.radians(elevation))
    h = float(optics.altitude_along_ray(0, mu, far))
    mu_far = (GROUND_RADIUS * mu + far) / (GROUND_RADIUS + h)
    whole = optics.integrate_columns(0, mu, steps=4000)
    rest = optics.integrate_columns(h, mu_far, steps=4000)
    t = (np.arange(4000) + 0.5) / 4000 * far
    near = optics.density(optics.altitude_along_ray(0, mu, t)).sum(axis=0) * far / 4000
    return float(np.abs((near + rest) / whole - 1).max())


def furnace() -> float:
    """Return the deviation from uniform light in non-absorbing air over white ground.

    Sunlight summed over all suns is uniform light. By conservation of energy, the mean radiance
    anywhere is then the sun's over 4 pi.
    """
    air = Atmosphere(aerosol_albedo=1, ozone=0, ground_albedo=1, aerosol_optical_depth=0.1)
    suns = np.degrees(np.arcsin((np.arange(60) + 0.5) / 30 - 1))
    x, w = np.polynomial.legendre.leggauss(16)
    elevation = np.degrees(np.arcsin(x))[:, None, None]
    azimuth = 15 + 30 * np.arange(6.0)[:, None]
    sky = SkyTable(air, quality=SHADER).radiance(elevation, azimuth, suns)
    scattered = np.einsum("m,masw->w", w / 2, sky) / 6 / len(suns)
    direct = optics.direct_irradiance(air, suns).mean(axis=0) / (4 * math.pi)
    share = 4 * math.pi * (scattered + direct) / solar_irradiance()
    return float(np.abs(share - 1).max())


def path_tracing_error(air: Atmosphere, sun: float, paths: int) -> tuple[Array, Array]:
    """Return the rms deviation from path tracing and the rms of its noise, at four wavelengths.

    Over 16 directions from 4° to 80° of elevation, towards the sun, beside it and away from it.
    The deviation includes the noise.
    """
    elevation, azimuth = np.radians(np.meshgrid([4.0, 15, 40, 80], [0.0, 60, 120, 180]))
    level = np.cos(elevation)
    views = np.stack(
        [level * np.sin(azimuth), np.sin(elevation), level * np.cos(azimuth)], axis=-1
    ).reshape(-1, 3)
    traced, noise = trace(air, views, sun, paths=paths, bounces=10)
    error = sky_radiance(air, views, sun) / traced - 1
    rms, own = (np.sqrt(np.mean(part**2, axis=0)) for part in (error, noise / traced))
    return rms, own


def illuminance(table: SkyTable, suns: ArrayLike, nodes: int = 16) -> Array:
    """Return the sky's illuminance on level ground in lux, for each of ``suns`` (degrees)."""
    x, w = np.polynomial.legendre.leggauss(nodes)
    mu, w = (x + 1) / 2, w / 2
    elevation = np.degrees(np.arcsin(mu))[:, None, None]
    azimuth = 180 * (np.arange(nodes)[:, None] + 0.5) / nodes
    radiance = table.radiance(elevation, azimuth, np.atleast_1d(suns))
    spectrum = 2 * math.pi * np.einsum("m,masw->sw", w * mu, radiance) / nodes
    return np.asarray(1000 * spectral_to_xyz(spectrum)[:, 1], float)


def zenith_chromaticity(air: Atmosphere, sun: float) -> Array:
    """Return CIE x, y of the zenith under a sun of this elevation."""
    return chromaticity(spectral_to_xyz(SkyTable(air, quality=SHADER).radiance(90, 0, sun)))


def zenith_x(air: Atmosphere, sun: float) -> float:
    """Return CIE x of the zenith, which is small for blue."""
    return float(zenith_chromaticity(air, sun)[0])
