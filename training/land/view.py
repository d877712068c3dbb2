"""Fits LandNet's head of the horizon once more, on worlds and on real photos.

``python -m training.land.view --checkpoint build/land/last.pt --worlds build/worlds/train --data
../shared/data/train --teacher sunwidget/analysis/models/land.onnx --out build/land/view.pt``

Worlds say where the horizon is, but look like worlds. A photo with a straight skyline says it, too
(``robust_line``), for every part of it; for other photos an earlier network is asked. The trunk
stays as it is, so its features are computed once.
"""

from __future__ import annotations

import argparse
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
from training.land.data import SHAPES, Random, Worlds, photos, sample, size_of, sizes
from training.land.model import LandNet
from training.land.photograph import Box
from training.loop import save
from training.sky_corrections import corrected

AREAS = (62_000, 92_000)  # pixels of a picture, in turn
EACH_WORLD = 5  # pictures
LEAST = 0.55  # of a photo's sides: its smallest part
SURE = 0.7  # confidence from which a skyline is taken for the horizon
KNOWN_COUNTS = 4.0  # times as much as the teacher's word
STEPS, BATCH, RATE, DECAY, NOISE, BETA = 4000, 256, 1e-3, 1.0, 0.05, 0.05
PHOTOS_COUNT = 2 / 3  # of the loss of worlds


@dataclass
class Table:
    """Features, what they should say, and how much each row counts."""

    features: Tensor  # (n, k)
    truth: Tensor  # (n, 4) of worlds, (n,) of photos: rows of horizons
    weight: Tensor  # (n,)


@torch.no_grad()
def features_of(network: LandNet, picture: np.ndarray) -> Tensor:
    """Return what the head of the horizon sees of a picture (3, h, w) uint8."""
    return network.seen(torch.from_numpy(picture[None].copy()).float() / 255)[0]


def of_worlds(network: LandNet, worlds: Worlds, random: Random) -> Table:
    """Return features and truth of some pictures of each world."""
    rows = []
    for i in range(EACH_WORLD * len(worlds)):
        shapes = sizes(AREAS[i % len(AREAS)])
        one = sample(worlds[i % len(worlds)], *shapes[random.integers(len(SHAPES))], random)
        rows.append((features_of(network, one["image"]), torch.from_numpy(np.float32(one["view"]))))
    found, truth = (torch.stack(part) for part in zip(*rows, strict=True))
    return Table(found, truth, torch.ones(len(rows)))


def of_photos(network: LandNet, data: Path, teacher: Path, random: Random) -> Table:
    """Return features and horizons of each photo to learn from, whole and of a part of it."""
    session = onnxruntime.InferenceSession(teacher, providers=["CPUExecutionProvider"])
    rows = []
    for number, (folder, image, mask) in enumerate(photos(data)):
        pair = read_pair(image, mask)
        picture = np.ascontiguousarray(pair[..., :3])
        sky = corrected(f"{folder}/{image.name}", pair[..., 3])
        height, width = sky.shape
        line = robust_line((sky > 191).astype(np.float32))
        sure = line.confidence >= SURE
        whole = Box(0, 0, height, width, *size_of(sky.shape, AREAS[number % 2]), bool(number % 2))
        row = line.row / height - 0.5 if sure else _taught(session, picture)
        for box in (whole, _part(height, width, random)):
            seen = features_of(network, box.of(picture, cv2.INTER_AREA).transpose(2, 0, 1))
            there = ((row + 0.5) * height - box.top) / box.height - 0.5
            rows.append((seen, torch.tensor(there), torch.tensor(KNOWN_COUNTS if sure else 1.0)))
    return Table(*(torch.stack(part).float() for part in zip(*rows, strict=True)))


def _part(height: int, width: int, random: Random) -> Box:
    rows, columns = sizes(AREAS[0])[random.integers(len(SHAPES))]
    scale = min(height / rows, width / columns) * random.uniform(LEAST, 1)
    high, wide = int(rows * scale), int(columns * scale)
    top, left = int(random.integers(height - high + 1)), int(random.integers(width - wide + 1))
    return Box(top, left, high, wide, rows, columns, bool(random.integers(2)))


def _taught(session: onnxruntime.InferenceSession, picture: np.ndarray) -> float:
    """Return the row of the horizon from the middle down, in heights, by another network."""
    rows, columns = size_of(picture.shape[:2], AREAS[-1])
    image = cv2.resize(picture, (columns, rows), interpolation=cv2.INTER_AREA)
    image = image.transpose(2, 0, 1)[None].astype(np.float32) / 255
    return float(session.run(["view"], {"image": image})[0][0, 0])


def fit(head: nn.Sequential, worlds: Table, real: Table) -> None:
    """Train the head anew, in place."""
    together = torch.cat([worlds.features, real.features])
    mean, deviation = together.mean(0), together.std(0) + 1e-3
    optimise = torch.optim.AdamW(head.parameters(), lr=RATE, weight_decay=DECAY)

    def seen(table: Table, rows: Tensor) -> Tensor:
        x = (table.features[rows] - mean) / deviation
        return head(x + NOISE * torch.randn_like(x))

    head.train()
    for step in range(STEPS):
        optimise.param_groups[0]["lr"] = RATE * (1 - step / STEPS)
        rows = torch.randint(len(worlds.truth), (BATCH,))
        view, truth = seen(worlds, rows), worlds.truth[rows]
        loss = F.smooth_l1_loss(view[:, :3], truth[:, :3], beta=BETA)
        loss = loss + 0.1 * F.binary_cross_entropy_with_logits(view[:, 3], truth[:, 3])
        rows = torch.multinomial(real.weight, 2 * BATCH, replacement=True)
        row = seen(real, rows)[:, 0]
        loss = loss + PHOTOS_COUNT * F.smooth_l1_loss(row, real.truth[rows], beta=BETA)
        optimise.zero_grad()
        loss.backward()
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
    worlds = of_worlds(network, Worlds(options.worlds), random)
    real = of_photos(network, options.data, options.teacher, random)
    for layer in network.view:
        if isinstance(layer, nn.Linear):
            layer.reset_parameters()
    fit(network.view, worlds, real)
    save(options.out, average=network.state_dict())


if __name__ == "__main__":
    main()
