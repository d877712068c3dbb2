"""Sky beside a new sun by day is as bright as photos of suns show it (camera/beside_sun.glsl)."""

import numpy as np
import pytest
from relight_scenes import known_photo

from sunwidget.analysis.sun.camera_glare import angle_to_sun
from sunwidget.edit.table import Edit
from sunwidget.formats.color import LUMINANCE
from sunwidget.renderer import render

SIZE = 180, 120
HAZE = 2.5, 2.4, 2.4  # tint of a photo with a pale sky
SUN = -15.0, 12.0


@pytest.fixture(scope="module")
def haze():
    return known_photo(sun=(150.0, 40.0), size=SIZE, clouds=False, tint=HAZE).analyze(sun="outside")


def levels(scene, edit, sun, *rings):
    """Median linear luminance of the sky between angles from ``sun``, degrees."""
    light = render(scene, edit, dtype="float32") @ LUMINANCE
    away = angle_to_sun(scene.camera, SIZE, sun)
    sky = scene.sky > 0.99
    return [float(np.median(light[sky & (away >= a) & (away < b)])) for a, b in rings]


def moved(**more):
    return Edit(sun_azimuth=SUN[0], sun_elevation=SUN[1], **more)


def test_a_pale_sky_falls_off_from_the_sun_on(haze):
    near, middle, far = levels(haze, moved(), SUN, (3, 5), (8, 10), (11, 13))
    assert middle < 0.66
    assert near - middle > 0.15
    assert middle - far > 0.06


def test_a_sun_behind_thick_cloud_dims_nothing(haze):
    # Beyond the sun's own glow, which the cloud takes.
    (shown,) = levels(haze, moved(cloud_strength=1), SUN, (13, 20))
    (veiled,) = levels(haze, moved(cloud_strength=1, sun_visibility=0.3), SUN, (13, 20))
    assert veiled > 1.08 * shown


def test_a_locked_exposure_dims_nothing(haze):
    (light,) = levels(haze, moved(auto_exposure=0.0, exposure=-1.5), SUN, (8, 10))
    assert light > 0.8


def test_the_users_exposure_stays(haze):
    (plain,) = levels(haze, moved(), SUN, (20, 30))
    (darker,) = levels(haze, moved(exposure=-1), SUN, (20, 30))
    assert -1.15 < np.log2(darker / plain) < -0.75


def test_a_sun_that_comes_into_the_picture_dims_without_a_step(haze):
    azimuths = np.arange(-46, -14, 2.0)
    light = [
        levels(haze, Edit(sun_azimuth=a, sun_elevation=12.0), (25.0, 12.0), (0, 12))[0]
        for a in azimuths
    ]
    assert np.abs(np.diff(np.log2(light))).max() < 0.3
