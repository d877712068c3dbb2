"""What is alike all round a point of the picture, as light around the sun is and clouds are not."""

from __future__ import annotations

import numpy as np

_FEWEST = 12  # pixels in one ring


def all_round(
    values: np.ndarray, part: np.ndarray, away: np.ndarray, pace: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return what two in three pixels at the same distance from a point exceed.

    Parameters
    ----------
    values : (h, w, c) float32
    part : (h, w) bool
        The pixels that count.
    away : (h, w) float
        Each pixel's distance from the point.
    pace : float
        Width of a ring, as ``away``.

    Returns
    -------
    distances : (n,) float64
        Middles of the rings with enough pixels, ascending; may be empty.
    profile : (n, c) float32
        The lower third quantile of ``values`` in each.
    """
    ring = (away[part] / pace).astype(int)
    inside = values[part]
    order = np.argsort(ring, kind="stable")
    found, first = np.unique(ring[order], return_index=True)
    rings = np.split(inside[order], first[1:])
    full = [i for i, pixels in enumerate(rings) if len(pixels) >= _FEWEST]
    profile = [np.quantile(rings[i], 1 / 3, axis=0) for i in full]
    middles = (found[full] + 0.5) * pace
    return middles, np.array(profile, np.float32).reshape(-1, values.shape[-1])


def interpolated(away: np.ndarray, middles: np.ndarray, profile: np.ndarray) -> np.ndarray:
    """Return a profile (n, c) at distances (h, w): (h, w, c) float32; 0 without a profile."""
    if not len(middles):
        return np.zeros((*away.shape, profile.shape[-1]), np.float32)
    columns = [np.interp(away, middles, channel) for channel in profile.T]
    return np.stack(columns, -1).astype(np.float32)
