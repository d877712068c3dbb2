"""Families of farmed and travelled land: fields, a road, an orchard, a ruin."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from training.worlds.buildings.castles import castle_wall
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
from training.worlds.ground import Ground
from training.worlds.mesh import Random
from training.worlds.props.cars import car
from training.worlds.props.farmland import fence, hay_bale, utility_pole, wind_turbine
from training.worlds.props.plants import hedge
from training.worlds.props.trees import broadleaf


def field_(random: Random) -> World:
    """Farmland: fields, hedges, bales, a road perhaps, trees in the distance."""
    land = hills(random, random.uniform(2, 18), random.uniform(150, 500), flat=40)
    width, turn = random.uniform(20, 90), random.uniform(0, np.pi)
    kinds = [
        str(random.choice(["grass", "crop", "meadow", "soil", "dry_grass", "crop"]))
        for _ in range(4)
    ]

    def strip(k: int) -> Callable:
        return lambda p: (np.floor((p.x * np.cos(turn) + p.y * np.sin(turn)) / width) % 4) == k

    cover, names = cover_by_rules(random, *((kinds[k], strip(k)) for k in range(4)))
    world = World(Ground(land, cover, names), eye=(1.4, 6))
    plant_trees(
        random, world, 40, 12, 1800, str(random.choice(["broadleaf", "mixed", "autumn", "bare"]))
    )
    if random.random() < 0.4:
        world.put(hay_bale(random), spread(random, world.ground, 25, 6, 200, steepest=0.2))
    for _ in range(random.integers(0, 3)):
        world.put(fence(random, 40.0), spread(random, world.ground, 2, 6, 60, sizes=(1, 1)))
    for _ in range(random.integers(0, 3)):
        world.put(hedge(random, 30.0), spread(random, world.ground, 4, 20, 300, sizes=(1, 1)))
    if random.random() < 0.3:
        world.put(wind_turbine(random), spread(random, world.ground, 6, 300, 2500, sizes=(1, 1)))
    if random.random() < 0.4:
        world.put(utility_pole(random), [(8.0, 10 + 40.0 * i, 0, 0.1, 1) for i in range(8)])
    if random.random() < 0.4:
        build_houses(random, world, [barn, house, church], 4, 60, 600)
    plant_tufts(random, world, 90, str(random.choice(["grass", "dry_grass"])))
    if random.random() < 0.25:
        stand_people(random, world, 2)
    return world


def road(random: Random) -> World:
    """A road through open land."""
    land = hills(random, random.uniform(1, 15), random.uniform(150, 500), flat=60)
    if random.random() < 0.5:
        land = peaks(random, land, random.uniform(60, 900), random.uniform(400, 2500), 1200)
    wide, bend, aside = random.uniform(2.5, 5), random.uniform(0, 14), random.uniform(-3, 3)

    def off(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        return np.abs(x - aside - bend * np.sin(y / 60))

    cover, names = cover_by_rules(
        random,
        (green(random), always),
        ("forest", lambda p: (p.noise > 0.15) & (np.hypot(p.x, p.y) > 300)),
        ("gravel", lambda p: off(p.x, p.y) < wide + 0.8),
        ("asphalt", lambda p: off(p.x, p.y) < wide),
        ("line", lambda p: (off(p.x, p.y) < 0.08) & (p.y % 9 < 5) & (np.abs(p.y) < 60)),
    )
    world = World(Ground(land, cover, names), eye=(1.3, 4))
    plant_trees(
        random,
        world,
        40,
        10,
        1200,
        str(random.choice(["broadleaf", "mixed", "conifer", "autumn", "bare"])),
    )
    pole = utility_pole(random)
    if random.random() < 0.5:
        world.put(
            pole,
            [
                (
                    aside + wide + 3,
                    10 + 40.0 * i,
                    float(land(np.array(aside + wide + 3), np.array(10 + 40.0 * i))),
                    1.57,
                    1,
                )
                for i in range(10)
            ],
        )
    cars = [(aside + 1.5, random.uniform(12, 90), 0, 1.57, 1) for _ in range(3)]
    world.put(
        car(random),
        [(x, y, float(land(np.array(x), np.array(y))), t, s) for x, y, _, t, s in cars],
    )
    if random.random() < 0.4:
        world.put(fence(random, 60.0), [(aside + wide + 4, 20.0, 0, 1.57, 1)])
    plant_tufts(random, world, 70)
    return world


def orchard(random: Random) -> World:
    """Test only: trees in rows, a farm, a track."""
    land = hills(random, random.uniform(1, 8), 250, flat=60)
    cover, names = cover_by_rules(
        random,
        ("grass", always),
        ("soil", lambda p: np.abs(p.x - 2) < 1.5),
        ("crop", lambda p: p.y > 140),
    )
    world = World(Ground(land, cover, names), eye=(1.4, 8))
    pitch, turn = random.uniform(4.5, 8), random.uniform(-0.8, 0.8)
    for _ in range(4):
        mesh, places = broadleaf(random).moved(scaled=random.uniform(0.35, 0.6)), []
        for i in range(-14, 15):
            for j in range(18):
                if random.random() < 0.25:
                    x, y = i * pitch, j * pitch + 4
                    x, y = x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)
                    places.append(
                        (
                            x,
                            y,
                            float(land(np.array(x), np.array(y))),
                            random.uniform(0, 6),
                            random.uniform(0.8, 1.2),
                        )
                    )
        world.put(mesh, places)
    build_houses(random, world, [barn, house, shed], 4, 25, 120)
    plant_tufts(random, world, 80)
    stand_people(random, world, 1)
    return world


def ruin(random: Random) -> World:
    """Test only: old walls and rocks on a heath."""
    land = hills(random, random.uniform(2, 15), 150, flat=25)
    cover, names = cover_by_rules(
        random,
        (str(random.choice(["heath", "dry_grass", "grass", "snow"])), always),
        ("rock", lambda p: p.slope > 0.5 + 0.4 * p.noise),
        ("gravel", lambda p: np.abs(p.x) < 1),
    )
    world = World(Ground(land, cover, names), eye=(1.4, 6))
    build_houses(random, world, [castle_wall, castle_wall, church], 7, 12, 90)
    lay_rocks(random, world, 40, 3, 90, 1.4)
    plant_trees(random, world, 14, 10, 500, "bare")
    plant_tufts(random, world, 40, "dry_grass")
    stand_people(random, world, 2)
    return world
