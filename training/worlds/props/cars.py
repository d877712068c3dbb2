"""Cars."""

from __future__ import annotations

import numpy as np

from training.worlds.mesh import Mesh, Random, box, joined, tube
from training.worlds.props.shapes import cabin_rings, copies, fan, limbs_along, loft

CAR_STATIONS = (  # along x from tail to nose, in lengths: bottom z, half width in halves
    (-0.5, 0.36, 0.86), (-0.48, 0.25, 0.93), (-0.3, 0.19, 1), (0, 0.19, 1),
    (0.2, 0.19, 1), (0.36, 0.19, 0.98), (0.47, 0.22, 0.9), (0.5, 0.36, 0.76),
)  # fmt: skip
CAR_KINDS = {  # length, height, top z at the stations, cabin x (low rear, front, top ...), solid
    "hatchback": ((3.6, 4.2), (1.42, 1.6), (0.75, 0.92, 0.94, 0.95, 0.95, 0.84, 0.7, 0.55),
                  (-0.49, 0.24, -0.38, 0.05), 0),
    "sedan": ((4.3, 4.8), (1.38, 1.5), (0.7, 0.92, 0.93, 0.92, 0.92, 0.84, 0.7, 0.55),
              (-0.36, 0.2, -0.22, 0.02), 0),
    "van": ((4.5, 5.2), (1.85, 2.2), (0.9, 1.05, 1.05, 1.05, 1.05, 1.02, 0.84, 0.6),
            (-0.495, 0.36, -0.475, 0.2), 0.62),
}  # fmt: skip


def car(random: Random, kind: str | None = None) -> Mesh:
    """Return a hatchback, sedan or van along x, its nose at +x, 3.6-5.2 m."""
    kind = kind or str(random.choice(list(CAR_KINDS), p=[0.45, 0.35, 0.2]))
    lengths, heights, tops, cabin, solid = CAR_KINDS[kind]
    length, height, half = (
        random.uniform(*lengths),
        random.uniform(*heights),
        random.uniform(0.83, 0.92),
    )
    profile = np.array([[0.9, 0], [1, 0.3], [1, 0.8], [0.9, 1]])
    profile = np.vstack([profile, profile[::-1] * [-1, 1]])
    rings = [
        [[x * length, wide * half * y, low + (top - low) * up] for y, up in profile]
        for (x, low, wide), top in zip(CAR_STATIONS, tops, strict=True)
    ]
    edges, belt = np.array(cabin) * length, tops[3] - 0.02
    z, w = (belt, height - 0.07), (half * 0.9, half * 0.76)
    whole = cabin_rings(edges[:2], edges[2:], z, w)
    crown = [whole[1] * [1, 1.03, 1], whole[1] * [0.94, 0.85, 1] + [0, 0, 0.07]]
    middle = whole.reshape(2, 2, 2, 3).mean(2, keepdims=True).repeat(2, 2)[:, :, 0]
    uprights = np.concatenate([whole.swapaxes(0, 1), middle.swapaxes(0, 1) * [0, 1, 1]])
    uprights[4:, :, 0] = 0.05 * length
    parts = [
        loft(rings, "paint", ends=True),
        loft(whole, "glass"),
        loft(crown, "paint", ends=True),
        limbs_along(uprights, np.full(2, 0.04), "paint"),
        *_wheels(length, half, random.uniform(0.3, 0.34)),
    ]
    if solid:  # panels, not windows, towards the tail
        fronts = (1 - solid) * edges[::2] + solid * edges[1::2]
        panels = cabin_rings((edges[0], fronts[0]), (edges[2], fronts[1]), z, w)
        parts.append(loft(panels * [1, 1.02, 1] - [0.01, 0, 0], "paint"))
    for x, wide, name in ((0.474, 0.62, "lamp"), (-0.49, 0.74, "plastic")):
        lamps = np.array([[x * length, way * wide * half, 0.56] for way in (-1, 1)])
        parts.append(copies(box(0.06, 0.26, 0.12, name), lamps))
    return joined(parts)


def _wheels(length: float, half: float, radius: float) -> list[Mesh]:
    """Return four wheels with hubs and dark arches."""
    angles = np.arange(7) * np.pi / 6
    rim = np.stack([np.cos(angles), 0 * angles, np.sin(angles)], -1) * radius
    hub = np.vstack([rim, -rim[1:-1]])[::2] * 0.6
    parts = []
    for side in (-1, 1):
        places = np.array(
            [[-0.3 * length, side * half, radius], [0.31 * length, side * half, radius]]
        )
        path = np.array([[0, -0.2, 0], [0, 0.015, 0]]) * [1, side, 1]
        parts += [
            copies(tube(path, [radius, radius], "rubber", 10), places),
            copies(fan(rim * 1.2, "rubber"), np.add(places, [0, 0.006 * side, 0])),
            copies(fan(hub, "metal"), np.add(places, [0, 0.02 * side, 0])),
        ]
    return parts
