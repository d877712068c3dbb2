"""The precomputed sky: all orders of scattering for every altitude, view and sun, in one table.

After Bruneton & Neyret, "Precomputed Atmospheric Scattering" (2008) and Bruneton's second
implementation (2017), with sunwidget's own shaders (``shaders/bruneton/``, run on EGL by
``precomputation.py``). A table is made once for one state of the air; moving the sun and the
camera then costs nothing. It differs from Bruneton's table: it has four wavelengths; single
scattering by haze has a separate table; samples are densest where light varies most, with
logarithmic interpolation (``bruneton/coordinates.glsl``); and orders are iterated on a quadrature
of directions, so that the large table is filled once at the end instead of for every order.
"""

from __future__ import annotations

import dataclasses
import math
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from sunwidget.atmosphere import optics
from sunwidget.atmosphere.constants import GROUND_RADIUS, solar_irradiance
from sunwidget.atmosphere.multiple import TWILIGHT_SCALE_HEIGHT
from sunwidget.progress import Progress
from sunwidget.renderer.bruneton import table_cache
from sunwidget.renderer.bruneton.precomputation import (
    ALL_ORDERS,
    PASSES,
    SIZES,
    Precomputation,
    Size,
    measured_rates,
)
from sunwidget.renderer.shader_source import resolve_includes

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from sunwidget.atmosphere.parameters import Atmosphere

    Floats = NDArray[np.float32]

# As in bruneton/coordinates.glsl.
_LOWEST_SUN, _TERMINATOR, _DAY, _NIGHT = -0.314, 0.36, 0.1, 0.08
_DARK = np.float32(1e-12)


@dataclass(frozen=True)
class BrunetonTable:
    """Radiance per unit of solar irradiance (1/sr), divided by a guess of its fall in twilight.

    Parameters
    ----------
    atmosphere : Atmosphere
        The air of the table; its altitude does not affect the table.
    orders : int
        Orders of scattering, 0 for all.
    tables : ndarray, shape (3, r, mu_s, mu, nu, 4), float32
        Single scattering by air and by haze, both without phase function; all other light.
    seconds : float
        Duration of the precomputation; 0 for a table from the cache.
    """

    atmosphere: Atmosphere
    orders: int
    tables: Floats
    seconds: float = 0.0

    def slice(self, altitude: float | None = None) -> Floats:
        """Return the table at one altitude of the camera, as the texture of ``bruneton_view``.

        Parameters
        ----------
        altitude : float, optional
            Metres above sea level; default: the altitude of the atmosphere.

        Returns
        -------
        ndarray, shape (3 · mu_s + 1, mu · nu, 4), float32
            The three tables, one above the other, 1.5 MB. The last row has the altitude, the
            aerosol's asymmetry and the sample counts of nu and mu_s.
        """
        if altitude is not None:
            atmosphere = self.atmosphere.replace(altitude=altitude)
        else:
            atmosphere = self.atmosphere
        h = optics.camera_height(atmosphere)
        _, r, mu_s, mu, nu, _ = self.tables.shape
        place = min(_altitude_coordinate(h) * (r - 1), r - 1.0)
        low = min(int(place), r - 2)
        part = np.float32(place - low)
        # Logarithmic interpolation, since densities fall exponentially.
        below, above = (np.log(np.maximum(self.tables[:, i], _DARK)) for i in (low, low + 1))
        level = np.exp(below * (1 - part) + above * part)
        out = np.zeros((3 * mu_s + 1, mu * nu, 4), np.float32)
        out[:-1] = level.reshape(3 * mu_s, mu * nu, 4)
        out[-1, 0] = h, self.atmosphere.aerosol_asymmetry, nu, mu_s
        return out

    def radiance(
        self,
        view_elevation: ArrayLike,
        view_azimuth: ArrayLike,
        sun_elevation: ArrayLike,
        altitude: float | None = None,
    ) -> NDArray[np.float64]:
        """Return the sky's radiance in W m⁻² sr⁻¹ nm⁻¹, shape (..., 4): see ``SkyTable.radiance``.

        NumPy twin of the look-up in ``bruneton/view.glsl``.
        """
        elevation, azimuth, sun = np.broadcast_arrays(
            *(
                np.radians(np.asarray(v, float))
                for v in (view_elevation, view_azimuth, sun_elevation)
            )
        )
        cut = self.slice(altitude)
        h = float(cut[-1, 0, 0])
        _, _, suns, views, azimuths, _ = self.tables.shape
        tables = cut[:-1].reshape(3, suns, views, azimuths, 4).astype(float)
        mu, mu_s = np.sin(elevation), np.sin(sun)
        cosine = np.cos(azimuth)
        places = (
            _sun_coordinate(mu_s, suns),
            _view_coordinate(h, mu, views),
            _azimuth_coordinate(cosine, azimuths),
        )
        found = _interpolate(tables, places) * _fading(mu_s)[..., None]
        nu = np.clip(mu * mu_s + np.cos(elevation) * np.cos(sun) * cosine, -1, 1)
        haze = optics.cornette_shanks_phase(nu, self.atmosphere.aerosol_asymmetry)
        radiance = (
            found[0] * optics.rayleigh_phase(nu)[..., None] + found[1] * haze[..., None] + found[2]
        )
        return np.asarray(radiance * solar_irradiance())


