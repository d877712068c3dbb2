"""Horizon: the earth's edge behind everything that stands on it (thesis 3.1.2).

``METHODS`` maps a name to a function ``(sky, encoded, water) -> Horizon`` in the pixels of the sky
map; ``encoded`` is the photo at its size, ``water`` the network's probability of water.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from sunwidget.analysis.horizon.straight_edge import StraightEdge, straight_edges
from sunwidget.formats.color import LUMINANCE, strips
from sunwidget.geometry.camera import Camera, Point

TOLERANCE = 0.004  # of the height: deviation of a sea horizon from a line
MAXIMUM_ROLL = 20.0
_BELOW = 0.05  # share of the columns that may contradict a sea's horizon
_WET = 0.6  # probability of water below the sky from which the sky ends at water
_SURELY_WET = 0.8  # probability of water from which a guess is not below it
_WIDE = 0.01  # of the picture: less of it is a puddle or a mistake
_STRAY = 0.02  # share of it that may be above
_SOFT = (0.004, 0.012)  # of the height below the horizon: what is above it fades out there
LEVEL_ROW = 0.52  # of the height: assumed horizon of a level camera


@dataclass(frozen=True)
class Horizon:
    """The horizon as a line.

    Parameters
    ----------
    row : float
        Row at the picture's center column in pixels; may lie outside the picture.
    roll : float
        Degrees by which the line falls to the right.
    confidence : float
        0 (a guess without a visible horizon) … 1 (a line across the whole picture, or a hint).
    source : str
        Name of the method, "hint", or "assumed".
    """

    row: float
    roll: float = 0.0
    confidence: float = 0.0
    source: str = "assumed"

    def scaled(self, zoom_x: float, zoom_y: float) -> Horizon:
        """Return the same horizon for a picture ``zoom`` times as large."""
        slope = math.tan(math.radians(self.roll)) * zoom_y / zoom_x
        roll = math.degrees(math.atan(slope))
        return Horizon(self.row * zoom_y, roll, self.confidence, self.source)


def from_hint(hint: float | tuple[Point, Point], width: int) -> Horizon:
    """Return the horizon of a hint: the row at the center, or two points, in pixels."""
    if isinstance(hint, tuple):
        (x0, y0), (x1, y1) = hint
        slope = (y1 - y0) / (x1 - x0)
        row = y0 + slope * (width / 2 - x0)
        return Horizon(row, math.degrees(math.atan(slope)), 1.0, "hint")
    return Horizon(float(hint), 0.0, 1.0, "hint")


def below_sun(found: Horizon, x: float, y: float, radius: float, width: int) -> Horizon:
    """Lower a horizon that is above a visible sun at (x, y); all in pixels.

    A setting sun may be below it by its ``radius``.
    """
    beneath = y - radius - found.row - math.tan(math.radians(found.roll)) * (x - width / 2)
    if beneath <= 0:
        return found
    return Horizon(found.row + beneath + radius, found.roll, min(found.confidence, 0.2), "assumed")


def expected(found: Horizon, sky: np.ndarray, row: float, water: np.ndarray) -> Horizon:
    """Use the land network's guess, but not above the lowest sky; all in pixels.

    Nor below ``water``, the probability (h, w) of some: a level surface that is seen from above.
    """
    _, border = skyline(sky)
    if not border.size and sky.mean() > 0.5:
        return found  # only sky: the horizon is below the picture
    wet = np.nonzero((water > _SURELY_WET) & (sky < 0.5))[0]
    if wet.size > _WIDE * water.size:
        row = min(row, float(np.quantile(wet, _STRAY)) - _SOFT[1] * len(sky))
    if border.size:
        row = max(row, float(np.quantile(border, 0.98)))
    return replace(found, row=row)


def row_argmax(
    sky: np.ndarray, encoded: np.ndarray | None = None, water: np.ndarray | None = None
) -> Horizon:
    """Return the row with most vertical edges of the sky mask (thesis equations 3.3 and 3.4).

    It misses a horizon with roll: a single degree spreads it over many rows.
    """
    edges = np.abs(np.diff((sky > 0.5).astype(np.int8), axis=0)).sum(axis=1)
    if not edges.size or edges.max() == 0:
        return _unseen(sky)
    row = int(edges.argmax())
    return Horizon(row + 1.0, 0.0, float(edges[row] / sky.shape[1]), "row_argmax")


def robust_line(
    sky: np.ndarray, encoded: np.ndarray | None = None, water: np.ndarray | None = None
) -> Horizon:
    """Fit a line with roll to the lower edge of the sky.

    Objects on the earth can only push the skyline up, so a skyline below the line counts against
    it and one above does not. If enough of the skyline agrees with a line, it is the horizon;
    otherwise the horizon is assumed level, at the skyline's lowest part or lower.
    """
    height, width = sky.shape
    columns, border = skyline(sky)
    if columns.size < 2:
        return _unseen(sky)
    row, slope, share = _best_line(columns - width / 2, border, height, width)
    if share >= 0.3:
        roll = math.degrees(math.atan(slope))
        return Horizon(row, roll, _confidence(share, roll), "robust_line")
    lowest = float(np.quantile(border, 0.98))
    return Horizon(max(lowest, LEVEL_ROW * height), 0.0, min(0.2, share), "assumed")


def water_line(sky: np.ndarray, encoded: np.ndarray, water: np.ndarray | None = None) -> Horizon:
    """Return the far end of water: where sky meets it, or by the picture's own edges."""
    line = _far_end(sky, encoded)
    return line if water is None else behind_water(line, sky, water)


