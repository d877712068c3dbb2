"""Boulders."""

from __future__ import annotations

import numpy as np

from training.worlds.mesh import Mesh, Random, ball
from training.worlds.props.shapes import TURN, directions, lumpy, raw


def rock(random: Random) -> Mesh:
    """Return a faceted boulder about 1 m across, its foot below z = 0."""
    ways = ball(1, "rock", 9, 14)
    cuts = directions(random, 16)
    facing = np.maximum(ways.vertices @ cuts.T, 1e-3)
    far = np.minimum((random.uniform(0.38, 0.52, 16) / facing).min(1), 0.56)
    cut = raw(ways.vertices * far[:, None], ways.faces, "rock")
    height = random.uniform(0.55, 0.95)
    rough = lumpy(random, cut, 0.035, 7.0)
    wide = random.uniform(0.85, 1.15)
    return rough.moved((0, 0, height * 0.28), random.uniform(0, TURN), (wide, 1 / wide, height))
