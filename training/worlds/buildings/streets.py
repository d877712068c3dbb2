"""Streets with kerbs and painted lines, and what is built along them: walls, stairs, arcades."""

from __future__ import annotations

import numpy as np

from training.worlds.buildings.openings import FLAT, POINTED, ROUND, SEGMENT, cells, pierced_through
from training.worlds.buildings.shapes import BAR, NO_BACK, boxes, facing_up, lathe, prism
from training.worlds.buildings.style import chance, pick, roof_name, wall_name
from training.worlds.mesh import Mesh, Random, joined

KERB = 0.12
ROAD, PAINT = 0.02, 0.026  # heights above the ground


def street_surface(width: float, length: float, random: Random) -> Mesh:
    """Return a carriageway of the width between its kerbs, from y = 0 to the length.

    The pavements stand beside it, outside the width; the asphalt is ``ROAD`` above the ground.
    """
    half, edge, top = width / 2, 0.15, ROAD + KERB
    parts = [facing_up(-half, half, 0, length, ROAD, "asphalt")]
    for side in (-1, 1):
        wide = random.uniform(1.5, 4)
        a, b = sorted((side * half, side * (half + edge)))
        c, d = sorted((side * (half + edge), side * (half + edge + wide)))
        parts.append(boxes((a, 0, 0), (b, length, top), "kerb"))
        parts.append(boxes((c, 0, 0), (d, length, top - 0.005), "paving"))
        gully = np.arange(random.uniform(2, 15), length - 1, 20)
        x = side * (half - 0.25)
        parts.append(facing_up(x - 0.2, x + 0.2, gully, gully + 0.45, ROAD + 0.003, "metal"))
    return joined(parts + _lines(random, half, length))


def _lines(random: Random, half: float, length: float) -> list[Mesh]:
    """Return painted lines: dashes, edges, a crossing, bays for parking."""
    dash, gap = random.uniform(1.5, 4), random.uniform(1.5, 6)
    y, parts, t = np.arange(random.uniform(0, 4), length - dash, dash + gap), [], 0.06
    if chance(random, 0.75):
        parts.append(facing_up(-t, t, y, y + dash, PAINT, "line"))
    elif chance(random, 0.5):
        x = np.array([-0.15, 0.15])
        parts.append(facing_up(x - t, x + t, 0, length, PAINT, "line"))
    if chance(random, 0.4):
        x = np.array([0.35 - half, half - 0.35])
        parts.append(facing_up(x - t, x + t, 0, length, PAINT, "line"))
    if chance(random, 0.4) and length > 8:
        x, at = np.arange(0.5 - half, half - 0.5, 1.0), random.uniform(2, length - 6)
        parts.append(facing_up(x, x + 0.5, at, at + 3, PAINT + 0.004, "line"))
    if half > 3.5 and chance(random, 0.35):
        side, y = random.choice([-1, 1]), np.arange(1, length, random.uniform(5, 6))
        inner, outer = sorted((side * (half - 2.1), side * (half - 0.02)))
        parts.append(facing_up(inner, outer, y, y + 0.1, PAINT + 0.002, "line"))
    return parts


