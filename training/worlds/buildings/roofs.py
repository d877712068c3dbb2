"""Roofs on a rectangle centred on the origin, from z = 0 up: with dormers, chimneys, crenels."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np

from training.worlds.buildings.facades import facade
from training.worlds.buildings.shapes import QUARTER, boxes, end_faces, facing_up, frustum, prism
from training.worlds.buildings.style import Style, chance, pick, roof_name
from training.worlds.mesh import Mesh, Random, box, joined

SLAB = 0.16  # thickness of a pitched roof


def gable_roof(
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
    parts = [prism(gable, -width / 2, width / 2, names[1])]
    for (a, b), (c, d) in itertools.pairwise(line):
        b, d = b + 0.01, d + 0.01
        for side in (1, -1):
            profile = [(side * a, b), (side * c, d), (side * c, d + SLAB), (side * a, b + SLAB)]
            parts.append(prism(profile[::side], -x, x, names[0]))
    return parts


def _hip(width: float, depth: float, rise: float, over: float, roof: str) -> list[Mesh]:
    """Return a hip roof on a soffit that stands over the walls."""
    w, d = width + 2 * over, depth + 2 * over
    ridge = (max(0.0, w - d), max(0.0, d - w))
    eave = boxes((-w / 2, -d / 2, 0), (w / 2, d / 2, 0.15), "trim")
    return [eave, frustum((w + 0.05, d + 0.05), ridge, rise, roof).moved((0, 0, 0.15))]


def flat_roof(random: Random, width: float, depth: float, wall: str) -> list[Mesh]:
    """Return a flat roof with a parapet, its coping and what stands there."""
    x, y, t = width / 2, depth / 2, 0.25
    h = random.uniform(0.3, 1.1)
    parts = [facing_up(-x, x, -y, y, 0, "asphalt")]
    for out, low, high, name in ((0.0, 0.0, h, wall), (0.06, h, h + 0.1, "trim")):
        a, b, o = x + out, y + out, t + 2 * out
        x0, x1 = np.array([-a, -a, -a, a - o]), np.array([a, a, -a + o, a])
        y0, y1 = np.array([-b, b - o, -b + o, -b + o]), np.array([-b + o, b, b - o, b - o])
        parts.append(boxes((x0, y0, low), (x1, y1, high), name))
    for _ in range(random.integers(0, 5)):
        w, d, z = random.uniform(0.8, 2.5), random.uniform(0.8, 2), random.uniform(0.6, 2.4)
        cx, cy = (random.uniform(-0.7, 0.7) * (of - 1.3) for of in (x, y))
        parts.append(box(w, d, z, pick(random, "metal", "trim", wall)).moved((cx, cy, 0)))
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
    top = joined(gable_roof(deep, w, rise, (0.12, 0.15), (roof, style.wall)))
    return joined(
        [
            facade(random, w, h, 1, 1, look).moved((-x, 0, 0)),
            end_faces(x, 0, deep, 0, h, style.wall),
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
    roof, rise, run = roof_name(random), random.uniform(2.1, 2.8), random.uniform(0.7, 1.4)
    y, top = depth / 2, random.uniform(0.4, 1.4)
    if detached:
        w, d = width - 2 * run, depth - 2 * run
        parts = [frustum((width, depth), (w, d), rise, roof)]
        parts.append(frustum((w, d), (w * 0.5, d * 0.2), top, roof).moved((0, 0, rise)))
    else:
        profile = [(-y, 0), (y, 0), (y - run, rise), (0, rise + top), (run - y, rise)]
        parts = [prism(profile, -width / 2, width / 2, roof)]
    slope, inner = rise / run, width - 2 * run * detached
    parts += _dormers(random, inner, -y + 0.35 / slope, 0.3, slope, style, roof)
    return [*parts, _stack(random, width, rise + top, style.wall)]


def _stack(random: Random, width: float, height: float, wall: str) -> Mesh:
    """Return a chimney that stands near the ridge."""
    tall = height + random.uniform(0.5, 1.3)
    x, y = random.uniform(-0.4, 0.4) * width, random.uniform(-0.6, 0.6)
    return _chimney(random, tall, wall).moved((x, y, 0))


def pitched_roof(
    random: Random, width: float, depth: float, style: Style, detached: bool, least: float
) -> list[Mesh]:
    """Return a gable or a hip roof with dormers and chimneys."""
    roof, over = roof_name(random), random.uniform(0.3, 0.8)
    slope = min(random.uniform(least, 1.15), 10 / depth)
    if detached and chance(random, 0.35):
        short = min(width, depth) / 2 + over
        parts = _hip(width, depth, slope * short, over, roof)
        return [*parts, _stack(random, 0.2 * width, slope * short, style.wall)]
    rise, verge = slope * depth / 2, over * 0.7 if detached else 0.0
    parts = gable_roof(width, depth, rise, (over, verge), (roof, style.wall), 0.3)
    if slope > 0.75 and style.detail > 0 and chance(random, 0.5):
        start = random.uniform(0.5, 0.9)
        parts += _dormers(
            random, width - 1.5, start - depth / 2, start * slope + 0.35, slope, style, roof
        )
    for _ in range(random.integers(0, 3)):
        parts.append(_stack(random, width, rise + 0.3, style.wall))
    return parts


def block_roof(
    random: Random, width: float, depth: float, style: Style, detached: bool
) -> list[Mesh]:
    """Return a block's roof."""
    kind = random.random()
    if kind < 0.4 or depth > 18:
        parts = flat_roof(random, width, depth, style.wall)
        if chance(random, 0.5):
            parts.append(_stack(random, width * 0.8, 1.5, style.wall))
        return parts
    if kind < 0.65:
        return _mansard(random, width, depth, style, detached)
    return pitched_roof(random, width, depth, style, detached, 0.4)


def crenels(width: float, depth: float, thick: float = 0.5, tall: float = 0.9) -> list[Mesh]:
    """Return merlons around a rectangle at z = 0 and its floor."""
    x, y = width / 2, depth / 2
    parts = [facing_up(-x, x, -y, y, 0.02, "stone")]
    for of, at, turned in ((width, y, 0.0), (depth, x, 1.0), (width, y, 2.0), (depth, x, 3.0)):
        count = max(2, round(of / 1.6))
        left = (np.arange(count) / count - 0.5) * of
        one = boxes((left, -at - 0.02, 0), (left + of / count / 2, thick - at, tall), "stone")
        parts.append(one.moved(turned=turned * QUARTER))
    return parts
