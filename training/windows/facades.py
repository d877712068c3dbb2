"""Photographed façades with labels by hand, straight on: walls and windows for drawn streets.

Read from a folder of the user's own: ``images/*.png``, and ``labels/*.txt`` with a class a pixel,
as ParisArtDecoFacades has them (Gadde, Marlet & Paragios 2016, "Learning grammars for
architecture-specific facade parsing", IJCV 117). None of it comes with this repository.
"""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np

Random = np.random.Generator
DOOR, SHOP, BALCONY, WINDOW, SKY = 0, 1, 2, 3, 5
SPLIT_SEED, JUDGES = 20261124, 0.24  # 19 of 79
GREEN = 8  # levels: leaves before a window, which labels pass over
SMALLEST = 8  # pixels of a window that is cut out


def names(folder: Path) -> tuple[list[str], list[str]]:
    """Façades to learn from, and those that only judge."""
    every = sorted(p.stem for p in (folder / "images").glob("*.png"))
    order = np.random.default_rng(SPLIT_SEED).permutation(len(every))
    few = round(JUDGES * len(every))
    return [every[i] for i in order[few:]], [every[i] for i in order[:few]]


def known(picture: np.ndarray, label: np.ndarray) -> np.ndarray:
    """Layers as in ``draw``: glass, opening, glass unknown, opening unknown; (h, w, 4) float32.

    Labels are of whole windows, so that glass is known where there is none only. Shops and what has
    no label may be anything; behind the bars of a balcony below a window that window goes on.
    """
    opening = label == WINDOW
    color = picture.astype(int)
    leaves = color[..., 1] > np.maximum(color[..., 0], color[..., 2]) + GREEN
    below = cv2.dilate(opening.astype(np.uint8), np.ones((61, 1), np.uint8), anchor=(0, 60)) > 0
    doubt = (label == SHOP) | (label < 0) | ((label == BALCONY) & below) | (opening & leaves)
    layers = [np.zeros_like(opening), opening & ~doubt, doubt | opening, doubt]
    return np.dstack(layers).astype(np.float32)


class Facades:
    """Façades by name, in memory."""

    def __init__(self, folder: Path, chosen: list[str]) -> None:
        self.walls, self.windows = [], []
        for name in chosen:
            label = np.loadtxt(folder / "labels" / f"{name}.txt", dtype=np.int16)
            picture = cv2.imread(str(folder / "images" / f"{name}.png"))[..., ::-1]
            layers = known(picture, label)
            parts = [picture, 255 * layers, 255 * (label != SKY)]
            self.walls.append(np.dstack(parts).astype(np.uint8))
            self.windows += cut(picture, layers)

    def window(self, random: Random) -> np.ndarray:
        """One of the windows, (h, w, 3) float32 in [0, 255], mirrored or not."""
        picture = self.windows[random.integers(len(self.windows))]
        return (picture[:, ::-1] if random.random() < 0.5 else picture).astype(np.float32)

    def wall(self, quad: np.ndarray, random: Random) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """A part of a row of houses about as wide to its height as ``quad``, (4, 2) pixels, is.

        Picture (h, w, 3) float32 in [0, 255], what is known (h, w, 4), and where it is no sky.
        """
        sides = np.linalg.norm(np.roll(quad, -1, 0) - quad, axis=1)
        wide, tall = sides[[0, 2]].mean(), sides[[1, 3]].mean()
        shape = np.exp(random.normal(0, 0.3)) * wide / tall
        top, foot = random.uniform(0, 0.45), random.uniform(0.7, 1.0)
        row: list[np.ndarray] = []
        height = 0
        while not row or sum(part.shape[1] for part in row) < shape * height:
            house = self._house(random, top, foot)
            height = height or house.shape[0]
            row.append(resized(house, (round(house.shape[1] * height / house.shape[0]), height)))
        whole = np.concatenate(row, 1)
        width = int(min(max(shape * height, 16), whole.shape[1]))
        left = int(random.integers(0, whole.shape[1] - width + 1))
        part = whole[:, left : left + width]
        # No finer than needed twice as large: warps do not average.
        scale = min(1.0, 2 * max(tall / height, wide / width))
        size = tuple(max(2, round(scale * n)) for n in (width, height))
        part = resized(part, size).astype(np.float32)
        tint = np.exp(random.normal(0, 0.15, 3) + random.normal(0, 0.2))
        return part[..., :3] * tint, part[..., 3:7] / 255, part[..., 7] / 255

    def _house(self, random: Random, top: float, foot: float) -> np.ndarray:
        wall = self.walls[random.integers(len(self.walls))]
        house = wall[int(top * len(wall)) : int(foot * len(wall))]
        return house[:, ::-1] if random.random() < 0.5 else house


def resized(layers: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Any number of layers (h, w, n) at another size (width, height): OpenCV averages four."""
    parts = np.split(layers, range(4, layers.shape[2], 4), 2)
    parts = [cv2.resize(np.ascontiguousarray(p), size, None, 0, 0, cv2.INTER_AREA) for p in parts]
    return np.dstack(parts)


def cut(picture: np.ndarray, layers: np.ndarray) -> list[np.ndarray]:
    """Windows that nothing hides, each (h, w, 3) uint8."""
    opening = (layers[..., 1] > 0).astype(np.uint8)
    count, pieces, boxes, _ = cv2.connectedComponentsWithStats(opening)
    out = []
    for i in range(1, count):
        left, top, wide, tall, area = boxes[i]
        if area > 0.97 * wide * tall and min(wide, tall) >= SMALLEST:
            out.append(np.ascontiguousarray(picture[top : top + tall, left : left + wide]))
    return out
