"""Clouds un-mixed from the fitted sky, continued where twigs or the sun's glow hide them."""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.backdrop.erase import Erased
from sunwidget.analysis.clouds.clouds import Clouds, veil
from sunwidget.analysis.fit.fit import SkyFit
from sunwidget.analysis.images.fill import fill_by_layers, fill_by_pyramid
from sunwidget.analysis.images.working_copy import smoothstep
from sunwidget.geometry.camera import Camera

_STRIPES = 0.08  # of the longer side: gaps are smoothed that widely, as far inside
_MOSTLY = 0.25, 0.75  # share of the surroundings that is clear
_SURROUNDINGS = 0.05  # of the longer side: width of the sky used around a glow


def unmix_clouds(
    erased: Erased,
    sky: np.ndarray,
    camera: Camera,
    fitted: SkyFit,
    covers: tuple[Clouds, Clouds],
    *,
    sun_seen: bool,
) -> tuple[Clouds, Clouds]:
    """Return ``covers`` with opacity and shade un-mixed from the fitted sky.

    Both pairs hold the clouds of the sky, and those of the whole picture as if it were sky.
    """
    of_sky, of_all = veil(erased.working, sky, camera, fitted, sun_seen=sun_seen)
    # Where the matte is soft, twigs darken the sky as a cloud would; continue the clouds from
    # around them. Around the sun everything is white; continue the clouds from beside it.
    weight = np.asarray(_inner(sky > 0.98), np.float32)
    filled = fill_by_pyramid(np.dstack([of_sky.opacity, of_sky.shade]), weight)
    if erased.glow.any():
        # If most of the surroundings are clear, the clear sky alone is continued.
        weight *= 1 - erased.glow
        clear = weight * _clearness(of_sky.opacity, weight > 0.5)
        cloudy, open_ = (_continued(of_sky.opacity, w) for w in (weight, clear))
        share = float(smoothstep(*_MOSTLY, _round_glow(erased.glow, weight, clear)))
        behind = cloudy + share * (open_ - cloudy)
        filled[..., 0] += erased.glow * (behind - filled[..., 0])
    return (
        Clouds(filled[..., 0] * sky, covers[0].softness, filled[..., 1]),
        Clouds(of_all.opacity * (1 - erased.glow), covers[1].softness, of_all.shade),
    )


def _continued(opacity: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Continue an opacity (h, w) over gaps along the rows, as the light there is continued.

    Inside the gaps it is smooth, or fragments of clouds at their rim would become stripes.
    """
    import cv2

    longest = max(weight.shape)
    filled = fill_by_layers(opacity[..., None], weight.astype(np.float32))[..., 0]
    smooth = cv2.GaussianBlur(filled, (0, 0), _STRIPES * longest)
    inside = cv2.distanceTransform((weight < 0.5).astype(np.uint8), cv2.DIST_L2, 5)
    share = smoothstep(0.0, _STRIPES * longest, inside)
    return np.clip(filled + share * (smooth - filled), 0, 1).astype(np.float32)


def _clearness(opacity: np.ndarray, sky: np.ndarray) -> np.ndarray:
    """Return each pixel's clearness relative to the sky's clearest quarter, (h, w) in [0, 1]."""
    usual = float(np.quantile(opacity[sky], 0.25)) if sky.any() else 0.0
    return np.asarray(1 - smoothstep(0.05, 0.3, opacity - usual), np.float32)


def _round_glow(glow: np.ndarray, weight: np.ndarray, clear: np.ndarray) -> float:
    """Return the share of clear sky around the glow (h, w)."""
    import cv2

    side = 2 * max(1, round(_SURROUNDINGS * max(glow.shape))) + 1
    near = cv2.dilate(glow, np.ones((side, side), np.uint8))
    return float((near * clear).sum() / max(float((near * weight).sum()), 1e-6))


def _inner(mask: np.ndarray) -> np.ndarray:
    """Shrink a mask (h, w) bool by 2 px; outside the frame it counts as set."""
    import cv2

    return cv2.erode(mask.astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
