"""Fits LandNet's heads of the horizon and of the sun once more, on worlds and on real photos.

``python -m training.land.heads --checkpoint build/land/last.pt --worlds build/worlds/train --data
../shared/data/train --teacher sunwidget/analysis/models/land.onnx --out build/land/heads.pt``

Worlds say where horizon and sun are, but look like worlds. A photo with a straight skyline says
where its horizon is (``robust_line``), for every part of it, and a labelled sun is known to a
camera that turned away from it (training/suns/away.py). Everything else an earlier network is
asked. The trunk stays as it is, so its features are computed once.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import onnxruntime
import torch
import torch.nn.functional as F
from torch import Tensor, nn

from sunwidget.analysis.horizon.horizon import robust_line
from training.data import read_pair
from training.land.data import SHAPES, Random, Worlds, photos, sample, shares, size_of, sizes
from training.land.model import SUN_HEIGHTS, SUN_TURNS, LandNet
from training.land.photograph import Box
from training.loop import save
from training.sky_corrections import corrected
from training.suns.away import without_suns
from training.suns.labels import judging, labels

AREAS = (62_000, 92_000)  # pixels of a picture, in turn
EACH_WORLD = 5  # pictures
LEAST = 0.55  # of a photo's sides: its smallest part
SURE = 0.7  # confidence from which a skyline is taken for the horizon
KNOWN_COUNTS = 4.0  # times as much as the teacher's word
VIEWS = 4  # of a photo with a labelled sun, each turned away from it
STEPS, BATCH, RATE, DECAY, NOISE, BETA = 4000, 256, 1e-3, 1.0, 0.05, 0.05
NOISE_OF_SUNS = 0.3
PHOTOS_COUNT = 2 / 3  # of the loss of worlds
SUNS_COUNT = 0.2  # labelled suns all stand near the picture, and others anywhere


@dataclass
class Table:
    """Features, what they should say, and how much each row counts."""

    features: Tensor  # (n, k)
    truth: Tensor  # (n, 4) of worlds, (n,) of photos: rows of horizons; or (n, 72): suns
    weight: Tensor  # (n,)

    @classmethod
    def of(cls, rows: list[tuple[Tensor, Tensor, float]]) -> Table:
        features, truth, weight = zip(*rows, strict=True)
        return cls(torch.stack(features), torch.stack(truth).float(), torch.tensor(weight))

    def draw(self, count: int) -> Tensor:
        """Return rows by chance, in proportion to their weights, (count,)."""
        return torch.multinomial(self.weight, count, replacement=True)


class Eyes:
    """What the heads see of a picture, and what an earlier network says of it."""

    def __init__(self, network: LandNet, teacher: Path) -> None:
        self.network = network
        self.session = onnxruntime.InferenceSession(teacher, providers=["CPUExecutionProvider"])

    @torch.no_grad()
    def seen(self, image: np.ndarray) -> tuple[Tensor, Tensor]:
        """Return the features of a picture (h, w, 3) uint8 for the two heads."""
        tensor = torch.from_numpy(image.transpose(2, 0, 1)[None].copy()).float() / 255
        view, sun = self.network.seen(tensor)
        return view[0], sun[0]

    def taught(self, picture: np.ndarray, *, mirrored: bool = False) -> tuple[float, np.ndarray]:
        """Return the horizon's row, in heights from the middle down, and the sun's shares (72,).

        ``mirrored`` says that the picture is, and has the teacher see it as it was.
        """
        rows, columns = size_of(picture.shape[:2], AREAS[-1])
        plain = picture[:, ::-1] if mirrored else picture
        image = cv2.resize(plain, (columns, rows), interpolation=cv2.INTER_AREA)
        image = image.transpose(2, 0, 1)[None].astype(np.float32) / 255
        view, sun = self.session.run(["view", "sun"], {"image": image})
        return float(view[0, 0]), _mirrored(sun[0]) if mirrored else sun[0]


def _mirrored(sun: np.ndarray) -> np.ndarray:
    """Return shares of the sun's directions (72,) with left and right exchanged."""
    turns = SUN_TURNS.numpy()
    opposite = [int(np.argmin(np.abs((turns + turn + 180) % 360 - 180))) for turn in turns]
    return np.asarray(sun.reshape(len(SUN_HEIGHTS), -1)[:, opposite].ravel())


def of_worlds(eyes: Eyes, worlds: Worlds, random: Random) -> tuple[Table, Table]:
    """Return horizons, and suns where one shines, of some pictures of each world."""
    horizons, suns = [], []
    for i in range(EACH_WORLD * len(worlds)):
        shapes = sizes(AREAS[i % len(AREAS)])
        one = sample(worlds[i % len(worlds)], *shapes[random.integers(len(SHAPES))], random)
        view, sun = eyes.seen(one["image"].transpose(1, 2, 0))
        horizons.append((view, torch.from_numpy(one["view"]), 1.0))
        if one["view"][3]:
            suns.append((sun, torch.from_numpy(one["sun"]), 1.0))
    return Table.of(horizons), Table.of(suns)


