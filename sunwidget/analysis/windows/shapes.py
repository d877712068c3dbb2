"""Windows as upright trapezia: fitted to a network's output, then aligned with their neighbors.

A façade has few kinds of window in rows and columns. The network's shape of each is ragged; all of
them together give the size, slope and position of each.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.images.working_copy import resize

X, Y, WIDE, TALL, TOP, FOOT = range(6)
"""Columns of windows, (n, 6): center, size (pixels), slopes of lintel and sill."""
# Probabilities: a piece that is no trapezium at one may split into some at the next.
_LEVELS = (0.5, 0.65, 0.8, 0.9)
_WEAK = 0.2  # probability of a window that is in line with others
_LIKE_A_WINDOW = 0.75  # intersection over union with a trapezium
_BARELY = 0.6  # the same for a piece that does not split
_MUCH = 0.4  # least share of a piece that windows in it must cover
_LEAST = 3e-5  # of the picture: smallest window
_FEWEST = 12  # pixels of a window
_THINNEST = 3  # pixels
_SLOPED = 4  # columns from which a slope is measurable
_STEEPEST = 0.8  # slope of sills and lintels
_NARROWING = 0.35  # of a window's height, from one side to the other
_WIDEST = 3.0  # times its height: boards and shadows of eaves are wider
_TALLEST = 6.0  # times its width: posts are taller
_WALL = 0.02  # of the picture: a larger window is a wall of glass
_GAP, _FILLED = 0.015, 0.8  # of the picture's longer side; of a wall's outline
_LEVEL, _UPRIGHT = 0.35, 1.2  # of a wall's width: how steep its edges are; how tall it is
_STACK = 0.1, 2.0  # of the picture's longer side, of its width: taller is more than one room
_PLAIN = 6  # width in pixels from which a window in a coarse picture counts
_MADE_OF = 0.45  # share of a large window or wall from which small windows in it replace it
_SO_MANY = 4  # least number of such small windows
_NEAR = 6.0  # sizes of a window: greatest distance of others of its façade
_ALIKE = 0.35  # ln: greatest difference in size of windows of one kind
_IN_LINE = 0.3  # sizes: greatest distance from a row or column
_BORDER = 1.4  # sizes of a window, within which there is no other
_ALONE, _TOGETHER = 0.65, 0.25  # least mean probability of windows: alone, or in line with others
_AS_LARGE, _LARGE = 0.78, (16, 24)  # the same for large ones; width at its start, and range
_FEW = 3  # neighbors from which a façade is known
_MATES = 2  # neighbors in line that confirm a weak window


class Found(NamedTuple):
    """Windows (n, 6), and walls of glass, (h, w) bool."""

    windows: np.ndarray
    wall: np.ndarray


class Wall(NamedTuple):
    """A wall of glass: its pixels (h, w) bool, and its edges (w,) in pixels from ``left`` on."""

    inside: np.ndarray
    left: int
    top: np.ndarray
    foot: np.ndarray


def find(*seen: np.ndarray) -> Found:
    """Return the windows of a picture.

    Parameters
    ----------
    *seen : (h, w) float32
        Probability that a pixel belongs to a window, at decreasing sizes of the picture: a network
        finds small windows in a fine one and large ones in a coarse one. The result has the
        first size.
    """
    shape = seen[0].shape
    wall = np.zeros(shape, bool)
    strong = _trapezia(seen[0], wall)
    for coarse in seen[1:]:
        rough_wall = np.zeros(coarse.shape, bool)
        rough = _trapezia(coarse, rough_wall)
        rough = rough[rough[:, [WIDE, TALL]].min(1, initial=np.inf) >= _PLAIN]
        strong, wall = _merged(strong, wall, _scaled(rough, coarse.shape, shape), rough_wall)
    probability = likeliest(seen)
    weak = _weak(probability, strong, wall)
    if len(strong) and len(weak):
        strong = np.concatenate([strong, weak[_mates(weak, strong) >= _MATES]])
    windows = _apart(aligned(strong))
    return Found(windows[_believed(windows, probability)], wall)


def likeliest(seen: Sequence[np.ndarray]) -> np.ndarray:
    """Return the maximum of probabilities (h, w) of several sizes, at the first size."""
    height, width = seen[0].shape
    return np.maximum.reduce([resize(image, width, height) for image in seen])


def mean_within(windows: np.ndarray, image: np.ndarray) -> np.ndarray:
    """Return the mean of an image (h, w) in each of the windows (n, 6), (n,)."""
    mean = np.zeros(len(windows))
    for i, window in enumerate(windows):
        quad = corners(window)
        first = np.maximum(np.floor(quad.min(0)).astype(int), 0)
        last = np.minimum(np.ceil(quad.max(0)).astype(int) + 1, image.shape[::-1])
        wide, tall = last - first
        if wide > 0 < tall:
            cover = filled(quad - first, (tall, wide))
            part = image[first[1] : last[1], first[0] : last[0]]
            mean[i] = (cover * part).sum() / max(cover.sum(), 1e-6)
    return mean


def corners(window: np.ndarray) -> np.ndarray:
    """Return a window's corners, (4, 2) pixels, from top left clockwise."""
    x, y, wide, tall, top, foot = window
    half = 0.5 * wide
    rise = np.array([-half, half])
    over, under = y - 0.5 * tall + top * rise, y + 0.5 * tall + foot * rise
    return np.stack([x + rise[[0, 1, 1, 0]], [over[0], over[1], under[1], under[0]]], 1)


