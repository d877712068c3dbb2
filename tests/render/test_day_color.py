"""A blue sky stays blue as the sun sinks by day (sky/day_color.glsl)."""

import dataclasses

import numpy as np
import pytest
from relight_scenes import known_photo

from sunwidget.edit.table import Edit
from sunwidget.renderer import render_pass

AZIMUTH = 120.0
BLUE, GRAY = (0.6, 1.0, 1.9), (1.3, 1.0, 0.7)  # tints of the photo


@pytest.fixture(scope="module")
def day():
    return known_photo(sun=(8.0, 40.0), clouds=False, tint=BLUE).analyze()


def removed(scene, elevation):
    """Log2 of red over blue that the sky ahead, at the horizon, has less than the model's."""
    edit = Edit(sun_azimuth=AZIMUTH, sun_elevation=elevation)
    air = render_pass(scene, edit, "air_edit")[0, :, :3]
    fit = dataclasses.replace(scene.fitted, sun=(AZIMUTH, elevation))
    model = fit.model(np.array([0.0]), np.array([0.573]))[0]
    drawn = air[len(air) // 2]
    return float(np.log2(model[0] / model[2]) - np.log2(drawn[0] / drawn[2]))


def test_a_sun_that_sinks_by_day_leaves_a_blue_sky_bluer_than_the_model(day):
    assert 0.4 < removed(day, 12) < 1.0
    assert 0.1 < removed(day, 20) < removed(day, 12)


def test_a_gray_sky_keeps_the_colors_of_the_model():
    scene = known_photo(sun=(8.0, 40.0), clouds=False, tint=GRAY).analyze()
    assert abs(removed(scene, 12) - removed(scene, 40)) < 0.02


def test_a_sunset_keeps_the_colors_of_the_model(day):
    assert abs(removed(day, 4) - removed(day, 40)) < 0.02
    assert abs(removed(day, -3) - removed(day, 40)) < 0.02


def test_a_sun_that_rises_by_day_gives_the_sky_the_models_colors():
    scene = known_photo(sun=(8.0, 15.0), clouds=False, tint=BLUE).analyze()
    assert abs(removed(scene, 40) - removed(scene, 15)) < 0.02


def test_the_color_follows_the_height_without_a_step(day):
    course = [removed(day, h) for h in np.arange(4, 15, 0.5)]
    assert np.abs(np.diff(course)).max() < 0.25
