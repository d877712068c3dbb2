"""Training photos: read once, packed into one memory-mapped file, served as augmented batches.

Masks on disk: 255 sky, 0 not sky, 128 ignore. In the pack every photo is ``(H, W, 5)`` uint8: sRGB,
its mask, and where its water is (``suns/water.py``; unknown in photos that judge water).
"""

from __future__ import annotations

import csv
import hashlib
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import cv2
import numpy as np
import torch
from torch.utils.data import IterableDataset

from training.augment import Augment, Random, Sample, crop
from training.loop import numbers
from training.rooms import Rooms
from training.sky_corrections import corrected, corrections, judges
from training.suns.water import water_to_learn

FOLDERS = {
    "landscape-pseudo": 1.0,
    "weather-pseudo": 0.6,
    "camvid": 1.5,
    "sea-sky": 0.4,
    "skyreplace-example": 0.4,
}
"""Folder of pairs -> how often one of its photos is drawn, relative to the first."""
TEXTURES = "opensky"
WORLDS = 0.35
"""How much of the samples are rendered worlds, where these are used."""
CORRECTED = 5.0
"""How often a photo with corrections by hand is drawn, relative to others of its folder."""
NON_COMMERCIAL = re.compile(r"\bNC\b|non-?commercial", re.IGNORECASE)
HELD_OUT = 16
"""One photo in this many (by a hash of its name) is kept for choosing between checkpoints."""


def barred(folder: Path) -> set[str]:
    """Names of the photos whose stated licence forbids commercial use."""
    index = folder / "index.tsv"
    if not index.exists():
        return set()
    with index.open(encoding="utf-8", newline="") as file:
        return {
            r["file"]
            for r in csv.DictReader(file, delimiter="\t")
            if NON_COMMERCIAL.search(r["licence"])
        }


def held_out(folder: str, name: str) -> bool:
    """Whether a photo belongs to the validation split; neighbouring frames share their fate."""
    key = name[:-7] if folder == "camvid" else name
    return hashlib.sha256(f"{folder}/{key}".encode()).digest()[0] % HELD_OUT == 0


