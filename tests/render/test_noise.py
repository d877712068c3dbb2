"""The photo's noise is measured, and given to what is filled: no more, no less, always the same."""

import dataclasses

import cv2
import numpy as np
import pytest
from relight_scenes import known_photo

from sunwidget.analysis import frame_inputs
from sunwidget.analysis.images.noise import noise_level
from sunwidget.analysis.sun.camera_glare import angle_to_sun
from sunwidget.edit.table import Edit
from sunwidget.photo.photo import open_photo
from sunwidget.renderer import render

ROWS, COLUMNS = np.mgrid[:200, :300]
SKY = np.ones((200, 300), np.float32)


def slope(deviation, seed=2):
    random = np.random.default_rng(seed)
    code = 0.4 + 0.3 * ROWS / 200 + 0.1 * np.sin(COLUMNS / 60)
    code = code[..., None] + deviation * random.standard_normal((200, 300, 1))
    return np.clip(np.repeat(code, 3, 2) * 65535, 0, 65535).astype(np.uint16)


@pytest.mark.parametrize("deviation", [0.002, 0.01, 0.03])
def test_the_deviation_is_recovered_on_a_sloping_sky(deviation):
    assert noise_level(open_photo(slope(deviation)), SKY) == pytest.approx(deviation, rel=0.1)


def test_a_clean_sky_has_none_and_noise_that_clips_is_bounded():
    assert noise_level(open_photo(slope(0)), SKY) < 1e-4
    assert noise_level(open_photo(slope(0.5)), SKY) <= 0.05


def test_leaves_and_edges_are_no_noise():
    picture = slope(0.005)
    picture[150:] = np.random.default_rng(4).integers(0, 65535, (50, 300, 3))
    picture[40:80, 100:160] = 60000
    sky = SKY.copy()
    sky[150:] = 0
    assert noise_level(open_photo(picture), sky) == pytest.approx(0.005, rel=0.2)


def test_without_sky_there_is_no_number_that_is_none():
    assert noise_level(open_photo(slope(0.01)), 0 * SKY) == 0
    assert noise_level(open_photo(np.zeros((1, 1, 3), np.uint8)), np.ones((1, 1), np.float32)) == 0


@pytest.fixture(scope="module")
def noisy():
    return known_photo(size=(240, 160), noise=0.012, clouds=False).analyze()


def rough(picture, where):
    """Deviation of the luminance's fine structure, in code values of 255."""
    code = picture.astype(np.float32) @ np.array([0.2126, 0.7152, 0.0722], np.float32)
    kernel = np.array([[1, -2, 1], [-2, 4, -2], [1, -2, 1]], np.float32) / 6
    return float(np.median(np.abs(cv2.filter2D(code, -1, kernel)[where])) / 0.6745)


MOVED = Edit(sun_azimuth=-15, sun_elevation=12, auto_exposure=0)


def filled(scene):
    """Where the glare hides the photo's own noise: nearer to the sun than the rest of its halo."""
    angle = angle_to_sun(
        scene.camera,
        (scene.width, scene.height),
        (scene.automatic["sun_azimuth"], scene.automatic["sun_elevation"]),
    )
    near = (angle > 0.5) & (angle < 6)
    return (frame_inputs.surface(scene)[..., 0] > 0.98) & near & (scene.sky == 1)


def test_what_was_filled_is_as_rough_as_the_photos_sky(noisy):
    where = filled(noisy)
    assert where.sum() > 100
    beside = (noisy.sky == 1) & (frame_inputs.surface(noisy)[..., 0] < 0.01)
    smooth, grained = (render(noisy, MOVED.replace(grain=g)) for g in (0.0, 1.0))
    expected = rough(smooth, beside)
    assert rough(smooth, where) < 0.5 * expected
    assert 0.6 * expected < rough(grained, where) < 1.5 * expected


def test_where_nothing_was_filled_nothing_is_added(noisy):
    untouched = frame_inputs.surface(noisy)[..., 0] == 0
    smooth, grained = (render(noisy, MOVED.replace(grain=g), dtype="float32") for g in (0.0, 2.0))
    assert np.array_equal(smooth[untouched], grained[untouched])
    assert np.array_equal(
        render(noisy, Edit(grain=2.0), dtype="float32"), render(noisy, dtype="float32")
    )


def test_the_grain_is_the_same_in_every_frame_and_a_clean_photo_has_none(noisy):
    first = render(noisy, MOVED)
    render(noisy, MOVED.replace(sun_azimuth=30))
    assert np.array_equal(render(noisy, MOVED), first)
    clean = dataclasses.replace(noisy, response=noisy.response | {"noise_level": 0.0})
    assert np.array_equal(
        render(clean, MOVED.replace(grain=2), dtype="float32"),
        render(clean, MOVED.replace(grain=0), dtype="float32"),
    )
