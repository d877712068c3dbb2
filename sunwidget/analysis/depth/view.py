"""What the methods of depth look at: a small copy of the photo, its camera and its air."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sunwidget.analysis.horizon.horizon import Horizon
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.geometry.camera import Camera

SIDE = 320  # pixels of the longer side at which depth is found
# Standard error of the horizon's row in heights of the picture, when it is sure and when it is
# assumed; between them by its confidence, geometrically.
_LEAST_ERROR, _LARGEST_ERROR = 0.002, 0.04


@dataclass(frozen=True, eq=False)
class View:
    """A photo as the methods of depth see it.

    Parameters
    ----------
    photo : Working
        Of any size: what networks look at.
    working : Working
        At most ``SIDE`` pixels long.
    sky, water : (h, w) float32
        Matte and mask of the same size, 1 = sky, 1 = water.
    camera : Camera
        Of the same size.
    horizon_error : float
        Standard error of the horizon's row, in pixels of this size.
    atmosphere : Atmosphere
        As fitted to the sky.
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
        """Shrink what the analysis knows; maps and camera may have any size."""
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
        """Where land is: (h, w) bool."""
        return np.asarray(self.sky < 0.5)

    @cached_property
    def fall(self) -> np.ndarray:
        """How far each ray falls, see ``fall_of``."""
        return fall_of(self.camera)


def fall_of(camera: Camera) -> np.ndarray:
    """Return how far each pixel's ray falls below the level of the eye in a metre of depth.

    Returns
    -------
    (h, w) float32
        Metres per metre along the optical axis; negative above the horizon.
    """
    u = (np.arange(camera.width) + 0.5 - camera.width / 2) / camera.focal
    v = (np.arange(camera.height) + 0.5 - camera.height / 2) / camera.focal
    x, y, z = camera.up
    return np.asarray(-(u * x + z)[None] - (v * y)[:, None], np.float32)
