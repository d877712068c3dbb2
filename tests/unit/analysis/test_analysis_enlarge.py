"""Maps that are enlarged by parts: the parts are the whole."""

import numpy as np
import pytest

import sunwidget as sw
from sunwidget.analysis.horizon.horizon import above, cut_below
from sunwidget.analysis.images.enlarge import enlarged_part, pixels_of, raise_to, resize_rows
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.segmentation import matting
from sunwidget.analysis.segmentation.refine import Decision
from sunwidget.geometry.camera import Camera

RANDOM = np.random.default_rng(3)
SMALL = RANDOM.random((23, 31), np.float32)
SIZE = 127, 90  # (width, height): no whole multiple


@pytest.mark.parametrize("image", [SMALL, RANDOM.random((23, 31, 3), np.float32)])
def test_pixels_have_the_same_bits_whichever_are_asked_for_with_them(image):
    whole = resize_rows(image, *SIZE)
    parts = [resize_rows(image, *SIZE, slice(top, top + 7)) for top in range(0, SIZE[1], 7)]
    assert np.array_equal(np.concatenate(parts), whole)
    part = slice(11, 60), slice(40, 101)
    assert np.array_equal(resize_rows(image, *SIZE, *part), whole[part])


def test_rows_are_those_of_the_enlarged_map():
    # A bit or two of float32: the two interpolate in another order.
    assert np.abs(resize_rows(SMALL, *SIZE) - resize(SMALL, *SIZE)).max() <= 2e-7


def test_a_map_of_the_size_asked_for_is_not_copied():
    assert resize_rows(SMALL, 31, 23) is SMALL


def test_tiles_cover_the_photo_once_and_are_the_enlarged_map():
    zoom = SIZE[0] / 31, SIZE[1] / 23
    out = np.full(SIZE[::-1], np.nan, np.float32)
    for top in range(0, 23, 8):
        for left in range(0, 31, 8):
            part = (
                pixels_of(top, min(top + 8, 23), zoom[1]),
                pixels_of(left, min(left + 8, 31), zoom[0]),
            )
            assert np.isnan(out[part]).all()
            out[part] = enlarged_part(SMALL, zoom, part)
    # OpenCV's warps place samples to 1/32 of a pixel, of a map that changes by up to 1 in one.
    assert np.abs(out - resize(SMALL, *SIZE)).max() <= 2 / 32


def test_raising_a_map_touches_only_where_there_is_something_to_raise_to():
    least = np.zeros((23, 31), np.float32)
    least[5:9, 20:24] = 1
    matte = np.full(SIZE[::-1], 0.25, np.float32)
    raise_to(matte, least, (SIZE[0] / 31, SIZE[1] / 23))
    expected = np.maximum(resize(least, *SIZE), 0.25)
    assert np.abs(matte - expected).max() <= 2 / 32
    raise_to(matte, np.zeros_like(least), (SIZE[0] / 31, SIZE[1] / 23))
    assert matte.max() == 1


@pytest.mark.parametrize(("pitch", "roll"), [(0.0, 0.0), (9.0, 6.0), (40.0, 0.0), (-40.0, 0.0)])
def test_cutting_below_the_horizon_is_multiplying_by_what_is_above_it(pitch, roll):
    camera = Camera(*SIZE, 40.0, pitch, roll)
    matte = RANDOM.random(SIZE[::-1]).astype(np.float32)
    expected = matte * above(camera, *SIZE)
    cut_below(matte, camera)
    assert np.array_equal(matte, expected)


def test_tiles_without_a_skyline_are_what_looking_at_every_pixel_gives(monkeypatch):
    # Half sky, half land, and noise that the guided filter could follow.
    picture = RANDOM.integers(0, 90, (300, 1500, 3), np.uint8)
    picture[:150] += 120
    photo = sw.open(picture)
    working = Working.of(photo)
    sky = np.zeros((working.height, working.width), np.float32)
    sky[: working.height // 2] = 1
    decision = Decision(sky, np.ones_like(sky))
    quick = matting.matte(photo, working, decision)
    monkeypatch.setattr(matting, "_ROUNDING", np.inf)  # no tile is sure
    every = matting.matte(photo, working, decision)
    assert np.array_equal(quick, every)
    assert 0 < np.mean((quick > 0) & (quick < 1)) < 0.1
