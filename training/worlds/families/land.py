"""Lie of the land and what covers it: hills, peaks, shores, rules for covers."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from training.worlds.ground import Ground, Noise
from training.worlds.mesh import Random


def hills(random: Random, height: float, size: float, *, flat: float = 30.0) -> Callable:
    """Return rolling land, level near the camera."""
    noise, tilt = Noise(random), random.uniform(-0.02, 0.03)

    def heights(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        away = np.hypot(x, y)
        broad = noise.fractal(x, y, size, 8, 0.45) - noise.fractal(
            np.zeros(()), np.zeros(()), size, 8, 0.45
        )
        fine = 0.04 * noise.fractal(x, y, 1.1, 4)
        return (
            height * broad * np.clip(away / flat, 0.02, 1)
            + fine
            + tilt * np.minimum(away, 400) * (y > 0)
        )

    return heights


def peaks(random: Random, heights: Callable, tall: float, begin: float, size: float) -> Callable:
    """Return the same land with mountains from ``begin`` metres on."""
    noise = Noise(random)

    def with_peaks(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        rise = np.clip((np.hypot(x, y) - begin) / (1.5 * begin), 0, 1) ** 1.5
        wide = np.clip(noise.fractal(x, y, 3 * size, 3) + 0.55, 0.1, 1.2)
        return heights(x, y) + tall * rise * wide * noise.ridges(x, y, size, 9)

    return with_peaks


def shore(
    random: Random, heights: Callable, begin: float, slope: float, *, side: float
) -> Callable:
    """Return land that goes under water (z = 0): beyond a winding line, ``begin`` metres off."""
    noise = Noise(random)
    turn = side
    bank = random.uniform(0.5, 3.0)

    def sinking(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        out = x * np.sin(turn) + y * np.cos(turn) - begin
        out = out + 0.5 * begin * noise.fractal(x, y, 4 * begin + 20, 5)
        land = np.clip(heights(x, y) + bank, 0.05, None)
        return np.where(
            out < 0, np.minimum(land, -out * slope + 0.02 * land), np.maximum(-out * slope, -12)
        )

    return sinking


class Spots(NamedTuple):
    """Places on the ground: metres, tangent of the slope, and noise in patches about 0."""

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    slope: np.ndarray
    noise: np.ndarray


def cover_by_rules(
    random: Random, *rules: tuple[str, Callable]
) -> tuple[Callable, tuple[str, ...]]:
    """Return a cover by rules, later ones over earlier: a name, and a test of ``Spots``."""
    noise = Noise(random)

    def cover(x: np.ndarray, y: np.ndarray, z: np.ndarray, slope: np.ndarray) -> np.ndarray:
        patches = noise.fractal(x, y, 60.0, 6) + noise.fractal(x, y, 4.0, 3) * 0.3
        index = np.zeros(x.shape, int)
        for i, (_, rule) in enumerate(rules):
            index = np.where(rule(Spots(x, y, z, slope, patches)), i, index)
        return index

    return cover, tuple(name for name, _ in rules)


def always(spots: Spots) -> np.ndarray:
    return np.ones_like(spots.x, bool)


def green(random: Random) -> str:
    return str(random.choice(["grass", "meadow", "grass", "dry_grass", "heath", "crop"]))


def level_ground(random: Random, name: str) -> Ground:
    noise = Noise(random)
    cover, names = cover_by_rules(
        random, (name, always), ("grass", lambda p: (p.noise > 0.2) & (np.hypot(p.x, p.y) > 120))
    )
    return Ground(lambda x, y: 0.015 * noise.fractal(x, y, 8.0, 3) - 0.03, cover, names)
