"""The photo's own sun: where it is, how large it came out, and its pixels (thesis 3.1.3).

``METHODS`` maps a name to a function that grows a mask from a seed pixel; ``find`` looks for the
seed when no person gave one.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.working import LUMINANCE, Working, resize
from sunwidget.camera import Camera, Point

RADIUS_DEG = 0.2665  # apparent radius of the sun's disc
TOLERANCE = 0.03  # M of Algorithm 1: encoded luminance around the seed's


@dataclass(frozen=True, eq=False)
class SunObservation:
    """The sun as the photo shows it.

    Parameters
    ----------
    x, y : float
        Centre in pixels of the photo; may lie outside.
    radius_px : float
        Radius of its bright blot in pixels (0 when it is outside or hidden). Over-exposed suns
        come out far larger than the true disc.
    azimuth, elevation : float
        Degrees, by the camera.
    mask : (H, W) float32
        Pixels of the blot, [0, 1].
    visible : bool
        Whether the photo shows it.
    source : str
        Name of the method, "hint", or "assumed".
    """

    x: float
    y: float
    radius_px: float
    azimuth: float
    elevation: float
    mask: np.ndarray
    visible: bool
    source: str


class Blot(NamedTuple):
    """The sun in working pixels: centre, radius and its pixels (h, w) float32."""

    x: float
    y: float
    radius: float
    mask: np.ndarray


def flood_fill(working: Working, sky: np.ndarray, x: float, y: float, focal: float) -> Blot:
    """Grow from the seed over pixels whose luminance differs from the seed's by at most M.

    Thesis Algorithm 1, marked on push (``cv2.floodFill`` with a fixed range). ``sky`` and
    ``focal`` are not used.
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
    return Blot(float(columns.mean()) + 0.5, float(rows.mean()) + 0.5, radius, filled)


def disc_fit(working: Working, sky: np.ndarray, x: float, y: float, focal: float) -> Blot:
    """Grow the clipped blot around the seed and fit a circle to it.

    The blot is what is nearly as bright as the brightest pixel within a few disc radii of the
    seed; its centre is the centroid weighted by how far inside it lies, so that rays and a
    horizon that cuts it pull little. Never smaller than the true disc in this camera.
    """
    import cv2

    true_radius = focal * math.tan(math.radians(RADIUS_DEG))
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
        return Blot(x, y, true_radius, np.zeros((height, width), np.float32))
    mask = (labels == np.bincount(found).argmax()).astype(np.uint8)
    depth = cv2.distanceTransform(np.pad(mask, 1), cv2.DIST_L2, 5)[1:-1, 1:-1]
    weight = np.where(depth > 0.5 * depth.max(), depth, 0) ** 2
    rows, columns = np.mgrid[:height, :width]
    total = float(weight.sum())
    centre_x = float((columns * weight).sum()) / total + 0.5
    centre_y = float((rows * weight).sum()) / total + 0.5
    return Blot(centre_x, centre_y, max(float(depth.max()), true_radius), mask.astype(np.float32))


METHODS: dict[str, Callable[[Working, np.ndarray, float, float, float], Blot]] = {
    "flood_fill": flood_fill,
    "disc_fit": disc_fit,
}


