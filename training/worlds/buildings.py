"""Buildings and streets as meshes: façades of recessed windows, roofs with eaves, arcades."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from training.worlds.mesh import Mesh, Random, box, joined

Values = float | np.ndarray | Sequence  # that broadcast

HOUSE_FACES, BLOCK_FACES, TOWER_FACES, ROW_FACES = 600, 4000, 3000, 15000
DETAIL = 3  # 3: sills and hoods, 2: frames, 1: glazing bars, 0: glass only
WALLS, ROOFS = 6, 3  # colours of each
MOST_SHOPS = 8  # of one façade
KERB = 0.12
ROAD, PAINT = 0.02, 0.026  # heights above the ground
SLAB = 0.16  # thickness of a pitched roof
ALL, NO_BACK, BAR = (0, 1, 2, 3, 4, 5), (0, 1, 2, 4, 5), (2, 3, 4, 5)
QUARTER = np.pi / 2

_TURN = np.linspace(np.pi, 0, 9)
_HALF = np.linspace(-1, 1, 9)
# The upper edge of an opening, in half widths: across and up.
FLAT = np.array([[-1.0, 0], [1, 0]])
ROUND = np.stack([np.cos(_TURN), np.sin(_TURN)], 1)
SEGMENT = ROUND[::2] * (1, 0.3)
POINTED = np.stack([_HALF, np.sqrt(4 - (1 + np.abs(_HALF)) ** 2)], 1)

_CUBE = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
_SIDES = np.array(
    [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
)


@dataclass(frozen=True)
class Style:
    """How a façade looks; shares are of the cell's width and of the storey's height."""

    wall: str
    ground: str  # of the ground floor
    cell: float = 2.6  # metres from window to window
    share: float = 0.42
    sill: float = 0.32
    head: float = 0.82
    tall: float = 1.0  # the ground floor's height in storeys
    recess: float = 0.15
    frame: float = 0.07
    bars: tuple[int, int] = (1, 1)  # upright and level glazing bars
    curve: str = "flat"
    hood: bool = False
    shutters: str = ""
    balcony: str = ""  # "single", "long" or none
    detail: int = DETAIL


_CURVES = {"flat": FLAT, "round": ROUND[::2], "segment": SEGMENT, "pointed": POINTED[::2]}


# Primitives


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


def _four(*points: tuple) -> np.ndarray:
    """Return quads of four points (x, y, z) whose coordinates broadcast."""
    return _stacked([of for point in points for of in point]).reshape(-1, 4, 3)


def _upright(x0: Values, x1: Values, z0: Values, z1: Values, y: Values = 0.0) -> np.ndarray:
    """Return rectangles that face -y."""
    return _four((x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1))


def _level(x0: Values, x1: Values, y0: Values, y1: Values, z: float, name: str) -> Mesh:
    """Return rectangles that face up."""
    return quads(_four((x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)), name)


def _ends(x: float, y0: float, y1: float, z0: float, z1: float, name: str) -> Mesh:
    """Return two rectangles that face +x at x and -x at -x."""
    side, near, far = (x, -x), (y0, y1), (y1, y0)
    return quads(_four((side, near, z0), (side, far, z0), (side, far, z1), (side, near, z1)), name)


def boxes(low: tuple, high: tuple, name: str, sides: tuple[int, ...] = ALL) -> Mesh:
    """Return boxes between corners whose coordinates broadcast."""
    flat = _stacked([*low, *high]).reshape(-1, 1, 1, 6)
    low, high = flat[..., :3], flat[..., 3:]
    return quads(low + _CUBE[_SIDES[list(sides)]] * (high - low), name)


def _prism(profile: Sequence, x0: float, x1: float, name: str) -> Mesh:
    """Return a convex profile of (y, z), anticlockwise seen from +x, drawn along x."""
    y, z = np.asarray(profile, float).T
    after = np.roll(np.arange(len(y)), -1)
    i, j = np.arange(1, len(y) - 1), np.arange(2, len(y))
    sides = _four((x0, y, z), (x0, y[after], z[after]), (x1, y[after], z[after]), (x1, y, z))
    right = _four((x1, y[0], z[0]), (x1, y[i], z[i]), (x1, y[j], z[j]), (x1, y[j], z[j]))
    left = _four((x0, y[0], z[0]), (x0, y[j], z[j]), (x0, y[i], z[i]), (x0, y[i], z[i]))
    return quads(np.concatenate([sides, right, left]), name)


def _frustum(base: tuple, top: tuple, height: float, name: str) -> Mesh:
    """Return a block of (width, depth) at the foot and at the top."""
    turn = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / 2
    x0, y0 = (turn * base).T
    x1, y1 = (turn * top).T
    k = np.array([1, 2, 3, 0])
    sides = _four((x0, y0, 0), (x0[k], y0[k], 0), (x1[k], y1[k], height), (x1, y1, height))
    caps = np.stack([np.stack([x1, y1, 0 * x1 + height], 1), np.stack([x0, y0, 0 * x0], 1)[::-1]])
    return quads(np.concatenate([sides, caps]), name)


def _lathe(radii: Sequence, heights: Sequence, name: str, sides: int = 20) -> Mesh:
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


def _drum(radius: float, height: float, name: str, sides: int = 20) -> Mesh:
    """Return a cylinder with flat ends."""
    turn = np.arange(sides) * 2 * np.pi / sides
    x, y = radius * np.cos(turn), radius * np.sin(turn)
    u, v = np.roll(x, -1), np.roll(y, -1)
    top = _four((0, 0, height), (x, y, height), (u, v, height), (u, v, height))
    foot = _four((0, 0, 0), (u, v, 0), (x, y, 0), (x, y, 0))
    side = _lathe([radius] * 2, [0, height], name, sides)
    return joined([side, quads(np.concatenate([top, foot]), name)])


def _chance(random: Random, share: float) -> bool:
    """Return True with the given chance."""
    return bool(random.random() < share)


def _pick(random: Random, *of: str) -> str:
    """Return one of the words."""
    return of[random.integers(len(of))]


def _wall_name(random: Random) -> str:
    """Return a wall's material."""
    return f"wall{random.integers(WALLS)}"


def _roof_name(random: Random) -> str:
    """Return a roof's material."""
    return f"roof{random.integers(ROOFS)}"


def _fitted(
    build: Callable[[Random, int], Mesh], random: Random, faces: int, detail: int = DETAIL
) -> Mesh:
    """Return what is built with the most detail that the number of faces allows."""
    seed = int(random.integers(2**32))
    while True:
        built = build(np.random.default_rng(seed), detail)
        if len(built.faces) <= faces or detail == 0:
            return built
        detail = max(0, detail - (1 if len(built.faces) < 1.6 * faces else 2))


# Façades


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
        _upright(0, width, np.r_[low, tops], np.r_[foot, high]),
        _upright(np.r_[0, right], np.r_[left, width], foot_up, top),
        _upright(left, right, foot_up, bottoms),
        _four((x0, 0, z0), (x1, 0, z1), (x1, 0, head), (x0, 0, head)),
        _four((x0, 0, z0), (x0, depth, z0), (x1, depth, z1), (x1, 0, z1)),
        _four((left, 0, bottoms), (left, depth, bottoms), (left, depth, spring), (left, 0, spring)),
        _four(
            (right, depth, bottoms), (right, 0, bottoms), (right, 0, spring), (right, depth, spring)
        ),
        _four((left, 0, bottoms), (end, 0, bottoms), (end, depth, bottoms), (left, depth, bottoms)),
    )
    return quads(np.concatenate(parts), name)


