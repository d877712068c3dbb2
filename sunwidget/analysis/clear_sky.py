"""The clear sky behind the clouds, shown where they are thinned or removed.

The fitted model alone misses haze banks, vignetting and the camera's tint. Where the photo shows
clear sky, the logarithm of photo over model is a slow field. A low-order surface continues it
behind the clouds; near clear sky the local deviation is added. A sky without any clear part keeps
the fit, with the white balance of clear skies (overcast.py).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from sunwidget.analysis.backdrop.backdrop import LONG_SIDE, RANGE, matched_sky
from sunwidget.analysis.fit.overcast import limit_balance
from sunwidget.analysis.images.fill import fill_by_pyramid
from sunwidget.analysis.images.working_copy import resize
from sunwidget.formats.pixels import size_within

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene

_CLEAR = 0.1  # opacity at which a pixel has little information about the clear sky
_STIFFNESS = np.array([0.002, 0.01, 0.01, 0.05, 0.05, 0.05])  # of 1, x, y, xy, x², y²
_SOFT_EDGE = 0.025  # deviation of the fully softened clouds' blur, in longer sides


def clear_sky(scene: Scene) -> np.ndarray:
    """Return a scene's sky behind its clouds, (h, w, 4) float32 in [0, 1].

    RGB is (log(clear sky / matched model) + RANGE) / (2 RANGE); A is the clouds' opacity with
    edges as soft as for ``cloud_softness`` = 1. The longer side has at most ``LONG_SIDE`` pixels.
    """
    working = scene.working
    size = size_within((working.width, working.height), LONG_SIDE)
    matte = np.asarray(resize(scene.small_sky, *size), np.float32)
    opacity = np.asarray(resize(scene.cloud_map, *size), np.float32) / np.maximum(matte, 1e-3)
    opacity = np.clip(opacity, 0, 1)
    field = _residual(scene, matte, opacity)
    encoded = (field + RANGE) / (2 * RANGE)
    noise = np.random.default_rng(20170602).random(encoded.shape, np.float32) - 0.5
    encoded = encoded + noise / 255  # dithered, or slow fields would show bands
    soft = _blurred(opacity, matte, _SOFT_EDGE * max(size))
    return np.clip(np.dstack([encoded, soft]), 0, 1).astype(np.float32)


def _residual(scene: Scene, matte: np.ndarray, opacity: np.ndarray) -> np.ndarray:
    """Return the log of the clear sky over the matched model, (h, w, 3)."""
    import cv2

    height, width = matte.shape
    fit = scene.fitted
    if fit is None:
        return np.zeros((height, width, 3), np.float32)
    display = np.asarray(resize(scene.without_sun.working.linear, width, height), np.float32)
    model = matched_sky(fit, scene.camera, (width, height))
    ratio = np.maximum(fit.response.scene_light(display), 1e-4) / np.maximum(model, 1e-6)
    residual = np.clip(np.log(ratio), -RANGE, RANGE)

    # Fringes of clouds, glow and clipped pixels are not clear sky.
    near = cv2.GaussianBlur(cv2.dilate(opacity, np.ones((3, 3))), (0, 0), 1.5)
    burnt = np.clip((display.max(-1) - 0.9) / 0.07, 0, 1)
    inside = cv2.erode((matte > 0.98).astype(np.uint8), np.ones((3, 3))) > 0
    trust = inside * (1 - burnt) * np.exp(-np.square(near / _CLEAR))
    trust *= 1 - resize(scene.without_sun.hidden, width, height)
    trust = trust.astype(np.float32)

    blue = fit if scene.shows_sun else limit_balance(fit, scene.working, scene.small_sky)
    expected = np.log(np.array(blue.gain) / np.array(fit.gain))
    slow = _surface(residual - expected, trust) + expected
    around = fill_by_pyramid((residual - slow).astype(np.float32), trust)
    reach = 0.05 * max(width, height)
    sure = cv2.GaussianBlur(trust, (0, 0), reach)
    share = (sure / (sure + 0.05))[..., None]
    return np.asarray(np.clip(slow + share * around, -RANGE, RANGE), np.float32)


def _surface(values: np.ndarray, trust: np.ndarray) -> np.ndarray:
    """Fit a quadratic surface (h, w, 3) to ``values``; it tends to 0 without trusted pixels."""
    height, width = trust.shape
    y, x = np.mgrid[:height, :width]
    x = (2 * x + 1) / width - 1
    y = (2 * y + 1) / height - 1
    basis = np.stack([np.ones_like(x), x, y, x * y, x * x, y * y], -1).reshape(-1, 6)
    weight = trust.reshape(-1, 1) / trust.size
    data = values.reshape(-1, 3)
    normal = basis.T @ (weight * basis) + np.diag(_STIFFNESS * 0.1)
    surface = basis @ np.linalg.solve(normal, basis.T @ (weight * data))
    used = trust.ravel() > 0.5
    if used.any():
        # Far from known pixels a parabola diverges.
        low, high = np.quantile(data[used], [0.02, 0.98], axis=0)
        surface = np.clip(surface, np.minimum(low, 0) - 0.1, np.maximum(high, 0) + 0.1)
    return np.asarray(surface.reshape(height, width, 3))


def _blurred(opacity: np.ndarray, matte: np.ndarray, deviation: float) -> np.ndarray:
    """Blur an opacity within the sky."""
    import cv2

    weighted = cv2.GaussianBlur(opacity * matte, (0, 0), max(deviation, 0.5))
    weight = cv2.GaussianBlur(matte, (0, 0), max(deviation, 0.5))
    return np.asarray(weighted / np.maximum(weight, 1e-3))
