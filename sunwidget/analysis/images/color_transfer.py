"""Match the camera's colors: Reinhard's transfer over sky pixels (thesis 3.2.3).

Source: Reinhard et al., "Color transfer between images", 2001, equations 4–10. Linear RGB is
converted to cone responses LMS, to their logarithm, and to the decorrelated space lαβ.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

RGB_TO_LMS = np.array(
    [[0.3811, 0.5783, 0.0402], [0.1967, 0.7244, 0.0782], [0.0241, 0.1288, 0.8444]]
)
LMS_TO_LAB = np.diag([1 / np.sqrt(3), 1 / np.sqrt(6), 1 / np.sqrt(2)]) @ np.array(
    [[1.0, 1, 1], [1, 1, -2], [1, -1, 0]]
)
FLOOR = 1e-4  # of cone response: below one step of 8-bit linear light; keeps log10 finite

Vector = tuple[float, float, float]


class Statistics(NamedTuple):
    """Mean and standard deviation in lαβ."""

    mean: Vector
    deviation: Vector


def to_lab(linear: np.ndarray) -> np.ndarray:
    """Convert linear RGB (…, 3) to lαβ (…, 3)."""
    lms = np.maximum(np.maximum(np.asarray(linear, np.float64), 0) @ RGB_TO_LMS.T, FLOOR)
    return np.log10(lms) @ LMS_TO_LAB.T


def from_lab(lab: np.ndarray) -> np.ndarray:
    """Convert lαβ (…, 3) to linear RGB (…, 3); the inverse of ``to_lab`` above its floor."""
    lms = np.power(10.0, np.asarray(lab) @ np.linalg.inv(LMS_TO_LAB).T)
    return lms @ np.linalg.inv(RGB_TO_LMS).T


def statistics(linear: np.ndarray, weight: np.ndarray | None = None) -> Statistics:
    """Return weighted mean and deviation of linear pixels (…, 3) in lαβ; zeros without weight."""
    return statistics_of_lab(to_lab(linear), weight)


def statistics_of_lab(lab: np.ndarray, weight: np.ndarray | None = None) -> Statistics:
    """Return weighted mean and deviation of pixels that are in lαβ already."""
    lab = lab.reshape(-1, 3)
    share = np.ones(len(lab)) if weight is None else np.asarray(weight, np.float64).ravel()
    total = share.sum()
    if total < 1e-6:
        return Statistics((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    mean = share @ lab / total
    variance = share @ (lab - mean) ** 2 / total
    return Statistics(_vector(mean), _vector(np.sqrt(np.maximum(variance, 0))))


def transfer(linear: np.ndarray, source: Statistics, target: Statistics) -> np.ndarray:
    """Change linear pixels (…, 3) from the statistics ``source`` to those of ``target``.

    A channel without spread in the source has a gain of 1, instead of a division by zero.
    """
    spread = np.asarray(source.deviation)
    gain = np.where(spread > 1e-4, np.asarray(target.deviation) / np.maximum(spread, 1e-4), 1.0)
    lab = (to_lab(linear) - np.asarray(source.mean)) * gain + np.asarray(target.mean)
    return np.maximum(from_lab(lab), 0)


def _vector(values: np.ndarray) -> Vector:
    return (float(values[0]), float(values[1]), float(values[2]))