def filled(quad: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """Return the share of each pixel in a convex shape, (n, 2) with pixel centers at integers."""
    import cv2

    fine = 4
    cover = np.zeros((fine * shape[0], fine * shape[1]), np.uint8)
    points = np.round((fine * (quad + 0.5) - 0.5) * 16).astype(np.int32)
    cv2.fillConvexPoly(cover, points, 255, shift=4)
    small = cv2.resize(cover, shape[::-1], None, 0, 0, cv2.INTER_AREA)
    return small.astype(np.float32) / 255


def walls(mask: np.ndarray) -> list[Wall]:
    """Return walls of glass with straight edges from a mask of glass, (h, w) bool.

    Gaps smaller than rooms are closed. Only shapes like a tower count: a large surface that is not
    upright, level and whole is more often a clad wall.
    """
    import cv2

    out = []
    side = 2 * round(0.5 * _GAP * max(mask.shape)) + 1
    rows = np.arange(len(mask))[:, None]
    count, pieces, boxes, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8))
    for i in range(1, count):
        left, _, wide, _, _ = boxes[i]
        part = (pieces[:, left : left + wide] == i).astype(np.uint8)
        edges = part.argmax(0), part.shape[0] - part[::-1].argmax(0)
        x = np.arange(wide)
        top, foot = (np.polyval(np.polyfit(x, edge, min(1, wide - 1)), x) for edge in edges)
        outline = (rows >= np.round(top)) & (rows < np.round(foot))
        level = np.ptp(top) < _LEVEL * wide and np.ptp(foot) < _LEVEL * wide
        tower = (foot - top).mean() > _UPRIGHT * wide
        if not (level and tower and (part > 0)[outline].sum() > _FILLED * outline.sum()):
            continue
        inside = np.zeros(mask.shape, bool)
        part = cv2.morphologyEx(part, cv2.MORPH_CLOSE, np.ones((side, side), np.uint8))
        inside[:, left : left + wide] = outline & (part > 0)
        out.append(Wall(inside, int(left), top, foot))
    return out


def stacks(windows: np.ndarray, shape: tuple[int, int]) -> tuple[np.ndarray, list[Wall]]:
    """Return windows (n, 6) of one room each, and taller ones as walls."""
    tall, wide = windows[:, TALL], windows[:, WIDE]
    several = (tall > _STACK[0] * max(shape)) & (tall > _STACK[1] * wide)
    out = []
    for window in windows[several]:
        quad = corners(window)
        left, right = (int(np.clip(round(x), 0, shape[1])) for x in quad[[0, 1], 0])
        if right - left > 1:
            x = np.arange(left, right)
            top, foot = (np.interp(x, quad[at, 0], quad[at, 1]) for at in ([0, 1], [3, 2]))
            out.append(Wall(filled(quad, shape) > 0.5, left, top, foot))
    return windows[~several], out


