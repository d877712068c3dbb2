"""What tests of worlds share: chance by a seed, what holds for every mesh, land by a formula."""

import ast
import functools
import inspect
from pathlib import Path

import numpy as np

from training.worlds import ground
from training.worlds.ground import Ground


def chance(seed=0):
    return np.random.default_rng(seed)


def check(found):
    """Every mesh: finite, its faces and materials within what there is."""
    assert np.isfinite(found.vertices).all()
    assert found.vertices.shape[1:] == (3,)
    assert found.faces.shape[1:] == (4,)
    assert 0 <= found.faces.min() <= found.faces.max() < len(found.vertices)
    assert found.materials.shape == (len(found.faces),)
    assert 0 <= found.materials.min() <= found.materials.max() < len(found.names)


def open_edges(found):
    """Edges, as pairs of places, that no other face goes along the other way."""
    _, place = np.unique(found.vertices.round(7), axis=0, return_inverse=True)
    faces = place.reshape(-1)[found.faces]
    edges = np.stack([faces, np.roll(faces, -1, 1)], -1).reshape(-1, 2)
    edges = [(int(a), int(b)) for a, b in edges if a != b]
    assert len(set(edges)) == len(edges), "two faces go along an edge the same way"
    return set(edges) - {(b, a) for a, b in edges}


def facing(found):
    """Twice the vector areas of the faces, (M, 3): along the normals."""
    a, b, c, d = found.vertices[found.faces].transpose(1, 0, 2)
    return np.cross(c - a, d - b)


def volume(found):
    a, b, c, d = found.vertices[found.faces].transpose(1, 0, 2)
    return ((np.cross(a, b) * c).sum() + (np.cross(a, c) * d).sum()) / 6


@functools.cache
def materials_known():
    """Names and classes of ``materials._TABLE``, read: to import it takes Blender."""
    path = Path(inspect.getfile(ground)).with_name("materials.py")
    for statement in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(statement, ast.AnnAssign) and statement.target.id == "_TABLE":
            return {name: row[3] for name, row in ast.literal_eval(statement.value).items()}
    raise AssertionError("materials.py has no _TABLE any more")


def is_known(name):
    return name in materials_known() or name in {"water", "glass"} or name.startswith("wall")


def grid(count=120, step=0.37):
    return np.meshgrid(np.arange(count) * step - 17.0, np.arange(count) * step - 9.0)


def rolling(water=None):
    """Hills by a formula, green below a metre and rock above it, scree where it is steep."""

    def heights(x, y):
        return 2 * np.sin(x / 30) + np.cos(y / 50)

    def cover(x, y, z, slope):
        return np.where(slope > 0.06, 2, np.where(z > 1, 1, 0))

    return Ground(heights, cover, ("grass", "rock", "scree"), water)


def coarsen(monkeypatch):
    """Ask for fewer texels of land: the same mesh, made faster."""
    for name, count in (("_RINGS", 40), ("_SEEN", 30), ("_BEHIND", 10)):
        monkeypatch.setattr(ground, name, count)
