"""What worlds there are: each family puts its things on its ground, otherwise by chance."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from training.worlds import buildings, props
from training.worlds.ground import Ground, Noise
from training.worlds.mesh import Mesh, Random, box, joined

Place = tuple[float, float, float, float, float]  # x, y, z in metres, turn in radians, scale


class Spots(NamedTuple):
    """Places on the ground: metres, tangent of the slope, and noise in patches about 0."""

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    slope: np.ndarray
    noise: np.ndarray


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


def _spread(
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


def _afloat(random: Random, ground: Ground, count: int, near: float, far: float) -> list[Place]:
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


def _trees(random: Random, world: World, count: int, near: float, far: float, kind: str) -> None:
    """Plant trees: real ones near, lumps far away."""
    makers: dict[str, list[Callable[[Random], Mesh]]] = {
        "broadleaf": [props.broadleaf, props.broadleaf, props.bush],
        "conifer": [props.conifer, props.conifer],
        "mixed": [props.broadleaf, props.conifer, props.bush, props.poplar],
        "palm": [props.palm, props.palm, props.bush],
        "bare": [props.bare_tree, props.bare_tree, props.bush],
        "autumn": [lambda r: props.broadleaf(r, "dry_leaves"), props.broadleaf, props.conifer],
    }
    close = min(far, 160.0)
    if near < close:
        for make in makers[kind]:
            for _ in range(2):
                places = _spread(
                    random, world.ground, count // 6 + 1, near, close, sizes=(0.7, 1.3)
                )
                world.put(make(random), places)
    if far > close:
        for _ in range(3):
            mesh = props.far_tree(random, kind == "conifer" or random.random() < 0.3)
            places = _spread(random, world.ground, count, close, far, sizes=(0.8, 1.5))
            world.put(mesh, places)


def _tufts(
    random: Random, world: World, count: int, name: str = "grass", far: float = 25.0
) -> None:
    for _ in range(2):
        patch = props.grass_patch(random, name=name)
        world.put(patch, _spread(random, world.ground, count, 1.2, far, half_angle=0.9))


def _rocks(random: Random, world: World, count: int, near: float, far: float, big: float) -> None:
    for _ in range(3):
        places = _spread(
            random, world.ground, count, near, far, sizes=(0.15 * big, big), steepest=2
        )
        world.put(props.rock(random), [(x, y, z, t, s) for x, y, z, t, s in places])


def _people(random: Random, world: World, count: int, near: float = 5.0, far: float = 60.0) -> None:
    for _ in range(3):
        places = _spread(random, world.ground, count, near, far, sizes=(0.97, 1.03), steepest=0.3)
        world.put(props.person(random), places)


def _houses(
    random: Random, world: World, makers: list, count: int, near: float, far: float
) -> None:
    """Build detached houses, not two in one place, each on a base that reaches into the slope."""
    taken: list[tuple[float, float, float]] = []
    for _ in range(count):
        mesh = makers[random.integers(len(makers))](random)
        reach = float(np.abs(mesh.vertices[:, :2]).max()) * 1.3
        for place in _spread(
            random, world.ground, 8, near, far, steepest=0.35, sizes=(1, 1), dry=0.6
        ):
            x, y, z = place[:3]
            if all(np.hypot(x - a, y - b) > reach + c for a, b, c in taken):
                taken.append((x, y, reach))
                span = np.ptp(mesh.vertices[:, 0]), np.ptp(mesh.vertices[:, 1])
                base = box(span[0] * 0.9, span[1] * 0.9, 3.0, "stone").moved((0, 0, -2.95))
                world.put(joined([mesh, base]), [(x, y, z, place[3], 1.0)])
                break


def _hills(random: Random, height: float, size: float, *, flat: float = 30.0) -> Callable:
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


def _peaks(random: Random, heights: Callable, tall: float, begin: float, size: float) -> Callable:
    """Return the same land with mountains from ``begin`` metres on."""
    noise = Noise(random)

    def with_peaks(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        rise = np.clip((np.hypot(x, y) - begin) / (1.5 * begin), 0, 1) ** 1.5
        wide = np.clip(noise.fractal(x, y, 3 * size, 3) + 0.55, 0.1, 1.2)
        return heights(x, y) + tall * rise * wide * noise.ridges(x, y, size, 9)

    return with_peaks


def _shore(
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


def _cover(random: Random, *rules: tuple[str, Callable]) -> tuple[Callable, tuple[str, ...]]:
    """Return a cover by rules, later ones over earlier: a name, and a test of ``Spots``."""
    noise = Noise(random)

    def cover(x: np.ndarray, y: np.ndarray, z: np.ndarray, slope: np.ndarray) -> np.ndarray:
        patches = noise.fractal(x, y, 60.0, 6) + noise.fractal(x, y, 4.0, 3) * 0.3
        index = np.zeros(x.shape, int)
        for i, (_, rule) in enumerate(rules):
            index = np.where(rule(Spots(x, y, z, slope, patches)), i, index)
        return index

    return cover, tuple(name for name, _ in rules)


def _always(spots: Spots) -> np.ndarray:
    return np.ones_like(spots.x, bool)


def _green(random: Random) -> str:
    return str(random.choice(["grass", "meadow", "grass", "dry_grass", "heath", "crop"]))


def coast(random: Random) -> World:
    """A beach or rocks, sea to the horizon, at times cliffs beside it."""
    rocky = random.random() < 0.5
    land = _hills(random, random.uniform(1, 14), random.uniform(60, 300), flat=20)
    if random.random() < 0.4:
        land = _peaks(
            random,
            land,
            random.uniform(40, 400),
            random.uniform(150, 900),
            random.uniform(300, 1500),
        )
    heights = _shore(
        random,
        land,
        random.uniform(4, 40),
        random.uniform(0.03, 0.25),
        side=random.uniform(-1.1, 1.1),
    )
    cover, names = _cover(
        random,
        ("rock" if rocky else "sand", _always),
        ("wet_sand", lambda p: (p.z < 0.25) & (not rocky)),
        (_green(random), lambda p: (p.z > 3 + 3 * p.noise) & (p.slope < 0.7 + p.noise)),
        ("rock", lambda p: p.slope > 0.75 + 0.4 * p.noise),
    )
    world = World(Ground(heights, cover, names, 0.0), eye=(1.4, 12), waves=random.uniform(0.1, 0.7))
    _rocks(random, world, 60 if rocky else 6, 2.5, 80, 1.6 if rocky else 0.6)
    if random.random() < 0.4:
        _people(random, world, 3)
    if random.random() < 0.5:
        for _ in range(3):
            world.put(props.boat(random), _afloat(random, world.ground, 3, 15, 500))
    if random.random() < 0.3:
        world.put(
            props.pier(random, random.uniform(15, 50)),
            [(random.uniform(-15, 15), random.uniform(8, 30), 0, 1.57, 1)],
        )
    if random.random() < 0.35:
        _houses(random, world, [buildings.house, buildings.lighthouse, buildings.shed], 6, 30, 400)
    _trees(random, world, 14, 20, 600, "palm" if random.random() < 0.3 else "mixed")
    if not rocky:
        _tufts(random, world, 25, "dry_grass")
    return world


def lake(random: Random) -> World:
    """Still water before hills or mountains, reeds and trees on its banks."""
    land = _hills(random, random.uniform(3, 15), random.uniform(80, 300), flat=25)
    far = random.uniform(150, 1200)
    if random.random() < 0.7:
        land = _peaks(random, land, random.uniform(60, 900), far, random.uniform(500, 2500))
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

    cover, names = _cover(
        random,
        (_green(random), _always),
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
    _trees(random, world, 60, 8, 1500, kind)
    for _ in range(2):
        reeds = [
            (x, y, 0.0, t, s)
            for x, y, z, t, s in _spread(random, world.ground, 30, 2, 25, dry=-0.4)
            if z < 0.4
        ]
        world.put(props.reeds(random), reeds)
    _tufts(random, world, 40)
    _rocks(random, world, 10, 2, 40, 0.8)
    if random.random() < 0.4:
        world.put(props.boat(random), _afloat(random, world.ground, 3, 6, 80))
    if random.random() < 0.3:
        world.put(
            props.pier(random, random.uniform(6, 20)),
            [(random.uniform(-5, 5), near + 5, 0, 1.57, 1)],
        )
    if random.random() < 0.35:
        _houses(random, world, [buildings.house, buildings.shed, buildings.barn], 5, 25, 300)
    return world


def field_(random: Random) -> World:
    """Farmland: fields, hedges, bales, a road perhaps, trees in the distance."""
    land = _hills(random, random.uniform(2, 18), random.uniform(150, 500), flat=40)
    width, turn = random.uniform(20, 90), random.uniform(0, np.pi)
    kinds = [
        str(random.choice(["grass", "crop", "meadow", "soil", "dry_grass", "crop"]))
        for _ in range(4)
    ]

    def strip(k: int) -> Callable:
        return lambda p: (np.floor((p.x * np.cos(turn) + p.y * np.sin(turn)) / width) % 4) == k

    cover, names = _cover(random, *((kinds[k], strip(k)) for k in range(4)))
    world = World(Ground(land, cover, names), eye=(1.4, 6))
    _trees(
        random, world, 40, 12, 1800, str(random.choice(["broadleaf", "mixed", "autumn", "bare"]))
    )
    if random.random() < 0.4:
        world.put(props.hay_bale(random), _spread(random, world.ground, 25, 6, 200, steepest=0.2))
    for _ in range(random.integers(0, 3)):
        fence = props.fence(random, 40.0)
        world.put(fence, _spread(random, world.ground, 2, 6, 60, sizes=(1, 1)))
    for _ in range(random.integers(0, 3)):
        world.put(
            props.hedge(random, 30.0), _spread(random, world.ground, 4, 20, 300, sizes=(1, 1))
        )
    if random.random() < 0.3:
        world.put(
            props.wind_turbine(random), _spread(random, world.ground, 6, 300, 2500, sizes=(1, 1))
        )
    if random.random() < 0.4:
        world.put(props.utility_pole(random), [(8.0, 10 + 40.0 * i, 0, 0.1, 1) for i in range(8)])
    if random.random() < 0.4:
        _houses(random, world, [buildings.barn, buildings.house, buildings.church], 4, 60, 600)
    _tufts(random, world, 90, str(random.choice(["grass", "dry_grass"])))
    if random.random() < 0.25:
        _people(random, world, 2)
    return world


def woods(random: Random) -> World:
    """Inside a wood or at its edge; light falls through crowns."""
    land = _hills(random, random.uniform(1, 10), random.uniform(40, 150), flat=15)
    cover, names = _cover(
        random,
        ("soil", _always),
        ("grass", lambda p: p.noise > 0.05),
        ("dry_leaves", lambda p: p.noise < -0.2),
        ("soil", lambda p: np.abs(p.x + 4 * np.sin(p.y / 15)) < 1.4),
    )
    world = World(Ground(land, cover, names), eye=(1.3, 3), clear=2.0)
    kind = str(random.choice(["conifer", "mixed", "broadleaf", "autumn", "bare"]))
    _trees(random, world, int(random.integers(60, 260)), random.uniform(4, 14), 160, kind)
    _trees(random, world, 60, 120, 500, kind)
    _tufts(random, world, 60)
    _rocks(random, world, 8, 2, 30, 0.8)
    if random.random() < 0.3:
        _people(random, world, 1, 5, 30)
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

    cover, names = _cover(
        random,
        ("sand", _always),
        ("red_rock" if random.random() < 0.3 else "sand", lambda p: p.slope > 1.2),
    )
    world = World(Ground(heights, cover, names), eye=(1.4, 5))
    _tufts(random, world, int(random.integers(0, 40)), "dry_grass", 40)
    if random.random() < 0.3:
        _people(random, world, 2, 6, 120)
    if random.random() < 0.3:
        world.put(props.bush(random), _spread(random, world.ground, 20, 5, 200))
    return world


def snow(random: Random) -> World:
    """A winter field, firs and huts before white slopes."""
    land = _hills(random, random.uniform(2, 25), random.uniform(80, 400), flat=25)
    if random.random() < 0.6:
        land = _peaks(
            random,
            land,
            random.uniform(100, 1200),
            random.uniform(200, 2500),
            random.uniform(500, 3000),
        )
    cover, names = _cover(
        random,
        ("snow", _always),
        ("rock", lambda p: p.slope > 1.0 + 0.5 * p.noise),
        ("dry_grass", lambda p: (p.noise > 0.45) & (np.hypot(p.x, p.y) < 100)),
        ("forest", lambda p: (p.noise > 0.1) & (np.hypot(p.x, p.y) > 400) & (p.z < 200)),
    )
    world = World(Ground(land, cover, names), eye=(1.4, 6))
    _trees(
        random,
        world,
        int(random.integers(10, 70)),
        8,
        1200,
        str(random.choice(["conifer", "bare"])),
    )
    _rocks(random, world, 8, 3, 60, 1.0)
    if random.random() < 0.4:
        _houses(random, world, [buildings.house, buildings.shed, buildings.barn], 5, 20, 250)
    if random.random() < 0.4:
        _people(random, world, 3)
    return world


def mountains(random: Random) -> World:
    """Peaks behind meadows, scree or forest."""
    land = _hills(random, random.uniform(5, 40), random.uniform(100, 400), flat=30)
    land = _peaks(
        random,
        land,
        random.uniform(250, 2200),
        random.uniform(150, 3000),
        random.uniform(600, 4000),
    )
    line, trees = random.uniform(300, 2500), random.uniform(50, 700)
    cover, names = _cover(
        random,
        (_green(random), _always),
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
    _trees(random, world, 40, 15, 2000, str(random.choice(["conifer", "mixed", "autumn"])))
    _rocks(random, world, 25, 3, 120, 2.0)
    _tufts(random, world, 40)
    if random.random() < 0.3:
        _houses(random, world, [buildings.house, buildings.shed, buildings.church], 5, 40, 500)
    if random.random() < 0.2:
        _people(random, world, 1)
    return world


def village(random: Random) -> World:
    """Detached houses, gardens and trees on rolling land."""
    land = _hills(random, random.uniform(1, 12), random.uniform(120, 400), flat=60)
    if random.random() < 0.3:
        land = _peaks(random, land, random.uniform(100, 800), 1500, 1200)
    cover, names = _cover(
        random,
        (_green(random), _always),
        ("gravel", lambda p: np.abs(p.x + 6 * np.sin(p.y / 40)) < 2.2),
        ("forest", lambda p: (p.noise > 0.1) & (np.hypot(p.x, p.y) > 400)),
    )
    world = World(Ground(land, cover, names), eye=(1.4, 10), clear=4)
    _houses(
        random,
        world,
        [buildings.house] * 5 + [buildings.barn, buildings.church, buildings.shed],
        22,
        12,
        250,
    )
    _trees(random, world, 40, 9, 900, str(random.choice(["broadleaf", "mixed", "autumn", "bare"])))
    for _ in range(2):
        world.put(props.fence(random, 15.0), _spread(random, world.ground, 4, 6, 80, sizes=(1, 1)))
        world.put(
            props.car(random), _spread(random, world.ground, 2, 8, 80, sizes=(1, 1), steepest=0.2)
        )
    _tufts(random, world, 50)
    _people(random, world, 2)
    return world


def _level(random: Random, name: str) -> Ground:
    noise = Noise(random)
    cover, names = _cover(
        random, (name, _always), ("grass", lambda p: (p.noise > 0.2) & (np.hypot(p.x, p.y) > 120))
    )
    return Ground(lambda x, y: 0.015 * noise.fractal(x, y, 8.0, 3) - 0.03, cover, names)


def street(random: Random) -> World:
    """Between two rows of houses, along the street or across it."""
    world = World(_level(random, "asphalt"), eye=(1.4, 9), widest=75, narrowest=25, clear=1.0)
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

    lay(buildings.street_surface(wide, length, random), 0, 0)
    # A row lies along x with façades towards -y: the left one is turned to face right, and so on.
    lay(buildings.row(random, length), -inside, 0, np.pi / 2)
    if random.random() < 0.85:
        lay(buildings.row(random, length), inside, length, -np.pi / 2)
    if random.random() < 0.5:
        lay(buildings.row(random, 60.0), -30.0, length + 10)
    lay(buildings.row(random, 60.0), 30.0, -10.0, np.pi)
    for side in (-1, 1):
        if random.random() < 0.6:
            lamp = props.lamp_post(random)
            for y in np.arange(random.uniform(0, 15), length, 22):
                lay(lamp, side * (wide / 2 + 0.6), float(y), 0 if side > 0 else np.pi)
        if random.random() < 0.5:
            tree = props.broadleaf(random, str(random.choice(["leaves", "dry_leaves"]))).moved(
                scaled=0.6
            )
            for y in np.arange(random.uniform(0, 12), length, random.uniform(8, 16)):
                lay(tree, side * (wide / 2 + 1.2), float(y), random.uniform(0, 6))
        car = props.car(random)
        for y in np.arange(3, length, 6.5):
            if random.random() < 0.35:
                lay(
                    car if random.random() < 0.5 else props.car(random),
                    side * (wide / 2 - 1.1),
                    float(y),
                    np.pi / 2,
                )
        for _ in range(random.integers(0, 6)):
            lay(
                props.person(random),
                side * (wide / 2 + random.uniform(0.5, 1.8)),
                random.uniform(20, 110),
                random.uniform(0, 6),
                0.1,
            )
    return world


def road(random: Random) -> World:
    """A road through open land."""
    land = _hills(random, random.uniform(1, 15), random.uniform(150, 500), flat=60)
    if random.random() < 0.5:
        land = _peaks(random, land, random.uniform(60, 900), random.uniform(400, 2500), 1200)
    wide, bend, aside = random.uniform(2.5, 5), random.uniform(0, 14), random.uniform(-3, 3)

    def off(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        return np.abs(x - aside - bend * np.sin(y / 60))

    cover, names = _cover(
        random,
        (_green(random), _always),
        ("forest", lambda p: (p.noise > 0.15) & (np.hypot(p.x, p.y) > 300)),
        ("gravel", lambda p: off(p.x, p.y) < wide + 0.8),
        ("asphalt", lambda p: off(p.x, p.y) < wide),
        ("line", lambda p: (off(p.x, p.y) < 0.08) & (p.y % 9 < 5) & (np.abs(p.y) < 60)),
    )
    world = World(Ground(land, cover, names), eye=(1.3, 4))
    _trees(
        random,
        world,
        40,
        10,
        1200,
        str(random.choice(["broadleaf", "mixed", "conifer", "autumn", "bare"])),
    )
    pole = props.utility_pole(random)
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
        props.car(random),
        [(x, y, float(land(np.array(x), np.array(y))), t, s) for x, y, _, t, s in cars],
    )
    if random.random() < 0.4:
        world.put(props.fence(random, 60.0), [(aside + wide + 4, 20.0, 0, 1.57, 1)])
    _tufts(random, world, 70)
    return world


def harbour(random: Random) -> World:
    """Boats before a quay with houses."""
    land = _hills(random, random.uniform(4, 30), random.uniform(100, 300), flat=10)
    near, far = random.uniform(3, 12), random.uniform(50, 140)

    def heights(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        behind = np.clip((y - far - 25) / 60, 0, 1) * np.abs(land(x, y))
        return np.where((y > near) & (y < far), -4.0, np.where(y < near, 1.2, 1.5 + behind))

    cover, names = _cover(
        random,
        ("paving", _always),
        (_green(random), lambda p: p.z > 4),
        ("forest", lambda p: p.z > 14 + 8 * p.noise),
    )
    world = World(Ground(heights, cover, names, 0.0), eye=(1.5, 9), waves=random.uniform(0.02, 0.2))
    world.things.append((buildings.row(random, 120.0), [(-60.0, far + 8, 1.45, 0.0, 1.0)]))
    for _ in range(8):
        world.put(props.boat(random), _afloat(random, world.ground, 5, near + 4, far))
    for _ in range(2):
        world.put(props.pier(random, 30.0), [(random.uniform(-40, 40), far - 12, 0, 1.57, 1)])
    _trees(random, world, 15, far + 30, 600, "mixed")
    _people(random, world, 5, 3, far + 6)
    return world


def park(random: Random) -> World:
    """Lawns, paths, benches and single trees, houses behind."""
    land = _hills(random, random.uniform(0.5, 4), 80, flat=30)
    cover, names = _cover(
        random,
        ("grass", _always),
        ("gravel", lambda p: np.abs(p.x - 9 * np.sin(p.y / 22)) < 1.8),
        ("paving", lambda p: np.abs(p.y - 30) < 2),
    )
    world = World(Ground(land, cover, names), eye=(1.4, 5))
    _trees(
        random,
        world,
        50,
        7,
        160,
        str(random.choice(["broadleaf", "mixed", "autumn", "bare", "palm"])),
    )
    for make in (props.bench, props.lamp_post, props.statue, props.umbrella, props.sign):
        world.put(make(random), _spread(random, world.ground, 4, 5, 60, sizes=(1, 1)))
    if random.random() < 0.6:
        row = buildings.row(random, 120.0)
        world.put(
            row.moved((-60, 0, -0.5)),
            [(0.0, random.uniform(70, 150), 0.0, random.normal(0, 0.2), 1.0)],
        )
    _tufts(random, world, 60)
    _people(random, world, 6)
    return world


def city(random: Random) -> World:
    """Blocks and towers, from a street, a roof or a hill."""
    high = random.random() < 0.4
    world = World(
        _level(random, "asphalt"),
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
            mesh = (
                buildings.tower(random)
                if tall
                else buildings.block(random, deep, deep, int(random.integers(2, 8)))
            )
            x, y = (i + 0.1) * pitch, (j + 0.3) * pitch
            world.things.append((mesh, [(x, y, 0.0, float(random.integers(4)) * np.pi / 2, 1.0)]))
    for _ in range(4):
        world.put(props.car(random), _spread(random, world.ground, 6, 8, 90, sizes=(1, 1)))
    world.put(props.broadleaf(random), _spread(random, world.ground, 20, 10, 120, sizes=(0.5, 0.9)))
    _people(random, world, 4)
    return world


def square(random: Random) -> World:
    """A paved square: façades round it, a monument, people, cafés."""
    world = World(_level(random, "paving"), eye=(1.5, 6), widest=70, narrowest=25)
    half, deep = random.uniform(18, 45), random.uniform(35, 90)
    world.things.append((buildings.row(random, 2 * half), [(-half, deep, 0.0, 0.0, 1.0)]))
    world.things.append((buildings.row(random, deep + 20), [(-half, -20.0, 0.0, np.pi / 2, 1.0)]))
    if random.random() < 0.8:
        world.things.append(
            (buildings.row(random, deep + 20), [(half, deep, 0.0, -np.pi / 2, 1.0)])
        )
    world.things.append((buildings.row(random, 2 * half), [(half, -20.0, 0.0, np.pi, 1.0)]))
    if random.random() < 0.5:
        world.things.append(
            (buildings.arcade(random, half), [(-half / 2, deep - 4, 0.0, 0.0, 1.0)])
        )
    if random.random() < 0.5:
        world.things.append(
            (buildings.church(random), [(random.uniform(-10, 10), deep + 25, 0.0, 0.0, 1.3)])
        )
    for make, count in (
        (props.statue, 1),
        (props.umbrella, 6),
        (props.lamp_post, 5),
        (props.bench, 5),
        (props.bollard, 8),
    ):
        world.put(
            make(random),
            _spread(random, world.ground, count, 7, deep * 0.8, half_angle=0.4, sizes=(1, 1)),
        )
    world.put(
        props.broadleaf(random),
        _spread(random, world.ground, 4, 10, deep * 0.8, half_angle=0.5, sizes=(0.5, 0.8)),
    )
    _people(random, world, 8, 5, deep)
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

    cover, names = _cover(
        random,
        ("rock", _always),
        ("meadow", lambda p: p.slope < 0.6 + 0.3 * p.noise),
        ("forest", lambda p: (p.z > 10) & (p.z < 260 + 90 * p.noise) & (p.slope < 1.3)),
        ("snow", lambda p: (p.z > 600 + 200 * p.noise) & (p.slope < 1.3)),
    )
    world = World(
        Ground(heights, cover, names, 0.0), eye=(1.5, 12), waves=random.uniform(0.02, 0.3)
    )
    _trees(random, world, 40, 10, 900, "conifer")
    _houses(random, world, [buildings.house, buildings.shed], 5, 30, 500)
    world.put(props.boat(random), _afloat(random, world.ground, 3, 10, 200))
    world.put(props.pier(random, 15.0), [(random.uniform(-8, 8), bank + 6, 0.0, 1.57, 1.0)])
    _rocks(random, world, 20, 2, 40, 1.0)
    return world


def orchard(random: Random) -> World:
    """Test only: trees in rows, a farm, a track."""
    land = _hills(random, random.uniform(1, 8), 250, flat=60)
    cover, names = _cover(
        random,
        ("grass", _always),
        ("soil", lambda p: np.abs(p.x - 2) < 1.5),
        ("crop", lambda p: p.y > 140),
    )
    world = World(Ground(land, cover, names), eye=(1.4, 8))
    pitch, turn = random.uniform(4.5, 8), random.uniform(-0.8, 0.8)
    for _ in range(4):
        mesh, places = props.broadleaf(random).moved(scaled=random.uniform(0.35, 0.6)), []
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
    _houses(random, world, [buildings.barn, buildings.house, buildings.shed], 4, 25, 120)
    _tufts(random, world, 80)
    _people(random, world, 1)
    return world


def ruin(random: Random) -> World:
    """Test only: old walls and rocks on a heath."""
    land = _hills(random, random.uniform(2, 15), 150, flat=25)
    cover, names = _cover(
        random,
        (str(random.choice(["heath", "dry_grass", "grass", "snow"])), _always),
        ("rock", lambda p: p.slope > 0.5 + 0.4 * p.noise),
        ("gravel", lambda p: np.abs(p.x) < 1),
    )
    world = World(Ground(land, cover, names), eye=(1.4, 6))
    _houses(
        random, world, [buildings.castle_wall, buildings.castle_wall, buildings.church], 7, 12, 90
    )
    _rocks(random, world, 40, 3, 90, 1.4)
    _trees(random, world, 14, 10, 500, "bare")
    _tufts(random, world, 40, "dry_grass")
    _people(random, world, 2)
    return world


TRAINING: dict[str, Callable[[Random], World]] = {
    "coast": coast, "lake": lake, "field": field_, "woods": woods, "dunes": dunes, "snow": snow,
    "mountains": mountains, "village": village, "street": street, "road": road,
    "harbour": harbour, "park": park, "city": city,
}  # fmt: skip
TEST: dict[str, Callable[[Random], World]] = {
    "square": square, "fjord": fjord, "orchard": orchard, "ruin": ruin,
}  # fmt: skip
