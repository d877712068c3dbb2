"""Looking for the sun in a photo's sky, and telling the moon and lamps from it."""

from __future__ import annotations

import math

import numpy as np

from sunwidget.analysis.working import LUMINANCE, Working

RADIUS_DEG = 0.2665  # apparent radius of the sun's disc, and of the moon's
_NIGHT = 0.5  # a sun lights a tenth of its sky to more than this encoded luminance, a moon does not


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
    return None if night(luminance, sky) else best


def night(luminance: np.ndarray, sky: np.ndarray) -> bool:
    """Whether the sky (h, w) is too dark for one with a sun in it; luminance encoded.

    Measured: 0.74 and more at the 90th percentile of skies with a sun, sunsets included; 0.45
    and less with a moon.
    """
    inside = sky > 0.5
    return bool(inside.any()) and float(np.quantile(luminance[inside], 0.9)) < _NIGHT


def find_moon(working: Working, sky: np.ndarray) -> tuple[float, float] | None:
    """Return the centre of a bright disc in a night sky, in fractions of the picture, or None.

    It must be round and stand free in the sky, which a lamp on its post does not.
    """
    import cv2

    luminance = working.encoded @ LUMINANCE
    if min(sky.shape) < 16 or not night(luminance, sky):
        return None
    near_sky = cv2.dilate((sky > 0.5).astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    smooth = np.where(near_sky, cv2.GaussianBlur(luminance, (0, 0), 1.0), 0)
    row, column = np.unravel_index(int(smooth.argmax()), smooth.shape)
    peak, level = float(smooth[row, column]), float(np.median(luminance[sky > 0.5]))
    if peak < 0.8:
        return None
    _, labels = cv2.connectedComponents((smooth > (peak + level) / 2).astype(np.uint8))
    disc = (labels == labels[row, column]).astype(np.uint8)
    area = int(disc.sum())
    depth = cv2.distanceTransform(np.pad(disc, 1), cv2.DIST_L2, 5)[1:-1, 1:-1]
    radius = float(depth.max())
    if radius < 2.5 or math.pi * radius**2 < 0.6 * area:
        return None
    rows, columns = np.nonzero(disc)
    centre = float(columns.mean()) + 0.5, float(rows.mean()) + 0.5
    y, x = np.mgrid[: sky.shape[0], : sky.shape[1]] + 0.5
    distance = np.hypot(x - centre[0], y - centre[1])
    ring = (distance > 1.3 * radius + 2) & (distance < 2.2 * radius + 4)
    # Before a tele lens it is larger than any lamp, and trees or roofs may stand beside it.
    least = 0.85 if radius < 0.03 * max(sky.shape) else 0.4
    free = ring.any() and float((sky[ring] > 0.5).mean()) > least
    return (centre[0] / sky.shape[1], centre[1] / sky.shape[0]) if free else None


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
    falls = -np.diff(rings)
    drop = float(rings[0] - rings[-1])
    # A speck of a few pixels may be any cloud's edge; a sun's sky darkens away from it.
    speck = area < 30 and (drop < 0.085 or share < 0.85)
    small = radius < 3.2 * true_radius and roundness > 0.78
    # Setting, it is less than burnt and lies in orange sky, which no cloud's edge does.
    setting = burnt > 0.93 and share > 0.85 and _orange(encoded, seed, radius)
    white = setting or (burnt > 0.985 and not speck)
    if white and small and step > 0.1 and _compact(luminance, seed, radius):
        return 3 + roundness, seed
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


def _orange(encoded: np.ndarray, seed: tuple[float, float], radius: float) -> bool:
    """Whether the pixels just round a small disc are bright and deep orange."""
    reach = math.ceil(3 * radius + 6)
    column, row = int(seed[0]), int(seed[1])
    top, left = max(row - reach, 0), max(column - reach, 0)
    part = encoded[top : row + reach + 1, left : column + reach + 1]
    y, x = np.mgrid[: part.shape[0], : part.shape[1]] + 0.5
    distance = np.hypot(x + left - seed[0], y + top - seed[1])
    ring = (distance > 1.5 * radius + 2) & (distance < 3 * radius + 6) & (part[..., 0] > 0.6)
    if np.count_nonzero(ring) < 0.3 * math.pi * (3 * radius + 6) ** 2:
        return False
    red, green, blue = np.median(part[ring], axis=0)
    return bool(red > 0.85 and blue < 0.45 * red and green < 0.9 * red)


def _compact(luminance: np.ndarray, seed: tuple[float, float], radius: float) -> bool:
    """Whether what is nearly as bright round a small disc is round as well.

    The brightest spot of a cloud or a tree in blossom is round by chance, and ragged a little
    lower.
    """
    import cv2

    reach = math.ceil(6 * radius + 4)
    column, row = int(seed[0]), int(seed[1])
    part = luminance[max(row - reach, 0) : row + reach + 1, max(column - reach, 0) :]
    part = np.ascontiguousarray(part[:, : min(column, reach) + reach + 1])
    here = min(row, reach), min(column, reach)
    bright = (part > part[here] - 0.06).astype(np.uint8)
    _, labels = cv2.connectedComponents(bright, connectivity=8)
    blot = (labels == labels[here]).astype(np.uint8)
    depth = float(cv2.distanceTransform(np.pad(blot, 1), cv2.DIST_L2, 5).max())
    return math.pi * depth**2 > 0.5 * float(blot.sum())


def _rings(
    luminance: np.ndarray, sky: np.ndarray, seed: tuple[float, float], radius: float
) -> tuple[np.ndarray, float]:
    """Mean luminance of the sky in widening rings, and the share of sectors that darken."""
    side = max(luminance.shape)
    edges = radius + side * np.array([0.012, 0.03, 0.055, 0.09, 0.14, 0.2])
    # Only the square round the rings: a photo may have twenty blots to ask about.
    column, row = seed
    left, top = (max(0, math.floor(at - edges[-1])) for at in (column, row))
    box = slice(top, math.ceil(row + edges[-1])), slice(left, math.ceil(column + edges[-1]))
    luminance, sky = luminance[box], sky[box]
    rows, columns = np.ogrid[: luminance.shape[0], : luminance.shape[1]]
    rows, columns = rows + (top + 0.5 - row), columns + (left + 0.5 - column)
    distance = np.hypot(columns, rows)
    counted = sky & (distance >= edges[0]) & (distance < edges[-1])
    ring = np.searchsorted(edges, distance[counted], side="right") - 1
    turn = np.arctan2(*(np.broadcast_to(a, counted.shape)[counted] for a in (rows, columns)))
    sector = ((turn / (2 * np.pi) + 0.5) * 12).astype(int) % 12
    cells = 5 * sector + ring
    weight = np.bincount(cells, minlength=60).reshape(12, 5)
    total = np.bincount(cells, luminance[counted], minlength=60).reshape(12, 5)
    filled = weight.sum(axis=0) >= 20
    reached = 5 if filled.all() else int(filled.argmin())
    means = total.sum(axis=0)[:reached] / weight.sum(axis=0)[:reached]
    table = np.where(weight >= 5, total / np.maximum(weight, 1), np.nan)
    table[:, reached:] = np.nan
    usable = np.isfinite(table[:, 0]) & np.isfinite(table[:, 2])
    if usable.sum() < 4:
        return np.array([]), 0.0
    inner, outer = table[usable, 0], np.nanmin(table[usable], axis=1)
    return means, float(np.mean(inner - outer > 0.03))
