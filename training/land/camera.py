"""Directions in a world's camera: to the right, up, and towards it.

``camera`` holds the vertical field of view, pitch and roll in radians, and the height of the eye.
"""

from __future__ import annotations

import numpy as np


def rays(camera: np.ndarray, shape: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Return unit vectors of the view, (H, W, 3), and distances over depths, (H, W)."""
    rows, columns = shape
    focal = 0.5 * rows / np.tan(float(camera[0]) / 2)
    x, y = (
        (np.arange(columns) + 0.5 - columns / 2) / focal,
        (rows / 2 - np.arange(rows) - 0.5) / focal,
    )
    view = np.stack([*np.meshgrid(x, y), np.full(shape, -1.0)], -1)
    length = np.linalg.norm(view, axis=-1)
    return view / length[..., None], length


def up(camera: np.ndarray) -> np.ndarray:
    """Return the world's up in the camera's right, up and towards it."""
    _, pitch, roll, _ = camera
    high, towards = np.cos(pitch), -np.sin(pitch)  # before the roll
    return np.float32([np.sin(roll) * high, np.cos(roll) * high, towards])


def to_sun(camera: np.ndarray, sun: np.ndarray) -> np.ndarray:
    """Return the unit vector to a sun in the camera's right, up and towards it."""
    (_, pitch, roll, _), (azimuth, elevation) = camera, sun[:2]
    right = np.cos(elevation) * np.sin(azimuth)
    ahead, high = np.cos(elevation) * np.cos(azimuth), np.sin(elevation)
    up = np.cos(pitch) * high - np.sin(pitch) * ahead
    towards = -np.cos(pitch) * ahead - np.sin(pitch) * high
    turn, aside = np.cos(roll), np.sin(roll)
    return np.float32([turn * right + aside * up, turn * up - aside * right, towards])
