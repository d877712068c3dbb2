"""Haze: how far the light came through the air that brightens it.

I = J t + A (1 − t) with the airlight A, and nearly everywhere in a small patch one channel of the
surface's own light J is nearly 0: t = 1 − ω · dark channel of I / A (He, Sun & Tang, "Single image
haze removal using dark channel prior", CVPR 2009, equations 5 and 11–12), refined by their guided
filter (ECCV 2010) and read as depth by t = exp(−β d).
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.depth_field import guided
from sunwidget.analysis.depth_ground import EYE_HEIGHT
from sunwidget.analysis.depth_level import fill_sky
from sunwidget.analysis.depth_view import View

OMEGA = 0.95
_PATCH, _RADIUS, _EPSILON = 15, 60, 1e-3  # He's, for pictures of about 600 pixels
_REFERENCE = 600
_THINNEST = 0.02  # transmittance below which nothing of the surface shows
_BAND = 0.16  # of the height: the sky so far above the land is the horizon's
_SURFACE_ERROR = 0.08  # of t: surfaces without anything dark in them
_AIR_ERROR = 0.5  # of ln β: the fitted air may well be wrong by a factor of 1.6
_FEET = 5e-4  # of the picture: less ground near by tells nothing
_NEAR = 30.0  # metres: so near the air does nothing


def airlight(view: View) -> np.ndarray:
    """Return the light of the sky over the land, by column: (w, 3) float32, linear.

    Without sky over the land it is that of the haziest pixels (He 2009, section 4.4).
    """
    import cv2

    linear, height, width = view.working.linear, *view.shape
    reach = np.ones((2 * max(1, round(_BAND * height)) + 1, 3), np.uint8)
    band = (view.sky > 0.98) & (cv2.dilate(view.land.astype(np.uint8), reach) > 0)
    if not band.any():
        dark = linear.min(axis=-1)
        brightest = dark >= np.quantile(dark, 0.999)
        light = np.maximum(linear[brightest].mean(axis=0), 1e-3)
        return np.broadcast_to(light, (width, 3)).astype(np.float32)
    # Columns without such sky take their neighbours': normalised convolution over a third of them.
    weight = band.astype(np.float32)
    columns = np.empty((1, width, 4), np.float32)
    columns[0, :, :3] = np.einsum("hwc,hw->wc", linear, weight)
    columns[0, :, 3] = weight.sum(axis=0)
    near = cv2.GaussianBlur(columns, (0, 0), width / 6, borderType=cv2.BORDER_REPLICATE)[0]
    whole = columns[0].sum(axis=0)
    near += 1e-3 * whole / max(float(whole[3]), 1.0)
    return np.maximum(near[:, :3] / near[:, 3:], 1e-3).astype(np.float32)


def transmittance(view: View, air: np.ndarray) -> np.ndarray:
    """Return the share of the surface's light that arrives: (h, w) float32, 0.02 to 1.

    ``air`` is the airlight of each column, (w, 3) float32.

    What the ground at one's feet would be by the same rule is taken for 1: so bright surfaces are
    in this light by themselves.
    """
    import cv2

    scale = max(view.shape) / _REFERENCE
    light = view.working.linear / air
    least = np.minimum(np.minimum(light[..., 0], light[..., 1]), light[..., 2])
    # Neither the patch nor the filter may mix the sky into the land.
    patch = np.ones((max(3, round(_PATCH * scale) | 1),) * 2, np.uint8)
    least = np.where(view.land, np.minimum(least, 1), np.float32(1))
    dark = cv2.erode(least.astype(np.float32), patch)
    filled = fill_sky(np.dstack([view.working.encoded, dark]), view.land)
    radius = max(2, round(_RADIUS * scale))
    smooth = guided(filled[..., :3], filled[..., 3], radius, _EPSILON)
    through = np.clip(1 - OMEGA * smooth, _THINNEST, 1)
    feet = view.land & (view.fall > EYE_HEIGHT / _NEAR)
    if feet.mean() > _FEET:
        through = np.minimum(through / np.median(through[feet]), 1)
    return np.asarray(through, np.float32)


def log_depth(view: View, through: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return ln(metres) of a transmittance and its standard error, (h, w) each.

    d = −ln t / β. Where hardly any haze shows, t is noise and its logarithm far more so: the error
    grows with the square of what the surface does to −ln t.
    """
    depth = -np.log(np.minimum(through, 0.999))
    slope = _SURFACE_ERROR / (through * depth)
    error = np.hypot(_AIR_ERROR, slope * np.hypot(1, slope))
    return np.log(depth / view.atmosphere.extinction_550), error
