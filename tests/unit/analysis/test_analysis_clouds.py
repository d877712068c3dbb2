"""Clouds by colour: drawn clouds are found, thresholds act, all methods read one scale."""

import numpy as np
import pytest

from sunwidget.analysis.clouds import clouds
from sunwidget.analysis.images.working_copy import Working
from sunwidget.photo.photo import open_photo

BLUE, WHITE, GREY = (62, 112, 190), (235, 235, 238), (120, 124, 132)
SKY = np.ones((40, 60), np.float32)
METHODS = tuple(clouds.INDICES)


def sky_of(*colors) -> Working:
    """Upright stripes of equal width, one a colour."""
    picture = np.zeros((40, 60, 3), np.uint8)
    for stripe, colour in zip(np.array_split(np.arange(60), len(colors)), colors, strict=True):
        picture[:, stripe] = colour
    return Working.of(open_photo(picture))


@pytest.mark.parametrize("name", METHODS)
def test_blue_is_clear_and_white_and_grey_are_cloud(name):
    found = clouds.METHODS[name](sky_of(BLUE, WHITE, GREY), SKY)
    assert found.opacity[:, :18].max() < 0.1
    assert found.opacity[:, 22:].min() > 0.9
    assert found.softness[:, :18].max() < 0.05
    assert found.softness[:, 22:38].min() > 0.7


@pytest.mark.parametrize("name", METHODS)
def test_paler_is_never_less_cloud(name):
    ramp = [tuple(np.round(np.add(np.multiply(BLUE, 1 - t), np.multiply(WHITE, t)))) for t in
            np.linspace(0, 1, 12)]  # fmt: skip
    index = clouds.INDICES[name](sky_of(*ramp).encoded)[0]
    assert np.all(np.diff(index) >= -1e-6)


@pytest.mark.parametrize("name", METHODS)
def test_a_higher_minimum_finds_less_cloud_and_zero_finds_all(name):
    working = sky_of(BLUE, (150, 170, 205), WHITE)
    cover = [
        clouds.METHODS[name](working, SKY, low, low + 0.4).opacity.mean() for low in (-1, 0.5, 0.95)
    ]
    assert cover[0] == 1
    assert cover[0] > cover[1] > cover[2]


def test_the_ratio_is_that_of_the_thesis():
    found = clouds.METHODS["rb_ratio"](sky_of((100, 120, 125)), SKY, 0.6, 1.0)
    # r/b = 0.8 lies midway between m_min and m_max (equation 3.6).
    assert found.softness == pytest.approx(0.5, abs=0.01)


def test_a_difference_of_thirty_levels_is_heinles_threshold():
    found = clouds.METHODS["rb_difference"](sky_of((100, 120, 130)), SKY)
    assert found.opacity == pytest.approx(0.5, abs=0.01)


def test_saturation_does_not_call_a_red_sunset_cloud_as_the_ratio_does():
    red = sky_of((230, 110, 60))
    assert clouds.METHODS["rb_ratio"](red, SKY).opacity.min() == 1
    assert clouds.METHODS["saturation"](red, SKY).opacity.max() == 0


def test_opacity_follows_the_pictures_edge_where_it_is_softer():
    # JPEG stores colors at half the size: opacity is told by them, and the edge by the light.
    columns = np.arange(120)[None] + 0.0 * np.arange(80)[:, None]
    edge = (columns >= 60).astype(np.float32)
    picture = np.float32([0.2, 0.4, 0.8]) + edge[..., None] * np.float32([0.7, 0.5, 0.1])
    soft = np.float32(np.clip((columns - 52) / 16, 0, 1))
    tied = clouds.smoothed(picture, soft, 6)
    assert tied[40, 58] < 0.3
    assert tied[40, 61] > 0.7
    assert soft[40, 58] > 0.35


def test_outside_the_sky_there_is_no_cloud():
    found = clouds.METHODS["learned"](sky_of(WHITE), 0 * SKY)
    assert found.opacity.max() == 0
    assert found.softness.max() == 0
