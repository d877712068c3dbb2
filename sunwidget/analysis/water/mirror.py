"""How calm water is that shows no glints: by how clearly it mirrors what stands above it."""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.images.working_copy import Working, smoothstep
from sunwidget.analysis.water.glitter import small_copy
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera

_FLOOR = 0.003  # display-linear light below which all is black
_SHIFT = 0.08  # of the height: largest error of the horizon
_FEWEST = 0.05  # share of the picture that must be mirrored
_CLEAR = 0.42, 0.55  # correlation of water and what it mirrors: ripples, and a mirror
_CONTRAST = 0.25, 0.38  # log2 of light along a row: less is no proof
_COURSE = 0.15  # of the width: what changes more slowly along a row is no mirror image
_CALM = 0.05  # slope variance of a mirror relative to the standard wind's


def mirror_roughness(working: Working, water: np.ndarray, camera: Camera) -> float:
    """Return the slope variance of the photo's water relative to the standard wind's.

    A mirror image needs slopes of less than 2 degrees. Water is compared with the picture above
    the horizon row by row, each without its slow course, since skies and water grow brighter alike.

    Parameters
    ----------
    working : Working
    water : (h, w) float32
        Water at its size.
    camera : Camera
        Camera for any size.

    Returns
    -------
    float
        0.05 for a mirror, 1 where nothing is mirrored or is seen to be.
    """
    import cv2

    light, wet = small_copy(working, water)
    height, width = wet.shape
    wet = wet > 0.6
    if wet.mean() < _FEWEST:
        return 1.0
    logs = np.log2(np.maximum(light @ LUMINANCE, _FLOOR)).astype(np.float32)
    logs = cv2.GaussianBlur(logs, (0, 0), 1.0)
    logs = logs - cv2.GaussianBlur(logs, (0, 0), sigmaX=_COURSE * width, sigmaY=0.5)
    horizon = camera.resized(width, height).horizon_row()
    calm = 0.0
    for shift in range(-round(_SHIFT * height), round(_SHIFT * height) + 1):
        above = np.round(2 * (horizon + shift) - np.arange(height)).astype(int)
        row = np.clip(above, 0, height - 1)
        pairs = wet & ~wet[row] & (above == row)[:, None]
        if pairs.mean() < _FEWEST:
            continue
        here, there = (_without_rows(values, pairs)[pairs] for values in (logs, logs[row]))
        clear = float((here * there).sum() / max(np.sqrt((here**2).sum() * (there**2).sum()), 1e-6))
        shown = smoothstep(*_CLEAR, clear) * smoothstep(*_CONTRAST, float(there.std()))
        calm = max(calm, float(shown))
    return 1 + calm * (_CALM - 1)


def _without_rows(values: np.ndarray, inside: np.ndarray) -> np.ndarray:
    """Subtract each row's mean inside a mask."""
    means = (values * inside).sum(1) / np.maximum(inside.sum(1), 1)
    return np.asarray(values - means[:, None])
