"""Lighthouses."""

from __future__ import annotations

import numpy as np

from training.worlds.buildings.shapes import BAR, NO_BACK, boxes, drum, lathe, quads, ring, upright
from training.worlds.buildings.style import pick, wall_name
from training.worlds.mesh import Mesh, Random, joined


def lighthouse(random: Random) -> Mesh:
    """Return a lighthouse with bands, a gallery and a lantern."""
    height, foot, neck = random.uniform(10, 26), random.uniform(2.4, 3.8), random.uniform(1.5, 2.1)
    bands = int(random.integers(1, 8))
    pair = (pick(random, "trim", wall_name(random)), pick(random, "awning", wall_name(random)))
    z = np.linspace(0, height, bands + 1)
    radii = neck + (foot - neck) * (1 - z / height) ** 1.3
    parts = [lathe(radii[i : i + 2], z[i : i + 2], pair[i % 2], 24) for i in range(bands)]
    parts.append(drum(neck + 0.9, 0.25, "trim", 24).moved((0, 0, height)))
    turn = np.arange(24) * np.pi / 12
    x, y, top = (neck + 0.8) * np.cos(turn), (neck + 0.8) * np.sin(turn), height + 1.2
    parts.append(
        boxes((x - 0.03, y - 0.03, height + 0.25), (x + 0.03, y + 0.03, top), "metal", BAR)
    )
    parts.append(ring(neck + 0.85, 0.1, np.full(24, top), np.full(24, top + 0.07)))
    lamp = neck * 0.7
    parts += [
        drum(lamp + 0.05, 0.8, "metal").moved((0, 0, height + 0.2)),
        drum(lamp, 2, "glass", 12).moved((0, 0, height + 1)),
    ]
    parts.append(
        lathe(
            [lamp + 0.3, lamp * 0.6, 0.15, 0.1, 0],
            height + np.array([3, 3.7, 4, 4.8, 4.9]),
            "metal",
        )
    )
    for at in np.linspace(0.3, 0.85, int(random.integers(2, 5))) * height:
        r = float(np.interp(at, z, radii))
        turned = random.uniform(-0.8, 0.8)
        frame = boxes((-0.45, -r - 0.1, 0), (0.45, 0, 1.3), "trim", NO_BACK)
        pane = quads(upright(-0.33, 0.33, 0.12, 1.18, -r - 0.11), "glass")
        parts += [frame.moved((0, 0, at), turned), pane.moved((0, 0, at), turned)]
    parts.append(boxes((-0.8, -foot - 0.35, 0), (0.8, 0, 2.5), "trim", NO_BACK))
    parts.append(quads(upright(-0.55, 0.55, 0.1, 2.2, -foot - 0.36), "wood"))
    return joined(parts)
