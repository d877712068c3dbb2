"""Where people live: houses, blocks of dwellings, terraces."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from training.worlds.buildings.facades import course, facade, four_walls, set_around
from training.worlds.buildings.roofs import block_roof, gable_roof, pitched_roof
from training.worlds.buildings.shapes import (
    BAR,
    NO_BACK,
    QUARTER,
    boxes,
    end_faces,
    frustum,
    prism,
    quads,
    upright,
)
from training.worlds.buildings.style import (
    DETAIL,
    Style,
    chance,
    dwelling_style,
    pick,
    roof_name,
    wall_name,
)
from training.worlds.mesh import Mesh, Random, box, joined

HOUSE_FACES, BLOCK_FACES, ROW_FACES = 600, 4000, 15000


def _fitted(
    build: Callable[[Random, int], Mesh], random: Random, faces: int, detail: int = DETAIL
) -> Mesh:
    """Return what is built with the most detail that the number of faces allows."""
    seed = int(random.integers(2**32))
    while True:
        built = build(np.random.default_rng(seed), detail)
        if len(built.faces) <= faces or detail == 0:
            return built
        detail = max(0, detail - (1 if len(built.faces) < 1.6 * faces else 2))


def house(random: Random) -> Mesh:
    """Return a detached house of one or two floors."""
    return _fitted(_house, random, HOUSE_FACES)


def _house(random: Random, detail: int) -> Mesh:
    """Return a house with so much detail."""
    width, depth, floors = random.uniform(7, 13.5), random.uniform(6, 9), int(random.integers(1, 3))
    height, foot = floors * random.uniform(2.5, 2.9), random.uniform(0.15, 0.5)
    style = replace(dwelling_style(random, detail), cell=random.uniform(2.2, 3.2))
    if chance(random, 0.4) and style.curve == "flat" and detail > 0:
        style = replace(style, shutters=pick(random, "wood", "awning", "trim"))
    columns = max(1, round(width / style.cell))
    door = int(random.integers(columns))
    x = (door + 0.5) * width / columns - width / 2
    parts = four_walls(random, width, depth, height, floors, style, "door", door)
    parts += [
        of.moved((0, 0, height)) for of in pitched_roof(random, width, depth, style, True, 0.45)
    ]
    wide = min(width / columns, random.uniform(1.6, 3))
    front = _porch(random, wide, foot, style.wall) if chance(random, 0.6) else []
    front.append(boxes((-0.8, -0.9, -foot), (0.8, 0, -foot / 2), "stone", NO_BACK))
    parts += [of.moved((x, -depth / 2, 0)) for of in front]
    side = -1.0 if x > 0 else 1.0
    if chance(random, 0.4):
        parts += _wing(random, side, (width, depth, height), foot, style)
    elif columns > 2 and chance(random, 0.3):
        bay = _oriel(random, width / columns, height / floors, 1, style)
        at = (columns - 0.5) if side > 0 else 0.5
        parts.append(bay.moved((at * width / columns - width / 2, -depth / 2, 0)))
    base = boxes(
        (-width / 2 - 0.05, -depth / 2 - 0.05, -foot),
        (width / 2 + 0.05, depth / 2 + 0.05, 0),
        "stone",
    )
    return joined([*parts, base]).moved((0, 0, foot))


def _oriel(random: Random, width: float, height: float, floors: int, style: Style) -> Mesh:
    """Return a bay that stands in front of the plane y = 0 on the ground."""
    out, x = random.uniform(0.5, 1.0), width / 2
    look = replace(style, share=0.78, shutters="", balcony="", detail=min(2, style.detail))
    front = facade(random, width, height, 2, floors, look).moved((-x, -out, 0))
    cheeks = end_faces(x, -out, 0, 0, height, style.wall)
    top = frustum((width + 0.2, out * 2 + 0.2), (width * 0.6, 0.1), 0.5, roof_name(random))
    return joined([front, cheeks, top.moved((0, 0, height))])


def _porch(random: Random, width: float, foot: float, wall: str) -> list[Mesh]:
    """Return a porch before a door at the origin that faces -y."""
    out, high, x = random.uniform(0.9, 2.2), random.uniform(2.4, 2.7), width / 2
    roof = roof_name(random)
    lean = [(-out - 0.2, high), (0, high), (0, high + 0.55), (-out - 0.2, high + 0.14)]
    parts = [prism(lean, -x - 0.15, x + 0.15, roof)]
    post = pick(random, "trim", "wood", wall)
    if chance(random, 0.75):
        at = np.array([-x, x - 0.14])
        parts.append(boxes((at, -out, 0), (at + 0.14, -out + 0.14, high), post, BAR))
    parts.append(boxes((-x, -out, -foot), (x, 0, 0.02), "stone", NO_BACK))
    return parts


def _wing(random: Random, side: float, size: tuple, foot: float, style: Style) -> list[Mesh]:
    """Return a wing that stands out of the front with its own gable."""
    width, depth, height = size
    w, out = random.uniform(0.3, 0.42) * width, random.uniform(1.5, 3.5)
    deep, rise = out + depth / 2, random.uniform(0.35, 0.5) * w
    look = replace(style, detail=min(style.detail, 2))
    front = facade(random, w, height, max(1, round(w / style.cell)), 1 + (height > 3.5), look)
    blank = quads(upright(0, deep, 0, height), style.wall)
    back = quads(upright(0, w, 0, height), style.wall)
    parts = set_around([front, blank, back, blank], w, deep)
    roof = joined(gable_roof(deep, w, rise, (0.35, 0.3), (roof_name(random), style.wall)))
    parts += [
        roof.moved((0, 0, height), QUARTER),
        box(w + 0.1, deep + 0.1, foot, "stone").moved((0, 0, -foot)),
    ]
    at = (side * ((width - w) / 2 - 0.15), -depth / 2 - out + deep / 2, 0)
    return [of.moved(at) for of in parts]


def block(random: Random, width: float, depth: float, floors: int) -> Mesh:
    """Return a detached block of dwellings, perhaps with shops."""
    size = (width, depth)
    return _fitted(lambda r, d: _block(r, size, floors, d, True, BLOCK_FACES), random, BLOCK_FACES)


def _block_style(random: Random, detail: int, least: float) -> Style:
    """Return how a block looks, its windows at least so far apart; plainer with less detail."""
    style = dwelling_style(random, detail)
    balcony = pick(random, "", "", "", "single", "single", "long")
    shutters = pick(random, "", "", "", "wood", "awning")
    return replace(
        style,
        cell=max(style.cell, least),
        tall=random.uniform(1.0, 1.35),
        balcony="long" if balcony and detail < 2 else balcony,
        shutters=shutters if style.curve == "flat" and not balcony and detail > 0 else "",
    )


def _block(
    random: Random,
    size: tuple,
    floors: int,
    detail: int,
    detached: bool,
    faces: int,
    wall: str = "",
) -> Mesh:
    """Return a block with so much detail; party walls are blank unless detached."""
    width, depth = size
    around = 2 * (width + depth) if detached else 2 * width
    style = _block_style(random, detail, around * floors / (faces / 11))
    style = replace(style, wall=wall, ground=wall) if wall else style
    storey = random.uniform(2.8, 3.5)
    first, height = storey * style.tall, storey * (floors - 1 + style.tall)
    ground = pick(random, "shop", "door", "door")
    columns = max(1, round(width / style.cell))
    door = int(random.integers(columns))
    parts = four_walls(random, width, depth, height, floors, style, ground, door, detached)
    if ground == "door" and columns > 1 and not style.balcony and chance(random, 0.3):
        bay = _oriel(random, 0.85 * width / columns, height - 0.5, floors, style)
        spots = [at for at in range(columns) if at != door][:: int(random.integers(1, 3))][:4]
        for at in spots:
            parts.append(bay.moved(((at + 0.5) * width / columns - width / 2, -depth / 2, 0)))
    for z, high, out, share in ((first, 0.16, 0.09, 0.5), (height - 0.3, 0.28, 0.35, 0.7)):
        if chance(random, share):
            parts.append(course(width, depth, z, high, random.uniform(0.5, 1) * out, detached))
    top = block_roof(random, width, depth, style, detached)
    return joined(parts + [of.moved((0, 0, height)) for of in top])


def row(random: Random, length: float) -> Mesh:
    """Return a terrace along x from 0 to the length, its façades at about y = 0."""
    count = max(1, round(length / random.uniform(5.5, 11)))
    alike = chance(random, 0.35)
    widths = np.ones(count) if alike else random.uniform(0.6, 1.4, count)
    widths *= length / widths.sum()
    most, depth, floors = ROW_FACES // count, random.uniform(8, 12), int(random.integers(2, 6))
    seed, wall, parts = int(random.integers(2**32)), wall_name(random), []
    start = DETAIL if most > 1400 else 2 if most > 800 else 1
    back = 0.0 if alike else random.uniform(0, 0.8)
    for x, width in zip(np.cumsum(widths) - widths / 2, widths, strict=True):
        size = (float(width), depth)
        high = floors if alike else max(2, floors + int(random.integers(-1, 2)))
        wall = wall if alike and chance(random, 0.7) else wall_name(random)

        def build(
            r: Random, d: int, size: tuple = size, high: int = high, wall: str = wall
        ) -> Mesh:
            return _block(r, size, high, d, False, most, wall)

        one = _fitted(build, np.random.default_rng(seed) if alike else random, most, start)
        parts.append(one.moved((x, depth / 2 + back * random.random(), 0)))
    return joined(parts)
