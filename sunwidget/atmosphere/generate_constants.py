"""Write the constants for both hosts: ``constants.json``, ``constants.glsl``, ``spectrum.glsl``.

Run ``python -m sunwidget.atmosphere.generate_constants`` after any change here. It needs
colour-science (CIE 1931 2° observer) and pvlib (ASTM G-173 spectrum; ozone of Bird & Riordan
1984), which the package itself does not need. Only the small results are committed.
"""

from __future__ import annotations

import importlib
import json
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.atmosphere.rayleigh import rayleigh_coefficient

Array = NDArray[np.float64]

HERE = Path(__file__).parent
JSON_PATH = HERE / "constants.json"
GLSL_PATH = HERE.parent / "shaders" / "atmosphere" / "constants.glsl"
SPECTRUM_PATH = GLSL_PATH.with_name("spectrum.glsl")

WAVELENGTHS = np.array([640.0, 580.0, 510.0, 440.0])
TABLE = np.arange(360.0, 831.0, 5.0)
GROUND_RADIUS = 6_360_000.0
TOP_RADIUS = 6_460_000.0
RAYLEIGH_SCALE_HEIGHT = 8_430.0
# Slope of Bodhaine's coefficients between 440 and 680 nm, 4.086, to a slider's step.
RAYLEIGH_EXPONENT = 4.09
# A single exponential of 8.43 km has the right column but is five times too dense at 80 km, the
# origin of deep twilight. Above 40 km (0.9 % of the column) density falls as in the mesosphere.
MESOSPHERE_ALTITUDE = 40_000.0
MESOSPHERE_SCALE_HEIGHT = 6_500.0
MIE_SCALE_HEIGHT = 1_200.0
OZONE_LAYER = (10_000.0, 25_000.0, 40_000.0)
# 1 DU = 0.01 mm of pure gas at 0 °C and 1 atm: 2.6867e20 molecules per m².
MOLECULES_PER_DOBSON = 2.6867e20
SUN_ANGULAR_RADIUS_DEG = 0.533 / 2
LUMINOUS_EFFICACY = 683.0

# Rec. 709 primaries, D65 white; XYZ to linear RGB (IEC 61966-2-1, Annex F precision).
XYZ_TO_REC709 = np.array(
    [
        [3.2404542, -1.5371385, -0.4985314],
        [-0.9692660, 1.8760108, 0.0415560],
        [0.0556434, -0.2040259, 1.0572252],
    ]
)


def solar_irradiance(at: Array) -> Array:
    """Return the extraterrestrial irradiance (ASTM G-173-03), averaged over ±5 nm, W m⁻² nm⁻¹."""
    from pvlib.spectrum import get_reference_spectra

    spectrum = get_reference_spectra(standard="ASTM G173-03")["extraterrestrial"]
    nm = np.asarray(spectrum.index, float)
    fine = np.arange(-5.0, 5.01, 0.5)
    values = np.interp(at[:, None] + fine, nm, np.asarray(spectrum, float))
    return np.asarray(values.mean(axis=1))


def solar_irradiance_1nm(at: Array) -> Array:
    """Return the extraterrestrial irradiance (ASTM G-173-03) without smoothing, W m⁻² nm⁻¹."""
    from pvlib.spectrum import get_reference_spectra

    spectrum = get_reference_spectra(standard="ASTM G173-03")["extraterrestrial"]
    return np.interp(at, np.asarray(spectrum.index, float), np.asarray(spectrum, float))


def ozone_cross_section(at: Array) -> Array:
    """Return the ozone absorption per molecule in m² (Bird & Riordan, NREL TR-215-2436, 1984).

    Their table (public domain, in pvlib as the coefficients of ``spectrl2``) gives base-e
    coefficients per atm-cm; 1 atm-cm = 1000 DU. It is zero at and below 440 nm, where the true
    optical depth of 300 DU is 0.001.
    """
    # The function shadows its module of the same name; the table has no public name.
    table = vars(importlib.import_module("pvlib.spectrum.spectrl2"))["_SPECTRL2_COEFFS"]
    per_atm_cm = np.interp(at, table["wavelength"], table["ozone_absorption"])
    return per_atm_cm / (1000 * MOLECULES_PER_DOBSON)


