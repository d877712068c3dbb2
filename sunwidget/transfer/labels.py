"""Labels of the land that need no further network."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from sunwidget.analysis.fit.fit import view_angles
from sunwidget.analysis.images.working_copy import resize, smoothstep

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.geometry.camera import Camera

LABELS = ("ground", "upright", "plants", "water")
_EYE_HEIGHT = 1.7  # meters above the ground, as assumed by the depth map
_FAR = 20_000.0  # meters


def labels_of(scene: Scene) -> dict[str, np.ndarray]:
    """Return the share of each label in each pixel, (h, w) in [0, 1], at working size.

    The shares sum to the land.
    """
    small = scene.working
    size = (small.width, small.height)
    land = 1 - resize(scene.sky, *size)
    water = resize(scene.water, *size) * land
    total = np.maximum(small.encoded.sum(-1), 1e-3)
    # Excess green (Woebbecke et al. 1995) detects leaves and grass; in the dark it is noise.
    excess = (2 * small.encoded[..., 1] - small.encoded[..., 0] - small.encoded[..., 2]) / total
    green = smoothstep(0.03, 0.15, excess) * smoothstep(0.08, 0.25, total)
    plants = green * (land - water)
    elevation = view_angles(scene.camera, *size)[1]
    below = smoothstep(0.0, -1.5, elevation)
    flat = _ground(scene.camera.resized(*size))
    depth = resize(np.minimum(scene.depth, _FAR), *size)
    # Surfaces much nearer than level ground are upright.
    lying = below * smoothstep(0.5, 0.8, depth / flat)
    ground = lying * (land - water - plants)
    parts = (ground, land - water - plants - ground, plants, water)
    return {n: _soft(p, small.encoded) for n, p in zip(LABELS, parts, strict=True)}


def _ground(camera: Camera) -> np.ndarray:
    """Return the depth (h, w) in meters of level ground under the camera, at most ``_FAR``."""
    y, x = np.mgrid[: camera.height, : camera.width] + 0.5
    u, v = (x - camera.width / 2) / camera.focal, (y - camera.height / 2) / camera.focal
    fall = -(u * camera.up[0] + v * camera.up[1] + camera.up[2])
    return np.asarray(_EYE_HEIGHT / np.maximum(fall, _EYE_HEIGHT / _FAR), np.float32)


def _soft(label: np.ndarray, guide: np.ndarray) -> np.ndarray:
    """Align a label with the picture's edges, so that it adds no edge."""
    import cv2

    radius = max(2, round(0.012 * max(label.shape)))
    label = label.astype(np.float32)
    return np.clip(cv2.ximgproc.guidedFilter(guide, label, radius, 1e-3), 0, 1)
