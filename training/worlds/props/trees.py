"""Trees: broad-leaved, slim, needled, bare, palms, and lumps for those far away."""

from __future__ import annotations

import numpy as np

from training.worlds.mesh import Mesh, Random, ball, box, joined
from training.worlds.props.leaves import foliage, leaf_cards
from training.worlds.props.shapes import TURN, directions, limbs_along, loft, lumpy, raw

TREE_CARDS = 1320  # of a broadleaf crown
CLUSTER_CARDS = 160  # at most
CONIFER_CARDS = 260  # that fray its outline


def broadleaf(random: Random, leaves: str = "leaves") -> Mesh:
    """Return a round-crowned tree, 4-16 m."""
    height = random.uniform(4, 16)
    half = height * np.array([1, 1, 0]) * random.uniform(0.2, 0.32)
    half[2] = height * random.uniform(0.28, 0.36)
    count = int(random.integers(6, 13))
    ways = np.vstack([np.zeros(3), _spread(random, count - 1)])
    ways += random.normal(size=ways.shape) * 0.12
    centres = np.array([0, 0, height - half[2]]) + ways * half * 0.6
    radii = half * random.uniform(0.36, 0.56, (count, 1)) * [1, 1, 0.8]
    size = float(np.clip(half[0] * 0.12, 0.16, 0.46))
    return _crowned(random, height, centres, radii, size, leaves)


def poplar(random: Random, leaves: str = "leaves") -> Mesh:
    """Return a tall slim tree, 9-22 m."""
    height = random.uniform(9, 22)
    up = np.linspace(0.16, 0.92, 10)
    widths = height * random.uniform(0.075, 0.11) * np.sin(np.pi * up**0.8 * 0.97 + 0.05) ** 0.6
    centres = np.stack([0 * up, 0 * up, up * height], -1)
    centres[:, :2] += random.normal(size=(10, 2)) * 0.15 * widths[:, None]
    radii = np.stack([widths, widths, np.full(10, 0.075 * height)], -1)
    size = float(np.clip(height * 0.027, 0.2, 0.5))
    return _crowned(random, height, centres, radii, size, leaves)


def _spread(random: Random, count: int) -> np.ndarray:
    """Return directions that spread evenly."""
    height = np.linspace(-0.9, 0.9, count)
    angle = np.arange(count) * 2.4 + random.uniform(0, TURN)
    flat = np.sqrt(1 - height**2)
    return np.stack([flat * np.cos(angle), flat * np.sin(angle), height], -1)


