"""What every training by the clock has in common: weights, their average, steps and checkpoints."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import torch
from torch import Tensor, nn

from training.clock import Clock
from training.train import Average, optimiser, save


class Run(Clock):
    """A network that learns for some minutes, also in several goes.

    With a checkpoint ``last.pt`` in ``folder`` it goes on from there. ``kept`` of the moving
    average stays each step; every ``seconds`` a checkpoint is written and ``on_checkpoint``
    is called.
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
        self.checkpoint = folder / "last.pt"
        self.average = Average(network, kept)
        self.resumed = self.checkpoint.exists()
        if self.resumed:
            state = torch.load(self.checkpoint, weights_only=True)
            self.begin(state)
            self.optimise.load_state_dict(state["optimiser"])
            self.spent, self.step = state["spent"], state["step"]

    def begin(self, state: dict[str, object]) -> None:
        """Take weights and their average over from a checkpoint, and nothing else."""
        self.network.load_state_dict(state["network"])
        self.average.state, self.average.steps = state["average"], state["step"]

    def afresh(self) -> None:
        """Let the moving average begin with the weights as they are now."""
        self.average = Average(self.network, self.kept)

    def learn(self, speed: float, steepest: float) -> None:
        """Make a step along the gradients that are there, no longer than ``steepest``."""
        for group in self.optimise.param_groups:
            group["lr"] = speed
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
