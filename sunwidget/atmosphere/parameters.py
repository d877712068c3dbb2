"""The state of a clear atmosphere: a few numbers, each a field of ``Edit`` too.

Names are those of the parameter table (``sunwidget/edit/table.py``); the sun's position is not
part of the atmosphere. Defaults: aerosol of the clear day 2013-05-27 that Kider et al.
measured ("A Framework for the Experimental Comparison of Solar and Skydome Illumination",
2014), optical depth 0.04 · λ_µm^-0.8, as fitted by Bruneton ("A Qualitative and Quantitative
Evaluation of 8 Clear Sky Models", 2017).
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import NamedTuple

from sunwidget.atmosphere.constants import (
    MIE_SCALE_HEIGHT,
    RAYLEIGH_EXPONENT,
    RAYLEIGH_SCALE_HEIGHT,
    rayleigh_optical_depth,
)
from sunwidget.atmosphere.rayleigh import rayleigh_coefficient

KOSCHMIEDER = 3.912
"""Optical depth at which a black object's contrast has fallen to 2 % (Koschmieder 1924)."""

RANGES: dict[str, tuple[float, float]] = {
    "aerosol_optical_depth": (0.0, 10.0),
    "angstrom_exponent": (-1.0, 4.0),
    "aerosol_asymmetry": (-0.99, 0.99),
    "aerosol_albedo": (0.0, 1.0),
    "ozone": (0.0, 1000.0),
    "ground_albedo": (0.0, 1.0),
    "altitude": (0.0, 90_000.0),
    "air_density": (0.0, 10.0),
    "rayleigh_exponent": (-1.0, 8.0),
    "rayleigh_scale_height": (2_000.0, 20_000.0),
    "aerosol_scale_height": (100.0, 10_000.0),
}
"""Physical limits; sliders stay well inside them."""


class ScaleHeights(NamedTuple):
    """Heights over which air and aerosol thin by a factor e, in metres."""

    air: float = RAYLEIGH_SCALE_HEIGHT
    aerosol: float = MIE_SCALE_HEIGHT


STANDARD_HEIGHTS = ScaleHeights()


@dataclass(frozen=True, kw_only=True)
class Atmosphere:
    """A clear atmosphere: what is in the air, the ground below it, and the camera's height.

    Parameters
    ----------
    aerosol_optical_depth : float
        Vertical aerosol extinction optical depth at 550 nm (AOD), from the sea level up.
    angstrom_exponent : float
        Ångström exponent α: optical depth falls as λ^-α.
    aerosol_asymmetry : float
        Cornette–Shanks asymmetry g of the aerosol's phase function.
    aerosol_albedo : float
        Single-scattering albedo of the aerosol, 0–1.
    ozone : float
        Ozone column in Dobson units.
    ground_albedo : float
        Lambertian albedo of the ground, equal at all wavelengths, 0–1.
    altitude : float
        Camera's height above sea level in metres.
    air_density : float
        Density of the molecules at sea level, relative to standard air; 0 removes the air.
    rayleigh_exponent : float
        Molecules scatter as λ to the power of minus this. The default, 4.09, gives Bodhaine's
        coefficients; other values tilt these about 550 nm.
    rayleigh_scale_height, aerosol_scale_height : float
        Metres over which molecules and aerosol thin by a factor e. They change neither the
        density of the molecules at sea level nor the optical depth of the aerosol.
    residual : float or None
        Relative misfit (rms) between this atmosphere and the photo's clear sky; ``None`` if
        the atmosphere was not fitted.
    confidence : float or None
        Probability that the fitted sky changes with the sun as the photo's would, 0-1
        (analysis/fit/confidence.py); ``None`` if the atmosphere was not fitted.

    Raises
    ------
    ValueError
        For a value that is not finite or physically impossible.
    """

    aerosol_optical_depth: float = 0.04 * 0.55**-0.8
    angstrom_exponent: float = 0.8
    aerosol_asymmetry: float = 0.7
    aerosol_albedo: float = 0.8
    ozone: float = 300.0
    ground_albedo: float = 0.1
    altitude: float = 0.0
    air_density: float = 1.0
    rayleigh_exponent: float = RAYLEIGH_EXPONENT
    rayleigh_scale_height: float = RAYLEIGH_SCALE_HEIGHT
    aerosol_scale_height: float = MIE_SCALE_HEIGHT
    residual: float | None = None
    confidence: float | None = None

    def __post_init__(self) -> None:
        for name, (low, high) in RANGES.items():
            value = float(getattr(self, name))
            if not math.isfinite(value) or not low <= value <= high:
                raise ValueError(f"{name} must be a number from {low:g} to {high:g}, not {value!r}")
            object.__setattr__(self, name, value)

    def replace(self, **changes: float | None) -> Atmosphere:
        """Return a copy with the named fields changed."""
        return dataclasses.replace(self, **changes)  # type: ignore[arg-type]

    def parameters(self) -> dict[str, float]:
        """Return the physical fields by name; the shaders' uniforms have the same names."""
        return {name: getattr(self, name) for name in RANGES}

    @property
    def heights(self) -> ScaleHeights:
        """Scale heights of air and aerosol: the only fields that path lengths depend on."""
        return ScaleHeights(self.rayleigh_scale_height, self.aerosol_scale_height)

    @property
    def extinction_550(self) -> float:
        """Extinction coefficient at sea level and 550 nm, in 1/m."""
        return self._rayleigh_550 + self.aerosol_optical_depth / self.aerosol_scale_height

    @property
    def visibility(self) -> float:
        """Meteorological visibility 3.912 / β_ext(550 nm) at sea level, in metres (Koschmieder)."""
        return KOSCHMIEDER / self.extinction_550 if self.extinction_550 > 0 else math.inf

    def with_visibility(self, metres: float) -> Atmosphere:
        """Return a copy whose aerosol gives a visibility of ``metres`` at sea level.

        Raises
        ------
        ValueError
            When air without aerosol has a lower visibility.
        """
        clean = self.replace(aerosol_optical_depth=0.0)
        # Tolerates a rounding error above the visibility of clean air.
        if not 0 < metres <= clean.visibility * (1 + 1e-9):
            raise ValueError(
                f"visibility must be above 0 and at most {clean.visibility:.0f} m, that of this "
                f"air without aerosol, not {metres!r}"
            )
        haze = max(KOSCHMIEDER / metres - clean.extinction_550, 0.0)
        return self.replace(aerosol_optical_depth=haze * self.aerosol_scale_height)

    @property
    def turbidity(self) -> float:
        """Turbidity at 550 nm: vertical optical depth of air with aerosol over that without."""
        air = self._rayleigh_depth_550
        return 1 + self.aerosol_optical_depth / air if air > 0 else math.inf

    def with_turbidity(self, turbidity: float) -> Atmosphere:
        """Return a copy whose aerosol gives this turbidity; 1 means no aerosol.

        Raises
        ------
        ValueError
            For a turbidity below one.
        """
        if not 1 <= turbidity < math.inf:
            raise ValueError(f"turbidity must be a number from 1, not {turbidity!r}")
        depth = (turbidity - 1) * self._rayleigh_depth_550
        return self.replace(aerosol_optical_depth=depth)

    @property
    def _rayleigh_550(self) -> float:
        return self.air_density * float(rayleigh_coefficient(550.0))

    @property
    def _rayleigh_depth_550(self) -> float:
        return self.air_density * float(
            rayleigh_optical_depth(550.0, scale_height=self.rayleigh_scale_height)
        )