def colour_matching(at: Array) -> Array:
    """Return the CIE 1931 2° color-matching functions, (n, 3)."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import colour

        functions = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    nm = np.asarray(functions.wavelengths, float)
    values = np.asarray(functions.values, float)
    return np.stack([np.interp(at, nm, values[:, k]) for k in range(3)], axis=1)


def training_spectra(at: Array) -> Array:
    """Return smooth spectra of skies and suns, relative to sunlight, (n, wavelengths).

    They are scattering spectra (white, aerosol, Rayleigh, twice scattered) through every
    combination of air, aerosol and ozone between the sun at the zenith and in twilight.
    """
    rayleigh = rayleigh_coefficient(at) * RAYLEIGH_SCALE_HEIGHT
    ozone = ozone_cross_section(at) * MOLECULES_PER_DOBSON
    ratio = at / 550.0
    sources = (
        np.ones_like(at),
        ratio**-1.0,
        ratio**-2.5,
        ratio**-4.0,
        1 - np.exp(-rayleigh * 4),
    )
    spectra: list[Array] = []
    for air in (0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 30.0):
        for aerosol, alpha in ((0.0, 1.0), (0.06, 0.8), (0.3, 1.4), (0.3, 0.3)):
            for dobson in (0.0, 300.0, 2000.0, 5000.0):
                depth = air * (rayleigh + aerosol * ratio**-alpha) + dobson * ozone
                spectra.extend(source * np.exp(-depth) for source in sources)
    return np.array(spectra)


def spectral_to_xyz(solar: Array) -> Array:
    """Return the 3×4 matrix from radiance at the four wavelengths to XYZ in kcd m⁻².

    Y is luminance. Least squares over ``training_spectra``, each weighted by 1/Y, so that bright
    and dark skies have the same weight.
    """
    nm = np.arange(360.0, 831.0, 1.0)
    weights = solar_irradiance_1nm(nm)[:, None] * colour_matching(nm)
    spectra = training_spectra(nm)
    xyz = spectra @ weights * (LUMINOUS_EFFICACY / 1000)
    samples = np.stack([np.interp(WAVELENGTHS, nm, row) for row in spectra]) * solar
    scale = 1 / xyz[:, 1:2]
    matrix, *_ = np.linalg.lstsq(samples * scale, xyz * scale, rcond=None)
    return np.asarray(matrix.T, float)


def constants() -> dict[str, Any]:
    """Return all constants of both hosts as plain JSON types."""
    solar = solar_irradiance(WAVELENGTHS)
    to_xyz = spectral_to_xyz(solar)
    rounded = {
        "wavelengths_nm": WAVELENGTHS,
        "rayleigh_per_m": rayleigh_coefficient(WAVELENGTHS),
        "ozone_m2": ozone_cross_section(WAVELENGTHS),
        "solar_W_m2_nm": solar,
        "spectral_to_xyz": to_xyz,
        "spectral_to_rec709": XYZ_TO_REC709 @ to_xyz,
    }
    table = {
        "wavelength_nm": TABLE,
        "solar_W_m2_nm": solar_irradiance(TABLE),
        "ozone_m2": ozone_cross_section(TABLE),
        "cie_1931_xyz": colour_matching(TABLE),
    }
    return {
        "ground_radius_m": GROUND_RADIUS,
        "top_radius_m": TOP_RADIUS,
        "rayleigh_exponent": RAYLEIGH_EXPONENT,
        "rayleigh_scale_height_m": RAYLEIGH_SCALE_HEIGHT,
        "mesosphere_altitude_m": MESOSPHERE_ALTITUDE,
        "mesosphere_scale_height_m": MESOSPHERE_SCALE_HEIGHT,
        "mie_scale_height_m": MIE_SCALE_HEIGHT,
        "ozone_layer_m": list(OZONE_LAYER),
        "molecules_per_dobson": MOLECULES_PER_DOBSON,
        "sun_angular_radius_deg": SUN_ANGULAR_RADIUS_DEG,
        "luminous_efficacy_lm_W": LUMINOUS_EFFICACY,
        "xyz_to_rec709": XYZ_TO_REC709.tolist(),
        **{k: _rounded(v) for k, v in rounded.items()},
        "table": {k: _rounded(v) for k, v in table.items()},
    }


def glsl(c: dict[str, Any]) -> str:
    """Return the text of ``atmosphere/constants.glsl``."""

    def vec4(values: list[float]) -> str:
        return "vec4(" + ", ".join(_float(v) for v in values) + ")"

    # Optical depth per metre (or per Dobson unit) keeps every exponent within float range.
    per_dobson = [x * c["molecules_per_dobson"] for x in c["ozone_m2"]]
    columns = np.array(c["spectral_to_rec709"]).T
    matrix = ",\n    ".join(", ".join(_float(v) for v in column) for column in columns)
    low, peak, high = c["ozone_layer_m"]
    radius = np.radians(c["sun_angular_radius_deg"])
    limb = limb_darkening_exponents(np.array(c["wavelengths_nm"]))
    lines = [
        "// Generated by sunwidget/atmosphere/generate_constants.py; do not edit.",
        "// Wavelengths in RGBA: 640, 580, 510, 440 nm. Lengths in metres.",
        "#define Length float",
        "#define Angle float",
        "#define Number float",
        "#define DimensionlessSpectrum vec4",
        "#define ScatteringSpectrum vec4  // 1/m",
        "#define IrradianceSpectrum vec4  // W m^-2 nm^-1",
        "#define RadianceSpectrum vec4  // W m^-2 sr^-1 nm^-1",
        "",
        "const float kPi = 3.14159265358979;",
        f"const Length kGroundRadius = {_float(c['ground_radius_m'])};",
        f"const Length kTopRadius = {_float(c['top_radius_m'])};",
        f"const Length kAtmosphereHeight = {_float(c['top_radius_m'] - c['ground_radius_m'])};",
        "// Standard air; the shaders use the uniforms of atmosphere/atmosphere.glsl instead.",
        f"const Number kRayleighExponent = {_float(c['rayleigh_exponent'])};",
        f"const Length kRayleighScaleHeight = {_float(c['rayleigh_scale_height_m'])};",
        "// Above 40 km (0.9 % of the column) air thins faster; deep twilight comes from there.",
        f"const Length kMesosphereAltitude = {_float(c['mesosphere_altitude_m'])};",
        f"const Length kMesosphereScaleHeight = {_float(c['mesosphere_scale_height_m'])};",
        f"const Length kOzoneBottom = {_float(low)};",
        f"const Length kOzonePeak = {_float(peak)};",
        f"const Length kOzoneTop = {_float(high)};",
        f"const Angle kSunAngularRadius = {_float(radius)};",
        f"const vec4 kWavelengths = {vec4(c['wavelengths_nm'])};  // nm",
        "// Bodhaine et al. 1999, sea level.",
        f"const ScatteringSpectrum kRayleighScattering = {vec4(c['rayleigh_per_m'])};",
        "// Vertical absorption optical depth of one Dobson unit, Bird & Riordan 1984.",
        f"const vec4 kOzoneDepthPerDobson = {vec4(per_dobson)};",
        "// ASTM G-173-03 extraterrestrial, mean over 10 nm.",
        f"const IrradianceSpectrum kSolarIrradiance = {vec4(c['solar_W_m2_nm'])};",
        "// Limb darkening mu^a; Neckel & Labs 1994 by power law.",
        f"const vec4 kLimbDarkening = {vec4(list(limb))};",
        "// Radiance at the four wavelengths to linear Rec. 709 in kcd m^-2.",
        f"const mat4x3 kSpectralToRec709 = mat4x3(\n    {matrix});",
        "",
    ]
    return "\n".join(lines)


def spectrum_glsl(c: dict[str, Any]) -> str:
    """Return the text of ``atmosphere/spectrum.glsl``: coefficients at any wavelength."""
    nm = np.array(c["table"]["wavelength_nm"])
    seen = (nm >= 380) & (nm <= 780)
    # Per Dobson unit, as in constants.glsl: cross-sections per molecule leave a float's range.
    ozone = np.array(c["table"]["ozone_m2"])[seen] * c["molecules_per_dobson"]
    values = [_float(float(f"{v:.6g}")) for v in ozone]
    rows = ",\n    ".join(", ".join(values[i : i + 8]) for i in range(0, len(values), 8))
    columns = np.array(c["spectral_to_xyz"]).T
    matrix = ",\n    ".join(", ".join(_float(v) for v in column) for column in columns)
    return f"""\
