"""Scattering by air molecules after Bodhaine et al. 1999."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def rayleigh_coefficient(wavelength_nm: ArrayLike) -> NDArray[np.float64]:
    """Return the scattering coefficient of air in 1/m (15 °C, 1013.25 hPa, 360 ppm CO₂).

    Bodhaine, Wood, Dutton & Slusser, "On Rayleigh Optical Depth Calculations",
    J. Atmos. Oceanic Technol. 16 (1999), eqs. 5, 6, 9, 18, 19, 22, 23.
    """
    metres = np.asarray(wavelength_nm, float) * 1e-9
    um2 = (metres * 1e6) ** -2
    co2 = 360e-6
    n300 = 1 + 1e-8 * (8060.51 + 2480990 / (132.274 - um2) + 17455.7 / (39.32957 - um2))
    n = 1 + (n300 - 1) * (1 + 0.54 * (co2 - 300e-6))
    f_n2 = 1.034 + 3.17e-4 * um2
    f_o2 = 1.096 + 1.385e-3 * um2 + 1.448e-4 * um2**2
    king = (78.084 * f_n2 + 20.946 * f_o2 + 0.934 + 100 * co2 * 1.15) / (99.964 + 100 * co2)
    lorentz = ((n**2 - 1) / (n**2 + 2)) ** 2
    return np.asarray(24 * np.pi**3 * lorentz * king / (metres**4 * 2.546899e25))
