"""Continuing a picture over what is not known: push-pull, and a mirrored texture."""

import cv2
import numpy as np
import pytest

from sunwidget.analysis.images.fill import (
    fill_by_layers,
    fill_by_pyramid,
    mirror_texture,
)

ROWS, COLUMNS = np.mgrid[:60, :90]


def smooth_field():
    x, y = COLUMNS / 90, ROWS / 60
    return np.stack([0.5 + 0.3 * x, 0.4 - 0.2 * y + 0.1 * x, 0.2 * x * y], -1).astype(np.float32)


def hole(radius):
    return (np.hypot(COLUMNS - 40, ROWS - 30) >= radius).astype(np.float32)


@pytest.mark.parametrize("radius", [3, 8, 15])
def test_a_hole_in_a_smooth_field_is_filled_smoothly(radius):
    field, weight = smooth_field(), hole(radius)
    broken = np.where(weight[..., None] > 0, field, 9).astype(np.float32)
    filled = fill_by_pyramid(broken, weight)
    # A pyramid continues the mean, not the slope: a share of the field's change over the hole.
    assert np.abs(filled - field).max() < 0.25 * 0.3 * (2 * radius) / 60 + 0.03
    assert np.array_equal(filled[weight == 1], field[weight == 1])


def test_what_lies_in_the_hole_has_no_influence():
    field, weight = smooth_field(), hole(10)
    first = fill_by_pyramid(np.where(weight[..., None] > 0, field, 0).astype(np.float32), weight)
    second = fill_by_pyramid(np.where(weight[..., None] > 0, field, 5).astype(np.float32), weight)
    assert np.allclose(first, second, atol=1e-5)


def test_a_constant_stays_constant_under_any_weight():
    weight = np.random.default_rng(3).random((37, 53)).astype(np.float32) ** 8
    filled = fill_by_pyramid(np.full((37, 53, 3), 0.7, np.float32), weight)
    assert np.allclose(filled, 0.7, atol=1e-5)


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (2, 30), (64, 3), (5, 5)])
def test_no_weight_at_all_gives_zeros_not_nan(shape):
    filled = fill_by_pyramid(np.ones((*shape, 3), np.float32), np.zeros(shape, np.float32))
    assert np.array_equal(filled, np.zeros((*shape, 3), np.float32))


def test_a_gap_above_the_ground_has_the_layers_beside_it():
    # A sky that darkens towards the ground and the right, with a gap that reaches the ground.
    down, right = ROWS / 60, COLUMNS / 90
    sky = np.repeat((-3 * down**4 - right * (1 + down))[..., None], 3, -1).astype(np.float32)
    known = hole(18) * (ROWS < 45)
    broken = np.where(known[..., None] > 0, sky, 9).astype(np.float32)
    gap = (hole(18) == 0) & (ROWS < 45)
    layered, alike = (
        np.abs(fill(broken, known) - sky)[gap].max() for fill in (fill_by_layers, fill_by_pyramid)
    )
    assert 2 * layered < alike
    assert np.abs(fill_by_layers(broken, known) - sky)[known > 0].max() < 1e-5


def bands():
    """A texture layered as skies are, of mean 0."""
    wave = np.sin(ROWS / 3.0) + 0.3 * np.sin(COLUMNS / 5.0)
    return np.repeat(wave[..., None], 3, -1).astype(np.float32)


@pytest.mark.parametrize("radius", [7, 12, 18])
def test_layers_go_on_through_a_gap(radius):
    beside = hole(radius)
    broken = np.where(beside[..., None] > 0, bands(), 9).astype(np.float32)
    continued = mirror_texture(broken, beside, beside)
    assert np.array_equal(continued[beside > 0], bands()[beside > 0])
    gap = beside == 0
    assert np.corrcoef(continued[gap].ravel(), bands()[gap].ravel())[0, 1] > 0.85
    assert 0.75 < continued[gap].std() / bands()[gap].std() < 1.3


def test_streaks_go_on_through_a_gap_even_if_its_sides_differ():
    slanting = np.sin((ROWS + 0.12 * COLUMNS) / 1.6)  # one side is shifted against the other
    slanting = np.repeat(slanting[..., None], 3, -1).astype(np.float32)
    beside = hole(14)
    inside = np.hypot(COLUMNS - 40, ROWS - 30) < 8
    assert mirror_texture(slanting, beside, beside)[inside].std() > 0.5 * slanting[inside].std()


def test_single_clouds_are_not_copied():
    clouds = np.sin(COLUMNS / 1.3) * np.sin(ROWS / 1.7) * np.where(COLUMNS < 40, 1, -1)
    clouds = np.repeat(clouds[..., None], 3, -1).astype(np.float32)
    beside = hole(12)
    inside = np.hypot(COLUMNS - 40, ROWS - 30) < 6  # farther out those at the rim fade
    assert mirror_texture(clouds, beside, beside)[inside].std() < 0.5 * clouds[inside].std()


def test_where_nothing_is_known_no_texture_is_made_up():
    beside = hole(10)
    continued = mirror_texture(bands(), beside, 0 * beside)
    assert np.abs(continued[beside == 0]).max() < 1e-3


def test_what_lies_above_a_gap_fades_into_it():
    values = np.repeat(np.where(ROWS < 20, 1.0, 0.0)[..., None], 3, -1).astype(np.float32)
    beside = np.where((ROWS >= 20) & (ROWS < 50) & (abs(COLUMNS - 45) < 25), 0, 1)
    continued = mirror_texture(values, beside.astype(np.float32), np.ones_like(beside, np.float32))
    middle = continued[20:50, 45, 0]
    assert middle[0] > 0.5
    assert middle[15] < 0.6 * middle[0]


def spots(random):
    """A texture of soft spots of mean 0, all over the picture."""
    spots = cv2.GaussianBlur(random.standard_normal(ROWS.shape), (0, 0), 2.5)
    return np.repeat((spots / spots.std())[..., None], 3, -1).astype(np.float32)


def at_the_side(radius):
    """1 beside a gap at the picture's left side."""
    return np.where(np.hypot(COLUMNS - 4, ROWS - 30) < radius, 0, 1).astype(np.float32)


def test_streaks_go_on_to_the_pictures_side():
    beside = at_the_side(16)
    streaks = np.repeat(np.sin(ROWS / 3.0)[..., None], 3, -1).astype(np.float32)
    continued = mirror_texture(np.where(beside[..., None] > 0, streaks, 9), beside, beside)
    gap = beside == 0
    assert np.corrcoef(continued[gap].ravel(), streaks[gap].ravel())[0, 1] > 0.85


def test_clouds_are_not_copied_to_the_pictures_side():
    beside = at_the_side(16)
    clouds = spots(np.random.default_rng(3))
    continued = mirror_texture(np.where(beside[..., None] > 0, clouds, 9), beside, beside)
    inside = np.hypot(COLUMNS - 4, ROWS - 30) < 8
    assert continued[inside].std() < 0.3 * clouds[inside].std()
