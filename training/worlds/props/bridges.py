"""Piers and bridges."""

from __future__ import annotations

import numpy as np

from training.worlds.mesh import Mesh, Random, box, joined, tube
from training.worlds.props.shapes import copies, loft


def pier(random: Random, length: float) -> Mesh:
    """Return a wooden deck along x about the origin, 1 m over z = 0, on piles that go below."""
    wide, deck, board = random.uniform(1.4, 3), random.uniform(0.8, 1.2), max(0.2, length / 150)
    x = np.arange(-length / 2 + board / 2, length / 2, board)
    boards = copies(box(board * 0.92, wide, 0.05, "wood"), np.stack([x, 0 * x, 0 * x + deck], -1))
    beam = box(length, 0.12, 0.2, "wood")
    beams = copies(beam, np.array([[0, s * wide * 0.42, deck - 0.2] for s in (-1, 1)]))
    at = np.linspace(-length / 2 + 0.3, length / 2 - 0.3, max(2, round(length / 2.5)))
    top = deck + random.choice([-0.1, 0.35, 0.9])
    pile = tube([[0, 0, -3], [0, 0, top]], [0.13, 0.12], "wood", 7)
    places = np.array([[i, s * (wide / 2 + 0.1), 0] for i in at for s in (-1, 1)])
    parts = [boards, beams, copies(pile, places)]
    if top > deck + 0.8:
        rail = box(length, 0.08, 0.08, "wood")
        parts.append(copies(rail, np.array([[0, s * (wide / 2 + 0.1), top] for s in (-1, 1)])))
    return joined(parts)


def bridge(random: Random, length: float) -> Mesh:
    """Return a humped stone bridge along x about the origin, of arches that stand on z = 0."""
    spans, wide = max(1, round(length / random.uniform(7, 11))), random.uniform(2, 4)
    t = np.linspace(0, 1, 14 * spans + 1)
    rise = min(3.5, 0.3 * length / spans) * random.uniform(0.8, 1.1)
    arch = np.sqrt(np.maximum(0, 1 - (np.minimum(np.abs((t * spans) % 1 - 0.5) / 0.44, 1)) ** 2))
    top = rise + 0.6 + 0.05 * length * (np.sin(np.pi * t) - 0.5)
    low = np.minimum(rise * arch, top - 0.3) - 0.5 * (arch == 0)
    sides = ((-1, low), (1, low), (1, top), (-1, top))
    rings = [np.stack([(t - 0.5) * length, 0 * t + s * wide / 2, z], -1) for s, z in sides]
    walls = []
    for side in (-1, 1):
        corners = ((side - 0.12, 0), (side + 0.12, 0), (side + 0.12, 0.85), (side - 0.12, 0.85))
        wall = [
            np.stack([(t - 0.5) * length, 0 * t + y * wide / 2, top - 0.05 + z], -1)
            for y, z in corners
        ]
        walls.append(loft(np.stack(wall, 1), "stone", ends=True))
    return joined([loft(np.stack(rings, 1), "stone", ends=True), *walls])
