"""How calm water is by what it mirrors (analysis/water/mirror.py)."""

import cv2
import numpy as np
import pytest

from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.water.mirror import mirror_roughness
from sunwidget.formats.color import srgb_to_linear
from sunwidget.geometry.camera import Camera

WIDTH, HEIGHT, ROW = 256, 192, 96  # px; the horizon's row
CAMERA = Camera.from_horizon(WIDTH, HEIGHT, 45.0, float(ROW))
WATER = np.repeat((np.arange(HEIGHT) >= ROW).astype(np.float32)[:, None], WIDTH, 1)


def lake(kind, row=ROW):
    """A copy of a photo of woods before a bright sky, above water of some ``kind``."""
    random = np.random.default_rng(5)
    x = np.arange(WIDTH)
    tops = 30 + 12 * np.sin(x / 9.0) + 8 * np.sin(x / 4.0 + 1)  # px above the water
    rows = np.arange(HEIGHT)[:, None]
    above = np.where(rows > ROW - tops, 0.1, 0.8)
    if kind == "bright on the left":
        above = 0.3 + 0.5 * np.repeat(np.exp(-x / 80.0)[None], HEIGHT, 0)
    below = above[np.clip(2 * row - 1 - np.arange(HEIGHT), 0, HEIGHT - 1)]
    if kind == "waves":
        waves = cv2.GaussianBlur(random.standard_normal((HEIGHT, WIDTH)), (0, 0), 4, sigmaY=0.8)
        below = 0.3 + 0.1 * waves / waves.std()
    picture = np.where(WATER > 0, 0.8 * below, above) + random.normal(0, 0.01, (HEIGHT, WIDTH))
    encoded = np.repeat(np.clip(picture, 0, 1)[..., None], 3, -1).astype(np.float32)
    return Working(srgb_to_linear(encoded).astype(np.float32), encoded, encoded, (1, 1))


@pytest.mark.parametrize("row", [ROW, ROW + 4])
def test_a_lake_that_mirrors_its_woods_is_calm_even_if_the_horizon_is_a_little_wrong(row):
    assert mirror_roughness(lake("mirror", row), WATER, CAMERA) == pytest.approx(0.05)


@pytest.mark.parametrize("kind", ["waves", "bright on the left"])
def test_waves_and_a_sea_as_bright_as_its_sky_are_no_mirror(kind):
    assert mirror_roughness(lake(kind), WATER, CAMERA) == 1


def test_without_water_nothing_is_mirrored():
    assert mirror_roughness(lake("mirror"), 0 * WATER, CAMERA) == 1
