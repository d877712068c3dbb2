"""A world before it is rendered: its ground, and what stands where."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from training.worlds.ground import Ground
from training.worlds.mesh import Mesh

Place = tuple[float, float, float, float, float]  # x, y, z in metres, turn in radians, scale


@dataclass
class World:
    """Ground, and meshes with the places where each stands."""

    ground: Ground
    things: list[tuple[Mesh, list[Place]]] = field(default_factory=list)
    eye: tuple[float, float] = (1.3, 4.0)  # range of the camera's height over ground, metres
    widest: float = 70.0  # degrees of vertical field of view
    narrowest: float = 14.0
    waves: float = 0.25
    clear: float = 3.0  # metres round the camera where nothing stands

    def put(self, mesh: Mesh, places: list[Place]) -> None:
        """Stand a mesh in all these places that are not on the camera's feet."""
        size = float(np.abs(mesh.vertices[:, :2]).max())
        free = [p for p in places if np.hypot(p[0], p[1]) > self.clear + size * p[4]]
        if free:
            self.things.append((mesh, free))