def of_photos(eyes: Eyes, data: Path, random: Random) -> tuple[Table, Table]:
    """Return horizons and suns of each photo to learn from, whole and of a part of it."""
    horizons, suns = [], []
    for number, (folder, image, mask) in enumerate(photos(data)):
        if f"{folder}/{image.name}" in judging():
            continue
        pair = read_pair(image, mask)
        picture = np.ascontiguousarray(pair[..., :3])
        sky = corrected(f"{folder}/{image.name}", pair[..., 3])
        height, width = sky.shape
        line = robust_line((sky > 191).astype(np.float32))
        sure = line.confidence >= SURE
        whole = Box(0, 0, height, width, *size_of(sky.shape, AREAS[number % 2]), bool(number % 2))
        row = line.row / height - 0.5 if sure else eyes.taught(picture)[0]
        for box in (whole, _part(height, width, random)):
            part = box.of(picture, cv2.INTER_AREA)
            view, sun = eyes.seen(part)
            there = ((row + 0.5) * height - box.top) / box.height - 0.5
            horizons.append((view, torch.tensor(there), KNOWN_COUNTS if sure else 1.0))
            guess = eyes.taught(part, mirrored=box.mirrored)[1]
            suns.append((sun, torch.from_numpy(guess), 1.0))
    return Table.of(horizons), Table.of(suns)


def of_suns(eyes: Eyes, data: Path) -> Table:
    """Return the suns of labelled photos, seen by cameras that turned away from them."""
    known = [p for p in labels() if p.kind in ("disc", "glow") and not p.test]
    rows = []
    for number, case in enumerate(without_suns(data, known, VIEWS)):
        mirrored = bool(number % 2)
        picture = case.picture[:, ::-1] if mirrored else case.picture
        high, wide = size_of(picture.shape[:2], AREAS[-1])
        _, sun = eyes.seen(cv2.resize(picture, (wide, high), interpolation=cv2.INTER_AREA))
        truth = shares(np.radians(case.sun), mirrored=mirrored)
        rows.append((sun, torch.from_numpy(truth), 1.0))
    return Table.of(rows)


def _part(height: int, width: int, random: Random) -> Box:
    rows, columns = sizes(AREAS[0])[random.integers(len(SHAPES))]
    scale = min(height / rows, width / columns) * random.uniform(LEAST, 1)
    high, wide = int(rows * scale), int(columns * scale)
    top, left = int(random.integers(height - high + 1)), int(random.integers(width - wide + 1))
    return Box(top, left, high, wide, rows, columns, bool(random.integers(2)))


def fit_horizon(head: nn.Sequential, worlds: Table, real: Table) -> None:
    """Train the head of the horizon anew, in place."""

    def loss(seen: Callable[[Table, Tensor], Tensor]) -> Tensor:
        rows = worlds.draw(BATCH)
        view, truth = seen(worlds, rows), worlds.truth[rows]
        found = F.smooth_l1_loss(view[:, :3], truth[:, :3], beta=BETA)
        found = found + 0.1 * F.binary_cross_entropy_with_logits(view[:, 3], truth[:, 3])
        rows = real.draw(2 * BATCH)
        row = seen(real, rows)[:, 0]
        return found + PHOTOS_COUNT * F.smooth_l1_loss(row, real.truth[rows], beta=BETA)

    _fit(head, (worlds, real), NOISE, loss)


def fit_sun(head: nn.Sequential, worlds: Table, guesses: Table, known: Table) -> None:
    """Train the head of the sun anew, in place."""

    def loss(seen: Callable[[Table, Tensor], Tensor]) -> Tensor:
        found = torch.zeros(())
        for table, share in ((worlds, 1.0), (guesses, 1.0), (known, SUNS_COUNT)):
            rows = table.draw(BATCH // 2)
            odds = seen(table, rows).log_softmax(1)
            found = found - share * (table.truth[rows] * odds).sum(1).mean()
        return found

    _fit(head, (worlds, guesses, known), NOISE_OF_SUNS, loss)


def _fit(
    head: nn.Sequential,
    tables: tuple[Table, ...],
    noise: float,
    loss: Callable[[Callable[[Table, Tensor], Tensor]], Tensor],
) -> None:
    together = torch.cat([table.features for table in tables])
    mean, deviation = together.mean(0), together.std(0) + 1e-3
    for layer in head:
        if isinstance(layer, nn.Linear):
            layer.reset_parameters()
    optimise = torch.optim.AdamW(head.parameters(), lr=RATE, weight_decay=DECAY)

    def seen(table: Table, rows: Tensor) -> Tensor:
        x = (table.features[rows] - mean) / deviation
        return head(x + noise * torch.randn_like(x))

    head.train()
    for step in range(STEPS):
        optimise.param_groups[0]["lr"] = RATE * (1 - step / STEPS)
        optimise.zero_grad()
        loss(seen).backward()
        optimise.step()
    head.eval()
    with torch.no_grad():  # the network's features are not normalised
        first = head[0]
        first.bias -= first.weight @ (mean / deviation)
        first.weight /= deviation


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    for name in ("checkpoint", "worlds", "data", "teacher", "out"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    options = parser.parse_args()
    cv2.setNumThreads(1)
    torch.manual_seed(0)
    random = np.random.default_rng(1)
    network = LandNet()
    state = torch.load(options.checkpoint, weights_only=True, map_location="cpu")
    network.load_state_dict(state["average"])
    network.eval()
    eyes = Eyes(network, options.teacher)
    horizons, suns = of_worlds(eyes, Worlds(options.worlds), random)
    rows, guesses = of_photos(eyes, options.data, random)
    fit_horizon(network.view, horizons, rows)
    fit_sun(network.sun, suns, guesses, of_suns(eyes, options.data))
    save(options.out, average=network.state_dict())


if __name__ == "__main__":
    main()
