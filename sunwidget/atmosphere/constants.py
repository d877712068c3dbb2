"""Physical constants, read from ``constants.json``; see ``generate_constants.py`` for sources.

``WAVELENGTHS`` are the four wavelengths that the shaders carry in RGBA. Functions take any
wavelength in nanometres; solar irradiance and ozone are tabulated from 360 to 830 nm.
"""

from __future__ import annotations

import json
from importlib.resources import files

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sunwidget.atmosphere.rayleigh import rayleigh_coefficient

Array = NDArray[np.float64]

_DATA = json.loads(files(__package__).joinpath("constants.json").read_text("utf-8"))
_TABLE = {name: np.array(values) for name, values in _DATA["table"].items()}

GROUND_RADIUS: float = _DATA["ground_radius_m"]
TOP_RADIUS: float = _DATA["top_radius_m"]
RAYLEIGH_EXPONENT: float = _DATA["rayleigh_exponent"]
RAYLEIGH_SCALE_HEIGHT: float = _DATA["rayleigh_scale_height_m"]
MESOSPHERE_ALTITUDE: float = _DATA["mesosphere_altitude_m"]
MESOSPHERE_SCALE_HEIGHT: float = _DATA["mesosphere_scale_height_m"]
MIE_SCALE_HEIGHT: float = _DATA["mie_scale_height_m"]
OZONE_LAYER: tuple[float, float, float] = tuple(_DATA["ozone_layer_m"])
MOLECULES_PER_DOBSON: float = _DATA["molecules_per_dobson"]
SUN_ANGULAR_RADIUS_DEG: float = _DATA["sun_angular_radius_deg"]
LUMINOUS_EFFICACY: float = _DATA["luminous_efficacy_lm_W"]

WAVELENGTHS: Array = np.array(_DATA["wavelengths_nm"])
SPECTRAL_TO_XYZ: Array = np.array(_DATA["spectral_to_xyz"])
SPECTRAL_TO_REC709: Array = np.array(_DATA["spectral_to_rec709"])
XYZ_TO_REC709: Array = np.array(_DATA["xyz_to_rec709"])


def rayleigh_optical_depth(
    wavelength_nm: ArrayLike = WAVELENGTHS, *, scale_height: float = RAYLEIGH_SCALE_HEIGHT
) -> Array:
    """Return the vertical Rayleigh optical depth of the model from sea level up."""
    above = np.exp(-MESOSPHERE_ALTITUDE / scale_height)
    thin = MESOSPHERE_SCALE_HEIGHT / RAYLEIGH_SCALE_HEIGHT
    column = scale_height * (1 - above + thin * above)
    return rayleigh_coefficient(wavelength_nm) * column


def ozone_cross_section(wavelength_nm: ArrayLike = WAVELENGTHS) -> Array:
    """Return ozone's absorption cross-section in m² per molecule (Bird & Riordan 1984)."""
    return np.interp(np.asarray(wavelength_nm, float), _TABLE["wavelength_nm"], _TABLE["ozone_m2"])


def solar_irradiance(wavelength_nm: ArrayLike = WAVELENGTHS) -> Array:
    """Return the sun's irradiance above the air in W m⁻² nm⁻¹ (ASTM G-173-03, 10 nm means)."""
    return np.interp(
        np.asarray(wavelength_nm, float), _TABLE["wavelength_nm"], _TABLE["solar_W_m2_nm"]
    )


def colour_matching(wavelength_nm: ArrayLike = WAVELENGTHS) -> Array:
    """Return the CIE 1931 2° color-matching functions, shape (..., 3)."""
    nm = np.asarray(wavelength_nm, float)
    table = _TABLE["cie_1931_xyz"]
    return np.stack(
        [np.interp(nm, _TABLE["wavelength_nm"], table[:, k]) for k in range(3)], axis=-1
    )
