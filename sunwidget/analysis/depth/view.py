"""The input of the depth methods: a small copy of the photo, its camera and its air."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sunwidget.analysis.horizon.horizon import Horizon
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.geometry.camera import Camera

SIDE = 320  # pixels of the longer side at which depth is found
# Standard error of the horizon's row in heights of the picture, at full and at no confidence, with
# geometric interpolation in between.
_LEAST_ERROR, _LARGEST_ERROR = 0.002, 0.04


@dataclass(frozen=True, eq=False)
class View:
    """A photo as input of the depth methods.

    Parameters
    ----------
    photo : Working
        Copy of any size for networks.
    working : Working
        Copy of at most ``SIDE`` pixels.
    sky, water : (h, w) float32
        Matte and mask at this size, 1 = sky, 1 = water.
    camera : Camera
        Camera at this size.
    horizon_error : float
        Standard error of the horizon's row, in pixels of this size.
    atmosphere : Atmosphere
        The atmosphere fitted to the sky.
    """

    photo: Working
    working: Working
    sky: np.ndarray
    water: np.ndarray
    camera: Camera
    horizon_error: float
    atmosphere: Atmosphere

    @classmethod
    def of(
        cls,
        working: Working,
        sky: np.ndarray,
        water: np.ndarray,
        camera: Camera,
        horizon: Horizon,
        atmosphere: Atmosphere,
    ) -> View:
        """Make a view from results of the analysis; maps and camera may have any size."""
        small = working.shrunk(SIDE)
        size = small.width, small.height
        doubt = 1 - float(np.clip(horizon.confidence, 0, 1))
        share = _LEAST_ERROR * (_LARGEST_ERROR / _LEAST_ERROR) ** doubt
        return cls(
            working,
            small,
            resize(sky, *size),
            resize(water, *size),
            camera.resized(*size),
            share * small.height,
            atmosphere,
        )

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.working.height, self.working.width

    @cached_property
    def land(self) -> np.ndarray:
        """Land pixels, (h, w) bool."""
        return np.asarray(self.sky < 0.5)

    @cached_property
    def fall(self) -> np.ndarray:
        """Fall of each pixel's ray, see ``ray_fall``."""
        return ray_fall(self.camera)


def ray_fall(camera: Camera) -> np.ndarray:
    """Return the fall of each pixel's ray below eye level, per metre of depth.

    Returns
    -------
    (h, w) float32
        Metres per metre along the optical axis; negative above the horizon.
    """
    u = (np.arange(camera.width) + 0.5 - camera.width / 2) / camera.focal
    v = (np.arange(camera.height) + 0.5 - camera.height / 2) / camera.focal
    x, y, z = camera.up
    return np.asarray(-(u * x + z)[None] - (v * y)[:, None], np.float32)
