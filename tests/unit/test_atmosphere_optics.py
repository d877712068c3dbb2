"""Closed forms and the direct beam: rows 1, 2 and 8 of the validation in docs/atmosphere.md."""

import numpy as np
import pytest
from scipy.integrate import quad

from sunwidget.atmosphere import optics
from sunwidget.atmosphere.color import chromaticity, spectrum_to_xyz
from sunwidget.atmosphere.constants import ozone_cross_section, solar_irradiance
from sunwidget.atmosphere.multiple import mie_moments
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.rayleigh import rayleigh_coefficient
from sunwidget.atmosphere.sun import disc_radiance, limb_darkening, refraction, true_elevation


def over_the_sphere(phase, weight=lambda mu: 1.0):
    # The lobe's peak is pointed out, or a narrow one would be stepped over.
    return 2 * np.pi * quad(lambda mu: float(phase(mu)) * weight(mu), -1, 1, points=[0.9, 0.99])[0]


def test_rayleigh_phase_integrates_to_one():
    assert over_the_sphere(optics.rayleigh_phase) == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize("g", [-0.5, 0, 0.3, 0.7, 0.8, 0.95])
def test_cornette_shanks_integrates_to_one_and_has_its_closed_mean_cosine(g):
    def phase(mu):
        return optics.cornette_shanks_phase(mu, g)

    closed = 3 * g * (4 + g * g) / (5 * (2 + g * g))
    assert over_the_sphere(phase) == pytest.approx(1, abs=1e-9)
    assert over_the_sphere(phase, lambda mu: mu) == pytest.approx(closed, abs=1e-9)


@pytest.mark.parametrize("g", [0.2, 0.7, 0.9])
def test_moments_of_the_aerosol_are_those_of_its_phase_function(g):
    legendre = (
        lambda mu: mu,
        lambda mu: (3 * mu**2 - 1) / 2,
        lambda mu: (5 * mu**3 - 3 * mu) / 2,
    )
    integrals = [
        over_the_sphere(lambda mu: optics.cornette_shanks_phase(mu, g), p) for p in legendre
    ]
    assert mie_moments(g) == pytest.approx(integrals, abs=1e-9)


def test_cornette_shanks_has_the_published_values_forward_and_back():
    assert optics.cornette_shanks_phase(1, 0.76) == pytest.approx(2.83000, rel=1e-5)
    assert optics.cornette_shanks_phase(-1, 0.76) == pytest.approx(0.0071760, rel=1e-4)


def test_rayleigh_coefficients_are_bodhaines():
    assert rayleigh_coefficient([440, 550, 680]) * 1e6 == pytest.approx(
        [28.71, 11.487, 4.848], rel=2e-4
    )


def test_air_mass_of_air_aerosol_and_ozone():
    # Elevations 30, 10, 5, 0. Air: pure exponential of 8.43 km; ours thins faster above 40 km,
    # which moves it by up to 0.16 % at the horizon.
    expected = [
        [1.992, 1.999, 1.977],
        [5.540, 5.724, 5.153],
        [10.086, 11.21, 8.119],
        [34.442, 91.25, 11.60],
    ]
    assert optics.relative_air_mass([30, 10, 5, 0]) == pytest.approx(np.array(expected), rel=2e-3)


@pytest.mark.parametrize("elevation", [90, 30, 5, 1])
def test_transmittance_multiplies_along_a_ray(elevation):
    mu, far = np.sin(np.radians(elevation)), 12_000.0
    h = float(optics.altitude_along_ray(0, mu, far))
    # Cosine of the same ray's zenith angle where it has risen to h.
    mu_far = (6_360_000 * mu + far) / (6_360_000 + h)
    whole = optics.integrate_columns(0, mu, steps=4000)
    rest = optics.integrate_columns(h, mu_far, steps=4000)
    t = (np.arange(4000) + 0.5) / 4000 * far
    near = optics.density(optics.altitude_along_ray(0, mu, t)).sum(axis=0) * far / 4000
    assert near + rest == pytest.approx(whole, rel=1e-4)


def test_column_table_agrees_with_integration():
    rng = np.random.default_rng(0)
    h = 30_000 * rng.random(400) ** 2
    mu = rng.uniform(optics.cosine_of_horizon(h), 1)
    table, exact = optics.columns_to_top(h, mu), optics.integrate_columns(h, mu, steps=2000)
    # In optical depth: 1e-3 of it changes transmittance by less than the eye or a sensor sees.
    depth = optics.extinction_coefficients(Atmosphere())
    error = (table - exact) @ depth
    assert np.abs(error / (1 + exact @ depth)).max() < 2e-3


