"""What stands in streets and parks: lamps, benches, signs, bollards, café tables."""

from __future__ import annotations

import numpy as np

from training.worlds.mesh import Mesh, Random, box, joined, tube
from training.worlds.props.shapes import TURN, copies, limbs_along, loft, ovals


def lamp_post(random: Random) -> Mesh:
    """Return a street lamp: a tall one with an arm along +x, or a lantern on a post."""
    if random.random() < 0.5:
        height, reach = random.uniform(5, 9), random.uniform(0.8, 1.8)
        arm = [[0, 0, height * 0.9], [reach * 0.12, 0, height * 0.97], [reach, 0, height]]
        return joined([
            tube([[0, 0, 0], [0, 0, height * 0.92]], [0.11, 0.06], "metal", 7),
            limbs_along(arm, np.array([0.05, 0.045, 0.04]), "metal", 5, ends=True),
            box(0.6, 0.24, 0.1, "metal").moved((reach + 0.2, 0, height - 0.02)),
            box(0.45, 0.18, 0.03, "lamp").moved((reach + 0.22, 0, height - 0.05)),
        ])  # fmt: skip
    height = random.uniform(2.6, 4)
    post = np.array([[0, 0, 0], [0, 0, 0.35], [0, 0, 0.4], [0, 0, height]])
    lantern = [(height, 0.07), (height + 0.4, 0.17)]
    return joined([
        tube(post, [0.13, 0.11, 0.06, 0.045], "metal", 8),
        ovals(lantern, "lamp", 1, 6),
        ovals([(height + 0.4, 0.21), (height + 0.55, 0.06), (height + 0.65, 0.01)], "metal", 1, 6),
    ])  # fmt: skip


def bench(random: Random) -> Mesh:
    """Return a bench along x that faces -y, with a back or without."""
    length, seat = random.uniform(1.3, 2.2), random.uniform(0.42, 0.48)
    name = str(random.choice(["wood", "wood", "stone"]))
    legs = np.array([[x * length * 0.4, 0, 0] for x in (-1, 1)])
    foot = box(0.08, 0.42, seat, "metal" if name == "wood" else "stone")
    if name == "stone":
        return joined(
            [
                copies(foot.moved(scaled=(2, 1, 1)), legs),
                box(length, 0.5, 0.1, name).moved((0, 0, seat)),
            ]
        )
    slats = np.array([[0, y, seat] for y in (-0.18, -0.06, 0.06, 0.18)])
    parts = [copies(foot, legs), copies(box(length, 0.1, 0.035, "wood"), slats)]
    if random.random() < 0.75:
        backs = np.array([[0, 0.24 + 0.05 * i, seat + 0.15 + 0.15 * i] for i in range(3)])
        parts.append(copies(box(length, 0.03, 0.11, "wood"), backs))
        stay = limbs_along([[0, 0.2, seat], [0, 0.38, seat + 0.55]], np.full(2, 0.03), "metal")
        parts.append(copies(stay, legs))
    return joined(parts)


def sign(random: Random) -> Mesh:
    """Return a road sign or a notice that faces -y."""
    height, radius = random.uniform(1.9, 2.6), random.uniform(0.28, 0.42)
    sides = int(random.choice([3, 4, 8, 16]))
    angles = np.arange(sides) * TURN / sides + (np.pi / 2 if sides == 3 else np.pi / sides)
    wide = random.uniform(1, 1.8) if sides == 4 else 1
    rim = np.stack([np.cos(angles) * wide, 0 * angles, np.sin(angles)], -1) * radius
    plate = loft(np.stack([rim, rim - [0, 0.03, 0]]), "paint", ends=True)
    posts = [-0.7, 0.7] if wide > 1.4 else [0]
    pole = tube([[0, 0, 0], [0, 0, height + radius * 0.6]], [0.035, 0.035], "metal", 6)
    places = np.array([[x * radius, 0, 0] for x in posts])
    return joined([plate.moved((0, -0.04, height)), copies(pole, places)])


def bollard(random: Random) -> Mesh:
    """Return a bollard, 0.6-1.1 m."""
    height, radius = random.uniform(0.6, 1.1), random.uniform(0.06, 0.16)
    name = str(random.choice(["metal", "stone", "plastic"]))
    rows = [(0, 1.15), (0.06, 1.0), (0.75, 0.9), (0.78, 1.1), (0.92, 1.1), (1.0, 0.5)]
    return ovals([(up * height, wide * radius) for up, wide in rows], name, 1, 9)


def umbrella(random: Random) -> Mesh:
    """Return a café table with a parasol and some chairs."""
    height, reach, table = (
        random.uniform(2.2, 2.8),
        random.uniform(1.1, 1.8),
        random.uniform(0.35, 0.5),
    )
    sides, cloth = int(random.choice([4, 6, 8])), str(random.choice(["cloth", "cloth2", "sail"]))
    parts = [
        ovals([(height - 0.62, reach), (height - 0.5, reach), (height, 0.04)], cloth, 1, sides),
        tube([[0, 0, 0], [0, 0, height]], [0.025, 0.02], "metal", 6),
        tube([[0, 0, 0], [0, 0, 0.06]], [0.25, 0.22], "metal", 8),
        ovals([(0.7, table), (0.74, table)], "wood", 1, 12),
    ]
    parts[0] = loft(parts[0].vertices[: 3 * sides].reshape(3, sides, 3), cloth)
    seats = np.array([[x * 0.18, y * 0.18, 0] for x in (-1, 1) for y in (-1, 1)])
    chair = joined([
        copies(box(0.03, 0.03, 0.44, "metal"), seats),
        box(0.42, 0.42, 0.04, "plastic").moved((0, 0, 0.44)),
        box(0.04, 0.42, 0.45, "plastic").moved((0.2, 0, 0.46)),
    ])  # fmt: skip
    for turn in random.uniform(0, TURN) + np.arange(int(random.integers(0, 5))) * TURN / 4:
        away = table + random.uniform(0.2, 0.4)
        parts.append(chair.moved((np.cos(turn) * away, np.sin(turn) * away, 0), turn))
    return joined(parts)
