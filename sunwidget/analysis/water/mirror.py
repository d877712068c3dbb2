"""What water mirrors, and how calm it is: the picture below an axis compared with that above it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.images.working_copy import Working, resize, smoothstep
from sunwidget.analysis.segmentation.feather import share_along_edges
from sunwidget.analysis.water.glitter import small_copy
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera

_FLOOR = 0.003  # display-linear light below which all is black
_SHIFT = 0.08  # of the height: largest error of the horizon
_BELOW = 0.02  # of the height: how far below the shore the axis may be, for it is seen from above
_FEWEST = 0.05  # share of the picture that must be mirrored
_CLEAR = 0.42, 0.55  # correlation of water and what it mirrors: ripples, and a mirror
_CONTRAST = 0.25, 0.38  # log2 of light along a row: less is no proof
_COURSE = 0.15  # of the width: what changes more slowly along a row is no mirror image
_OUTLINE = 0.3, 0.5  # correlation of the water's light and the skyline that it would mirror
_RISE = 0.3  # log2 from land to sky: less says nothing
_WASHED = 0.3, 0.7  # rise of the water's light over that above it: ripples, and a mirror
_EITHER = 0.05  # least share of the water's pixels that mirror sky, or land
_CALM = 0.05  # slope variance of a mirror relative to the standard wind's
_SURE = 0.15, 0.85  # share of land along the photo's edges, below and above which there is only one


class Mirror(NamedTuple):
    """The photo's water as a mirror."""

    clear: float
    """0 for waves, or where nothing is mirrored; 1 for a mirror."""
    land: np.ndarray
    """Share of a pixel's water that mirrors land, (h, w) float32 in [0, 1]."""

    @property
    def roughness(self) -> float:
        """Slope variance relative to the standard wind's: a mirror needs less than 2 degrees."""
        return 1 + self.clear * (_CALM - 1)


def find_mirror(
    working: Working, sky: np.ndarray, water: np.ndarray, camera: Camera, *, glints: bool = False
) -> Mirror:
    """Compare water with the picture above each possible axis, row by row.

    Two things tell a mirror. Its light correlates with that above it, without the rows' means and
    slow courses, since skies and water grow brighter alike. Or it is darker where it would mirror
    land than where it would mirror sky, beyond what a parabola from row to row explains.

    Parameters
    ----------
    working : Working
    sky, water : (h, w) float32
        Maps at its size.
    camera : Camera
        Camera for any size.
    glints : bool
        Whether the photo's sun may glint: a column of glints looks like the mirrored glow above it.

    Returns
    -------
    Mirror
    """
    nothing = Mirror(0.0, np.zeros(water.shape, np.float32))
    light, mask = small_copy(working, water)
    wet = mask > 0.6
    if wet.mean() < _FEWEST:
        return nothing
    height, width = wet.shape
    logs = np.log2(np.maximum(light @ LUMINANCE, _FLOOR)).astype(np.float32)
    bright = resize(sky, width, height) > 0.5
    found = [each for each in _likenesses(logs, bright, wet, camera, glints) if each.clear > 0]
    best = max(found, key=lambda each: each.score, default=None)
    if best is None or best.score <= 0:
        return nothing
    mirrored = water * _mirrored_land(sky, water, best.row / height)
    land = smoothstep(*_SURE, share_along_edges(working, mirrored, water))
    dark = resize(_darkness(logs, bright, wet, best.row), *water.shape[::-1])
    land = np.where(water > 0, best.land * land * dark, 0)
    return Mirror(best.clear, land.astype(np.float32))


class _Likeness(NamedTuple):
    """How alike water and the picture above an axis are."""

    row: int
    score: float  # sum of the correlations of detail and of outline
    clear: float  # how clear a mirror that makes it, [0, 1]
    land: float  # how far water that would mirror land does so, [0, 1]


def _likenesses(
    logs: np.ndarray, sky: np.ndarray, wet: np.ndarray, camera: Camera, glints: bool
) -> Iterator[_Likeness]:
    """Yield the likeness of each possible axis."""
    import cv2

    height, width = wet.shape
    logs = cv2.GaussianBlur(logs, (0, 0), 1.0)
    fine = logs - cv2.GaussianBlur(logs, (0, 0), sigmaX=_COURSE * width, sigmaY=0.5)
    horizon = camera.resized(width, height).horizon_row()
    shore = float(np.quantile(wet.argmax(0)[wet.any(0)], 0.9))
    first = round(horizon - _SHIFT * height)
    last = round(max(horizon + _SHIFT * height, shore + _BELOW * height))
    for axis in range(first, last + 1):
        row, pairs = _pairs(wet, axis)
        if pairs.mean() < _FEWEST:
            continue
        here, there = (_without_rows(values, pairs)[pairs] for values in (fine, fine[row]))
        product, spread = float((here * there).sum()), float((here**2).sum() * (there**2).sum())
        detail = product / max(np.sqrt(spread), 1e-6)
        alike = smoothstep(*_CLEAR, detail) * smoothstep(*_CONTRAST, float(there.std()))
        alike = 0.0 if glints else float(alike)
        outline, rise, _ = _outline(logs, sky[row], pairs)
        rise_above = _outline(logs[row], sky[row], pairs)[1]
        seen = float(smoothstep(*_OUTLINE, outline))
        # Ripples wash out the skyline's contrast.
        known = abs(rise_above) > _RISE
        calm = float(smoothstep(*_WASHED, rise / rise_above)) if known else alike
        clear, land = max(alike, calm * seen), calm * max(alike, seen)
        yield _Likeness(axis, detail + outline, clear, land)