def _glazing(
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
    parts, bars = [quads(_upright(left, right, low, high, y), fill)], []
    if style.detail > 0 and fill == "glass":
        for share in np.arange(1, style.bars[0] + 1) / (style.bars[0] + 1):
            x = left + share * (right - left)
            bars.append(_upright(x - f / 2, x + f / 2, low, high, y - 0.03))
        blind = random.random(left.shape) < 0.15
        drop = random.uniform(0.2, 0.7, left.shape) * (high - low)
        parts.append(quads(_upright(left, right, high - drop, high, y - 0.015)[blind], "trim"))
    if style.detail > 1:
        bars += [
            _upright(left, left + f, low, high, y - 0.02),
            _upright(right - f, right, low, high, y - 0.02),
            _upright(left, right, high - f, high, y - 0.02),
            _upright(left, right, low, low + f, y - 0.02),
        ]
        for share in np.arange(1, style.bars[1] + 1) / (style.bars[1] + 1):
            z = low + share * (high - low)
            bars.append(_upright(left, right, z - f / 2, z + f / 2, y - 0.025))
    if bars:
        parts.append(quads(np.concatenate(bars), "trim"))
    return parts


def _ledges(left: Values, right: Values, z: Values, out: float = 0.1) -> Mesh:
    """Return sills or hoods whose upper faces are at z."""
    return boxes((left - out, -out, z - 0.08), (right + out, 0, z), "trim", NO_BACK)


def _cells(width: float, columns: int, share: float) -> np.ndarray:
    """Return left and right of the openings of equal cells."""
    cell = width / columns
    middle = (np.arange(columns) + 0.5) * cell
    return np.stack([middle - share * cell / 2, middle + share * cell / 2], 1)


def facade(
    random: Random,
    width: float,
    height: float,
    columns: int,
    floors: int,
    style: Style,
    ground: str = "window",
    door: int = 0,
) -> Mesh:
    """Return a façade in the plane y = 0 that faces -y, x in [0, width], z in [0, height].

    Parameters
    ----------
    ground : "window", "door" (in column ``door``) or "shop"
    """
    first = height * style.tall / (floors - 1 + style.tall)
    if ground == "shop":
        parts = _shops(random, width, first, style)
    else:
        only = door if ground == "door" else -1
        parts = _storeys(random, width, 0, first, 1, columns, style, only)
    if floors > 1:
        upper = replace(style, ground=style.wall)
        parts += _storeys(random, width, first, height, floors - 1, columns, upper)
    if floors > 1 and ground != "window" and style.balcony:
        levels = first + (height - first) / (floors - 1) * np.arange(floors - 1)
        parts += _balconies(random, _cells(width, columns, style.share), levels, style)
    return joined(parts)


def _storeys(
    random: Random,
    width: float,
    low: float,
    high: float,
    floors: int,
    columns: int,
    style: Style,
    door: int = -1,
) -> list[Mesh]:
    """Return equal storeys of windows, in the ground floor's material."""
    storey = (high - low) / floors
    edges = _cells(width, columns, style.share)
    level = low + storey * np.arange(floors)
    tops = level + style.head * storey
    bottoms = np.repeat((level + style.sill * storey)[:, None], columns, 1)
    shown = np.arange(columns) != door
    if door >= 0:
        middle = edges[door].mean()
        half = min(0.55, 0.4 * width / columns)
        edges[door] = middle - half, middle + half
        bottoms[:, door] = low
    name, curve = style.ground, _CURVES[style.curve]
    parts = [pierced(width, low, high, edges, bottoms, tops, style.recess, name, curve)]
    left, right = edges[shown].T
    bottoms, tops = bottoms[:, shown], tops[:, None]
    parts += _glazing(random, left, right, bottoms, tops, style)
    if door >= 0:
        parts += _glazing(random, *edges[door], low, tops[0], replace(style, detail=2), "wood")
    if style.detail >= DETAIL and left.size:
        parts.append(_ledges(left, right, bottoms))
        if style.hood:
            parts.append(_ledges(left, right, tops + 0.2, 0.2))
    if style.shutters and style.detail > 0 and left.size:
        wide = np.minimum((right - left) / 2, (width / columns - right[0] + left[0]) / 2.2)
        for x in (left - wide, right):
            parts.append(boxes((x, -0.05, bottoms), (x + wide, 0, tops), style.shutters, NO_BACK))
    return parts


def _shops(random: Random, width: float, height: float, style: Style) -> list[Mesh]:
    """Return a ground floor of shop windows with doors, fascias and awnings."""
    shops = max(1, min(MOST_SHOPS, round(width / random.uniform(4, 6.5))))
    cell = width / shops
    at = np.arange(shops)[:, None] * cell
    edges = (at[..., None] + cell * np.array([[0.06, 0.64], [0.71, 0.93]])).reshape(-1, 2)
    sill, head = random.uniform(0.3, 0.7), height * random.uniform(0.7, 0.76)
    bottoms = np.tile([sill, 0.02], shops)[None]
    recess = random.uniform(0.2, 0.45)
    look = replace(style, recess=recess, bars=(int(random.integers(0, 4)), 0))
    parts = [pierced(width, 0, height, edges, bottoms, np.array([head]), recess, style.ground)]
    left, right = edges[::2].T
    parts += _glazing(random, left, right, sill, head, look)
    left, right = edges[1::2].T
    fill = _pick(random, "glass", "wood")
    parts += _glazing(random, left, right, 0.02, head, replace(look, bars=(1, 1)), fill)
    for x in at.ravel():
        parts += _shop_front(random, x + 0.04 * cell, x + 0.96 * cell, head, height)
    return parts


def _shop_front(random: Random, x0: float, x1: float, head: float, height: float) -> list[Mesh]:
    """Return the fascia of one shop and perhaps an awning."""
    name = _pick(random, "awning", "wood", "trim", "metal")
    parts = [boxes((x0, -0.14, head + 0.05), (x1, 0, height - 0.2), name, NO_BACK)]
    if _chance(random, 0.45):
        out, drop = random.uniform(0.8, 1.6), random.uniform(0.4, 0.8)
        z = head + 0.02
        profile = [(-out, z - drop - 0.2), (-out + 0.03, z - drop - 0.2), (0, z - 0.04), (0, z)]
        parts.append(_prism([*profile, (-out, z - drop)], x0, x1, "awning"))
    return parts


def _balconies(random: Random, edges: np.ndarray, levels: np.ndarray, style: Style) -> list[Mesh]:
    """Return balconies at some columns, or along the whole façade."""
    out = random.uniform(0.7, 1.4)
    if style.balcony == "long":
        left, right = edges.min() - 0.3, edges.max() + 0.3
        return _railed(left, right, levels, out, random)
    every = int(random.integers(1, 4))
    chosen = edges[int(random.integers(0, every)) % len(edges) :: every]
    left, right = np.broadcast_arrays(*chosen.T, levels[:, None])[:2]
    z = np.broadcast_to(levels[:, None], left.shape)
    return _railed(left.ravel() - 0.35, right.ravel() + 0.35, z.ravel(), out, random)


def _railed(x0: Values, x1: Values, z: Values, out: float, random: Random) -> list[Mesh]:
    """Return slabs that stand out of a façade with a panel or bars around."""
    name = _pick(random, "metal", "metal", "glass", "trim", "awning", "wood")
    x0, x1, z = np.broadcast_arrays(x0, x1, z)
    parts = [boxes((x0, -out, z - 0.16), (x1, 0, z), _pick(random, "trim", "stone"), NO_BACK)]
    open_rail = name == "metal"
    t, low, high = 0.05, z + (0.92 if open_rail else 0.05), z + 1.0
    parts.append(boxes((x0, -out, low), (x1, -out + t, high), name))
    for x in (x0, x1 - t):
        parts += [boxes((x, -out + t, low), (x + t, 0, high), name, NO_BACK)]
    if open_rail:
        count = max(2, min(int(np.mean(x1 - x0) / 0.22), 200 // len(z)))
        x = x0[:, None] + np.linspace(0, 1, count + 1) * (x1 - x0 - t)[:, None]
        z = z[:, None]
        parts.append(boxes((x, -out, z), (x + 0.035, -out + 0.035, z + 0.95), name, BAR))
    return parts


def _style(random: Random, detail: int) -> Style:
    """Return how a dwelling looks."""
    wall = _wall_name(random)
    tall_windows = _chance(random, 0.3)
    curve = _pick(random, "flat", "flat", "flat", "segment", "round")
    return Style(
        wall,
        ground=wall if _chance(random, 0.7) else _pick(random, "stone", _wall_name(random)),
        cell=random.uniform(2.0, 3.3),
        share=random.uniform(0.34, 0.6),
        sill=random.uniform(0.08, 0.2) if tall_windows else random.uniform(0.27, 0.36),
        head=random.uniform(0.76, 0.86),
        recess=random.uniform(0.1, 0.26),
        frame=random.uniform(0.05, 0.1),
        bars=(int(random.integers(0, 3)), int(random.integers(0, 3))),
        curve=curve if detail > 1 else "flat",
        hood=_chance(random, 0.3),
        detail=detail,
    )


def _around(sides: Sequence[Mesh], width: float, depth: float) -> list[Mesh]:
    """Return front, right, back and left set around a rectangle."""
    x, y = width / 2, depth / 2
    at = ((-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0))
    return [side.moved(at[i], i * QUARTER) for i, side in enumerate(sides)]


def _walls(
    random: Random,
    width: float,
    depth: float,
    height: float,
    floors: int,
    style: Style,
    ground: str = "window",
    door: int = 0,
    detached: bool = True,
) -> list[Mesh]:
    """Return the four façades; the left and the right are blank if not detached."""
    long, short = (max(1, round(of / style.cell)) for of in (width, depth))
    back = replace(style, detail=max(0, style.detail - 1))
    sides = [facade(random, width, height, long, floors, style, ground, door)]
    blank = quads(_upright(0, depth, 0, height), style.wall)
    for of, columns in ((depth, short), (width, long), (depth, short)):
        shown = detached or of == width
        sides.append(facade(random, of, height, columns, floors, back) if shown else blank)
    return _around(sides, width, depth)


# Roofs: on a rectangle centred on the origin, from z = 0 up


def _gable(
    width: float,
    depth: float,
    rise: float,
    over: tuple[float, float],
    names: tuple[str, str],
    knee: float = 0.0,
    bend: tuple[float, float] | None = None,
) -> list[Mesh]:
    """Return a roof with its ridge along x.

    Parameters
    ----------
    over : how far the eaves and the verges stand out
    names : of the roof and of the gable wall
    knee : the wall's height below the eaves
    bend : where a gambrel bends, in shares of the half depth and of the rise
    """
    y, x, top = depth / 2, width / 2 + over[1], knee + rise
    line = [(-y, knee), *([(-y * bend[0], knee + rise * bend[1])] if bend else []), (0.0, top)]
    gable = [(-y, 0), (y, 0), *((-a, b) for a, b in line[:-1]), *line[::-1]]
    slope = (line[1][1] - knee) / (line[1][0] + y)
    line[0] = (-y - over[0], knee - over[0] * slope)
    parts = [_prism(gable, -width / 2, width / 2, names[1])]
    for (a, b), (c, d) in itertools.pairwise(line):
        b, d = b + 0.01, d + 0.01
        for side in (1, -1):
            profile = [(side * a, b), (side * c, d), (side * c, d + SLAB), (side * a, b + SLAB)]
            parts.append(_prism(profile[::side], -x, x, names[0]))
    return parts


def _hip(width: float, depth: float, rise: float, over: float, roof: str) -> list[Mesh]:
    """Return a hip roof on a soffit that stands over the walls."""
    w, d = width + 2 * over, depth + 2 * over
    ridge = (max(0.0, w - d), max(0.0, d - w))
    eave = boxes((-w / 2, -d / 2, 0), (w / 2, d / 2, 0.15), "trim")
    return [eave, _frustum((w + 0.05, d + 0.05), ridge, rise, roof).moved((0, 0, 0.15))]


def _flat(random: Random, width: float, depth: float, wall: str) -> list[Mesh]:
    """Return a flat roof with a parapet, its coping and what stands there."""
    x, y, t = width / 2, depth / 2, 0.25
    h = random.uniform(0.3, 1.1)
    parts = [_level(-x, x, -y, y, 0, "asphalt")]
    for out, low, high, name in ((0.0, 0.0, h, wall), (0.06, h, h + 0.1, "trim")):
        a, b, o = x + out, y + out, t + 2 * out
        x0, x1 = np.array([-a, -a, -a, a - o]), np.array([a, a, -a + o, a])
        y0, y1 = np.array([-b, b - o, -b + o, -b + o]), np.array([-b + o, b, b - o, b - o])
        parts.append(boxes((x0, y0, low), (x1, y1, high), name))
    for _ in range(random.integers(0, 5)):
        w, d, z = random.uniform(0.8, 2.5), random.uniform(0.8, 2), random.uniform(0.6, 2.4)
        cx, cy = (random.uniform(-0.7, 0.7) * (of - 1.3) for of in (x, y))
        parts.append(box(w, d, z, _pick(random, "metal", "trim", wall)).moved((cx, cy, 0)))
    return parts


def _chimney(random: Random, height: float, wall: str) -> Mesh:
    """Return a chimney with a cap and pots."""
    w, d = random.uniform(0.6, 1.4), random.uniform(0.5, 0.8)
    parts = [box(w, d, height, wall), box(w + 0.14, d + 0.14, 0.14, "trim").moved((0, 0, height))]
    pot = box(0.2, 0.2, 0.35, "roof0")
    pots = np.linspace(-w / 3, w / 3, int(w / 0.35))
    return joined([*parts, *(pot.moved((x, 0, height + 0.14)) for x in pots)])


def _dormer(random: Random, slope: float, style: Style, roof: str) -> Mesh:
    """Return a dormer that faces -y from a roof of the slope, its foot at the origin."""
    w, h = random.uniform(1.1, 1.6), random.uniform(1.1, 1.5)
    rise = random.uniform(0.2, 0.5) * w
    deep, x = (h + rise + SLAB) / slope, w / 2
    look = replace(style, share=0.7, sill=0.12, head=0.88, tall=1, recess=0.08, ground=style.wall)
    look = replace(look, detail=min(look.detail, 2), shutters="")
    top = joined(_gable(deep, w, rise, (0.12, 0.15), (roof, style.wall)))
    return joined(
        [
            facade(random, w, h, 1, 1, look).moved((-x, 0, 0)),
            _ends(x, 0, deep, 0, h, style.wall),
            top.moved((0, deep / 2, h), QUARTER),
        ]
    )


def _dormers(
    random: Random, width: float, y: float, z: float, slope: float, style: Style, roof: str
) -> list[Mesh]:
    """Return a row of equal dormers with their feet at y and z."""
    count = int(random.integers(1, max(2, int(width / 2.6) + 1)))
    one = _dormer(random, slope, style, roof)
    return [one.moved((x, y, z)) for x in (np.arange(count) + 0.5) * width / count - width / 2]


def _mansard(
    random: Random, width: float, depth: float, style: Style, detached: bool
) -> list[Mesh]:
    """Return a mansard roof with dormers."""
    roof, rise, run = _roof_name(random), random.uniform(2.1, 2.8), random.uniform(0.7, 1.4)
    y, top = depth / 2, random.uniform(0.4, 1.4)
    if detached:
        w, d = width - 2 * run, depth - 2 * run
        parts = [_frustum((width, depth), (w, d), rise, roof)]
        parts.append(_frustum((w, d), (w * 0.5, d * 0.2), top, roof).moved((0, 0, rise)))
    else:
        profile = [(-y, 0), (y, 0), (y - run, rise), (0, rise + top), (run - y, rise)]
        parts = [_prism(profile, -width / 2, width / 2, roof)]
    slope, inner = rise / run, width - 2 * run * detached
    parts += _dormers(random, inner, -y + 0.35 / slope, 0.3, slope, style, roof)
    return [*parts, _stack(random, width, rise + top, style.wall)]


def _stack(random: Random, width: float, height: float, wall: str) -> Mesh:
    """Return a chimney that stands near the ridge."""
    tall = height + random.uniform(0.5, 1.3)
    x, y = random.uniform(-0.4, 0.4) * width, random.uniform(-0.6, 0.6)
    return _chimney(random, tall, wall).moved((x, y, 0))


def _pitched(
    random: Random, width: float, depth: float, style: Style, detached: bool, least: float
) -> list[Mesh]:
    """Return a gable or a hip roof with dormers and chimneys."""
    roof, over = _roof_name(random), random.uniform(0.3, 0.8)
    slope = min(random.uniform(least, 1.15), 10 / depth)
    if detached and _chance(random, 0.35):
        short = min(width, depth) / 2 + over
        parts = _hip(width, depth, slope * short, over, roof)
        return [*parts, _stack(random, 0.2 * width, slope * short, style.wall)]
    rise, verge = slope * depth / 2, over * 0.7 if detached else 0.0
    parts = _gable(width, depth, rise, (over, verge), (roof, style.wall), 0.3)
    if slope > 0.75 and style.detail > 0 and _chance(random, 0.5):
        start = random.uniform(0.5, 0.9)
        parts += _dormers(
            random, width - 1.5, start - depth / 2, start * slope + 0.35, slope, style, roof
        )
    for _ in range(random.integers(0, 3)):
        parts.append(_stack(random, width, rise + 0.3, style.wall))
    return parts


# Dwellings


def _oriel(random: Random, width: float, height: float, floors: int, style: Style) -> Mesh:
    """Return a bay that stands in front of the plane y = 0 on the ground."""
    out, x = random.uniform(0.5, 1.0), width / 2
    look = replace(style, share=0.78, shutters="", balcony="", detail=min(2, style.detail))
    front = facade(random, width, height, 2, floors, look).moved((-x, -out, 0))
    cheeks = _ends(x, -out, 0, 0, height, style.wall)
    top = _frustum((width + 0.2, out * 2 + 0.2), (width * 0.6, 0.1), 0.5, _roof_name(random))
    return joined([front, cheeks, top.moved((0, 0, height))])


def _porch(random: Random, width: float, foot: float, wall: str) -> list[Mesh]:
    """Return a porch before a door at the origin that faces -y."""
    out, high, x = random.uniform(0.9, 2.2), random.uniform(2.4, 2.7), width / 2
    roof = _roof_name(random)
    lean = [(-out - 0.2, high), (0, high), (0, high + 0.55), (-out - 0.2, high + 0.14)]
    parts = [_prism(lean, -x - 0.15, x + 0.15, roof)]
    post = _pick(random, "trim", "wood", wall)
    if _chance(random, 0.75):
        at = np.array([-x, x - 0.14])
        parts.append(boxes((at, -out, 0), (at + 0.14, -out + 0.14, high), post, BAR))
    parts.append(boxes((-x, -out, -foot), (x, 0, 0.02), "stone", NO_BACK))
    return parts


def house(random: Random) -> Mesh:
    """Return a detached house of one or two floors."""
    return _fitted(_house, random, HOUSE_FACES)


def _house(random: Random, detail: int) -> Mesh:
    """Return a house with so much detail."""
    width, depth, floors = random.uniform(7, 13.5), random.uniform(6, 9), int(random.integers(1, 3))
    height, foot = floors * random.uniform(2.5, 2.9), random.uniform(0.15, 0.5)
    style = replace(_style(random, detail), cell=random.uniform(2.2, 3.2))
    if _chance(random, 0.4) and style.curve == "flat" and detail > 0:
        style = replace(style, shutters=_pick(random, "wood", "awning", "trim"))
    columns = max(1, round(width / style.cell))
    door = int(random.integers(columns))
    x = (door + 0.5) * width / columns - width / 2
    parts = _walls(random, width, depth, height, floors, style, "door", door)
    parts += [of.moved((0, 0, height)) for of in _pitched(random, width, depth, style, True, 0.45)]
    wide = min(width / columns, random.uniform(1.6, 3))
    front = _porch(random, wide, foot, style.wall) if _chance(random, 0.6) else []
    front.append(boxes((-0.8, -0.9, -foot), (0.8, 0, -foot / 2), "stone", NO_BACK))
    parts += [of.moved((x, -depth / 2, 0)) for of in front]
    side = -1.0 if x > 0 else 1.0
    if _chance(random, 0.4):
        parts += _wing(random, side, (width, depth, height), foot, style)
    elif columns > 2 and _chance(random, 0.3):
        bay = _oriel(random, width / columns, height / floors, 1, style)
        at = (columns - 0.5) if side > 0 else 0.5
        parts.append(bay.moved((at * width / columns - width / 2, -depth / 2, 0)))
    base = boxes(
        (-width / 2 - 0.05, -depth / 2 - 0.05, -foot),
        (width / 2 + 0.05, depth / 2 + 0.05, 0),
        "stone",
    )
    return joined([*parts, base]).moved((0, 0, foot))


def _wing(random: Random, side: float, size: tuple, foot: float, style: Style) -> list[Mesh]:
    """Return a wing that stands out of the front with its own gable."""
    width, depth, height = size
    w, out = random.uniform(0.3, 0.42) * width, random.uniform(1.5, 3.5)
    deep, rise = out + depth / 2, random.uniform(0.35, 0.5) * w
    look = replace(style, detail=min(style.detail, 2))
    front = facade(random, w, height, max(1, round(w / style.cell)), 1 + (height > 3.5), look)
    blank = quads(_upright(0, deep, 0, height), style.wall)
    back = quads(_upright(0, w, 0, height), style.wall)
    parts = _around([front, blank, back, blank], w, deep)
    roof = joined(_gable(deep, w, rise, (0.35, 0.3), (_roof_name(random), style.wall)))
    parts += [
        roof.moved((0, 0, height), QUARTER),
        box(w + 0.1, deep + 0.1, foot, "stone").moved((0, 0, -foot)),
    ]
    at = (side * ((width - w) / 2 - 0.15), -depth / 2 - out + deep / 2, 0)
    return [of.moved(at) for of in parts]


def block(random: Random, width: float, depth: float, floors: int) -> Mesh:
    """Return a detached block of dwellings, perhaps with shops."""
    size = (width, depth)
    return _fitted(lambda r, d: _block(r, size, floors, d, True, BLOCK_FACES), random, BLOCK_FACES)


def _block_style(random: Random, detail: int, least: float) -> Style:
    """Return how a block looks, its windows at least so far apart; plainer with less detail."""
    style = _style(random, detail)
    balcony = _pick(random, "", "", "", "single", "single", "long")
    shutters = _pick(random, "", "", "", "wood", "awning")
    return replace(
        style,
        cell=max(style.cell, least),
        tall=random.uniform(1.0, 1.35),
        balcony="long" if balcony and detail < 2 else balcony,
        shutters=shutters if style.curve == "flat" and not balcony and detail > 0 else "",
    )


def _block(
    random: Random,
    size: tuple,
    floors: int,
    detail: int,
    detached: bool,
    faces: int,
    wall: str = "",
) -> Mesh:
    """Return a block with so much detail; party walls are blank unless detached."""
    width, depth = size
    around = 2 * (width + depth) if detached else 2 * width
    style = _block_style(random, detail, around * floors / (faces / 11))
    style = replace(style, wall=wall, ground=wall) if wall else style
    storey = random.uniform(2.8, 3.5)
    first, height = storey * style.tall, storey * (floors - 1 + style.tall)
    ground = _pick(random, "shop", "door", "door")
    columns = max(1, round(width / style.cell))
    door = int(random.integers(columns))
    parts = _walls(random, width, depth, height, floors, style, ground, door, detached)
    if ground == "door" and columns > 1 and not style.balcony and _chance(random, 0.3):
        bay = _oriel(random, 0.85 * width / columns, height - 0.5, floors, style)
        spots = [at for at in range(columns) if at != door][:: int(random.integers(1, 3))][:4]
        for at in spots:
            parts.append(bay.moved(((at + 0.5) * width / columns - width / 2, -depth / 2, 0)))
    for z, high, out, share in ((first, 0.16, 0.09, 0.5), (height - 0.3, 0.28, 0.35, 0.7)):
        if _chance(random, share):
            parts.append(_course(width, depth, z, high, random.uniform(0.5, 1) * out, detached))
    top = _top(random, width, depth, style, detached)
    return joined(parts + [of.moved((0, 0, height)) for of in top])


def _course(width: float, depth: float, z: float, high: float, out: float, detached: bool) -> Mesh:
    """Return a cornice or a string course, along the front only unless detached."""
    x, y = width / 2, depth / 2
    if detached:
        return boxes((-x - out, -y - out, z), (x + out, y + out, z + high), "trim")
    return boxes((-x, -y - out, z), (x, -y, z + high), "trim", NO_BACK)


def _top(random: Random, width: float, depth: float, style: Style, detached: bool) -> list[Mesh]:
    """Return a block's roof."""
    kind = random.random()
    if kind < 0.4 or depth > 18:
        parts = _flat(random, width, depth, style.wall)
        if _chance(random, 0.5):
            parts.append(_stack(random, width * 0.8, 1.5, style.wall))
        return parts
    if kind < 0.65:
        return _mansard(random, width, depth, style, detached)
    return _pitched(random, width, depth, style, detached, 0.4)


def row(random: Random, length: float) -> Mesh:
    """Return a terrace along x from 0 to the length, its façades at about y = 0."""
    count = max(1, round(length / random.uniform(5.5, 11)))
    alike = _chance(random, 0.35)
    widths = np.ones(count) if alike else random.uniform(0.6, 1.4, count)
    widths *= length / widths.sum()
    most, depth, floors = ROW_FACES // count, random.uniform(8, 12), int(random.integers(2, 6))
    seed, wall, parts = int(random.integers(2**32)), _wall_name(random), []
    start = DETAIL if most > 1400 else 2 if most > 800 else 1
    back = 0.0 if alike else random.uniform(0, 0.8)
    for x, width in zip(np.cumsum(widths) - widths / 2, widths, strict=True):
        size = (float(width), depth)
        high = floors if alike else max(2, floors + int(random.integers(-1, 2)))
        wall = wall if alike and _chance(random, 0.7) else _wall_name(random)

        def build(
            r: Random, d: int, size: tuple = size, high: int = high, wall: str = wall
        ) -> Mesh:
            return _block(r, size, high, d, False, most, wall)

        one = _fitted(build, np.random.default_rng(seed) if alike else random, most, start)
        parts.append(one.moved((x, depth / 2 + back * random.random(), 0)))
    return joined(parts)


# Offices


def tower(random: Random) -> Mesh:
    """Return an office high-rise of 12 to 40 floors."""
    floors, storey = int(random.integers(12, 41)), random.uniform(3.3, 3.9)
    width, depth = random.uniform(16, 38, 2)
    look, wall = _pick(random, "grid", "strip", "punched"), _wall_name(random)
    seed, parts, z, wide = int(random.integers(2**32)), [], 0.0, random.uniform(1.1, 1.5)
    stages = [(1.0, floors)]
    if _chance(random, 0.45):
        stages = [(1.0, int(floors * random.uniform(0.5, 0.8))), (random.uniform(0.6, 0.85), 0)]
        stages[1] = (stages[1][0], floors - stages[0][1])
    if _chance(random, 0.5):
        podium = _lobby(random, width * wide, depth * wide, wall)
        parts, z = [podium], float(podium.vertices[:, 2].max()) - 0.5
    for scale, count in stages:
        w, d = width * scale, depth * scale
        share = count / floors
        walls = [
            _curtain(np.random.default_rng(seed), of, count, storey, look, wall, share)
            for of in (w, d, w, d)
        ]
        parts += [of.moved((0, 0, z)) for of in _around(walls, w, d)]
        z += count * storey
        parts += [of.moved((0, 0, z)) for of in _flat(random, w, d, wall)]
    plant = (random.uniform(0.3, 0.6) * w, random.uniform(0.3, 0.6) * d)
    parts.append(box(*plant, random.uniform(2.5, 5), _pick(random, "metal", wall)).moved((0, 0, z)))
    if _chance(random, 0.3):
        parts.append(box(0.4, 0.4, random.uniform(8, 20), "metal").moved((0, 0, z)))
    return joined(parts)


def _lobby(random: Random, width: float, depth: float, wall: str) -> Mesh:
    """Return a tower's podium with shops all round."""
    style, height = Style(wall, wall, detail=1), random.uniform(4.5, 6)
    sides = [facade(random, of, height, 1, 1, style, "shop") for of in (width, depth) * 2]
    roof = box(width + 0.4, depth + 0.4, 0.5, "trim").moved((0, 0, height))
    return joined([*_around(sides, width, depth), roof])


def _curtain(
    random: Random, width: float, floors: int, storey: float, look: str, wall: str, share: float
) -> Mesh:
    """Return an office façade; ``share`` is its part of the tower's faces."""
    height = floors * storey
    bay = random.uniform(1.5, 3.5)
    if look != "grid":
        return _offices(random, width, floors, storey, look, wall, share)
    columns = max(4, round(width / bay))
    x, z = np.linspace(0, width, columns + 1), np.arange(floors + 1) * storey
    fins, bands = random.uniform(0.06, 0.6, 2)
    t, high = random.uniform(0.08, 0.4), random.uniform(0.15, 1.2)
    rail = _pick(random, "metal", "trim", wall)
    parts = [
        quads(_upright(0, width, 0, height), "glass"),
        boxes((x - t / 2, -fins, 0), (x + t / 2, 0, height), rail, (2, 4, 5)),
        boxes((0, -bands, z[:-1]), (width, 0, z[:-1] + high), _pick(random, rail, wall), NO_BACK),
    ]
    blind = random.random((floors, columns)) < 0.1
    i, j = np.nonzero(blind)
    drop = random.uniform(0.2, 0.9, len(i)) * (storey - high)
    panes = _upright(x[j], x[j + 1], z[i + 1] - drop, z[i + 1], -0.02)[: int(150 * share)]
    return joined([*parts, quads(panes, "trim")])


def _offices(
    random: Random, width: float, floors: int, storey: float, look: str, wall: str, share: float
) -> Mesh:
    """Return an office façade of strip windows or of large punched ones."""
    height, tall = floors * storey, 1 + (look == "punched")
    rows = max(1, floors // tall)
    columns = 1 if look == "strip" else max(2, min(round(width / 3.2), int(64 * share / rows)))
    columns = max(columns, 1)
    fill, low, high = (
        random.uniform(0.6, 0.85),
        random.uniform(0.08, 0.3),
        random.uniform(0.85, 0.95),
    )
    edges = _cells(width, columns, 1 - 0.6 / width if look == "strip" else fill)
    level, recess = np.arange(rows) * height / rows, random.uniform(0.2, 0.6)
    bottoms, tops = (level + low * height / rows)[:, None], level + high * height / rows
    left, right = edges.T
    parts = [
        pierced(width, 0, height, edges, bottoms, tops, recess, wall),
        quads(_upright(left, right, bottoms, tops[:, None], recess), "glass"),
    ]
    if look == "strip":
        count = min(round(width / random.uniform(1.8, 4)), int(260 * share / rows))
        x = np.linspace(left[0], right[0], max(2, count) + 1)[1:-1]
        bars = _upright(x - 0.06, x + 0.06, bottoms, tops[:, None], recess - 0.05)
    else:
        middle = (bottoms + tops[:, None]) / 2
        bars = _upright(left, right, middle - 0.2, middle + 0.2, recess - 0.05)
    return joined([*parts, quads(bars, _pick(random, "metal", "trim"))])


# In the country


def barn(random: Random) -> Mesh:
    """Return a barn with large doors, its ridge along y."""
    width, depth, height = random.uniform(8, 14), random.uniform(11, 24), random.uniform(3.2, 5.5)
    wall = _pick(random, "wood", "wood", "metal", _wall_name(random))
    style = Style(wall, wall, cell=5, share=0.25, sill=0.45, head=0.72, recess=0.1)
    gate, high = random.uniform(2.6, 4), random.uniform(2.6, height - 0.3)
    edges = np.array([[width - gate, width + gate]]) / 2
    front = [pierced(width, 0, height, edges, np.array([[0.0]]), np.array([high]), 0.2, wall)]
    if _chance(random, 0.6):
        front += _glazing(random, *edges[0], 0, high, replace(style, recess=0.12), "wood")
    others = [
        facade(random, of, height, max(1, round(of / 5)), 1, style) for of in (depth, width, depth)
    ]
    parts = _around([joined(front), *others], width, depth)
    names, over = (_roof_name(random), wall), (random.uniform(0.3, 0.8), random.uniform(0.2, 0.8))
    bend = (random.uniform(0.55, 0.7), random.uniform(0.6, 0.72)) if _chance(random, 0.5) else None
    rise = random.uniform(0.6, 0.9 if bend else 0.7) * width / 2
    roof = joined(_gable(depth, width, rise, over, names, 0, bend))
    parts.append(roof.moved((0, 0, height), QUARTER))
    hatch = boxes(
        (-0.7, -depth / 2 - 0.06, height), (0.7, -depth / 2, height + 1.2), "trim", NO_BACK
    )
    return joined([*parts, hatch])


def shed(random: Random) -> Mesh:
    """Return a garden shed with a lean-to or a gable roof."""
    width, depth, height = random.uniform(1.8, 4), random.uniform(1.5, 3), random.uniform(1.9, 2.4)
    wall = _pick(random, "wood", "wood", "metal", _wall_name(random))
    style = Style(wall, wall, 1.6, 0.5, 0.45, 0.92, recess=0.06, frame=0.05, detail=2)
    parts = _walls(random, width, depth, height, 1, style, "door", 0)
    names, over = (_roof_name(random), wall), random.uniform(0.1, 0.3)
    if _chance(random, 0.5):
        roof = _gable(width, depth, random.uniform(0.3, 0.6) * depth, (over, over), names)
    else:
        y, rise, x = depth / 2, random.uniform(0.15, 0.35) * depth, width / 2
        slope, e = rise / depth, y + over
        low, high = -slope * over + 0.01, rise + slope * over + 0.01
        slab = [(-e, high), (e, low), (e, low + 0.08), (-e, high + 0.08)]
        roof = [
            _prism([(-y, 0), (y, 0), (-y, rise)], -x, x, wall),
            _prism(slab, -x - over, x + over, names[0]),
        ]
    return joined(parts + [of.moved((0, 0, height)) for of in roof])


def church(random: Random) -> Mesh:
    """Return a church: a nave along y with a steeple before it."""
    width, length, height = random.uniform(7, 12), random.uniform(14, 28), random.uniform(5, 10)
    wall, roof = _pick(random, "stone", _wall_name(random)), _roof_name(random)
    style = Style(
        wall,
        wall,
        4,
        0.34,
        0.25,
        0.85,
        recess=0.3,
        curve=_pick(random, "pointed", "round"),
        detail=2,
    )
    parts = _walls(random, width, length, height, 1, replace(style, cell=random.uniform(3, 4.5)))
    rise = random.uniform(0.8, 1.4) * width / 2
    gable = joined(_gable(length, width, rise, (0.4, 0.2), (roof, wall)))
    parts.append(gable.moved((0, 0, height), QUARTER))
    bays = max(1, round(length / 4))
    y = (np.arange(bays + 1) / bays - 0.5) * (length - 0.6)
    for x in (-width / 2 - 0.8, width / 2):
        parts.append(boxes((x, y - 0.3, 0), (x + 0.8, y + 0.3, height * 0.75), wall))
    apse = [
        _lathe([width * 0.38] * 2, [0, height * 0.8], wall),
        _lathe([width * 0.42, 0], [height * 0.8, height + rise / 2], roof),
    ]
    parts += [of.moved((0, length / 2, 0)) for of in apse]
    side = _pick(random, "middle", "middle", "left")
    x = 0.0 if side == "middle" else -width / 2
    y = -length / 2 - 1 if side == "middle" else -length / 2 + 3
    return joined([*parts, _steeple(random, height + rise, style, roof).moved((x, y, 0))])


def _steeple(random: Random, nave: float, style: Style, roof: str) -> Mesh:
    """Return a church tower with a spire that stands over the nave."""
    side, height = random.uniform(3.5, 5.5), nave * random.uniform(1.05, 1.5)
    floors = int(random.integers(2, 5))
    style = replace(style, head=0.8, sill=0.3, share=0.3, tall=1.3)
    front = facade(random, side, height, 1, floors, style, "door")
    other = facade(random, side, height, 1, floors, replace(style, cell=side))
    parts = _around([front, other, other, other], side, side)
    for level in range(1, floors + 1):
        parts.append(_course(side, side, height * level / floors - 0.2, 0.25, 0.12, True))
    spire, over = random.uniform(0.6, 2.6) * side, side + 0.5
    kind = random.random()
    if kind < 0.4:
        parts.append(_frustum((over, over), (0, 0), spire, roof).moved((0, 0, height + 0.05)))
    elif kind < 0.75:
        eight = _lathe([side * 0.5, 0], [0, spire * 1.2], roof, 8)
        flat = quads(eight.vertices[eight.faces], roof)
        parts += [
            flat.moved((0, 0, height), QUARTER / 4),
            _level(*[-side / 2, side / 2] * 2, height + 0.06, "stone"),
        ]
    else:
        parts += [of.moved((0, 0, height + 0.05)) for of in _crenels(side, side)]
    return joined(parts)


def _crenels(width: float, depth: float, thick: float = 0.5, tall: float = 0.9) -> list[Mesh]:
    """Return merlons around a rectangle at z = 0 and its floor."""
    x, y = width / 2, depth / 2
    parts = [_level(-x, x, -y, y, 0.02, "stone")]
    for of, at, turned in ((width, y, 0.0), (depth, x, 1.0), (width, y, 2.0), (depth, x, 3.0)):
        count = max(2, round(of / 1.6))
        left = (np.arange(count) / count - 0.5) * of
        one = boxes((left, -at - 0.02, 0), (left + of / count / 2, thick - at, tall), "stone")
        parts.append(one.moved(turned=turned * QUARTER))
    return parts


def _through(
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
    ends = _ends(x, -y, y, low, high, name)
    top = _level(-x, x, -y, y, high, name)
    sides = [front.moved((-x, -y, 0)), back.moved((x, y, 0), np.pi), ends, top]
    return joined(sides)


def _worn(random: Random, count: int, low: float, high: float) -> np.ndarray:
    """Return heights of a ruin's top, close ones alike."""
    steps = np.cumsum(np.cumsum(random.normal(0, 1, count)) * 0.6 + random.normal(0, 1, count))
    steps -= np.linspace(0, steps[-1], count)
    return low + (high - low) * (steps - steps.min()) / (np.ptp(steps) + 1e-6)


def castle_wall(random: Random) -> Mesh:
    """Return a castle's wall along x, centred, with crenels or a broken top, gate and towers."""
    length, height, thick = random.uniform(12, 34), random.uniform(4, 8), random.uniform(1.2, 2.5)
    gate, high = random.uniform(2, 3.6), random.uniform(0.5, 0.8) * height
    at = length / 2 + random.uniform(-0.3, 0.3) * length
    edges = np.array([[at - gate / 2, at + gate / 2]])
    curve = ROUND if _chance(random, 0.5) else POINTED
    parts = [_through((length, 0, height, thick), edges, 0, high, "stone", curve)]
    count = round(length / random.uniform(0.7, 1.1)) | 1
    tops = random.uniform(0.7, 1.1) * (np.arange(count) % 2 == 0) + 0.3
    if _chance(random, 0.35):
        tops = np.maximum(_worn(random, count, -0.4, height * 0.4), 0.02)
    x, deep = np.linspace(-length / 2, length / 2, count + 1), thick * random.uniform(0.3, 0.6)
    low = (x[:-1], -thick / 2 - 0.02, height - 0.05)
    parts.append(boxes(low, (x[1:], deep - thick / 2, height + tops), "stone"))
    if _chance(random, 0.6):
        scale = min(1, height / 7)
        ends = (-length / 2, length / 2)
        parts += [castle_tower(random).moved((end, 0, 0), scaled=scale) for end in ends]
    return joined(parts)


def castle_tower(random: Random) -> Mesh:
    """Return a stone tower, round or square, whole with crenels or a ruin."""
    radius, height = random.uniform(2.4, 4.2), random.uniform(8, 15)
    if _chance(random, 0.35):
        return _ring(radius, 0.9, np.zeros(24), _worn(random, 24, height * 0.25, height))
    if _chance(random, 0.4):
        style = Style("stone", "stone", share=0.13, sill=0.4, head=0.75, recess=0.5, detail=0)
        side, tall = radius * 1.8, max(2, int(height / 4))
        parts = _around([facade(random, side, height, 1, tall, style)] * 4, side, side)
        parts.append(
            boxes(
                (-side / 2 - 0.3, -side / 2 - 0.3, height - 0.6),
                (side / 2 + 0.3, side / 2 + 0.3, height),
                "stone",
            )
        )
        return joined(parts + [of.moved((0, 0, height)) for of in _crenels(side + 0.6, side + 0.6)])
    body = [_lathe([radius * 1.12, radius], [0, height], "stone", 24)]
    top = _drum(radius + 0.35, 0.7, "stone", 24).moved((0, 0, height - 0.5))
    merlons = _ring(radius + 0.35, 0.5, np.full(24, 0.15), np.where(np.arange(24) % 2, 1.1, 0.35))
    for turn, z in zip(random.uniform(0, 6.3, 4), height * np.linspace(0.2, 0.8, 4), strict=True):
        slit = boxes(
            (-0.14, -radius * 1.12 - 0.02, -0.6), (0.14, -radius * 0.8, 0.6), "glass", NO_BACK
        )
        body.append(slit.moved((0, 0, z), turn))
    if _chance(random, 0.3):
        body.append(_lathe([radius + 0.3, 0], [height + 0.3, height * 1.5], _roof_name(random)))
    return joined([*body, top, merlons.moved((0, 0, height))])


def _ring(radius: float, thick: float, low: np.ndarray, high: np.ndarray) -> Mesh:
    """Return a round stone wall whose pieces each have their own foot and top."""
    turn = np.arange(len(low) + 1) * 2 * np.pi / len(low)
    c, s = np.cos(turn), np.sin(turn)
    a = (radius * c[:-1], radius * s[:-1])
    b = (radius * c[1:], radius * s[1:])
    inner = 1 - thick / radius
    d, e = tuple(inner * of for of in a), tuple(inner * of for of in b)
    sides = [
        _four((*p, low), (*q, low), (*q, high), (*p, high))
        for p, q in ((a, b), (b, e), (e, d), (d, a))
    ]
    top = _four((*a, high), (*b, high), (*e, high), (*d, high))
    return quads(np.concatenate([*sides, top]), "stone")


def lighthouse(random: Random) -> Mesh:
    """Return a lighthouse with bands, a gallery and a lantern."""
    height, foot, neck = random.uniform(10, 26), random.uniform(2.4, 3.8), random.uniform(1.5, 2.1)
    bands = int(random.integers(1, 8))
    pair = (_pick(random, "trim", _wall_name(random)), _pick(random, "awning", _wall_name(random)))
    z = np.linspace(0, height, bands + 1)
    radii = neck + (foot - neck) * (1 - z / height) ** 1.3
    parts = [_lathe(radii[i : i + 2], z[i : i + 2], pair[i % 2], 24) for i in range(bands)]
    parts.append(_drum(neck + 0.9, 0.25, "trim", 24).moved((0, 0, height)))
    turn = np.arange(24) * np.pi / 12
    x, y, top = (neck + 0.8) * np.cos(turn), (neck + 0.8) * np.sin(turn), height + 1.2
    parts.append(
        boxes((x - 0.03, y - 0.03, height + 0.25), (x + 0.03, y + 0.03, top), "metal", BAR)
    )
    parts.append(_ring(neck + 0.85, 0.1, np.full(24, top), np.full(24, top + 0.07)))
    lamp = neck * 0.7
    parts += [
        _drum(lamp + 0.05, 0.8, "metal").moved((0, 0, height + 0.2)),
        _drum(lamp, 2, "glass", 12).moved((0, 0, height + 1)),
    ]
    parts.append(
        _lathe(
            [lamp + 0.3, lamp * 0.6, 0.15, 0.1, 0],
            height + np.array([3, 3.7, 4, 4.8, 4.9]),
            "metal",
        )
    )
    for at in np.linspace(0.3, 0.85, int(random.integers(2, 5))) * height:
        r = float(np.interp(at, z, radii))
        turned = random.uniform(-0.8, 0.8)
        frame = boxes((-0.45, -r - 0.1, 0), (0.45, 0, 1.3), "trim", NO_BACK)
        pane = quads(_upright(-0.33, 0.33, 0.12, 1.18, -r - 0.11), "glass")
        parts += [frame.moved((0, 0, at), turned), pane.moved((0, 0, at), turned)]
    parts.append(boxes((-0.8, -foot - 0.35, 0), (0.8, 0, 2.5), "trim", NO_BACK))
    parts.append(quads(_upright(-0.55, 0.55, 0.1, 2.2, -foot - 0.36), "wood"))
    return joined(parts)


# Along a street


def wall(random: Random, length: float) -> Mesh:
    """Return a garden wall along x, centred, with a coping and perhaps piers or a railing."""
    height, thick = random.uniform(0.5, 2.2), random.uniform(0.2, 0.45)
    name, cap = _pick(random, "stone", _wall_name(random)), _pick(random, "stone", "trim", "roof0")
    x, y = length / 2, thick / 2
    parts = [boxes((-x, -y, 0), (x, y, height), name)]
    parts.append(boxes((-x, -y - 0.05, height), (x, y + 0.05, height + 0.08), cap))
    top = height + 0.08
    if height < 1 and _chance(random, 0.6):
        at = np.arange(-x + 0.1, x, 0.16)
        parts.append(boxes((at, -0.012, top), (at + 0.025, 0.012, top + 0.9), "metal", BAR))
        parts.append(boxes((-x, -0.02, top + 0.75), (x, 0.02, top + 0.8), "metal"))
        top += 0.9
    if _chance(random, 0.6):
        at = np.linspace(-x, x, max(2, round(length / random.uniform(2, 4)) + 1))
        p = thick / 2 + random.uniform(0.06, 0.15)
        parts.append(boxes((at - p, -p, 0), (at + p, p, top + 0.15), name))
        q = p + 0.06
        parts.append(boxes((at - q, -q, top + 0.15), (at + q, q, top + 0.25), cap))
    return joined(parts)


def stairs(random: Random, width: float) -> Mesh:
    """Return steps that rise towards +y to a landing, between cheeks or rails."""
    rise, going = random.uniform(0.14, 0.18), random.uniform(0.28, 0.38)
    count, x = int(random.integers(3, 16)), width / 2
    step, high, run = np.arange(count), count * rise, count * going
    end = run + random.uniform(1, 2.5)
    name = _pick(random, "stone", "paving", _wall_name(random))
    stop = np.r_[step[1:] * going, end]
    parts = [boxes((-x, step * going, 0), (x, stop, (step + 1) * rise), name, NO_BACK)]
    parts.append(boxes((-x, end - 0.01, 0), (x, end, high), name, (3,)))
    side, rail = random.random(), random.uniform(0.2, 0.9)
    if side < 0.45:
        profile = [(0, 0), (end, 0), (end, high + rail), (run, high + rail), (0, rail)]
        parts += [_prism(profile, at, at + 0.3, name) for at in (-x - 0.3, x)]
    elif side < 0.85:
        line = [(0, rise + 0.84), (run, high + rise + 0.84)]
        bar = [*line, *((y, z + 0.06) for y, z in line[::-1])]
        at, foot = np.array([[-x + 0.1], [x - 0.15]]), step[::2] * going + 0.1
        tops = (step[::2] + 1) * rise + 0.9
        parts.append(boxes((at, foot, 0), (at + 0.05, foot + 0.05, tops), "metal", BAR))
        parts += [_prism(bar, of, of + 0.05, "metal") for of in at.ravel()]
    return joined(parts).moved((0, -end / 2, 0))


def arcade(random: Random, length: float) -> Mesh:
    """Return a colonnade along x, centred: arches or lintels on piers or columns, roofed behind."""
    bays = max(2, round(length / random.uniform(2.4, 4.5)))
    cell, high = length / bays, random.uniform(3, 5)
    name, thick = _pick(random, "stone", "trim", _wall_name(random)), random.uniform(0.45, 0.8)
    slim = _chance(random, 0.5)
    curve = (ROUND, ROUND, FLAT, POINTED, SEGMENT)[random.integers(5)]
    edges = _cells(length, bays, 1 - thick / cell)
    rise = (edges[0, 1] - edges[0, 0]) / 2 * curve[:, 1].max()
    high = max(high, rise + 1.8)
    spring, full = high - rise, high + random.uniform(0.4, 1)
    low, deep = spring if slim else 0.0, random.uniform(2, 4.5)
    at = np.linspace(0, length, bays + 1)[1:-1] - length / 2
    parts = [_columns(at, thick, spring, name)] if slim else []
    if slim:
        ends = np.array([-length / 2, length / 2 - thick / 2])
        parts.append(boxes((ends, -thick / 2, 0), (ends + thick / 2, thick / 2, low), name))
    parts.append(_through((length, low, full, thick), edges, low, high, name, curve))
    x, y = length / 2, thick / 2
    parts.append(boxes((-x, -y - 0.2, full), (x, deep, full + 0.25), "trim"))
    if _chance(random, 0.6):
        back = _wall_name(random)
        parts.append(boxes((-x, deep - 0.3, 0), (x, deep, full), back))
        parts.append(boxes((-x - 0.2, -y - 0.4, 0), (x + 0.2, deep + 0.2, 0.05), "paving"))
    if _chance(random, 0.4):
        lean = [(-y, full + 0.25), (deep, full + 0.25), (deep, full + 0.25 + deep * 0.4)]
        parts.append(_prism(lean, -x, x, _roof_name(random)))
    return joined(parts)


def _columns(at: np.ndarray, thick: float, height: float, name: str) -> Mesh:
    """Return round columns along x with a base and a capital each."""
    r, t = thick * 0.34, thick / 2
    shaft = _lathe([r, r, r * 0.84], [0.2, height * 0.35, height - 0.15], name, 12)
    parts = [shaft.moved((x, 0, 0)) for x in at]
    parts.append(boxes((at - t, -t, 0), (at + t, t, 0.2), name))
    parts.append(boxes((at - t, -t, height - 0.2), (at + t, t, height), name))
    return joined(parts)


def street_surface(width: float, length: float, random: Random) -> Mesh:
    """Return a carriageway of the width between its kerbs, from y = 0 to the length.

    The pavements stand beside it, outside the width; the asphalt is ``ROAD`` above the ground.
    """
    half, edge, top = width / 2, 0.15, ROAD + KERB
    parts = [_level(-half, half, 0, length, ROAD, "asphalt")]
    for side in (-1, 1):
        wide = random.uniform(1.5, 4)
        a, b = sorted((side * half, side * (half + edge)))
        c, d = sorted((side * (half + edge), side * (half + edge + wide)))
        parts.append(boxes((a, 0, 0), (b, length, top), "kerb"))
        parts.append(boxes((c, 0, 0), (d, length, top - 0.005), "paving"))
        gully = np.arange(random.uniform(2, 15), length - 1, 20)
        x = side * (half - 0.25)
        parts.append(_level(x - 0.2, x + 0.2, gully, gully + 0.45, ROAD + 0.003, "metal"))
    return joined(parts + _lines(random, half, length))


def _lines(random: Random, half: float, length: float) -> list[Mesh]:
    """Return painted lines: dashes, edges, a crossing, bays for parking."""
    dash, gap = random.uniform(1.5, 4), random.uniform(1.5, 6)
    y, parts, t = np.arange(random.uniform(0, 4), length - dash, dash + gap), [], 0.06
    if _chance(random, 0.75):
        parts.append(_level(-t, t, y, y + dash, PAINT, "line"))
    elif _chance(random, 0.5):
        x = np.array([-0.15, 0.15])
        parts.append(_level(x - t, x + t, 0, length, PAINT, "line"))
    if _chance(random, 0.4):
        x = np.array([0.35 - half, half - 0.35])
        parts.append(_level(x - t, x + t, 0, length, PAINT, "line"))
    if _chance(random, 0.4) and length > 8:
        x, at = np.arange(0.5 - half, half - 0.5, 1.0), random.uniform(2, length - 6)
        parts.append(_level(x, x + 0.5, at, at + 3, PAINT + 0.004, "line"))
    if half > 3.5 and _chance(random, 0.35):
        side, y = random.choice([-1, 1]), np.arange(1, length, random.uniform(5, 6))
        inner, outer = sorted((side * (half - 2.1), side * (half - 0.02)))
        parts.append(_level(inner, outer, y, y + 0.1, PAINT + 0.002, "line"))
    return parts