// Generated by sunwidget/atmosphere/generate_constants.py; do not edit.
// Scattering and absorption at any wavelength (nm), for the plotted spectra.

// Rayleigh scattering coefficient of standard air at sea level, 1/m: Bodhaine et al. 1999, eqs. 5,
// 6, 9, 18, 19, 22, 23. `excess` is the refractive index minus one, to keep its digits.
Number GetBodhaineScattering(Number wavelength) {{
  float um2 = 1e6 / (wavelength * wavelength);
  float excess = 1e-8 * (8060.51 + 2480990.0 / (132.274 - um2) + 17455.7 / (39.32957 - um2))
      * (1.0 + 0.54 * 60e-6);
  float f_n2 = 1.034 + 3.17e-4 * um2;
  float f_o2 = 1.096 + (1.385e-3 + 1.448e-4 * um2) * um2;
  float king = (78.084 * f_n2 + 20.946 * f_o2 + 0.934 + 0.036 * 1.15) / (99.964 + 0.036);
  float square = excess * (2.0 + excess);
  float lorentz = square / (3.0 + square);
  return 24.0 * kPi * kPi * kPi / 25.46899 * um2 * um2 * lorentz * lorentz * king;
}}

// Vertical absorption optical depth of one Dobson unit, Bird & Riordan 1984: 380-780 nm by 5.
const float kOzoneTable[{len(values)}] = float[{len(values)}](
    {rows});

