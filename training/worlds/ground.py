"""The land itself: heights by noise, a mesh that is fine near the camera, and what grows where."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from training.worlds.mesh import Mesh, Random

Heights = Callable[[np.ndarray, np.ndarray], np.ndarray]

_NEAREST, _FARTHEST = 0.5, 14_000.0  # metres
_RINGS, _SEEN, _BEHIND = 230, 230, 70  # texels of the mesh: outwards, in view, elsewhere


class Noise:
    """Gradient noise of the plane (Perlin 2002), about -0.7 to 0.7."""

    def __init__(self, random: Random) -> None:
        self._table = random.permutation(1024)
        angles = random.uniform(0, 2 * np.pi, 1024)
        self._gradients = np.stack([np.cos(angles), np.sin(angles)], -1)

    def __call__(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        column, row = np.floor(x).astype(int), np.floor(y).astype(int)
        u, v = x - column, y - row
        corners = []
        for i in (0, 1):
            for j in (0, 1):
                at = self._table[(self._table[(column + i) & 1023] + row + j) & 1023]
                gradient = self._gradients[at]
                corners.append(gradient[..., 0] * (u - i) + gradient[..., 1] * (v - j))
        u, v = (t * t * t * (t * (t * 6 - 15) + 10) for t in (u, v))
        below = corners[0] + v * (corners[1] - corners[0])
        above = corners[2] + v * (corners[3] - corners[2])
        return below + u * (above - below)

    def fractal(
        self, x: np.ndarray, y: np.ndarray, size: float, octaves: int = 7, gain: float = 0.5
    ) -> np.ndarray:
        """Return the sum of octaves, the largest ``size`` metres across."""
        return sum(
            gain**i * self(x / size * 2.03**i + 7.1 * i, y / size * 2.03**i - 3.7 * i)
            for i in range(octaves)
        )

    def ridges(self, x: np.ndarray, y: np.ndarray, size: float, octaves: int = 7) -> np.ndarray:
        """Return sharp crests over broad valleys, 0 to about 1.6 (Musgrave's ridged noise)."""
        total, weight = np.zeros_like(x, dtype=float), 1.0
        for i in range(octaves):
            crest = (
                1 - 1.6 * np.abs(self(x / size * 2.03**i + 7.1 * i, y / size * 2.03**i - 3.7 * i))
            ) ** 2
            total = total + 0.5**i * crest * weight
            weight = np.clip(crest, 0, 1)
        return total


@dataclass
class Ground:
    """Heights of the land in metres, with what covers it.

    Parameters
    ----------
    heights : function of x, y (metres; y is ahead of the camera) to z
    cover : function of x, y, z, slope (tangent) to an index into ``names``
    names : materials
    water : level of water in metres, or None
    """

    heights: Heights
    cover: Callable[[np.ndarray, np.ndarray, np.ndarray, np.ndarray], np.ndarray]
    names: tuple[str, ...]
    water: float | None = None
    flat: list[tuple[float, float, float]] = field(default_factory=list)

    def at(self, x: np.ndarray | float, y: np.ndarray | float) -> np.ndarray:
        """Return heights, never below the water."""
        z = self.heights(np.asarray(x, float), np.asarray(y, float))
        return z if self.water is None else np.maximum(z, self.water)

    def slope(self, x: np.ndarray, y: np.ndarray, step: float = 1.0) -> np.ndarray:
        """Return the tangent of the steepest slope."""
        across = self.heights(x + step, y) - self.heights(x - step, y)
        along = self.heights(x, y + step) - self.heights(x, y - step)
        return np.hypot(across, along) / (2 * step)

    def mesh(self, half_angle: float, around: tuple[float, float] = (0.0, 0.0)) -> Mesh:
        """Return the land about ``around``; ``half_angle`` (radians) about +y is in view."""
        radii = np.geomspace(_NEAREST, _FARTHEST, _RINGS)
        half_angle = min(half_angle, 0.9 * np.pi)
        seen = np.linspace(-half_angle, half_angle, _SEEN)
        behind = np.linspace(half_angle, 2 * np.pi - half_angle, _BEHIND + 2)[1:-1]
        angles = np.concatenate([seen, behind])
        x = around[0] + radii[:, None] * np.sin(angles)
        y = around[1] + radii[:, None] * np.cos(angles)
        z = self.heights(x, y)
        vertices = np.stack([x, y, z], -1).reshape(-1, 3)
        middle = np.array([[*around, float(self.heights(*np.array(around)))]])
        ring, turn = np.meshgrid(np.arange(_RINGS - 1), np.arange(len(angles)), indexing="ij")
        after = (turn + 1) % len(angles)
        corner = ring * len(angles)
        quads = np.stack(
            [
                corner + turn,
                corner + after,
                corner + len(angles) + after,
                corner + len(angles) + turn,
            ],
            -1,
        ).reshape(-1, 4)
        first = np.arange(len(angles))
        centre = np.full_like(first, len(vertices))
        cap = np.stack([centre, np.roll(first, -1), first, first], -1)
        faces = np.concatenate([quads, cap])
        vertices = np.concatenate([vertices, middle])
        centres = vertices[faces].mean(1)
        span = np.linalg.norm(vertices[faces[:, 0]] - vertices[faces[:, 2]], axis=1)
        slope = self.slope(centres[:, 0], centres[:, 1], np.maximum(span / 2, 0.2))
        cover = self.cover(centres[:, 0], centres[:, 1], centres[:, 2], slope)
        return Mesh(vertices, faces, np.asarray(cover, int), self.names, smooth=True)

    def sheet(self) -> Mesh:
        """Return the water's surface as far as the horizon."""
        level = 0.0 if self.water is None else self.water
        r = 4 * _FARTHEST
        square = np.array([[-r, -r, level], [r, -r, level], [r, r, level], [-r, r, level]])
        return Mesh(square, np.array([[0, 1, 2, 3]]), np.zeros(1, int), ("water",))
