"""Trains the sky network for a given wall-clock time on a CPU.

``python -m training.train --data ../shared/data/train --minutes 100 --out build/sky``

Most of the time goes to small squares, the last part to 384 px, the size the network is used at.
The learning rate follows elapsed time, so that a slower machine gets fewer steps rather than an
unfinished schedule. Two processes of one thread average their gradients: on busy cores that is
three times faster than one process of two threads, which spin while they wait for each other.
Running it again with the same ``--out`` resumes. What is validated and exported is an exponential
moving average of the weights. ``--start sunwidget/analysis/models/sky.onnx`` goes on from a shipped
file, at half the learning rate and without the smallest squares.
"""

from __future__ import annotations

import argparse
import csv
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import torch
import torch.nn.functional as F
from torch import Tensor, distributed, multiprocessing, nn
from torch.utils.data import DataLoader, IterableDataset

from training.data import Batches, Pack, typical, validation
from training.model import SkyNet
from training.restore import restore


@dataclass(frozen=True)
class Stage:
    """Up to ``until`` (share of the time): ``batch`` squares of ``size`` pixels per process."""

    until: float
    size: int
    batch: int


STAGES = (Stage(0.5, 128, 32), Stage(0.86, 192, 20), Stage(1.01, 384, 6))
STAGES_ON = (Stage(0.55, 192, 24), Stage(0.85, 256, 14), Stage(1.01, 384, 7))
"""The schedule of a training that goes on from a shipped file."""
PEAK_RATE = 2e-3
PEAK_RATE_ON = 1e-3
WARM_UP = 0.02
CHECK_SECONDS = 540
FULL_SIZE = 384
"""The size the network is used at (pixels)."""


class Average:
    """Exponential moving average of weights and batch statistics."""

    def __init__(self, network: SkyNet, decay: float = 0.995) -> None:
        self.decay, self.steps = decay, 0
        self.state = {k: v.detach().clone() for k, v in network.state_dict().items()}

    @torch.no_grad()
    def update(self, network: SkyNet) -> None:
        self.steps += 1
        decay = min(self.decay, (1 + self.steps) / (10 + self.steps))
        for key, value in network.state_dict().items():
            if value.dtype.is_floating_point:
                self.state[key].lerp_(value, 1 - decay)
            else:
                self.state[key].copy_(value)


def rate(share: float, peak: float) -> float:
    """Learning rate at a share of the time in [0, 1]: linear warm-up, then linearly down to 1 %."""
    if share < WARM_UP:
        return peak * max(share / WARM_UP, 0.02)
    return peak * max(0.01, (1 - share) / (1 - WARM_UP))


def loss_function(logits: Tensor, coarse: Tensor, target: Tensor, weight: Tensor) -> Tensor:
    """Weighted cross-entropy, soft Jaccard per photo, and deep supervision at 1/8; all float32.

    ``target`` ``(N, 1, H, W)`` in [0, 1]; ``weight`` alike, 0 where nothing is known, 1 inside, up
    to 3 along edges.
    """
    valid = (weight > 0).float()
    entropy = (
        F.binary_cross_entropy_with_logits(logits, target, reduction="none") * weight
    ).sum() / weight.sum()
    probability = torch.sigmoid(logits) * valid
    shared = (probability * target).sum((1, 2, 3))
    union = (probability + target * valid).sum((1, 2, 3)) - shared
    smooth = (
        0.01 * target[0].numel()
    )  # a few stray pixels in a photo without sky cost little, a wall costs all
    jaccard = (1 - (shared + smooth) / (union + smooth)).mean()
    small, known = F.avg_pool2d(target, 8), F.avg_pool2d(valid, 8)
    deep = (F.binary_cross_entropy_with_logits(coarse, small, reduction="none") * known).mean()
    return entropy + 0.5 * jaccard + 0.3 * deep


@torch.no_grad()
def validate(network: SkyNet, batches: list[tuple[Tensor, ...]]) -> tuple[float, float]:
    """Pooled IoU and share of wrong pixels on the held-out photos."""
    network.eval()
    shared = union = wrong = total = 0.0
    for image, target, weight in batches:
        logits = network(prepare(image))
        sky, truth, known = logits > 0, target > 127, weight > 0
        shared += (sky & truth & known).sum().item()
        union += ((sky | truth) & known).sum().item()
        wrong += ((sky != truth) & known).sum().item()
        total += known.sum().item()
    return shared / max(union, 1), wrong / max(total, 1)


