"""Directions, solid angles and irradiance of an equirectangular map.

The middle column is azimuth 0, azimuth grows to the right, the top row is the zenith. Vectors have
x at azimuth 0, y at -90° (to its left) and z up.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def angles(width: int) -> tuple[Array, Array]:
    """Return azimuth and elevation (width / 2, width) of a map's pixels, in degrees."""
    azimuth = ((np.arange(width) + 0.5) / width - 0.5) * 360
    elevation = 90 - (np.arange(width // 2) + 0.5) / width * 360
    across, up = np.meshgrid(azimuth, elevation)
    return across, up


def solid_angles(width: int) -> Array:
    """Return the steradians (width / 2, 1) of the pixels of each row."""
    edges = np.sin(np.radians(90 - np.arange(width // 2 + 1) / width * 360))
    return np.asarray((edges[:-1] - edges[1:])[:, None] * 2 * np.pi / width)


def irradiance(light: NDArray[Any], normal: tuple[float, float, float] = (0, 0, 1)) -> Any:
    """Return the irradiance (3,) of a map on a plane, by channel.

    Parameters
    ----------
    light : (H, W, 3)
        Radiance; in kcd m⁻² it gives klx.
    normal : (x, y, z)
        Normal of the plane: x to azimuth 0, y to the left of it, z up.
    """
    width = light.shape[1]
    azimuth, elevation = (np.radians(a) for a in angles(width))
    facing = np.cos(elevation) * (np.cos(azimuth) * normal[0] - np.sin(azimuth) * normal[1])
    facing = np.maximum(facing + np.sin(elevation) * normal[2], 0) * solid_angles(width)
    return np.einsum("ij,ijk->k", facing, light, dtype=np.float64)


def distance(sun: tuple[float, float], azimuth: Array, elevation: Array) -> Array:
    """Return the angle (…) in degrees between a sun, (azimuth, elevation), and directions."""
    up, down = np.radians(sun[1]), np.radians(elevation)
    turn = np.radians(azimuth - sun[0])
    cosine = np.sin(up) * np.sin(down) + np.cos(up) * np.cos(down) * np.cos(turn)
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def toward(azimuth: Any, elevation: Any) -> Array:
    """Return the unit vectors (…, 3) of directions in degrees."""
    across, up = np.radians(azimuth), np.radians(elevation)
    level = np.cos(up)
    return np.stack([level * np.cos(across), -level * np.sin(across), np.sin(up)], axis=-1)


def direction_of(vector: Array) -> tuple[float, float]:
    """Return the azimuth and elevation in degrees of a vector (3,) of any length."""
    x, y, z = (float(part) for part in vector)
    return float(np.degrees(np.arctan2(-y, x))), float(np.degrees(np.arctan2(z, np.hypot(x, y))))


def pixel_of(azimuth: Any, elevation: Any, width: int) -> tuple[Array, Array]:
    """Return continuous pixels (x, y) of directions in degrees, x in [0, width)."""
    x = (np.asarray(azimuth, float) / 360 + 0.5) % 1 * width
    x, y = np.broadcast_arrays(x, (90 - np.asarray(elevation, float)) / 360 * width)
    return x, y


def sample(image: NDArray[np.float32], azimuth: Any, elevation: Any) -> NDArray[np.float32]:
    """Return a map (H, W[, n]) in some directions, interpolated across its seam."""
    import cv2

    # Three extra columns on either side, since OpenCV cannot wrap a single axis.
    wide = np.concatenate([image[:, -3:], image, image[:, :3]], axis=1)
    x, y = pixel_of(azimuth, elevation, image.shape[1])
    shape = x.shape
    at = [part.reshape(-1, shape[-1]).astype(np.float32) for part in (x + 2.5, y - 0.5)]
    found = cv2.remap(wide, at[0], at[1], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(found, np.float32).reshape(shape + image.shape[2:])
