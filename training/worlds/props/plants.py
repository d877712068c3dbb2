"""Bushes, hedges, grass and reeds."""

from __future__ import annotations

import numpy as np

from training.worlds.mesh import Mesh, Random, ball, box, joined, tube
from training.worlds.props.leaves import foliage, leaf_cards
from training.worlds.props.shapes import TURN, copies, raw

HEDGE_CARDS = 2400  # at most; they grow to cover a longer one


def bush(random: Random, leaves: str = "leaves") -> Mesh:
    """Return a bush, 0.5-2.2 m: leaf cards over a dark core."""
    height, count = random.uniform(0.5, 2.2), int(random.integers(2, 6))
    centres = random.normal(size=(count, 3)) * height * [0.3, 0.3, 0]
    centres[:, 2] = height * random.uniform(0.3, 0.5, count)
    radii = height * random.uniform(0.38, 0.52, (count, 1)) * [1, 1, 0.95]
    core = ball(1, "bark", 5, 8)
    cores = [core.moved(c, scaled=r * 0.6) for c, r in zip(centres, radii, strict=True)]
    return joined([*cores, foliage(random, centres, radii, 170, 0.05 + 0.08 * height, leaves)])


def hedge(random: Random, length: float) -> Mesh:
    """Return a trimmed hedge along x about the origin, 0.7-2 m high."""
    size = np.array([length, random.uniform(0.5, 1.0), random.uniform(0.7, 2.0)])
    area = np.array([size[1] * size[2], length * size[2], length * size[1] / 2])
    count = int(min(HEDGE_CARDS, 100 * area.sum()))
    places = random.uniform(-1, 1, (count, 3))
    axis = random.choice(3, count, p=area / area.sum())
    out = np.zeros((count, 3))
    out[np.arange(count), axis] = np.sign(places[np.arange(count), axis])
    out[:, 2] = np.abs(out[:, 2])
    places = np.where(out != 0, out * random.uniform(0.85, 1.04, (count, 1)), places)
    card = float(np.clip(np.sqrt(5.5 * area.sum() / count), 0.15, 0.5))
    cards = leaf_cards(
        random,
        places * size / 2 + [0, 0, size[2] / 2],
        card * random.uniform(0.6, 1.2, count),
        "leaves",
        1.2 * out,
    )
    return joined([box(length * 0.97, size[1] * 0.7, size[2] * 0.88, "leaves"), cards])


def grass_patch(
    random: Random, size: float = 1.0, height: float | None = None, name: str = "grass"
) -> Mesh:
    """Return 60-120 blades on a square of ``size`` metres about the origin."""
    height = random.uniform(0.08, 0.45) if height is None else height
    width = 0.008 + 0.025 * height + 0.006 * size
    return _blades(random, int(random.integers(60, 121)), size, height, width, name)


def reeds(random: Random, size: float = 1.0) -> Mesh:
    """Return reeds on a square of ``size`` metres, 1-2.2 m, some with a plume."""
    height, count = random.uniform(1.2, 2.2), int(random.integers(50, 100))
    leaves = _blades(random, count, size, height, 0.035, "reeds")
    tips = leaves.vertices.reshape(-1, 5, 3)[: count // 4, 4]
    plume = tube([[0, 0, -0.2], [0, 0, -0.05], [0, 0, 0.02]], [0.008, 0.018, 0.01], "dry_grass", 4)
    return joined([leaves, copies(plume, tips)])


def _blades(
    random: Random, count: int, size: float, height: float, width: float, name: str
) -> Mesh:
    """Return bent blades on a square of ``size``: a quad and a triangle each."""
    root = random.uniform(-size / 2, size / 2, (count, 3)) * [1, 1, 0]
    angle = random.uniform(0, TURN, count)
    side = np.stack([np.cos(angle), np.sin(angle), 0 * angle], -1) * width / 2
    tall = height * random.uniform(0.5, 1.0, (count, 1))
    bend = random.normal(size=(count, 3)) * [0.3, 0.3, 0] * tall
    middle, tip = root + [0, 0, 0.6] * tall + 0.3 * bend, root + [0, 0, 1] * tall + bend
    corners = np.stack([root - side, root + side, middle + 0.8 * side, middle - 0.8 * side, tip], 1)
    faces = np.arange(count)[:, None, None] * 5 + np.array([[0, 1, 2, 3], [3, 2, 4, 4]])
    return raw(corners, faces.reshape(-1, 4), name)