Number GetOzoneDepthPerDobson(Number wavelength) {{
  float place = clamp((wavelength - 380.0) / 5.0, 0.0, {len(values) - 1}.0);
  int low = min(int(place), {len(values) - 2});
  return mix(kOzoneTable[low], kOzoneTable[low + 1], place - float(low));
}}

// Radiance at the four wavelengths to CIE 1931 XYZ in kcd m^-2.
const mat4x3 kSpectralToXyz = mat4x3(
    {matrix});
"""


def limb_darkening_exponents(wavelength_nm: Array) -> Array:
    """Return the exponent a of the disc's profile μ^a: 0.397, 0.503, 0.652 at 680, 550, 440 nm."""
    return np.interp(wavelength_nm, [440.0, 550.0, 680.0], [0.652, 0.503, 0.397])


def _rounded(values: Array) -> Any:
    return np.vectorize(lambda v: float(f"{v:.7g}"))(values).tolist()


def _float(value: float) -> str:
    text = f"{value:.9g}"
    return text if any(mark in text for mark in ".e") else text + ".0"


def main() -> None:
    """Write the three files."""
    c = constants()
    JSON_PATH.write_text(json.dumps(c, indent=1) + "\n", encoding="utf-8")
    GLSL_PATH.parent.mkdir(parents=True, exist_ok=True)
    GLSL_PATH.write_text(glsl(c), encoding="utf-8")
    SPECTRUM_PATH.write_text(spectrum_glsl(c), encoding="utf-8")


if __name__ == "__main__":
    main()