def _crowned(
    random: Random, height: float, centres: np.ndarray, radii: np.ndarray, size: float, leaves: str
) -> Mesh:
    """Return a trunk, limbs to every cluster of leaves at ``centres``, and the leaves."""
    count = len(centres)
    thick = height * random.uniform(0.011, 0.018)
    roots = np.zeros((count, 3))
    roots[:, 2] = np.minimum(height * random.uniform(0.2, 0.45, count), centres[:, 2] * 0.8)
    middle = 0.5 * (roots + centres) - [0, 0, 0.03 * height]
    limbs = limbs_along(
        np.stack([roots, middle, centres], 1), thick * np.array([0.55, 0.4, 0.15]), "bark"
    )
    each = min(CLUSTER_CARDS, TREE_CARDS // count)
    crown = foliage(random, centres, radii, each, size, leaves)
    return joined([_trunk(random, height * 0.8, thick), limbs, crown])


def _trunk(random: Random, height: float, radius: float, sides: int = 7) -> Mesh:
    """Return a slightly crooked trunk that tapers and flares at its foot."""
    up = np.array([0, 0.04, 0.3, 0.65, 1])
    path = np.zeros((5, 3))
    path[:, 2] = up * height
    path[2:, :2] = random.normal(size=(3, 2)) * height * 0.012
    return limbs_along(path, radius * np.array([1.6, 1.1, 0.9, 0.65, 0.3]), "bark", sides)


def conifer(random: Random) -> Mesh:
    """Return a fir or spruce of drooping whorls, 5-25 m."""
    height, bare = random.uniform(5, 25), random.uniform(0.04, 0.2)
    levels, around = int(random.integers(11, 17)), int(random.integers(8, 12))
    reach = height * random.uniform(0.15, 0.25)
    up = np.repeat(1 - np.linspace(1, 0.03, levels) ** 1.25, around)
    count = len(up)
    length = reach * (0.08 + 0.92 * (1 - up) ** 0.7) * random.uniform(0.7, 1.1, count)
    angle = np.arange(count) * TURN / around + np.repeat(random.uniform(0, 1, levels), around)
    angle += random.normal(size=count) * 0.12
    root = np.stack([0 * up, 0 * up, height * (bare + (1 - bare) * up)], -1)
    root[:, 2] += random.normal(size=count) * 0.02 * height * (1 - up)
    out = np.stack([np.cos(angle), np.sin(angle), 0 * angle], -1) * length[:, None]
    side = np.stack([-np.sin(angle), np.cos(angle), 0 * angle], -1) * length[:, None] * 0.4
    drop = (
        np.array([0, 0, 1.0])
        * np.minimum(length * random.uniform(0.3, 0.5, count), 0.75 * root[:, 2])[:, None]
    )
    middle, tip = root + 0.55 * out - 0.35 * drop, root + out - drop
    left, right = middle + side - 0.4 * drop, middle - side - 0.4 * drop
    corners = np.stack([root, left, tip, middle, right], 1)
    corners[..., 2] = np.maximum(corners[..., 2], 0.02)
    faces = np.array([[0, 3, 1], [1, 3, 2], [0, 4, 3], [3, 4, 2]])
    faces = (np.arange(count)[:, None, None] * 5 + faces).reshape(-1, 3)
    boughs = raw(corners, faces, "needles")
    on = random.integers(0, count, CONIFER_CARDS)
    places = root[on] + (tip - root)[on] * random.uniform(0.35, 1.05, (CONIFER_CARDS, 1))
    places += side[on] * random.uniform(-0.9, 0.9, (CONIFER_CARDS, 1))
    frays = leaf_cards(random, places, 0.35 * length[on] + 0.1, "needles", np.array([0, 0, 0.8]))
    frays.vertices[:, 2] = np.abs(frays.vertices[:, 2])
    return joined([_trunk(random, height, height * 0.012, 6), boughs, frays])


def palm(random: Random) -> Mesh:
    """Return a palm with a bent trunk and feathered fronds, 4-13 m."""
    height, lean = random.uniform(3.5, 10), random.uniform(0, 0.25)
    t = np.linspace(0, 1, 7)[:, None]
    trunk = height * (t * [0, 0, 1] + t**2 * [lean, 0, 0])
    thick = random.uniform(0.12, 0.2) * np.array([1.7, 1.1, 1, 0.95, 0.9, 0.85, 0.9])
    count, leaflets = int(random.integers(12, 20)), 14
    length = random.uniform(1.8, 3.2)
    angle = (np.arange(count) * 2.4 + random.normal(size=count) * 0.2)[:, None, None]
    rise = random.uniform(-0.3, 1.1, (count, 1, 1))
    s = np.linspace(0.08, 1, leaflets)[None, :, None]
    out = np.concatenate([np.cos(angle), np.sin(angle), 0 * angle], -1)
    spine = trunk[-1] + length * (
        s * out * np.cos(rise * 0.8) + [0, 0, 1] * (rise * s - 0.95 * s**2)
    )
    side = np.concatenate([-np.sin(angle), np.cos(angle), 0 * angle], -1)
    reach = length * 0.3 * np.sin(np.pi * (0.12 + 0.83 * s))
    along = out * length * 0.075
    blades = [
        np.stack([spine - along, spine + along, spine + 2 * along + way], -2)
        for way in (side * reach - [0, 0, 0.35] * reach, -side * reach - [0, 0, 0.35] * reach)
    ]
    corners = np.stack(blades).reshape(-1, 3)
    fronds = raw(corners, np.arange(len(corners)).reshape(-1, 3), "leaves")
    ribs = limbs_along(spine[:, ::3], 0.03 * np.ones(spine[:, ::3].shape[1]), "leaves", 3)
    return joined([limbs_along(trunk, thick, "bark", 7), fronds, ribs])


def bare_tree(random: Random) -> Mesh:
    """Return a tree without leaves, 4-15 m."""
    height = random.uniform(4, 15)
    t = np.linspace(0, 1, 4)[:, None]
    paths = (t * [0, 0, 0.6 * height])[None]
    paths[:, 1:, :2] += random.normal(size=(1, 3, 2)) * height * 0.02
    radii = height * random.uniform(0.022, 0.034) * np.array([[1.4, 0.9, 0.7, 0.45]])
    parts = [limbs_along(paths, radii, "bark", 7)]
    for count, sides in ((int(random.integers(5, 8)), 5), (4, 4), (4, 3)):
        paths, radii = _grown(random, paths, radii, count)
        points = [0, 1, 3] if sides == 3 else [0, 1, 2, 3]
        parts.append(limbs_along(paths[:, points], radii[:, points], "bark", sides))
    twigs, radii = _grown(random, paths, radii, 3)
    across = np.cross(twigs[:, -1] - twigs[:, 0], directions(random, len(twigs)))
    across *= 0.012 / (np.linalg.norm(across, axis=1, keepdims=True) + 1e-9)
    corners = np.stack([twigs[:, 0] - across, twigs[:, 0] + across, twigs[:, -1]], 1)
    parts.append(raw(corners, np.arange(len(twigs) * 3).reshape(-1, 3), "bark"))
    tree = joined(parts)
    return tree.moved(scaled=height / tree.vertices[:, 2].max())


def _grown(
    random: Random, paths: np.ndarray, radii: np.ndarray, count: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return ``count`` branches (paths, radii) off each one of ``paths`` (B, K, 3)."""
    branches, points, _ = paths.shape
    at = np.tile(np.linspace(0.4, 1, count), branches) * (points - 1) * 0.999
    low, of = at.astype(int), np.repeat(np.arange(branches), count)
    part = (at - low)[:, None]
    start = paths[of, low] * (1 - part) + paths[of, low + 1] * part
    whole = paths[of, -1] - paths[of, 0]
    length = np.linalg.norm(whole, axis=1, keepdims=True)
    way = whole / length + random.uniform(0.6, 1.1, (len(of), 1)) * directions(random, len(of))
    way /= np.linalg.norm(way, axis=1, keepdims=True) + 1e-9
    reach = way * length * random.uniform(0.45, 0.75, (len(of), 1))
    t = np.linspace(0, 1, points)[:, None]
    grown = start[:, None] + t * reach[:, None] + t**2 * [0, 0, 0.22] * length[:, None]
    thick = radii[of, low] * random.uniform(0.5, 0.7, len(of))
    return grown, thick[:, None] * np.linspace(1, 0.25, points)


def far_tree(random: Random, conifer: bool) -> Mesh:
    """Return a tree of few faces, to be seen from 150 m or more."""
    height = random.uniform(8, 22) if conifer else random.uniform(6, 16)
    trunk = box(height * 0.035, height * 0.035, height * 0.4, "bark")
    if conifer:
        angles = np.arange(9) * TURN / 9
        parts = [trunk]
        for low in (0.1, 0.3, 0.5, 0.7):
            rim = 0.3 * height * (1 - low) ** 0.9 * 0.65 * random.uniform(0.7, 1.2, (9, 1))
            flat = np.stack([np.cos(angles), np.sin(angles), 0 * angles], -1)
            foot = rim * flat + [0, 0, low * height] + random.normal(size=(9, 1)) * [0, 0, 0.2]
            top = 0.02 * flat + [0, 0, height * min(1.0, low + 0.45)]
            parts.append(loft(np.stack([foot, top]), "needles"))
        return joined(parts)
    wide = height * random.uniform(0.2, 0.3)
    parts = [trunk]
    for up, size in ((0.55, 1.0), (0.45, 0.75), (0.75, 0.7)):
        lump = lumpy(random, ball(1, "leaves", 5, 9), 0.12, 4.0)
        by = (*random.normal(size=2) * wide * 0.3, up * height)
        parts.append(lump.moved(by, scaled=(wide * size, wide * size, height * 0.25 * size)))
    return joined(parts)
