"""Façades of windows, doors, shops and balconies, and the four walls they make."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from training.worlds.buildings.openings import (
    FLAT,
    POINTED,
    ROUND,
    SEGMENT,
    cells,
    glazing,
    ledges,
    pierced,
)
from training.worlds.buildings.shapes import (
    BAR,
    NO_BACK,
    QUARTER,
    Values,
    boxes,
    prism,
    quads,
    upright,
)
from training.worlds.buildings.style import DETAIL, Style, chance, pick
from training.worlds.mesh import Mesh, Random, joined

MOST_SHOPS = 8  # of one façade

_CURVES = {"flat": FLAT, "round": ROUND[::2], "segment": SEGMENT, "pointed": POINTED[::2]}


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
        parts += _balconies(random, cells(width, columns, style.share), levels, style)
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
    edges = cells(width, columns, style.share)
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
    parts += glazing(random, left, right, bottoms, tops, style)
    if door >= 0:
        parts += glazing(random, *edges[door], low, tops[0], replace(style, detail=2), "wood")
    if style.detail >= DETAIL and left.size:
        parts.append(ledges(left, right, bottoms))
        if style.hood:
            parts.append(ledges(left, right, tops + 0.2, 0.2))
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
    parts += glazing(random, left, right, sill, head, look)
    left, right = edges[1::2].T
    fill = pick(random, "glass", "wood")
    parts += glazing(random, left, right, 0.02, head, replace(look, bars=(1, 1)), fill)
    for x in at.ravel():
        parts += _shop_front(random, x + 0.04 * cell, x + 0.96 * cell, head, height)
    return parts


def _shop_front(random: Random, x0: float, x1: float, head: float, height: float) -> list[Mesh]:
    """Return the fascia of one shop and perhaps an awning."""
    name = pick(random, "awning", "wood", "trim", "metal")
    parts = [boxes((x0, -0.14, head + 0.05), (x1, 0, height - 0.2), name, NO_BACK)]
    if chance(random, 0.45):
        out, drop = random.uniform(0.8, 1.6), random.uniform(0.4, 0.8)
        z = head + 0.02
        profile = [(-out, z - drop - 0.2), (-out + 0.03, z - drop - 0.2), (0, z - 0.04), (0, z)]
        parts.append(prism([*profile, (-out, z - drop)], x0, x1, "awning"))
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
    name = pick(random, "metal", "metal", "glass", "trim", "awning", "wood")
    x0, x1, z = np.broadcast_arrays(x0, x1, z)
    parts = [boxes((x0, -out, z - 0.16), (x1, 0, z), pick(random, "trim", "stone"), NO_BACK)]
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


def set_around(sides: Sequence[Mesh], width: float, depth: float) -> list[Mesh]:
    """Return front, right, back and left set around a rectangle."""
    x, y = width / 2, depth / 2
    at = ((-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0))
    return [side.moved(at[i], i * QUARTER) for i, side in enumerate(sides)]


def four_walls(
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
    blank = quads(upright(0, depth, 0, height), style.wall)
    for of, columns in ((depth, short), (width, long), (depth, short)):
        shown = detached or of == width
        sides.append(facade(random, of, height, columns, floors, back) if shown else blank)
    return set_around(sides, width, depth)


def course(width: float, depth: float, z: float, high: float, out: float, detached: bool) -> Mesh:
    """Return a cornice or a string course, along the front only unless detached."""
    x, y = width / 2, depth / 2
    if detached:
        return boxes((-x - out, -y - out, z), (x + out, y + out, z + high), "trim")
    return boxes((-x, -y - out, z), (x, -y, z + high), "trim", NO_BACK)
