"""Leaves as flat cards, alone and in clusters."""

from __future__ import annotations

import numpy as np

from training.worlds.mesh import Mesh, Random
from training.worlds.props.shapes import directions, raw


def leaf_cards(
    random: Random, centres: np.ndarray, sizes: np.ndarray, name: str, facing: np.ndarray | float
) -> Mesh:
    """Return a rhombic card at each of ``centres`` (N, 3), turned at random near ``facing``."""
    normal = directions(random, len(centres)) + facing
    along = np.cross(normal, directions(random, len(centres)))
    along /= np.linalg.norm(along, axis=1, keepdims=True) + 1e-9
    across = np.cross(along, normal)
    across /= np.linalg.norm(across, axis=1, keepdims=True) + 1e-9
    along, across = along * sizes[:, None] * 0.75, across * sizes[:, None] * 0.5
    corners = centres[:, None] + np.stack([along, -across, -along, across], 1)
    return raw(corners, np.arange(len(centres) * 4).reshape(-1, 4), name)


def foliage(
    random: Random, centres: np.ndarray, radii: np.ndarray, each: int, size: float, name: str
) -> Mesh:
    """Return ``each`` cards in the shell of every ellipsoid at ``centres`` of ``radii`` (C, 3)."""
    out = directions(random, len(centres) * each)
    deep = random.uniform(0.5, 1.05, (len(out), 1))
    places = np.repeat(centres, each, 0) + out * deep * np.repeat(radii, each, 0)
    places[:, 2] = np.abs(places[:, 2])
    return leaf_cards(random, places, size * random.uniform(0.7, 1.3, len(out)), name, 0.7 * out)
