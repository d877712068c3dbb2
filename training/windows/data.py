"""Batches for PaneNet: drawn and photographed façades before photos of nature."""

from __future__ import annotations

import hashlib
from collections import deque
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import torch
from torch.utils.data import IterableDataset

from training.augment import photometric
from training.loop import numbers
from training.windows.draw import street
from training.windows.facades import Facades

WITH_WINDOWS = Path(__file__).parent / "with_windows.txt"
"""Photos of the folder that show windows, of those in which a first network saw most."""
SIDE = 256
RECENT, NEW = 192, 0.35  # streets that are used again; share of new ones
SOFT, PLAIN = 0.4, 0.3  # shares: of pictures that are not sharp; that have a photo's own light
FOLDER = "landscape-pseudo/images"


def natural(root: Path) -> list[Path]:
    """Photos of nature: as good as none shows a window."""
    known = set(WITH_WINDOWS.read_text().split())
    return [p for p in sorted((root / FOLDER).glob("*.jpg")) if p.name not in known]


def held_out(path: Path) -> bool:
    """Whether a photo only judges: one in eight, by its name."""
    return hashlib.sha256(path.name.encode()).digest()[0] % 8 == 0


class Batches(IterableDataset):
    """Endless ``image`` (N, 3, S, S) uint8 and ``known`` (N, 4, S, S) float (``draw.LAYERS``)."""

    def __init__(
        self, photos: list[Path], batch: int, seed: int, facades: Facades | None = None
    ) -> None:
        super().__init__()
        self.photos, self.batch, self.seed, self.facades = photos, batch, seed, facades

    def __iter__(self) -> Iterator[dict[str, torch.Tensor]]:
        cv2.setNumThreads(1)
        random = numbers(self.seed)
        recent: deque[tuple[np.ndarray, np.ndarray]] = deque(maxlen=RECENT)
        while True:
            pairs = [self.again(recent, random) for _ in range(self.batch)]
            planes = (np.stack(part).transpose(0, 3, 1, 2) for part in zip(*pairs, strict=True))
            image, known = (torch.from_numpy(np.ascontiguousarray(p)) for p in planes)
            yield {"image": image, "known": known}

    def again(
        self, recent: deque[tuple[np.ndarray, np.ndarray]], random: np.random.Generator
    ) -> tuple[np.ndarray, np.ndarray]:
        """A new street, or a recent one in another light: drawing takes most of the time."""
        if len(recent) < RECENT or random.random() < NEW:
            recent.append(self.street(random))
            return seen(*recent[-1], random)
        picture, known = recent[random.integers(len(recent))]
        if random.random() < 0.5:
            picture, known = (np.ascontiguousarray(p[:, ::-1]) for p in (picture, known))
        return seen(picture, known, random)

    def sample(self, random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
        """A picture (S, S, 3) uint8, and what is known of it (S, S, 4) float32."""
        return seen(*self.street(random), random)

    def street(self, random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
        return street(self.part(random), self.part(random), random, self.facades)

    def part(self, random: np.random.Generator) -> np.ndarray:
        """A square part of a photo, (S, S, 3) uint8 RGB."""
        photo = cv2.imread(str(self.photos[random.integers(len(self.photos))]))[..., ::-1]
        side = int(min(photo.shape[:2]) * random.uniform(0.4, 1.0))
        y, x = (int(random.integers(0, n - side + 1)) for n in photo.shape[:2])
        part = np.ascontiguousarray(photo[y : y + side, x : x + side])
        if random.random() < 0.5:
            part = np.ascontiguousarray(part[:, ::-1])
        return cv2.resize(part, (SIDE, SIDE), interpolation=cv2.INTER_AREA)


def seen(
    image: np.ndarray, known: np.ndarray, random: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """A street as a camera has it, in some light."""
    if random.random() < SOFT:  # a small photo, or one that is not sharp
        side = int(SIDE / random.uniform(1.0, 2.5))
        small = cv2.resize(image, (side, side), interpolation=cv2.INTER_AREA)
        image = cv2.resize(small, (SIDE, SIDE), interpolation=cv2.INTER_CUBIC)
    if random.random() < PLAIN:
        return image, known.astype(np.float32)
    nothing = np.zeros(known.shape[:2], np.uint8)
    return photometric(image, nothing, random), known.astype(np.float32)
