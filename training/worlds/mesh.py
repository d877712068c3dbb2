"""Meshes as arrays: what stands in a world before Blender sees it. Metres, z up, right-handed."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

Random = np.random.Generator


@dataclass(frozen=True)
class Mesh:
    """Triangles and quads with a material each.

    Parameters
    ----------
    vertices : (N, 3) float, metres; the origin is where it stands on the ground
    faces : (M, 4) int, anticlockwise seen from outside; a triangle repeats its last index
    materials : (M,) int, index into ``names``
    names : of materials, as in ``materials.py``
    smooth : shade as a round surface
    """

    vertices: np.ndarray
    faces: np.ndarray
    materials: np.ndarray
    names: tuple[str, ...]
    smooth: bool = False

    def moved(
        self,
        by: tuple[float, float, float] = (0, 0, 0),
        turned: float = 0.0,
        scaled: float | tuple[float, float, float] = 1.0,
    ) -> Mesh:
        """Return it scaled, then turned about z (radians), then moved (metres)."""
        cosine, sine = np.cos(turned), np.sin(turned)
        turn = np.array([[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1]])
        vertices = (self.vertices * np.asarray(scaled)) @ turn + np.asarray(by)
        return Mesh(vertices, self.faces, self.materials, self.names, self.smooth)


def mesh(vertices: np.ndarray, faces: Iterable, name: str, *, smooth: bool = False) -> Mesh:
    """Return a mesh of one material; ``faces`` of three or four indices."""
    quads = np.array([[*f, f[-1]][:4] for f in faces], int).reshape(-1, 4)
    return Mesh(np.asarray(vertices, float), quads, np.zeros(len(quads), int), (name,), smooth)


def joined(parts: Iterable[Mesh]) -> Mesh:
    """Return all parts as one mesh, materials of the same name shared; smooth if the first is."""
    parts = list(parts)
    names = tuple(dict.fromkeys(name for part in parts for name in part.names))
    starts = np.cumsum([0] + [len(part.vertices) for part in parts[:-1]])
    index = [np.array([names.index(name) for name in part.names]) for part in parts]
    return Mesh(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate([part.faces + start for part, start in zip(parts, starts, strict=True)]),
        np.concatenate([of[part.materials] for part, of in zip(parts, index, strict=True)]),
        names,
        parts[0].smooth,
    )


_CUBE = np.array([[x, y, z] for z in (0, 1) for y in (-0.5, 0.5) for x in (-0.5, 0.5)])
_SIDES = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))


def box(width: float, depth: float, height: float, name: str) -> Mesh:
    """Return a box that stands on z = 0, centred on the origin (x by y by z)."""
    return mesh(_CUBE * (width, depth, height), _SIDES, name)


def tube(path: np.ndarray, radii: np.ndarray, name: str, sides: int = 6) -> Mesh:
    """Return a smooth tube along ``path`` (K, 3) with ``radii`` (K,), its end closed to a point."""
    path = np.asarray(path, float)
    along = np.gradient(path, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True) + 1e-9
    across = np.cross(along, np.where(np.abs(along[:, 2:]) < 0.9, [[0, 0, 1.0]], [[1.0, 0, 0]]))
    across /= np.linalg.norm(across, axis=1, keepdims=True) + 1e-9
    beside = np.cross(along, across)
    angles = np.arange(sides) * 2 * np.pi / sides
    rings = (
        path[:, None]
        + (np.cos(angles)[:, None] * across[:, None] + np.sin(angles)[:, None] * beside[:, None])
        * np.asarray(radii, float)[:, None, None]
    )
    vertices = np.concatenate([rings.reshape(-1, 3), path[-1:]])
    faces = [
        (i * sides + j, i * sides + k, (i + 1) * sides + k, (i + 1) * sides + j)
        for i in range(len(path) - 1)
        for j in range(sides)
        for k in [(j + 1) % sides]
    ]
    last = (len(path) - 1) * sides
    faces += [(last + j, last + (j + 1) % sides, len(vertices) - 1) for j in range(sides)]
    return mesh(vertices, faces, name, smooth=True)


def ball(radius: float, name: str, rings: int = 8, around: int = 12) -> Mesh:
    """Return a smooth sphere about the origin."""
    polar = np.linspace(0, np.pi, rings + 1)[:, None]
    turn = np.arange(around) * 2 * np.pi / around
    vertices = radius * np.stack(
        [np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar) + 0 * turn], -1
    )
    faces = [
        (i * around + j, (i + 1) * around + j, (i + 1) * around + k, i * around + k)
        for i in range(rings)
        for j in range(around)
        for k in [(j + 1) % around]
    ]
    return mesh(vertices.reshape(-1, 3), faces, name, smooth=True)
