"""What every training by the clock has in common: weights, their average, steps and checkpoints."""

from __future__ import annotations

import argparse
from collections import defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn
from torch.utils.data import DataLoader, IterableDataset, get_worker_info

from training.clock import Clock

WARM_UP = 0.02
ENCODER_SHARE = 0.35
CHECKPOINT = "last.pt"


class Average:
    """Exponential moving average of weights and batch statistics."""

    def __init__(self, network: nn.Module, decay: float = 0.995) -> None:
        self.decay, self.steps = decay, 0
        self.state = {k: v.detach().clone() for k, v in network.state_dict().items()}

    @torch.no_grad()
    def update(self, network: nn.Module) -> None:
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


def prepare(image: Tensor) -> Tensor:
    """uint8 -> float32 in [0, 1], channels last in memory."""
    return image.float().div_(255).contiguous(memory_format=torch.channels_last)


def device_options(parser: argparse.ArgumentParser, batch: int, workers: int = 1) -> None:
    """Add what says where a training runs, and how much at once."""
    add = parser.add_argument
    add("--device", default="cuda" if torch.cuda.is_available() else "cpu")
    add("--workers", type=int, default=workers, help="processes that make batches")
    add("--batch", type=int, default=batch)
    add("--bfloat16", action="store_true", help="for graphics cards, and CPUs with matrix units")


def put(batch: dict[str, Tensor], device: str) -> dict[str, Tensor]:
    """Return a batch with its tensors on the device."""
    return {name: tensor.to(device, non_blocking=True) for name, tensor in batch.items()}


def numbers(*seeds: int) -> np.random.Generator:
    """Return random numbers that differ in each of the processes that make batches."""
    worker = get_worker_info()
    return np.random.default_rng((*seeds, worker.id if worker else 0))


def batches(dataset: IterableDataset, ahead: int = 4, workers: int = 1) -> Iterator[Any]:
    """Return batches that other processes make, each so many ahead."""
    return iter(
        DataLoader(
            dataset,
            batch_size=None,
            num_workers=workers,
            prefetch_factor=ahead,
            multiprocessing_context="spawn",  # OpenCV's threads do not survive a fork
        )
    )


def optimiser(network: nn.Module) -> torch.optim.AdamW:
    """AdamW; weight decay on convolution kernels only, a share of the rate for the encoder."""
    groups: dict[tuple[bool, bool], list[nn.Parameter]] = defaultdict(list)
    for name, weights in network.named_parameters():
        groups[name.startswith("encoder."), weights.ndim > 1].append(weights)
    return torch.optim.AdamW(
        [
            {
                "params": weights,
                "weight_decay": 0.02 if kernels else 0.0,
                "share": ENCODER_SHARE if learned else 1.0,
            }
            for (learned, kernels), weights in groups.items()
        ],
        betas=(0.9, 0.99),
    )


def save(path: Path, **state: object) -> None:
    """Writes a checkpoint whole or not at all."""
    torch.save(state, path.with_suffix(".part"))
    path.with_suffix(".part").replace(path)


def begun(folder: Path) -> bool:
    """Whether a training in this folder has a checkpoint to go on from."""
    return (folder / CHECKPOINT).exists()


class Run(Clock):
    """A network that learns for some minutes, also in several goes.

    With a checkpoint in ``folder`` it goes on from there. ``kept`` of the moving
    average stays each step; every ``seconds`` a checkpoint is written and ``on_checkpoint``
    is called. The weights in ``encoder``, if any, were learned before and get a share of the rate.
    """

    def __init__(
        self,
        network: nn.Module,
        folder: Path,
        minutes: float,
        *,
        kept: float = 0.995,
        seconds: float = 240,
        on_checkpoint: Callable[[], None] | None = None,
    ) -> None:
        self.network, self.optimise = network, optimiser(network)
        super().__init__(minutes, self.keep, seconds)
        self.kept, self.on_checkpoint, self.step = kept, on_checkpoint, 0
        self.recent: dict[str, list[float]] = defaultdict(list)
        self.checkpoint = folder / CHECKPOINT
        self.average = Average(network, kept)
        self.resumed = begun(folder)
        if self.resumed:
            state = torch.load(self.checkpoint, weights_only=True, map_location="cpu")
            self.begin(state)
            self.optimise.load_state_dict(state["optimiser"])
            self.spent, self.step = state["spent"], state["step"]

    def begin(self, state: dict[str, object]) -> None:
        """Take weights and their average over from a checkpoint, and nothing else."""
        self.network.load_state_dict(state["network"])
        for key, value in state["average"].items():
            self.average.state[key].copy_(value)
        self.average.steps = state["step"]

    def afresh(self) -> None:
        """Let the moving average begin with the weights as they are now."""
        self.average = Average(self.network, self.kept)

    def learn(self, speed: float, steepest: float) -> None:
        """Make a step along the gradients that are there, no longer than ``steepest``."""
        for group in self.optimise.param_groups:
            group["lr"] = speed * group["share"]
        nn.utils.clip_grad_norm_(self.network.parameters(), steepest)
        self.optimise.step()
        self.optimise.zero_grad(set_to_none=True)
        self.average.update(self.network)
        self.step += 1

    def count(self, losses: dict[str, Tensor]) -> None:
        """Remember losses until they are reported."""
        for name, value in losses.items():
            self.recent[name].append(float(value.detach()))

    def keep(self) -> None:
        """Write the checkpoint."""
        save(
            self.checkpoint,
            network=self.network.state_dict(),
            average=self.average.state,
            optimiser=self.optimise.state_dict(),
            spent=self.spent,
            step=self.step,
        )
        if self.on_checkpoint is not None:
            self.on_checkpoint()


def report(run: Run, every: int = 50) -> Iterator[float]:
    """Yield the share of the time before each step; print the recent means, and save at the end."""
    for share in run.shares():
        yield share
        if run.step % every == 0:
            means = " ".join(f"{name} {np.mean(n):.4f}" for name, n in run.recent.items())
            print(f"step {run.step} {run.spent / 60:.1f} min {means}", flush=True)
            run.recent.clear()
    run.keep()
