"""The rays of a photo's sun: streaks that its aperture and lens draw from the sun outwards.

Seen from the sun, a ray is brighter than what lies beside it at every distance, from the core on;
a cloud is not. So the picture is unrolled around the sun, and a ray's brightness at some distance
counts as far as it holds all the way there.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.images.working_copy import Working, smoothstep
from sunwidget.analysis.sun.sun import SunObservation
from sunwidget.formats.color import LUMINANCE

_REACH, _FADES = 0.45, 0.75  # widths of the picture; share of it from which rays fade
_ANGLES = 1024  # of the unrolled picture
_BESIDE = 25.0  # of them: deviation of the surroundings that a ray is compared with, 9 degrees
_COARSER = 4  # of them are averaged before such a wide mean, which takes a quarter of the time
_ALONG = 0.03  # widths: deviation of the mean along a ray
_FROM, _LEAST_FROM = 1.5, 0.03  # radii of the sun, widths: closer to it rays run together
_RISES = 0.02  # log of light from which a streak is no part of its surroundings
_STEEPEST = 4.0  # a ray is at most so many times brighter than where it is weakest farther in
_FREE = (
    0.6,
    0.9,
)  # share of the surroundings that are sky: with less it is no ray, with more it may be
_SKY = 0.95  # of a pixel, from which it is compared
_FLOOR = 0.01  # added to light before its logarithm is taken


def find_rays(working: Working, sky: np.ndarray, light: SunObservation) -> np.ndarray:
    """Return the light of the sun's rays in the sky, as logarithm of its excess, (h, w, 3), >= 0.

    Parameters
    ----------
    working : Working
    sky : (h, w) float32
        Sky matte at its size.
    light : SunObservation
        The photo's sun.
    """
    import cv2

    height, width = sky.shape
    to_working = width / light.size[0]
    center = light.x * to_working - 0.5, light.y * to_working - 0.5  # OpenCV counts pixel centers
    reach = int(_REACH * width)
    polar = cv2.INTER_LINEAR | cv2.WARP_POLAR_LINEAR | cv2.WARP_FILL_OUTLIERS

    def unrolled(image: np.ndarray) -> np.ndarray:
        return np.asarray(cv2.warpPolar(image, (reach, _ANGLES), center, reach, polar))

    log = np.log(working.linear + _FLOOR)
    # What lies outside the picture is unrolled to zero.
    known = (unrolled((sky > _SKY).astype(np.float32)) > _SKY).astype(np.float32)
    here = unrolled(log.astype(np.float32)) * known[..., None]
    beside = _around(here, known)
    plain = known * ((here - beside) @ LUMINANCE < _RISES)
    beside = _around(here * plain[..., None], plain)
    rise = _along((here - beside) * known[..., None], known, _ALONG * width)
    bright = rise @ LUMINANCE
    held = np.where(known > 0, np.maximum(bright, 0), np.inf)
    begin = max(_FROM * light.radius_px * to_working, _LEAST_FROM * width)
    held[:, : int(begin) + 1] = np.inf
    held = np.minimum.accumulate(held, 1)
    held = np.where(np.isfinite(held), held, 0)
    share = np.minimum(_STEEPEST * held / np.maximum(bright, 1e-6), 1) * (bright > 0) * known
    # Beside land a band along the horizon looks like half a ray.
    share = share * smoothstep(*_FREE, _mean_around(known[..., None])[..., 0])
    share = share * (1 - smoothstep(_FADES, 1.0, np.arange(reach) / reach))
    rays = np.maximum(rise, 0) * share[..., None]
    back = cv2.warpPolar(
        rays.astype(np.float32), (width, height), center, reach, polar | cv2.WARP_INVERSE_MAP
    )
    return np.asarray(back * (sky > _SKY)[..., None])


def _mean_around(values: np.ndarray) -> np.ndarray:
    """Return the mean over neighboring angles, (angles, reach, n)."""
    import cv2

    margin = int(4 * _BESIDE) // _COARSER * _COARSER
    ring = np.concatenate([values[-margin:], values, values[:margin]]).astype(np.float32)
    reach, angles = ring.shape[1], len(ring)
    few = cv2.resize(ring, (reach, angles // _COARSER), interpolation=cv2.INTER_AREA)
    few = cv2.GaussianBlur(few, (0, 0), sigmaX=1e-3, sigmaY=_BESIDE / _COARSER)
    mean = cv2.resize(few, (reach, angles), interpolation=cv2.INTER_LINEAR)[margin:-margin]
    return np.asarray(mean.reshape(values.shape))


def _around(values: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Return the weighted mean over neighboring angles; ``values`` are weighted already."""
    mean = _mean_around(np.dstack([values, weight]))
    return np.asarray(mean[..., :3] / np.maximum(mean[..., 3:], 1e-3))


def _along(values: np.ndarray, weight: np.ndarray, deviation: float) -> np.ndarray:
    """Return the mean along the radius, weighted; ``values`` are so already."""
    import cv2

    stacked = np.dstack([values, weight]).astype(np.float32)
    mean = cv2.GaussianBlur(stacked, (0, 0), sigmaX=deviation, sigmaY=0.8)
    return np.asarray(mean[..., :3] / np.maximum(mean[..., 3:], 0.05))
