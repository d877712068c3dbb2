"""Weights stored as bytes are near what was trained, channel by channel."""

import numpy as np
import pytest

from training.quantize import from_bytes, to_bytes

CHANCE = np.random.default_rng(7)


@pytest.fixture
def weights():
    """Channels of very different sizes, as convolutions with merged normalization have them."""
    sizes = np.geomspace(1e-3, 10, 24, dtype=np.float32)[:, None, None, None]
    return CHANCE.normal(size=(24, 16, 3, 3)).astype(np.float32) * sizes


def test_every_channel_is_as_precise_as_its_own_size_allows(weights):
    whole, scales = to_bytes(weights)
    assert whole.dtype == np.int8
    assert whole.shape == weights.shape
    assert scales.dtype == np.float32
    assert scales.shape == (24, 1, 1, 1)
    off = from_bytes(whole, scales) - weights
    share = np.sqrt((off**2).mean((1, 2, 3)) / (weights**2).mean((1, 2, 3)))
    assert share.max() < 0.01


def test_one_large_weight_does_not_coarsen_the_others(weights):
    weights[:, 0, 0, 0] = 4.2 * np.abs(weights).max((1, 2, 3))
    whole, scales = to_bytes(weights)
    plain = np.abs(weights).max((1, 2, 3), keepdims=True) / 127
    coarse = np.round(weights / plain) * plain

    def error(found):
        return ((found - weights) ** 2).sum((1, 2, 3))

    assert (error(from_bytes(whole, scales)) <= error(coarse) * (1 + 1e-5)).all()


def test_storing_again_changes_nothing(weights):
    whole, scales = to_bytes(weights)
    again = to_bytes(from_bytes(whole, scales))
    np.testing.assert_array_equal(again[0], whole)
    np.testing.assert_allclose(again[1], scales, rtol=1e-6)


def test_a_channel_of_zeros_stays_one():
    whole, scales = to_bytes(np.zeros((2, 5), np.float32))
    assert not from_bytes(whole, scales).any()
    assert np.isfinite(scales).all()
