"""Depth at any size: flat ground, exact at every pixel, and deviations from it.

ln depth = (1 − share) · ln depth of the ground + share · (its own). In this form the ground has no
terraces at any size, and enlarged objects keep their edges: their maps follow the picture (He &
Sun, "Fast guided filter", arXiv:1505.00996, 2015).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from sunwidget.analysis.depth import flat_ground
from sunwidget.analysis.depth.view import ray_fall
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera

_RADIUS, _EPSILON = 2, 2e-3  # pixels of the small map; squared contrast below an edge


@dataclass(frozen=True, eq=False)
class DepthField:
    """The depth of a photo; sky has the depth of the nearest land.

    Parameters
    ----------
    share : (h, w) float32 in [0, 1]
        Weight of a pixel's own depth against flat ground.
    log_depth : (h, w) float32
        A pixel's own depth as ln(metres).
    confidence : (h, w) float32 in [0, 1]
        1 / (1 + (2 σ)²) with the standard error σ of ln depth, apart from the common scale.
    camera : Camera
        Camera for any size.
    horizon_error : float
        Standard error of the horizon, in heights of the picture.
    sharpen : bool
        Whether enlarged maps follow the picture's edges.
    """

    share: np.ndarray
    log_depth: np.ndarray
    confidence: np.ndarray
    camera: Camera
    horizon_error: float
    sharpen: bool = True

    def log_metres(self, width: int, height: int, working: Working) -> np.ndarray:
        """Return ln(metres) along the optical axis at a size, (height, width) float32."""
        camera = self.camera.resized(width, height)
        ground = flat_ground.log_depth(
            ray_fall(camera), self.horizon_error * height, camera.focal, height
        )
        share, own = self._enlarged(width, height, working)
        return np.asarray(ground + share * (own - ground), np.float32)

    def _enlarged(self, width: int, height: int, working: Working) -> tuple[np.ndarray, np.ndarray]:
        rows, columns = self.share.shape
        if not self.sharpen or width * height <= 1.5 * rows * columns or min(rows, columns) < 8:
            return resize(self.share, width, height), resize(self.log_depth, width, height)
        fine = working.encoded @ LUMINANCE
        coarse = resize(fine, columns, rows)
        fine = resize(fine, width, height)
        share, own = (
            resize(slope, width, height) * fine + resize(offset, width, height)
            for slope, offset in (
                _local_lines(coarse, values) for values in (self.share, self.log_depth)
            )
        )
        low, high = float(self.log_depth.min()), float(self.log_depth.max())
        return np.clip(share, 0, 1), np.clip(own, low, high)


def _local_lines(guide: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Fit values = slope · guide + offset around each pixel; return two maps (h, w) float32."""
    import cv2

    def mean(image: np.ndarray) -> np.ndarray:
        return cv2.blur(image, (2 * _RADIUS + 1,) * 2)

    of_guide, of_values = mean(guide), mean(values)
    covariance = mean(guide * values) - of_guide * of_values
    slope = covariance / (mean(guide * guide) - of_guide**2 + np.float32(_EPSILON))
    return mean(slope), mean(of_values - slope * of_guide)


def guided(guide: np.ndarray, values: np.ndarray, radius: int, epsilon: float) -> np.ndarray:
    """Smooth a map between the edges of a color picture (He, Sun & Tang, ECCV 2010).

    Parameters
    ----------
    guide : (h, w, 3) float32 in [0, 1]
    values : (h, w) float32
    radius : int
        Radius in pixels.
    epsilon : float
        Squared contrast of the guide below an edge.

    Returns
    -------
    (h, w) float32
    """
    import cv2

    # In code values up to 255: OpenCV treats a covariance with a determinant below 1e-6 as
    # singular, as nearly all are for colors up to 1, and would only blur.
    code = np.multiply(guide, 255, dtype=np.float32)
    filtered = cv2.ximgproc.guidedFilter(
        code, np.ascontiguousarray(values), radius, epsilon * 255**2
    )
    return np.asarray(filtered)
