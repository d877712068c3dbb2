"""Windows: detected by a network, lit one by one (models/MODEL_CARD.md).

A pane's light is absolute, not a ratio: it comes from lamps that the photo does not show. Some
rooms stay dark and no two lamps are alike. All of it depends only on the windows' positions, so
that the same photo always gets the same lights.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from sunwidget.analysis.images.working_copy import resize
from sunwidget.analysis.networks.bundled import STRIDE, once, run
from sunwidget.analysis.windows import shapes
from sunwidget.analysis.windows.shapes import FOOT, TALL, TOP, WIDE, X, Y

if TYPE_CHECKING:
    from sunwidget.photo.photo import Photo

BUNDLED = Path(__file__).parents[1] / "models" / "panes.onnx"
SIDE = 1024  # longer side of the network's input in pixels
BRIGHTEST = 3.0  # times the median lamp; a level of 1 in the texture
_DARK_ROOMS = 0.4
_SPREAD = 0.6  # standard deviation of ln brightness of lamps
_AT_TOP, _AT_FOOT = 1.2, 0.65  # of a window's light: lamps hang from ceilings
_AT_SIDES = 0.75
_CURTAINS, _BLINDS = 0.25, 0.2  # shares of windows
_BEHIND = 0.45  # of the light: through curtains and blinds
_FURNISHED, _THINGS = 12, 0.3  # width in pixels from which furniture is visible; its ln contrast
_FRAME = 0.04  # of a window's size
# Mean probability of glass: shutters and boards have none, and small windows show little.
_GLASS_FROM, _GLASS_WIDE = (0.05, 0.4), (8, 28)  # of windows; least width and range (pixels)
_GLASS_WALL = 0.45
_SEEN = 0.1, 0.35  # probabilities of a window: of something that hides it, and of the window
_BARRED = 10  # width in pixels from which bars are visible
_BAR = 0.35, 0.75  # share of the glass along a line: of a bar, and of glass without one
_SAME_ROOM = 1.3  # widths between the centers of windows of one room
_STOREY, _UNIT = 0.014, 0.012  # of the picture's longer side: rooms behind walls of glass


class View(NamedTuple):
    """Probabilities of windows and of their glass, both (h, w) float32 in [0, 1]."""

    window: np.ndarray
    pane: np.ndarray


@once
def look(photo: Photo) -> tuple[View, ...]:
    """Return the network's output for a photo at two sizes; cached per photo.

    The longer side of the first is ``SIDE``, but at most twice that of the photo. The second is
    half as large.

    Raises
    ------
    AnalysisError
        If onnxruntime is missing.
    """
    picture = photo.preview(SIDE).astype(np.float32) / 255
    scale = min(2.0, SIDE / max(picture.shape))
    return _look(picture, scale), _look(picture, 0.5 * scale)


def _look(picture: np.ndarray, scale: float) -> View:
    height, width = (max(1, round(scale * n)) for n in picture.shape[:2])
    columns, rows = (max(1, round(n / STRIDE)) * STRIDE for n in (width, height))
    found = run(BUNDLED, "windows", ["window", "pane"], picture, (columns, rows))
    return View(*(resize(image[0], width, height) for image in found))


def probability(views: Sequence[View]) -> np.ndarray:
    """Return the probability that pixels belong to windows, (h, w) float32 at the first size."""
    return shapes.likeliest([view.window for view in views])


def lamps(views: Sequence[View]) -> np.ndarray:
    """Return the texture ``lamps``, (h, w, 4) float32 in [0, 1]; (1, 1, 4) zeros without a window.

    Parameters
    ----------
    views : sequence of View
        Network output at decreasing sizes, 0 in the sky.

    Returns
    -------
    (h, w, 4)
        Light of the panes, where 1 is ``BRIGHTEST`` times a median lamp; their light on
        surroundings, in the same unit; its warmth, 0 for cold; and 1.
    """
    import cv2

    window = probability(views)
    pane = shapes.likeliest([view.pane for view in views])
    height, width = window.shape
    windows, wall = shapes.find(*(view.window for view in views))
    windows = windows[shapes.mean_within(windows, pane) > _least_glass(windows[:, WIDE])]
    windows, towers = shapes.stacks(windows, window.shape)
    light, warmth = (np.zeros(window.shape, np.float32) for _ in range(2))
    for room in rooms(windows):
        _light_room(windows[room], pane, light, warmth)
    # Objects that hide part of a window stay dark.
    light *= np.clip((window - _SEEN[0]) / (_SEEN[1] - _SEEN[0]), 0, 1)
    for whole in towers + shapes.walls(wall):
        if pane[whole.inside].mean() > _GLASS_WALL:
            _light_wall(whole, light, warmth)
    light = np.minimum(light, 1)
    if not light.any():
        return np.zeros((1, 1, 4), np.float32)
    # Light falls on reveals and sills, and more widely and weakly on ground and walls in front.
    reach = 0.02 * max(height, width)
    near = cv2.GaussianBlur(light, (0, 0), 0.15 * reach)
    coarse = max(1, round(0.25 * reach))
    small = resize(np.dstack([light, light * warmth]), -(-width // coarse), -(-height // coarse))
    far = cv2.GaussianBlur(small, (0, 0), reach / coarse)
    lower = np.array([[1, 0, 0], [0, 1, reach / coarse]], np.float32)
    far = cv2.resize(cv2.warpAffine(far, lower, far.shape[1::-1]), (width, height))
    spill = np.clip(0.5 * near + far[..., 0], 0, 1) * (light == 0)
    warm = np.where(light > 0, warmth, far[..., 1] / np.maximum(far[..., 0], 1e-6))
    return np.dstack([light, spill, warm, np.ones_like(light)]).astype(np.float32)


def _least_glass(wide: np.ndarray) -> np.ndarray:
    """Return the least probability of glass in windows of a width in pixels."""
    low, high = _GLASS_FROM
    return np.asarray(low + (high - low) * np.clip((wide - _GLASS_WIDE[0]) / _GLASS_WIDE[1], 0, 1))


def rooms(windows: np.ndarray) -> list[np.ndarray]:
    """Return the windows (n, 6) of each room, as indices of windows close together in a row."""
    x, y = (windows[None, :, at] - windows[:, None, at] for at in (X, Y))
    wide = 0.5 * (windows[None, :, WIDE] + windows[:, None, WIDE])
    off = np.abs(y - x * windows[:, None, [TOP, FOOT]].mean(2))
    one = (np.abs(x) < _SAME_ROOM * wide) & (off < 0.5 * windows[:, None, TALL])
    label = np.arange(len(windows))
    while True:
        lower = np.where(one | one.T, label[None], len(windows)).min(1, initial=len(windows))
        if np.array_equal(lower, label):
            return [np.flatnonzero(label == i) for i in np.unique(label)]
        label = lower


def _lamp(x: float, y: float, shape: tuple[int, ...]) -> tuple[float, float, np.random.Generator]:
    """Return a room's brightness (1 for a median lamp, 0 if dark), warmth, and random generator.

    The seed is the room's position to a thousandth of the picture, so that a stroke elsewhere
    changes nothing.
    """
    place = [max(0, round(1000 * at / n)) for at, n in zip((x, y), shape[::-1], strict=True)]
    chance = np.random.default_rng(place)
    lit = chance.random() >= _DARK_ROOMS
    level = np.exp(chance.normal(0, _SPREAD))
    return lit * min(level, BRIGHTEST / _AT_TOP), chance.random(), chance


def _light_room(
    windows: np.ndarray, pane: np.ndarray, light: np.ndarray, warmth: np.ndarray
) -> None:
    import cv2

    level, warm, chance = _lamp(windows[:, X].mean(), windows[:, Y].mean(), light.shape)
    if level == 0:
        return
    for window in windows:
        small = window.copy()
        small[[WIDE, TALL]] *= 1 - 2 * _FRAME
        quad = shapes.corners(small)
        left, top = np.maximum(np.floor(quad.min(0)).astype(int) - 1, 0)
        right, foot = np.minimum(np.ceil(quad.max(0)).astype(int) + 2, light.shape[::-1])
        if right <= left or foot <= top:
            continue
        box = slice(top, foot), slice(left, right)
        cover = shapes.filled(quad - (left, top), (foot - top, right - left))
        across = (np.arange(left, right) - small[X]) / small[WIDE]
        over = np.arange(top, foot)[:, None] - small[Y] - small[TOP] * (across * small[WIDE])
        down = np.clip(over / small[TALL] + 0.5, 0, 1)
        room = _AT_TOP + (_AT_FOOT - _AT_TOP) * down
        room = room * (1 + (_AT_SIDES - 1) * np.clip(2 * across, -1, 1) ** 2)
        if small[WIDE] > _FURNISHED:
            things = chance.normal(0, _THINGS, (4, 3))
            room = room * np.exp(cv2.resize(things, cover.shape[::-1], None, 0, 0, cv2.INTER_CUBIC))
        draw, much = chance.random(2)
        if draw < _CURTAINS:
            room = np.where(np.abs(across) < 0.45 * much, room, _BEHIND)
        elif draw < _CURTAINS + _BLINDS:
            room = np.where(down > 0.2 + 0.6 * much, room, _BEHIND)
        cover *= _between_bars(pane[box], cover, small[TALL] * down)
        new = level / BRIGHTEST * cover * room
        warmth[box] = np.where(new > light[box], warm, warmth[box])
        light[box] = np.maximum(light[box], new)


def _between_bars(pane: np.ndarray, cover: np.ndarray, down: np.ndarray) -> np.ndarray:
    """Return the part of a window without straight bars and frames, (h, w) in [0, 1].

    ``pane`` is the probability of glass, ``cover`` the window, ``down`` the depth below its lintel.
    """
    columns = np.broadcast_to(np.arange(cover.shape[1]), cover.shape)
    left = np.ones(cover.shape)
    for place in (columns, np.round(down).astype(int)):
        count = np.bincount(place.ravel(), cover.ravel())
        if (count > 0).sum() < _BARRED:
            continue
        share = np.bincount(place.ravel(), (cover * pane).ravel()) / np.maximum(count, 1e-6)
        most = np.quantile(share[count > 0], 0.8)
        if most > 0:
            left *= np.clip((share / most - _BAR[0]) / (_BAR[1] - _BAR[0]), 0, 1)[place]
    return left


def _light_wall(wall: shapes.Wall, light: np.ndarray, warmth: np.ndarray) -> None:
    """Light the rooms behind a wall of glass: storeys differ in the share of lit rooms."""
    longer = max(light.shape)
    tall = (wall.foot - wall.top).max()
    storeys, units = (
        max(1, round(n / (size * longer))) for n, size in ((tall, _STOREY), (len(wall.top), _UNIT))
    )
    rows = np.arange(light.shape[0], dtype=np.float32)[:, None]
    columns = slice(wall.left, wall.left + len(wall.top))
    down = storeys * (rows - wall.top) / np.maximum(wall.foot - wall.top, 1)
    across = np.linspace(0, units, len(wall.top), endpoint=False)[None]
    _, _, chance = _lamp(wall.left, float(wall.top.mean()), light.shape)
    busy = chance.beta(0.8, 1.2, storeys)
    base = np.exp(chance.normal(-0.3, 0.3, storeys))
    lit, level = np.zeros((storeys, units)), np.ones((storeys, units))
    for storey in range(storeys):
        unit = 0
        while unit < units:
            run = 1 + int(chance.integers(0, 4))
            lit[storey, unit : unit + run] = chance.random() < busy[storey]
            level[storey, unit : unit + run] = base[storey] * np.exp(chance.normal(0, 0.25))
            unit += run
    warm = chance.random(storeys)
    at = np.clip(down.astype(int), 0, storeys - 1), np.clip(across.astype(int), 0, units - 1)
    # Slabs between the storeys, and posts where there is space.
    pitch = (wall.foot - wall.top) / storeys
    slab = np.clip((down % 1) * pitch - 0.25 * pitch, 0, 1)
    post = np.clip((across % 1) * len(wall.top) / units - 0.5, 0, 1)
    inside = wall.inside[:, columns] & (down >= 0) & (down < storeys)
    new = inside * lit[at] * np.minimum(level[at] / BRIGHTEST, 1) * slab * post
    warmth[:, columns] = np.where(new > 0, warm[at[0]], warmth[:, columns])
    light[:, columns] = np.maximum(light[:, columns], new)
