"""Photos taken of worlds: what part of the picture, exposure, glare."""

import numpy as np
import pytest
from world_meshes import chance

from training.land import photograph


@pytest.mark.parametrize("shape", [(186, 279), (279, 186), (228, 228), (171, 304)])
def test_a_box_lies_inside_the_picture_and_has_the_wanted_proportions(shape):
    random = chance(2)
    for rows, columns in ((128, 192), (192, 128), (160, 160), (96, 160)):
        boxes = [photograph.box(random, shape, rows, columns) for _ in range(40)]
        for found in boxes:
            assert 0 <= found.top <= found.top + found.height <= shape[0]
            assert 0 <= found.left <= found.left + found.width <= shape[1]
            assert found.width == pytest.approx(found.height * columns / rows, abs=2)
            scale = min(shape[0] / rows, shape[1] / columns)
            assert found.height > 0.64 * scale * rows - 1
        assert {found.mirrored for found in boxes} == {False, True}
        assert len({(found.top, found.left, found.height) for found in boxes}) > 10
    assert found.of(np.zeros((*shape, 3), np.float32)).shape == (rows, columns, 3)


def test_a_mirrored_box_is_the_other_one_flipped():
    picture = chance().random((60, 90, 3)).astype(np.float32)
    plain, mirrored = (photograph.Box(5, 7, 40, 60, 20, 30, flag) for flag in (False, True))
    assert mirrored.of(picture) == pytest.approx(plain.of(picture)[:, ::-1], abs=1e-6)
    whole = photograph.Box(5, 7, 40, 60, 40, 60, False)
    assert np.array_equal(whole.of(picture), picture[5:45, 7:67])


def halves(ratio=5.0, scale=1.0):
    """Radiance, the right half ``ratio`` times as bright as the left."""
    light = chance(1).uniform(0.7, 1.3, (48, 64, 3)).astype(np.float32)
    light[:, 32:] *= ratio
    return light * np.float32(scale)


def test_a_photo_is_bright_where_the_world_is():
    for seed in range(24):
        found = photograph.develop(halves(), chance(seed))
        assert found.dtype == np.uint8
        assert found.shape == (48, 64, 3)
        left, right = found[:, :30].mean(), found[:, 34:].mean()
        assert right > left + 15
        assert 5 < found.mean() < 250


def test_a_camera_exposes_for_the_light_there_is():
    for seed in range(6):
        dim, bright = (photograph.develop(halves(scale=s), chance(seed)) for s in (0.01, 300.0))
        assert np.abs(dim.astype(int) - bright).max() <= 2


def test_a_camera_shoots_the_same_by_the_same_seed_and_otherwise_by_another():
    shots = [photograph.develop(halves(), chance(seed)) for seed in (7, 7, 8)]
    assert np.array_equal(shots[0], shots[1])
    assert not np.array_equal(shots[0], shots[2])


def test_glare_takes_no_light_away_and_spreads_from_what_is_bright():
    light = np.full((40, 60, 3), 0.1, np.float32)
    light[20, 30] = 2000
    found = photograph.glare(light, chance())
    assert (found >= light).all()
    assert found[20, 33].mean() > found[20, 55].mean() > 0.1
