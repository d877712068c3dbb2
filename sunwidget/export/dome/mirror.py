"""The mapping from a dome's directions outside the photo to mirrored places in the photo.

Beside the photo its columns repeat mirrored at the left and right edges, stretched slightly so that
they meet behind the camera; above its upper edge its rows repeat mirrored. Towards the zenith such
columns would converge in one point. The sky there is a plane on which the upper part of the photo
is mirrored in both directions. The two mappings cross-fade.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from sunwidget.geometry.camera import Camera

Floats = NDArray[np.float64]

_LOWEST_TOP = 4.0  # least degrees of sky above the horizon that can be mirrored
_HIGHEST_TOP = 75.0  # above, the rows of a picture bend around the zenith
_WIDEST = 300.0  # degrees of azimuth; a wider picture leaves too little to fill
_FADE = (-5.0, 5.0)  # degrees above the picture's upper edge
_LEAN, _UNEVEN, _LOWER = 0.5, 0.4, 0.3  # variation between mirrored tiles
_LOWEST_ROW = 0.3  # share of the picture's sky, from below, that is not shown near the zenith
_NEARER = 1.6  # clouds overhead are nearer than those that a level camera sees
_BEND = 5.0  # degrees by which the mirror lines are bent
_TURN = np.radians(33.0)  # keeps the two mirrorings from lining up


@dataclass(frozen=True)
class Mirror:
    """The mirrored part of the sky: between two edges, from the horizon to ``top``.

    Parameters
    ----------
    top : float
        Elevation in degrees below which the full width of the picture shows sky.
    edges : (3, n)
        Increasing elevations and the azimuths of the left and right edge there, in degrees.
    """

    top: float
    edges: Floats

    def around(self, azimuth: Floats, elevation: Floats) -> tuple[Floats, Floats]:
        """Return the direction in the picture that a direction anywhere on the dome shows."""
        low = 0.15 * self.top
        height = np.where(elevation > self.top, 2 * self.top - elevation, elevation)
        height = np.clip(height, np.minimum(elevation, low), self.top)
        left, right = self._edges_at(height)
        width = right - left
        count = np.maximum(1, 2 * np.round((360 / width - 2) / 2) + 1)  # odd: they meet mirrored
        beyond = (azimuth - right) % 360  # 0 at the right edge, growing to the right
        outside = beyond <= 360 - width
        across = np.where(outside, beyond / (360 - width), 0)  # 0 and 1 at the picture's edges
        tiles = across * count + _UNEVEN * np.sin(2 * np.pi * across)
        tiles += _LEAN * np.sin(np.pi * across) ** 2 * (height / self.top - 0.5)
        share = np.where(outside, _folded(tiles + 1), (azimuth - left) % 360 / width)
        height = height * (1 - _LOWER * np.sin(np.pi * across) ** 2)
        left, right = self._edges_at(height)
        return left + share * (right - left), height

    def overhead(self, azimuth: Floats, elevation: Floats) -> tuple[Floats, Floats]:
        """Return the direction in the picture that a direction near the zenith shows."""
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
        """Return the weight of ``overhead`` at an elevation; the rest is that of ``around``."""
        low, high = self.top + _FADE[0], min(self.top + _FADE[1], 88.0)
        x = np.clip((elevation - low) / (high - low), 0, 1)
        return np.asarray(x * x * (3 - 2 * x))

    def _edges_at(self, elevation: Floats) -> tuple[Floats, Floats]:
        heights, left, right = self.edges
        return np.interp(elevation, heights, left), np.interp(elevation, heights, right)


def mirror_of(camera: Camera) -> Mirror | None:
    """Return the mirroring of a camera's picture; None if it shows too little sky."""
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
    """Fold any number into [0, 1], mirrored at each integer."""
    return np.asarray(1 - np.abs(share % 2 - 1))
