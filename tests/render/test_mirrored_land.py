"""How water that mirrors land is relit (frame/frame.glsl)."""

import dataclasses
import functools

import numpy as np
import pytest
from water_scenes import ROW, SIZE, TOLD

import sunwidget as sw
from sunwidget.analysis import frame_inputs
from sunwidget.analysis.water.mirror import Mirror

WIDTH, HEIGHT = SIZE
X, ROWS = np.arange(WIDTH), np.arange(HEIGHT)[:, None]
TOPS = 30 + 8 * np.sin(X / 9.0) + 5 * np.sin(X / 4.0 + 1)  # of woods, px above the water
SKY = (ROWS <= ROW - TOPS).astype(np.float32)
WOODS = (ROWS - ROW > 2) & (ROWS - ROW < TOPS - 5)  # as the water mirrors them
OPEN = ROWS - ROW > TOPS + 5
BEHIND = sw.Edit(sun_azimuth=0, sun_elevation=4, auto_exposure=0)


@functools.cache
def lake():
    """A still lake before dark woods and a hazy sky, as 8-bit sRGB."""
    sky = np.array([0.45, 0.6, 0.85]) + ROWS[..., None] / HEIGHT * np.array([0.6, 0.4, 0.1])
    above = np.where(SKY[..., None] > 0, sky, np.array([0.13, 0.17, 0.08]))
    below = 0.75 * above[np.clip(2 * ROW - np.arange(HEIGHT), 0, HEIGHT - 1)]
    picture = np.where(ROWS[..., None] >= ROW, below, above)
    picture = picture + np.random.default_rng(3).normal(0, 0.006, picture.shape)
    return np.round(np.clip(picture, 0, 1) * 255).astype(np.uint8)


@functools.cache
def analysed():
    water = np.repeat((ROWS >= ROW).astype(np.float32), WIDTH, 1)
    return sw.analyze(lake(), **TOLD | {"sky": SKY, "water": water})


@functools.cache
def relit(mirrors):
    """The lake under a low sun behind its woods; or as if it mirrored sky alone."""
    scene = analysed()
    with pytest.MonkeyPatch.context() as patch:
        if not mirrors:
            nothing = Mirror(1.0, np.zeros_like(scene.small_water))
            patch.setattr(frame_inputs, "find_mirror", lambda *_, **__: nothing)
            scene = dataclasses.replace(scene)  # nothing is cached for a copy
        return sw.render(scene, BEHIND)[..., :3].astype(float)


def test_the_map_of_water_is_that_of_all_water():
    assert analysed().water[WOODS].min() == 1


def test_an_unmoved_sun_leaves_mirrored_land_to_the_bit():
    assert np.array_equal(sw.render(analysed()), lake())


def test_mirrored_woods_stay_dark_when_the_sky_that_the_water_mirrors_becomes_bright():
    before, woods = lake().astype(float)[WOODS].mean(), relit(True)[ROW - 20 : ROW - 4].mean()
    as_sky, as_land = (relit(mirrors)[WOODS].mean() for mirrors in (False, True))
    assert as_sky > before + 20  # levels of 255
    assert as_land < before + 5
    assert as_land < woods + 15


def test_water_that_mirrors_the_sky_does_not_care():
    assert np.abs(relit(True) - relit(False))[OPEN].max() <= 1


def test_what_mirrors_land_becomes_no_brighter_by_it():
    assert (relit(True) - relit(False))[WOODS].mean(-1).max() < 1