def read_pair(image: Path, mask: Path | None) -> np.ndarray:
    """One photo as ``(H, W, 4)`` uint8: sRGB, then the mask (255 without a mask file)."""
    rgb = cv2.cvtColor(cv2.imread(str(image), cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB)
    label = (
        np.full(rgb.shape[:2], 255, np.uint8)
        if mask is None
        else cv2.imread(str(mask), cv2.IMREAD_GRAYSCALE)
    )
    if label.shape != rgb.shape[:2]:
        label = cv2.resize(label, rgb.shape[1::-1], interpolation=cv2.INTER_NEAREST)
    return np.dstack([rgb, label])


class Pack:
    """All photos in one memory-mapped file beside a small index; built on first use."""

    def __init__(self, root: Path, cache: Path) -> None:
        index = cache / "index.npz"
        if not index.exists():
            self._build(root, cache, index)
        with np.load(index) as table:
            self.offset, self.shape = table["offset"], table["shape"]
            self.folder, self.held_out = table["folder"], table["held_out"]
            self.by_hand = table["by_hand"]
        self.bytes = np.memmap(cache / "pixels.bin", np.uint8, "r")

    @staticmethod
    def _build(root: Path, cache: Path, index: Path) -> None:
        cache.mkdir(parents=True, exist_ok=True)
        offset, shape, folders, held, by_hand = [], [], [], [], []
        position = 0
        with (cache / "pixels.bin").open("wb") as out:
            for folder in (*FOLDERS, TEXTURES):
                pairs = folder != TEXTURES
                skip = barred(root / folder)
                for path in sorted(
                    (root / folder / "images" if pairs else root / folder).glob("*.jpg")
                ):
                    if path.name in skip:
                        continue
                    photo = read_pair(
                        path, root / folder / "masks" / f"{path.stem}.png" if pairs else None
                    )
                    file = f"{folder}/{path.name}"
                    photo[..., 3] = corrected(file, photo[..., 3])
                    photo = np.dstack([photo, water_to_learn(file, photo[..., 3])])
                    out.write(photo.tobytes())
                    offset.append(position)
                    shape.append(photo.shape[:2])
                    folders.append(folder)
                    held.append(held_out(folder, path.stem) or judges(file))
                    by_hand.append(file in corrections())
                    position += photo.size
        np.savez(index, offset=offset, shape=shape, folder=folders, held_out=held, by_hand=by_hand)

    def __getitem__(self, i: int) -> np.ndarray:
        height, width = self.shape[i]
        start = int(self.offset[i])
        return np.asarray(self.bytes[start : start + height * width * 5]).reshape(height, width, 5)

    def select(self, *, training: bool) -> np.ndarray:
        """Indices of the pairs of one split."""
        return np.flatnonzero((self.folder != TEXTURES) & (self.held_out != training))

    def textures(self) -> np.ndarray:
        """Indices of the photos that are nothing but sky."""
        return np.flatnonzero((self.folder == TEXTURES) & ~self.held_out)


class Batches(IterableDataset):
    """Endless augmented batches, all uint8.

    Image ``(N, 3, S, S)``; sky, its weight in the loss, and water ``(N, 1, S, S)``.
    """

    def __init__(
        self,
        root: Path,
        cache: Path,
        rooms: Path | None,
        size: int,
        batch: int,
        seed: int,
        worlds: Callable[[Random], Sample] | None = None,
    ) -> None:
        self.root, self.cache, self.rooms = root, cache, rooms
        self.size, self.batch, self.seed, self.worlds = size, batch, seed, worlds

    def __iter__(self) -> Iterator[tuple[torch.Tensor, ...]]:
        cv2.setNumThreads(0)
        torch.set_num_threads(1)
        random = numbers(self.seed, self.size)
        pack, rooms = Pack(self.root, self.cache), Rooms(self.rooms)
        pairs, textures = pack.select(training=True), pack.textures()
        weight = np.array([FOLDERS[str(f)] for f in pack.folder[pairs]])
        weight *= np.where(pack.by_hand[pairs], CORRECTED, 1.0)
        weight /= weight.sum()

        def sky() -> np.ndarray:
            return pack[random.choice(textures)][..., :3]

        def photo() -> np.ndarray:
            return pack[random.choice(pairs, p=weight)]

        augment = Augment(self.size, random, sky, photo, rooms)

        def sample() -> Sample:
            if self.worlds is not None and random.random() < WORLDS:
                return self.worlds(random)
            return augment(photo())

        while True:
            yield stack([sample() for _ in range(self.batch)])


def stack(samples: list[Sample]) -> tuple[torch.Tensor, ...]:
    """Samples -> uint8 tensors, channels last in memory."""
    image = torch.from_numpy(np.stack([s.image for s in samples])).permute(0, 3, 1, 2)
    target = torch.from_numpy(np.stack([s.target for s in samples]))[:, None]
    weight = torch.from_numpy(np.stack([edge_weight(s) for s in samples]))[:, None]
    water = torch.from_numpy(np.stack([s.water for s in samples]))[:, None]
    return image, target, weight, water


def edge_weight(sample: Sample) -> np.ndarray:
    """Weight of every pixel in the loss, ``(S, S)`` uint8.

    0 where nothing is known, 85 inside, up to 255 within 2 px of an edge.
    """
    edge = cv2.morphologyEx(sample.target, cv2.MORPH_GRADIENT, np.ones((5, 5), np.uint8))
    return np.where(sample.valid > 0, 85 + (edge // 3) * 2, 0).astype(np.uint8)


def validation(
    root: Path, cache: Path, size: int, batch: int = 8
) -> list[tuple[torch.Tensor, ...]]:
    """The held-out photos, whole, squeezed to ``size`` squares, not augmented."""
    pack = Pack(root, cache)
    return plain(pack, pack.select(training=False), size, batch)


def typical(root: Path, cache: Path, size: int, count: int) -> list[tuple[torch.Tensor, ...]]:
    """``count`` photos spread over the training split, treated as in :func:`validation`."""
    pack = Pack(root, cache)
    chosen = pack.select(training=True)
    return plain(pack, chosen[:: max(1, len(chosen) // count)], size, 12)


def plain(pack: Pack, chosen: np.ndarray, size: int, batch: int) -> list[tuple[torch.Tensor, ...]]:
    """Batches of whole photos; a last incomplete one is kept."""
    samples = [crop(pack[i], (0, 0, *pack.shape[i]), size) for i in chosen]
    return [stack(samples[i : i + batch]) for i in range(0, len(samples), batch)]
