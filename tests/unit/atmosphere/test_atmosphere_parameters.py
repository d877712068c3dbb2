"""Density, exponent, scale heights and orders of scattering; aliases and presets."""

import math

import numpy as np
import pytest
from test_atmosphere_sky import AIR, directions

from sunwidget.atmosphere import optics
from sunwidget.atmosphere.color import spectral_to_xyz
from sunwidget.atmosphere.constants import rayleigh_optical_depth
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.presets import PRESETS
from sunwidget.atmosphere.rayleigh import rayleigh_coefficient
from sunwidget.atmosphere.sky import SHADER, SkyTable, sky_radiance
from sunwidget.edit.table import NUMBERS
from sunwidget.validation.path_tracer import trace
from sunwidget.validation.sky_figures import furnace

VIEWS = directions(*np.meshgrid([4.0, 15.0, 40.0, 80.0], [0.0, 60.0, 120.0, 180.0]))


def test_standard_air_is_bodhaines_to_the_bit():
    nm = np.arange(380.0, 781.0, 10.0)
    assert np.array_equal(optics.extinction_coefficients(AIR, nm)[0], rayleigh_coefficient(nm))


def test_the_default_exponent_is_the_slope_of_bodhaines_coefficients():
    blue, red = rayleigh_coefficient([440.0, 680.0])
    assert AIR.rayleigh_exponent == pytest.approx(np.log(blue / red) / np.log(680 / 440), abs=0.005)


def test_another_exponent_tilts_the_spectrum_about_550_nm():
    nm = np.array([440.0, 550.0, 680.0])
    grey = optics.extinction_coefficients(AIR.replace(rayleigh_exponent=0.0), nm)[0]
    # As grey as 4.09 is Bodhaine's slope: his curve is no power law, 1 % away between.
    assert grey == pytest.approx(np.full(3, rayleigh_coefficient(550.0)), rel=0.01)
    assert grey[1] == pytest.approx(rayleigh_coefficient(550.0), rel=1e-12)


def test_the_thesis_preset_has_the_coefficients_that_the_thesis_prints():
    thesis = PRESETS["thesis"]
    printed = np.array([5.8, 13.5, 33.1])
    ours = optics.extinction_coefficients(thesis, [680.0, 550.0, 440.0])[0] * 1e6
    assert np.round(ours, 1) == pytest.approx(printed, abs=1e-9)
    assert thesis.heights == (8000.0, 1200.0)


@pytest.mark.parametrize("heights", [(4000.0, 300.0), (8430.0, 1200.0), (14_000.0, 5000.0)])
def test_columns_follow_the_scale_heights(heights):
    h = np.array([0.0, 500.0, 5000.0, 20_000.0])
    vertical = optics.integrate_columns(h, 1.0, optics.ScaleHeights(*heights), steps=4000)
    # A pure exponential's column is its density times its scale height; above 40 km ours thins
    # faster, which takes up to 2 % at 14 km.
    assert vertical[:, 0] == pytest.approx(heights[0] * np.exp(-h / heights[0]), rel=0.06)
    assert vertical[:, 1] == pytest.approx(heights[1] * np.exp(-h / heights[1]), rel=2e-3)
    assert vertical[:, 2] == pytest.approx(optics.integrate_columns(h, 1.0)[:, 2], rel=1e-3)
    assert vertical[0, 0] * rayleigh_coefficient(550.0) == pytest.approx(
        rayleigh_optical_depth(550.0, scale_height=heights[0]), rel=2e-3
    )


@pytest.mark.parametrize("heights", [(3000.0, 200.0), (15_000.0, 6000.0)])
def test_the_column_table_holds_at_the_ends_of_the_sliders(heights):
    heights = optics.ScaleHeights(*heights)
    rng = np.random.default_rng(0)
    h = 30_000 * rng.random(300) ** 2
    mu = rng.uniform(optics.cosine_of_horizon(h), 1)
    table = optics.columns_to_top(h, mu, heights)
    exact = optics.integrate_columns(h, mu, heights, steps=2000)
    air = AIR.replace(rayleigh_scale_height=heights.air, aerosol_scale_height=heights.aerosol)
    depth = optics.extinction_coefficients(air)
    error = np.abs((table - exact) @ depth) / (1 + exact @ depth)
    # Haze of 200 m lies between two rows of the table and falls faster than they follow.
    assert np.median(error) < 2e-3
    assert error.max() < 0.02


def test_the_aerosols_optical_depth_stays_when_its_scale_height_changes():
    for height in (300.0, 1200.0, 5000.0):
        air = AIR.replace(aerosol_scale_height=height, aerosol_optical_depth=0.2)
        column = optics.integrate_columns(0.0, 1.0, air.heights, steps=4000)[1]
        # A tenth of a millionth of a haze of 5 km lies above the model's top.
        assert column * optics.extinction_coefficients(air, 550.0)[1] == pytest.approx(
            0.2, rel=2e-3
        )


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"air_density": -0.1}, "air_density"),
        ({"rayleigh_exponent": math.nan}, "rayleigh_exponent"),
        ({"rayleigh_scale_height": 0.0}, "rayleigh_scale_height"),
        ({"aerosol_scale_height": -5.0}, "aerosol_scale_height"),
    ],
)
def test_impossible_air_is_refused_by_name(changes, message):
    with pytest.raises(ValueError, match=message):
        Atmosphere(**changes)


