"""Depth: metres along the optical axis, from the ground plane.

``METHODS`` maps a name to a function ``(sky, Camera) -> (h, w) float32``.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from sunwidget.camera import Camera

EYE_HEIGHT = 1.7  # metres; scales all depths
FAR = 20_000.0  # metres: land that the ground plane puts at or above the horizon


def ground_plane(sky: np.ndarray, camera: Camera) -> np.ndarray:
    """Flat ground below the horizon; what stands on it takes the depth of its contact row.

    A column is read from the frame upwards: ground as far as the picture is lower than the
    horizon, and land above the horizon stands where the ground under it ends. The sky is inf.
    """
    height, width = sky.shape
    x = np.arange(width) + 0.5
    y = np.arange(height)[:, None] + 0.5
    # Direction to the pixel with unit depth along the axis; its fall below the horizon a metre.
    u, v = (x - width / 2) / camera.focal, (y - height / 2) / camera.focal
    fall = -(u * camera.up[0] + v * camera.up[1] + camera.up[2])
    ground = np.where(fall > EYE_HEIGHT / FAR, EYE_HEIGHT / np.maximum(fall, 1e-9), FAR)
    return np.where(sky > 0.5, np.inf, ground).astype(np.float32)


METHODS: dict[str, Callable[[np.ndarray, Camera], np.ndarray]] = {"ground_plane": ground_plane}
