"""Encoding of linear light, and random lengths: what all drawings of suns have in common."""

from __future__ import annotations

import numpy as np

Random = np.random.Generator

LUMINANCE = np.array([0.2126, 0.7152, 0.0722], np.float32)


def _srgb(x: np.ndarray) -> np.ndarray:
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


_STEPS = 16384
_ENCODED = _srgb(np.linspace(0, 1, _STEPS)).astype(np.float32)
_LINEAR = np.interp(np.linspace(0, 1, _STEPS), _ENCODED, np.linspace(0, 1, _STEPS))
_LINEAR = _LINEAR.astype(np.float32)


def to_linear(encoded: np.ndarray) -> np.ndarray:
    """sRGB in [0, 1] to linear, by table."""
    return _LINEAR[(encoded * np.float32(_STEPS - 1)).astype(np.int32)]


def to_encoded(linear: np.ndarray) -> np.ndarray:
    """Linear to sRGB, clipped, by table."""
    return _ENCODED[(np.clip(linear, 0, 1) * np.float32(_STEPS - 1)).astype(np.int32)]


def log_uniform(random: Random, low: float, high: float) -> float:
    return float(np.exp(random.uniform(np.log(low), np.log(high))))