@torch.no_grad()
def recalibrate(network: SkyNet, batches: list[tuple[Tensor, ...]]) -> None:
    """Measures the batch statistics afresh, at full size and for exactly these weights.

    Those gathered in training belong to other sizes, other weights and augmented photos (Wu and
    Johnson 2021, "Rethinking Batch in BatchNorm").
    """
    layers = [m for m in network.modules() if isinstance(m, nn.BatchNorm2d)]
    for layer in layers:
        layer.reset_running_stats()
        layer.momentum = None  # plain mean over the batches
    network.train()
    for image, *_ in batches:
        network(prepare(image))


def prepare(image: Tensor) -> Tensor:
    """uint8 -> float32 in [0, 1], channels last in memory."""
    return image.float().div_(255).contiguous(memory_format=torch.channels_last)


def loader(options: argparse.Namespace, stage: Stage, seed: int) -> Iterator[Any]:
    data = Batches(options.data, options.cache, options.rooms, stage.size, stage.batch, seed)
    return batches(data, ahead=6)


def batches(dataset: IterableDataset, ahead: int = 4) -> Iterator[Any]:
    """Return batches that another process makes, so many ahead."""
    return iter(
        DataLoader(
            dataset,
            batch_size=None,
            num_workers=1,
            prefetch_factor=ahead,
            multiprocessing_context="spawn",  # OpenCV's threads do not survive a fork
        )
    )


def optimiser(network: nn.Module) -> torch.optim.AdamW:
    """AdamW; weight decay on convolution kernels only."""
    kernels = [p for p in network.parameters() if p.ndim > 1]
    others = [p for p in network.parameters() if p.ndim <= 1]
    groups = [{"params": kernels, "weight_decay": 0.02}, {"params": others, "weight_decay": 0.0}]
    return torch.optim.AdamW(groups, lr=PEAK_RATE, betas=(0.9, 0.99))


def save(path: Path, **state: object) -> None:
    """Writes a checkpoint whole or not at all."""
    torch.save(state, path.with_suffix(".part"))
    path.with_suffix(".part").replace(path)


def agree(value: float) -> float:
    """The first process' value, in all of them."""
    shared = torch.tensor([value], dtype=torch.float64)
    distributed.broadcast(shared, 0)
    return shared.item()


def average_gradients(network: SkyNet, processes: int) -> None:
    """Replaces every gradient by its mean over the processes."""
    gradients = [p.grad for p in network.parameters() if p.grad is not None]
    flat = torch.cat([g.flatten() for g in gradients])
    distributed.all_reduce(flat)
    for gradient, mean in zip(gradients, flat.split([g.numel() for g in gradients]), strict=True):
        gradient.copy_((mean / processes).view_as(gradient))


