"""What is alike all round a point."""

import numpy as np

from sunwidget.analysis.images.rings import all_round, interpolated

ROWS, COLUMNS = np.mgrid[:60, :80] + 0.5
AWAY = np.hypot(COLUMNS - 40, ROWS - 20)
FALL = np.exp(-AWAY / 15)[..., None] * np.float32([1.0, 0.5, 0.1])


def test_a_round_light_comes_back_though_a_quarter_of_each_ring_is_brighter():
    brighter = (np.arctan2(ROWS - 20, COLUMNS - 40) > np.pi / 2)[..., None] * 2.0
    field = interpolated(AWAY, *all_round(FALL + brighter, AWAY < 50, AWAY, 2.0))
    assert np.abs(field - FALL)[(AWAY > 4) & (AWAY < 45)].max() < 0.06


def test_pixels_outside_the_part_do_not_count_and_missing_rings_are_interpolated():
    part = (np.abs(AWAY - 20) > 4) & (COLUMNS > 20)
    values = np.where(part[..., None], FALL, 9.0)
    middles, profile = all_round(values, part, AWAY, 2.0)
    assert not np.any(np.abs(middles - 20) < 2)
    assert profile.max() < 1
    assert np.abs(interpolated(AWAY, middles, profile) - FALL)[np.abs(AWAY - 20) < 3].max() < 0.1


def test_of_nothing_there_is_no_profile():
    middles, profile = all_round(FALL, AWAY < 0, AWAY, 2.0)
    assert middles.shape == (0,)
    assert profile.shape == (0, 3)
    assert not interpolated(AWAY, middles, profile).any()
