"""The air's share of the land's light, and the clouds of the low sky."""

from types import SimpleNamespace

import numpy as np
import pytest

from sunwidget.analysis import haze
from sunwidget.analysis.images.working_copy import Working
from sunwidget.photo.photo import open_photo

HEIGHT, WIDTH = 80, 120


def share(picture, air, monkeypatch, sky=None):
    """The share of a picture (h, w) of grays of which the network says ``air`` (h, w)."""
    working = Working.of(open_photo(np.repeat(picture[..., None].astype(np.uint8), 3, -1)))
    monkeypatch.setattr(haze, "look_at_land", lambda _: SimpleNamespace(air=air))
    sky = np.zeros((HEIGHT, WIDTH), np.float32) if sky is None else sky
    return haze.air_share(working, sky)


def test_even_land_has_what_the_network_says(monkeypatch):
    even = np.full((HEIGHT, WIDTH), 150)
    found = share(even, np.full((40, 60), 0.4, np.float32), monkeypatch)
    assert found.dtype == np.float32
    assert found.shape == (HEIGHT, WIDTH)
    assert found == pytest.approx(0.4, abs=0.01)


def test_no_more_air_than_light_in_the_darkest_place_nearby(monkeypatch):
    picture = np.full((HEIGHT, WIDTH), 150)
    picture[:, :60] = np.where(np.indices((HEIGHT, 60)).sum(0) % 2, 150, 10)  # leaves
    found = share(picture, np.full((40, 60), 0.9, np.float32), monkeypatch)
    assert found[:, :50][picture[:, :50] == 150].max() < 0.05
    assert found[:, 70:].min() > 0.8


def test_what_is_dark_does_not_darken_the_fog_beside_it(monkeypatch):
    picture = np.full((HEIGHT, WIDTH), 150)
    picture[:, :60] = 10
    air = np.repeat(np.float32([[0.1] * 30 + [0.9] * 30]), 40, 0)
    found = share(picture, air, monkeypatch)
    assert found[:, 62:].min() > 0.7
    assert found[:, :58].max() < 0.3


def test_the_sky_has_the_share_of_the_land_below_it(monkeypatch):
    sky = np.zeros((HEIGHT, WIDTH), np.float32)
    sky[:40] = 1
    air = np.zeros((40, 60), np.float32)
    air[:20], air[20:, 30:] = 1, 0.5
    found = share(np.full((HEIGHT, WIDTH), 150), air, monkeypatch, sky)
    assert found[30:40, 80:].mean() == pytest.approx(0.5, abs=0.1)
    assert found[30:40, :40].max() < 0.2


def test_cover_is_that_of_the_clouds_above_the_skyline():
    sky = np.zeros((HEIGHT, WIDTH), np.float32)
    sky[:60] = 1
    high, low = np.zeros_like(sky), np.zeros_like(sky)
    high[:20], low[50:60] = 0.8, 0.8
    assert haze.cover_of_low_sky(sky, high) < 0.01
    assert 0.6 < haze.cover_of_low_sky(sky, low) <= 0.8
    assert haze.cover_of_low_sky(np.zeros_like(sky), np.zeros_like(sky)) == 0
