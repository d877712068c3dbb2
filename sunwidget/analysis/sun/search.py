"""Search for the sun in a photo, and distinguish it from the moon."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.fit.confidence import probability
from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.networks.sun import SunMaps
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Point

LEAST_CONFIDENCE = 0.45  # from which a peak counts as the sun
SURE = 0.7  # the same in a sky as dark as at night
# Bias, then the weights of ``features_of``: python -m training.suns.calibrate
WEIGHTS = (-2.694, 2.156, -0.734, -0.972)
RADIUS_SCALE = 0.758  # from the network's radius to the radius that people draw
_NEAR_SKY = 0.04  # of the width; a sun has some sky within it, or within
_NEAR_RADII = 2.0  # of its radius
_ALONE = 0.97  # confidence from which a sun needs none, as one between leaves
_NIGHT = 0.5  # encoded luminance of the sky's brightest tenth: with a sun above, with a moon below


class Peak(NamedTuple):
    """A sun found by the network, in working pixels.

    Parameters
    ----------
    x, y : float
        Center.
    radius : float
        Radius of its disc or clipped core.
    confidence : float
        Probability that it is a sun, [0, 1]: a logistic regression (Platt 1999) on the network's
        output, fitted to hand-labeled photos.
    sharpness : float
        Probability that it has a limb, [0, 1].
    """

    x: float
    y: float
    radius: float
    confidence: float
    sharpness: float


def _likeliest(probability: np.ndarray) -> tuple[int, int]:
    """Return row and column of a map's greatest value."""
    row, column = np.unravel_index(int(probability.argmax()), probability.shape)
    return int(row), int(column)


def _log_odds(*probabilities: float) -> np.ndarray:
    """Return ln(p / (1 - p)), limited to that of one in a million."""
    p = np.clip(probabilities, 1e-6, 1 - 1e-6)
    return np.asarray(np.log(p / (1 - p)))


def features_of(maps: SunMaps) -> np.ndarray:
    """Return the features that decide whether the likeliest place has a sun, (3,).

    They are the log odds there and at the best place elsewhere, and the excess of light to be
    erased over the surroundings.
    """
    height, width = maps.probability.shape
    row, column = _likeliest(maps.probability)
    radius = float(maps.radius[row, column])
    columns, rows = np.arange(width) - column, np.arange(height)[:, None] - row
    away = np.hypot(columns, rows) / width
    # Glints on water below it are evidence for the sun, not for another place.
    glints = (rows > 0) & (np.abs(columns) < 0.12 * width)
    elsewhere = maps.probability[(away > max(0.08, 2 * radius)) & ~glints]
    odds = _log_odds(maps.probability[row, column], elsewhere.max(initial=0.0))
    erased = resize(maps.clean.mean(-1), width, height)
    core = float(erased[away <= max(0.012, 0.7 * radius)].min())
    ring = erased[(away > radius + 0.08) & (away < radius + 0.16)]
    around = float(np.median(ring)) if ring.size else 0.0
    return np.array([*odds, core - around])


def peak_of(maps: SunMaps, working: Working) -> Peak:
    """Return the likeliest sun, even if it is unlikely."""
    height, width = maps.probability.shape
    row, column = _likeliest(maps.probability)
    rows, columns = slice(max(row - 1, 0), row + 2), slice(max(column - 1, 0), column + 2)
    weight = maps.probability[rows, columns].astype(np.float64) ** 2
    y, x = np.mgrid[:height, :width]
    total = float(weight.sum())
    return Peak(
        float(((x[rows, columns] + 0.5) * weight).sum()) / total * working.width / width,
        float(((y[rows, columns] + 0.5) * weight).sum()) / total * working.height / height,
        RADIUS_SCALE * float(maps.radius[row, column]) * working.width,
        probability(WEIGHTS, features_of(maps)),
        float(maps.sharpness[row, column]),
    )


def find(working: Working, maps: SunMaps, sky: np.ndarray) -> Peak | None:
    """Return the sun that the photo shows, or None; a disc in a dark sky is likely the moon."""
    peak = peak_of(maps, working)
    if peak.confidence < _ALONE and not _beside_sky(peak, sky):
        return None
    if not night(working.encoded @ LUMINANCE, sky):
        return peak if peak.confidence >= LEAST_CONFIDENCE else None
    # A sky this dark is red around the sun; a blue one is lit by the moon.
    red, _, blue = np.median(working.encoded[sky > 0.5], axis=0)
    moonlit = red <= blue and find_moon(working, sky) is not None
    return peak if peak.confidence >= SURE and not moonlit else None


def _beside_sky(place: Peak, sky: np.ndarray) -> bool:
    """Return whether there is sky (h, w) near a place: sunlit snow shines like a sun, too."""
    reach = max(_NEAR_SKY * sky.shape[1], _NEAR_RADII * place.radius)
    y, x = np.ogrid[: sky.shape[0], : sky.shape[1]]
    near = np.hypot(x + 0.5 - place.x, y + 0.5 - place.y) <= reach
    return bool((sky[near] > 0.1).any())


def night(luminance: np.ndarray, sky: np.ndarray) -> bool:
    """Return whether the sky (h, w) is too dark for a sun in it; luminance is encoded.

    Measured at the 90th percentile: 0.74 and more for skies with a sun, including sunsets; 0.45
    and less with a moon.
    """
    inside = sky > 0.5
    return bool(inside.any()) and float(np.quantile(luminance[inside], 0.9)) < _NIGHT


def on_dark_land(working: Working, sky: np.ndarray, place: Point) -> bool:
    """Return whether a place inside the picture is neither sky (h, w) nor as bright as one.

    No sun can be seen there: it is behind land, or below the horizon.
    """
    column, row = int(place[0]), int(place[1])
    return bool(sky[row, column] < 0.5 and working.encoded[row, column] @ LUMINANCE < _NIGHT)


def find_moon(working: Working, sky: np.ndarray) -> tuple[float, float] | None:
    """Return the center of a bright disc in a night sky, in fractions of the picture, or None.

    It must be round and free in the sky, unlike a lamp on a post.
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
    center = float(columns.mean()) + 0.5, float(rows.mean()) + 0.5
    y, x = np.mgrid[: sky.shape[0], : sky.shape[1]] + 0.5
    distance = np.hypot(x - center[0], y - center[1])
    ring = (distance > 1.3 * radius + 2) & (distance < 2.2 * radius + 4)
    # In a telephoto it is larger than any lamp, and trees or roofs may be beside it.
    least = 0.85 if radius < 0.03 * max(sky.shape) else 0.4
    free = ring.any() and float((sky[ring] > 0.5).mean()) > least
    return (center[0] / sky.shape[1], center[1] / sky.shape[0]) if free else None