def _far_end(sky: np.ndarray, encoded: np.ndarray) -> Horizon:
    """Fit the line as ``robust_line`` does, then search for the far end of water.

    A far shore lifts the skyline off the water: a straight edge just below the skyline wins, and
    so does a strong one if there is no line. Calm water that mirrors the sky is misclassified as
    sky: where land has "sky" below it, the straight edge at the land's foot wins, and so does an
    edge below which the sky continues darker and upside down.
    """
    line = robust_line(sky)
    height = sky.shape[0]
    edges = [e for e in straight_edges(encoded) if abs(e.roll) <= 3 and e.row < 0.85]
    if not edges:
        return line
    row = line.row / height
    guessed = line.source == "assumed"
    if not guessed:
        inside = [e for e in edges if 0.05 < e.row < row - 0.02 and e.strength > 0.45]
        foot = _mirrored_foot(sky)
        for edge in inside:
            at_foot = foot is not None and edge.row > foot - 0.02
            if at_foot or _mirrors(sky, encoded @ LUMINANCE, edge, line):
                return _from_edge(edge, sky, 0.7)
    own = max((e.strength for e in edges if abs(e.row - row) < 0.01), default=0.0)
    under = [e for e in edges if e.strength > 0.72 and e.row > row - 0.01]
    if guessed and under:
        return _from_edge(under[0], sky, 0.45)
    near = [
        e
        for e in under
        if 0.005 < e.row - row < 0.03 and e.strength > own + 0.03 and abs(e.roll - line.roll) < 1
    ]
    return _from_edge(near[0], sky, max(line.confidence, 0.7)) if near else line


def behind_water(found: Horizon, sky: np.ndarray, water: np.ndarray) -> Horizon:
    """Return the line along which sky meets water, or ``found`` if there is none.

    Parameters
    ----------
    found : Horizon
        Horizon so far, in the pixels of the maps.
    sky, water : (h, w) float32
        Sky matte, and the probability of water.
    """
    height, width = sky.shape
    columns, border = skyline(sky)
    if columns.size < 2:
        return found
    depths = np.linspace(0.01, 0.05, 5)[:, None] * height
    rows = np.minimum(border + depths, height - 1).astype(int)
    wet = water[rows, columns.astype(int)].min(axis=0) > _WET
    if wet.sum() < 0.25 * width:
        return found
    columns, border = columns[wet] - width / 2, border[wet]
    row, slope, share = _best_line(columns, border, height, width)
    # Sky below a sea's horizon contradicts the line: a low sun's glare lifts part of a skyline.
    below = border - row - slope * columns > _tolerance(height)
    if share * width < 0.6 * columns.size or below.mean() > _BELOW:
        return found
    roll = math.degrees(math.atan(slope))
    return Horizon(row, roll, max(0.8, found.confidence), "water_line")


