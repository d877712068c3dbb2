"""From spectral radiance to XYZ and linear Rec. 709. Luminance is in kcd m⁻²."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sunwidget.atmosphere.constants import (
    LUMINOUS_EFFICACY,
    SPECTRAL_TO_REC709,
    SPECTRAL_TO_XYZ,
    colour_matching,
)

Array = NDArray[np.float64]


def spectral_to_rec709(radiance: ArrayLike) -> Array:
    """Return linear Rec. 709 in kcd m⁻² from radiance at the shaders' four wavelengths.

    ``radiance`` is (..., 4) in W m⁻² sr⁻¹ nm⁻¹; irradiance gives klx. Colors outside the gamut
    have negative channels.
    """
    return np.asarray(radiance, float) @ SPECTRAL_TO_REC709.T


def spectral_to_xyz(radiance: ArrayLike) -> Array:
    """Return CIE 1931 XYZ in kcd m⁻² from radiance (..., 4) at the shaders' four wavelengths."""
    return np.asarray(radiance, float) @ SPECTRAL_TO_XYZ.T


def spectrum_to_xyz(wavelengths: ArrayLike, radiance: ArrayLike) -> Array:
    """Return CIE 1931 XYZ in kcd m⁻² from a spectrum (..., n) at ``wavelengths`` (n,) in nm.

    Uses the trapezoidal rule; the wavelengths should cover 380-780 nm in steps of 10 or less.
    """
    nm = np.asarray(wavelengths, float)
    weights = colour_matching(nm) * np.gradient(nm)[:, None]
    weights[[0, -1]] /= 1.0 if len(nm) < 2 else 2.0
    return np.asarray(radiance, float) @ weights * (LUMINOUS_EFFICACY / 1000)


def chromaticity(xyz: ArrayLike) -> Array:
    """Return CIE 1931 x, y, shape (..., 2)."""
    xyz = np.asarray(xyz, float)
    return xyz[..., :2] / xyz.sum(axis=-1, keepdims=True)
