"""Trains PaneNet for a given wall-clock time on a CPU.

``python -m training.windows.train --data ../shared/data/train --minutes 70 --out build/windows``

Running it again with the same ``--out`` resumes; ``--start last.pt`` goes on from another run's
weights. What is exported is an exponential moving average. ``--facades`` is a folder of labelled
photographs (``facades.py``); without one all walls are drawn.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import torch

from training.loop import Run, batches, prepare, rate, report
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
    parser.add_argument(
        "--bfloat16", action="store_true", help="twice as fast on CPUs that have it"
    )
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    torch.set_num_threads(1)
    torch.manual_seed(options.seed)
    network = PaneNet().to(memory_format=torch.channels_last)
    run = Run(network, options.out, options.minutes, seconds=SAVE_SECONDS)
    if options.start is not None and not run.resumed:
        network.load_state_dict(torch.load(options.start, weights_only=True)["average"])
        run.afresh()
    photos = [p for p in natural(options.data) if not held_out(p)]
    real = options.facades and Facades(options.facades, names(options.facades)[0])
    streets = batches(Batches(photos, options.batch, options.seed + run.step, real))
    for share in report(run):
        batch = next(streets)
        network.train()
        with torch.autocast("cpu", torch.bfloat16, enabled=options.bfloat16):
            out = network(prepare(batch["image"])).float()
        parts = losses(out, batch["known"])
        sum(parts.values()).backward()
        run.learn(rate(share, options.rate), 2.0)
        run.count(parts)


if __name__ == "__main__":
    main()
