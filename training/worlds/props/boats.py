"""Boats: rowed, for fishing, under sail."""

from __future__ import annotations

import numpy as np

from training.worlds.mesh import Mesh, Random, box, joined, tube
from training.worlds.props.shapes import TURN, cabin_rings, copies, fan, limbs_along, loft


def boat(random: Random, kind: str | None = None) -> Mesh:
    """Return a rowing boat, a fishing boat or a yacht along x, afloat at z = 0."""
    kind = kind or str(random.choice(["rowing", "fishing", "yacht"]))
    name = str(random.choice(["paint", "wood"])) if kind == "rowing" else "paint"
    if kind == "rowing":
        length, free = random.uniform(3, 5), random.uniform(0.38, 0.5)
        seats = np.outer([-0.32, -0.09, 0.13], [length, 0, 0])
        seats[:, 2] = free * 0.72
        seat = box(0.25, length * 0.27, 0.04, "wood")
        return joined([*_hull(length, length * 0.35, free, 0.15, name, 0.6), copies(seat, seats)])
    if kind == "yacht":
        length = random.uniform(6, 13)
        free = 0.3 + 0.07 * length
        hull = _hull(length, length * 0.3, free, 0.06 * length, name, 0.08)
        return joined([*hull, *_yacht(random, length, free)])
    length = random.uniform(5.5, 11)
    free, at = 0.3 + 0.08 * length, length * random.choice([-0.2, 0.1])
    tall, wide = 1.9, length * 0.085
    house = cabin_rings(
        (at - wide, at + wide),
        (at - wide, at + wide * 1.1),
        (free * 0.5, free + tall),
        (wide, wide),
    )
    panes = cabin_rings((at - wide * 1.02, at + wide * 1.07), (at - wide * 1.02, at + wide * 1.12),
                   (free + 1.05, free + 1.6), (wide * 1.02, wide * 1.02))  # fmt: skip
    mast = [[at - wide, 0, free], [at - wide, 0, free + tall + length * 0.25]]
    return joined([
        *_hull(length, length * 0.33, free, 0.07 * length, name, 0.25),
        loft(house, "paint", ends=True),
        loft(panes, "glass"),
        box(2.6 * wide, 2.3 * wide, 0.08, "wood").moved((at, 0, free + tall)),
        tube(mast, [0.06, 0.04], "wood", 5),
    ])  # fmt: skip


def _hull(
    length: float, beam: float, free: float, draught: float, name: str, deck: float
) -> list[Mesh]:
    """Return a hull, bow at +x, its gunwales and a floor at ``deck``, a share of the depth."""
    t = np.linspace(0, 1, 11)
    half = beam / 2 * np.interp(t, [0, 0.25, 0.5, 0.75, 0.9, 1], [0.72, 0.94, 1, 0.76, 0.4, 0.03])
    sheer = free * (1 + 0.5 * np.clip(t - 0.35, 0, 1) ** 1.5 * 2)
    keel = -draught * np.interp(t, [0, 0.5, 0.85, 1], [0.5, 1, 0.7, -0.6])
    angles = np.linspace(np.pi, TURN, 9)
    y, z = np.cos(angles), -(np.abs(np.sin(angles)) ** 0.7)
    rings = np.stack([
        np.repeat((t - 0.5)[:, None] * length, 9, 1),
        half[:, None] * y,
        sheer[:, None] + (sheer - keel)[:, None] * z,
    ], -1)  # fmt: skip
    wide = half * np.sqrt(1 - deck ** (2 / 0.7)) * 0.98
    level = sheer - deck * (sheer - keel)
    floor = np.stack([np.stack([rings[:, 0, 0], s * wide, level], -1) for s in (1, -1)], 1)
    return [
        loft(rings, name, around=False, smooth=True),
        fan(rings[0, ::-1], name),
        loft(floor, "wood", around=False),
        limbs_along(
            np.stack([rings[:, 0], rings[:, -1]]), np.full(11, 0.015 + 0.005 * length), "wood"
        ),
    ]


def _yacht(random: Random, length: float, deck: float) -> list[Mesh]:
    """Return what stands on a yacht's deck: a low cabin, a mast, a boom and maybe sails."""
    mast, boom = random.uniform(1.15, 1.4) * length, 0.42 * length
    foot, side = 0.08 * length, random.uniform(-0.35, 0.35)
    end = np.array([foot - boom * np.cos(side), boom * np.sin(side), deck + 1.5])
    head, bow = np.array([foot, 0, mast * 0.97]), np.array([0.48 * length, 0, deck * 1.5])
    low = cabin_rings((-0.15 * length, 0.2 * length), (-0.13 * length, 0.12 * length),
                 (deck - 0.1, deck + 0.45), (0.11 * length, 0.085 * length))  # fmt: skip
    stays = [[head, bow], [head, [-0.49 * length, 0, deck]]]
    parts = [
        loft(low, "paint", ends=True),
        tube([[foot, 0, 0], [foot, 0, mast]], [0.08, 0.06], "metal", 6),
        limbs_along([[foot, 0, deck + 1.45], end], np.full(2, 0.06), "metal", 5),
        limbs_along(stays, np.full(2, 0.012), "metal", 3),
    ]
    if random.random() < 0.55:
        belly = 0.05 * length * (1 if side > 0 else -1)
        parts.append(
            _sail(np.array([foot, 0, deck + 1.55]), np.add(end, [0.1, 0, 0.05]), head, belly)
        )
        clew = np.array([foot - 0.03 * length, side * 0.3 * length, deck + 1.0])
        parts.append(_sail(bow, clew, head * [1, 1, 0.9], belly))
    return parts


def _sail(tack: np.ndarray, clew: np.ndarray, head: np.ndarray, belly: float) -> Mesh:
    """Return a three-cornered sail blown towards +y."""
    up, across = np.linspace(0, 0.98, 6)[:, None, None], np.linspace(0, 1, 5)[None, :, None]
    luff, leech = tack + (head - tack) * up, clew + (head - clew) * up
    blown = np.sin(np.pi * across) * (1 - up) ** 0.5 * belly
    return loft(
        luff + (leech - luff) * across + blown * [0, 1, 0], "sail", around=False, smooth=True
    )
