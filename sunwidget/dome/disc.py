"""The sun's disc drawn into a map: its pixels, however few, emit its whole light."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from sunwidget.atmosphere.color import spectral_to_rec709
from sunwidget.atmosphere.constants import SUN_ANGULAR_RADIUS_DEG
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.sun import disc_radiance
from sunwidget.dome.sphere import solid_angles

# Samples of the sun's disc along its radius and around it.
_RINGS, _SPOKES = 48, 96


def sun_disc(
    atmosphere: Atmosphere, azimuth: float, elevation: float, size: tuple[int, int]
) -> NDArray[np.float64]:
    """Return the sun's disc: it is split into equal parts, each added to the pixel it falls on."""
    width, height = size
    share = np.sqrt((np.arange(_RINGS) + 0.5) / _RINGS)  # rings of equal area
    angle = (np.arange(_SPOKES) + 0.5) / _SPOKES * 2 * np.pi
    distance, around = (a.ravel() for a in np.meshgrid(share * SUN_ANGULAR_RADIUS_DEG, angle))
    up = elevation + distance * np.sin(around)
    # A part of the disc past the zenith lies on the opposite side.
    level = np.cos(np.radians(np.clip(up, -89.9, 89.9)))
    across = azimuth + distance * np.cos(around) / level
    part = np.pi * np.radians(SUN_ANGULAR_RADIUS_DEG) ** 2 / len(up)  # steradians
    light = np.maximum(spectral_to_rec709(disc_radiance(atmosphere, up, distance)), 0) * part
    x = np.floor((across / 360 + 0.5) * width).astype(int) % width
    y = np.clip(np.floor((0.5 - up / 180) * height).astype(int), 0, height - 1)
    disc = np.zeros((height, width, 3))
    np.add.at(disc, (y, x), light)
    return np.asarray(disc / solid_angles(width)[..., None])


def disc_with_illuminance(
    direct: NDArray[np.float64], atmosphere: Atmosphere, sun: tuple[float, float], width: int
) -> NDArray[np.float32]:
    """Return a disc (width / 2, width, 3), 0.533° wide, whose pixels give exactly ``direct``.

    ``direct`` (3,) is the illuminance on a plane facing the sun, (azimuth, elevation).
    """
    if not direct.any():
        return np.zeros((width // 2, width, 3), np.float32)
    disc = sun_disc(atmosphere, *sun, (width, width // 2))
    drawn = (disc * solid_angles(width)[..., None]).sum((0, 1))
    return np.asarray(disc * (direct / np.maximum(drawn, 1e-30)), np.float32)
