"""Trains the sky network for a given wall-clock time on a CPU.

``python -m training.train --data ../shared/data/train --minutes 100 --out build/sky``

Most of the time goes to small squares, the last part to 384 px, the size the network is used at. The learning rate is
a cosine of elapsed time, so that a slower machine gets fewer steps rather than an unfinished schedule. Running it
again with the same ``--out`` resumes. What is validated and exported is an exponential moving average of the weights.
"""

from __future__ import annotations

import argparse
import csv
import math
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import torch
import torch.nn.functional as F
from torch import Tensor, nn
from torch.utils.data import DataLoader

from training.data import Batches, validation
from training.model import SkyNet


@dataclass(frozen=True)
class Stage:
    """Up to ``until`` (share of the time) train on squares of ``size`` pixels, ``batch`` at a time."""

    until: float
    size: int
    batch: int


STAGES = (Stage(0.55, 192, 32), Stage(0.82, 256, 20), Stage(1.01, 384, 10))
PEAK_RATE = 2e-3
WARM_UP = 0.02
CHECK_SECONDS = 420


class Average:
    """Exponential moving average of weights and batch statistics."""

    def __init__(self, network: SkyNet, decay: float = 0.998) -> None:
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


def rate(share: float) -> float:
    """Learning rate at a share of the time in [0, 1]: linear warm-up, then a cosine down to 1 %."""
    if share < WARM_UP:
        return PEAK_RATE * max(share / WARM_UP, 0.02)
    fall = min(1.0, (share - WARM_UP) / (1 - WARM_UP))
    return PEAK_RATE * (0.01 + 0.99 * 0.5 * (1 + math.cos(math.pi * fall)))


def loss_function(logits: Tensor, coarse: Tensor, target: Tensor, weight: Tensor) -> Tensor:
    """Weighted cross-entropy, soft Jaccard per photo, and deep supervision at 1/8; all float32.

    ``target`` ``(N, 1, H, W)`` in [0, 1]; ``weight`` alike, 0 where nothing is known, 1 inside, 3 along edges.
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
        with torch.autocast("cpu", torch.bfloat16):
            logits = network(prepare(image))
        sky, truth, known = logits > 0, target > 127, weight > 0
        shared += (sky & truth & known).sum().item()
        union += ((sky | truth) & known).sum().item()
        wrong += ((sky != truth) & known).sum().item()
        total += known.sum().item()
    return shared / max(union, 1), wrong / max(total, 1)


def prepare(image: Tensor) -> Tensor:
    """uint8 -> float32 in [0, 1], channels last in memory."""
    return image.float().div_(255).contiguous(memory_format=torch.channels_last)


def loader(
    options: argparse.Namespace, stage: Stage, seed: int
) -> Iterator[tuple[Tensor, Tensor, Tensor]]:
    batches = Batches(options.data, options.cache, stage.size, stage.batch, seed)
    start = "spawn" if options.workers else None  # OpenCV threads do not survive a fork
    ahead = 6 if options.workers else None
    return iter(
        DataLoader(
            batches,
            batch_size=None,
            num_workers=options.workers,
            prefetch_factor=ahead,
            multiprocessing_context=start,
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


def train(options: argparse.Namespace) -> None:
    torch.manual_seed(options.seed)
    torch.set_num_threads(options.threads)
    options.out.mkdir(parents=True, exist_ok=True)
    network = SkyNet().to(memory_format=torch.channels_last)
    average, optimise = Average(network), optimiser(network)
    spent, step = 0.0, 0
    checkpoint = options.out / "last.pt"
    if checkpoint.exists():
        state = torch.load(checkpoint, weights_only=True)
        network.load_state_dict(state["network"])
        optimise.load_state_dict(state["optimiser"])
        average.state, average.steps = state["average"], state["step"]
        spent, step = state["spent"], state["step"]
    start = time.monotonic() - spent
    limit = options.minutes * 60
    photos = validation(options.data, options.cache, 384)
    judge = SkyNet().to(memory_format=torch.channels_last)
    log = options.out / "log.csv"
    if not log.exists():
        log.write_text("minutes,step,size,rate,loss,iou,mcr\n", encoding="utf-8")
    stage: Stage | None = None
    checked, losses = time.monotonic(), []
    while (spent := time.monotonic() - start) < limit:
        share = spent / limit
        now = next(s for s in STAGES if share < s.until)
        if now is not stage:
            stage, batches = now, loader(options, now, options.seed + step)
        image, target, weight = next(batches)
        for group in optimise.param_groups:
            group["lr"] = rate(share)
        network.train()
        with torch.autocast("cpu", torch.bfloat16):
            logits, coarse = network.features(prepare(image))
        loss = loss_function(
            logits.float(), coarse.float(), target.float() / 255, weight.float() / 85
        )
        optimise.zero_grad(set_to_none=True)
        loss.backward()
        nn.utils.clip_grad_norm_(network.parameters(), 2.0)
        optimise.step()
        average.update(network)
        step += 1
        losses.append(loss.item())
        if step % 100 == 0:
            print(
                f"step {step} {spent / 60:.1f} min loss {sum(losses[-100:]) / len(losses[-100:]):.4f}",
                flush=True,
            )
        ended = time.monotonic() - start >= limit
        if ended or time.monotonic() - checked > CHECK_SECONDS:
            judge.load_state_dict(average.state)
            iou, mcr = validate(judge, photos)
            row = (spent / 60, step, stage.size, rate(share), sum(losses) / len(losses), iou, mcr)
            with log.open("a", encoding="utf-8", newline="") as file:
                csv.writer(file).writerow(f"{v:.5g}" for v in row)
            print(" ".join(f"{v:.5g}" for v in row), flush=True)
            state = {"network": network.state_dict(), "optimiser": optimise.state_dict()}
            save(
                checkpoint,
                **state,
                average=average.state,
                spent=time.monotonic() - start,
                step=step,
            )
            checked, losses = time.monotonic(), []


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--data", type=Path, required=True, help="folder that holds camvid/, landscape-pseudo/ …"
    )
    parser.add_argument(
        "--out", type=Path, default=Path("build/sky"), help="checkpoints and log.csv"
    )
    parser.add_argument("--cache", type=Path, help="packed photos (default: OUT/cache)")
    parser.add_argument("--minutes", type=float, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    options.cache = options.cache or options.out / "cache"
    train(options)


if __name__ == "__main__":
    main()
