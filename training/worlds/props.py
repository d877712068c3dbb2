"""Things that stand outdoors: trees, people, cars, boats, street furniture. Metres, on z = 0."""

from __future__ import annotations

import numpy as np

from training.worlds.mesh import Mesh, Random, ball, box, joined, tube

TURN = 2 * np.pi
TREE_CARDS = 1320  # of a broadleaf crown
CLUSTER_CARDS = 160  # at most
CONIFER_CARDS = 260  # that fray its outline
HEDGE_CARDS = 2400  # at most; they grow to cover a longer one
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


def _raw(vertices: np.ndarray, faces: np.ndarray, name: str, *, smooth: bool = False) -> Mesh:
    """Return a mesh of one material from arrays; ``faces`` (M, 3) or (M, 4)."""
    if faces.shape[1] == 3:
        faces = np.column_stack([faces, faces[:, 2]])
    return Mesh(vertices.reshape(-1, 3), faces, np.zeros(len(faces), int), (name,), smooth)


def _all(of: Mesh, name: str) -> Mesh:
    """Return it in one material."""
    return _raw(of.vertices, of.faces, name, smooth=of.smooth)


def _copies(part: Mesh, places: np.ndarray) -> Mesh:
    """Return a copy of ``part`` at each of ``places`` (N, 3)."""
    places = np.asarray(places, float)
    starts = np.arange(len(places))[:, None, None] * len(part.vertices)
    return Mesh(
        (part.vertices + places[:, None]).reshape(-1, 3),
        (part.faces + starts).reshape(-1, 4),
        np.tile(part.materials, len(places)),
        part.names,
        part.smooth,
    )


def _fan(rim: np.ndarray, name: str) -> Mesh:
    """Return the flat face within ``rim`` (R, 3), as triangles about its middle."""
    here = np.arange(len(rim))
    faces = np.stack([here, np.roll(here, -1), np.full(len(rim), len(rim))], -1)
    return _raw(np.vstack([rim, rim.mean(0)]), faces, name)