def bruneton_table(
    atmosphere: Atmosphere,
    orders: int = 0,
    size: str = "small",
    progress: Progress | None = None,
    *,
    cache: bool = True,
) -> BrunetonTable:
    """Return the precomputed sky of ``atmosphere``, from the cache or newly computed.

    Parameters
    ----------
    atmosphere : Atmosphere
        What is in the air; only ``slice`` and ``radiance`` use its altitude.
    orders : int, default 0
        Orders of scattering and reflection, 1–16; 0 for all.
    size : {"small", "full"}
        16×64×32×8 or 32×128×32×8 samples of r, mu, mu_s and nu.
    progress : callable, optional
        Called with (fraction, message) about six times a second; raise in it to cancel.
    cache : bool, default True
        Whether to use the user's cache folder.

    Raises
    ------
    ValueError
        For an unknown size or a number of orders out of range.
    RendererError
        If this machine has no EGL.

    See Also
    --------
    bruneton_cost : estimate of the time that it takes.
    """
    if not 0 <= orders <= 16 or orders != int(orders):
        raise ValueError(f"orders must be a whole number from 0 (all) to 16, not {orders!r}")
    samples = _size(size)
    key = _key(atmosphere, orders, samples)
    r, mu, mu_s, nu = samples.table
    tables = table_cache.read(key, (3, r, mu_s, mu, nu, 4)) if cache else None
    if tables is not None:
        return BrunetonTable(atmosphere, orders, tables)
    start = time.perf_counter()
    tables = Precomputation(atmosphere, int(orders), samples, progress).run()
    made = BrunetonTable(atmosphere, orders, tables, time.perf_counter() - start)
    if cache:
        table_cache.write(key, tables)
    return made


def is_cached(atmosphere: Atmosphere, orders: int = 0, size: str = "small") -> bool:
    """Return whether the cache has the table of ``bruneton_table``."""
    return table_cache.path(_key(atmosphere, orders, _size(size))).is_file()


def bruneton_cost(size: str = "small", orders: int = 0) -> float:
    """Estimate the seconds of a precomputation on this machine, to about a factor of 1.5.

    The estimate is measured: a few rows of the two slowest passes are drawn (0.3 s, once).
    """
    samples = _size(size)
    texels = samples.texels()
    rates = measured_rates()
    repeated = (orders or ALL_ORDERS) - 1
    table = texels["bruneton/table"]
    work = texels["bruneton/first"] + 2 * table, table
    seconds = work[0] * rates["single"] + work[1] * rates["gather"]
    each = texels["bruneton/incident"] * rates["gather"]
    each += texels["bruneton/source"] * rates["source"]
    return float(seconds + repeated * each)


