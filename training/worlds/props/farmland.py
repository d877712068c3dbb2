"""What stands in open country: fences, poles and wires, bales, wind turbines."""

from __future__ import annotations

import numpy as np

from training.worlds.mesh import Mesh, Random, ball, box, joined, tube
from training.worlds.props.shapes import TURN, copies, limbs_along, loft, lumpy


def fence(random: Random, length: float) -> Mesh:
    """Return a fence along x about the origin: rails, pickets or wire, 0.8-1.5 m."""
    kind, height = str(random.choice(["rails", "pickets", "wire"])), random.uniform(0.8, 1.5)
    gap = random.uniform(1.6, 2.6)
    x = np.linspace(-length / 2, length / 2, max(2, round(length / gap) + 1))
    posts = np.stack([x, 0 * x, 0 * x], -1)
    rows = {"rails": np.array([0.35, 0.62, 0.88]), "pickets": np.array([0.25, 0.75]),
            "wire": np.array([0.3, 0.5, 0.7, 0.9])}[kind]  # fmt: skip
    rails = np.stack([0 * rows, 0 * rows - 0.05, rows * height], -1)
    post = box(0.1, 0.1, height * 1.04, "wood")
    rail = box(length, 0.04, 0.1, "wood") if kind != "wire" else box(length, 0.008, 0.008, "metal")
    parts = [copies(post, posts), copies(rail, rails)]
    if kind == "pickets":
        x = np.arange(-length / 2 + 0.08, length / 2, 0.14)
        parts.append(
            copies(
                box(0.085, 0.025, height * 0.95, "wood"),
                np.stack([x, 0 * x - 0.09, 0 * x + 0.05], -1),
            )
        )
    return joined(parts)


def utility_pole(random: Random) -> Mesh:
    """Return a wooden pole with one or two cross arms along y, 7-11 m."""
    height, arms = random.uniform(7, 11), int(random.integers(1, 3))
    parts = [tube([[0, 0, 0], [0, 0, height]], [0.15, 0.1], "wood", 8)]
    for z in height - 0.35 - 0.9 * np.arange(arms):
        pins = np.array([[0.12, y, z + 0.14] for y in (-0.85, -0.45, 0.45, 0.85)])
        parts.append(box(0.1, 2.0, 0.12, "wood").moved((0.12, 0, z)))
        parts.append(copies(box(0.07, 0.07, 0.14, "stone"), pins))
    if random.random() < 0.4:  # a transformer
        drum = tube([[-0.35, 0, height - 2.2], [-0.35, 0, height - 1.3]], [0.22, 0.22], "metal", 8)
        parts.append(drum)
    return joined(parts)


def power_line(a: np.ndarray, b: np.ndarray, sag: float, radius: float = 0.02) -> Mesh:
    """Return a wire from ``a`` to ``b`` that hangs ``sag`` metres at its middle."""
    t = np.linspace(0, 1, 17)[:, None]
    path = np.asarray(a) * (1 - t) + np.asarray(b) * t - 4 * sag * t * (1 - t) * [0, 0, 1]
    return limbs_along(path, np.full(17, radius), "rubber", 3)


def hay_bale(random: Random) -> Mesh:
    """Return a round bale on its side (axis along y) or a square one."""
    if random.random() < 0.3:
        return box(
            random.uniform(0.9, 2.2),
            random.uniform(0.5, 0.9),
            random.uniform(0.4, 0.9),
            "dry_grass",
        )
    radius, half = random.uniform(0.55, 0.8), random.uniform(0.55, 0.65)
    path = np.array([[0, y, 0] for y in (-half, -half * 0.93, half * 0.93, half)])
    bale = limbs_along(path, radius * np.array([0.93, 1, 1, 0.93]), "dry_grass", 18, ends=True)
    return lumpy(random, bale, 0.012).moved((0, 0, radius * 0.97))


def wind_turbine(random: Random, name: str = "paint") -> Mesh:
    """Return a wind turbine that faces +x, its hub 60-120 m up."""
    height = random.uniform(60, 120)
    reach, turn = height * random.uniform(0.4, 0.55), random.uniform(0, TURN)
    t = np.array([0, 0.06, 0.2, 0.6, 1.0])
    wide = reach * np.array([0.016, 0.016, 0.034, 0.018, 0.004])
    section = np.array([[0.25, 0.5], [-0.25, 0.5], [-0.12, -1.4], [0.12, -1.4]])  # x, across
    parts = [
        tube([[0, 0, 0], [0, 0, height]], [height * 0.025, height * 0.014], name, 14),
        box(height * 0.1, height * 0.035, height * 0.04, name).moved(
            (0, 0, height - height * 0.02)
        ),
        ball(height * 0.02, name, 6, 10).moved((height * 0.055, 0, height), scaled=(1.4, 1, 1)),
    ]
    for angle in turn + np.arange(3) * TURN / 3:
        out = np.array([0, np.cos(angle), np.sin(angle)])
        across = np.array([0, -np.sin(angle), np.cos(angle)])
        rings = [
            [reach * s * out + w * (x * np.array([1.0, 0, 0]) + y * across) for x, y in section]
            for s, w in zip(t, wide, strict=True)
        ]
        blade = loft(rings, name, ends=True)
        parts.append(blade.moved((height * 0.06, 0, height)))
    return joined(parts)
