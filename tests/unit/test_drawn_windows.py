"""What the network of windows learns from: drawn by seed, with glass where it is said to be."""

import numpy as np
import pytest

from training.windows.draw import SIDE, facade, furnish, street

SIZE = 128


def photo(seed):
    return np.random.default_rng(seed).integers(90, 160, (SIZE, SIZE, 3)).astype(np.uint8)


@pytest.mark.parametrize("seed", range(20))
def test_a_street_is_a_picture_and_its_glass(seed):
    image, glass = street(photo(1), photo(2), np.random.default_rng(seed))
    assert image.shape == (SIZE, SIZE, 3)
    assert image.dtype == np.uint8
    assert glass.shape == (SIZE, SIZE)
    assert 0 <= glass.min() <= glass.max() <= 1
    again, same = street(photo(1), photo(2), np.random.default_rng(seed))
    assert np.array_equal(image, again)
    assert np.array_equal(glass, same)


def test_some_streets_have_windows_and_some_photos_none():
    shares = [street(photo(1), photo(2), np.random.default_rng(s))[1].mean() for s in range(40)]
    assert 0.1 < np.mean(np.array(shares) == 0) < 0.6
    assert max(shares) > 0.1


def test_glass_is_not_what_the_wall_is():
    apart = []
    for seed in range(10):
        picture, glass = facade(np.random.default_rng(seed))
        assert picture.shape == (SIDE, SIDE, 3)
        if 0.05 < glass.mean() < 0.9:
            inside, outside = picture[glass > 0.5].mean(0), picture[glass == 0].mean(0)
            apart.append(np.abs(inside - outside).max())
    assert len(apart) > 5
    assert np.median(apart) > 20


def test_people_cars_and_signs_hide_glass():
    glass = np.ones((SIZE, SIZE), np.float32)
    canvas = np.zeros((SIZE, SIZE, 3), np.float32)
    for seed in range(6):
        furnish(canvas, glass, np.random.default_rng(seed))
    assert (canvas.max(-1) > 0).any()
    assert (glass[canvas.max(-1) > 0] < 1).mean() > 0.97
