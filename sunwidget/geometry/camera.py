"""Camera: map a pixel to a direction and back, from the horizon and the field of view.

Pixels are continuous: the picture spans 0 … width and 0 … height, its center is
(width / 2, height / 2), and the sample in column i covers i … i + 1. Camera coordinates are x to
the right, y *down*, z along the optical axis. The horizon is a line l = p₀ × p₁ in homogeneous
pixels, and the direction to the zenith is up = Kᵀ l / |Kᵀ l| with up_y < 0 (Hartley & Zisserman,
*Multiple View Geometry*, 2004, section 8.6: the vanishing line's plane normal).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

Vector = tuple[float, float, float]
Point = tuple[float, float]


@dataclass(frozen=True)
class Camera:
    """A pinhole camera over a flat horizon.

    Parameters
    ----------
    width, height : int
        Size of the picture in pixels.
    fov_vertical_deg : float
        Vertical field of view in degrees, 0 < fov < 180.
    pitch : float
        Elevation of the optical axis above the horizon in degrees, −90 < pitch < 90.
    roll : float
        Degrees by which the horizon falls to the right in the picture (y grows with x).

    Raises
    ------
    ValueError
        For a size below one pixel, or an angle that is not finite or out of range.
    """

    width: int
    height: int
    fov_vertical_deg: float
    pitch: float = 0.0
    roll: float = 0.0

    def __post_init__(self) -> None:
        if self.width < 1 or self.height < 1:
            size = f"{self.width} × {self.height}"
            raise ValueError(f"A camera needs at least 1 × 1 pixels, not {size}.")
        if not 0 < self.fov_vertical_deg < 180:
            raise ValueError(
                "The vertical field of view must lie between 0° and 180°, "
                f"not {self.fov_vertical_deg!r}."
            )
        if not -90 < self.pitch < 90:
            raise ValueError(f"Pitch must lie between −90° and 90°, not {self.pitch!r}.")
        if not math.isfinite(self.roll):
            raise ValueError(f"Roll must be a finite number of degrees, not {self.roll!r}.")

    @classmethod
    def from_horizon(
        cls,
        width: int,
        height: int,
        fov_vertical_deg: float,
        horizon: float | tuple[Point, Point],
        roll: float = 0.0,
    ) -> Camera:
        """Find pitch and roll from the horizon in the picture.

        Parameters
        ----------
        width, height : int
            Size of the picture in pixels.
        fov_vertical_deg : float
            Vertical field of view in degrees.
        horizon : float or ((x0, y0), (x1, y1))
            Row of the horizon at the picture's center column, or two points of the horizon, in
            pixels. They may lie outside the picture.
        roll : float
            Roll in degrees; used only if ``horizon`` is a row.

        Returns
        -------
        Camera

        Raises
        ------
        ValueError
            When the two points have the same column, and as ``Camera``.
        """
        center = width / 2
        if isinstance(horizon, (tuple, list)):
            (x0, y0), (x1, y1) = horizon
            if x0 == x1:
                raise ValueError(f"The horizon needs two points with different x, not {horizon!r}.")
            slope = (y1 - y0) / (x1 - x0)
            row = y0 + slope * (center - x0)
        else:
            row, slope = float(horizon), math.tan(math.radians(roll))
        focal = height / 2 / math.tan(math.radians(fov_vertical_deg) / 2)
        # Kᵀ times the line slope·x − y + (row − slope·center) = 0; y is negative, which is up.
        up = (slope * focal, -focal, row - height / 2)
        length = math.hypot(*up)
        return cls(
            width,
            height,
            fov_vertical_deg,
            pitch=math.degrees(math.asin(up[2] / length)),
            roll=math.degrees(math.atan2(up[0], -up[1])),
        )

    @cached_property
    def focal(self) -> float:
        """Focal length in pixels."""
        return self.height / 2 / math.tan(math.radians(self.fov_vertical_deg) / 2)

    @cached_property
    def up(self) -> Vector:
        """Direction to the zenith in camera coordinates, unit length."""
        pitch, roll = math.radians(self.pitch), math.radians(self.roll)
        return (
            math.sin(roll) * math.cos(pitch),
            -math.cos(roll) * math.cos(pitch),
            math.sin(pitch),
        )

    @cached_property
    def forward(self) -> Vector:
        """Level direction of the camera's heading (azimuth 0), in camera coordinates."""
        x, y, z = self.up
        level = math.sqrt(1 - z * z)
        return (-z * x / level, -z * y / level, level)

    @cached_property
    def right(self) -> Vector:
        """Level direction to the camera's right (azimuth 90°), in camera coordinates."""
        (fx, fy, fz), (ux, uy, uz) = self.forward, self.up
        return (fy * uz - fz * uy, fz * ux - fx * uz, fx * uy - fy * ux)

    def angles(self, x: ArrayLike, y: ArrayLike) -> tuple[Any, Any]:
        """Convert pixels, also outside the picture, into azimuth and elevation.

        Parameters
        ----------
        x, y : float or array_like
            Continuous pixel coordinates, from the picture's top left corner.

        Returns
        -------
        azimuth, elevation : float or ndarray
            Degrees: azimuth from the camera's heading, positive to the right, −180 … 180;
            elevation above the horizon. Floats when both arguments are scalars.
        """
        u = (np.asarray(x, np.float64) - self.width / 2) / self.focal
        v = (np.asarray(y, np.float64) - self.height / 2) / self.focal
        length = np.sqrt(u * u + v * v + 1)

        def along(axis: Vector) -> Any:
            return (u * axis[0] + v * axis[1] + axis[2]) / length

        azimuth = np.degrees(np.arctan2(along(self.right), along(self.forward)))
        elevation = np.degrees(np.arcsin(np.clip(along(self.up), -1, 1)))
        return _scalars(azimuth, elevation)

    def pixel(self, azimuth: ArrayLike, elevation: ArrayLike) -> tuple[Any, Any]:
        """Convert azimuth and elevation into pixels, also outside the picture.

        Parameters
        ----------
        azimuth, elevation : float or array_like
            Degrees, as ``angles`` returns them.

        Returns
        -------
        x, y : float or ndarray
            Continuous pixel coordinates; NaN for a direction behind the camera. Floats when both
            arguments are scalars.
        """
        a = np.radians(np.asarray(azimuth, np.float64))
        e = np.radians(np.asarray(elevation, np.float64))
        level_forward, level_right, rise = np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)
        d = [
            level_forward * f + level_right * r + rise * u
            for f, r, u in zip(self.forward, self.right, self.up, strict=True)
        ]
        depth = np.where(d[2] > 1e-9, d[2], np.nan)
        return _scalars(
            self.width / 2 + self.focal * d[0] / depth,
            self.height / 2 + self.focal * d[1] / depth,
        )

    def horizon_row(self, x: ArrayLike | None = None) -> Any:
        """Return the row of the horizon in column ``x`` (default: the center), in pixels."""
        column = self.width / 2 if x is None else np.asarray(x, np.float64)
        ux, uy, uz = self.up
        row = self.height / 2 - (ux * (column - self.width / 2) + uz * self.focal) / uy
        return float(row) if np.ndim(row) == 0 else row

    def resized(self, width: int, height: int) -> Camera:
        """Return the same camera for a picture of ``width`` × ``height`` pixels (same shape)."""
        return Camera(width, height, self.fov_vertical_deg, self.pitch, self.roll)


def _scalars(first: Any, second: Any) -> tuple[Any, Any]:
    if np.ndim(first) == 0 and np.ndim(second) == 0:
        return float(first), float(second)
    return first, second