def aligned(windows: np.ndarray) -> np.ndarray:
    """Return windows (n, 6) with the sizes, slopes and positions of their rows and columns."""
    if len(windows) <= _FEW:
        return windows
    near = _near(windows, windows)
    enough = near.sum(1) > _FEW
    share = near / near.sum(1, keepdims=True)
    out = windows.copy()
    size = np.exp(share @ np.log(windows[:, [WIDE, TALL]]))
    out[enough, WIDE], out[enough, TALL] = size[enough].T
    slopes = _slopes(out, near, out[:, [TOP, FOOT]].mean(1))
    out[enough, TOP], out[enough, FOOT] = slopes[enough].T
    row, column = _lines(out, out)
    row, column = row & near, column & near
    aligned_rows = enough & (row.sum(1) >= _FEW)
    # Rows give slopes more precisely than sills of single windows.
    level, slope = _along(out, row)
    known = near * np.where(aligned_rows, row.sum(1), 0)
    rows = known.sum(1) > 0
    slopes = _slopes(out[rows], known[rows][:, rows], slope[rows])
    out[rows, TOP], out[rows, FOOT] = slopes.T
    out[aligned_rows, Y] = level[aligned_rows]
    columns = enough & (column.sum(1) >= _FEW)
    out[columns, X] = ((column * out[:, X]).sum(1) / np.maximum(column.sum(1), 1))[columns]
    return out


