"""Batches: worlds photographed anew each time, and real photos with masks of sky and water."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import torch
from torch import Tensor
from torch.utils.data import IterableDataset

from training.augment import relight
from training.data import FOLDERS, barred, held_out, read_pair
from training.land import haze, photograph
from training.land.air import with_air
from training.land.camera import to_sun, up
from training.land.model import SUN_HEIGHTS, SUN_TURNS
from training.loop import numbers
from training.sky_corrections import corrected, judges
from training.suns.water import UNKNOWN, water_to_learn
from training.worlds import CLASSES

Random = np.random.Generator
Batch = dict[str, Tensor]

SHAPES = ((2, 3), (2, 3), (3, 4), (1, 1), (3, 2), (4, 3), (3, 5))  # rows to columns
_KEPT = 400  # worlds in memory
_LOW = 0.2  # radians: lower suns are photographed twice as often


def sizes(area: int) -> list[tuple[int, int]]:
    """Return rows and columns of all shapes, multiples of 32, of about ``area`` pixels."""
    found = []
    for high, wide in SHAPES:
        side = np.sqrt(area / (high * wide))
        found.append((32 * max(3, round(high * side / 32)), 32 * max(3, round(wide * side / 32))))
    return found


def size_of(shape: tuple[int, int], area: int) -> tuple[int, int]:
    """Return rows and columns of a shape, multiples of 32, of about ``area`` pixels."""
    scale = (area / (shape[0] * shape[1])) ** 0.5
    rows, columns = (max(2, round(side * scale / 32)) * 32 for side in shape)
    return rows, columns


class Worlds:
    """The worlds of a folder, read when asked for; new files are found as they come."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._files: list[Path] = []
        self._kept: OrderedDict[Path, dict[str, np.ndarray]] = OrderedDict()
        self.look()

    def look(self) -> int:
        """Look for new files; return how many there are."""
        self._files = sorted(self._folder.glob("*.npz"))
        return len(self._files)

    def __len__(self) -> int:
        return len(self._files)

    def __getitem__(self, index: int) -> dict[str, np.ndarray]:
        path = self._files[index]
        if path not in self._kept:
            with np.load(path) as file:
                self._kept[path] = dict(file)
            if len(self._kept) > _KEPT:
                self._kept.popitem(last=False)
        return self._kept[path]


def sample(world: dict[str, np.ndarray], rows: int, columns: int, random: Random) -> dict:
    """Return one photo of a world with its truth, as arrays."""
    low = np.where(world["suns"][: len(world["light"]), 1] < _LOW, 2.0, 1.0)
    sun = int(random.choice(len(low), p=low / low.sum()))
    shape = world["depth"].shape
    box = photograph.box(random, shape, rows, columns)
    depth = world["depth"].astype(np.float32)
    light, air = with_air(world, sun, random)
    light = photograph.glare(light, random)
    image = photograph.develop(box.of(light, cv2.INTER_AREA), random)
    sky = (world["matter"] == 0).astype(np.float32)
    half = photograph.Box(
        box.top, box.left, box.height, box.width, rows // 2, columns // 2, box.mirrored
    )
    solid = half.of(1 - sky, cv2.INTER_AREA)
    air = half.of(air * (1 - sky), cv2.INTER_AREA) / np.maximum(solid, 0.05)
    matter = half.of(world["matter"], cv2.INTER_NEAREST)
    normal = world["normal"].astype(np.float32) / 127
    water = world["matter"] == 1
    normal[water] = up(world["camera"])
    normal = half.of(normal, cv2.INTER_AREA)
    if box.mirrored:
        normal = normal * np.float32([-1, 1, 1])
    normal /= np.maximum(np.linalg.norm(normal, axis=-1, keepdims=True), 1e-3)
    level = half.of(np.where(np.isfinite(depth), depth, 0) * (1 - sky), cv2.INTER_AREA)
    land = 1 - box.of(sky, cv2.INTER_AREA)
    return {
        "image": image.transpose(2, 0, 1),
        "sky": box.of(sky, cv2.INTER_AREA)[None],
        "sunlit": box.of(world["sunlit"][sun].astype(np.float32) / 255, cv2.INTER_AREA)[None],
        "land": ((land > 0.95) * np.where(box.of(water.astype(np.float32)) > 0.5, 0.1, 1.0))[None],
        "solid": (solid > 0.95)[None],
        "normal": normal.transpose(2, 0, 1),
        "depth": (level / np.maximum(solid, 0.5))[None],
        "air": air[None],
        "openness": half.of(world["openness"].astype(np.float32) / 255, cv2.INTER_AREA)[None],
        "matter": matter,
        "view": _view(world, sun, box),
        "sun": shares(world["suns"][sun], mirrored=box.mirrored),
        **_facing(world, sun, half),
        **_others(world, random, box, half),
    }


