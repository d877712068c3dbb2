"""Training samples: water stays where it is, and drawn pictures are used again."""

import cv2
import numpy as np

from training import augment
from training.augment import Augment, Drawn, crop
from training.rooms import Rooms

SIZE = 64


def photo():
    """A sky over a lake and, to the right, ground; a strip of it is unknown."""
    picture = np.zeros((90, 120, 5), np.uint8)
    picture[:40, :, :3], picture[:40, :, 3] = (120, 160, 220), 255
    picture[40:, :60, :3], picture[40:, :60, 4] = (60, 90, 130), 255
    picture[40:, 60:, :3] = (90, 80, 50)
    picture[80:, :, 3] = picture[80:, :, 4] = 128
    return picture


def augmenter(seed=0):
    random = np.random.default_rng(seed)
    return Augment(SIZE, random, lambda: photo()[..., :3], photo, Rooms(None))


def test_a_crop_keeps_water_and_what_is_unknown_of_it():
    sample = crop(photo(), (0, 0, 90, 120), SIZE)
    assert sample.water.shape == (SIZE, SIZE)
    assert set(np.unique(sample.water)) == {0, 128, 255}
    assert (sample.water[32:55, :30] == 255).all()
    assert (sample.water[:26] == 0).all()
    assert (sample.water[60:] == 128).all()


def test_water_moves_with_the_picture(monkeypatch):
    monkeypatch.setattr(augment, "ROOMS", 0.0)
    monkeypatch.setattr(augment, "STREETS", 0.0)
    monkeypatch.setattr(augment, "photometric", lambda image, *_: image)
    monkeypatch.setattr(augment, "replace_sky", lambda sample, *_: sample)
    monkeypatch.setattr(augment, "draw_thin_things", lambda image, target, _: (image, target))
    make = augmenter()
    seen = 0
    for _ in range(40):
        sample = make(photo())
        wet = cv2.erode((sample.water == 255).astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
        seen += wet.any()
        assert (np.abs(sample.image[wet].astype(int) - (60, 90, 130)).max(initial=0)) < 3
        assert not (sample.target[wet] > 128).any()
    assert seen > 20


def test_rooms_and_streets_have_no_water_and_rooms_no_sky(monkeypatch):
    monkeypatch.setattr(augment, "ROOMS", 0.5)
    monkeypatch.setattr(augment, "STREETS", 0.5)
    make = augmenter()
    samples = [make(photo()) for _ in range(12)]
    assert not any(s.water.any() for s in samples)
    assert all((s.valid == 255).all() for s in samples)
    bare = [s for s in samples if not s.target.any()]
    assert 0 < len(bare) < len(samples)


def test_what_is_drawn_is_used_several_times():
    count = 0

    def draw():
        nonlocal count
        count += 1
        return np.full((4, 4, 3), count, np.uint8), np.zeros((4, 4), np.uint8)

    random = np.random.default_rng(0)
    drawn = Drawn(draw, uses=4)
    taken = {int(drawn.take(random)[0][0, 0, 0]) for _ in range(200)}
    assert 30 < count < 80
    assert len(taken) > 0.7 * count
    assert len(drawn.kept) == 32