METHODS: dict[str, Callable[[np.ndarray, np.ndarray, np.ndarray], Horizon]] = {
    "row_argmax": row_argmax,
    "robust_line": robust_line,
    "water_line": water_line,
}


def _confidence(share: float, roll: float) -> float:
    """Return the confidence of a line with which ``share`` of the columns agree.

    Tuned by hand on 45 lines in photos and renders of known horizon (right: within 2 % of the
    height). From a third of the columns on, six of seven level lines are right; lines with roll
    that do not fill the width are roofs, hills and clouds.
    """
    share = min(1.0, share + 0.01 * abs(roll))  # undoes the score's penalty
    tilt = math.exp(-((roll / 3.5) ** 2) * 3 * (1 - share))
    return min(1.0, (0.35 + 0.65 * share) * tilt)


def _from_edge(edge: StraightEdge, sky: np.ndarray, confidence: float) -> Horizon:
    return Horizon(edge.row * sky.shape[0], edge.roll, float(confidence), "water_line")


def _mirrors(sky: np.ndarray, luminance: np.ndarray, edge: StraightEdge, line: Horizon) -> bool:
    """Return whether "sky" below a level edge is the darker mirror image of the sky above it."""
    height = sky.shape[0]
    row, reach = round(edge.row * height), round(0.05 * height)
    depth = min(reach, int(line.row) - row - 2)
    if abs(edge.roll) > 1 or depth < 7 or row < reach:
        return False
    columns = sky[row - reach : row].mean(axis=0) > 0.9
    if columns.mean() < 0.3:
        return False
    steps = np.arange(3, depth)
    above = np.median(luminance[row - steps][:, columns], axis=1)
    below = np.median(luminance[row + steps][:, columns], axis=1)
    if min(np.ptp(above), np.ptp(below)) < 0.01 or above[0] - below[0] < 0.03:
        return False
    return float(np.corrcoef(above, below)[0, 1]) > 0.8


def _mirrored_foot(sky: np.ndarray) -> float | None:
    """Return the lower end of land with "sky" below it, in fractions of the height, or None.

    The sky below must be as wide as the land, or it is seen through an arch or branches; and the
    land's lower end must be level, as shores are.
    """
    height, width = sky.shape
    open_sky = sky > 0.5
    first = np.argmax(~open_sky, axis=0)  # row of the first land of each column
    rows = np.arange(height)[:, None]
    under = open_sky & (rows > first) & open_sky[0]
    below = under.any(axis=0)
    foot = np.argmax(under, axis=0)  # first sky below that land
    thick = (foot - first > 0.02 * height) & (under.sum(axis=0) > 0.03 * height) & below
    if np.count_nonzero(thick) < 0.1 * width:
        return None
    feet = foot[thick]
    low = float(np.quantile(feet, 0.4))
    if low - float(np.quantile(feet, 0.1)) > 0.06 * height:
        return None
    return low / height


