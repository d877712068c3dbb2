"""The rays of a photo's sun: what runs outwards from it, and nothing else."""

import numpy as np
import pytest

from sunwidget.analysis.backdrop.rays import find_rays
from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.sun.sun import SunObservation
from sunwidget.photo.photo import open_photo

WIDTH, HEIGHT, X, Y = 480, 320, 240.5, 120.5
ROWS, COLUMNS = np.mgrid[:HEIGHT, :WIDTH] + 0.5
AWAY = np.hypot(COLUMNS - X, ROWS - Y)
TURN = np.arctan2(ROWS - Y, COLUMNS - X)


def found(log_excess, sky=None):
    """What is found in an even sky with this much more light, (h, w, 3)."""
    light = 0.2 * np.exp(log_excess)[..., None] * np.array([0.5, 0.7, 1.0])
    light[AWAY < 8] = 1.0
    sun = SunObservation(
        X, Y, 8.0, 0.0, 20.0, (AWAY < 8).astype(np.float32), (WIDTH, HEIGHT), True, "detected"
    )
    sky = np.ones((HEIGHT, WIDTH), np.float32) if sky is None else sky
    return find_rays(Working.of(open_photo(light.astype(np.float32))), sky, sun)


def starburst(strength, blades=6):
    """Rays three pixels wide that fade to a third over a hundred pixels."""
    off = AWAY * np.abs(np.sin(TURN * blades / 2 + 0.4) / (blades / 2))
    return strength * np.exp(-AWAY / 100) * np.exp(-np.square(off / 3))


def test_rays_are_found_with_their_light():
    excess = starburst(0.5)
    rays = found(excess).mean(-1)
    on = (excess > 0.15) & (AWAY > 25)
    assert (rays[on] / excess[on]).mean() == pytest.approx(1, abs=0.25)
    assert rays[(excess < 0.01) & (AWAY > 25) & (AWAY < 150)].mean() < 0.01


def test_a_glow_that_is_alike_all_round_is_no_ray():
    assert found(0.8 * np.exp(-AWAY / 60)).max() < 0.03  # from which glare counts (erase.py)


def test_clouds_that_do_not_reach_the_sun_are_no_rays():
    rng = np.random.default_rng(4)
    excess = np.zeros((HEIGHT, WIDTH))
    for x, y in zip(rng.uniform(0, WIDTH, 40), rng.uniform(0, HEIGHT, 40), strict=True):
        cloud = np.exp(-np.square((COLUMNS - x) / 30) - np.square((ROWS - y) / 9))
        excess += 0.6 * cloud * (np.hypot(x - X, y - Y) > 70)
    # A third of what there is at most; next to nothing on the whole.
    assert found(excess).mean() < 0.04 * excess.mean()


def test_a_bright_band_along_the_skyline_is_no_ray():
    land = ROWS > Y + 4
    band = 0.6 * np.exp(-np.square((ROWS - Y) / 5))
    assert found(band, 1 - land.astype(np.float32))[~land].mean() < 0.1 * band[~land].mean()


def test_land_has_no_rays_and_hides_none_beyond_it():
    sky = np.ones((HEIGHT, WIDTH), np.float32)
    sky[np.abs(AWAY - 60) < 10] = 0
    excess = starburst(0.5)
    rays = found(excess, sky).mean(-1)
    assert not rays[sky == 0].any()
    beyond = (excess > 0.1) & (AWAY > 80)
    assert (rays[beyond] / excess[beyond]).mean() > 0.6
