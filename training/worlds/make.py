"""Make worlds by seed: python -m training.worlds.make --out build/worlds --first 0 --count 1000.

One file a world, ``<family>-<seed>.npz``, with what ``render.measure`` returns and its camera and
suns. Existing files are left alone, so it can be stopped and gone on with; several processes
share the work by ``--part i/n``.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import sys
import time
import traceback
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from training.worlds import families, render
from training.worlds.families.world import World
from training.worlds.materials import Palette
from training.worlds.mesh import Random
from training.worlds.render import View
from training.worlds.sky import Clouds, Sky, Sun

_AREA = 52_000  # pixels of a picture
_SHAPES = (3 / 2, 3 / 2, 4 / 3, 16 / 9, 1.0, 2 / 3, 3 / 4)
_PICTURES, _MORE = 4, 4  # suns to take photos by, and to measure what they light
_OVERCAST = 0.1
_BLOCKED = 2.5  # metres: half of the height of what is seen; views of a wall or a bush are left out


def _view(random: Random, world: World) -> View:
    shape = float(random.choice(_SHAPES))
    width = int(np.sqrt(_AREA * shape))
    narrow, wide = np.radians(world.narrowest), np.radians(world.widest)
    fov = float(np.exp(random.uniform(np.log(narrow), np.log(wide))))
    if random.random() < 0.06:
        fov = float(np.radians(random.uniform(6, 14)))
    horizon = random.normal(0.03, 0.2)  # of the picture's height below its middle
    pitch = float(np.arctan(2 * horizon * np.tan(fov / 2)))
    roll = float(np.radians(random.normal(0, 4 if random.random() < 0.15 else 0.8)))
    eye = float(np.exp(random.uniform(*np.log(world.eye))))
    z = float(world.ground.at(np.zeros(1), np.zeros(1))[0])
    return View((0.0, 0.0, z + eye), fov, pitch, roll, width, round(_AREA / width))


def _suns(random: Random, view: View) -> list[Sun]:
    covered = random.random() < _OVERCAST
    return [_sun(random, view, covered=covered, first=not i) for i in range(2 if covered else 4)]


def _sun(random: Random, view: View, *, covered: bool = False, first: bool = False) -> Sun:
    low, high = ((-3, 0.5), (0.6, 8), (8, 30), (30, 65))[
        random.choice(4, p=(0.03, 0.27, 0.4, 0.3) if first else (0.1, 0.35, 0.32, 0.23))
    ]
    elevation = random.uniform(low, high)
    azimuth = random.uniform(-np.pi, np.pi)
    if random.random() < 0.4:
        azimuth = random.uniform(-1.1, 1.1) * view.half_angle
    return Sun(float(azimuth), float(np.radians(elevation)), covered)


def make(family: str, seed: int, pictures: int = _PICTURES) -> dict[str, np.ndarray] | None:
    """Return a world's maps, and pictures under its first suns; None if its view is blocked."""
    number = list(families.TRAINING | families.TEST).index(family)
    random = np.random.default_rng([seed, number])
    world = (families.TRAINING | families.TEST)[family](random)
    view, render_threads = _view(random, world), 1
    suns = _suns(random, view)
    render.empty(render_threads)
    palette = Palette(random, waves=world.waves)
    render.put(render.add("ground", world.ground.mesh(1.3 * view.half_angle), palette))
    if world.ground.water is not None:
        render.put(render.add("water", world.ground.sheet(), palette))
    for mesh, places in world.things:
        data = render.add("thing", mesh, palette)
        for x, y, z, turned, size in places:
            render.put(data, (x, y, z), turned, size)
    cover = 1.0 if suns[0].covered else float(random.choice([0.0, random.uniform(0.1, 0.75)]))
    sky = Sky(random, Clouds.drawn(random, cover))
    pictures = min(pictures, len(suns))
    others = np.random.default_rng([seed, number, 1])
    suns += [_sun(others, view) for _ in range(_MORE)]
    maps = render.measure(sky, suns, view, pictures=pictures, clear=_BLOCKED)
    if maps is None:
        return None
    maps["suns"] = np.array([(s.azimuth, s.elevation, s.covered) for s in suns], np.float32)
    maps["camera"] = np.array([view.fov, view.pitch, view.roll, view.place[2]], np.float32)
    return maps


@contextlib.contextmanager
def _silent() -> Iterator[None]:
    """Keep Blender, which writes to the file descriptor, from telling of every picture."""
    kept = os.dup(1)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        sys.stdout.flush()
        os.dup2(kept, 1)
        os.close(nowhere)
        os.close(kept)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--part", default="0/1")
    parser.add_argument("--families", nargs="*", default=list(families.TRAINING))
    parser.add_argument("--pictures", type=int, default=_PICTURES, help="suns to photograph by")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    part, parts = map(int, options.part.split("/"))
    for seed in range(options.first + part, options.first + options.count, parts):
        family = options.families[seed % len(options.families)]
        path = options.out / f"{family}-{seed:05}.npz"
        if path.exists():
            continue
        start = time.monotonic()
        try:
            with _silent():
                maps = make(family, seed, options.pictures)
        # One world that cannot be built must not stop a night's work.
        except Exception:  # noqa: BLE001
            traceback.print_exc()
            continue
        if maps is not None:
            part_path = path.with_suffix(".part")
            with part_path.open("wb") as file:
                np.savez_compressed(file, **maps)
            part_path.rename(path)
        print(
            f"{path.name} {time.monotonic() - start:.1f} s{'' if maps else ', blocked'}", flush=True
        )


if __name__ == "__main__":
    main()
