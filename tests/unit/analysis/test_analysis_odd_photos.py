"""Photos with no sky, nothing but sky, no light, no colour, no size: warnings, never a crash."""

import numpy as np
import pytest
from analysis_pictures import seascape

import sunwidget as sw
from sunwidget.analysis import frame_inputs


def land(height=40, width=60):
    random = np.random.default_rng(1)
    grain = random.integers(0, 60, (height, width, 1))
    return np.clip(np.array([60, 75, 40]) + grain, 0, 255).astype(np.uint8)


ODD = {
    "no sky": land(),
    "all sky": seascape(60, 40, horizon=1.0, disc=None),
    "one pixel": np.full((1, 1, 3), 90, np.uint8),
    "one row": np.full((1, 5000, 3), 90, np.uint8),
    "one column": np.full((5000, 1, 3), 90, np.uint8),
    "grey": seascape(60, 40).mean(axis=2, keepdims=True).astype(np.uint8).repeat(3, axis=2),
    "black": np.zeros((40, 60, 3), np.uint8),
    "white": np.full((40, 60, 3), 255, np.uint8),
    "night": (seascape(60, 40) // 16).astype(np.uint8),
    "float, brighter than white": seascape(60, 40).astype(np.float32) / 50,
}


@pytest.mark.parametrize("name", ODD)
def test_odd_photos_get_maps_in_range_and_warnings(name):
    scene = sw.analyze(ODD[name])
    shape = ODD[name].shape[:2]
    for field in (scene.sky, scene.clouds, scene.cloud_softness, scene.water):
        assert field.shape == shape
        assert 0 <= field.min() <= field.max() <= 1  # fails on NaN, too
    assert scene.depth.shape == shape
    assert not np.isnan(scene.depth).any()
    for value in frame_inputs.uniforms(scene).values():
        assert np.isfinite(np.ravel(value)).all()
    for parameter, value in scene.automatic.items():
        assert np.isfinite(value), parameter
    assert any("focal length" in warning for warning in scene.warnings)


def test_a_photo_without_sky_says_so_and_what_to_do():
    scene = sw.analyze(land(), sky=np.zeros((40, 60)))
    assert any("No sky found" in w and "Draw a sky stroke" in w for w in scene.warnings)


def test_a_photo_without_sun_says_that_its_place_is_assumed():
    scene = sw.analyze(seascape(60, 40, disc=None), fov=45.0)
    assert scene.sun is None
    assert any("No sun found" in warning for warning in scene.warnings)
    assert -180 <= scene.assumed_sun[0] <= 180


def test_a_skyline_of_roofs_says_that_the_horizon_is_a_guess():
    roofs = np.ones((160, 240), np.float32)
    for house, top in enumerate((60, 95, 40, 110, 75, 52, 102, 68, 85, 45)):
        roofs[top:, 24 * house : 24 * house + 24] = 0
    walls = np.random.default_rng(3).uniform(40, 120, (160, 240, 1)) * np.ones(3)
    picture = np.where(roofs[..., None] > 0, (150, 180, 220), walls).astype(np.uint8)
    scene = sw.analyze(picture, sky=roofs, refine="none", fov=45.0)
    assert scene.horizon.confidence < 0.3
    assert any("is a guess" in warning for warning in scene.warnings)


def test_a_sunset_flood_fill_that_takes_the_whole_sky_warns():
    picture = np.full((40, 60, 3), 250, np.uint8)
    picture[30:] = 20
    scene = sw.analyze(picture, sun=(30, 10), sun_method="flood_fill", fov=45.0)
    assert any("far more than a sun" in warning for warning in scene.warnings)


def test_a_told_sun_far_outside_the_picture_is_kept():
    scene = sw.analyze(seascape(60, 40), sun=(-400, -90), fov=45.0)
    assert (scene.sun.x, scene.sun.y) == (-400, -90)
    assert not scene.sun.visible
