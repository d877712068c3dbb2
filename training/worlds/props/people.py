"""People, and statues of them."""

from __future__ import annotations

import numpy as np

from training.worlds.mesh import Mesh, Random, ball, box, joined, tube
from training.worlds.props.shapes import copies, limbs_along, ovals, raw


def person(random: Random) -> Mesh:
    """Return someone who stands or walks towards +x, 1.5-1.95 m."""
    swing = random.uniform(0.2, 0.45) if random.random() < 0.6 else random.uniform(0, 0.08)
    sides, bend = np.array([-1, 1]), random.uniform(0, 0.6, 2)
    stride = swing * sides
    hips = np.stack([0 * sides, 0.085 * sides, 0 * sides + 0.92], -1)
    legs = _swung(hips, (0.43, 0.42), np.stack([stride, stride - swing * (stride < 0) - 0.03]))
    shoulders = np.stack([0 * sides, 0.195 * sides, 0 * sides + 1.42], -1)
    arms = _swung(shoulders, (0.29, 0.25), np.stack([-stride, -stride + 0.1 + bend]))
    arms[:, 1:, 1] += 0.05 * sides[:, None]
    torso = [(0.84, 0.15), (0.93, 0.17), (1.08, 0.145), (1.28, 0.17), (1.41, 0.185), (1.48, 0.07)]
    parts = [
        ovals(torso, "cloth", 0.62),
        limbs_along(legs, np.array([0.085, 0.062, 0.045]), "cloth2", 6),
        limbs_along(arms, np.array([0.06, 0.047, 0.034]), "cloth", 6),
        copies(box(0.25, 0.09, 0.09, "rubber"), legs[:, 2] + [0.06, 0, -0.06]),
        copies(ball(0.048, "skin", 4, 5), arms[:, 2] - [0, 0, 0.03]),
        tube([[0, 0, 1.44], [0, 0, 1.56]], [0.055, 0.05], "skin", 6),
        ball(0.1, "skin", 6, 8).moved((0.015, 0, 1.625), scaled=(0.98, 0.8, 1.2)),
        ball(0.1, "hair", 6, 8).moved((-0.012, 0, 1.65), scaled=(1.02, 0.9, 1.1)),
    ]
    if random.random() < 0.3:  # a skirt or long coat
        hem = random.uniform(0.35, 0.75)
        parts.append(ovals([(hem, 0.25), (0.9, 0.18), (1.06, 0.14)], "cloth2", 0.8))
    if random.random() < 0.3:  # long hair
        parts.append(
            ovals([(1.42, 0.07), (1.56, 0.1), (1.68, 0.08)], "hair", 0.5).moved((-0.06, 0, 0))
        )
    body = joined(parts)
    tall, broad = random.uniform(1.5, 1.95) / 1.76, random.uniform(0.9, 1.2)
    return body.moved(
        (0, 0, -body.vertices[:, 2].min() * tall), 0, (tall * broad, tall * broad, tall)
    )


def _swung(start: np.ndarray, lengths: tuple[float, float], angles: np.ndarray) -> np.ndarray:
    """Return paths (L, 3, 3) of two-bone limbs that hang from ``start``, swung in the xz plane."""
    bones = [
        length * np.stack([np.sin(angle), 0 * angle, -np.cos(angle)], -1)
        for length, angle in zip(lengths, angles, strict=True)
    ]
    return np.stack([start, start + bones[0], start + bones[0] + bones[1]], 1)


def statue(random: Random) -> Mesh:
    """Return a stone figure on a plinth, 2.5-6 m."""
    scale, high, wide = random.uniform(1, 1.8), random.uniform(0.8, 2), random.uniform(0.8, 1.1)
    steps = [(1.35, 0.0, 0.18), (1.0, 0.18, high - 0.15), (1.15, high, 0.18)]
    plinth = [box(w * wide, w * wide, tall, "stone").moved((0, 0, z)) for w, z, tall in steps]
    figure = _all(person(random), "stone").moved((0, 0, high / scale + 0.18 / scale))
    return joined([*plinth, figure.moved(scaled=scale)])


def _all(of: Mesh, name: str) -> Mesh:
    """Return it in one material."""
    return raw(of.vertices, of.faces, name, smooth=of.smooth)