def find(working: Working, sky: np.ndarray, focal: float) -> tuple[float, float] | None:
    """Return the seed of a visible sun in working pixels, or None.

    The brightest part of the sky (or just at the skyline) must be nearly clipped, and the sky
    around it must grow darker outwards in almost every direction, as an aureole does and a
    white cloud does not.
    """
    import cv2

    height, width = sky.shape
    side = max(height, width)
    if min(height, width) < 16 or not (sky > 0.5).any():
        return None
    near_sky = cv2.dilate((sky > 0.5).astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    luminance = working.encoded @ LUMINANCE
    smooth = cv2.GaussianBlur(luminance, (0, 0), max(0.8, 0.0012 * side))
    smooth = np.where(near_sky, smooth, 0)
    peak = float(smooth.max())
    if peak < 0.9:
        return None
    true_radius = max(focal * math.tan(math.radians(RADIUS_DEG)), 1.0)
    best, best_score = None, 0.0
    for threshold in (max(0.9, peak - 0.01), max(0.9, peak - 0.04)):
        blots = (smooth >= threshold).astype(np.uint8)
        count, labels, stats, _ = cv2.connectedComponentsWithStats(blots, connectivity=8)
        largest = np.argsort(-stats[1:, cv2.CC_STAT_AREA])[:12] + 1
        for label in largest[: count - 1]:
            blot = (labels == label).astype(np.uint8)
            score, seed = _likelihood(blot, working.encoded, luminance, near_sky, true_radius)
            if score > best_score:
                best, best_score = seed, score
    return best


def _likelihood(
    blot: np.ndarray,
    encoded: np.ndarray,
    luminance: np.ndarray,
    sky: np.ndarray,
    true_radius: float,
) -> tuple[float, tuple[float, float]]:
    """How much a bright blot is like a sun (0 = not at all), and its centre.

    Three kinds are known, best first: a burnt-out disc of about the true size; a large burnt
    core round which the sky fades ring by ring, far out and on all sides (a white cloud ends at
    its edge, and what lies beyond knows nothing of it); and the same in the colours of sunset,
    where blue does not burn. The numbers part the suns from the clouds, lamps and bright
    horizons of 51 varied photos.
    """
    import cv2

    area = int(blot.sum())
    if area < 3 or area > 0.05 * blot.size:
        return 0.0, (0.0, 0.0)
    depth = cv2.distanceTransform(np.pad(blot, 1), cv2.DIST_L2, 5)[1:-1, 1:-1]
    row, column = np.unravel_index(int(depth.argmax()), depth.shape)
    radius = float(depth.max())
    seed = (float(column) + 0.5, float(row) + 0.5)
    roundness = min(math.pi * radius**2 / area, 1.0)
    rings, share = _rings(luminance, sky, seed, radius)
    if roundness < 0.2 or rings.size < 4:
        return 0.0, seed
    burnt = float(encoded[row, column].min())
    step = float(luminance[row, column]) - float(rings[0])
    if burnt > 0.985 and roundness > 0.78 and radius < 3.2 * true_radius and step > 0.1:
        return 3 + roundness, seed
    falls = -np.diff(rings)
    drop = float(rings[0] - rings[-1])
    sudden = float(falls.max()) / max(drop, 1e-3)  # the edge of a cloud is one large step
    if float(falls.min()) < -0.01 or drop < 0.12 or share < 0.75:
        return 0.0, seed
    large = radius > 0.012 * max(blot.shape)
    if large and (
        (burnt > 0.985 and sudden < 0.4) or (burnt > 0.94 and sudden < 0.33 and roundness > 0.7)
    ):
        return 2 + drop + 0.3 * roundness, seed
    if burnt < 0.85 and roundness > 0.75 and radius > 1.5 and share > 0.95 and sudden < 0.38:
        return 1 + drop, seed
    return 0.0, seed


def _rings(
    luminance: np.ndarray, sky: np.ndarray, seed: tuple[float, float], radius: float
) -> tuple[np.ndarray, float]:
    """Mean luminance of the sky in widening rings, and the share of sectors that darken."""
    height, width = luminance.shape
    side = max(height, width)
    columns, rows = np.arange(width) + 0.5 - seed[0], np.arange(height)[:, None] + 0.5 - seed[1]
    distance = np.hypot(columns, rows)
    sector = ((np.arctan2(rows, columns) / (2 * np.pi) + 0.5) * 12).astype(int) % 12
    edges = radius + side * np.array([0.012, 0.03, 0.055, 0.09, 0.14, 0.2])
    means, table = [], np.full((12, 5), np.nan)
    for k in range(5):
        ring = sky & (distance >= edges[k]) & (distance < edges[k + 1])
        if ring.sum() < 20:
            break
        means.append(float(luminance[ring].mean()))
        weight = np.bincount(sector[ring], minlength=12)
        total = np.bincount(sector[ring], luminance[ring], minlength=12)
        table[:, k] = np.where(weight >= 5, total / np.maximum(weight, 1), np.nan)
    usable = np.isfinite(table[:, 0]) & np.isfinite(table[:, 2])
    if usable.sum() < 4:
        return np.array([]), 0.0
    inner, outer = table[usable, 0], np.nanmin(table[usable], axis=1)
    return np.array(means), float(np.mean(inner - outer > 0.03))


def in_sky(blot: Blot, sky: np.ndarray) -> np.ndarray:
    """Return the blot with a soft rim, (h, w) float32; zeros unless sky surrounds it."""
    import cv2

    if not 0 < blot.radius < 0.1 * max(sky.shape):
        return np.zeros_like(sky)
    reach = 2 * math.ceil(0.25 * blot.radius + 2) + 1
    ring = cv2.dilate(blot.mask, np.ones((3 * reach, 3 * reach), np.uint8)) - blot.mask
    if ring.sum() < 1 or float((ring * sky).sum() / ring.sum()) < 0.6:
        return np.zeros_like(sky)
    grown = cv2.dilate(blot.mask, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (reach, reach)))
    return np.clip(cv2.GaussianBlur(grown, (0, 0), reach / 6), 0, 1).astype(np.float32)


