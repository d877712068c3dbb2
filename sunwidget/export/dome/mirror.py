"""Where outside its picture a dome shows the picture again, mirrored.

Round the picture its columns go on mirrored at its left and right edges, stretched a little so
that they meet behind the camera; above its upper edge rows go on mirrored. Towards the zenith such
columns would run together in one point, so the sky there is a plane laid over it, on which the
upper part of the picture is mirrored in both directions. Between the two is a cross-fade.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from sunwidget.geometry.camera import Camera

Floats = NDArray[np.float64]

_LOWEST_TOP = 4.0  # degrees of sky above the horizon from which there is something to mirror
_HIGHEST_TOP = 75.0  # beyond, the rows of a picture bend round the zenith
_WIDEST = 300.0  # degrees of azimuth; nothing is left to fill
_FADE = (-5.0, 5.0)  # degrees above the picture's upper edge
_LEAN, _UNEVEN, _LOWER = 0.5, 0.4, 0.3  # how far no mirrored tile is like the next
_LOWEST_ROW = 0.3  # of the picture's sky, from which up it is shown near the zenith
_NEARER = 1.6  # clouds overhead are nearer than those that a level camera sees
_BEND = 5.0  # degrees by which the lines are bent that it is mirrored at
_TURN = np.radians(33.0)  # so that the two mirrorings do not line up


@dataclass(frozen=True)
class Mirror:
    """The part of the sky that is mirrored: between two edges, from the horizon to ``top``.

    Parameters
    ----------
    top : float
        Degrees of elevation up to which the whole width of the picture shows sky.
    edges : (3, n)
        Elevations, rising, and the azimuths of the left and the right edge there, in degrees.
    """

    top: float
    edges: Floats

    def around(self, azimuth: Floats, elevation: Floats) -> tuple[Floats, Floats]:
        """Return the direction in the picture that stands for one anywhere on the dome."""
        low = 0.15 * self.top
        height = np.where(elevation > self.top, 2 * self.top - elevation, elevation)
        height = np.clip(height, np.minimum(elevation, low), self.top)
        left, right = self._edges_at(height)
        width = right - left
        count = np.maximum(1, 2 * np.round((360 / width - 2) / 2) + 1)  # odd: they meet mirrored
        beyond = (azimuth - right) % 360  # 0 at the right edge, growing to the right
        outside = beyond <= 360 - width
        way = np.where(outside, beyond / (360 - width), 0)  # 0 and 1 at the picture's edges
        tiles = way * count + _UNEVEN * np.sin(2 * np.pi * way)
        tiles += _LEAN * np.sin(np.pi * way) ** 2 * (height / self.top - 0.5)
        share = np.where(outside, _folded(tiles + 1), (azimuth - left) % 360 / width)
        height = height * (1 - _LOWER * np.sin(np.pi * way) ** 2)
        left, right = self._edges_at(height)
        return left + share * (right - left), height

    def overhead(self, azimuth: Floats, elevation: Floats) -> tuple[Floats, Floats]:
        """Return the direction in the picture that stands for one near the zenith."""
        distance = (90 - elevation) / _NEARER
        angle = np.radians(azimuth) + _TURN
        up, aside = distance * np.cos(angle), distance * np.sin(angle)
        up, aside = up + _BEND * np.sin(aside / 13), aside + _BEND * np.sin(up / 19)
        low = _LOWEST_ROW * self.top
        height = low + (self.top - low) * _folded(up / (self.top - low))
        left, right = self._edges_at(height)
        middle, half = (left + right) / 2, (right - left) / 2
        across = aside / np.cos(np.radians(height))
        return left + 2 * half * _folded((across - middle) / (2 * half) + 0.5), height

    def overhead_share(self, elevation: Floats) -> Floats:
        """How much of the sky at an elevation is ``overhead``'s, the rest ``around``'s."""
        low, high = self.top + _FADE[0], min(self.top + _FADE[1], 88.0)
        x = np.clip((elevation - low) / (high - low), 0, 1)
        return np.asarray(x * x * (3 - 2 * x))

    def _edges_at(self, elevation: Floats) -> tuple[Floats, Floats]:
        heights, left, right = self.edges
        return np.interp(elevation, heights, left), np.interp(elevation, heights, right)


def mirror_of(camera: Camera) -> Mirror | None:
    """Return how a camera's picture is mirrored; None where it shows too little sky for that."""
    across = np.linspace(0, camera.width, 65)
    _, upper = camera.angles(across, 0 * across)
    top = min(float(np.min(upper)), _HIGHEST_TOP)
    if top < _LOWEST_TOP or not 0 < camera.pitch + camera.fov_vertical_deg / 2 < 85:
        return None
    down = np.linspace(0, camera.height, 257)
    heights = np.linspace(0, top, 129)
    sides = []
    for x in (0, camera.width):
        azimuth, elevation = camera.angles(np.full_like(down, x), down)
        order = np.argsort(elevation)
        sides.append(np.interp(heights, elevation[order], azimuth[order]))
    left, right = sides
    if np.any(right - left < 2) or np.any(right - left > _WIDEST):
        return None
    return Mirror(top, np.stack([heights, left, right]))


def _folded(share: Floats) -> Floats:
    """Fold any number into [0, 1], mirrored at each whole one."""
    return np.asarray(1 - np.abs(share % 2 - 1))
