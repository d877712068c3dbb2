"""What a sky has all round its sun, apart from layers and clouds."""

import numpy as np
import pytest

from sunwidget.analysis.backdrop.aureole import find_aureole

ROWS, COLUMNS = np.mgrid[:120, :180] + 0.5
AWAY = np.hypot(COLUMNS - 90, ROWS - 50)
HIDDEN = AWAY < 25
KNOWN = np.float32(~HIDDEN)
LAYERS = 0.4 * ROWS / 120


def found(excess):
    picture = np.repeat(excess[..., None], 3, -1).astype(np.float32)
    return find_aureole(picture, KNOWN, HIDDEN, (90.0, 50.0))[..., 1]


@pytest.fixture(scope="module")
def ring():
    return 0.3 * np.exp(-np.maximum(AWAY - 25, 0) / 10)


def test_a_ring_around_the_sun_is_found_in_a_layered_sky(ring):
    aureole = found(LAYERS + ring)
    beside = (AWAY > 26) & (AWAY < 29)
    assert 0.6 * ring[beside].mean() < aureole[beside].mean() < 1.02 * ring[beside].mean()
    assert aureole[AWAY > 85].max() == 0


def test_it_only_fades_outwards(ring):
    aureole = found(LAYERS + ring)
    row = aureole[50, 90:]
    assert (np.diff(row) <= 1e-6).all()
    assert row[0] > 0.2


def test_clouds_on_one_side_and_layers_are_none():
    clouds = 0.8 * ((COLUMNS > 112) & (COLUMNS < 130) & (ROWS > 30) & (ROWS < 70))
    assert found(LAYERS + clouds).max() < 0.02


def test_a_sky_darker_beside_its_sun_keeps_its_light(ring):
    assert found(LAYERS - ring).max() < 0.02


def test_where_nothing_is_hidden_nothing_is_found(ring):
    picture = np.repeat(ring[..., None], 3, -1).astype(np.float32)
    assert not find_aureole(picture, KNOWN, np.zeros_like(HIDDEN), (90.0, 50.0)).any()