def _along(windows: np.ndarray, row: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return each window's height on the line through its row (n, n), and the slope: (n,)."""
    count = np.maximum(row.sum(1), 1)
    x, y = (row @ windows[:, at] / count for at in (X, Y))
    across, over = (windows[None, :, at] - mean[:, None] for at, mean in ((X, x), (Y, y)))
    slope = (row * across * over).sum(1) / np.maximum((row * across**2).sum(1), 1e-6)
    return y + slope * (windows[:, X] - x), slope


def _apart(windows: np.ndarray) -> np.ndarray:
    """Return windows (n, 6) without those inside a larger one."""
    order = np.argsort(-windows[:, WIDE] * windows[:, TALL])
    windows = windows[order]
    x, y = (np.abs(windows[None, :, at] - windows[:, None, at]) for at in (X, Y))
    inside = (x < 0.5 * windows[:, None, WIDE]) & (y < 0.5 * windows[:, None, TALL])
    return np.asarray(windows[~np.triu(inside, 1).any(0)])


def _near(some: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Return whether others are near some and of similar size, (n, m) bool."""
    size = some[:, None, [WIDE, TALL]]
    apart = np.abs(others[None, :, [X, Y]] - some[:, None, [X, Y]])
    ratio = np.abs(np.log(others[None, :, [WIDE, TALL]] / size))
    return (apart < _NEAR * size.max(2, keepdims=True)).all(2) & (ratio < _ALIKE).all(2)


def _lines(some: np.ndarray, others: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return whether others are in a row with some, and in a column, two (n, m) bool."""
    x, y = (others[None, :, at] - some[:, None, at] for at in (X, Y))
    off = np.abs(y - x * some[:, None, [TOP, FOOT]].mean(2))
    return off < _IN_LINE * some[:, None, TALL], np.abs(x) < _IN_LINE * some[:, None, WIDE]


def _scaled(windows: np.ndarray, shape: tuple[int, ...], larger: tuple[int, ...]) -> np.ndarray:
    """Return windows (n, 6) of a picture of one shape, scaled to a larger copy."""
    y, x = (to / was for to, was in zip(larger, shape, strict=True))
    out = windows * [x, y, x, y, y / x, y / x]
    out[:, [X, Y]] += [(x - 1) / 2, (y - 1) / 2]  # centers of pixels
    return np.asarray(out)


def _merged(
    fine: np.ndarray, wall: np.ndarray, rough: np.ndarray, rough_wall: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Merge windows and walls of two picture sizes: a large window, or the small ones in it."""
    import cv2

    area = fine[:, WIDE] * fine[:, TALL]
    x, y = (np.abs(fine[None, :, at] - rough[:, None, at]) for at in (X, Y))
    inside = (x < 0.5 * rough[:, None, WIDE]) & (y < 0.5 * rough[:, None, TALL])
    part = (inside * area).sum(1) / np.maximum(rough[:, WIDE] * rough[:, TALL], 1e-6)
    whole = (part < _MADE_OF) & (inside.sum(1) < _SO_MANY)
    rough, inside = rough[whole], inside[whole]
    windows = np.concatenate([fine[~inside.any(0)], rough])
    rough_wall = resize(rough_wall.astype(np.float32), *wall.shape[::-1]) > 0.5
    covered = np.zeros(wall.shape, np.uint8)
    for window in windows:
        cv2.fillConvexPoly(covered, np.round(corners(window)).astype(np.int32), 1)
    count, pieces = cv2.connectedComponents((wall | rough_wall).astype(np.uint8))
    area, panes = (np.bincount(pieces.ravel(), n, count) for n in (None, covered.ravel()))
    glass = panes < _MADE_OF * area
    glass[0] = False
    middle = np.clip(np.round(windows[:, [Y, X]]).astype(int), 0, np.array(wall.shape) - 1)
    whole = glass[pieces]
    return windows[~whole[tuple(middle.T)]], whole


def _believed(windows: np.ndarray, probability: np.ndarray) -> np.ndarray:
    """Return which windows are likely enough, (n,) bool; single and large ones need more."""
    alone = _mates(windows, windows) < _MATES  # counts the window itself
    large = np.clip((windows[:, WIDE] - _LARGE[0]) / _LARGE[1], 0, 1)
    least = np.maximum(np.where(alone, _ALONE, _TOGETHER), _AS_LARGE * large)
    return np.asarray(mean_within(windows, probability) > least)


def _mates(weak: np.ndarray, strong: np.ndarray) -> np.ndarray:
    """Return the number of strong windows in line with each weak one, (n,)."""
    row, column = _lines(strong, weak)
    return ((row | column).T & _near(weak, strong)).sum(1)


def _slopes(windows: np.ndarray, weight: np.ndarray, slope: np.ndarray) -> np.ndarray:
    """Return slopes of lintels and sills, (n, 2), which change linearly with height nearby.

    ``slope`` (n,) is known at the windows' centers, with a ``weight`` (n, n) for each other one.
    """
    height = windows[:, Y]
    total = weight.sum(1)
    middle, steep = weight @ height / total, weight @ slope / total
    spread = weight @ height**2 - total * middle**2
    both = weight @ (height * slope) - total * middle * steep
    # Regularized towards the mean if all windows have about the same height.
    change = both / (spread + total * windows[:, TALL] ** 2)
    half = 0.5 * windows[:, TALL]
    at = np.stack([height - half, height + half], 1) - middle[:, None]
    return np.clip(steep[:, None] + change[:, None] * at, -_STEEPEST, _STEEPEST)


def _trapezia(probability: np.ndarray, wall: np.ndarray) -> np.ndarray:
    """Return trapezia (n, 6) of likely pixels; large ones go into ``wall``."""
    found = _split(probability, (0, 0), 0, wall)
    return np.array([window for window, _ in found]).reshape(-1, 6)


def _split(
    part: np.ndarray, place: tuple[int, int], level: int, wall: np.ndarray
) -> list[tuple[np.ndarray, int]]:
    """Return the windows of a part of the picture, (6,), and the pixels that each covers.

    A piece that is no trapezium becomes several windows if it splits into some at a higher level.
    """
    import cv2

    if level == len(_LEVELS):
        return []
    found = []
    mask = (part > _LEVELS[level]).astype(np.uint8)
    count, pieces, boxes, _ = cv2.connectedComponentsWithStats(mask, connectivity=4)
    for i in range(1, count):
        left, top, wide, tall, area = (int(n) for n in boxes[i])
        if min(wide, tall) < _THINNEST or area < max(_FEWEST, _LEAST * wall.size):
            continue
        box = slice(top, top + tall), slice(left, left + wide)
        piece, at = pieces[box] == i, (place[0] + left, place[1] + top)
        window, overlap = _fit(piece)
        large = area >= _WALL * wall.size
        parts = []
        if large or overlap < _LIKE_A_WINDOW:
            parts = _split(np.where(piece, part[box], 0), at, level + 1, wall)
        if len(parts) > 1 and sum(n for _, n in parts) > _MUCH * area:
            found += parts
        elif large:
            whole = slice(at[1], at[1] + tall), slice(at[0], at[0] + wide)
            wall[whole] |= piece & (level == 0)
        elif overlap >= _BARELY and (
            _TALLEST * window[WIDE] > window[TALL] > window[WIDE] / _WIDEST
        ):
            window[[X, Y]] += at
            found.append((window, area))
    return found


def _weak(probability: np.ndarray, strong: np.ndarray, wall: np.ndarray) -> np.ndarray:
    """Return trapezia (n, 6) of weak pixels, which other windows must confirm."""
    import cv2

    taken = cv2.dilate(wall.astype(np.uint8), np.ones((5, 5), np.uint8))
    for window in strong * [1, 1, _BORDER, _BORDER, 1, 1]:
        cv2.fillConvexPoly(taken, np.round(corners(window)).astype(np.int32), 1)
    rest = np.where(taken > 0, 0, probability)
    mask = (rest > _WEAK).astype(np.uint8)
    count, pieces, boxes, _ = cv2.connectedComponentsWithStats(mask, connectivity=4)
    found = []
    for i in range(1, count):
        left, top, wide, tall, area = boxes[i]
        if min(wide, tall) < _THINNEST or area < max(_FEWEST, _LEAST * wall.size):
            continue
        window, _ = _fit(pieces[top : top + tall, left : left + wide] == i)
        window[[X, Y]] += left, top
        found.append(window)
    return np.array(found).reshape(-1, 6)


def _fit(piece: np.ndarray) -> tuple[np.ndarray, float]:
    """Return the trapezium (6,) most similar to a piece, (h, w) bool, and their similarity."""
    import cv2

    columns = np.flatnonzero(piece.any(0))
    top = piece.argmax(0)[columns]
    foot = piece.shape[0] - piece[::-1].argmax(0)[columns] - 1
    # The sides are where half of a full column is covered.
    high = piece.sum(0)[columns]
    full = np.flatnonzero(high >= 0.5 * np.median(high))
    x = columns[full]
    first, last = float(x[0]), float(x[-1])
    inner = full[len(full) // 8 : len(full) - len(full) // 8] if len(full) >= 8 else full
    middle, slopes, at = 0.5 * (first + last), [], []
    for edge in (top, foot):
        across, level = columns[inner] - middle, edge[inner]
        even = across - across.sum() / len(across)
        slope = float(even @ level / (even @ even)) if len(inner) >= _SLOPED else 0.0
        slope = min(max(slope, -_STEEPEST), _STEEPEST)
        slopes.append(slope)
        at.append(float(np.median(level - slope * across)))
    if abs(slopes[0] - slopes[1]) * (last - first) > _NARROWING * (at[1] - at[0] + 1):
        slopes = [sum(slopes) / 2] * 2
    window = np.array([middle, sum(at) / 2, last - first + 1, at[1] - at[0] + 1, *slopes])
    shape = np.zeros(piece.shape, np.uint8)
    quad = corners(window - [0, 0, 1, 1, 0, 0])  # to the centers of pixels
    cv2.fillConvexPoly(shape, np.round(quad * 16).astype(np.int32), 1, shift=4)
    both, either = (shape & piece).sum(), (shape | piece).sum()
    return window, float(both / either)
