"""What glints on dry land (analysis/water/glitter.py)."""

import numpy as np
import pytest

import sunwidget as sw
from sunwidget.analysis import frame_inputs
from sunwidget.analysis.images.working_copy import Working, encode
from sunwidget.analysis.water.glitter import glints_on_land

WIDTH, HEIGHT, ROW = 96, 72, 30  # px; the horizon's row
SKY = np.repeat((np.arange(HEIGHT) < ROW).astype(np.float32)[:, None], WIDTH, 1)
DRY = np.zeros_like(SKY)


def ground(level, shine=1.0, sky=0.7):
    """A photo of land of one brightness (display-linear) with a brighter patch below the sun."""
    light = np.where(SKY[..., None] > 0, sky, level) * np.ones(3)
    light[ROW + 8 : ROW + 24, 40:56] = shine
    return light.astype(np.float32)


def copied(light):
    return Working(light, encode(light), encode(light), (1, 1))


@pytest.mark.parametrize(("level", "shiny"), [(0.03, 1), (0.12, 1), (0.35, 0), (0.6, 0)])
def test_a_wet_street_glints_and_snow_does_not(level, shiny):
    assert glints_on_land(copied(ground(level)), SKY, DRY) == shiny


def test_neither_water_nor_sky_says_whether_land_is_white():
    light = ground(0.05, shine=0.05)
    water = DRY.copy()
    water[ROW:, :70] = 1
    light[ROW:, :70] = 0.9
    assert glints_on_land(copied(light), SKY, water) == 1
    assert glints_on_land(copied(light), np.ones_like(SKY), DRY) == 0


@pytest.mark.parametrize(("level", "glints"), [(0.03, True), (0.4, False)])
def test_the_zone_of_glints_on_land_leaves_snow_alone(level, glints):
    light = ground(level)
    light[4:10, 44:52] = 1  # the sun
    photo = np.round(255 * encode(light)).astype(np.uint8)
    told = {"sky": SKY > 0.5, "water": DRY > 0.5, "horizon": float(ROW)}
    scene = sw.analyze(photo, sun=(48.0, 7.0), **told)
    zone = frame_inputs.surface(scene)[ROW + 12 : ROW + 20, 44:52, 2]
    assert (zone.max() > 0.5) == glints