def _loft(
    rings: np.ndarray, name: str, *, around: bool = True, ends: bool = False, smooth: bool = False
) -> Mesh:
    """Return the skin over ``rings`` (..., S, R, 3), anticlockwise about the way they go."""
    rings = np.asarray(rings, float).reshape(-1, *np.shape(rings)[-3:])
    here = np.arange(rings.size // 3).reshape(rings.shape[:3])
    here, beside = (here, np.roll(here, -1, 2)) if around else (here[..., :-1], here[..., 1:])
    quads = np.stack([here[:, :-1], beside[:, :-1], beside[:, 1:], here[:, 1:]], -1)
    skin = _raw(rings, quads.reshape(-1, 4), name, smooth=smooth)
    if not ends:
        return skin
    caps = [_fan(rim, name) for of in rings for rim in (of[0, ::-1], of[-1])]
    return joined([skin, *caps])


def _limbs(
    paths: np.ndarray, radii: np.ndarray, name: str, sides: int = 4, *, ends: bool = False
) -> Mesh:
    """Return round limbs along ``paths`` (..., K, 3) with ``radii`` (..., K); they do not twist."""
    paths = np.asarray(paths, float)
    along = np.gradient(paths, axis=-2)
    along /= np.linalg.norm(along, axis=-1, keepdims=True) + 1e-9
    whole = np.abs(paths[..., -1:, :] - paths[..., :1, :])
    upright = whole[..., 2:] > 0.7 * np.linalg.norm(whole, axis=-1, keepdims=True)
    across = np.cross(along, np.where(upright, [1.0, 0, 0], [0, 0, 1.0]))
    across /= np.linalg.norm(across, axis=-1, keepdims=True) + 1e-9
    beside = np.cross(along, across)
    angles = np.arange(sides)[:, None] * TURN / sides
    out = np.cos(angles) * across[..., None, :] + np.sin(angles) * beside[..., None, :]
    rings = paths[..., None, :] + out * np.asarray(radii, float)[..., None, None]
    return _loft(rings, name, ends=ends, smooth=True)


def _units(random: Random, count: int) -> np.ndarray:
    """Return random directions."""
    ways = random.normal(size=(count, 3))
    return ways / (np.linalg.norm(ways, axis=1, keepdims=True) + 1e-9)


def _spread(random: Random, count: int) -> np.ndarray:
    """Return directions that spread evenly."""
    height = np.linspace(-0.9, 0.9, count)
    angle = np.arange(count) * 2.4 + random.uniform(0, TURN)
    flat = np.sqrt(1 - height**2)
    return np.stack([flat * np.cos(angle), flat * np.sin(angle), height], -1)


def _lumpy(random: Random, part: Mesh, amount: float, fine: float = 2.0) -> Mesh:
    """Return it swollen and dented by smooth noise; ``part`` of about 1 m about the origin."""
    ways = random.normal(size=(3, 6)) * fine
    noise = np.sin(part.vertices @ ways + random.uniform(0, TURN, 6)).sum(1) / 2
    vertices = part.vertices * (1 + amount * noise[:, None])
    return Mesh(vertices, part.faces, part.materials, part.names, part.smooth)


def _cards(
    random: Random, centres: np.ndarray, sizes: np.ndarray, name: str, facing: np.ndarray | float
) -> Mesh:
    """Return a rhombic card at each of ``centres`` (N, 3), turned at random near ``facing``."""
    normal = _units(random, len(centres)) + facing
    along = np.cross(normal, _units(random, len(centres)))
    along /= np.linalg.norm(along, axis=1, keepdims=True) + 1e-9
    across = np.cross(along, normal)
    across /= np.linalg.norm(across, axis=1, keepdims=True) + 1e-9
    along, across = along * sizes[:, None] * 0.75, across * sizes[:, None] * 0.5
    corners = centres[:, None] + np.stack([along, -across, -along, across], 1)
    return _raw(corners, np.arange(len(centres) * 4).reshape(-1, 4), name)


def _foliage(
    random: Random, centres: np.ndarray, radii: np.ndarray, each: int, size: float, name: str
) -> Mesh:
    """Return ``each`` cards in the shell of every ellipsoid at ``centres`` of ``radii`` (C, 3)."""
    out = _units(random, len(centres) * each)
    deep = random.uniform(0.5, 1.05, (len(out), 1))
    places = np.repeat(centres, each, 0) + out * deep * np.repeat(radii, each, 0)
    places[:, 2] = np.abs(places[:, 2])
    return _cards(random, places, size * random.uniform(0.7, 1.3, len(out)), name, 0.7 * out)


def _trunk(random: Random, height: float, radius: float, sides: int = 7) -> Mesh:
    """Return a slightly crooked trunk that tapers and flares at its foot."""
    up = np.array([0, 0.04, 0.3, 0.65, 1])
    path = np.zeros((5, 3))
    path[:, 2] = up * height
    path[2:, :2] = random.normal(size=(3, 2)) * height * 0.012
    return _limbs(path, radius * np.array([1.6, 1.1, 0.9, 0.65, 0.3]), "bark", sides)


def _crowned(
    random: Random, height: float, centres: np.ndarray, radii: np.ndarray, size: float, leaves: str
) -> Mesh:
    """Return a trunk, limbs to every cluster of leaves at ``centres``, and the leaves."""
    count = len(centres)
    thick = height * random.uniform(0.011, 0.018)
    roots = np.zeros((count, 3))
    roots[:, 2] = np.minimum(height * random.uniform(0.2, 0.45, count), centres[:, 2] * 0.8)
    middle = 0.5 * (roots + centres) - [0, 0, 0.03 * height]
    limbs = _limbs(
        np.stack([roots, middle, centres], 1), thick * np.array([0.55, 0.4, 0.15]), "bark"
    )
    each = min(CLUSTER_CARDS, TREE_CARDS // count)
    crown = _foliage(random, centres, radii, each, size, leaves)
    return joined([_trunk(random, height * 0.8, thick), limbs, crown])


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
    boughs = _raw(corners, faces, "needles")
    on = random.integers(0, count, CONIFER_CARDS)
    places = root[on] + (tip - root)[on] * random.uniform(0.35, 1.05, (CONIFER_CARDS, 1))
    places += side[on] * random.uniform(-0.9, 0.9, (CONIFER_CARDS, 1))
    frays = _cards(random, places, 0.35 * length[on] + 0.1, "needles", np.array([0, 0, 0.8]))
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
    fronds = _raw(corners, np.arange(len(corners)).reshape(-1, 3), "leaves")
    ribs = _limbs(spine[:, ::3], 0.03 * np.ones(spine[:, ::3].shape[1]), "leaves", 3)
    return joined([_limbs(trunk, thick, "bark", 7), fronds, ribs])


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
    way = whole / length + random.uniform(0.6, 1.1, (len(of), 1)) * _units(random, len(of))
    way /= np.linalg.norm(way, axis=1, keepdims=True) + 1e-9
    reach = way * length * random.uniform(0.45, 0.75, (len(of), 1))
    t = np.linspace(0, 1, points)[:, None]
    grown = start[:, None] + t * reach[:, None] + t**2 * [0, 0, 0.22] * length[:, None]
    thick = radii[of, low] * random.uniform(0.5, 0.7, len(of))
    return grown, thick[:, None] * np.linspace(1, 0.25, points)


def bare_tree(random: Random) -> Mesh:
    """Return a tree without leaves, 4-15 m."""
    height = random.uniform(4, 15)
    t = np.linspace(0, 1, 4)[:, None]
    paths = (t * [0, 0, 0.6 * height])[None]
    paths[:, 1:, :2] += random.normal(size=(1, 3, 2)) * height * 0.02
    radii = height * random.uniform(0.022, 0.034) * np.array([[1.4, 0.9, 0.7, 0.45]])
    parts = [_limbs(paths, radii, "bark", 7)]
    for count, sides in ((int(random.integers(5, 8)), 5), (4, 4), (4, 3)):
        paths, radii = _grown(random, paths, radii, count)
        points = [0, 1, 3] if sides == 3 else [0, 1, 2, 3]
        parts.append(_limbs(paths[:, points], radii[:, points], "bark", sides))
    twigs, radii = _grown(random, paths, radii, 3)
    across = np.cross(twigs[:, -1] - twigs[:, 0], _units(random, len(twigs)))
    across *= 0.012 / (np.linalg.norm(across, axis=1, keepdims=True) + 1e-9)
    corners = np.stack([twigs[:, 0] - across, twigs[:, 0] + across, twigs[:, -1]], 1)
    parts.append(_raw(corners, np.arange(len(twigs) * 3).reshape(-1, 3), "bark"))
    tree = joined(parts)
    return tree.moved(scaled=height / tree.vertices[:, 2].max())


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
            parts.append(_loft(np.stack([foot, top]), "needles"))
        return joined(parts)
    wide = height * random.uniform(0.2, 0.3)
    parts = [trunk]
    for up, size in ((0.55, 1.0), (0.45, 0.75), (0.75, 0.7)):
        lump = _lumpy(random, ball(1, "leaves", 5, 9), 0.12, 4.0)
        by = (*random.normal(size=2) * wide * 0.3, up * height)
        parts.append(lump.moved(by, scaled=(wide * size, wide * size, height * 0.25 * size)))
    return joined(parts)


def bush(random: Random, leaves: str = "leaves") -> Mesh:
    """Return a bush, 0.5-2.2 m: leaf cards over a dark core."""
    height, count = random.uniform(0.5, 2.2), int(random.integers(2, 6))
    centres = random.normal(size=(count, 3)) * height * [0.3, 0.3, 0]
    centres[:, 2] = height * random.uniform(0.3, 0.5, count)
    radii = height * random.uniform(0.38, 0.52, (count, 1)) * [1, 1, 0.95]
    core = ball(1, "bark", 5, 8)
    cores = [core.moved(c, scaled=r * 0.6) for c, r in zip(centres, radii, strict=True)]
    return joined([*cores, _foliage(random, centres, radii, 170, 0.05 + 0.08 * height, leaves)])


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
    cards = _cards(
        random,
        places * size / 2 + [0, 0, size[2] / 2],
        card * random.uniform(0.6, 1.2, count),
        "leaves",
        1.2 * out,
    )
    return joined([box(length * 0.97, size[1] * 0.7, size[2] * 0.88, "leaves"), cards])


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
    return _raw(corners, faces.reshape(-1, 4), name)


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
    return joined([leaves, _copies(plume, tips)])


def rock(random: Random) -> Mesh:
    """Return a faceted boulder about 1 m across, its foot below z = 0."""
    ways = ball(1, "rock", 9, 14)
    cuts = _units(random, 16)
    facing = np.maximum(ways.vertices @ cuts.T, 1e-3)
    far = np.minimum((random.uniform(0.38, 0.52, 16) / facing).min(1), 0.56)
    cut = _raw(ways.vertices * far[:, None], ways.faces, "rock")
    height = random.uniform(0.55, 0.95)
    rough = _lumpy(random, cut, 0.035, 7.0)
    wide = random.uniform(0.85, 1.15)
    return rough.moved((0, 0, height * 0.28), random.uniform(0, TURN), (wide, 1 / wide, height))


def _swung(start: np.ndarray, lengths: tuple[float, float], angles: np.ndarray) -> np.ndarray:
    """Return paths (L, 3, 3) of two-bone limbs that hang from ``start``, swung in the xz plane."""
    bones = [
        length * np.stack([np.sin(angle), 0 * angle, -np.cos(angle)], -1)
        for length, angle in zip(lengths, angles, strict=True)
    ]
    return np.stack([start, start + bones[0], start + bones[0] + bones[1]], 1)


def _oval(rows: list[tuple[float, float]], name: str, deep: float, sides: int = 8) -> Mesh:
    """Return an upright skin of ovals: ``rows`` of height, half width (y); x ``deep`` as wide."""
    angles = np.arange(sides) * TURN / sides
    oval = np.stack([deep * np.cos(angles), np.sin(angles), 0 * angles], -1)
    return _loft([oval * wide + [0, 0, up] for up, wide in rows], name, ends=True, smooth=True)


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
        _oval(torso, "cloth", 0.62),
        _limbs(legs, np.array([0.085, 0.062, 0.045]), "cloth2", 6),
        _limbs(arms, np.array([0.06, 0.047, 0.034]), "cloth", 6),
        _copies(box(0.25, 0.09, 0.09, "rubber"), legs[:, 2] + [0.06, 0, -0.06]),
        _copies(ball(0.048, "skin", 4, 5), arms[:, 2] - [0, 0, 0.03]),
        tube([[0, 0, 1.44], [0, 0, 1.56]], [0.055, 0.05], "skin", 6),
        ball(0.1, "skin", 6, 8).moved((0.015, 0, 1.625), scaled=(0.98, 0.8, 1.2)),
        ball(0.1, "hair", 6, 8).moved((-0.012, 0, 1.65), scaled=(1.02, 0.9, 1.1)),
    ]
    if random.random() < 0.3:  # a skirt or long coat
        hem = random.uniform(0.35, 0.75)
        parts.append(_oval([(hem, 0.25), (0.9, 0.18), (1.06, 0.14)], "cloth2", 0.8))
    if random.random() < 0.3:  # long hair
        parts.append(
            _oval([(1.42, 0.07), (1.56, 0.1), (1.68, 0.08)], "hair", 0.5).moved((-0.06, 0, 0))
        )
    body = joined(parts)
    tall, broad = random.uniform(1.5, 1.95) / 1.76, random.uniform(0.9, 1.2)
    return body.moved(
        (0, 0, -body.vertices[:, 2].min() * tall), 0, (tall * broad, tall * broad, tall)
    )


def _cabin(low: tuple[float, float], top: tuple[float, float], z: tuple, w: tuple) -> np.ndarray:
    """Return a cabin's low and top ring (2, 4, 3): x from rear to front, z and half widths."""
    return np.array(
        [
            [[rear, -half, up], [front, -half, up], [front, half, up], [rear, half, up]]
            for (rear, front), up, half in zip((low, top), z, w, strict=True)
        ]
    )


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
            _copies(tube(path, [radius, radius], "rubber", 10), places),
            _copies(_fan(rim * 1.2, "rubber"), np.add(places, [0, 0.006 * side, 0])),
            _copies(_fan(hub, "metal"), np.add(places, [0, 0.02 * side, 0])),
        ]
    return parts


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
    whole = _cabin(edges[:2], edges[2:], z, w)
    crown = [whole[1] * [1, 1.03, 1], whole[1] * [0.94, 0.85, 1] + [0, 0, 0.07]]
    middle = whole.reshape(2, 2, 2, 3).mean(2, keepdims=True).repeat(2, 2)[:, :, 0]
    uprights = np.concatenate([whole.swapaxes(0, 1), middle.swapaxes(0, 1) * [0, 1, 1]])
    uprights[4:, :, 0] = 0.05 * length
    parts = [
        _loft(rings, "paint", ends=True),
        _loft(whole, "glass"),
        _loft(crown, "paint", ends=True),
        _limbs(uprights, np.full(2, 0.04), "paint"),
        *_wheels(length, half, random.uniform(0.3, 0.34)),
    ]
    if solid:  # panels, not windows, towards the tail
        fronts = (1 - solid) * edges[::2] + solid * edges[1::2]
        panels = _cabin((edges[0], fronts[0]), (edges[2], fronts[1]), z, w)
        parts.append(_loft(panels * [1, 1.02, 1] - [0.01, 0, 0], "paint"))
    for x, wide, name in ((0.474, 0.62, "lamp"), (-0.49, 0.74, "plastic")):
        lamps = np.array([[x * length, way * wide * half, 0.56] for way in (-1, 1)])
        parts.append(_copies(box(0.06, 0.26, 0.12, name), lamps))
    return joined(parts)


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
        _loft(rings, name, around=False, smooth=True),
        _fan(rings[0, ::-1], name),
        _loft(floor, "wood", around=False),
        _limbs(np.stack([rings[:, 0], rings[:, -1]]), np.full(11, 0.015 + 0.005 * length), "wood"),
    ]


