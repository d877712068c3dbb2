"""Castles, whole or in ruins: walls with a gate, towers."""

from __future__ import annotations

import numpy as np

from training.worlds.buildings.facades import facade, set_around
from training.worlds.buildings.openings import POINTED, ROUND, pierced_through
from training.worlds.buildings.roofs import crenels
from training.worlds.buildings.shapes import NO_BACK, boxes, drum, lathe, ring
from training.worlds.buildings.style import Style, chance, roof_name
from training.worlds.mesh import Mesh, Random, joined


def castle_wall(random: Random) -> Mesh:
    """Return a castle's wall along x, centred, with crenels or a broken top, gate and towers."""
    length, height, thick = random.uniform(12, 34), random.uniform(4, 8), random.uniform(1.2, 2.5)
    gate, high = random.uniform(2, 3.6), random.uniform(0.5, 0.8) * height
    at = length / 2 + random.uniform(-0.3, 0.3) * length
    edges = np.array([[at - gate / 2, at + gate / 2]])
    curve = ROUND if chance(random, 0.5) else POINTED
    parts = [pierced_through((length, 0, height, thick), edges, 0, high, "stone", curve)]
    count = round(length / random.uniform(0.7, 1.1)) | 1
    tops = random.uniform(0.7, 1.1) * (np.arange(count) % 2 == 0) + 0.3
    if chance(random, 0.35):
        tops = np.maximum(_worn(random, count, -0.4, height * 0.4), 0.02)
    x, deep = np.linspace(-length / 2, length / 2, count + 1), thick * random.uniform(0.3, 0.6)
    low = (x[:-1], -thick / 2 - 0.02, height - 0.05)
    parts.append(boxes(low, (x[1:], deep - thick / 2, height + tops), "stone"))
    if chance(random, 0.6):
        scale = min(1, height / 7)
        ends = (-length / 2, length / 2)
        parts += [castle_tower(random).moved((end, 0, 0), scaled=scale) for end in ends]
    return joined(parts)


def castle_tower(random: Random) -> Mesh:
    """Return a stone tower, round or square, whole with crenels or a ruin."""
    radius, height = random.uniform(2.4, 4.2), random.uniform(8, 15)
    if chance(random, 0.35):
        return ring(radius, 0.9, np.zeros(24), _worn(random, 24, height * 0.25, height))
    if chance(random, 0.4):
        style = Style("stone", "stone", share=0.13, sill=0.4, head=0.75, recess=0.5, detail=0)
        side, tall = radius * 1.8, max(2, int(height / 4))
        parts = set_around([facade(random, side, height, 1, tall, style)] * 4, side, side)
        parts.append(
            boxes(
                (-side / 2 - 0.3, -side / 2 - 0.3, height - 0.6),
                (side / 2 + 0.3, side / 2 + 0.3, height),
                "stone",
            )
        )
        return joined(parts + [of.moved((0, 0, height)) for of in crenels(side + 0.6, side + 0.6)])
    body = [lathe([radius * 1.12, radius], [0, height], "stone", 24)]
    top = drum(radius + 0.35, 0.7, "stone", 24).moved((0, 0, height - 0.5))
    merlons = ring(radius + 0.35, 0.5, np.full(24, 0.15), np.where(np.arange(24) % 2, 1.1, 0.35))
    for turn, z in zip(random.uniform(0, 6.3, 4), height * np.linspace(0.2, 0.8, 4), strict=True):
        slit = boxes(
            (-0.14, -radius * 1.12 - 0.02, -0.6), (0.14, -radius * 0.8, 0.6), "glass", NO_BACK
        )
        body.append(slit.moved((0, 0, z), turn))
    if chance(random, 0.3):
        body.append(lathe([radius + 0.3, 0], [height + 0.3, height * 1.5], roof_name(random)))
    return joined([*body, top, merlons.moved((0, 0, height))])


def _worn(random: Random, count: int, low: float, high: float) -> np.ndarray:
    """Return heights of a ruin's top, close ones alike."""
    steps = np.cumsum(np.cumsum(random.normal(0, 1, count)) * 0.6 + random.normal(0, 1, count))
    steps -= np.linspace(0, steps[-1], count)
    return low + (high - low) * (steps - steps.min()) / (np.ptp(steps) + 1e-6)
