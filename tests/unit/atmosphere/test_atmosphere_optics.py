"""Phase functions, columns, disc, refraction. Closed forms and the beam: test_validation.py."""

import numpy as np
import pytest

from sunwidget.atmosphere import optics
from sunwidget.atmosphere.constants import ozone_cross_section
from sunwidget.atmosphere.multiple import mie_moments
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.rayleigh import rayleigh_coefficient
from sunwidget.atmosphere.sun import disc_radiance, limb_darkening, refraction, true_elevation
from sunwidget.validation.sky_figures import over_the_sphere


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


def test_rayleigh_coefficients_are_bodhaines():
    assert rayleigh_coefficient([440, 550, 680]) * 1e6 == pytest.approx(
        [28.71, 11.487, 4.848], rel=2e-4
    )


def test_column_table_agrees_with_integration():
    rng = np.random.default_rng(0)
    h = 30_000 * rng.random(400) ** 2
    mu = rng.uniform(optics.cosine_of_horizon(h), 1)
    table, exact = optics.columns_to_top(h, mu), optics.integrate_columns(h, mu, steps=2000)
    # In optical depth: 1e-3 of it changes transmittance by less than the eye or a sensor sees.
    depth = optics.extinction_coefficients(Atmosphere())
    error = (table - exact) @ depth
    assert np.abs(error / (1 + exact @ depth)).max() < 2e-3


def test_ozone_takes_out_orange():
    assert ozone_cross_section(600) == pytest.approx(4.9e-25, rel=0.12)
    assert ozone_cross_section(450) < ozone_cross_section(600) / 10


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
