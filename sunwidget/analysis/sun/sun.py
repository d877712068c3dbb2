"""The photo's own sun: its position, its size in the picture, and its pixels (thesis 3.1.3).

``METHODS`` maps a name to a function that grows a mask from a seed pixel; ``find`` (search.py)
gives the seed if the user does not.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.images.working_copy import Working, resize, smoothstep
from sunwidget.analysis.sun.search import Peak, find, find_moon, night
from sunwidget.atmosphere.constants import SUN_ANGULAR_RADIUS_DEG
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera, Point

__all__ = [
    "METHODS",
    "Peak",
    "SunMask",
    "SunObservation",
    "away_from",
    "disc_fit",
    "field_of_view_of",
    "find",
    "find_land_glare",
    "find_moon",
    "find_sea",
    "flood_fill",
    "in_sky",
    "limit_to_core",
    "limit_to_peak",
    "observe",
]

_SHARP = 0.6  # sharpness by the network, from which a core is a disc with a limb
_EVEN = 0.3  # rise over run up to which the skyline beside a low sun continues behind it
_LIMB_STEP = 0.15  # least difference of encoded luminance across a limb
_LEAST_LIMB = 6.0  # radius in working pixels
_RAYS = 4.0  # largest area of a core with rays, in areas of the largest circle inside it
_SET = 0.2  # share above the skyline from which a detected sun that has half set is visible
TOLERANCE = 0.03  # M of Algorithm 1: deviation of encoded luminance from the seed's


@dataclass(frozen=True, eq=False)
class SunObservation:
    """The sun as the photo shows it.

    Parameters
    ----------
    x, y : float
        Center in pixels of the photo; may lie outside.
    radius_px : float
        Radius of its bright area in pixels (0 if it is outside or hidden). An over-exposed sun
        is far larger than the true disc.
    azimuth, elevation : float
        Degrees, by the camera.
    blot : (h, w) float32
        Mask of its pixels, [0, 1], at the size at which they were found.
    size : (width, height)
        Size of the photo in pixels.
    visible : bool
        Whether the photo shows it.
    source : str
        Name of the method, "hint", or "assumed".
    kind : str
        "sun"; or "moon" if the user marked a disc in a night sky. A detected moon is
        ``Scene.moon`` instead.
    confidence : float
        Probability that it is the sun, [0, 1]: 1 for a hint, and if nothing measures it.
    """

    x: float
    y: float
    radius_px: float
    azimuth: float
    elevation: float
    blot: np.ndarray = field(repr=False)
    size: tuple[int, int]
    visible: bool
    source: str
    kind: str = "sun"
    confidence: float = 1.0

    @property
    def mask(self) -> np.ndarray:
        """Mask of its pixels at the photo's size, (H, W) float32 in [0, 1]; computed on access."""
        return resize(self.blot, *self.size)


class SunMask(NamedTuple):
    """The sun in working pixels: center, radius and mask (h, w) float32."""

    x: float
    y: float
    radius: float
    mask: np.ndarray


def flood_fill(working: Working, sky: np.ndarray, x: float, y: float, focal: float) -> SunMask:
    """Grow from the seed over pixels whose luminance differs from the seed's by at most M.

    Thesis Algorithm 1, with pixels marked on push (``cv2.floodFill`` with a fixed range). ``sky``
    and ``focal`` are not used.
    """
    import cv2

    luminance = np.ascontiguousarray(working.encoded @ LUMINANCE)
    column = min(max(int(x), 0), working.width - 1)
    row = min(max(int(y), 0), working.height - 1)
    mask = np.zeros((working.height + 2, working.width + 2), np.uint8)
    flags = 8 | cv2.FLOODFILL_FIXED_RANGE | cv2.FLOODFILL_MASK_ONLY | (1 << 8)
    cv2.floodFill(luminance, mask, (column, row), 0, TOLERANCE, TOLERANCE, flags)
    filled = mask[1:-1, 1:-1].astype(np.float32)
    rows, columns = np.nonzero(filled)
    radius = math.sqrt(rows.size / math.pi)
    return SunMask(float(columns.mean()) + 0.5, float(rows.mean()) + 0.5, radius, filled)


