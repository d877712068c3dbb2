"""Barns and sheds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from training.worlds.buildings.facades import facade, four_walls, set_around
from training.worlds.buildings.openings import glazing, pierced
from training.worlds.buildings.roofs import gable_roof
from training.worlds.buildings.shapes import NO_BACK, QUARTER, boxes, prism
from training.worlds.buildings.style import Style, chance, pick, roof_name, wall_name
from training.worlds.mesh import Mesh, Random, joined


def barn(random: Random) -> Mesh:
    """Return a barn with large doors, its ridge along y."""
    width, depth, height = random.uniform(8, 14), random.uniform(11, 24), random.uniform(3.2, 5.5)
    wall = pick(random, "wood", "wood", "metal", wall_name(random))
    style = Style(wall, wall, cell=5, share=0.25, sill=0.45, head=0.72, recess=0.1)
    gate, high = random.uniform(2.6, 4), random.uniform(2.6, height - 0.3)
    edges = np.array([[width - gate, width + gate]]) / 2
    front = [pierced(width, 0, height, edges, np.array([[0.0]]), np.array([high]), 0.2, wall)]
    if chance(random, 0.6):
        front += glazing(random, *edges[0], 0, high, replace(style, recess=0.12), "wood")
    others = [
        facade(random, of, height, max(1, round(of / 5)), 1, style) for of in (depth, width, depth)
    ]
    parts = set_around([joined(front), *others], width, depth)
    names, over = (roof_name(random), wall), (random.uniform(0.3, 0.8), random.uniform(0.2, 0.8))
    bend = (random.uniform(0.55, 0.7), random.uniform(0.6, 0.72)) if chance(random, 0.5) else None
    rise = random.uniform(0.6, 0.9 if bend else 0.7) * width / 2
    roof = joined(gable_roof(depth, width, rise, over, names, 0, bend))
    parts.append(roof.moved((0, 0, height), QUARTER))
    hatch = boxes(
        (-0.7, -depth / 2 - 0.06, height), (0.7, -depth / 2, height + 1.2), "trim", NO_BACK
    )
    return joined([*parts, hatch])


def shed(random: Random) -> Mesh:
    """Return a garden shed with a lean-to or a gable roof."""
    width, depth, height = random.uniform(1.8, 4), random.uniform(1.5, 3), random.uniform(1.9, 2.4)
    wall = pick(random, "wood", "wood", "metal", wall_name(random))
    style = Style(wall, wall, 1.6, 0.5, 0.45, 0.92, recess=0.06, frame=0.05, detail=2)
    parts = four_walls(random, width, depth, height, 1, style, "door", 0)
    names, over = (roof_name(random), wall), random.uniform(0.1, 0.3)
    if chance(random, 0.5):
        roof = gable_roof(width, depth, random.uniform(0.3, 0.6) * depth, (over, over), names)
    else:
        y, rise, x = depth / 2, random.uniform(0.15, 0.35) * depth, width / 2
        slope, e = rise / depth, y + over
        low, high = -slope * over + 0.01, rise + slope * over + 0.01
        slab = [(-e, high), (e, low), (e, low + 0.08), (-e, high + 0.08)]
        roof = [
            prism([(-y, 0), (y, 0), (-y, rise)], -x, x, wall),
            prism(slab, -x - over, x + over, names[0]),
        ]
    return joined(parts + [of.moved((0, 0, height)) for of in roof])
