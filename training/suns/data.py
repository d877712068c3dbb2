"""Batches for SunNet: drawn suns in photos without one, and hand-labelled photos as they are."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import torch
from torch.utils.data import IterableDataset

from training.data import read_pair
from training.loop import numbers
from training.suns.compose import compose, spoil
from training.suns.labels import Photo, labels
from training.suns.light import LUMINANCE, to_linear
from training.suns.model import HALF, LIGHT_FLOOR, QUARTER
from training.suns.water import UNKNOWN, outlines, water_to_learn

FOLDERS = ("landscape-pseudo", "weather-pseudo", "camvid", "sea-sky", "skyreplace-example")
TEXTURES = "opensky"
SIZES = ((224, 320), (256, 256), (320, 224), (192, 352), (288, 288))
"""(height, width) of the pictures of a batch, in pixels: every shape of photo in turn."""


@dataclass
class Split:
    """Paths of photos to train on: with a label as they are, and without a sun."""

    labelled: list[Photo]
    sunless: list[str]
    skies: list[str]  # those without a sun that have sky enough to draw one in
    textures: list[str]
    watery: list[str]  # with an outline of water
    dry: list[str]  # known to have none


def split(root: Path) -> Split:
    """What may be trained on. A photo whose label only judges is in no list."""
    known = {p.file: p for p in labels()}
    sunless = []
    for folder in FOLDERS:
        for path in sorted((root / folder / "images").glob("*.jpg")):
            photo = known.get(f"{folder}/{path.name}")
            unlabelled = photo is None and not path.name.startswith(("sunrise", "shine"))
            if unlabelled or (photo is not None and photo.is_sunless and not photo.test):
                sunless.append(f"{folder}/{path.name}")
    trained = [p for p in known.values() if not p.test and p.kind != "drop"]
    textures = [f"{TEXTURES}/{p.name}" for p in sorted((root / TEXTURES).glob("*.jpg"))]
    skies = [f for f in sunless if (read(root, f)[::4, ::4, 3] > 191).mean() > 0.06]
    outlined = [p.file for p in trained if p.file in outlines()]
    watery = [f for f in outlined if outlines()[f][0]]
    watery += [f for f in sunless if f.startswith("sea-sky")][::4]
    dry = [f for f in outlined if not outlines()[f][0]]
    dry += [f for f in sunless if f.startswith("camvid")]
    return Split(trained, sunless, skies, textures, watery, dry)


def read(root: Path, file: str) -> np.ndarray:
    """A photo (h, w, 5) uint8: sRGB, and masks of its sky and its water (255; 128 unknown)."""
    folder, name = file.split("/")
    if folder == TEXTURES:
        photo = read_pair(root / folder / name, None)
        scale = min(1.0, 512 / max(photo.shape))
        photo = cv2.resize(photo, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    else:
        mask = root / folder / "masks" / f"{Path(name).stem}.png"
        photo = read_pair(root / folder / "images" / name, mask)
    return np.dstack([photo, water_to_learn(file, photo[..., 3])])


def random_box(
    shape: tuple[int, int], aspect: float, random: np.random.Generator, least: float
) -> tuple[int, int, int, int]:
    """A part of a photo, (top, left, height, width), of about this aspect (width over height)."""
    height, width = shape
    scale = np.sqrt(random.uniform(least, 1.0))
    aspect *= np.exp(random.normal(0, 0.08))
    h, w = min(height, width / aspect), min(width, height * aspect)
    h, w = max(int(h * scale), 16), max(int(w * scale), 16)
    return int(random.integers(height - h + 1)), int(random.integers(width - w + 1)), h, w


def cut(photo: np.ndarray, box: tuple[int, int, int, int], size: tuple[int, int]) -> np.ndarray:
    """The part of a photo at (height, width) ``size``."""
    top, left, h, w = box
    part = np.ascontiguousarray(photo[top : top + h, left : left + w])
    how = cv2.INTER_AREA if h > size[0] else cv2.INTER_LINEAR
    layers = part[..., :3], part[..., 3:]  # OpenCV resizes no more than four at a time
    return np.dstack([cv2.resize(each, size[::-1], interpolation=how) for each in layers])


def tone(rgb: np.ndarray, random: np.random.Generator) -> np.ndarray:
    """A real photo through another exposure, gamma and saturation; uint8."""
    x = rgb.astype(np.float32) / 255
    x = x ** np.exp(random.normal(0, 0.15)) * np.exp(min(random.normal(-0.03, 0.1), 0.05))
    grey = x @ LUMINANCE
    x = grey[..., None] + random.uniform(0.6, 1.35) * (x - grey[..., None])
    return spoil(np.clip(x * np.exp(random.normal(0, 0.03, 3)), 0, 1).astype(np.float32), random)


def small_log(encoded: np.ndarray) -> np.ndarray:
    """log(display-linear light + floor) at half of the size, (h/2, w/2, 3)."""
    height, width = encoded.shape[:2]
    light = cv2.resize(
        to_linear(encoded), (width // HALF, height // HALF), interpolation=cv2.INTER_AREA
    )
    return np.log(light + LIGHT_FLOOR)


def example(
    image: np.ndarray,
    sky: np.ndarray,
    place: tuple[float, float] | None,
    radius: float,
    sharp: float,
    clean: np.ndarray | None,
    seen: float = 1.0,
    water: np.ndarray | None = None,
) -> dict[str, np.ndarray]:
    """Image (uint8) and targets; ``clean`` None where the sky without the sun is not known.

    ``water`` (h, w) uint8: 255, 0, or what lies between where it is not known.
    """
    height, width = image.shape[0] // QUARTER, image.shape[1] // QUARTER
    heat = np.zeros((height, width), np.float32)
    weight = np.ones((height, width), np.float32)
    if place is not None:
        column, row = int(place[0] / QUARTER), int(place[1] / QUARTER)
        column, row = min(max(column, 0), width - 1), min(max(row, 0), height - 1)
        sigma = max(1.0, 0.4 * radius * width)
        d2 = (np.arange(width) - column) ** 2 + (np.arange(height)[:, None] - row) ** 2
        heat = np.exp(-0.5 * d2 / sigma**2).astype(np.float32)
        heat[row, column] = 1.0
        if seen < 0.25:  # hardly to be seen: neither a sun nor none
            weight = (heat < 0.02).astype(np.float32)
            heat *= 0
    if clean is None:
        target = np.zeros((image.shape[0] // HALF, image.shape[1] // HALF, 3), np.float32)
        clean_weight = target[..., 0]
    else:
        target = small_log(clean) - small_log(image.astype(np.float32) / 255)
        size = target.shape[1::-1]
        small = cv2.resize(sky.astype(np.float32), size, interpolation=cv2.INTER_AREA)
        clean_weight = (0.15 + 0.85 * small) * (1 + 2 * np.minimum(np.abs(target).mean(-1), 1))
    water = np.full(sky.shape, UNKNOWN, np.uint8) if water is None else water
    wet, dry = (
        cv2.resize(mask.astype(np.float32), (width, height), interpolation=cv2.INTER_AREA)
        for mask in (water > 191, water < 64)
    )
    return {
        "image": image.transpose(2, 0, 1),
        "heat": heat[None],
        "heat_weight": weight[None],
        "radius": np.full(
            (1, 1, 1), np.log(max(radius, 1e-3)) if radius > 0 else np.nan, np.float32
        ),
        "sharp": np.full((1, 1, 1), sharp, np.float32),
        "clean": np.ascontiguousarray(target.transpose(2, 0, 1), np.float32),
        "clean_weight": clean_weight[None].astype(np.float32),
        "water": wet[None],
        "water_weight": (wet + dry > 0.95).astype(np.float32)[None],
    }


def drawn(photo: np.ndarray, size: tuple[int, int], random: np.random.Generator) -> dict:
    """A photo without a sun, one drawn into it."""
    part = cut(photo, random_box(photo.shape[:2], size[1] / size[0], random, 0.35), size)
    part = part[:, ::-1] if random.random() < 0.5 else part
    sky = cv2.GaussianBlur((part[..., 3] > 127).astype(np.float32), (0, 0), 0.6)
    result = compose(np.ascontiguousarray(part[..., :3]), sky, random)
    image, water = spoil(result.image, random), part[..., 4].copy()
    if result.water is not None:  # its glints are to go, too
        sky[result.water :] = np.maximum(sky[result.water :], 0.6)
        water[result.water :] = 255
    if result.ground is not None:
        water[result.ground :] = 0
    return example(
        image,
        sky,
        result.place,
        result.radius,
        result.sharp,
        result.clean,
        result.seen,
        water,
    )


def real(
    photo: np.ndarray, label: Photo | None, size: tuple[int, int], random: np.random.Generator
) -> dict:
    """A photo as it is; the part keeps the sun, mostly."""
    has_sun = label is not None and (label.is_sun or label.kind == "glow")
    height, width = photo.shape[:2]
    for _ in range(12):
        top, left, h, w = box = random_box((height, width), size[1] / size[0], random, 0.3)
        x, y = 0.0, 0.0
        if not has_sun:
            break
        x, y = (label.x * width - left) / w, (label.y * height - top) / h
        if 0.03 < x < 0.97 and 0.03 < y < 0.97:
            break
    part = cut(photo, box, size)
    if random.random() < 0.5:
        part, x = part[:, ::-1], 1 - x
    image = tone(part[..., :3], random)
    sky, water = (part[..., 3] > 127).astype(np.float32), part[..., 4]
    if not has_sun:
        clean = image.astype(np.float32) / 255
        return example(image, sky, None, 0.0, np.nan, clean, water=water)
    if label.kind == "glow":  # its place is neither a sun nor none, elsewhere there is none
        if not (0 < x < 1 and 0 < y < 1):
            return example(image, sky, None, 0.0, np.nan, None, water=water)
        place = x * size[1], y * size[0]
        return example(image, sky, place, 0.1, np.nan, None, 0.0, water)
    radius = label.r * width / w
    if not (-2 * radius < x < 1 + 2 * radius and -2 * radius < y < 1 + 2 * radius):
        return example(image, sky, None, 0.0, np.nan, None, water=water)
    inside = 0 < x < 1 and 0 < y < 1
    place = x * size[1], y * size[0]
    return example(image, sky, place, radius, np.nan, None, 1.0 if inside else 0.0, water)


class Batches(IterableDataset):
    """Endless batches: dictionaries of tensors, see ``training.suns.model.losses``."""

    def __init__(self, root: Path, batch: int, seed: int) -> None:
        self.root, self.batch, self.seed = root, batch, seed

    def __iter__(self) -> Iterator[dict[str, torch.Tensor]]:
        cv2.setNumThreads(0)
        torch.set_num_threads(1)
        random = numbers(self.seed)
        photos = split(self.root)
        suns = [p for p in photos.labelled if p.is_sun]
        baits, glows = ([p for p in photos.labelled if p.kind == k] for k in ("bait", "glow"))
        others = [p for p in photos.labelled if not p.is_sun and p.kind not in ("bait", "glow")]
        by_file = {p.file: p for p in photos.labelled}
        dry = sorted(set(photos.dry) & set(photos.skies))

        def one(size: tuple[int, int]) -> dict[str, np.ndarray]:
            draw = random.random()
            if draw < 0.62:
                kind = random.random()
                skies = dry if kind < 0.4 else photos.skies  # a sun on dry land, too
                file = str(random.choice(photos.textures if kind < 0.12 else skies))
                return drawn(read(self.root, file), size, random)
            if draw < 0.77 and photos.watery:
                file = str(random.choice(photos.watery if draw < 0.7 else photos.dry))
                return real(read(self.root, file), by_file.get(file), size, random)
            if draw < 0.86 and suns:
                label = suns[int(random.integers(len(suns)))]
            elif draw < 0.88 and baits:
                label = baits[int(random.integers(len(baits)))]
            elif draw < 0.93 and glows:
                label = glows[int(random.integers(len(glows)))]
            elif draw < 0.97 and others:
                label = others[int(random.integers(len(others)))]
            else:
                file = str(random.choice(photos.sunless))
                return real(read(self.root, file), None, size, random)
            return real(read(self.root, label.file), label, size, random)

        while True:
            size = SIZES[int(random.integers(len(SIZES)))]
            rows = [one(size) for _ in range(self.batch)]
            yield {
                key: torch.from_numpy(np.ascontiguousarray(np.stack([r[key] for r in rows])))
                for key in rows[0]
            }


def typical(root: Path, count: int, batch: int = 8) -> Iterator[torch.Tensor]:
    """``count`` batches of photos as they are trained on, uint8 (N, 3, 224, 320)."""
    random = np.random.default_rng(5)
    photos = split(root)
    for _ in range(count):
        labelled = [
            photos.labelled[int(i)] for i in random.integers(len(photos.labelled), size=batch // 2)
        ]
        files = [p.file for p in labelled] + [str(random.choice(photos.sunless)) for _ in labelled]
        parts = [read(root, f) for f in files]
        images = [cut(p, (0, 0, *p.shape[:2]), (224, 320))[..., :3] for p in parts]
        yield torch.from_numpy(np.stack(images).transpose(0, 3, 1, 2).copy())
