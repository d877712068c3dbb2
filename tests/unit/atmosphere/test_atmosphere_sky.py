"""The reference sky against path tracing and plain physics. Rows 1-8: test_validation.py."""

import numpy as np
import pytest

from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.sky import FAST, SHADER, SkyTable, sky_radiance
from sunwidget.validation import sky_figures

AIR = Atmosphere()


def directions(elevation, azimuth):
    e, a = np.radians(np.broadcast_arrays(elevation, azimuth)).reshape(2, -1)
    return np.stack([np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a)], axis=1)


@pytest.mark.parametrize(
    ("air", "sun", "allowed"),
    [
        # Error of the model plus noise of 200 paths (2 % by day, 5 % in twilight). The design
        # asks for 8 % by day, 15 % at low sun and 35 % below the horizon.
        (AIR, 60.0, 0.05),
        (AIR, 30.0, 0.06),
        (AIR, 5.0, 0.09),
        (AIR, 0.0, 0.12),
        (AIR, -3.0, 0.25),
        (Atmosphere(aerosol_optical_depth=0.3, aerosol_albedo=0.9), 40.0, 0.10),
    ],
)
def test_all_orders_agree_with_path_tracing(air, sun, allowed):
    error, noise = sky_figures.path_tracing_error(air, sun, paths=200)
    # Three per cent by day; in twilight few paths meet the light, and weigh much.
    assert noise.max() < (0.06 if sun > 2 else 0.25)
    assert np.sqrt(np.mean(error**2)) < allowed


def test_the_blue_hour_has_its_colour():
    assert sky_figures.zenith_chromaticity(AIR, -6.0) == pytest.approx([0.231, 0.232], abs=0.01)


@pytest.mark.parametrize("quality", [FAST, SHADER], ids=["fast", "shader"])
@pytest.mark.parametrize(
    "air",
    [
        AIR,
        Atmosphere(aerosol_optical_depth=0, ozone=0),
        Atmosphere(aerosol_optical_depth=0.6, aerosol_asymmetry=0.95, aerosol_albedo=1),
        Atmosphere(altitude=30_000, ground_albedo=1),
        Atmosphere(aerosol_asymmetry=0, angstrom_exponent=2, aerosol_optical_depth=0.6),
    ],
)
def test_sky_is_finite_and_positive_everywhere(air, quality):
    elevation = np.array([-90, -30, -5, -0.1, 0, 1e-3, 1, 30, 89.99, 90])[:, None, None]
    sky = SkyTable(air, quality=quality).radiance(
        elevation,
        np.array([0, 0.1, 90, 180.0])[:, None],
        np.array([-12, -6, -0.27, 0, 0.27, 5, 60, 90]),
    )
    assert np.all(np.isfinite(sky))
    assert np.all(sky >= 0)
    above = sky[4:]
    assert np.all(above > 0)


def test_fast_table_is_close_to_the_full_one_by_day():
    elevation, azimuth = np.array([2, 8, 25, 60, 85.0])[:, None], np.arange(0, 181, 30.0)
    for sun in (60.0, 25.0, 5.0):
        fast = SkyTable(AIR).radiance(elevation, azimuth, sun)
        full = SkyTable(AIR, quality=SHADER).radiance(elevation, azimuth, sun)
        assert np.abs(fast / full - 1).max() < 0.02


def test_sky_mirrors_about_the_sun_and_turns_with_it():
    right = sky_radiance(AIR, directions([5, 40.0], 50.0), 20.0)
    left = sky_radiance(AIR, directions([5, 40.0], -50.0), 20.0)
    turned = sky_radiance(AIR, directions([5, 40.0], 80.0), 20.0, sun_azimuth=30.0)
    assert left == pytest.approx(right, rel=1e-12)
    assert turned == pytest.approx(right, rel=1e-12)


def test_single_scattering_alone_is_darker_everywhere():
    views = directions([1, 20, 60, 90.0], [0, 60, 120, 180.0])
    for sun in (60.0, 10.0, -3.0):
        alone = sky_radiance(AIR, views, sun, multiple_scattering=False)
        assert np.all(alone < sky_radiance(AIR, views, sun))


def test_haze_whitens_and_widens_the_glow():
    views = directions([30.0, 30.0], [5.0, 90.0])
    clear = sky_radiance(AIR.replace(aerosol_optical_depth=0.02), views, 30.0)
    hazy = sky_radiance(AIR.replace(aerosol_optical_depth=0.4), views, 30.0)
    assert np.all(hazy[0] / hazy[1] > clear[0] / clear[1])
    assert (hazy[:, 3] / hazy[:, 0] < clear[:, 3] / clear[:, 0]).all()


def test_sky_darkens_with_height():
    zenith = directions([90.0], [0.0])
    heights = [0.0, 3000.0, 10_000.0, 30_000.0]
    blue = [sky_radiance(AIR.replace(altitude=h), zenith, 40.0)[0, 3] for h in heights]
    assert np.all(np.diff(blue) < 0)
    assert blue[-1] < 0.05 * blue[0]
