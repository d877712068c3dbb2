"""Trains PaneNet for a given wall-clock time on a CPU.

``python -m training.windows.train --data ../shared/data/train --minutes 70 --out build/windows``

Running it again with the same ``--out`` resumes; ``--start last.pt`` goes on from another run's
weights. What is exported is an exponential moving average. ``--facades`` is a folder of labelled
photographs (``facades.py``); without one all walls are drawn.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np
import torch
from torch import nn
from torch.utils.data import DataLoader

from training.train import Average, optimiser, prepare, rate, save
from training.windows.data import Batches, held_out, natural
from training.windows.facades import Facades, names
from training.windows.model import PaneNet, losses

SAVE_SECONDS = 180


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, default=Path("../shared/data/train"))
    parser.add_argument("--facades", type=Path)
    parser.add_argument("--start", type=Path)
    parser.add_argument("--out", type=Path, default=Path("build/windows"))
    parser.add_argument("--minutes", type=float, default=40)
    parser.add_argument("--batch", type=int, default=12)
    parser.add_argument("--rate", type=float, default=2e-3)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    torch.set_num_threads(1)
    torch.manual_seed(options.seed)
    network = PaneNet().to(memory_format=torch.channels_last)
    if options.start is not None:
        network.load_state_dict(torch.load(options.start, weights_only=True)["average"])
    average, optimise = Average(network), optimiser(network)
    spent, step, checkpoint = 0.0, 0, options.out / "last.pt"
    if checkpoint.exists():
        state = torch.load(checkpoint, weights_only=True)
        network.load_state_dict(state["network"])
        optimise.load_state_dict(state["optimiser"])
        average.state, average.steps = state["average"], state["step"]
        spent, step = state["spent"], state["step"]

    def keep() -> None:
        save(
            checkpoint,
            network=network.state_dict(),
            average=average.state,
            optimiser=optimise.state_dict(),
            spent=spent,
            step=step,
        )

    photos = [p for p in natural(options.data) if not held_out(p)]
    real = options.facades and Facades(options.facades, names(options.facades)[0])
    loader = DataLoader(
        Batches(photos, options.batch, options.seed + step, real),
        batch_size=None,
        num_workers=1,
        prefetch_factor=4,
        multiprocessing_context="spawn",
    )
    began, before, saved, recent = time.monotonic(), spent, time.monotonic(), []
    for batch in loader:
        for group in optimise.param_groups:
            group["lr"] = rate(spent / (options.minutes * 60), options.rate)
        network.train()
        parts = losses(network(prepare(batch["image"])), batch["known"])
        optimise.zero_grad(set_to_none=True)
        sum(parts.values()).backward()
        nn.utils.clip_grad_norm_(network.parameters(), 2.0)
        optimise.step()
        average.update(network)
        step += 1
        recent.append([float(value.detach()) for value in parts.values()])
        now = time.monotonic()
        spent = before + now - began
        if step % 50 == 0:
            told = " ".join(f"{k} {v:.4f}" for k, v in zip(parts, np.mean(recent, 0), strict=True))
            print(f"step {step} {spent / 60:.1f} min {told}", flush=True)
            recent.clear()
        if now - saved > SAVE_SECONDS:
            keep()
            saved = now
        if spent > options.minutes * 60:
            break
    keep()


if __name__ == "__main__":
    main()
