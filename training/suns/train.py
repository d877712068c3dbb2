"""Trains SunNet for a given wall-clock time.

``python -m training.suns.train --data ../shared/data/train --minutes 60 --out build/suns``

Running it again with the same ``--out`` resumes; ``--start`` goes on from another checkpoint, or
from ``sunwidget/analysis/models/suns.onnx``, with a schedule of its own. What is exported is an
exponential moving average of the weights.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import torch

from training.loop import Run, batches, begun, device_options, prepare, put, rate, report
from training.restore import restore
from training.suns.data import Batches, typical
from training.suns.model import SunNet, losses

PEAK_RATE = 2e-3


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--data", type=Path, default=Path("../shared/data/train"))
    parser.add_argument("--out", type=Path, default=Path("build/suns"))
    parser.add_argument("--start", type=Path, help="checkpoint or shipped file to go on from")
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--rate", type=float, default=PEAK_RATE)
    parser.add_argument("--threads", type=int, default=1)
    device_options(parser, batch=16)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    torch.set_num_threads(options.threads)
    torch.manual_seed(options.seed)
    network = SunNet()
    start = None if begun(options.out) else options.start
    if start and start.suffix == ".onnx":
        restore(network, start, [(image,) for image in typical(options.data, 24)])
    network.to(options.device, memory_format=torch.channels_last)
    run = Run(network, options.out, options.minutes)
    if start and start.suffix == ".pt":
        state = torch.load(start, weights_only=True, map_location="cpu")
        for key in ("network", "average"):  # outputs that it did not have start afresh
            state[key] = network.state_dict() | state[key]
        run.begin(state)
    data = Batches(options.data, options.batch, options.seed + run.step)
    photos = batches(data, workers=options.workers)
    kind = torch.device(options.device).type
    for share in report(run):
        batch = put(next(photos), options.device)
        network.train()
        with torch.autocast(kind, torch.bfloat16, enabled=options.bfloat16):
            maps = network(prepare(batch.pop("image")))
        parts = losses(tuple(each.float() for each in maps), batch)
        sum(parts.values()).backward()
        run.learn(rate(share, options.rate), 2.0)
        run.count(parts)


if __name__ == "__main__":
    main()
