"""Families where people live: village, street, park, city, square."""

from __future__ import annotations

import numpy as np

from training.worlds.buildings.churches import church
from training.worlds.buildings.farms import barn, shed
from training.worlds.buildings.houses import block, house, row
from training.worlds.buildings.streets import arcade, street_surface
from training.worlds.buildings.towers import tower
from training.worlds.families.land import always, cover_by_rules, green, hills, level_ground, peaks
from training.worlds.families.placing import (
    build_houses,
    plant_trees,
    plant_tufts,
    spread,
    stand_people,
)
from training.worlds.families.world import World
from training.worlds.ground import Ground
from training.worlds.mesh import Mesh, Random
from training.worlds.props.cars import car
from training.worlds.props.farmland import fence
from training.worlds.props.people import person, statue
from training.worlds.props.street_furniture import bench, bollard, lamp_post, sign, umbrella
from training.worlds.props.trees import broadleaf


def village(random: Random) -> World:
    """Detached houses, gardens and trees on rolling land."""
    land = hills(random, random.uniform(1, 12), random.uniform(120, 400), flat=60)
    if random.random() < 0.3:
        land = peaks(random, land, random.uniform(100, 800), 1500, 1200)
    cover, names = cover_by_rules(
        random,
        (green(random), always),
        ("gravel", lambda p: np.abs(p.x + 6 * np.sin(p.y / 40)) < 2.2),
        ("forest", lambda p: (p.noise > 0.1) & (np.hypot(p.x, p.y) > 400)),
    )
    world = World(Ground(land, cover, names), eye=(1.4, 10), clear=4)
    build_houses(
        random,
        world,
        [house] * 5 + [barn, church, shed],
        22,
        12,
        250,
    )
    plant_trees(
        random, world, 40, 9, 900, str(random.choice(["broadleaf", "mixed", "autumn", "bare"]))
    )
    for _ in range(2):
        world.put(fence(random, 15.0), spread(random, world.ground, 4, 6, 80, sizes=(1, 1)))
        world.put(car(random), spread(random, world.ground, 2, 8, 80, sizes=(1, 1), steepest=0.2))
    plant_tufts(random, world, 50)
    stand_people(random, world, 2)
    return world


def street(random: Random) -> World:
    """Between two rows of houses, along the street or across it."""
    world = World(level_ground(random, "asphalt"), eye=(1.4, 9), widest=75, narrowest=25, clear=1.0)
    wide, length = random.uniform(5, 13), 160.0
    turn = random.normal(0, 0.25) if random.random() < 0.75 else random.uniform(-1.5, 1.5)
    inside = wide / 2 + random.uniform(2.0, 6.0)
    aside = random.uniform(-0.7, 0.7) * inside

    def lay(mesh: Mesh, x: float, y: float, turned: float = 0.0, z: float = 0.0) -> None:
        moved = x - aside, y - 40
        cosine, sine = np.cos(turn), np.sin(turn)
        world.things.append(
            (
                mesh,
                [
                    (
                        moved[0] * cosine - moved[1] * sine,
                        moved[0] * sine + moved[1] * cosine,
                        z,
                        turned + turn,
                        1.0,
                    )
                ],
            )
        )

    lay(street_surface(wide, length, random), 0, 0)
    # A row lies along x with façades towards -y: the left one is turned to face right, and so on.
    lay(row(random, length), -inside, 0, np.pi / 2)
    if random.random() < 0.85:
        lay(row(random, length), inside, length, -np.pi / 2)
    if random.random() < 0.5:
        lay(row(random, 60.0), -30.0, length + 10)
    lay(row(random, 60.0), 30.0, -10.0, np.pi)
    for side in (-1, 1):
        if random.random() < 0.6:
            lamp = lamp_post(random)
            for y in np.arange(random.uniform(0, 15), length, 22):
                lay(lamp, side * (wide / 2 + 0.6), float(y), 0 if side > 0 else np.pi)
        if random.random() < 0.5:
            tree = broadleaf(random, str(random.choice(["leaves", "dry_leaves"]))).moved(scaled=0.6)
            for y in np.arange(random.uniform(0, 12), length, random.uniform(8, 16)):
                lay(tree, side * (wide / 2 + 1.2), float(y), random.uniform(0, 6))
        parked = car(random)
        for y in np.arange(3, length, 6.5):
            if random.random() < 0.35:
                lay(
                    parked if random.random() < 0.5 else car(random),
                    side * (wide / 2 - 1.1),
                    float(y),
                    np.pi / 2,
                )
        for _ in range(random.integers(0, 6)):
            lay(
                person(random),
                side * (wide / 2 + random.uniform(0.5, 1.8)),
                random.uniform(20, 110),
                random.uniform(0, 6),
                0.1,
            )
    return world


