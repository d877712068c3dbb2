"""Rendered worlds as samples for the sky network: plain fields and seas as no photo shows."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np

from training.augment import Random, Sample
from training.land.data import WATER, Worlds, sample, sizes

AREA = 70_000  # pixels of the picture of a world before it is squeezed to a square


class WorldSamples:
    """Makes a square sample of ``size`` pixels from a world of a folder, by chance."""

    def __init__(self, folder: Path, size: int) -> None:
        self.folder, self.size = folder, size
        self.worlds: Worlds | None = None  # opened in the process that uses it

    def __call__(self, random: Random) -> Sample:
        """One world's picture, its sky and its water."""
        self.worlds = self.worlds or Worlds(self.folder)
        shapes = sizes(AREA)
        rows, columns = shapes[int(random.integers(len(shapes)))]
        world = self.worlds[int(random.integers(len(self.worlds)))]
        found = sample(world, rows, columns, random)
        square = self.size, self.size
        image = np.ascontiguousarray(found["image"].transpose(1, 2, 0))
        sky = cv2.resize(found["sky"][0], square, interpolation=cv2.INTER_LINEAR)
        matter = found["matter"].astype(np.uint8)
        matter = cv2.resize(matter, square, interpolation=cv2.INTER_NEAREST)
        target = np.rint(255 * np.clip(sky, 0, 1)).astype(np.uint8)
        return Sample(
            cv2.resize(image, square, interpolation=cv2.INTER_LINEAR),
            target,
            np.full_like(target, 255),
            np.where(matter == WATER, 255, 0).astype(np.uint8),
        )