def skyline(sky: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return columns (pixel centers) and the row below the lowest sky pixel of each.

    Patches of sky smaller than 0.5 % of the picture do not count. Columns without sky, and columns
    whose sky reaches the lower frame, are omitted.
    """
    import cv2

    height, width = sky.shape
    pieces = (sky > 0.5).astype(np.uint8)
    count, labels, stats, _ = cv2.connectedComponentsWithStats(pieces, connectivity=4)
    large = np.flatnonzero(stats[:, cv2.CC_STAT_AREA] >= 0.005 * pieces.size)
    mask = np.isin(labels, large[large > 0])
    seen = mask.any(axis=0)
    border = height - np.argmax(mask[::-1], axis=0).astype(np.float64)
    seen &= border < height
    columns = np.flatnonzero(seen)
    return columns + 0.5, border[columns]


def _unseen(sky: np.ndarray) -> Horizon:
    """Guess without a skyline: below the picture if it is full of sky, level otherwise."""
    height = sky.shape[0]
    full = sky.size > 0 and float(np.mean(sky > 0.5)) > 0.95
    return Horizon(height * (1.1 if full else LEVEL_ROW), 0.0, 0.0, "assumed")


def _tolerance(height: int) -> float:
    """Return how far a pixel of the skyline may be off a sea's horizon, in pixels."""
    return max(1.0, TOLERANCE * height)


def _best_line(x: np.ndarray, y: np.ndarray, height: int, width: int) -> tuple[float, float, float]:
    """Return row at x = 0, slope, and the share of all columns that agree with the line."""
    tolerance = _tolerance(height)
    anchors = np.unique(np.linspace(0, x.size - 1, 72).round().astype(int))
    first, second = np.triu_indices(anchors.size, k=1)
    run = x[anchors[second]] - x[anchors[first]]
    wide = run >= 0.2 * width
    if not wide.any():
        return float(np.median(y)), 0.0, 0.0
    first, second, run = anchors[first[wide]], anchors[second[wide]], run[wide]
    slopes = (y[second] - y[first]) / run
    rows = y[first] - slopes * x[first]
    # Also try a level line through each anchor, since two noisy anchors rarely give one.
    slopes = np.concatenate([slopes, np.zeros(anchors.size)])
    rows = np.concatenate([rows, y[anchors]])
    level = np.abs(slopes) <= math.tan(math.radians(MAXIMUM_ROLL))
    slopes, rows = slopes[level], rows[level]
    score, _ = _score(x, y, rows, slopes, tolerance, width)
    best = int(score.argmax())
    row, slope = float(rows[best]), float(slopes[best])
    for _ in range(3):  # least squares on the columns that agree
        near = np.abs(y - row - slope * x) <= tolerance
        if np.count_nonzero(near) < 2 or np.ptp(x[near]) < 0.2 * width:
            break
        slope, row = (float(v) for v in np.polyfit(x[near], y[near], 1))
    score, share = _score(x, y, np.array([row]), np.array([slope]), tolerance, width)
    return row, slope, float(max(0.0, min(share[0], score[0])))


def _score(
    x: np.ndarray,
    y: np.ndarray,
    rows: np.ndarray,
    slopes: np.ndarray,
    tolerance: float,
    width: int,
) -> tuple[np.ndarray, np.ndarray]:
    residual = y[None] - rows[:, None] - slopes[:, None] * x[None]
    near = (np.abs(residual) <= tolerance).sum(axis=1) / width
    below = (residual > 2 * tolerance).sum(axis=1) / width
    tilt = np.degrees(np.arctan(np.abs(slopes)))
    return near - 1.5 * below - 0.01 * tilt, near


def above(camera: Camera, width: int, height: int, rows: slice = slice(None)) -> np.ndarray:
    """Return 1 above the horizon and 0 below, (height, width) float32, with a soft edge.

    The edge is 0.8 % of the height below the line, so that a slightly high line does not cut the
    sky. ``rows`` selects only some rows.
    """
    line, at = _line_and_rows(camera, width, height)
    whole, none = _SOFT
    return np.clip((line + none - at[rows]) / (none - whole), 0, 1).astype(np.float32)


def cut_below(matte: np.ndarray, camera: Camera) -> None:
    """Multiply a map (H, W) in place by ``above`` of its size."""
    height, width = matte.shape
    line, _ = _line_and_rows(camera, width, height)
    # Outside these rows the factor is 1 or 0 in all columns.
    first = int(np.clip((line.min() + _SOFT[0]) * height - 1, 0, height))
    last = int(np.clip((line.max() + _SOFT[1]) * height + 1, 0, height))
    for strip in strips((last - first, width)):
        rows = slice(first + strip.start, first + strip.stop)
        matte[rows] *= above(camera, width, height, rows)
    matte[last:] = 0


def below(camera: Camera, width: int, height: int) -> np.ndarray:
    """Return which pixels of a picture of this size are below the horizon, (h, w) bool."""
    line, rows = _line_and_rows(camera, width, height)
    return np.asarray(rows > line)


def _line_and_rows(camera: Camera, width: int, height: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the horizon in each column (width,) and the rows (height, 1), as shares of height."""
    (x0, y0), (x1, y1) = camera.pixel(-10.0, 0.0), camera.pixel(10.0, 0.0)
    slope = (y1 - y0) / (x1 - x0)
    columns = (np.arange(width) + 0.5) * camera.width / width
    line = (y0 + slope * (columns - x0)) / camera.height
    return line, ((np.arange(height) + 0.5) / height)[:, None]
