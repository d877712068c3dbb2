"""Conversion between pixels and directions; the twin of ``explorer/projection.glsl``.

Three projections: the dome (equidistant fisheye), the panorama (equirectangular, -10 to 90
degrees) and the camera (perspective). Azimuths increase clockwise; the dome is seen from below, so
east is left of north. ``js/src/explorer/projection.js`` is the browser's twin.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sunwidget.explorer.table import PROJECTIONS

Array = NDArray[np.float64]

DOME_SHARE = 0.94
"""Diameter of the dome over the smaller side; the rest is space for labels."""
PANORAMA_BOTTOM = -10.0
PANORAMA_HEIGHT = 100.0


@dataclass(frozen=True, kw_only=True)
class Projection:
    """The projection of the sky in one picture.

    Parameters
    ----------
    name : {"dome", "panorama", "camera"}
        Kind of projection.
    size : (width, height)
        Size of the picture in pixels.
    view_azimuth : float
        Azimuth at the top of the dome and in the middle of the others, degrees.
    view_elevation, fov : float
        Elevation in the middle of the camera's picture, and its vertical field of view, degrees.

    Raises
    ------
    ValueError
        For an unknown name.
    """

    name: str
    size: tuple[int, int]
    view_azimuth: float = 0.0
    view_elevation: float = 12.0
    fov: float = 60.0

    def __post_init__(self) -> None:
        if self.name not in PROJECTIONS:
            raise ValueError(
                f"projection must be one of {', '.join(PROJECTIONS)}, not {self.name!r}."
            )

    @property
    def scale(self) -> float:
        """In pixels: the dome's radius, a degree of the panorama, or the camera's focal length."""
        width, height = self.size
        if self.name == "dome":
            return 0.5 * DOME_SHARE * min(width, height)
        if self.name == "panorama":
            return min(width / 360, height / PANORAMA_HEIGHT)
        return float(0.5 * height / np.tan(0.5 * np.radians(self.fov)))

    def direction(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Return azimuth and elevation in degrees at picture coordinates, shape (..., 2).

        NaN for pixels without sky.
        """
        width, height = self.size
        right, up = np.broadcast_arrays(
            np.asarray(x, float) - 0.5 * width, 0.5 * height - np.asarray(y, float)
        )
        if self.name == "dome":
            share = np.hypot(right, up) / self.scale
            azimuth = self.view_azimuth + np.degrees(np.arctan2(-right, up))
            elevation = np.where(share <= 1, 90 * (1 - share), np.nan)
        elif self.name == "panorama":
            angle = right / self.scale
            azimuth = np.where(np.abs(angle) <= 180, self.view_azimuth + angle, np.nan)
            elevation = PANORAMA_BOTTOM + 0.5 * PANORAMA_HEIGHT + up / self.scale
            below = elevation < PANORAMA_BOTTOM
            elevation = np.where(below | (elevation > 90) | np.isnan(azimuth), np.nan, elevation)
        else:
            rise = np.radians(self.view_elevation)
            ahead = self.scale * np.cos(rise) - up * np.sin(rise)
            above = self.scale * np.sin(rise) + up * np.cos(rise)
            azimuth = self.view_azimuth + np.degrees(np.arctan2(right, ahead))
            elevation = np.degrees(np.arctan2(above, np.hypot(right, ahead)))
        azimuth = np.where(np.isnan(elevation), np.nan, (azimuth + 180) % 360 - 180)
        return np.stack([azimuth, elevation], axis=-1)

    def pixel(self, azimuth: ArrayLike, elevation: ArrayLike) -> Array:
        """Return picture coordinates of directions in degrees, shape (..., 2).

        They may be outside the picture; NaN behind the camera.
        """
        width, height = self.size
        turn = (np.asarray(azimuth, float) - self.view_azimuth + 180) % 360 - 180
        turn, elevation = np.broadcast_arrays(turn, np.asarray(elevation, float))
        if self.name == "dome":
            radius = self.scale * (1 - elevation / 90)
            right, up = -radius * np.sin(np.radians(turn)), radius * np.cos(np.radians(turn))
        elif self.name == "panorama":
            right = turn * self.scale
            up = (elevation - PANORAMA_BOTTOM - 0.5 * PANORAMA_HEIGHT) * self.scale
        else:
            rise, side, high = (
                np.radians(self.view_elevation),
                np.radians(turn),
                np.radians(elevation),
            )
            level = np.cos(high) * np.cos(side)
            ahead = level * np.cos(rise) + np.sin(high) * np.sin(rise)
            focal = np.where(ahead > 1e-6, self.scale / np.where(ahead > 1e-6, ahead, 1), np.nan)
            right = focal * np.cos(high) * np.sin(side)
            up = focal * (np.sin(high) * np.cos(rise) - level * np.sin(rise))
        return np.stack([0.5 * width + right, 0.5 * height - up], axis=-1)
