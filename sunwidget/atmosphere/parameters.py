"""The state of one clear atmosphere: a handful of numbers, each a field of ``Edit`` too.

Names and ranges are those of the parameter table (``sunwidget/edit.py``); the sun's place is
not part of the atmosphere. Defaults: aerosol of the clear day 2013-05-27 that Kider et al.
measured ("A Framework for the Experimental Comparison of Solar and Skydome Illumination",
2014), optical depth 0.04 · λ_µm^-0.8, as fitted by Bruneton ("A Qualitative and Quantitative
Evaluation of 8 Clear Sky Models", 2017).
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

from sunwidget.atmosphere.constants import (
    MIE_SCALE_HEIGHT,
    RAYLEIGH_SCALE_HEIGHT,
    rayleigh_optical_depth,
)

RANGES: dict[str, tuple[float, float]] = {
    "aerosol_optical_depth": (0.0, 10.0),
    "angstrom_exponent": (-1.0, 4.0),
    "aerosol_asymmetry": (-0.99, 0.99),
    "aerosol_albedo": (0.0, 1.0),
    "ozone": (0.0, 1000.0),
    "ground_albedo": (0.0, 1.0),
    "altitude": (0.0, 90_000.0),
}
"""Physical limits; sliders stay well inside them."""


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
    residual : float or None
        Relative misfit (rms) of the photo's clear sky that this atmosphere leaves; ``None``
        when it was not fitted.

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
    residual: float | None = None

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
        """Return the physical fields by name, as the shaders' uniforms are called."""
        return {name: getattr(self, name) for name in RANGES}

    @property
    def extinction_550(self) -> float:
        """Extinction coefficient at sea level and 550 nm, in 1/m."""
        rayleigh = float(rayleigh_optical_depth(550.0)) / RAYLEIGH_SCALE_HEIGHT
        return rayleigh + self.aerosol_optical_depth / MIE_SCALE_HEIGHT

    @property
    def visibility(self) -> float:
        """Meteorological visibility 3.912 / β_ext(550 nm) at sea level, in metres (Koschmieder)."""
        return 3.912 / self.extinction_550

    @property
    def turbidity(self) -> float:
        """Linke-like turbidity at 550 nm: optical depth of air with aerosol over that of air."""
        rayleigh = float(rayleigh_optical_depth(550.0))
        return (rayleigh + self.aerosol_optical_depth) / rayleigh
