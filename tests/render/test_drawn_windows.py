"""What the network of windows learns from: drawn by seed, with glass where it is said to be."""

import cv2
import numpy as np
import pytest

from training.windows.draw import (
    GLASS,
    GLASS_UNKNOWN,
    LAYERS,
    OPENING,
    OPENING_UNKNOWN,
    SIDE,
    facade,
    furnish,
    set_up,
    street,
)
from training.windows.facades import BALCONY, SHOP, SKY, WINDOW, Facades, known, names

SIZE = 128


def photo(seed):
    return np.random.default_rng(seed).integers(90, 160, (SIZE, SIZE, 3)).astype(np.uint8)


@pytest.mark.parametrize("seed", range(20))
def test_a_street_is_a_picture_and_its_glass(seed):
    image, glass = street(photo(1), photo(2), np.random.default_rng(seed))
    assert image.shape == (SIZE, SIZE, 3)
    assert image.dtype == np.uint8
    assert glass.shape == (SIZE, SIZE, LAYERS)
    assert (glass[..., GLASS] <= glass[..., OPENING] + glass[..., OPENING_UNKNOWN] + 1e-6).all()
    assert 0 <= glass.min() <= glass.max() <= 1
    again, same = street(photo(1), photo(2), np.random.default_rng(seed))
    assert np.array_equal(image, again)
    assert np.array_equal(glass, same)


def test_some_streets_have_windows_and_some_photos_none():
    shares = [
        street(photo(1), photo(2), np.random.default_rng(s))[1][..., OPENING].mean()
        for s in range(40)
    ]
    assert 0.1 < np.mean(np.array(shares) == 0) < 0.6
    assert max(shares) > 0.1


def test_glass_is_not_what_the_wall_is():
    apart = []
    for seed in range(10):
        picture, layers = facade(np.random.default_rng(seed))
        glass = layers[..., GLASS]
        assert picture.shape == (SIDE, SIDE, 3)
        if 0.05 < glass.mean() < 0.9:
            wall = layers[..., OPENING] == 0
            inside, outside = picture[glass > 0.5].mean(0), picture[wall].mean(0)
            apart.append(np.abs(inside - outside).max())
    assert len(apart) > 5
    assert np.median(apart) > 20


def test_people_cars_and_signs_hide_glass():
    glass = np.ones((SIZE, SIZE, LAYERS), np.float32)
    canvas = np.zeros((SIZE, SIZE, 3), np.float32)
    for seed in range(6):
        furnish(canvas, glass, np.random.default_rng(seed))
    assert (canvas.max(-1) > 0).any()
    assert (glass[canvas.max(-1) > 0] < 1).mean() > 0.97


def labelled(folder, count=8):
    """A folder of façades: sky, wall, windows with balconies, shops, and one corner unlabelled."""
    for part in ("images", "labels"):
        (folder / part).mkdir()
    for i in range(count):
        label = np.full((200, 120), 4)
        label[:20], label[170:], label[:5, :5] = SKY, SHOP, -1
        for y in (40, 100):
            for x in (20, 70):
                label[y : y + 30, x : x + 20], label[y + 30 : y + 40, x : x + 20] = WINDOW, BALCONY
        picture = np.full((200, 120, 3), 180, np.uint8)
        picture[label == WINDOW] = 30
        picture[45:50, 20:40] = (40, 90, 40)  # leaves
        cv2.imwrite(str(folder / "images" / f"facade_{i}.png"), picture)
        np.savetxt(folder / "labels" / f"facade_{i}.txt", label, fmt="%d")
    return folder


def test_of_labels_only_what_they_tell_is_known(tmp_path):
    folder = labelled(tmp_path, 1)
    label = np.loadtxt(folder / "labels" / "facade_0.txt").astype(int)
    layers = known(cv2.imread(str(folder / "images" / "facade_0.png"))[..., ::-1], label)
    assert layers[60, 30].tolist() == [0, 1, 1, 0]  # a window: whether glass, nobody says
    assert layers[60, 60].tolist() == [0, 0, 0, 0]  # wall
    assert layers[180, 60].tolist() == [0, 0, 1, 1]  # a shop
    assert layers[2, 2].tolist() == [0, 0, 1, 1]  # no label
    assert layers[75, 30].tolist() == [0, 0, 1, 1]  # a balcony's bars before the window
    assert layers[47, 30].tolist() == [0, 0, 1, 1]  # leaves before it


def test_facades_that_judge_teach_nothing(tmp_path):
    learn, judge = names(labelled(tmp_path, 8))
    assert len(learn) == 6
    assert not set(learn) & set(judge)
    assert names(tmp_path) == (learn, judge)


def test_photographed_facades_and_windows_stand_in_streets(tmp_path):
    folder = labelled(tmp_path)
    real = Facades(folder, names(folder)[0])
    assert real.windows
    assert all(window.mean() < 40 for window in real.windows)  # none behind leaves
    flat = np.array([[20, 10], [120, 10], [120, 120], [20, 120]], np.float32)
    canvas, target = np.zeros((SIZE, SIZE, 3), np.float32), np.zeros((SIZE, SIZE, LAYERS))
    random = np.random.default_rng(3)
    picture, layers, solid = real.wall(flat, random)
    set_up(canvas, target, (picture, layers, solid), flat, random)
    sure = target[..., OPENING_UNKNOWN] == 0
    window, rest = target[..., OPENING] > 0.9, (target[..., OPENING] == 0) & sure
    assert window.any()
    assert not target[:, :15].any()
    assert (target[window][:, GLASS_UNKNOWN] > 0.9).all()
    assert canvas[window].mean() < 0.4 * canvas[rest & (canvas.max(-1) > 0)].mean()
    image, target = street(photo(1), photo(2), np.random.default_rng(5), real)
    again, same = street(photo(1), photo(2), np.random.default_rng(5), real)
    assert np.array_equal(image, again)
    assert np.array_equal(target, same)