def test_direct_beam_agrees_with_astm_g173():
    spectrum = pytest.importorskip("pvlib.spectrum").get_reference_spectra(standard="ASTM G173-03")
    nm = np.array(spectrum.index, float)
    windows = [(400, 575), (600, 625), (660, 680), (745, 745), (775, 775)]
    clear = np.any([(nm >= low) & (nm <= high) for low, high in windows], axis=0)
    nm, measured = nm[clear], np.array(spectrum["direct"])[clear]
    top = np.array(spectrum["extraterrestrial"])[clear]
    # AM1.5 of the standard: AOD 0.084 at 500 nm, alpha 1.14, 343.8 DU of ozone. The sun is
    # compared above the air by its own spectrum, so that only the air is tested.
    air = Atmosphere(
        aerosol_optical_depth=0.084 * (550 / 500) ** -1.14, angstrom_exponent=1.14, ozone=343.8
    )
    elevation = 90 - 48.236
    ours = top * optics.direct_irradiance(air, elevation, nm) / solar_irradiance(nm)
    error = ours / measured - 1
    assert np.sqrt(np.mean(error**2)) < 0.015


def test_ozone_takes_out_orange():
    assert ozone_cross_section(600) == pytest.approx(4.9e-25, rel=0.12)
    assert ozone_cross_section(450) < ozone_cross_section(600) / 10


@pytest.mark.parametrize(
    ("elevation", "x", "y"),
    [(60, 0.3368, 0.3478), (10, 0.3859, 0.3906), (2, 0.5138, 0.4285), (0, 0.6165, 0.3772)],
)
def test_sun_reddens_along_its_anchors(elevation, x, y):
    nm = np.arange(380, 781, 5.0)
    beam = optics.direct_irradiance(Atmosphere(), elevation, nm)
    assert chromaticity(spectrum_to_xyz(nm, beam)) == pytest.approx([x, y], abs=1.5e-3)


def test_disc_integrates_to_the_direct_irradiance():
    edges = np.linspace(0, 1, 401)
    radius = (edges[1:] + edges[:-1]) / 2
    ring = np.pi * np.diff(edges**2)
    assert ring @ limb_darkening(radius) / np.pi == pytest.approx(np.ones(4), abs=2e-3)
    air = Atmosphere()
    solid_angle = ring * np.radians(0.533 / 2) ** 2
    whole = solid_angle @ disc_radiance(air, 40.0, radius * 0.533 / 2)
    assert whole == pytest.approx(optics.direct_irradiance(air, 40.0), rel=5e-3)


def test_disc_is_dark_outside_itself_and_below_the_horizon():
    assert np.all(disc_radiance(Atmosphere(), 10.0, 0.3) == 0)
    assert np.all(disc_radiance(Atmosphere(), -0.5, 0.1) == 0)


def test_visible_share_of_the_disc_passes_a_half_at_the_horizon():
    share = optics.visible_fraction(np.radians([-0.3, -0.2665, 0, 0.2665, 0.3]))
    assert share == pytest.approx([0, 0, 0.5, 1, 1], abs=1e-9)


def test_refraction_lifts_the_sun_by_half_a_degree_at_the_horizon():
    assert refraction(0.0) * 60 == pytest.approx(34.5, abs=0.3)
    assert refraction(90.0) == pytest.approx(0, abs=2e-4)
    assert true_elevation(10.0) == pytest.approx(10 - 5.4 / 60, abs=2e-3)
    below = refraction(np.linspace(-12, 0, 100))
    assert np.all(np.isfinite(below))
    assert np.all(np.diff(below) <= 0)


@pytest.mark.parametrize("bad", [float("nan"), float("inf"), -0.1])
def test_impossible_air_is_refused_by_name(bad):
    with pytest.raises(ValueError, match="aerosol_optical_depth"):
        Atmosphere(aerosol_optical_depth=bad)


def test_visibility_is_koschmieders():
    air = Atmosphere(aerosol_optical_depth=0.3)
    extinction = optics.extinction_coefficients(air, 550.0)[:2].sum()
    assert air.visibility == pytest.approx(3.912 / extinction, rel=3e-3)
