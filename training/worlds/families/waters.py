"""Families by the water: coast, lake, harbour, fjord."""

from __future__ import annotations

import numpy as np

from training.worlds.buildings.farms import barn, shed
from training.worlds.buildings.houses import house, row
from training.worlds.buildings.lighthouses import lighthouse
from training.worlds.families.land import always, cover_by_rules, green, hills, peaks, shore
from training.worlds.families.placing import (
    afloat,
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
from training.worlds.props.boats import boat
from training.worlds.props.bridges import pier
from training.worlds.props.plants import reeds


def coast(random: Random) -> World:
    """A beach or rocks, sea to the horizon, at times cliffs beside it."""
    rocky = random.random() < 0.5
    land = hills(random, random.uniform(1, 14), random.uniform(60, 300), flat=20)
    if random.random() < 0.4:
        land = peaks(
            random,
            land,
            random.uniform(40, 400),
            random.uniform(150, 900),
            random.uniform(300, 1500),
        )
    heights = shore(
        random,
        land,
        random.uniform(4, 40),
        random.uniform(0.03, 0.25),
        side=random.uniform(-1.1, 1.1),
    )
    cover, names = cover_by_rules(
        random,
        ("rock" if rocky else "sand", always),
        ("wet_sand", lambda p: (p.z < 0.25) & (not rocky)),
        (green(random), lambda p: (p.z > 3 + 3 * p.noise) & (p.slope < 0.7 + p.noise)),
        ("rock", lambda p: p.slope > 0.75 + 0.4 * p.noise),
    )
    world = World(Ground(heights, cover, names, 0.0), eye=(1.4, 12), waves=random.uniform(0.1, 0.7))
    lay_rocks(random, world, 60 if rocky else 6, 2.5, 80, 1.6 if rocky else 0.6)
    if random.random() < 0.4:
        stand_people(random, world, 3)
    if random.random() < 0.5:
        for _ in range(3):
            world.put(boat(random), afloat(random, world.ground, 3, 15, 500))
    if random.random() < 0.3:
        world.put(
            pier(random, random.uniform(15, 50)),
            [(random.uniform(-15, 15), random.uniform(8, 30), 0, 1.57, 1)],
        )
    if random.random() < 0.35:
        build_houses(random, world, [house, lighthouse, shed], 6, 30, 400)
    plant_trees(random, world, 14, 20, 600, "palm" if random.random() < 0.3 else "mixed")
    if not rocky:
        plant_tufts(random, world, 25, "dry_grass")
    return world


def lake(random: Random) -> World:
    """Still water before hills or mountains, reeds and trees on its banks."""
    land = hills(random, random.uniform(3, 15), random.uniform(80, 300), flat=25)
    far = random.uniform(150, 1200)
    if random.random() < 0.7:
        land = peaks(random, land, random.uniform(60, 900), far, random.uniform(500, 2500))
    noise, near, bank = Noise(random), random.uniform(2, 14), random.uniform(0.3, 1.5)
    snow_line = random.uniform(150, 900)

    def heights(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        wind = noise.fractal(x, y, 150.0, 5)
        inside = np.minimum(y - near + 6 * wind, (far - y) * 0.5 + 60 * wind)
        inside = np.minimum(inside, far - np.abs(x) * 0.6 + 60 * wind)
        ground = np.maximum(land(x, y) + bank, 0.1)
        return np.where(
            inside > 0, np.maximum(-inside * 0.2, -6), np.minimum(ground, 0.05 - inside * 0.35)
        )

    cover, names = cover_by_rules(
        random,
        (green(random), always),
        ("gravel", lambda p: p.z < 0.25),
        ("forest", lambda p: (p.z > 15 + 30 * p.noise) & (np.hypot(p.x, p.y) > 250)),
        (
            "rock",
            lambda p: (p.slope > 0.9 + 0.4 * p.noise) | (p.z > 0.8 * snow_line + 100 * p.noise),
        ),
        ("snow", lambda p: (p.z > snow_line + 150 * p.noise) & (p.slope < 1.3)),
    )
    world = World(
        Ground(heights, cover, names, 0.0),
        eye=(1.3, 8),
        waves=float(random.choice([0.01, 0.05, 0.15])),
    )
    kind = str(random.choice(["conifer", "mixed", "broadleaf", "autumn"]))
    plant_trees(random, world, 60, 8, 1500, kind)
    for _ in range(2):
        banks = [
            (x, y, 0.0, t, s)
            for x, y, z, t, s in spread(random, world.ground, 30, 2, 25, dry=-0.4)
            if z < 0.4
        ]
        world.put(reeds(random), banks)
    plant_tufts(random, world, 40)
    lay_rocks(random, world, 10, 2, 40, 0.8)
    if random.random() < 0.4:
        world.put(boat(random), afloat(random, world.ground, 3, 6, 80))
    if random.random() < 0.3:
        world.put(
            pier(random, random.uniform(6, 20)),
            [(random.uniform(-5, 5), near + 5, 0, 1.57, 1)],
        )
    if random.random() < 0.35:
        build_houses(random, world, [house, shed, barn], 5, 25, 300)
    return world


def harbour(random: Random) -> World:
    """Boats before a quay with houses."""
    land = hills(random, random.uniform(4, 30), random.uniform(100, 300), flat=10)
    near, far = random.uniform(3, 12), random.uniform(50, 140)

    def heights(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        behind = np.clip((y - far - 25) / 60, 0, 1) * np.abs(land(x, y))
        return np.where((y > near) & (y < far), -4.0, np.where(y < near, 1.2, 1.5 + behind))

    cover, names = cover_by_rules(
        random,
        ("paving", always),
        (green(random), lambda p: p.z > 4),
        ("forest", lambda p: p.z > 14 + 8 * p.noise),
    )
    world = World(Ground(heights, cover, names, 0.0), eye=(1.5, 9), waves=random.uniform(0.02, 0.2))
    world.things.append((row(random, 120.0), [(-60.0, far + 8, 1.45, 0.0, 1.0)]))
    for _ in range(8):
        world.put(boat(random), afloat(random, world.ground, 5, near + 4, far))
    for _ in range(2):
        world.put(pier(random, 30.0), [(random.uniform(-40, 40), far - 12, 0, 1.57, 1)])
    plant_trees(random, world, 15, far + 30, 600, "mixed")
    stand_people(random, world, 5, 3, far + 6)
    return world


def fjord(random: Random) -> World:
    """Test only: water between steep walls, a jetty, a few houses."""
    tall, wide = random.uniform(150, 900), random.uniform(60, 400)
    noise, bank = Noise(random), random.uniform(2, 9)

    def heights(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        bend = 0.4 * wide * noise.fractal(y * 0 + 3, y, 900.0, 3)
        off = np.abs(x - bend) - wide / 2
        wall = (
            tall * np.clip(off / (1.2 * tall), 0, 1.4) * (0.5 + noise.ridges(x, y, 700.0, 8) * 0.7)
        )
        shore = np.minimum(bank - y, wall + 60)
        rise = np.maximum(
            np.where(off > 0, 0.3 + wall, -8.0),
            np.where(y < bank, 0.3 + 0.25 * shore * (y < bank), -8.0),
        )
        end = tall * np.clip((y - 2500) / 3000, 0, 1) * noise.ridges(x, y, 900.0, 8)
        return np.where(
            (off > 0) | (y < bank), rise, np.where(end > 20, end, -8.0)
        ) + 0.02 * noise.fractal(x, y, 1.0, 3)

    cover, names = cover_by_rules(
        random,
        ("rock", always),
        ("meadow", lambda p: p.slope < 0.6 + 0.3 * p.noise),
        ("forest", lambda p: (p.z > 10) & (p.z < 260 + 90 * p.noise) & (p.slope < 1.3)),
        ("snow", lambda p: (p.z > 600 + 200 * p.noise) & (p.slope < 1.3)),
    )
    world = World(
        Ground(heights, cover, names, 0.0), eye=(1.5, 12), waves=random.uniform(0.02, 0.3)
    )
    plant_trees(random, world, 40, 10, 900, "conifer")
    build_houses(random, world, [house, shed], 5, 30, 500)
    world.put(boat(random), afloat(random, world.ground, 3, 10, 200))
    world.put(pier(random, 15.0), [(random.uniform(-8, 8), bank + 6, 0.0, 1.57, 1.0)])
    lay_rocks(random, world, 20, 2, 40, 1.0)
    return world