def _sail(tack: np.ndarray, clew: np.ndarray, head: np.ndarray, belly: float) -> Mesh:
    """Return a three-cornered sail blown towards +y."""
    up, across = np.linspace(0, 0.98, 6)[:, None, None], np.linspace(0, 1, 5)[None, :, None]
    luff, leech = tack + (head - tack) * up, clew + (head - clew) * up
    blown = np.sin(np.pi * across) * (1 - up) ** 0.5 * belly
    return _loft(
        luff + (leech - luff) * across + blown * [0, 1, 0], "sail", around=False, smooth=True
    )


def _yacht(random: Random, length: float, deck: float) -> list[Mesh]:
    """Return what stands on a yacht's deck: a low cabin, a mast, a boom and maybe sails."""
    mast, boom = random.uniform(1.15, 1.4) * length, 0.42 * length
    foot, side = 0.08 * length, random.uniform(-0.35, 0.35)
    end = np.array([foot - boom * np.cos(side), boom * np.sin(side), deck + 1.5])
    head, bow = np.array([foot, 0, mast * 0.97]), np.array([0.48 * length, 0, deck * 1.5])
    low = _cabin((-0.15 * length, 0.2 * length), (-0.13 * length, 0.12 * length),
                 (deck - 0.1, deck + 0.45), (0.11 * length, 0.085 * length))  # fmt: skip
    stays = [[head, bow], [head, [-0.49 * length, 0, deck]]]
    parts = [
        _loft(low, "paint", ends=True),
        tube([[foot, 0, 0], [foot, 0, mast]], [0.08, 0.06], "metal", 6),
        _limbs([[foot, 0, deck + 1.45], end], np.full(2, 0.06), "metal", 5),
        _limbs(stays, np.full(2, 0.012), "metal", 3),
    ]
    if random.random() < 0.55:
        belly = 0.05 * length * (1 if side > 0 else -1)
        parts.append(
            _sail(np.array([foot, 0, deck + 1.55]), np.add(end, [0.1, 0, 0.05]), head, belly)
        )
        clew = np.array([foot - 0.03 * length, side * 0.3 * length, deck + 1.0])
        parts.append(_sail(bow, clew, head * [1, 1, 0.9], belly))
    return parts


