"""Pieces apart from the sky and from the land are judged as a whole, by belief and by colour."""

import numpy as np
import pytest

from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.segmentation import patches
from sunwidget.photo.photo import open_photo

HEIGHT, WIDTH = 120, 180
SKY, LAND = (120, 160, 220), (70, 80, 40)
PATCH = slice(30, 45), slice(50, 75)  # 1.7 % of the picture, in the sky
BELOW = slice(90, 105), slice(50, 75)


@pytest.fixture
def scene(monkeypatch):
    """Sky above row 80, its mask and what the networks think of it, which agrees."""
    picture = np.empty((HEIGHT, WIDTH, 3), np.uint8)
    picture[:80], picture[80:] = SKY, LAND
    sky = np.zeros((HEIGHT, WIDTH), np.float32)
    sky[:80] = 1
    belief = np.clip(sky, 0.01, 0.99)

    class Land:
        sky = belief

    monkeypatch.setattr(patches, "look_at_land", lambda working: Land)
    return picture, sky, belief


def settled(picture, sky, belief):
    return patches.settle(sky, belief, Working.of(open_photo(picture)))


def test_an_island_of_the_skys_colour_that_the_networks_call_sky_becomes_sky(scene):
    picture, sky, belief = scene
    whole = sky.copy()
    sky[PATCH] = 0
    np.testing.assert_array_equal(settled(picture, sky, belief), whole)


def test_an_island_that_the_networks_call_land_stays(scene):
    picture, sky, belief = scene
    picture[PATCH], sky[PATCH], belief[PATCH] = LAND, 0, 0.01
    np.testing.assert_array_equal(settled(picture, sky, belief), sky)


def test_a_window_that_the_networks_call_land_is_no_sky(scene):
    picture, sky, belief = scene
    whole = sky.copy()
    picture[BELOW], sky[BELOW], belief[BELOW] = (90, 95, 80), 1, 0.05
    np.testing.assert_array_equal(settled(picture, sky, belief), whole)


def test_a_gap_that_they_call_sky_and_that_has_its_colour_stays(scene):
    picture, sky, belief = scene
    picture[BELOW], sky[BELOW], belief[BELOW] = SKY, 1, 0.9
    np.testing.assert_array_equal(settled(picture, sky, belief), sky)


def test_what_is_small_or_hangs_together_is_not_judged(scene):
    picture, sky, belief = scene
    sky[90:95, 30:37] = 1  # 0.16 %
    sky[20:80, 90:92] = 0  # a mast
    labels, is_sky = patches.find(sky)
    assert not labels.any()
    assert not is_sky.size
    np.testing.assert_array_equal(settled(picture, sky, belief), sky)


def test_patches_are_numbered_sky_first_and_twigs_meet_at_corners():
    sky = np.zeros((HEIGHT, WIDTH), np.float32)
    sky[:80] = 1
    sky[BELOW] = 1
    sky[PATCH] = 0
    sky[45:80, 75:78] = 0  # from its corner down to the land
    labels, is_sky = patches.find(sky)
    assert list(is_sky) == [True]
    assert (labels[BELOW] == 1).all()
    assert np.count_nonzero(labels) == 15 * 25
