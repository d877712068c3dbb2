"""Haze outlined by hand, as shares of the light and where they are known."""

import numpy as np
import pytest

from training.land import haze

SKY = np.zeros((100, 200), np.uint8)
SKY[:20], SKY[20:24] = 255, 128


@pytest.fixture
def outlined(monkeypatch):
    square = np.array([[0.2, 0.3], [0.6, 0.3], [0.6, 0.8], [0.2, 0.8]])
    inner = np.array([[0.3, 0.4], [0.5, 0.4], [0.5, 0.7], [0.3, 0.7]])
    found = {"a": [(0.5, square), (0.75, inner)], "b": [(-1.0, square)], "c": []}
    monkeypatch.setattr(haze, "outlines", lambda: found)


def test_later_outlines_paint_over_earlier_ones_and_the_rest_is_clear(outlined):
    share, known = haze.haze_map("a", SKY)
    assert share[55, 80] == 0.75
    assert share[35, 50] == 0.5
    assert share[90, 10] == 0
    assert known[55, 80] & known[35, 50] & known[90, 10]


def test_borders_sky_and_what_nobody_can_tell_are_not_known(outlined):
    share, known = haze.haze_map("a", SKY)
    assert not known[:24].any()
    assert not known[30, 80]
    assert not known[40, 80]
    share, known = haze.haze_map("b", SKY)
    assert not known[55, 80]
    assert share.min() == share.max() == 0
    assert haze.haze_map("c", SKY)[1][30:].all()


def test_the_table_holds_levels_and_polygons_inside_the_picture():
    found = haze.outlines()
    assert len(found) > 150
    assert 0.15 < np.mean([haze.judges(file) for file in found]) < 0.35
    regions = [region for regions in found.values() for region in regions]
    assert {share for share, _ in regions} == set(haze.SHARES.values())
    for _, polygon in regions:
        assert len(polygon) >= 3
        assert -0.02 <= polygon.min() <= polygon.max() <= 1.02
    assert any(not regions for regions in found.values())