def _others(
    world: dict[str, np.ndarray], random: Random, box: photograph.Box, half: photograph.Box
) -> dict[str, np.ndarray]:
    """Return what of the light of two of the world's suns, by chance, falls on each place."""
    suns, passed = [], []
    for sun in random.permutation(len(world["sunlit"]))[:2]:
        azimuth, elevation, covered = (float(v) for v in world["suns"][sun])
        flat = np.cos(elevation)
        right = flat * np.sin(azimuth) * (-1 if box.mirrored else 1)
        known = float(not covered and elevation > 0)
        suns.append((right, np.sin(elevation), flat * np.cos(azimuth), known))
        light = _cosine(world, sun) * world["sunlit"][sun] / np.float32(255)
        passed.append(half.of(light, cv2.INTER_AREA)[None])
    return {"suns": np.float32(suns), "passed": np.stack(passed)}


def _cosine(world: dict[str, np.ndarray], sun: int) -> np.ndarray:
    """Return the cosine between normal and sun, (H, W), no less than 0."""
    normal = world["normal"].astype(np.float32) / 127
    return np.maximum(normal @ to_sun(world["camera"], world["suns"][sun]), 0)


def _view(world: dict[str, np.ndarray], sun: int, box: photograph.Box) -> np.ndarray:
    fov, pitch, roll, _ = (float(v) for v in world["camera"])
    rows, columns = world["depth"].shape
    focal = 0.5 * rows / np.tan(fov / 2)
    # The horizon's row below the middle of the picture, turned with the roll about it.
    middle = 0.5 * rows + focal * np.tan(pitch) * np.cos(roll) ** -1
    aside = box.left + box.width / 2 - columns / 2
    row = (middle + np.tan(roll) * aside - box.top) / box.height - 0.5
    _, elevation, covered = (float(v) for v in world["suns"][sun])
    slope = (-1 if box.mirrored else 1) * np.tan(roll)
    shining = float(not covered and elevation > 0)
    return np.float32([row, slope, np.log2(focal / box.height), shining])


def shares(sun: np.ndarray, *, mirrored: bool) -> np.ndarray:
    """Return a sun (azimuth, elevation, radians, …) as shares of the nearest of the grid, (72,)."""
    azimuth, elevation = np.degrees(sun[:2])
    step = float(SUN_TURNS[1] - SUN_TURNS[0])
    apart = (SUN_TURNS.numpy() - (-azimuth if mirrored else azimuth) + 180) % 360 - 180
    turns = np.maximum(1 - np.abs(apart) / step, 0)
    heights = SUN_HEIGHTS.numpy()
    rows = [np.interp(elevation, heights, one) for one in np.eye(len(heights))]
    return np.outer(rows, turns).astype(np.float32).ravel()


def _facing(world: dict[str, np.ndarray], sun: int, half: photograph.Box) -> dict[str, np.ndarray]:
    """Return the cosine between normal and sun, and where it lights what."""
    lit = half.of(world["sunlit"][sun].astype(np.float32) / 255, cv2.INTER_AREA)
    facing = half.of(_cosine(world, sun), cv2.INTER_AREA)
    return {"facing": facing[None], "faced": np.maximum(2 * lit - 1, 0)[None]}


