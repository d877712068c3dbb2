"""Churches: a nave, an apse, a steeple."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from training.worlds.buildings.facades import course, facade, four_walls, set_around
from training.worlds.buildings.roofs import crenels, gable_roof
from training.worlds.buildings.shapes import QUARTER, boxes, facing_up, frustum, lathe, quads
from training.worlds.buildings.style import Style, pick, roof_name, wall_name
from training.worlds.mesh import Mesh, Random, joined


def church(random: Random) -> Mesh:
    """Return a church: a nave along y with a steeple before it."""
    width, length, height = random.uniform(7, 12), random.uniform(14, 28), random.uniform(5, 10)
    wall, roof = pick(random, "stone", wall_name(random)), roof_name(random)
    style = Style(
        wall,
        wall,
        4,
        0.34,
        0.25,
        0.85,
        recess=0.3,
        curve=pick(random, "pointed", "round"),
        detail=2,
    )
    parts = four_walls(
        random, width, length, height, 1, replace(style, cell=random.uniform(3, 4.5))
    )
    rise = random.uniform(0.8, 1.4) * width / 2
    gable = joined(gable_roof(length, width, rise, (0.4, 0.2), (roof, wall)))
    parts.append(gable.moved((0, 0, height), QUARTER))
    bays = max(1, round(length / 4))
    y = (np.arange(bays + 1) / bays - 0.5) * (length - 0.6)
    for x in (-width / 2 - 0.8, width / 2):
        parts.append(boxes((x, y - 0.3, 0), (x + 0.8, y + 0.3, height * 0.75), wall))
    apse = [
        lathe([width * 0.38] * 2, [0, height * 0.8], wall),
        lathe([width * 0.42, 0], [height * 0.8, height + rise / 2], roof),
    ]
    parts += [of.moved((0, length / 2, 0)) for of in apse]
    side = pick(random, "middle", "middle", "left")
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
    parts = set_around([front, other, other, other], side, side)
    for level in range(1, floors + 1):
        parts.append(course(side, side, height * level / floors - 0.2, 0.25, 0.12, True))
    spire, over = random.uniform(0.6, 2.6) * side, side + 0.5
    kind = random.random()
    if kind < 0.4:
        parts.append(frustum((over, over), (0, 0), spire, roof).moved((0, 0, height + 0.05)))
    elif kind < 0.75:
        eight = lathe([side * 0.5, 0], [0, spire * 1.2], roof, 8)
        flat = quads(eight.vertices[eight.faces], roof)
        parts += [
            flat.moved((0, 0, height), QUARTER / 4),
            facing_up(*[-side / 2, side / 2] * 2, height + 0.06, "stone"),
        ]
    else:
        parts += [of.moved((0, 0, height + 0.05)) for of in crenels(side, side)]
    return joined(parts)