def wall(random: Random, length: float) -> Mesh:
    """Return a garden wall along x, centred, with a coping and perhaps piers or a railing."""
    height, thick = random.uniform(0.5, 2.2), random.uniform(0.2, 0.45)
    name, cap = pick(random, "stone", wall_name(random)), pick(random, "stone", "trim", "roof0")
    x, y = length / 2, thick / 2
    parts = [boxes((-x, -y, 0), (x, y, height), name)]
    parts.append(boxes((-x, -y - 0.05, height), (x, y + 0.05, height + 0.08), cap))
    top = height + 0.08
    if height < 1 and chance(random, 0.6):
        at = np.arange(-x + 0.1, x, 0.16)
        parts.append(boxes((at, -0.012, top), (at + 0.025, 0.012, top + 0.9), "metal", BAR))
        parts.append(boxes((-x, -0.02, top + 0.75), (x, 0.02, top + 0.8), "metal"))
        top += 0.9
    if chance(random, 0.6):
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
    name = pick(random, "stone", "paving", wall_name(random))
    stop = np.r_[step[1:] * going, end]
    parts = [boxes((-x, step * going, 0), (x, stop, (step + 1) * rise), name, NO_BACK)]
    parts.append(boxes((-x, end - 0.01, 0), (x, end, high), name, (3,)))
    side, rail = random.random(), random.uniform(0.2, 0.9)
    if side < 0.45:
        profile = [(0, 0), (end, 0), (end, high + rail), (run, high + rail), (0, rail)]
        parts += [prism(profile, at, at + 0.3, name) for at in (-x - 0.3, x)]
    elif side < 0.85:
        line = [(0, rise + 0.84), (run, high + rise + 0.84)]
        bar = [*line, *((y, z + 0.06) for y, z in line[::-1])]
        at, foot = np.array([[-x + 0.1], [x - 0.15]]), step[::2] * going + 0.1
        tops = (step[::2] + 1) * rise + 0.9
        parts.append(boxes((at, foot, 0), (at + 0.05, foot + 0.05, tops), "metal", BAR))
        parts += [prism(bar, of, of + 0.05, "metal") for of in at.ravel()]
    return joined(parts).moved((0, -end / 2, 0))


def arcade(random: Random, length: float) -> Mesh:
    """Return a colonnade along x, centred: arches or lintels on piers or columns, roofed behind."""
    bays = max(2, round(length / random.uniform(2.4, 4.5)))
    cell, high = length / bays, random.uniform(3, 5)
    name, thick = pick(random, "stone", "trim", wall_name(random)), random.uniform(0.45, 0.8)
    slim = chance(random, 0.5)
    curve = (ROUND, ROUND, FLAT, POINTED, SEGMENT)[random.integers(5)]
    edges = cells(length, bays, 1 - thick / cell)
    rise = (edges[0, 1] - edges[0, 0]) / 2 * curve[:, 1].max()
    high = max(high, rise + 1.8)
    spring, full = high - rise, high + random.uniform(0.4, 1)
    low, deep = spring if slim else 0.0, random.uniform(2, 4.5)
    at = np.linspace(0, length, bays + 1)[1:-1] - length / 2
    parts = [_columns(at, thick, spring, name)] if slim else []
    if slim:
        ends = np.array([-length / 2, length / 2 - thick / 2])
        parts.append(boxes((ends, -thick / 2, 0), (ends + thick / 2, thick / 2, low), name))
    parts.append(pierced_through((length, low, full, thick), edges, low, high, name, curve))
    x, y = length / 2, thick / 2
    parts.append(boxes((-x, -y - 0.2, full), (x, deep, full + 0.25), "trim"))
    if chance(random, 0.6):
        back = wall_name(random)
        parts.append(boxes((-x, deep - 0.3, 0), (x, deep, full), back))
        parts.append(boxes((-x - 0.2, -y - 0.4, 0), (x + 0.2, deep + 0.2, 0.05), "paving"))
    if chance(random, 0.4):
        lean = [(-y, full + 0.25), (deep, full + 0.25), (deep, full + 0.25 + deep * 0.4)]
        parts.append(prism(lean, -x, x, roof_name(random)))
    return joined(parts)


def _columns(at: np.ndarray, thick: float, height: float, name: str) -> Mesh:
    """Return round columns along x with a base and a capital each."""
    r, t = thick * 0.34, thick / 2
    shaft = lathe([r, r, r * 0.84], [0.2, height * 0.35, height - 0.15], name, 12)
    parts = [shaft.moved((x, 0, 0)) for x in at]
    parts.append(boxes((at - t, -t, 0), (at + t, t, 0.2), name))
    parts.append(boxes((at - t, -t, height - 0.2), (at + t, t, height), name))
    return joined(parts)
