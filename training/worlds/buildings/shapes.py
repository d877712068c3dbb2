"""Simple shapes: rectangles, boxes, prisms, blunt pyramids, round bodies and rings."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from training.worlds.mesh import Mesh, joined

Values = float | np.ndarray | Sequence  # that broadcast

ALL, NO_BACK, BAR = (0, 1, 2, 3, 4, 5), (0, 1, 2, 4, 5), (2, 3, 4, 5)  # sides of boxes
QUARTER = np.pi / 2

_CUBE = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
_SIDES = np.array(
    [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
)


def quads(corners: np.ndarray, name: str) -> Mesh:
    """Return quads (N, 4, 3) as a mesh; empty ones are dropped, pinched ones are triangles."""
    corners = np.array(corners, float).reshape(-1, 4, 3)
    a, b = (corners[:, 2:] - corners[:, :2]).transpose(1, 0, 2)
    crossed = a[:, [1, 2, 0]] * b[:, [2, 0, 1]] - a[:, [2, 0, 1]] * b[:, [1, 2, 0]]
    corners = corners[(crossed**2).sum(1) > 1e-10]
    faces = np.arange(4 * len(corners)).reshape(-1, 4)
    short = (np.abs(corners - corners[:, [1, 2, 3, 0]]) < 1e-7).all(2)
    for side in np.flatnonzero(short.any(0)):
        at = short[:, side]
        corners[at] = np.roll(corners[at], 2 - side, 1)
        faces[at, 3] = faces[at, 2]
    return Mesh(corners.reshape(-1, 3), faces, np.zeros(len(faces), int), (name,))


def _stacked(parts: list) -> np.ndarray:
    """Return coordinates that broadcast as the last axis of one array (np.stack is slow here)."""
    arrays = [np.asarray(of, float) for of in parts]
    stacked = np.empty((*np.broadcast(*arrays).shape, len(arrays)))
    for at, of in enumerate(arrays):
        stacked[..., at] = of
    return stacked


def four(*points: tuple) -> np.ndarray:
    """Return quads of four points (x, y, z) whose coordinates broadcast."""
    return _stacked([of for point in points for of in point]).reshape(-1, 4, 3)


def upright(x0: Values, x1: Values, z0: Values, z1: Values, y: Values = 0.0) -> np.ndarray:
    """Return rectangles that face -y."""
    return four((x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1))


def facing_up(x0: Values, x1: Values, y0: Values, y1: Values, z: float, name: str) -> Mesh:
    """Return rectangles that face up."""
    return quads(four((x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)), name)


def end_faces(x: float, y0: float, y1: float, z0: float, z1: float, name: str) -> Mesh:
    """Return two rectangles that face +x at x and -x at -x."""
    side, near, far = (x, -x), (y0, y1), (y1, y0)
    return quads(four((side, near, z0), (side, far, z0), (side, far, z1), (side, near, z1)), name)


def boxes(low: tuple, high: tuple, name: str, sides: tuple[int, ...] = ALL) -> Mesh:
    """Return boxes between corners whose coordinates broadcast."""
    flat = _stacked([*low, *high]).reshape(-1, 1, 1, 6)
    low, high = flat[..., :3], flat[..., 3:]
    return quads(low + _CUBE[_SIDES[list(sides)]] * (high - low), name)


def prism(profile: Sequence, x0: float, x1: float, name: str) -> Mesh:
    """Return a convex profile of (y, z), anticlockwise seen from +x, drawn along x."""
    y, z = np.asarray(profile, float).T
    after = np.roll(np.arange(len(y)), -1)
    i, j = np.arange(1, len(y) - 1), np.arange(2, len(y))
    sides = four((x0, y, z), (x0, y[after], z[after]), (x1, y[after], z[after]), (x1, y, z))
    right = four((x1, y[0], z[0]), (x1, y[i], z[i]), (x1, y[j], z[j]), (x1, y[j], z[j]))
    left = four((x0, y[0], z[0]), (x0, y[j], z[j]), (x0, y[i], z[i]), (x0, y[i], z[i]))
    return quads(np.concatenate([sides, right, left]), name)


def frustum(base: tuple, top: tuple, height: float, name: str) -> Mesh:
    """Return a block of (width, depth) at the foot and at the top."""
    turn = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / 2
    x0, y0 = (turn * base).T
    x1, y1 = (turn * top).T
    k = np.array([1, 2, 3, 0])
    sides = four((x0, y0, 0), (x0[k], y0[k], 0), (x1[k], y1[k], height), (x1, y1, height))
    caps = np.stack([np.stack([x1, y1, 0 * x1 + height], 1), np.stack([x0, y0, 0 * x0], 1)[::-1]])
    return quads(np.concatenate([sides, caps]), name)


def lathe(radii: Sequence, heights: Sequence, name: str, sides: int = 20) -> Mesh:
    """Return a smooth round body, open below, closed on top if the last radius is 0."""
    turn = np.arange(sides) * 2 * np.pi / sides
    ring = np.stack([np.cos(turn), np.sin(turn)], 1)
    levels = [np.c_[ring * r, np.full(sides, z)] for r, z in zip(radii, heights, strict=True)]
    i, j = np.arange(len(levels) - 1)[:, None] * sides, np.arange(sides)
    k = (j + 1) % sides
    faces = np.stack(np.broadcast_arrays(i + j, i + k, i + sides + k, i + sides + j), -1)
    faces = faces.reshape(-1, 4)
    if radii[-1] == 0:
        faces[-sides:, 3] = faces[-sides:, 2]
    return Mesh(np.concatenate(levels), faces, np.zeros(len(faces), int), (name,), True)


def drum(radius: float, height: float, name: str, sides: int = 20) -> Mesh:
    """Return a cylinder with flat ends."""
    turn = np.arange(sides) * 2 * np.pi / sides
    x, y = radius * np.cos(turn), radius * np.sin(turn)
    u, v = np.roll(x, -1), np.roll(y, -1)
    top = four((0, 0, height), (x, y, height), (u, v, height), (u, v, height))
    foot = four((0, 0, 0), (u, v, 0), (x, y, 0), (x, y, 0))
    side = lathe([radius] * 2, [0, height], name, sides)
    return joined([side, quads(np.concatenate([top, foot]), name)])


def ring(radius: float, thick: float, low: np.ndarray, high: np.ndarray) -> Mesh:
    """Return a round stone wall whose pieces each have their own foot and top."""
    turn = np.arange(len(low) + 1) * 2 * np.pi / len(low)
    c, s = np.cos(turn), np.sin(turn)
    a = (radius * c[:-1], radius * s[:-1])
    b = (radius * c[1:], radius * s[1:])
    inner = 1 - thick / radius
    d, e = tuple(inner * of for of in a), tuple(inner * of for of in b)
    sides = [
        four((*p, low), (*q, low), (*q, high), (*p, high))
        for p, q in ((a, b), (b, e), (e, d), (d, a))
    ]
    top = four((*a, high), (*b, high), (*e, high), (*d, high))
    return quads(np.concatenate([*sides, top]), "stone")
