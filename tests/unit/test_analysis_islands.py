"""Statements about what the matte gains in mid-sky and in the glow of a low sun."""

import numpy as np

from sunwidget.analysis.islands import fill_islands, grow_over_glow

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


def test_sky_runs_on_through_a_smooth_glow_to_the_next_edge() -> None:
    sky, coarse = skyline()
    coarse[60:80] = 0.3
    sky[60:80, 60:120] = 0
    photo = np.full((HEIGHT, WIDTH, 3), 0.8, np.float32)
    photo[80:] = 0.1
    bound = grow_over_glow(sky, coarse, photo)
    assert bound[62:76, 65:115].min() > 0.9
    assert bound[82:].max() == 0


def test_dark_land_without_an_edge_is_not_taken_for_glow() -> None:
    sky, coarse = skyline()
    coarse[60:80] = 0.3
    sky[60:80, 60:120] = 0
    photo = np.full((HEIGHT, WIDTH, 3), 0.1, np.float32)
    assert grow_over_glow(sky, coarse, photo).max() == 0
