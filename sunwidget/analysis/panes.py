"""Panes of windows: found by a network, lit one by one (models/MODEL_CARD.md).

A pane's light is its own and no ratio: lamps stand behind it that the photo does not show. Some
rooms stay dark and no two lamps are alike; which and how follows from where a window is, so that
the same photo always has the same evening.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np

from sunwidget.analysis.onnx_file import bundled_session
from sunwidget.analysis.working import resize

if TYPE_CHECKING:
    from sunwidget.photo import Photo

BUNDLED = Path(__file__).parent / "models" / "panes.onnx"
SIDE = 1024  # pixels of the longer side of the copy that the network sees
_STRIDE = 32
_PANE = 0.5  # probability from which a pixel is glass
_BAR = 0.1  # probability of a bar between panes
_LEAST = 3e-5  # of the picture: what is smaller is no pane
_DARK_ROOMS = 0.3
_SPREAD = 0.5  # ln: of lamps' brightness
_BRIGHTEST = 3.0  # times the median lamp; a level of 1 in the texture
_AT_TOP, _AT_FOOT = 1.15, 0.7  # of a window's light
_LIKE_A_PANE = 0.8  # overlap with an upright trapezium over what both cover
_THINNEST = 3  # pixels
_STEEPEST = 0.5  # slope of sills and lintels
_WIDEST = 3.0  # times its height: boards and shadows of eaves are wider
_WALL, _ROOM = 0.01, 0.014  # of the picture, of its longer side
_SOFT = 0.7  # pixels: edges of panes
_FRAME = 0.006  # of the longer side: panes nearer than that are one window


def probability(photo: Photo) -> np.ndarray:
    """Return the probability that pixels are glass of windows, (h, w) float32 in [0, 1].

    Of a copy whose longer side is ``SIDE``; of a small photo, twice its size at most. Once a photo:
    strokes do not ask again.

    Raises
    ------
    AnalysisError
        When onnxruntime is missing.
    """
    if photo not in _seen:
        _seen[photo] = _look(photo)
    return _seen[photo]


def _look(photo: Photo) -> np.ndarray:
    picture = photo.preview(SIDE).astype(np.float32) / 255
    scale = min(2.0, SIDE / max(picture.shape))
    height, width = (round(scale * n) for n in picture.shape[:2])
    columns, rows = (max(1, round(n / _STRIDE)) * _STRIDE for n in (width, height))
    image = resize(picture, columns, rows).transpose(2, 0, 1)[None]
    (pane,) = bundled_session(BUNDLED, "windows").run(
        ["pane"], {"image": np.ascontiguousarray(image)}
    )
    return resize(pane[0, 0], width, height)


def lamps(pane: np.ndarray) -> np.ndarray:
    """Return the texture ``lamps``, (h, w, 4) float32 in [0, 1]; (1, 1, 4) zeros without a pane.

    Parameters
    ----------
    pane : (h, w) float32
        Probability of glass, none in the sky.

    Returns
    -------
    (h, w, 4)
        Light of the panes, ``_BRIGHTEST`` times that of a median lamp at 1; light that falls from
        them on what is near, alike; how warm it is, cold at 0; and 1.
    """
    import cv2

    height, width = pane.shape
    found = _straight((pane > _PANE).astype(np.uint8))
    windows = _windows(found)
    # Bars that the network sees stay dark.
    seen = found * np.clip((pane - _BAR) / (_PANE - _BAR), 0, 1)
    share = cv2.GaussianBlur(seen.astype(np.float32), (0, 0), _SOFT)
    count = int(windows.max()) + 1
    rows, columns = np.nonzero(windows)
    label = windows[rows, columns]
    area = np.maximum(np.bincount(label, minlength=count), 1)
    middle = [np.bincount(label, at, count) / area for at in (columns, rows)]
    glass = np.bincount(windows.ravel(), found.ravel(), count)
    level, warmth = np.zeros(count, np.float32), np.zeros(count, np.float32)
    for i in np.flatnonzero(glass >= max(4.0, _LEAST * height * width)):
        # Where it is to a thousandth of the picture, so that a stroke elsewhere changes nothing.
        place = [round(1000 * m[i] / n) for m, n in zip(middle, (width, height), strict=True)]
        random = np.random.default_rng(place)
        lit = i > 0 and random.random() >= _DARK_ROOMS
        level[i] = lit * min(np.exp(random.normal(0, _SPREAD)) / _BRIGHTEST, 1 / _AT_TOP)
        warmth[i] = random.random()
    if not level.any():
        return np.zeros((1, 1, 4), np.float32)
    top, foot = np.full(count, height, np.float32), np.zeros(count, np.float32)
    np.minimum.at(top, label, rows)
    np.maximum.at(foot, label, rows)
    around = cv2.dilate(windows.astype(np.float32), np.ones((5, 5))).astype(int)
    down = np.arange(height, dtype=np.float32)[:, None] - top[around]
    down /= np.maximum(foot - top, 1)[around]
    # Lamps hang from ceilings.
    light = share * level[around] * (_AT_TOP + (_AT_FOOT - _AT_TOP) * np.clip(down, 0, 1))
    reach = 0.02 * max(height, width)
    wide = cv2.GaussianBlur(light, (0, 0), reach)
    # Light falls on reveals and sills, and wider and weaker on the ground and walls before them.
    near = cv2.GaussianBlur(light, (0, 0), 0.15 * reach)
    lower = np.array([[1, 0, 0], [0, 1, reach]], np.float32)
    far = cv2.warpAffine(wide, lower, (width, height))
    spill = np.clip(0.5 * near + far, 0, 1) * (1 - share)
    warm = cv2.GaussianBlur(light * warmth[around], (0, 0), reach) / np.maximum(wide, 1e-6)
    warm = np.where(share > 0.05, warmth[around], warm)
    return np.dstack([light, spill, warm, np.ones_like(light)]).astype(np.float32)


def _windows(found: np.ndarray) -> np.ndarray:
    """Return which window each pixel belongs to, (h, w) int32, 0 none; cuts bars into ``found``.

    Panes close together are one window; a pane larger than windows are is a wall of glass, and has
    rooms behind it.
    """
    import cv2

    longer = max(found.shape)
    _, pieces, shape, _ = cv2.connectedComponentsWithStats(found)
    walls = np.flatnonzero(shape[1:, cv2.CC_STAT_AREA] > _WALL * found.size) + 1
    wall = np.isin(pieces, walls)
    side = 2 * round(0.5 * _FRAME * longer) + 1
    kernel = np.ones((side, side), np.uint8)
    joined = cv2.morphologyEx(np.where(wall, 0, found).astype(np.uint8), cv2.MORPH_CLOSE, kernel)
    count, windows = cv2.connectedComponents(joined)
    room = max(4, round(_ROOM * longer))
    rows, columns = np.nonzero(wall)
    _, cell = np.unique(rows // room * longer + columns // room, return_inverse=True)
    windows[rows, columns] = count + cell
    found[wall & ((np.arange(found.shape[0]) % room == 0)[:, None])] = 0
    found[wall & (np.arange(found.shape[1]) % room == 0)] = 0
    return np.asarray(windows, np.int32)


def _straight(found: np.ndarray) -> np.ndarray:
    """Return panes with straight edges, (h, w) uint8: what has no such shape is no pane.

    Sides are upright, sills and lintels may run towards a vanishing point.
    """
    import cv2

    out = np.zeros_like(found)
    count, pieces, shape, _ = cv2.connectedComponentsWithStats(found, connectivity=4)
    for i in range(1, count):
        left, top, wide, tall, _ = shape[i]
        if wide > _WIDEST * tall or min(wide, tall) < _THINNEST:
            continue
        piece = pieces[top : top + tall, left : left + wide] == i
        quad = _quad(piece)
        pane = np.zeros(piece.shape, np.uint8)
        cv2.fillConvexPoly(pane, np.round(quad * 16).astype(np.int32), 1, shift=4)
        both, either = (pane & piece).sum(), (pane | piece).sum()
        part = out[top : top + tall, left : left + wide]
        if both >= _LIKE_A_PANE * either:
            part |= pane
    return out


def _quad(piece: np.ndarray) -> np.ndarray:
    """Return the corners (4, 2) of the upright trapezium that is most like a piece, (h, w) bool."""
    columns = np.flatnonzero(piece.any(0))
    top = piece.argmax(0)[columns]
    foot = piece.shape[0] - piece[::-1].argmax(0)[columns] - 1
    # Sides where half of a full column is there.
    high = foot - top + 1
    full = np.flatnonzero(high >= 0.5 * np.median(high))
    x = columns[full]
    ends = np.array([x[0], x[-1]])
    inner = full[len(full) // 8 : len(full) - len(full) // 8] if len(full) >= 8 else full
    lines = []
    for edge in (top, foot):
        slope = np.polyfit(columns[inner], edge[inner], 1)[0] if len(inner) >= 4 else 0.0
        slope = min(max(slope, -_STEEPEST), _STEEPEST)
        offset = np.median(edge[inner] - slope * columns[inner])
        lines.append(slope * ends + offset)
    (a, b), (c, d) = lines
    return np.array([(ends[0], a), (ends[1], b), (ends[1], d), (ends[0], c)], np.float64)


_seen: WeakKeyDictionary[Photo, np.ndarray] = WeakKeyDictionary()
