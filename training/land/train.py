"""Trains LandNet for a given wall-clock time, on worlds and real photos together.

``python -m training.land.train --worlds build/worlds --data ../shared/data/train --minutes 60
--out build/land``

Begins with what ``--start`` knows: the trunk of ``sky.onnx``, all of ``land.onnx``, or a
checkpoint; running it again with the same ``--out`` resumes. The learning rate follows elapsed
time. Worlds that are made meanwhile are learned from as they come. What is exported is a moving
average of the weights.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from pathlib import Path

import torch
import torch.nn.functional as F
from torch import Tensor

from training.data import typical
from training.land.data import UNKNOWN, WATER, Batch, PhotoBatches, WorldBatches
from training.land.model import LandNet, losses, sun_basis
from training.loop import Run, batches, begun, device_options, prepare, put, rate
from training.restore import restore

TRUNK = Path("sunwidget/analysis/models/sky.onnx")
AREAS = ((0.0, 62_000), (0.5, 92_000))
"""From which share of the time on: pixels of a picture."""
PEAK_RATE = 1e-3
KEPT = 0.9985  # of the moving average of the weights, each step
PHOTOS_EVERY = 3  # steps: worlds have more labels, and the trunk knows photos
TEACHES_FROM = 250  # steps, from which on the moving average is worth listening to
MIRRORED = (
    sun_basis(torch.tensor([-0.3, 0.5, 0.8])) * sun_basis(torch.tensor([0.3, 0.5, 0.8]))
).sign()
"""How the functions of a sun change when left and right are exchanged."""


def photo_losses(out: dict[str, Tensor], batch: Batch) -> dict[str, Tensor]:
    """Return the losses of a batch of real photos: what is sky, and what is water."""
    sky, water = batch["sky"], batch["water"]
    known = (sky != UNKNOWN).float()
    entropy = F.binary_cross_entropy_with_logits(out["sky"], sky / 255, reduction="none")
    small_sky = F.avg_pool2d(sky / 255, 2)
    sure = (F.avg_pool2d(known, 2) > 0.99) * ((small_sky < 0.02) | (small_sky > 0.98))
    matter = out["matter"].log_softmax(1)
    clear, rest = matter[:, :1], _log_rest(matter, 0)
    kind = -torch.where(small_sky > 0.5, clear, rest) * sure
    wet = F.max_pool2d(water, 2)
    labeled = ((wet == 255) & (-F.max_pool2d(-water, 2) == 255)) | (wet == 0)
    lake = (
        -torch.where(wet == 255, matter[:, WATER : WATER + 1], _log_rest(matter, WATER)) * labeled
    )
    return {
        "sky": (entropy * known).sum() / known.sum().clamp(min=1),
        "matter": 0.5 * kind.sum() / sure.sum().clamp(min=1),
        "water": 0.7 * lake.sum() / labeled.sum().clamp(min=1),
    }


def _log_rest(matter: Tensor, index: int) -> Tensor:
    """Return the log of what is left beside one class of log shares (N, C, h, w)."""
    others = torch.cat([matter[:, :index], matter[:, index + 1 :]], 1)
    return others.logsumexp(1, keepdim=True)


def consistency(student: dict[str, Tensor], teacher: dict[str, Tensor]) -> Tensor:
    """Return how unlike two views of the same photos are; ``teacher`` saw them mirrored."""
    back = {k: v.flip(3) for k, v in teacher.items() if v.ndim == 4}
    back["normal"] = torch.cat([-back["normal"][:, :1], back["normal"][:, 1:]], 1)
    solid = 1 - back["matter"].softmax(1)[:, :1]
    level = (student["depth"] - back["depth"]) * solid
    level = level - level.sum((1, 2, 3), keepdim=True) / solid.sum((1, 2, 3), keepdim=True).clamp(
        min=1
    )
    lit = F.binary_cross_entropy_with_logits(student["sunlit"], back["sunlit"].sigmoid())
    normal = (1 - (student["normal"] * back["normal"]).sum(1, keepdim=True)) * solid
    turned = back["transfer"] * MIRRORED.to(solid.device).view(1, -1, 1, 1)
    share = (student["transfer"] - turned).abs() * solid
    return lit + normal.mean() + 0.2 * (level.abs() * solid).mean() + share.mean()


def take_over(network: LandNet, start: Path, data: Path, cache: Path) -> None:
    """Take over what a shipped file or a checkpoint knows; heads that it lacks begin anew."""
    if start.suffix == ".onnx":
        cache.mkdir(parents=True, exist_ok=True)
        restore(network, start, typical(data, cache, 192, 96))
    else:
        state = torch.load(start, weights_only=True, map_location="cpu")["average"]
        network.load_state_dict(state, strict=False)


class Training:
    """One run: network, moving average, optimiser and clock."""

    def __init__(self, options: argparse.Namespace) -> None:
        self.options = options
        self.network = LandNet()
        if not begun(options.out):
            take_over(self.network, options.start, options.data, options.cache)
        self.network.to(options.device, memory_format=torch.channels_last)
        self.run = Run(
            self.network, options.out, options.minutes, kept=KEPT, on_checkpoint=self._report
        )
        self.teacher = LandNet().to(options.device).eval()
        self.kind = torch.device(options.device).type
        self.sums: dict[str, Tensor] = {}

    def train(self) -> None:
        """Learn in stages until the time is spent."""
        for i, (_, area) in enumerate(AREAS):
            end = AREAS[i + 1][0] if i + 1 < len(AREAS) else 1.0
            if self.run.spent < end * self.run.limit:
                self._stage(area, end)
        self.run.keep()

    def _stage(self, area: int, end: float) -> None:
        o, seed = self.options, self.run.step + 1
        worlds = batches(WorldBatches(o.worlds, area, o.batch, seed), workers=o.workers)
        photos = batches(PhotoBatches(o.data, area, o.batch, seed), workers=-(-o.workers // 4))
        for share in self.run.shares(end):
            self._learn(put(next(worlds), o.device), photos, rate(share, o.rate))

    def _learn(self, world: Batch, photos: Iterator[Batch], speed: float) -> None:
        self.network.train()
        found = losses(self._maps(self.network, prepare(world["image"])), world)
        sum(found.values()).backward()
        self._count("", found)
        if self.run.step % PHOTOS_EVERY == 0:
            self._learn_from_photos(put(next(photos), self.options.device))
        self.run.learn(speed, 5.0)

    def _maps(self, network: LandNet, image: Tensor) -> dict[str, Tensor]:
        with torch.autocast(self.kind, torch.bfloat16, enabled=self.options.bfloat16):
            return {name: value.float() for name, value in network.maps(image).items()}

    def _learn_from_photos(self, photo: Batch) -> None:
        image = prepare(photo["image"])
        out = self._maps(self.network, image)
        found = photo_losses(out, photo)
        if self.run.step > TEACHES_FROM:
            self.teacher.load_state_dict(self.run.average.state)
            with torch.no_grad():
                seen = self._maps(self.teacher, image.flip(3))
            found["alike"] = consistency(out, seen)
        sum(found.values()).backward()
        self._count("photo_", found)

    def _count(self, prefix: str, found: dict[str, Tensor]) -> None:
        for name, value in found.items():
            key, value = prefix + name, value.detach()
            self.sums[key] = 0.98 * self.sums.get(key, value) + 0.02 * value

    def _report(self) -> None:
        line = {k: round(v.item(), 3) for k, v in self.sums.items()}
        print(
            f"{self.run.spent / 60:.1f} min, step {self.run.step}: {json.dumps(line)}", flush=True
        )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--worlds", type=Path, required=True)
    parser.add_argument("--data", type=Path, required=True)
    parser.add_argument("--cache", type=Path, default=Path("build/pack"))
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--start", type=Path, default=TRUNK)
    parser.add_argument("--rate", type=float, default=PEAK_RATE)
    parser.add_argument("--threads", type=int, default=1)
    device_options(parser, batch=6)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    torch.set_num_threads(options.threads)
    torch.manual_seed(1)
    Training(options).train()


if __name__ == "__main__":
    main()