def _size(name: str) -> Size:
    if name not in SIZES:
        raise ValueError(f"size must be 'small' or 'full', not {name!r:.40}")
    return SIZES[name]


def _key(atmosphere: Atmosphere, orders: int, size: Size) -> str:
    air = {name: value for name, value in atmosphere.parameters().items() if name != "altitude"}
    # The expanded shaders are part of the key, so that a changed shader makes new tables.
    shaders = [resolve_includes(f"{name}.glsl") for name in ("atmosphere/columns", *PASSES)]
    return table_cache.key(air, orders, dataclasses.astuple(size), shaders)


def _altitude_coordinate(h: float) -> float:
    return math.sqrt(math.sqrt(h * (2 * GROUND_RADIUS + h)) / optics.LONGEST_HORIZON)


def _view_coordinate(h: float, mu: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Twin of GetViewCoordinate in ``bruneton/coordinates.glsl``."""
    rho = math.sqrt(h * (2 * GROUND_RADIUS + h))
    d, ground = optics.distance_to_boundary(h, mu)
    shortest = optics.ATMOSPHERE_HEIGHT - h
    down = np.clip((d - h) / (rho - h), 0, 1)
    up = np.clip((d - shortest) / (rho + optics.LONGEST_HORIZON - shortest), 0, 1)
    last = count // 2 - 1
    return np.where(ground, last * down, last + 1 + last * np.sqrt(up))


def _fading(mu_s: NDArray[np.float64]) -> NDArray[np.float64]:
    """Twin of GetFading in ``bruneton/coordinates.glsl``."""
    below = np.minimum(mu_s, 0)
    return np.asarray(np.exp(-0.5 * GROUND_RADIUS / TWILIGHT_SCALE_HEIGHT * below**2))


def _sun_coordinate(mu_s: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Twin of GetSunCoordinate in ``bruneton/coordinates.glsl``."""
    e = np.arcsin(np.clip(mu_s, -1, 1))
    night = _TERMINATOR * (1 - np.arcsinh(-e / _NIGHT) / np.arcsinh(-_LOWEST_SUN / _NIGHT))
    day = _TERMINATOR + (1 - _TERMINATOR) * np.arcsinh(e / _DAY) / np.arcsinh(0.5 * np.pi / _DAY)
    return np.asarray(np.clip(np.where(e < 0, night, day), 0, 1) * (count - 1))


def _azimuth_coordinate(cosine: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Twin of GetAzimuthCoordinate in ``bruneton/coordinates.glsl``."""
    angle = np.arccos(np.clip(cosine, -1, 1))
    index = np.minimum(np.floor(angle / np.pi * (count - 1)), count - 2)
    near, far = np.cos(np.pi * index / (count - 1)), np.cos(np.pi * (index + 1) / (count - 1))
    return np.asarray(index + np.clip((near - cosine) / (near - far), 0, 1))


def _interpolate(
    tables: NDArray[np.float64], places: tuple[NDArray[np.float64], ...]
) -> NDArray[np.float64]:
    """Sample ``tables`` (3, sun, view, azimuth, 4) at ``places``; returns (3, ..., 4).

    Interpolation is linear in view and azimuth, logarithmic between suns.
    """
    corners = [
        np.clip(p.astype(int), 0, n - 2) for p, n in zip(places, tables.shape[1:4], strict=True)
    ]
    sun, view, azimuth = ((p - c)[..., None] for p, c in zip(places, corners, strict=True))

    def at(side: int) -> NDArray[np.float64]:
        found = [
            tables[:, corners[0] + side, corners[1] + b, corners[2] + c]
            for b in (0, 1)
            for c in (0, 1)
        ]
        upper = found[0] * (1 - azimuth) + found[1] * azimuth
        lower = found[2] * (1 - azimuth) + found[3] * azimuth
        return np.log(np.maximum(upper * (1 - view) + lower * view, _DARK))

    return np.asarray(np.exp(at(0) * (1 - sun) + at(1) * sun))