def boat(random: Random, kind: str | None = None) -> Mesh:
    """Return a rowing boat, a fishing boat or a yacht along x, afloat at z = 0."""
    kind = kind or str(random.choice(["rowing", "fishing", "yacht"]))
    name = str(random.choice(["paint", "wood"])) if kind == "rowing" else "paint"
    if kind == "rowing":
        length, free = random.uniform(3, 5), random.uniform(0.38, 0.5)
        seats = np.outer([-0.32, -0.09, 0.13], [length, 0, 0])
        seats[:, 2] = free * 0.72
        seat = box(0.25, length * 0.27, 0.04, "wood")
        return joined([*_hull(length, length * 0.35, free, 0.15, name, 0.6), _copies(seat, seats)])
    if kind == "yacht":
        length = random.uniform(6, 13)
        free = 0.3 + 0.07 * length
        hull = _hull(length, length * 0.3, free, 0.06 * length, name, 0.08)
        return joined([*hull, *_yacht(random, length, free)])
    length = random.uniform(5.5, 11)
    free, at = 0.3 + 0.08 * length, length * random.choice([-0.2, 0.1])
    tall, wide = 1.9, length * 0.085
    house = _cabin(
        (at - wide, at + wide),
        (at - wide, at + wide * 1.1),
        (free * 0.5, free + tall),
        (wide, wide),
    )
    panes = _cabin((at - wide * 1.02, at + wide * 1.07), (at - wide * 1.02, at + wide * 1.12),
                   (free + 1.05, free + 1.6), (wide * 1.02, wide * 1.02))  # fmt: skip
    mast = [[at - wide, 0, free], [at - wide, 0, free + tall + length * 0.25]]
    return joined([
        *_hull(length, length * 0.33, free, 0.07 * length, name, 0.25),
        _loft(house, "paint", ends=True),
        _loft(panes, "glass"),
        box(2.6 * wide, 2.3 * wide, 0.08, "wood").moved((at, 0, free + tall)),
        tube(mast, [0.06, 0.04], "wood", 5),
    ])  # fmt: skip


