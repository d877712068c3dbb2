"""Trains the sky network for a given wall-clock time, best on a graphics card.

``python -m training.train --data ../shared/data/train --encoder efficientnet-lite2.pth --rooms
build/rooms --minutes 9 --workers 15 --out build/sky``, then
``… --start build/sky/last.pt --worlds build/worlds --minutes 20 --out build/sky-worlds``

Begins from an encoder that knows ImageNet (``encoder.py``). ``--start`` goes on from a checkpoint
or the shipped file at a tenth of the rate and with its batch statistics as they are, to learn from
rendered worlds or new corrections, too. The learning rate follows elapsed time; running it again
with the same ``--out`` resumes. What is validated and exported is a moving average of the weights.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import cv2
import torch
import torch.nn.functional as F
from torch import Tensor, nn

from training.data import Batches, Pack, typical, validation
from training.loop import Run, batches, device_options, prepare, rate, save
from training.model import SkyNet
from training.restore import restore
from training.suns.water import UNKNOWN
from training.world_samples import WorldSamples

FULL_SIZE = 384
"""The size the network is used at (pixels)."""
STAGES = ((0.45, 320), (1.0, FULL_SIZE))
"""Until which share of the time squares have which size (pixels)."""
STAGES_ON = ((1.0, FULL_SIZE),)
PEAK_RATE, PEAK_RATE_ON = 2e-3, 1.5e-4
KEPT, KEPT_ON = 0.998, 0.995  # of the moving average of the weights, each step
WATER, WATER_COARSE = 0.6, 0.2  # weights of the losses of water


def sky_loss(logits: Tensor, coarse: Tensor, target: Tensor, weight: Tensor) -> Tensor:
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


def water_loss(logits: Tensor, water: Tensor) -> Tensor:
    """Cross-entropy where water is known; ``water`` (N, 1, H, W) is 255, 0 or ``UNKNOWN``.

    ``logits`` may be smaller by a whole factor; then only cells that are known as a whole count.
    """
    known, wet = (water != UNKNOWN).float(), (water > 191).float()
    factor = water.shape[-1] // logits.shape[-1]
    if factor > 1:
        wet, known = F.avg_pool2d(wet, factor), (F.avg_pool2d(known, factor) > 0.99).float()
    entropy = F.binary_cross_entropy_with_logits(logits, wet, reduction="none")
    return (entropy * known).sum() / known.sum().clamp(min=1)


@torch.no_grad()
def validate(network: SkyNet, photos: list[tuple[Tensor, ...]]) -> tuple[float, float, float]:
    """Pooled IoU and share of wrong pixels of the sky, and IoU of water, on the held-out photos."""
    network.eval()
    device = next(network.parameters()).device
    shared = union = wrong = total = wet_shared = wet_union = 0.0
    for image, *labels in photos:
        target, weight, water = (x.to(device) for x in labels)
        logits = network(prepare(image.to(device)))
        sky, truth, known = logits[:, :1] > 0, target > 127, weight > 0
        shared += (sky & truth & known).sum().item()
        union += ((sky | truth) & known).sum().item()
        wrong += ((sky != truth) & known).sum().item()
        total += known.sum().item()
        found, wet, known = logits[:, 1:] > 0, water > 191, water != UNKNOWN
        wet_shared += (found & wet & known).sum().item()
        wet_union += ((found | wet) & known).sum().item()
    return shared / max(union, 1), wrong / max(total, 1), wet_shared / max(wet_union, 1)


class Training:
    """One run: network, moving average, optimiser and clock."""

    def __init__(self, options: argparse.Namespace) -> None:
        self.options, self.going_on = options, options.start is not None
        self.network = SkyNet()
        if self.going_on and options.start.suffix == ".onnx":
            restore(
                self.network, options.start, typical(options.data, options.cache, FULL_SIZE, 96)
            )
        elif self.going_on:
            state = torch.load(options.start, weights_only=True, map_location="cpu")
            self.network.load_state_dict(state["average"])
        elif options.encoder is not None:
            self.network.encoder.load(options.encoder)
        self.network.to(options.device, memory_format=torch.channels_last)
        self.run = Run(
            self.network,
            options.out,
            options.minutes,
            kept=KEPT_ON if self.going_on else KEPT,
            seconds=60 * options.minutes / 8,
            on_checkpoint=self.check,
        )

    def train(self) -> None:
        """Learn in stages until the time is spent."""
        peak = PEAK_RATE_ON if self.going_on else PEAK_RATE
        if self.going_on and self.run.step == 0:  # for means of old and new weights
            save(self.options.out / "at-0.pt", average=self.run.average.state)
        for until, size in STAGES_ON if self.going_on else STAGES:
            if self.run.spent >= until * self.run.limit:
                continue
            source = self.loader(size)
            for share in self.run.shares(until):
                self.learn(next(source))
                self.run.learn(rate(share, peak), 2.0)
        self.run.keep()

    def loader(self, size: int) -> Iterator[tuple[Tensor, ...]]:
        """Endless batches of squares of a size, uint8."""
        o = self.options
        worlds = None if o.worlds is None else WorldSamples(o.worlds, size)
        data = Batches(o.data, o.cache, o.rooms, size, o.batch, o.seed + self.run.step, worlds)
        return batches(data, ahead=2, workers=o.workers)

    def learn(self, batch: tuple[Tensor, ...]) -> None:
        """Add the gradients of one batch (uint8)."""
        image, target, weight, water = (x.to(self.options.device) for x in batch)
        self.network.train()
        if self.going_on:
            for layer in self.network.modules():
                if isinstance(layer, nn.BatchNorm2d):
                    layer.eval()
        kind = torch.device(self.options.device).type
        with torch.autocast(kind, torch.bfloat16, enabled=self.options.bfloat16):
            logits, coarse = (x.float() for x in self.network.features(prepare(image)))
        parts = {
            "sky": sky_loss(logits[:, :1], coarse[:, :1], target.float() / 255, weight / 85),
            "water": WATER * water_loss(logits[:, 1:], water)
            + WATER_COARSE * water_loss(coarse[:, 1:], water),
        }
        sum(parts.values()).backward()
        self.run.count(parts)

    def check(self) -> None:
        """Measure the averaged weights on the held-out photos, print, and keep them by name."""
        judge = SkyNet().to(self.options.device)
        judge.load_state_dict(self.run.average.state)
        photos = validation(self.options.data, self.options.cache, FULL_SIZE)
        sky, wrong, water = validate(judge, photos)
        minutes = self.run.spent / 60
        print(
            f"{minutes:.1f} min, step {self.run.step}: sky {sky:.4f} ({wrong:.4f} wrong), "
            f"water {water:.4f}",
            flush=True,
        )
        # For means, see export.py.
        save(self.options.out / f"at-{minutes:.0f}.pt", average=self.run.average.state)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = parser.add_argument
    add("--data", type=Path, required=True, help="folder that holds camvid/, landscape-pseudo/ …")
    add("--out", type=Path, default=Path("build/sky"), help="checkpoints")
    add("--cache", type=Path, help="packed photos (default: OUT/cache)")
    add("--encoder", type=Path, help="EfficientNet-Lite2's weights on ImageNet (.pth)")
    add("--start", type=Path, help="a checkpoint or an .onnx file to go on from")
    add("--rooms", type=Path, help="folder of interior panoramas (*.hdr, see rooms.py)")
    add("--worlds", type=Path, help="folder of rendered worlds (*.npz, see worlds/make.py)")
    add("--minutes", type=float, default=9)
    device_options(parser, batch=64, workers=15)
    add("--seed", type=int, default=1)
    options = parser.parse_args()
    options.cache = options.cache or options.out / "cache"
    options.out.mkdir(parents=True, exist_ok=True)
    torch.manual_seed(options.seed)
    cv2.setNumThreads(0)
    Pack(options.data, options.cache)  # built once, before the processes share it
    Training(options).train()


if __name__ == "__main__":
    main()