def test_turbidity_and_visibility_are_the_aerosol_by_other_names():
    for air in (AIR, PRESETS["thesis"], AIR.replace(rayleigh_scale_height=6000, air_density=0.5)):
        assert air.with_turbidity(4.0).turbidity == pytest.approx(4.0)
        assert air.with_turbidity(1.0).aerosol_optical_depth == 0
        assert air.with_visibility(20_000.0).visibility == pytest.approx(20_000)
        clean = air.replace(aerosol_optical_depth=0)
        assert air.with_visibility(clean.visibility).aerosol_optical_depth == pytest.approx(0)
        assert air.with_turbidity(air.turbidity).aerosol_optical_depth == pytest.approx(
            air.aerosol_optical_depth
        )
        with pytest.raises(ValueError, match="visibility"):
            air.with_visibility(2 * clean.visibility)
    with pytest.raises(ValueError, match="turbidity"):
        AIR.with_turbidity(0.9)
    # Koschmieder's range of standard air at 550 nm.
    assert AIR.replace(aerosol_optical_depth=0).visibility == pytest.approx(340e3, rel=0.01)


def test_no_air_at_all_is_black_and_finite():
    nothing = AIR.replace(air_density=0, aerosol_optical_depth=0, ozone=0)
    assert nothing.visibility == nothing.turbidity == math.inf
    for orders in (0, 1, 2, 3, 5):
        sky = SkyTable(nothing, quality=SHADER, orders=orders).radiance([0, 30, 90], 0, 20)
        assert np.all(sky == 0)
    ground = SkyTable(nothing).radiance(-30, 0, 20)
    assert np.all(ground > 0)
    haze = SkyTable(AIR.replace(air_density=0), quality=SHADER).radiance([0, 30, 90], 0, 20)
    assert np.all(haze > 0)


@pytest.mark.parametrize("orders", [2, 3])
@pytest.mark.parametrize(
    ("air", "sun", "allowed"),
    # The model's error and the noise of 400 paths, as for all orders.
    [(AIR, 40.0, 0.05), (AIR, 5.0, 0.06), (PRESETS["hazy"], 30.0, 0.09)],
)
def test_the_first_orders_agree_with_path_tracing(orders, air, sun, allowed):
    traced, _ = trace(air, VIEWS, sun, paths=400, bounces=orders)
    ours = sky_radiance(air, VIEWS, sun, orders=orders)
    assert np.sqrt(np.mean((ours / traced - 1) ** 2)) < allowed


@pytest.mark.parametrize("air", [AIR, PRESETS["polluted"], AIR.replace(ground_albedo=0.8)])
def test_orders_rise_to_all_of_them(air):
    for sun in (60.0, 5.0, -4.0):
        skies = [sky_radiance(air, VIEWS, sun, orders=n) for n in (1, 2, 3, 5, 16)]
        whole = sky_radiance(air, VIEWS, sun)
        for fewer, more in zip(skies, [*skies[1:], whole], strict=True):
            assert np.all(more > fewer * (1 - 1e-12))
        # Of sixteen orders the sky lacks nothing that is seen, even over snow.
        assert skies[-1] == pytest.approx(whole, rel=0.01)
    alone = sky_radiance(air, VIEWS, 30.0, multiple_scattering=False)
    assert np.array_equal(alone, sky_radiance(air, VIEWS, 30.0, orders=1))


def test_late_orders_keep_their_light():
    # Over white ground in air that absorbs nothing; 3.3 % with each point's own ratio.
    assert furnace() < 0.015
    # Haze at low sun in the blue, where half of all light was scattered more than twice: 7 % too
    # dark with each point's own ratio. The mean over 16 directions has a noise of 1.5 %.
    haze = Atmosphere(aerosol_optical_depth=0.3, aerosol_asymmetry=0.75)
    traced, _ = trace(haze, VIEWS, 10.0, wavelengths=[440.0], paths=1500, bounces=20, seed=3)
    ours = sky_radiance(haze, VIEWS, 10.0, wavelengths=[440.0])
    assert np.mean(ours / traced) == pytest.approx(1, abs=0.04)


@pytest.mark.parametrize("orders", [-1, 1.5])
def test_half_an_order_is_refused(orders):
    with pytest.raises(ValueError, match="orders"):
        SkyTable(AIR, orders=orders)


def test_presets_are_what_they_are_called():
    assert set(PRESETS) == {"clear", "hazy", "polluted", "high_mountain", "thesis"}
    rows = {p.name: p for p in NUMBERS}
    for air in PRESETS.values():
        for name, value in air.parameters().items():
            assert rows[name].minimum <= value <= rows[name].maximum

    def light(name):
        return spectral_to_xyz(sky_radiance(PRESETS[name], VIEWS, 40.0))

    clear, hazy, polluted, high = map(light, ("clear", "hazy", "polluted", "high_mountain"))
    assert hazy[:, 1].mean() > clear[:, 1].mean() > high[:, 1].mean()
    # Soot takes light: more aerosol than in the hazy air, and darker away from the sun.
    assert polluted[-4:, 1].mean() < hazy[-4:, 1].mean()
    blue = [(z[:, 2] / z.sum(axis=1)).mean() for z in (high, clear, hazy)]
    assert blue[0] > blue[1] > blue[2]
