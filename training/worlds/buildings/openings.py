"""Walls with holes in them, and what fills the holes: panes, frames, bars, sills."""

from __future__ import annotations

import numpy as np

from training.worlds.buildings.shapes import (
    NO_BACK,
    Values,
    boxes,
    end_faces,
    facing_up,
    four,
    quads,
    upright,
)
from training.worlds.buildings.style import Style
from training.worlds.mesh import Mesh, Random, joined

_TURN = np.linspace(np.pi, 0, 9)
_HALF = np.linspace(-1, 1, 9)
# The upper edge of an opening, in half widths: across and up.
FLAT = np.array([[-1.0, 0], [1, 0]])
ROUND = np.stack([np.cos(_TURN), np.sin(_TURN)], 1)
SEGMENT = ROUND[::2] * (1, 0.3)
POINTED = np.stack([_HALF, np.sqrt(4 - (1 + np.abs(_HALF)) ** 2)], 1)


def pierced(
    width: float,
    low: float,
    high: float,
    edges: np.ndarray,
    bottoms: np.ndarray,
    tops: np.ndarray,
    depth: float,
    name: str,
    curve: np.ndarray = FLAT,
) -> Mesh:
    """Return a wall that faces -y with openings and their reveals.

    Parameters
    ----------
    edges : (C, 2), left and right of each column
    bottoms, tops : (F, C) and (F,), of each row
    curve : (K, 2), of the openings' upper edge in half widths
    """
    left, right = edges.T
    tops = np.asarray(tops)
    bottoms, top = np.broadcast_to(bottoms, (len(tops), len(left))), tops[:, None]
    foot, half = bottoms.min(1), (right - left) / 2
    rise = np.minimum(half, (top - bottoms) / max(curve[:, 1].max(), 1))
    x = np.broadcast_to(
        (left + half)[:, None] + half[:, None] * curve[:, 0], (*rise.shape, len(curve))
    )
    z = (top - rise * curve[:, 1].max())[..., None] + rise[..., None] * curve[:, 1]
    x0, x1, z0, z1 = x[..., :-1], x[..., 1:], z[..., :-1], z[..., 1:]
    head, foot_up = top[..., None], foot[:, None]
    spring = z[..., 0]
    end = np.where(bottoms > low, right, left)  # no sill on the ground
    parts = (
        upright(0, width, np.r_[low, tops], np.r_[foot, high]),
        upright(np.r_[0, right], np.r_[left, width], foot_up, top),
        upright(left, right, foot_up, bottoms),
        four((x0, 0, z0), (x1, 0, z1), (x1, 0, head), (x0, 0, head)),
        four((x0, 0, z0), (x0, depth, z0), (x1, depth, z1), (x1, 0, z1)),
        four((left, 0, bottoms), (left, depth, bottoms), (left, depth, spring), (left, 0, spring)),
        four(
            (right, depth, bottoms), (right, 0, bottoms), (right, 0, spring), (right, depth, spring)
        ),
        four((left, 0, bottoms), (end, 0, bottoms), (end, depth, bottoms), (left, depth, bottoms)),
    )
    return quads(np.concatenate(parts), name)


def pierced_through(
    size: tuple[float, float, float, float],
    edges: np.ndarray,
    bottom: float,
    top: float,
    name: str,
    curve: np.ndarray,
) -> Mesh:
    """Return a free-standing wall of (width, low, high, thick) with openings right through."""
    width, low, high, thick = size
    bottoms, tops = np.full((1, 1), bottom), np.array([top])
    y, x = thick / 2, width / 2
    front = pierced(width, low, high, edges, bottoms, tops, thick, name, curve)
    back = pierced(width, low, high, width - edges[::-1, ::-1], bottoms, tops, 0, name, curve)
    ends = end_faces(x, -y, y, low, high, name)
    top = facing_up(-x, x, -y, y, high, name)
    sides = [front.moved((-x, -y, 0)), back.moved((x, y, 0), np.pi), ends, top]
    return joined(sides)


def cells(width: float, columns: int, share: float) -> np.ndarray:
    """Return left and right of the openings of equal cells."""
    cell = width / columns
    middle = (np.arange(columns) + 0.5) * cell
    return np.stack([middle - share * cell / 2, middle + share * cell / 2], 1)


def glazing(
    random: Random,
    left: Values,
    right: Values,
    low: Values,
    high: Values,
    style: Style,
    fill: str = "glass",
) -> list[Mesh]:
    """Return panes with frames, glazing bars and a few blinds; all arrays broadcast."""
    left, right, low, high = (
        of.ravel() for of in np.broadcast_arrays(*map(np.atleast_1d, (left, right, low, high)))
    )
    y, f = style.recess, style.frame
    parts, bars = [quads(upright(left, right, low, high, y), fill)], []
    if style.detail > 0 and fill == "glass":
        for share in np.arange(1, style.bars[0] + 1) / (style.bars[0] + 1):
            x = left + share * (right - left)
            bars.append(upright(x - f / 2, x + f / 2, low, high, y - 0.03))
        blind = random.random(left.shape) < 0.15
        drop = random.uniform(0.2, 0.7, left.shape) * (high - low)
        parts.append(quads(upright(left, right, high - drop, high, y - 0.015)[blind], "trim"))
    if style.detail > 1:
        bars += [
            upright(left, left + f, low, high, y - 0.02),
            upright(right - f, right, low, high, y - 0.02),
            upright(left, right, high - f, high, y - 0.02),
            upright(left, right, low, low + f, y - 0.02),
        ]
        for share in np.arange(1, style.bars[1] + 1) / (style.bars[1] + 1):
            z = low + share * (high - low)
            bars.append(upright(left, right, z - f / 2, z + f / 2, y - 0.025))
    if bars:
        parts.append(quads(np.concatenate(bars), "trim"))
    return parts


def ledges(left: Values, right: Values, z: Values, out: float = 0.1) -> Mesh:
    """Return sills or hoods whose upper faces are at z."""
    return boxes((left - out, -out, z - 0.08), (right + out, 0, z), "trim", NO_BACK)
