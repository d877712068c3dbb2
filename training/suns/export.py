"""Writes a checkpoint's averaged weights as the ONNX file that the package ships.

``python -m training.suns.export --checkpoint build/suns/last.pt``

Contract: ``image`` float32 ``(1, 3, H, W)``, RGB, sRGB-encoded in [0, 1] -> ``sun`` and ``clean``,
float32 ``(1, 3, H/4, W/4)`` and ``(1, 3, H/2, W/2)``, and ``water``, ``(1, 1, H/4, W/4)``
(training/suns/model.py). H and W are multiples of 32.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import torch

from training.export import to_onnx
from training.suns.model import SunMaps, SunNet

OUT = Path("sunwidget/analysis/models/suns.onnx")


def load(checkpoint: Path) -> SunNet:
    """The averaged network of a checkpoint, for inference."""
    network = SunNet()
    network.load_state_dict(torch.load(checkpoint, weights_only=True)["average"])
    return network.eval()


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--checkpoint", type=Path, default=Path("build/suns/last.pt"))
    parser.add_argument("--out", type=Path, default=OUT)
    options = parser.parse_args()
    torch.set_num_threads(1)
    network = SunMaps(load(options.checkpoint)).eval()
    picture = torch.rand(1, 3, 224, 320)
    names = ["sun", "clean", "water"]
    about = "Suns, clean skies and water"
    options.out.write_bytes(to_onnx(network, picture, names, about, as_bytes=True))


if __name__ == "__main__":
    main()
