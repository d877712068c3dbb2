"""Where the old sun hides the sky: a star's rays, and a halo that ends where the sky begins."""

import cv2
import numpy as np
import pytest

from sunwidget.analysis.old_sun import old_sun_mark, starburst

SIZE = (160, 240)
ROWS, COLUMNS = np.mgrid[: SIZE[0], : SIZE[1]] + 0.5
CENTRE = (130.0, 60.0)
DISTANCE = np.hypot(COLUMNS - CENTRE[0], ROWS - CENTRE[1])
SKY = np.ones(SIZE, bool)


def star(rays=8, length=60.0, width=2.0, strength=1.0):
    """Log light of rays that fade linearly to ``length``."""
    light = np.zeros(SIZE)
    for k in range(rays):
        turn = 0.3 + 2 * np.pi * k / rays
        along = (COLUMNS - CENTRE[0]) * np.cos(turn) + (ROWS - CENTRE[1]) * np.sin(turn)
        across = (COLUMNS - CENTRE[0]) * np.sin(turn) - (ROWS - CENTRE[1]) * np.cos(turn)
        fade = np.clip(1 - along / length, 0, 1) * (along > 0)
        light = np.maximum(light, strength * fade * np.exp(-((across / width) ** 2)))
    return light


def test_rays_are_marked_and_the_sky_between_them_is_not():
    light = star()
    mark = starburst(light + 0.1 * np.sin(COLUMNS / 40), SKY & (DISTANCE > 6), CENTRE)
    ray = (light > 0.35) & (DISTANCE > 8)
    between = (light < 0.005) & (DISTANCE > 25)
    assert mark[ray].mean() > 0.8
    assert mark[between].mean() < 0.03
    assert mark.min() >= 0
    assert mark.max() <= 1


def test_a_cloud_that_does_not_touch_the_sun_is_no_ray():
    cloud = 1.5 * (np.hypot((COLUMNS - 190) / 22, (ROWS - 70) / 12) < 1)
    mark = starburst(cv2.GaussianBlur(cloud, (0, 0), 2), SKY & (DISTANCE > 6), CENTRE)
    assert mark[DISTANCE > 12].max() < 0.2


@pytest.mark.parametrize("centre", [(130.0, 60.0), (5.0, 5.0), (0.5, 70.0), (239.0, 159.0)])
def test_an_even_or_noisy_sky_has_no_rays(centre):
    noise = 0.02 * np.random.default_rng(1).standard_normal(SIZE)
    distance = np.hypot(COLUMNS - centre[0], ROWS - centre[1])
    mark = starburst(noise, SKY & (distance > 6), centre)
    assert mark[distance > 12].max(initial=0) < 0.3
    assert mark.mean() < 0.02


def test_the_mark_reaches_as_far_as_the_halo_and_leaves_a_burnt_cloud_alone():
    angle = (DISTANCE * 0.25).astype(np.float32)
    halo = 2.0 * np.exp(-((angle / 5) ** 2))
    clipped = (angle < 2).astype(np.float32)
    far_cloud = np.hypot(COLUMNS - 30, ROWS - 130) < 15
    clipped[far_cloud] = 1
    mark = old_sun_mark(halo.astype(np.float32), clipped, np.ones(SIZE, np.float32), angle)
    assert mark[angle < 5].min() > 0.95
    assert mark[angle > 15].max() < 0.05
