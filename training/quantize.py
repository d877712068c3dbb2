"""Weights as bytes: whole numbers from -127 to 127 times one scale per output channel."""

from __future__ import annotations

import numpy as np

LARGEST = 127
_CUTS = np.linspace(0.7, 1.0, 13)  # shares of a channel's largest weight that may be cut off


def to_bytes(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return whole numbers and scales whose product is nearest to weights, channel by channel.

    A few large weights of a channel may be cut off for the sake of the others.

    Parameters
    ----------
    values : (channels, ...) float32

    Returns
    -------
    whole : (channels, ...) int8
    scales : (channels, 1, ...) float32
    """
    flat = values.reshape(len(values), -1).astype(np.float32)
    largest = np.abs(flat).max(1, keepdims=True)
    largest = np.where(largest > 0, largest, 1)
    tried = [cut * largest / LARGEST for cut in _CUTS]
    errors = [((_rounded(flat, scales) * scales - flat) ** 2).sum(1) for scales in tried]
    best = np.argmin(errors, axis=0)[:, None]
    scales = np.take_along_axis(np.hstack(tried), best, 1).astype(np.float32)
    whole = _rounded(flat, scales).astype(np.int8).reshape(values.shape)
    return whole, scales.reshape(-1, *(1,) * (values.ndim - 1))


def from_bytes(whole: np.ndarray, scales: np.ndarray) -> np.ndarray:
    """Return the weights (channels, ...) float32 that ``to_bytes`` stored."""
    return np.asarray(whole.astype(np.float32) * scales)


def _rounded(flat: np.ndarray, scales: np.ndarray) -> np.ndarray:
    return np.clip(np.round(flat / scales), -LARGEST, LARGEST)
