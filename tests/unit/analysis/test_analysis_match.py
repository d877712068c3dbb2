"""Colour matching in lαβ (Reinhard 2001)."""

import numpy as np
import pytest

from sunwidget.analysis.images import color_transfer

RNG = np.random.default_rng(0)
SKY = np.array([0.2, 0.35, 0.7]) * np.exp(0.2 * RNG.standard_normal((500, 3)))
DUSK = np.array([0.6, 0.3, 0.15]) * np.exp(0.4 * RNG.standard_normal((400, 3)))


def test_space_and_back_changes_nothing_above_the_floor():
    assert color_transfer.from_lab(color_transfer.to_lab(SKY)) == pytest.approx(SKY, rel=1e-9)


def test_grey_has_hardly_any_colour_in_the_opponent_channels():
    # The published matrix' rows sum to 0.9996 … 0.9993, not 1: hence not exactly zero.
    lab = color_transfer.to_lab(np.full((1, 3), 0.4))
    assert abs(lab[0, 1]) < 1e-3
    assert abs(lab[0, 2]) < 1e-3


def test_transfer_gives_the_target_its_mean_and_deviation():
    source, target = color_transfer.statistics(SKY), color_transfer.statistics(DUSK)
    moved = color_transfer.to_lab(
        color_transfer.from_lab(
            (color_transfer.to_lab(SKY) - source.mean)
            * np.divide(target.deviation, source.deviation)
            + target.mean
        )
    )
    assert moved.mean(axis=0) == pytest.approx(target.mean, abs=1e-9)
    assert moved.std(axis=0) == pytest.approx(target.deviation, abs=1e-9)
    assert color_transfer.transfer(SKY, source, target) == pytest.approx(
        np.maximum(color_transfer.from_lab(moved), 0), abs=1e-9
    )


def test_transfer_to_own_statistics_is_the_identity():
    own = color_transfer.statistics(SKY)
    assert color_transfer.transfer(SKY, own, own) == pytest.approx(SKY, rel=1e-9)


def test_weights_select_pixels():
    both = np.concatenate([SKY, DUSK])
    weight = np.r_[np.ones(len(SKY)), np.zeros(len(DUSK))]
    for chosen, all_of_sky in zip(
        color_transfer.statistics(both, weight), color_transfer.statistics(SKY), strict=True
    ):
        assert chosen == pytest.approx(all_of_sky)


def test_black_pixels_and_empty_selections_stay_finite():
    black = color_transfer.statistics(np.zeros((10, 3)))
    empty = color_transfer.statistics(SKY, np.zeros(len(SKY)))
    assert np.isfinite(black.mean).all()
    assert empty.deviation == (0, 0, 0)
    flat = color_transfer.statistics(np.full((10, 3), 0.3))
    assert np.isfinite(color_transfer.transfer(SKY, flat, color_transfer.statistics(DUSK))).all()
