"""Office high-rises: curtain walls, strip windows, a podium with shops."""

from __future__ import annotations

import numpy as np

from training.worlds.buildings.facades import facade, set_around
from training.worlds.buildings.openings import cells, pierced
from training.worlds.buildings.roofs import flat_roof
from training.worlds.buildings.shapes import NO_BACK, boxes, quads, upright
from training.worlds.buildings.style import Style, chance, pick, wall_name
from training.worlds.mesh import Mesh, Random, box, joined

TOWER_FACES = 3000


def tower(random: Random) -> Mesh:
    """Return an office high-rise of 12 to 40 floors."""
    floors, storey = int(random.integers(12, 41)), random.uniform(3.3, 3.9)
    width, depth = random.uniform(16, 38, 2)
    look, wall = pick(random, "grid", "strip", "punched"), wall_name(random)
    seed, parts, z, wide = int(random.integers(2**32)), [], 0.0, random.uniform(1.1, 1.5)
    stages = [(1.0, floors)]
    if chance(random, 0.45):
        stages = [(1.0, int(floors * random.uniform(0.5, 0.8))), (random.uniform(0.6, 0.85), 0)]
        stages[1] = (stages[1][0], floors - stages[0][1])
    if chance(random, 0.5):
        podium = _lobby(random, width * wide, depth * wide, wall)
        parts, z = [podium], float(podium.vertices[:, 2].max()) - 0.5
    for scale, count in stages:
        w, d = width * scale, depth * scale
        share = count / floors
        walls = [
            _curtain(np.random.default_rng(seed), of, count, storey, look, wall, share)
            for of in (w, d, w, d)
        ]
        parts += [of.moved((0, 0, z)) for of in set_around(walls, w, d)]
        z += count * storey
        parts += [of.moved((0, 0, z)) for of in flat_roof(random, w, d, wall)]
    plant = (random.uniform(0.3, 0.6) * w, random.uniform(0.3, 0.6) * d)
    parts.append(box(*plant, random.uniform(2.5, 5), pick(random, "metal", wall)).moved((0, 0, z)))
    if chance(random, 0.3):
        parts.append(box(0.4, 0.4, random.uniform(8, 20), "metal").moved((0, 0, z)))
    return joined(parts)


def _lobby(random: Random, width: float, depth: float, wall: str) -> Mesh:
    """Return a tower's podium with shops all round."""
    style, height = Style(wall, wall, detail=1), random.uniform(4.5, 6)
    sides = [facade(random, of, height, 1, 1, style, "shop") for of in (width, depth) * 2]
    roof = box(width + 0.4, depth + 0.4, 0.5, "trim").moved((0, 0, height))
    return joined([*set_around(sides, width, depth), roof])


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
    rail = pick(random, "metal", "trim", wall)
    parts = [
        quads(upright(0, width, 0, height), "glass"),
        boxes((x - t / 2, -fins, 0), (x + t / 2, 0, height), rail, (2, 4, 5)),
        boxes((0, -bands, z[:-1]), (width, 0, z[:-1] + high), pick(random, rail, wall), NO_BACK),
    ]
    blind = random.random((floors, columns)) < 0.1
    i, j = np.nonzero(blind)
    drop = random.uniform(0.2, 0.9, len(i)) * (storey - high)
    panes = upright(x[j], x[j + 1], z[i + 1] - drop, z[i + 1], -0.02)[: int(150 * share)]
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
    edges = cells(width, columns, 1 - 0.6 / width if look == "strip" else fill)
    level, recess = np.arange(rows) * height / rows, random.uniform(0.2, 0.6)
    bottoms, tops = (level + low * height / rows)[:, None], level + high * height / rows
    left, right = edges.T
    parts = [
        pierced(width, 0, height, edges, bottoms, tops, recess, wall),
        quads(upright(left, right, bottoms, tops[:, None], recess), "glass"),
    ]
    if look == "strip":
        count = min(round(width / random.uniform(1.8, 4)), int(260 * share / rows))
        x = np.linspace(left[0], right[0], max(2, count) + 1)[1:-1]
        bars = upright(x - 0.06, x + 0.06, bottoms, tops[:, None], recess - 0.05)
    else:
        middle = (bottoms + tops[:, None]) / 2
        bars = upright(left, right, middle - 0.2, middle + 0.2, recess - 0.05)
    return joined([*parts, quads(bars, pick(random, "metal", "trim"))])
