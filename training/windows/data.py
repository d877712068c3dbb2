"""Batches for PaneNet: drawn façades before photos of nature."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import torch
from torch.utils.data import IterableDataset, get_worker_info

from training.augment import photometric
from training.windows.draw import street

WITH_WINDOWS = Path(__file__).parent / "with_windows.txt"
"""Photos of the folder that show windows, of those in which a first network saw most."""
SIDE = 256
FOLDER = "landscape-pseudo/images"


def natural(root: Path) -> list[Path]:
    """Photos of nature: as good as none shows a window."""
    known = set(WITH_WINDOWS.read_text().split())
    return [p for p in sorted((root / FOLDER).glob("*.jpg")) if p.name not in known]


def held_out(path: Path) -> bool:
    """Whether a photo only judges: one in eight, by its name."""
    return hashlib.sha256(path.name.encode()).digest()[0] % 8 == 0


class Batches(IterableDataset):
    """Endless ``image`` (N, 3, S, S) uint8 and ``pane`` (N, 1, S, S) float."""

    def __init__(self, photos: list[Path], batch: int, seed: int) -> None:
        super().__init__()
        self.photos, self.batch, self.seed = photos, batch, seed

    def __iter__(self) -> Iterator[dict[str, torch.Tensor]]:
        cv2.setNumThreads(1)
        worker = get_worker_info()
        random = np.random.default_rng([self.seed, worker.id if worker else 0])
        while True:
            pairs = [self.sample(random) for _ in range(self.batch)]
            image, pane = (np.stack(part) for part in zip(*pairs, strict=True))
            image = np.ascontiguousarray(image.transpose(0, 3, 1, 2))
            yield {"image": torch.from_numpy(image), "pane": torch.from_numpy(pane[:, None])}

    def sample(self, random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
        image, pane = street(self.part(random), self.part(random), random)
        nothing = np.zeros(pane.shape, np.uint8)
        return photometric(image, nothing, random), pane.astype(np.float32)

    def part(self, random: np.random.Generator) -> np.ndarray:
        """A square part of a photo, (S, S, 3) uint8 RGB."""
        photo = cv2.imread(str(self.photos[random.integers(len(self.photos))]))[..., ::-1]
        side = int(min(photo.shape[:2]) * random.uniform(0.4, 1.0))
        y, x = (int(random.integers(0, n - side + 1)) for n in photo.shape[:2])
        part = np.ascontiguousarray(photo[y : y + side, x : x + side])
        if random.random() < 0.5:
            part = np.ascontiguousarray(part[:, ::-1])
        return cv2.resize(part, (SIDE, SIDE), interpolation=cv2.INTER_AREA)
