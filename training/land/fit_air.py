"""Fits LandNet's head of the air's light alone; everything else stays as it is.

``python -m training.land.fit_air --start sunwidget/analysis/models/land.onnx --worlds
build/worlds/train --data ../shared/data/train --out build/land/air.pt``

Worlds in drawn air say it exactly, photos with outlined haze (``haze.py``) look as photos do. The
trunk's features are computed once, so this takes minutes on two cores. ``training.land.export``
writes the result.
"""

from __future__ import annotations

import argparse
import dataclasses
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np
import torch
import torch.nn.functional as F
from torch import Tensor

from training.land import photograph
from training.land.data import Random, Worlds, outlined, sample, size_of
from training.land.export import AREA
from training.land.model import LandNet, air_loss
from training.land.train import take_over
from training.loop import save

SHAPES = ((2, 3), (3, 4), (1, 1), (3, 2))  # rows to columns
EACH_WORLD, EACH_PHOTO = 15, 10  # pictures
PHOTOS = 0.4  # of the batches
STEPS, BATCH, RATE, DECAY = 2500, 8, 2e-3, 0.01


class Pictures(NamedTuple):
    """Pictures of one size: features (n, 64, h/2, w/2), ``air`` and ``solid`` (n, 1, h, w)."""

    features: Tensor
    air: Tensor
    solid: Tensor


@torch.no_grad()
def look(network: LandNet, worlds: Worlds, random: Random) -> list[Pictures]:
    """Return pictures of all worlds, by size."""
    found: dict[tuple[int, int], list[tuple[Tensor, Tensor, Tensor]]] = defaultdict(list)
    for i in range(EACH_WORLD * len(worlds)):
        size = size_of(SHAPES[random.integers(len(SHAPES))], AREA)
        one = sample(worlds[i % len(worlds)], *size, random)
        seen = network.fine(torch.from_numpy(one["image"][None].copy()).float() / 255)[0]
        truth = (torch.from_numpy(one[key].astype(np.float32)).half() for key in ("air", "solid"))
        found[size].append((seen.half(), *truth))
    return [Pictures(*map(torch.stack, zip(*rows, strict=True))) for rows in found.values()]


@torch.no_grad()
def look_at_photos(network: LandNet, data: Path, random: Random) -> list[Pictures]:
    """Return parts of the outlined photos that do not judge, by size."""
    found: dict[tuple[int, int], list[tuple[Tensor, Tensor, Tensor]]] = defaultdict(list)
    for picture, share, known in outlined(data, judging=False):
        for _ in range(EACH_PHOTO):
            size = size_of(SHAPES[random.integers(len(SHAPES))], AREA)
            box = photograph.box(random, share.shape, *size)
            half = dataclasses.replace(box, rows=size[0] // 2, columns=size[1] // 2)
            gain = np.exp(random.normal(0, 0.08, 3) + random.normal(0, 0.2))
            image = np.clip(box.of(picture, cv2.INTER_AREA) * gain, 0, 255)
            tensor = torch.from_numpy(image.transpose(2, 0, 1)[None].copy()).float() / 255
            air = half.of(share, cv2.INTER_AREA)
            solid = (half.of(known.astype(np.float32), cv2.INTER_AREA) > 0.95).astype(np.float32)
            truth = (torch.from_numpy(values[None]).half() for values in (air, solid))
            found[size].append((network.fine(tensor)[0].half(), *truth))
    return [Pictures(*map(torch.stack, zip(*rows, strict=True))) for rows in found.values()]


def fit(
    head: torch.nn.Sequential, worlds: list[Pictures], photos: list[Pictures], random: Random
) -> None:
    """Train the head anew, in place."""
    groups = worlds + photos
    parts = ((worlds, 1 - PHOTOS), (photos, PHOTOS))
    share = np.concatenate(
        [weight * _sizes(part) / max(_sizes(part).sum(), 1) for part, weight in parts]
    )
    optimise = torch.optim.AdamW(head.parameters(), lr=RATE, weight_decay=DECAY)
    head.train()
    for step in range(STEPS):
        optimise.param_groups[0]["lr"] = RATE * (1 - step / STEPS) + 1e-5
        group = groups[random.choice(len(groups), p=share / share.sum())]
        rows = torch.from_numpy(random.integers(len(group.air), size=BATCH))
        air = F.pixel_shuffle(head(group.features[rows].float()), 2)
        loss = air_loss(air, group.air[rows].float(), group.solid[rows].float())
        optimise.zero_grad()
        loss.backward()
        optimise.step()
        if step % 250 == 249:
            print(f"step {step + 1}: {loss.item():.3f}", flush=True)
    head.eval()


def _sizes(groups: list[Pictures]) -> np.ndarray:
    return np.array([len(group.air) for group in groups], float)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    for name in ("start", "worlds", "data", "out"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    parser.add_argument("--cache", type=Path, default=Path("build/pack"))
    options = parser.parse_args()
    cv2.setNumThreads(1)
    torch.manual_seed(0)
    network = LandNet()
    take_over(network, options.start, options.data, options.cache)
    network.eval()
    random = np.random.default_rng(9)
    worlds = look(network, Worlds(options.worlds), random)
    fit(network.air, worlds, look_at_photos(network, options.data, random), random)
    save(options.out, average=network.state_dict())


if __name__ == "__main__":
    main()
