"""Families of wild land: woods, dunes, snow, mountains."""

from __future__ import annotations

import numpy as np

from training.worlds.buildings.churches import church
from training.worlds.buildings.farms import barn, shed
from training.worlds.buildings.houses import house
from training.worlds.families.land import always, cover_by_rules, green, hills, peaks
from training.worlds.families.placing import (
    build_houses,
    lay_rocks,
    plant_trees,
    plant_tufts,
    spread,
    stand_people,
)
from training.worlds.families.world import World
from training.worlds.ground import Ground, Noise
from training.worlds.mesh import Random
from training.worlds.props.plants import bush


def woods(random: Random) -> World:
    """Inside a wood or at its edge; light falls through crowns."""
    land = hills(random, random.uniform(1, 10), random.uniform(40, 150), flat=15)
    cover, names = cover_by_rules(
        random,
        ("soil", always),
        ("grass", lambda p: p.noise > 0.05),
        ("dry_leaves", lambda p: p.noise < -0.2),
        ("soil", lambda p: np.abs(p.x + 4 * np.sin(p.y / 15)) < 1.4),
    )
    world = World(Ground(land, cover, names), eye=(1.3, 3), clear=2.0)
    kind = str(random.choice(["conifer", "mixed", "broadleaf", "autumn", "bare"]))
    plant_trees(random, world, int(random.integers(60, 260)), random.uniform(4, 14), 160, kind)
    plant_trees(random, world, 60, 120, 500, kind)
    plant_tufts(random, world, 60)
    lay_rocks(random, world, 8, 2, 30, 0.8)
    if random.random() < 0.3:
        stand_people(random, world, 1, 5, 30)
    return world


def dunes(random: Random) -> World:
    """Sand: crests with a steep lee side."""
    noise, size, tall = Noise(random), random.uniform(25, 120), random.uniform(2, 18)
    turn = random.uniform(0, np.pi)

    def heights(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        u = x * np.cos(turn) + y * np.sin(turn) + 0.6 * size * noise.fractal(x, y, 3 * size, 3)
        v = (u / size) % 1.0
        crest = np.where(v < 0.72, v / 0.72, (1 - v) / 0.28)
        crest = crest * crest * (3 - 2 * crest)
        wave = tall * crest * np.clip(0.6 + noise.fractal(x, y, 5 * size, 3), 0.1, 1.3)
        return (wave + 0.03 * noise.fractal(x, y, 0.9, 3)) * np.clip(np.hypot(x, y) / 12, 0.05, 1)

    cover, names = cover_by_rules(
        random,
        ("sand", always),
        ("red_rock" if random.random() < 0.3 else "sand", lambda p: p.slope > 1.2),
    )
    world = World(Ground(heights, cover, names), eye=(1.4, 5))
    plant_tufts(random, world, int(random.integers(0, 40)), "dry_grass", 40)
    if random.random() < 0.3:
        stand_people(random, world, 2, 6, 120)
    if random.random() < 0.3:
        world.put(bush(random), spread(random, world.ground, 20, 5, 200))
    return world


def snow(random: Random) -> World:
    """A winter field, firs and huts before white slopes."""
    land = hills(random, random.uniform(2, 25), random.uniform(80, 400), flat=25)
    if random.random() < 0.6:
        land = peaks(
            random,
            land,
            random.uniform(100, 1200),
            random.uniform(200, 2500),
            random.uniform(500, 3000),
        )
    cover, names = cover_by_rules(
        random,
        ("snow", always),
        ("rock", lambda p: p.slope > 1.0 + 0.5 * p.noise),
        ("dry_grass", lambda p: (p.noise > 0.45) & (np.hypot(p.x, p.y) < 100)),
        ("forest", lambda p: (p.noise > 0.1) & (np.hypot(p.x, p.y) > 400) & (p.z < 200)),
    )
    world = World(Ground(land, cover, names), eye=(1.4, 6))
    plant_trees(
        random,
        world,
        int(random.integers(10, 70)),
        8,
        1200,
        str(random.choice(["conifer", "bare"])),
    )
    lay_rocks(random, world, 8, 3, 60, 1.0)
    if random.random() < 0.4:
        build_houses(random, world, [house, shed, barn], 5, 20, 250)
    if random.random() < 0.4:
        stand_people(random, world, 3)
    return world


def mountains(random: Random) -> World:
    """Peaks behind meadows, scree or forest."""
    land = hills(random, random.uniform(5, 40), random.uniform(100, 400), flat=30)
    land = peaks(
        random,
        land,
        random.uniform(250, 2200),
        random.uniform(150, 3000),
        random.uniform(600, 4000),
    )
    line, trees = random.uniform(300, 2500), random.uniform(50, 700)
    cover, names = cover_by_rules(
        random,
        (green(random), always),
        (
            "forest",
            lambda p: (
                (p.z > 20 + 80 * p.noise)
                & (p.z < trees + 150 * p.noise)
                & (np.hypot(p.x, p.y) > 300)
            ),
        ),
        ("scree", lambda p: (p.z > trees + 200 * p.noise) | (p.slope > 0.7 + 0.5 * p.noise)),
        ("rock" if random.random() < 0.8 else "red_rock", lambda p: p.slope > 0.95 + 0.4 * p.noise),
        ("snow", lambda p: (p.z > line + 250 * p.noise) & (p.slope < 1.3 + 0.3 * p.noise)),
    )
    world = World(Ground(land, cover, names), eye=(1.4, 20))
    plant_trees(random, world, 40, 15, 2000, str(random.choice(["conifer", "mixed", "autumn"])))
    lay_rocks(random, world, 25, 3, 120, 2.0)
    plant_tufts(random, world, 40)
    if random.random() < 0.3:
        build_houses(random, world, [house, shed, church], 5, 40, 500)
    if random.random() < 0.2:
        stand_people(random, world, 1)
    return world