def _mirrored_rows(height: int, axis: float) -> np.ndarray:
    """Return the row that each of ``height`` rows mirrors, the first or last if it is outside."""
    above = np.round(2 * axis - np.arange(height)).astype(int)
    return np.clip(above, 0, height - 1)


def _pairs(wet: np.ndarray, axis: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the mirrored rows, and where water (h, w) would mirror what is inside and dry."""
    row = _mirrored_rows(len(wet), axis)
    inside = row == 2 * axis - np.arange(len(wet))
    return row, wet & ~wet[row] & inside[:, None]


def _without_rows(values: np.ndarray, inside: np.ndarray) -> np.ndarray:
    """Subtract each row's mean inside a mask."""
    means = (values * inside).sum(1) / np.maximum(inside.sum(1), 1)
    return np.asarray(values - means[:, None])


def _outline(
    logs: np.ndarray, sky: np.ndarray, inside: np.ndarray
) -> tuple[float, float, np.ndarray]:
    """Return how light rises from land to sky inside a mask, without a parabola of the row.

    The correlation, the rise (log2), and the light of sky by row; 0 if there is only one of both.
    """
    rows = np.linspace(-1, 1, len(logs))
    if not _EITHER < float(sky[inside].mean()) < 1 - _EITHER:
        return 0.0, 0.0, 0 * rows
    terms = np.stack([np.ones_like(rows), rows, rows**2], 1)
    # What only depends on the row needs no pixels, but sums of rows.
    light, bright = np.where(inside, logs, 0), inside & sky
    solve = np.linalg.pinv(terms.T @ (inside.sum(1)[:, None] * terms))
    by_light, by_sky = terms.T @ light.sum(1), terms.T @ bright.sum(1)
    product = float((light * bright).sum() - by_light @ solve @ by_sky)
    light_spread = float((light**2).sum() - by_light @ solve @ by_light)
    sky_spread = max(float(bright.sum() - by_sky @ solve @ by_sky), 1e-6)
    rise = product / sky_spread
    level = terms @ solve @ (by_light - rise * by_sky) + rise
    seen = np.flatnonzero(inside.any(1))
    level = level[np.clip(np.arange(len(rows)), seen[0], seen[-1])]
    return product / np.sqrt(max(light_spread * sky_spread, 1e-6)), rise, level


def _darkness(logs: np.ndarray, sky: np.ndarray, wet: np.ndarray, axis: int) -> np.ndarray:
    """Return how far water is darker than where it mirrors sky, relative to land and sky, (h, w).

    1 where that land is as bright as the sky, or no sky is mirrored.
    """
    import cv2

    row, pairs = _pairs(wet, axis)
    logs = cv2.GaussianBlur(logs, (0, 0), 1.5)
    beyond = _dry(logs, wet)[row]
    (_, rise, level), (_, _, level_above) = (
        _outline(values, sky[row], pairs) for values in (logs, beyond)
    )
    if rise == 0:
        return np.ones(logs.shape, np.float32)
    seen = 1 - np.exp2(np.minimum(logs - level[:, None], 0))
    land = 1 - np.exp2(np.minimum(beyond - level_above[:, None], 0))
    covered = np.clip(seen / np.maximum(land, 0.05), 0, 1)
    return np.asarray(1 + smoothstep(0.1, 0.3, land) * (covered - 1), np.float32)


def _mirrored_land(sky: np.ndarray, water: np.ndarray, axis: float) -> np.ndarray:
    """Return how much land, not sky, lies above the axis, (h, w), at the same distance from it.

    What would be mirrored from outside the picture is that at its upper border.
    """
    row = _mirrored_rows(len(sky), axis * len(sky))
    return _dry(1 - sky, water >= 0.5)[row]


def _dry(image: np.ndarray, wet: np.ndarray) -> np.ndarray:
    """Return the image with what lies beyond the shore in place of water.

    Between the axis and a shore above it water would mirror water, but mirrors the shore.
    """
    rows = np.where(wet, 0, np.arange(len(image))[:, None])
    return np.take_along_axis(image, np.maximum.accumulate(rows, axis=0), 0)
