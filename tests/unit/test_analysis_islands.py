"""Statements about what the matte gains in mid-sky."""

import numpy as np

from sunwidget.analysis.islands import fill_islands

HEIGHT, WIDTH = 120, 180


def skyline() -> tuple[np.ndarray, np.ndarray]:
    """Sky above row 80, and a network that says the same."""
    sky = np.zeros((HEIGHT, WIDTH), np.float32)
    sky[:80] = 1
    return sky, sky.copy()


def test_an_island_that_the_network_calls_sky_becomes_sky() -> None:
    sky, coarse = skyline()
    sky[30:36, 50:58] = 0
    bound = fill_islands(sky, coarse)
    assert bound[31:35, 51:57].min() > 0.5
    assert bound[80:].max() == 0


def test_an_island_that_the_network_calls_land_stays() -> None:
    sky, coarse = skyline()
    sky[30:36, 50:58] = coarse[30:36, 50:58] = 0
    assert fill_islands(sky, coarse).max() == 0


def test_a_mast_that_stands_on_the_land_stays() -> None:
    sky, coarse = skyline()
    sky[20:80, 90:92] = 0
    assert fill_islands(sky, coarse).max() == 0