def disc_fit(working: Working, sky: np.ndarray, x: float, y: float, focal: float) -> SunMask:
    """Grow the clipped area around the seed and fit a circle to it.

    The area is nearly as bright as the brightest pixel within a few disc radii of the seed. Its
    center is the centroid weighted by the distance from its edge, so that rays and a horizon
    through it have little effect. It is never smaller than the true disc in this camera.
    """
    import cv2

    true_radius = focal * math.tan(math.radians(SUN_ANGULAR_RADIUS_DEG))
    luminance = cv2.GaussianBlur(working.encoded @ LUMINANCE, (0, 0), 0.8)
    height, width = luminance.shape
    column, row = min(max(int(x), 0), width - 1), min(max(int(y), 0), height - 1)
    reach = max(2, round(1.5 * true_radius))
    window = luminance[
        max(row - reach, 0) : row + reach + 1, max(column - reach, 0) : column + reach + 1
    ]
    peak = float(window.max())
    bright = (luminance >= peak - TOLERANCE).astype(np.uint8)
    _, labels = cv2.connectedComponents(bright, connectivity=8)
    near = labels[
        max(row - reach, 0) : row + reach + 1, max(column - reach, 0) : column + reach + 1
    ]
    found = near[near > 0]
    if not found.size:
        return SunMask(x, y, true_radius, np.zeros((height, width), np.float32))
    mask = (labels == np.bincount(found).argmax()).astype(np.uint8)
    depth = cv2.distanceTransform(np.pad(mask, 1), cv2.DIST_L2, 5)[1:-1, 1:-1]
    weight = np.where(depth > 0.5 * depth.max(), depth, 0) ** 2
    rows, columns = np.mgrid[:height, :width]
    total = float(weight.sum())
    center_x = float((columns * weight).sum()) / total + 0.5
    center_y = float((rows * weight).sum()) / total + 0.5
    return SunMask(
        center_x, center_y, max(float(depth.max()), true_radius), mask.astype(np.float32)
    )


METHODS: dict[str, Callable[[Working, np.ndarray, float, float, float], SunMask]] = {
    "flood_fill": flood_fill,
    "disc_fit": disc_fit,
}


def limit_to_peak(sun_mask: SunMask, peak: Peak) -> SunMask:
    """Return a mask grown from a detected sun, or a plain disc if it grew into cloud or glow."""
    near = math.hypot(sun_mask.x - peak.x, sun_mask.y - peak.y) < max(0.7 * peak.radius, 3)
    if near and 0.5 * peak.radius < sun_mask.radius < 1.6 * peak.radius:
        return sun_mask
    return _plain_disc(sun_mask.mask.shape, peak.x, peak.y, peak.radius)


def _plain_disc(shape: tuple[int, ...], x: float, y: float, radius: float) -> SunMask:
    disc = np.clip(radius + 0.5 - away_from(shape, x, y), 0, 1).astype(np.float32)
    return SunMask(x, y, radius, disc)


def limit_to_core(sun_mask: SunMask, place: Point) -> SunMask:
    """Return a mask grown from a known place, or a plain disc there if it grew into clouds.

    A core with its rays covers little more than the largest circle inside it; clouds as white as
    the sun cover many times that.
    """
    if float(sun_mask.mask.sum()) < _RAYS * math.pi * sun_mask.radius**2:
        return sun_mask
    return _plain_disc(sun_mask.mask.shape, *place, sun_mask.radius)


def field_of_view_of(
    sun_mask: SunMask, peak: Peak, working: Working, assumed: float
) -> float | None:
    """Return the vertical field of view in degrees from the disc's size, or None.

    A sharp and round limb has the true 0.533°. A bloomed core gives no information, and a disc of a
    few pixels little. A disc no larger than in the ``assumed`` field of view counts as bloomed.
    """
    area = float(sun_mask.mask.sum())
    if peak.sharpness < _SHARP or sun_mask.radius < _LEAST_LIMB or peak.confidence < 0.5:
        return None
    away = away_from(sun_mask.mask.shape, sun_mask.x, sun_mask.y) / sun_mask.radius
    luminance = working.encoded @ LUMINANCE
    inside = float(np.median(luminance[(away > 0.7) & (away < 0.9)]))
    outside = float(np.median(luminance[(away > 1.2) & (away < 1.4)]))
    if inside - outside < _LIMB_STEP:
        return None
    if area > 1.4 * math.pi * sun_mask.radius**2:
        return None
    # Half way between the two sides of the limb.
    disc = np.count_nonzero((luminance > (inside + outside) / 2) & (away < 1.4))
    focal = math.sqrt(disc / math.pi) / math.tan(math.radians(SUN_ANGULAR_RADIUS_DEG))
    degrees = 2 * math.degrees(math.atan(0.5 * working.height / focal))
    return max(degrees, 1.0) if degrees < 0.7 * assumed else None