def lamp_post(random: Random) -> Mesh:
    """Return a street lamp: a tall one with an arm along +x, or a lantern on a post."""
    if random.random() < 0.5:
        height, reach = random.uniform(5, 9), random.uniform(0.8, 1.8)
        arm = [[0, 0, height * 0.9], [reach * 0.12, 0, height * 0.97], [reach, 0, height]]
        return joined([
            tube([[0, 0, 0], [0, 0, height * 0.92]], [0.11, 0.06], "metal", 7),
            _limbs(arm, np.array([0.05, 0.045, 0.04]), "metal", 5, ends=True),
            box(0.6, 0.24, 0.1, "metal").moved((reach + 0.2, 0, height - 0.02)),
            box(0.45, 0.18, 0.03, "lamp").moved((reach + 0.22, 0, height - 0.05)),
        ])  # fmt: skip
    height = random.uniform(2.6, 4)
    post = np.array([[0, 0, 0], [0, 0, 0.35], [0, 0, 0.4], [0, 0, height]])
    lantern = [(height, 0.07), (height + 0.4, 0.17)]
    return joined([
        tube(post, [0.13, 0.11, 0.06, 0.045], "metal", 8),
        _oval(lantern, "lamp", 1, 6),
        _oval([(height + 0.4, 0.21), (height + 0.55, 0.06), (height + 0.65, 0.01)], "metal", 1, 6),
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
                _copies(foot.moved(scaled=(2, 1, 1)), legs),
                box(length, 0.5, 0.1, name).moved((0, 0, seat)),
            ]
        )
    slats = np.array([[0, y, seat] for y in (-0.18, -0.06, 0.06, 0.18)])
    parts = [_copies(foot, legs), _copies(box(length, 0.1, 0.035, "wood"), slats)]
    if random.random() < 0.75:
        backs = np.array([[0, 0.24 + 0.05 * i, seat + 0.15 + 0.15 * i] for i in range(3)])
        parts.append(_copies(box(length, 0.03, 0.11, "wood"), backs))
        stay = _limbs([[0, 0.2, seat], [0, 0.38, seat + 0.55]], np.full(2, 0.03), "metal")
        parts.append(_copies(stay, legs))
    return joined(parts)


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
    parts = [_copies(post, posts), _copies(rail, rails)]
    if kind == "pickets":
        x = np.arange(-length / 2 + 0.08, length / 2, 0.14)
        parts.append(
            _copies(
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
        parts.append(_copies(box(0.07, 0.07, 0.14, "stone"), pins))
    if random.random() < 0.4:  # a transformer
        drum = tube([[-0.35, 0, height - 2.2], [-0.35, 0, height - 1.3]], [0.22, 0.22], "metal", 8)
        parts.append(drum)
    return joined(parts)


def power_line(a: np.ndarray, b: np.ndarray, sag: float, radius: float = 0.02) -> Mesh:
    """Return a wire from ``a`` to ``b`` that hangs ``sag`` metres at its middle."""
    t = np.linspace(0, 1, 17)[:, None]
    path = np.asarray(a) * (1 - t) + np.asarray(b) * t - 4 * sag * t * (1 - t) * [0, 0, 1]
    return _limbs(path, np.full(17, radius), "rubber", 3)


def sign(random: Random) -> Mesh:
    """Return a road sign or a notice that faces -y."""
    height, radius = random.uniform(1.9, 2.6), random.uniform(0.28, 0.42)
    sides = int(random.choice([3, 4, 8, 16]))
    angles = np.arange(sides) * TURN / sides + (np.pi / 2 if sides == 3 else np.pi / sides)
    wide = random.uniform(1, 1.8) if sides == 4 else 1
    rim = np.stack([np.cos(angles) * wide, 0 * angles, np.sin(angles)], -1) * radius
    plate = _loft(np.stack([rim, rim - [0, 0.03, 0]]), "paint", ends=True)
    posts = [-0.7, 0.7] if wide > 1.4 else [0]
    pole = tube([[0, 0, 0], [0, 0, height + radius * 0.6]], [0.035, 0.035], "metal", 6)
    places = np.array([[x * radius, 0, 0] for x in posts])
    return joined([plate.moved((0, -0.04, height)), _copies(pole, places)])


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
    bale = _limbs(path, radius * np.array([0.93, 1, 1, 0.93]), "dry_grass", 18, ends=True)
    return _lumpy(random, bale, 0.012).moved((0, 0, radius * 0.97))


def bollard(random: Random) -> Mesh:
    """Return a bollard, 0.6-1.1 m."""
    height, radius = random.uniform(0.6, 1.1), random.uniform(0.06, 0.16)
    name = str(random.choice(["metal", "stone", "plastic"]))
    rows = [(0, 1.15), (0.06, 1.0), (0.75, 0.9), (0.78, 1.1), (0.92, 1.1), (1.0, 0.5)]
    return _oval([(up * height, wide * radius) for up, wide in rows], name, 1, 9)


def umbrella(random: Random) -> Mesh:
    """Return a café table with a parasol and some chairs."""
    height, reach, table = (
        random.uniform(2.2, 2.8),
        random.uniform(1.1, 1.8),
        random.uniform(0.35, 0.5),
    )
    sides, cloth = int(random.choice([4, 6, 8])), str(random.choice(["cloth", "cloth2", "sail"]))
    parts = [
        _oval([(height - 0.62, reach), (height - 0.5, reach), (height, 0.04)], cloth, 1, sides),
        tube([[0, 0, 0], [0, 0, height]], [0.025, 0.02], "metal", 6),
        tube([[0, 0, 0], [0, 0, 0.06]], [0.25, 0.22], "metal", 8),
        _oval([(0.7, table), (0.74, table)], "wood", 1, 12),
    ]
    parts[0] = _loft(parts[0].vertices[: 3 * sides].reshape(3, sides, 3), cloth)
    seats = np.array([[x * 0.18, y * 0.18, 0] for x in (-1, 1) for y in (-1, 1)])
    chair = joined([
        _copies(box(0.03, 0.03, 0.44, "metal"), seats),
        box(0.42, 0.42, 0.04, "plastic").moved((0, 0, 0.44)),
        box(0.04, 0.42, 0.45, "plastic").moved((0.2, 0, 0.46)),
    ])  # fmt: skip
    for turn in random.uniform(0, TURN) + np.arange(int(random.integers(0, 5))) * TURN / 4:
        away = table + random.uniform(0.2, 0.4)
        parts.append(chair.moved((np.cos(turn) * away, np.sin(turn) * away, 0), turn))
    return joined(parts)


def statue(random: Random) -> Mesh:
    """Return a stone figure on a plinth, 2.5-6 m."""
    scale, high, wide = random.uniform(1, 1.8), random.uniform(0.8, 2), random.uniform(0.8, 1.1)
    steps = [(1.35, 0.0, 0.18), (1.0, 0.18, high - 0.15), (1.15, high, 0.18)]
    plinth = [box(w * wide, w * wide, tall, "stone").moved((0, 0, z)) for w, z, tall in steps]
    figure = _all(person(random), "stone").moved((0, 0, high / scale + 0.18 / scale))
    return joined([*plinth, figure.moved(scaled=scale)])


def pier(random: Random, length: float) -> Mesh:
    """Return a wooden deck along x about the origin, 1 m over z = 0, on piles that go below."""
    wide, deck, board = random.uniform(1.4, 3), random.uniform(0.8, 1.2), max(0.2, length / 150)
    x = np.arange(-length / 2 + board / 2, length / 2, board)
    boards = _copies(box(board * 0.92, wide, 0.05, "wood"), np.stack([x, 0 * x, 0 * x + deck], -1))
    beam = box(length, 0.12, 0.2, "wood")
    beams = _copies(beam, np.array([[0, s * wide * 0.42, deck - 0.2] for s in (-1, 1)]))
    at = np.linspace(-length / 2 + 0.3, length / 2 - 0.3, max(2, round(length / 2.5)))
    top = deck + random.choice([-0.1, 0.35, 0.9])
    pile = tube([[0, 0, -3], [0, 0, top]], [0.13, 0.12], "wood", 7)
    places = np.array([[i, s * (wide / 2 + 0.1), 0] for i in at for s in (-1, 1)])
    parts = [boards, beams, _copies(pile, places)]
    if top > deck + 0.8:
        rail = box(length, 0.08, 0.08, "wood")
        parts.append(_copies(rail, np.array([[0, s * (wide / 2 + 0.1), top] for s in (-1, 1)])))
    return joined(parts)


def bridge(random: Random, length: float) -> Mesh:
    """Return a humped stone bridge along x about the origin, of arches that stand on z = 0."""
    spans, wide = max(1, round(length / random.uniform(7, 11))), random.uniform(2, 4)
    t = np.linspace(0, 1, 14 * spans + 1)
    rise = min(3.5, 0.3 * length / spans) * random.uniform(0.8, 1.1)
    arch = np.sqrt(np.maximum(0, 1 - (np.minimum(np.abs((t * spans) % 1 - 0.5) / 0.44, 1)) ** 2))
    top = rise + 0.6 + 0.05 * length * (np.sin(np.pi * t) - 0.5)
    low = np.minimum(rise * arch, top - 0.3) - 0.5 * (arch == 0)
    sides = ((-1, low), (1, low), (1, top), (-1, top))
    rings = [np.stack([(t - 0.5) * length, 0 * t + s * wide / 2, z], -1) for s, z in sides]
    walls = []
    for side in (-1, 1):
        corners = ((side - 0.12, 0), (side + 0.12, 0), (side + 0.12, 0.85), (side - 0.12, 0.85))
        wall = [
            np.stack([(t - 0.5) * length, 0 * t + y * wide / 2, top - 0.05 + z], -1)
            for y, z in corners
        ]
        walls.append(_loft(np.stack(wall, 1), "stone", ends=True))
    return joined([_loft(np.stack(rings, 1), "stone", ends=True), *walls])


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
        blade = _loft(rings, name, ends=True)
        parts.append(blade.moved((height * 0.06, 0, height)))
    return joined(parts)
