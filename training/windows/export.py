"""Writes a checkpoint's averaged weights as the ONNX file that the package ships.

``python -m training.windows.export --checkpoint build/windows/last.pt``

Contract: ``image`` float32 ``(1, 3, H, W)``, RGB, sRGB-encoded in [0, 1] -> ``pane`` float32
and ``window`` ``(1, 1, H, W)`` in [0, 1]. H and W are multiples of 32.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import torch

from training.export import to_onnx
from training.windows.model import PaneNet, PaneProbability

OUT = Path("sunwidget/analysis/models/panes.onnx")


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--checkpoint", type=Path, default=Path("build/windows/last.pt"))
    parser.add_argument("--out", type=Path, default=OUT)
    options = parser.parse_args()
    torch.set_num_threads(1)
    network = PaneNet()
    network.load_state_dict(torch.load(options.checkpoint, weights_only=True)["average"])
    picture = torch.rand(1, 3, 224, 320)
    probability = PaneProbability(network.eval()).eval()
    options.out.write_bytes(
        to_onnx(probability, picture, ["pane", "window"], "Windows and their panes")
    )


if __name__ == "__main__":
    main()