def away_from(shape: tuple[int, ...], x: float, y: float) -> np.ndarray:
    """Return the distance of each pixel of a map (h, w) from a point, in pixels."""
    return np.hypot(np.arange(shape[1]) + 0.5 - x, np.arange(shape[0])[:, None] + 0.5 - y)


def in_sky(
    sun_mask: SunMask, sky: np.ndarray, encoded: np.ndarray, least: float = 0.6
) -> np.ndarray:
    """Return the mask with a soft rim, (h, w) float32; zeros unless sky surrounds it.

    Pixels much darker than the disc, such as twigs in front of it, are excluded. ``least`` is the
    share of the surroundings that must be sky.
    """
    import cv2

    if not 0 < sun_mask.radius < 0.12 * max(sky.shape):
        return np.zeros_like(sky)
    reach = 2 * math.ceil(0.25 * sun_mask.radius + 2) + 1
    ring = cv2.dilate(sun_mask.mask, np.ones((3 * reach, 3 * reach), np.uint8)) - sun_mask.mask
    if ring.sum() < 1 or float((ring * sky).sum() / ring.sum()) < least:
        return np.zeros_like(sky)
    # The land below the sky cuts a setting sun.
    rows = np.flatnonzero(((ring > 0) & (sky > 0.5)).any(1))
    if not rows.size:
        return np.zeros_like(sky)
    below = np.arange(sky.shape[0]) > rows[-1]
    sun_mask = sun_mask._replace(mask=np.where(below[:, None], 0, sun_mask.mask).astype(np.float32))
    grown = cv2.dilate(sun_mask.mask, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (reach, reach)))
    soft = np.clip(cv2.GaussianBlur(grown, (0, 0), reach / 6), 0, 1)
    luminance = encoded @ LUMINANCE
    inside = luminance[sun_mask.mask > 0.5]
    usual = float(np.median(inside)) if inside.size else 0.0
    return np.asarray(soft * smoothstep(0.5, 0.7, luminance / max(usual, 1e-3)), np.float32)


_BURNS = 0.75  # radii beyond the disc
_GLINTS, _SEA = 0.1, 0.08  # widths: from the sun to where the skyline counts, and how much of it
_TILT, _RISES = 0.03, 0.05  # rise over run; heights of the picture
_STRAIGHT, _MOST = 1.5, 0.8  # rows; share of the columns
_FADES = 6  # columns
_AS_BRIGHT = 0.6, 0.8  # of the sky's encoded luminance


def find_land_glare(sun_mask: SunMask, sky: np.ndarray) -> np.ndarray:
    """Return where a low sun's glare over an even skyline is not sky, (h, w) float32 in [0, 1].

    A setting sun clips a notch into the sea or the hills in front of it. If the skylines left and
    right of it are below its center, nothing below the line between them is sky; if they are
    uneven, as trees are, only the clipped part is excluded.
    """
    import cv2

    no_sky = np.zeros_like(sky)
    wide = math.ceil(3 * sun_mask.radius) + 3
    first, last = math.floor(sun_mask.x) - wide, math.ceil(sun_mask.x) + wide
    if first - wide < 0 or last + wide > sky.shape[1]:
        return no_sky
    left, right = _skyline(sky[:, first - wide : first]), _skyline(sky[:, last : last + wide])
    uneven = max(np.ptp(left), np.ptp(right)) > max(2, _EVEN * wide)
    steep = abs(float(left.mean() - right.mean())) > _EVEN * (last - first)
    if uneven or steep:
        near = math.ceil(wide / 3)
        left, right = left[-near:], right[:near]
    if min(left.min(), right.min()) <= sun_mask.y:
        return no_sky
    line = np.interp(np.arange(first, last), [first, last], [left.mean(), right.mean()])
    below = np.arange(sky.shape[0])[:, None] + 0.5 - line
    no_sky[:, first:last] = np.clip(below, 0, 1)
    if uneven or steep:
        side = 2 * math.ceil(_BURNS * sun_mask.radius + 2) + 1
        burnt = cv2.dilate(sun_mask.mask, np.ones((side, side), np.uint8))
        no_sky *= cv2.GaussianBlur(burnt, (0, 0), 1.0)
    return no_sky