def observe(
    seed: Point | None,
    blot: Blot | None,
    sky: np.ndarray,
    camera: Camera,
    working: Working,
) -> SunObservation | None:
    """Turn a blot, or a hint outside the picture, into what the Scene tells about the sun.

    A hinted sun stays where the person put it; the blot then only gives size and pixels.
    """
    zoom_x, zoom_y = working.zoom
    if seed is not None:
        x, y = seed
    elif blot is not None:
        x, y = blot.x, blot.y
    else:
        return None
    mask = np.zeros((camera.height, camera.width), np.float32)
    radius, visible = 0.0, False
    if blot is not None:
        column = min(max(int(x), 0), working.width - 1)
        row = min(max(int(y), 0), working.height - 1)
        around = sky[max(row - 3, 0) : row + 4, max(column - 3, 0) : column + 4]
        visible = bool(around.max() > 0.5) and bool(blot.mask.any())
        if visible:
            mask, radius = resize(blot.mask, camera.width, camera.height), blot.radius * zoom_y
    azimuth, elevation = camera.angles(x * zoom_x, y * zoom_y)
    source = "detected" if seed is None else "hint"
    return SunObservation(x * zoom_x, y * zoom_y, radius, azimuth, elevation, mask, visible, source)


def assume(working: Working, sky: np.ndarray, camera: Camera) -> tuple[float, float]:
    """Guess azimuth and elevation of a sun that the photo does not show.

    The sky is brightest towards the sun: the azimuth is that of the brightest part of the
    sky, blurred; the elevation is that part's own when it is low and the sky darkens above it,
    else 20° above the upper frame.
    """
    import cv2

    height, width = sky.shape
    luminance = np.log(np.maximum(working.luminance, 1e-3))
    weight = (sky > 0.5).astype(np.float32)
    top = camera.angles(camera.width / 2, 0)[1]
    high = min(max(top + 20, 15.0), 75.0)
    if weight.mean() < 0.005 or min(height, width) < 8:
        return 0.0, high
    blur = 0.08 * max(height, width)
    share = cv2.GaussianBlur(weight, (0, 0), blur)
    smooth = cv2.GaussianBlur(luminance * weight, (0, 0), blur) / np.maximum(share, 1e-3)
    smooth = np.where((weight > 0) & (share > 0.02), smooth, -np.inf)
    row, column = np.unravel_index(int(smooth.argmax()), smooth.shape)
    azimuth, _ = camera.angles((column + 0.5) * working.zoom[0], (row + 0.5) * working.zoom[1])
    return azimuth, high
