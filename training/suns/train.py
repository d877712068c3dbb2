"""Trains SunNet for a given wall-clock time on a CPU.

``python -m training.suns.train --data ../shared/data/train --minutes 60 --out build/suns``

Running it again with the same ``--out`` resumes; ``--start`` goes on from another checkpoint with a
schedule of its own. What is exported is an exponential moving average of the weights.
"""

from __future__ import annotations

import argparse
import time
from collections import defaultdict
from pathlib import Path

import numpy as np
import torch
from torch import nn
from torch.utils.data import DataLoader

from training.suns.data import Batches
from training.suns.model import SunNet, losses
from training.train import Average, optimiser, prepare, rate, save

PEAK_RATE = 2e-3
SAVE_SECONDS = 240


class Training:
    """One process; the batches are made in another."""

    def __init__(self, options: argparse.Namespace) -> None:
        self.options = options
        self.network = SunNet().to(memory_format=torch.channels_last)
        self.average, self.optimise = Average(self.network), optimiser(self.network)
        self.spent, self.step = 0.0, 0
        self.checkpoint = options.out / "last.pt"
        if self.checkpoint.exists():
            state = torch.load(self.checkpoint, weights_only=True)
            self.optimise.load_state_dict(state["optimiser"])
            self.spent, self.step = state["spent"], state["step"]
        elif options.start:
            state = torch.load(options.start, weights_only=True)
            for key in ("network", "average"):  # outputs that it did not have start afresh
                state[key] = self.network.state_dict() | state[key]
        else:
            return
        self.network.load_state_dict(state["network"])
        self.average.state, self.average.steps = state["average"], state["step"]

    def run(self) -> None:
        """Train until the time is spent."""
        began, before = time.monotonic(), self.spent
        saved, limit = began, self.options.minutes * 60
        batches = iter(
            DataLoader(
                Batches(self.options.data, self.options.batch, self.options.seed + self.step),
                batch_size=None,
                num_workers=1,
                prefetch_factor=4,
                multiprocessing_context="spawn",
            )
        )
        recent: dict[str, list[float]] = defaultdict(list)
        while self.spent < limit:
            for key, value in self.learn(next(batches), self.spent / limit).items():
                recent[key].append(value)
            now = time.monotonic()
            self.spent = before + now - began
            if self.step % 50 == 0:
                told = " ".join(f"{k} {np.mean(v):.4f}" for k, v in recent.items())
                print(f"step {self.step} {self.spent / 60:.1f} min {told}", flush=True)
                recent.clear()
            if now - saved > SAVE_SECONDS:
                self.save()
                saved = now
        self.save()

    def learn(self, batch: dict[str, torch.Tensor], share: float) -> dict[str, float]:
        """One step; the losses."""
        for group in self.optimise.param_groups:
            group["lr"] = rate(share, self.options.rate)
        self.network.train()
        parts = losses(self.network(prepare(batch.pop("image"))), batch)
        self.optimise.zero_grad(set_to_none=True)
        sum(parts.values()).backward()
        nn.utils.clip_grad_norm_(self.network.parameters(), 2.0)
        self.optimise.step()
        self.average.update(self.network)
        self.step += 1
        return {key: float(value.detach()) for key, value in parts.items()}

    def save(self) -> None:
        save(
            self.checkpoint,
            network=self.network.state_dict(),
            average=self.average.state,
            optimiser=self.optimise.state_dict(),
            spent=self.spent,
            step=self.step,
        )


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, default=Path("../shared/data/train"))
    parser.add_argument("--out", type=Path, default=Path("build/suns"))
    parser.add_argument("--start", type=Path, help="checkpoint to go on from")
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--batch", type=int, default=16)
    parser.add_argument("--rate", type=float, default=PEAK_RATE)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    torch.set_num_threads(options.threads)
    torch.manual_seed(options.seed)
    Training(options).run()


if __name__ == "__main__":
    main()
