"""Ground plane: depth from the fall of a ray below the horizon."""

from __future__ import annotations

import numpy as np

EYE_HEIGHT = 1.7  # metres above the ground: a guess that scales all depths of the ground
FAR = 20_000.0  # metres: more distant land looks the same
_SOFTEST = 0.008  # of the picture's height: most blur of the horizon
_UNEVEN = 0.25  # standard error of ln depth, since ground is neither flat nor level


def log_depth(fall: np.ndarray, error: float, focal: float, height: int) -> np.ndarray:
    """Return ln(metres) along the optical axis of flat ground.

    depth = eye height / fall. Since the horizon's row has an error e, the fall becomes
    e · ln(1 + exp(fall / e)): the same well below the horizon, smooth across it, and never 0.

    Parameters
    ----------
    fall : array
        Fall in metres per metre of depth (``view.ray_fall``).
    error, focal, height : float
        Standard error of the horizon, focal length, and height of the picture, in pixels.
    """
    soft = np.float32(min(error, _SOFTEST * height) / focal)
    ratio = np.asarray(fall, np.float32) / soft
    # ln(1 + e^x) without overflow, in a third of logaddexp's time.
    below = np.maximum(ratio, 0) + np.log1p(np.exp(-np.abs(ratio)))
    nearness = np.maximum(below * soft, np.float32(EYE_HEIGHT / FAR))
    return np.asarray(np.float32(np.log(EYE_HEIGHT)) - np.log(nearness))


def log_error(fall: np.ndarray, error: float, focal: float) -> np.ndarray:
    """Return the standard error of ``log_depth`` in ln metres, apart from the eye's height."""
    share = error / focal
    return np.asarray(np.hypot(_UNEVEN, share / np.maximum(fall, share / 2)))