def _skyline(sky: np.ndarray) -> np.ndarray:
    """Return in each column the row below its last pixel of sky, (w,); 0 where there is none."""
    return np.asarray(((sky > 0.5) * np.arange(1, sky.shape[0] + 1)[:, None]).max(axis=0))


def find_sea(
    sun_mask: SunMask, sky: np.ndarray, encoded: np.ndarray
) -> tuple[np.ndarray, np.ndarray] | None:
    """Return what is sky and what is not around the horizon of a sea below a low sun.

    The glints of a sun above the sea grow together with its glow in the sky, and clip a notch into
    the sea. If the skylines left and right of them lie on one line, what is above that line and as
    bright as the sky there is sky, and nothing below it is.

    Returns
    -------
    two arrays (h, w) float32 in [0, 1], or None
        Weights of sky and of no sky; None without a straight horizon.
    """
    height, width = sky.shape
    wide, beside = math.ceil(max(3 * sun_mask.radius + 3, _GLINTS * width)), math.ceil(_SEA * width)
    first, last = round(sun_mask.x) - wide, round(sun_mask.x) + wide
    if first - beside < 0 or last + beside > width:
        return None
    columns = np.concatenate([np.arange(first - beside, first), np.arange(last, last + beside)])
    rows = _skyline(sky[:, columns])
    fits = np.ones(columns.size, bool)
    for _ in range(2):  # without what stands out, such as boats and waves
        slope, offset = np.polyfit(columns[fits], rows[fits], 1)
        away = np.abs(rows - slope * columns - offset)
        fits = away <= np.quantile(away, _MOST)
    if np.quantile(away, _MOST) > _STRAIGHT or abs(slope) > _TILT or rows.min() <= sun_mask.y:
        return None
    up = offset + slope * np.arange(first, last) - np.arange(height)[:, None]
    luminance = encoded[:, first:last] @ LUMINANCE
    above = (sky[:, first:last] > 0.9) & (up > 0.5) & (up < 2 * _RISES * height)
    if not above.any():
        return None
    bright = smoothstep(*_AS_BRIGHT, luminance / max(float(np.median(luminance[above])), 1e-3))
    is_sky, no_sky = np.zeros_like(sky), np.zeros_like(sky)
    # As soft as a matte beside it, also where the sun's part of the horizon ends.
    share = np.clip(0.5 * up + 0.25, 0, 1)
    ends = np.minimum(np.arange(last - first) + 1, np.arange(last - first, 0, -1)) / _FADES
    is_sky[:, first:last] = np.minimum(ends, 1) * bright * share * (up < _RISES * height)
    no_sky[:, first:last] = np.minimum(ends, 1) * (1 - share)
    return is_sky, no_sky


def observe(
    seed: Point | None,
    sun_mask: SunMask | None,
    sky: np.ndarray,
    camera: Camera,
    working: Working,
    peak: Peak | None = None,
) -> SunObservation | None:
    """Make the Scene's observation of the sun from a mask, or from a hint outside the picture.

    A hinted sun keeps its position; the mask then gives only its size and pixels. ``peak`` is the
    network's peak of a detected sun.
    """
    zoom_x, zoom_y = working.zoom
    if seed is not None:
        x, y = seed
    elif sun_mask is not None:
        x, y = sun_mask.x, sun_mask.y
    else:
        return None
    mask = np.zeros_like(sky)
    radius, visible = 0.0, False
    if sun_mask is not None:
        column = min(max(int(x), 0), working.width - 1)
        row = min(max(int(y), 0), working.height - 1)
        around = sky[max(row - 3, 0) : row + 4, max(column - 3, 0) : column + 4]
        area = float(sun_mask.mask.sum())
        half_set = peak is not None and float((sun_mask.mask * sky).sum()) > _SET * area
        visible = area > 0 and (half_set or bool(around.max() > 0.5))
        if visible:
            mask, radius = sun_mask.mask, sun_mask.radius * zoom_y
    azimuth, elevation = camera.angles(x * zoom_x, y * zoom_y)
    source = "detected" if seed is None else "hint"
    dark = visible and peak is None and night(working.encoded @ LUMINANCE, sky)
    return SunObservation(
        x * zoom_x,
        y * zoom_y,
        radius,
        azimuth,
        elevation,
        mask,
        (camera.width, camera.height),
        visible,
        source,
        "moon" if dark else "sun",
        1.0 if peak is None else peak.confidence,
    )
