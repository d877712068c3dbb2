"""What water mirrors, and how calm it is (analysis/water/mirror.py)."""

import cv2
import numpy as np
import pytest

from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.water.mirror import find_mirror
from sunwidget.formats.color import srgb_to_linear
from sunwidget.geometry.camera import Camera

WIDTH, HEIGHT, ROW = 256, 192, 96  # px; the horizon's row
CAMERA = Camera.from_horizon(WIDTH, HEIGHT, 45.0, float(ROW))
WATER = np.repeat((np.arange(HEIGHT) >= ROW).astype(np.float32)[:, None], WIDTH, 1)


X = np.arange(WIDTH)
ROWS = np.arange(HEIGHT)[:, None]
TOPS = 30 + 12 * np.sin(X / 9.0) + 8 * np.sin(X / 4.0 + 1)  # of woods, px above the water
SKY = (ROWS <= ROW - TOPS).astype(np.float32)
OPEN = np.repeat((ROWS < ROW).astype(np.float32), WIDTH, 1)  # the sky of an open sea


def lake(kind, row=ROW):
    """A copy of a photo of woods before a bright sky, above water of some ``kind``."""
    random = np.random.default_rng(5)
    above = np.where(SKY > 0, 0.8, 0.1)
    if kind == "bright on the left":
        above = 0.3 + 0.5 * np.repeat(np.exp(-X / 80.0)[None], HEIGHT, 0)
    if kind == "column":
        above = 0.2 + 0.6 * np.repeat(np.exp(-0.5 * ((X - 90) / 9.0) ** 2)[None], HEIGHT, 0)
    below = above[np.clip(2 * row - 1 - np.arange(HEIGHT), 0, HEIGHT - 1)]
    if kind == "waves":
        waves = cv2.GaussianBlur(random.standard_normal((HEIGHT, WIDTH)), (0, 0), 4, sigmaY=0.8)
        below = 0.3 + 0.1 * waves / waves.std()
    picture = np.where(WATER > 0, 0.8 * below, above) + random.normal(0, 0.01, (HEIGHT, WIDTH))
    encoded = np.repeat(np.clip(picture, 0, 1)[..., None], 3, -1).astype(np.float32)
    return Working(srgb_to_linear(encoded).astype(np.float32), encoded, encoded, (1, 1))


@pytest.mark.parametrize("row", [ROW, ROW + 4])
def test_a_lake_that_mirrors_its_woods_is_calm_even_if_the_horizon_is_a_little_wrong(row):
    mirror = find_mirror(lake("mirror", row), SKY, WATER, CAMERA)
    assert mirror.clear == 1
    assert mirror.roughness == pytest.approx(0.05)


@pytest.mark.parametrize("kind", ["waves", "bright on the left"])
def test_waves_and_a_sea_as_bright_as_its_sky_are_no_mirror(kind):
    mirror = find_mirror(lake(kind), SKY if kind == "waves" else OPEN, WATER, CAMERA)
    assert (mirror.clear, mirror.roughness) == (0, 1)
    assert not mirror.land.any()


def test_without_water_nothing_is_mirrored():
    assert find_mirror(lake("mirror"), SKY, 0 * WATER, CAMERA).clear == 0


def test_a_column_of_glints_is_no_mirror_image_of_the_glow_above_it():
    assert find_mirror(lake("column"), OPEN, WATER, CAMERA).clear == 1  # it looks like one
    assert find_mirror(lake("column"), OPEN, WATER, CAMERA, glints=True).clear == 0


@pytest.mark.parametrize("glints", [False, True])
@pytest.mark.parametrize("lower", [0, 30])
def test_mirrored_land_ends_where_the_photos_mirrored_skyline_is(lower, glints):
    camera = Camera.from_horizon(WIDTH, HEIGHT, 45.0, float(ROW - lower))  # wrong by so much
    land = find_mirror(lake("mirror"), SKY, WATER, camera, glints=glints).land
    below = ROWS - ROW  # px below the shore
    assert land[(below >= 1) & (below < TOPS - 4)].min() > 0.9
    assert land[below > TOPS + 4].max() < 0.1
    assert not land[:ROW].any()


def test_a_skyline_that_the_water_does_not_show_is_not_mirrored():
    even = lake("mirror")
    for image in (even.linear, even.encoded):
        image[ROW:] = image[ROW:].mean((0, 1))
    assert not find_mirror(even, SKY, WATER, CAMERA).land.any()
