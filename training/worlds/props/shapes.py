"""Shapes that things are made of: limbs, skins over rings, copies, dents."""

from __future__ import annotations

import numpy as np

from training.worlds.mesh import Mesh, Random, joined

TURN = 2 * np.pi


def raw(vertices: np.ndarray, faces: np.ndarray, name: str, *, smooth: bool = False) -> Mesh:
    """Return a mesh of one material from arrays; ``faces`` (M, 3) or (M, 4)."""
    if faces.shape[1] == 3:
        faces = np.column_stack([faces, faces[:, 2]])
    return Mesh(vertices.reshape(-1, 3), faces, np.zeros(len(faces), int), (name,), smooth)


def copies(part: Mesh, places: np.ndarray) -> Mesh:
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


def fan(rim: np.ndarray, name: str) -> Mesh:
    """Return the flat face within ``rim`` (R, 3), as triangles about its middle."""
    here = np.arange(len(rim))
    faces = np.stack([here, np.roll(here, -1), np.full(len(rim), len(rim))], -1)
    return raw(np.vstack([rim, rim.mean(0)]), faces, name)


def loft(
    rings: np.ndarray, name: str, *, around: bool = True, ends: bool = False, smooth: bool = False
) -> Mesh:
    """Return the skin over ``rings`` (..., S, R, 3), anticlockwise about the way they go."""
    rings = np.asarray(rings, float).reshape(-1, *np.shape(rings)[-3:])
    here = np.arange(rings.size // 3).reshape(rings.shape[:3])
    here, beside = (here, np.roll(here, -1, 2)) if around else (here[..., :-1], here[..., 1:])
    quads = np.stack([here[:, :-1], beside[:, :-1], beside[:, 1:], here[:, 1:]], -1)
    skin = raw(rings, quads.reshape(-1, 4), name, smooth=smooth)
    if not ends:
        return skin
    caps = [fan(rim, name) for of in rings for rim in (of[0, ::-1], of[-1])]
    return joined([skin, *caps])


def limbs_along(
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
    return loft(rings, name, ends=ends, smooth=True)


def ovals(rows: list[tuple[float, float]], name: str, deep: float, sides: int = 8) -> Mesh:
    """Return an upright skin of ovals: ``rows`` of height, half width (y); x ``deep`` as wide."""
    angles = np.arange(sides) * TURN / sides
    oval = np.stack([deep * np.cos(angles), np.sin(angles), 0 * angles], -1)
    return loft([oval * wide + [0, 0, up] for up, wide in rows], name, ends=True, smooth=True)


def cabin_rings(
    low: tuple[float, float], top: tuple[float, float], z: tuple, w: tuple
) -> np.ndarray:
    """Return a cabin's low and top ring (2, 4, 3): x from rear to front, z and half widths."""
    return np.array(
        [
            [[rear, -half, up], [front, -half, up], [front, half, up], [rear, half, up]]
            for (rear, front), up, half in zip((low, top), z, w, strict=True)
        ]
    )


def directions(random: Random, count: int) -> np.ndarray:
    """Return random directions."""
    ways = random.normal(size=(count, 3))
    return ways / (np.linalg.norm(ways, axis=1, keepdims=True) + 1e-9)


def lumpy(random: Random, part: Mesh, amount: float, fine: float = 2.0) -> Mesh:
    """Return it swollen and dented by smooth noise; ``part`` of about 1 m about the origin."""
    ways = random.normal(size=(3, 6)) * fine
    noise = np.sin(part.vertices @ ways + random.uniform(0, TURN, 6)).sum(1) / 2
    vertices = part.vertices * (1 + amount * noise[:, None])
    return Mesh(vertices, part.faces, part.materials, part.names, part.smooth)