class WorldBatches(IterableDataset):
    """Endless batches of worlds, each of one shape; ``__iter__`` yields dicts of tensors."""

    def __init__(self, folder: Path, area: int, count: int, seed: int) -> None:
        self._folder, self._area, self._count, self._seed = folder, area, count, seed

    def __iter__(self) -> Iterator[Batch]:
        cv2.setNumThreads(1)
        random, worlds = numbers(self._seed), Worlds(self._folder)
        for number in range(10**9):
            if number % 20 == 0:
                worlds.look()
            rows, columns = sizes(self._area)[random.integers(len(SHAPES))]
            picked = random.integers(len(worlds), size=self._count)
            items = [sample(worlds[i], rows, columns, random) for i in picked]
            yield stack(items)


def stack(items: list[dict]) -> Batch:
    """Return samples as one batch; pictures stay uint8, the rest is float32 or int64."""
    batch = {}
    for key in items[0]:
        values = np.stack([item[key] for item in items])
        kind = {"image": np.uint8, "matter": np.int64}.get(key, np.float32)
        batch[key] = torch.from_numpy(values.astype(kind))
    return batch


class PhotoBatches(IterableDataset):
    """Endless batches of real photos: ``image``, ``sky``, ``water`` (N, 1, H, W), 128 unknown."""

    def __init__(self, root: Path, area: int, count: int, seed: int) -> None:
        self._root, self._area, self._count, self._seed = root, area, count, seed

    def __iter__(self) -> Iterator[Batch]:
        cv2.setNumThreads(1)
        random = numbers(self._seed)
        pairs = photos(self._root)
        weights = np.array([FOLDERS[folder] for folder, *_ in pairs])
        weights /= weights.sum()
        while True:
            rows, columns = sizes(self._area)[random.integers(len(SHAPES))]
            picked = random.choice(len(pairs), self._count, p=weights)
            yield stack([_photo(*pairs[i], rows, columns, random) for i in picked])


def photos(root: Path, *, held: bool = False) -> list[tuple[str, Path, Path]]:
    """Return folder, picture and mask of all photos to learn from (or of those that judge)."""
    found = []
    for folder in FOLDERS:
        names = barred(root / folder)
        for image in sorted((root / folder / "images").glob("*.jpg")):
            mask = root / folder / "masks" / f"{image.stem}.png"
            if image.name in names or not mask.exists():
                continue
            if (held_out(folder, image.stem) or judges(f"{folder}/{image.name}")) == held:
                found.append((folder, image, mask))
    return found


def outlined(root: Path, *, judging: bool) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Yield picture (h, w, 3) uint8, and haze as ``haze_map``, of outlined photos.

    ``judging`` selects those that only judge, or the others.
    """
    for file in haze.outlines():
        if haze.judges(file) == judging:
            folder, name = file.split("/")
            mask = root / folder / "masks" / f"{Path(name).stem}.png"
            pair = read_pair(root / folder / "images" / name, mask)
            yield pair[..., :3], *haze.haze_map(file, corrected(file, pair[..., 3]))


def _photo(
    folder: str, image: Path, mask: Path, rows: int, columns: int, random: Random
) -> dict[str, np.ndarray]:
    pair, file = read_pair(image, mask), f"{folder}/{image.name}"
    box = photograph.box(random, pair.shape[:2], rows, columns)
    sky = corrected(file, pair[..., 3])
    water = water_to_learn(file, sky)
    picture = box.of(pair[..., :3], cv2.INTER_AREA)
    if random.random() < 0.5:
        gain = np.exp(random.normal(0, 0.12, 3) + random.normal(0, 0.25))
        picture = np.clip(picture * gain, 0, 255).astype(np.uint8)
    target = np.where(box.of(sky, cv2.INTER_NEAREST) > 191, 255, 0).astype(np.uint8)
    light = relight(picture.astype(np.float32) / 255, target, random)  # a third of them
    picture = np.rint(255 * np.clip(light, 0, 1)).astype(np.uint8)
    return {
        "image": picture.transpose(2, 0, 1),
        "sky": box.of(sky, cv2.INTER_NEAREST)[None],
        "water": box.of(water, cv2.INTER_NEAREST)[None],
    }


WATER = CLASSES.index("water")
__all__ = [
    "UNKNOWN",
    "WATER",
    "PhotoBatches",
    "WorldBatches",
    "Worlds",
    "photos",
    "sample",
    "stack",
]
