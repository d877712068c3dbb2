"""Writes a checkpoint's averaged weights as the ONNX file that the package ships.

``python -m training.land.export --checkpoint build/land/last.pt``

Contract: ``image`` float32 ``(1, 3, H, W)``, RGB, sRGB-encoded in [0, 1], H and W multiples of 32
-> the outputs of ``LandMaps`` (training/land/model.py).
"""

from __future__ import annotations

import argparse
from pathlib import Path

import torch

from training.export import to_onnx
from training.land.model import LandMaps, LandNet

OUT = Path("sunwidget/analysis/models/land.onnx")
AREA = 92_000
"""Pixels of the picture at which it is used (sunwidget/analysis/networks/land.py)."""


def load(checkpoint: Path) -> LandNet:
    """Return the averaged network of a checkpoint, for inference."""
    network = LandNet()
    network.load_state_dict(torch.load(checkpoint, weights_only=True)["average"])
    return network.eval()


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--checkpoint", type=Path, default=Path("build/land/last.pt"))
    parser.add_argument("--out", type=Path, default=OUT)
    options = parser.parse_args()
    torch.set_num_threads(1)
    network = load(options.checkpoint)
    picture = torch.rand(1, 3, 256, 352)
    maps = LandMaps(network).eval()
    about = "How land lies, what it is made of, and what light falls on it"
    options.out.write_bytes(to_onnx(maps, picture, list(LandMaps.OUTPUTS), about))


if __name__ == "__main__":
    main()