def park(random: Random) -> World:
    """Lawns, paths, benches and single trees, houses behind."""
    land = hills(random, random.uniform(0.5, 4), 80, flat=30)
    cover, names = cover_by_rules(
        random,
        ("grass", always),
        ("gravel", lambda p: np.abs(p.x - 9 * np.sin(p.y / 22)) < 1.8),
        ("paving", lambda p: np.abs(p.y - 30) < 2),
    )
    world = World(Ground(land, cover, names), eye=(1.4, 5))
    plant_trees(
        random,
        world,
        50,
        7,
        160,
        str(random.choice(["broadleaf", "mixed", "autumn", "bare", "palm"])),
    )
    for make in (bench, lamp_post, statue, umbrella, sign):
        world.put(make(random), spread(random, world.ground, 4, 5, 60, sizes=(1, 1)))
    if random.random() < 0.6:
        terrace = row(random, 120.0)
        world.put(
            terrace.moved((-60, 0, -0.5)),
            [(0.0, random.uniform(70, 150), 0.0, random.normal(0, 0.2), 1.0)],
        )
    plant_tufts(random, world, 60)
    stand_people(random, world, 6)
    return world


def city(random: Random) -> World:
    """Blocks and towers, from a street, a roof or a hill."""
    high = random.random() < 0.4
    world = World(
        level_ground(random, "asphalt"),
        eye=(15, 60) if high else (1.5, 5),
        widest=70,
        narrowest=14,
        clear=2,
    )
    pitch = random.uniform(35, 60)
    for i in range(-5, 6):
        for j in range(9):
            if abs(i) < 1 and j < 2:
                continue
            deep = pitch - random.uniform(12, 22)
            tall = random.random() < 0.25
            mesh = tower(random) if tall else block(random, deep, deep, int(random.integers(2, 8)))
            x, y = (i + 0.1) * pitch, (j + 0.3) * pitch
            world.things.append((mesh, [(x, y, 0.0, float(random.integers(4)) * np.pi / 2, 1.0)]))
    for _ in range(4):
        world.put(car(random), spread(random, world.ground, 6, 8, 90, sizes=(1, 1)))
    world.put(broadleaf(random), spread(random, world.ground, 20, 10, 120, sizes=(0.5, 0.9)))
    stand_people(random, world, 4)
    return world


def square(random: Random) -> World:
    """A paved square: façades round it, a monument, people, cafés."""
    world = World(level_ground(random, "paving"), eye=(1.5, 6), widest=70, narrowest=25)
    half, deep = random.uniform(18, 45), random.uniform(35, 90)
    world.things.append((row(random, 2 * half), [(-half, deep, 0.0, 0.0, 1.0)]))
    world.things.append((row(random, deep + 20), [(-half, -20.0, 0.0, np.pi / 2, 1.0)]))
    if random.random() < 0.8:
        world.things.append((row(random, deep + 20), [(half, deep, 0.0, -np.pi / 2, 1.0)]))
    world.things.append((row(random, 2 * half), [(half, -20.0, 0.0, np.pi, 1.0)]))
    if random.random() < 0.5:
        world.things.append((arcade(random, half), [(-half / 2, deep - 4, 0.0, 0.0, 1.0)]))
    if random.random() < 0.5:
        world.things.append((church(random), [(random.uniform(-10, 10), deep + 25, 0.0, 0.0, 1.3)]))
    for make, count in (
        (statue, 1),
        (umbrella, 6),
        (lamp_post, 5),
        (bench, 5),
        (bollard, 8),
    ):
        world.put(
            make(random),
            spread(random, world.ground, count, 7, deep * 0.8, half_angle=0.4, sizes=(1, 1)),
        )
    world.put(
        broadleaf(random),
        spread(random, world.ground, 4, 10, deep * 0.8, half_angle=0.5, sizes=(0.5, 0.8)),
    )
    stand_people(random, world, 8, 5, deep)
    return world