class Training:
    """One of the processes that train together; the first one measures, logs and saves."""

    def __init__(self, rank: int, options: argparse.Namespace) -> None:
        self.rank, self.options = rank, options
        self.network = SkyNet().to(memory_format=torch.channels_last)
        self.average, self.optimise = Average(self.network), optimiser(self.network)
        self.spent, self.step, self.losses = 0.0, 0, []
        self.checkpoint = options.out / "last.pt"
        on = options.start is not None
        self.stages, self.peak = (STAGES_ON, PEAK_RATE_ON) if on else (STAGES, PEAK_RATE)
        if self.checkpoint.exists():
            self.resume()
        elif on:
            restore(self.network, options.start, typical(options.data, options.cache, 192, 96))
            self.average = Average(self.network)

    def resume(self) -> None:
        state = torch.load(self.checkpoint, weights_only=True)
        self.network.load_state_dict(state["network"])
        self.optimise.load_state_dict(state["optimiser"])
        self.average.state, self.average.steps = state["average"], state["step"]
        self.spent, self.step = state["spent"], state["step"]

    def run(self) -> None:
        """Trains until the time is spent."""
        start = checked = time.monotonic()
        before, limit = self.spent, self.options.minutes * 60
        stage = None
        while (share := self.spent / limit) < 1:
            now = next(s for s in self.stages if share < s.until)
            if now is not stage:
                seed = self.options.seed + 1000 * self.rank + self.step
                stage, batches = now, loader(self.options, now, seed)
            self.learn(*next(batches), rate(share, self.peak))
            self.spent = agree(before + time.monotonic() - start)
            if self.rank:
                continue
            if self.step % 100 == 0:
                recent = np.mean(self.losses[-100:])
                print(f"step {self.step} {self.spent / 60:.1f} min loss {recent:.4f}", flush=True)
            if time.monotonic() - checked > CHECK_SECONDS:
                self.check(stage.size, rate(share, self.peak))
                checked = time.monotonic()
        if self.rank == 0:
            self.finish()

    def learn(self, image: Tensor, target: Tensor, weight: Tensor, learning_rate: float) -> None:
        """One step on one batch (uint8) per process."""
        for group in self.optimise.param_groups:
            group["lr"] = learning_rate
        self.network.train()
        with torch.autocast("cpu", torch.bfloat16, enabled=self.options.bfloat16):
            logits, coarse = self.network.features(prepare(image))
        truth, importance = target.float() / 255, weight.float() / 85
        loss = loss_function(logits.float(), coarse.float(), truth, importance)
        self.optimise.zero_grad(set_to_none=True)
        loss.backward()
        average_gradients(self.network, self.options.processes)
        nn.utils.clip_grad_norm_(self.network.parameters(), 2.0)
        self.optimise.step()
        if self.rank == 0:
            self.average.update(self.network)
        self.step += 1
        self.losses.append(loss.item())

    def finish(self) -> None:
        """Keeps the best of three sets of weights on the held-out photos, and saves it.

        The average, the average with batch statistics measured afresh, and the last weights: after
        long training at full size the last are best, after a short one the second.
        """
        afresh = SkyNet().to(memory_format=torch.channels_last)
        afresh.load_state_dict(self.average.state)
        recalibrate(afresh, typical(self.options.data, self.options.cache, FULL_SIZE, 300))
        photos = validation(self.options.data, self.options.cache, FULL_SIZE)
        scores = []
        for state in (self.average.state, afresh.state_dict(), self.network.state_dict()):
            judge = SkyNet().to(memory_format=torch.channels_last)
            judge.load_state_dict(state)
            scores.append((validate(judge, photos)[0], judge.state_dict()))
        self.average.state = max(scores, key=lambda s: s[0])[1]
        self.check(FULL_SIZE, rate(1, self.peak))

    def check(self, size: int, learning_rate: float) -> None:
        """Measures the averaged weights on the held-out photos, logs, saves."""
        judge = SkyNet().to(memory_format=torch.channels_last)
        judge.load_state_dict(self.average.state)
        iou, mcr = validate(judge, validation(self.options.data, self.options.cache, FULL_SIZE))
        row = (
            self.spent / 60,
            self.step,
            size,
            learning_rate,
            np.mean(self.losses or [np.nan]),
            iou,
            mcr,
        )
        log = self.options.out / "log.csv"
        if not log.exists():
            log.write_text("minutes,step,size,rate,loss,iou,mcr\n", encoding="utf-8")
        with log.open("a", encoding="utf-8", newline="") as file:
            csv.writer(file).writerow(f"{v:.5g}" for v in row)
        print(" ".join(f"{v:.5g}" for v in row), flush=True)
        state = {
            "network": self.network.state_dict(),
            "optimiser": self.optimise.state_dict(),
            "average": self.average.state,
            "spent": self.spent,
            "step": self.step,
        }
        save(self.checkpoint, **state)
        save(self.options.out / f"at-{self.spent / 60:.0f}.pt", **state)  # for means, see export.py
        self.losses = []


def train(rank: int, options: argparse.Namespace) -> None:
    """Body of one process."""
    torch.manual_seed(options.seed)
    torch.set_num_threads(1)
    cv2.setNumThreads(0)
    meeting = f"file://{(options.out / 'meeting').resolve()}"
    distributed.init_process_group(
        "gloo", init_method=meeting, rank=rank, world_size=options.processes
    )
    try:
        Training(rank, options).run()
    finally:
        distributed.destroy_process_group()


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = parser.add_argument
    add("--data", type=Path, required=True, help="folder that holds camvid/, landscape-pseudo/ …")
    add("--out", type=Path, default=Path("build/sky"), help="checkpoints and log.csv")
    add("--cache", type=Path, help="packed photos (default: OUT/cache)")
    add("--minutes", type=float, default=100)
    add("--seed", type=int, default=1)
    add("--start", type=Path, help="a shipped sky.onnx whose weights to go on from")
    add("--rooms", type=Path, help="folder of interior panoramas (*.hdr, see rooms.py)")
    add("--bfloat16", action="store_true", help="for CPUs with matrix units; slow elsewhere")
    add("--processes", type=int, default=2, help="that train together, one core each")
    options = parser.parse_args()
    options.cache = options.cache or options.out / "cache"
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / "meeting").unlink(missing_ok=True)
    Pack(options.data, options.cache)  # built once, before the processes share it
    multiprocessing.spawn(train, (options,), nprocs=options.processes)


if __name__ == "__main__":
    main()
