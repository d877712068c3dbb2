"""One set of constants on both hosts, and four wavelengths that stand for all."""

import re

import numpy as np
import pytest

from sunwidget.atmosphere import constants
from sunwidget.atmosphere.color import chromaticity, spectral_to_xyz, spectrum_to_xyz
from sunwidget.atmosphere.parameters import RANGES, Atmosphere
from sunwidget.atmosphere.sky import SkyTable
from sunwidget.atmosphere.sun import limb_darkening_exponent
from sunwidget.edit.table import NUMBERS
from sunwidget.renderer.shader_source import read_shader


def glsl_constant(name):
    text = re.sub(r"//.*", "", read_shader("atmosphere/constants.glsl"))
    match = re.search(rf"const \w+ {name} = ([^;]+);", text)
    assert match, name
    numbers = re.findall(r"-?\d+\.\d*(?:e[-+]?\d+)?|-?\d+e[-+]?\d+", match[1])
    return np.array([float(n) for n in numbers])


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("kGroundRadius", constants.GROUND_RADIUS),
        ("kTopRadius", constants.TOP_RADIUS),
        ("kRayleighScaleHeight", constants.RAYLEIGH_SCALE_HEIGHT),
        ("kMesosphereAltitude", constants.MESOSPHERE_ALTITUDE),
        ("kMesosphereScaleHeight", constants.MESOSPHERE_SCALE_HEIGHT),
        ("kRayleighExponent", constants.RAYLEIGH_EXPONENT),
        ("kOzonePeak", constants.OZONE_LAYER[1]),
        ("kSunAngularRadius", np.radians(constants.SUN_ANGULAR_RADIUS_DEG)),
        ("kWavelengths", constants.WAVELENGTHS),
        ("kRayleighScattering", constants.rayleigh_coefficient(constants.WAVELENGTHS)),
        ("kOzoneDepthPerDobson", constants.ozone_cross_section() * 2.6867e20),
        ("kSolarIrradiance", constants.solar_irradiance()),
        ("kLimbDarkening", limb_darkening_exponent()),
        ("kSpectralToRec709", constants.SPECTRAL_TO_REC709.T.ravel()),
    ],
)
def test_shaders_and_numpy_hold_the_same_constant(name, value):
    # Seven digits are written; a float has no more.
    assert glsl_constant(name) == pytest.approx(np.atleast_1d(value), rel=2e-6)


def test_committed_constants_are_what_the_generator_writes():
    pytest.importorskip("pvlib")
    pytest.importorskip("colour")
    from sunwidget.atmosphere.generate_constants import constants as generate
    from sunwidget.atmosphere.generate_constants import glsl, spectrum_glsl

    generated = generate()
    assert generated["solar_W_m2_nm"] == pytest.approx(constants.solar_irradiance(), rel=1e-6)
    assert (
        read_shader("atmosphere/constants.glsl").splitlines()[:20]
        == glsl(generated).splitlines()[:20]
    )
    # The matrices at the end are least squares, to which another BLAS gives other last digits.
    committed, made = read_shader("atmosphere/spectrum.glsl"), spectrum_glsl(generated)
    assert committed.split("const mat4x3")[0] == made.split("const mat4x3")[0]


def test_every_parameter_of_the_air_is_a_parameter_of_the_edit():
    assert set(RANGES) <= {p.name for p in NUMBERS}


def test_every_value_of_a_slider_is_an_atmosphere():
    rows = {p.name: p for p in NUMBERS}
    for name in RANGES:
        for value in (rows[name].minimum, rows[name].maximum):
            assert getattr(Atmosphere(**{name: value}), name) == value


def uv(xyz):
    x, y = np.moveaxis(chromaticity(xyz), -1, 0)
    scale = 1 / (-2 * x + 12 * y + 3)
    return np.stack([4 * x * scale, 9 * y * scale], axis=-1)


def test_four_wavelengths_give_the_colour_of_the_whole_spectrum():
    # Skies that the matrix was not fitted to: the model's own, in other air.
    nm = np.arange(380, 781, 10.0)
    elevation, azimuth = np.array([3, 10, 30, 60, 90.0])[:, None], np.array([0, 60, 180.0])
    errors = []
    for sun in (50.0, 8.0, 1.0, -4.0):
        for air in (Atmosphere(aerosol_optical_depth=0.15, angstrom_exponent=1.2, ozone=380),):
            full = spectrum_to_xyz(nm, SkyTable(air, nm).radiance(elevation, azimuth, sun))
            four = spectral_to_xyz(SkyTable(air).radiance(elevation, azimuth, sun))
            errors.append(np.linalg.norm(uv(full) - uv(four), axis=-1))
            assert np.abs(four[..., 1] / full[..., 1] - 1).max() < 0.04
    # A just noticeable difference is about 0.004.
    assert np.mean(errors) < 0.002
    assert np.max(errors) < 0.008
