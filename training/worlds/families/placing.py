"""Things put in their places: anywhere on the ground, afloat, trees, rocks, people, houses."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from training.worlds.families.world import Place, World
from training.worlds.ground import Ground
from training.worlds.mesh import Mesh, Random, box, joined
from training.worlds.props.people import person
from training.worlds.props.plants import bush, grass_patch
from training.worlds.props.rocks import rock
from training.worlds.props.trees import bare_tree, broadleaf, conifer, far_tree, palm, poplar


def spread(
    random: Random,
    ground: Ground,
    count: int,
    near: float,
    far: float,
    *,
    half_angle: float = 0.7,
    steepest: float = 0.8,
    sizes: tuple[float, float] = (0.8, 1.3),
    dry: float = 0.15,
) -> list[Place]:
    """Return places on the ground, most of them in view, as many far as near by the logarithm."""
    distance = np.exp(random.uniform(np.log(near), np.log(far), count))
    angle = random.uniform(-half_angle, half_angle, count)
    behind = random.random(count) < 0.12
    angle = np.where(behind, random.uniform(-np.pi, np.pi, count), angle)
    x, y = distance * np.sin(angle), distance * np.cos(angle)
    z = ground.heights(x, y)
    keep = ground.slope(x, y) < steepest
    if ground.water is not None:
        keep &= z > ground.water + dry
    turned, size = random.uniform(0, 2 * np.pi, count), random.uniform(*sizes, count)
    return [
        (float(a), float(b), float(c), float(d), float(e))
        for a, b, c, d, e, k in zip(x, y, z, turned, size, keep, strict=True)
        if k
    ]


def afloat(random: Random, ground: Ground, count: int, near: float, far: float) -> list[Place]:
    distance = np.exp(random.uniform(np.log(near), np.log(far), count))
    angle = random.uniform(-0.6, 0.6, count)
    x, y = distance * np.sin(angle), distance * np.cos(angle)
    level = ground.water or 0.0
    deep = ground.heights(x, y) < level - 0.4
    turned = random.uniform(0, 2 * np.pi, count)
    return [
        (float(a), float(b), level, float(c), 1.0)
        for a, b, c, k in zip(x, y, turned, deep, strict=True)
        if k
    ]


def plant_trees(
    random: Random, world: World, count: int, near: float, far: float, kind: str
) -> None:
    """Plant trees: real ones near, lumps far away."""
    makers: dict[str, list[Callable[[Random], Mesh]]] = {
        "broadleaf": [broadleaf, broadleaf, bush],
        "conifer": [conifer, conifer],
        "mixed": [broadleaf, conifer, bush, poplar],
        "palm": [palm, palm, bush],
        "bare": [bare_tree, bare_tree, bush],
        "autumn": [lambda r: broadleaf(r, "dry_leaves"), broadleaf, conifer],
    }
    close = min(far, 160.0)
    if near < close:
        for make in makers[kind]:
            for _ in range(2):
                places = spread(random, world.ground, count // 6 + 1, near, close, sizes=(0.7, 1.3))
                world.put(make(random), places)
    if far > close:
        for _ in range(3):
            mesh = far_tree(random, kind == "conifer" or random.random() < 0.3)
            places = spread(random, world.ground, count, close, far, sizes=(0.8, 1.5))
            world.put(mesh, places)


def plant_tufts(
    random: Random, world: World, count: int, name: str = "grass", far: float = 25.0
) -> None:
    for _ in range(2):
        patch = grass_patch(random, name=name)
        world.put(patch, spread(random, world.ground, count, 1.2, far, half_angle=0.9))


def lay_rocks(
    random: Random, world: World, count: int, near: float, far: float, big: float
) -> None:
    for _ in range(3):
        places = spread(random, world.ground, count, near, far, sizes=(0.15 * big, big), steepest=2)
        world.put(rock(random), [(x, y, z, t, s) for x, y, z, t, s in places])


def stand_people(
    random: Random, world: World, count: int, near: float = 5.0, far: float = 60.0
) -> None:
    for _ in range(3):
        places = spread(random, world.ground, count, near, far, sizes=(0.97, 1.03), steepest=0.3)
        world.put(person(random), places)


def build_houses(
    random: Random, world: World, makers: list, count: int, near: float, far: float
) -> None:
    """Build detached houses, not two in one place, each on a base that reaches into the slope."""
    taken: list[tuple[float, float, float]] = []
    for _ in range(count):
        mesh = makers[random.integers(len(makers))](random)
        reach = float(np.abs(mesh.vertices[:, :2]).max()) * 1.3
        for place in spread(
            random, world.ground, 8, near, far, steepest=0.35, sizes=(1, 1), dry=0.6
        ):
            x, y, z = place[:3]
            if all(np.hypot(x - a, y - b) > reach + c for a, b, c in taken):
                taken.append((x, y, reach))
                span = np.ptp(mesh.vertices[:, 0]), np.ptp(mesh.vertices[:, 1])
                base = box(span[0] * 0.9, span[1] * 0.9, 3.0, "stone").moved((0, 0, -2.95))
                world.put(joined([mesh, base]), [(x, y, z, place[3], 1.0)])
                break
