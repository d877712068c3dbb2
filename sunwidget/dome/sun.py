"""The sun in an environment map: the position and the light of its disc."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.atmosphere.constants import SUN_ANGULAR_RADIUS_DEG
from sunwidget.dome.sphere import Array, angles, direction_of, distance, solid_angles, toward
from sunwidget.formats.color import LUMINANCE

DISC = 2.5
"""Degrees around the sun within which light above the surroundings is the sun's."""
_BESIDE = (2.5, 4.0)  # degrees: the surroundings
_CORE = 0.6  # degrees that contain a disc's light, even with coarse pixels
_STANDS_OUT = 15.0  # times its surroundings; less is a bright cloud, a lamp or a clipped disc
_NEAR_THE_TOP = 0.8  # of the brightest pixel; such pixels form a plateau if they are too many
_PLATEAU = 3.0  # times the solid angle of the disc or of a pixel
_SMOOTH = 0.5  # degrees


@dataclass(frozen=True)
class FoundSun:
    """A disc, or the brightest spot if there is no disc.

    Parameters
    ----------
    azimuth, elevation : float
        Degrees.
    illuminance : (3,)
        On a plane facing it, by the light above the surrounding sky; the map's unit times sr.
    contrast : float
        Mean light of its core over that of its surroundings, minus 1.
    clipped : bool
        Whether the map clips the disc's light.
    """

    azimuth: float
    elevation: float
    illuminance: Array
    contrast: float
    clipped: bool

    @property
    def stands_out(self) -> bool:
        """Whether it is a disc, not a bright cloud."""
        return self.contrast > _STANDS_OUT


def find_disc(
    light: NDArray[Any], sky: NDArray[Any], near: tuple[float, float] | None = None
) -> FoundSun:
    """Return the brightest compact spot of the sky, and its light.

    Parameters
    ----------
    light : (H, W, 3)
        The map.
    sky : (H, W)
        Its sky, [0, 1].
    near : (azimuth, elevation), optional
        A hint. The disc is searched within 3° of it; the hint is kept if no disc stands out.
    """
    import cv2

    width = light.shape[1]
    azimuth, elevation = angles(width)
    level = np.asarray(light @ LUMINANCE, np.float64)
    # The network's sky mask may exclude a bright sun by the width of its glare.
    around = cv2.dilate((sky > 0.5).astype(np.uint8), np.ones((2 * (width // 180) + 1,) * 2)) > 0
    allowed = around & (elevation > -0.5)
    if near is not None:
        allowed = distance(near, azimuth, elevation) < 3
    smooth = cv2.GaussianBlur(np.where(allowed, level, 0), (0, 0), max(_SMOOTH * width / 360, 0.5))
    row, column = np.unravel_index(int(np.argmax(np.where(allowed, smooth, -1))), smooth.shape)
    place = float(azimuth[row, column]), float(elevation[row, column])
    solid, vectors = solid_angles(width), toward(azimuth, elevation)
    for _ in range(4):
        apart = distance(place, azimuth, elevation)
        excess = np.maximum(level - _surroundings(level, apart, elevation), 0) * (apart < DISC)
        if not excess.any():
            break
        # Weighted by squared light, so that asymmetric glare pulls less.
        place = direction_of(((excess**2 * solid)[..., None] * vectors).sum((0, 1)))
    apart = distance(place, azimuth, elevation)
    beside = np.array([_surroundings(light[..., i], apart, elevation) for i in range(3)])
    own = np.maximum(light - beside, 0) * ((apart < DISC) * solid)[..., None]
    core = apart <= max(_CORE, 0.75 * 360 / width)
    around_level = max(_surroundings(level, apart, elevation), 1e-12)
    contrast = float(level[core].mean()) / around_level - 1 if core.any() else 0.0
    if near is not None and contrast < _STANDS_OUT:
        place = near
    return FoundSun(*place, own.sum((0, 1)), contrast, _is_cut_off(level, apart, solid))


def _surroundings(level: NDArray[Any], apart: Array, elevation: Array) -> float:
    ring = (apart > _BESIDE[0]) & (apart < _BESIDE[1]) & (elevation > 0)
    return float(np.median(level[ring])) if ring.any() else 0.0


def _is_cut_off(level: Array, apart: Array, solid: Array) -> bool:
    near = apart < 2 * DISC
    top = near & (level > _NEAR_THE_TOP * level[near].max())
    pixel = 2 * np.pi * np.pi / level.shape[0] / level.shape[1]
    disc = np.pi * np.radians(SUN_ANGULAR_RADIUS_DEG) ** 2
    return bool((top * solid).sum() > _PLATEAU * max(disc, pixel))
