"""Writes a checkpoint's averaged weights as the ONNX file that the package ships.

``python -m training.export --checkpoint build/sky/last.pt``

Contract: ``image`` float32 ``(1, 3, H, W)``, RGB, sRGB-encoded in [0, 1] -> ``sky`` and ``water``
float32 ``(1, 1, H, W)`` in [0, 1].
Made for 384 x 384; other multiples of 32 work. How weights are stored: ``training/weights.py``.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

import numpy as np
import onnx
import torch
from torch import nn
from torch.nn.utils.fusion import fuse_conv_bn_eval

from training.model import STRIDE, SkyMaps, SkyNet
from training.weights import store_weights

SIZE = 384
LIMIT = 3_500_000
TOLERANCE, TOLERANCE_OF_BYTES = 0.02, 0.1
"""Largest difference of any pixel between PyTorch in float32 and the file."""


def fold(module: nn.Module) -> None:
    """Merges every batch normalisation that directly follows a convolution into it, in place."""
    for child in module.children():
        fold(child)
    if isinstance(module, nn.Sequential):
        for i in range(len(module) - 1):
            if isinstance(module[i], nn.Conv2d) and isinstance(module[i + 1], nn.BatchNorm2d):
                module[i], module[i + 1] = (
                    fuse_conv_bn_eval(module[i], module[i + 1]),
                    nn.Identity(),
                )


def load(checkpoints: list[Path], shares: list[float]) -> SkyNet:
    """The averaged network of a checkpoint, or the mean of several of one run, for inference.

    Weights of one run lie close enough together to be averaged (Wortsman et al. 2022, "Model
    soups").
    """
    states = [torch.load(c, weights_only=True)["average"] for c in checkpoints]
    mean = {
        key: sum(share * s[key] for share, s in zip(shares, states, strict=True)) / sum(shares)
        if value.dtype.is_floating_point
        else value
        for key, value in states[0].items()
    }
    network = SkyNet()
    network.load_state_dict(mean)
    return network.eval()


def to_onnx(
    network: nn.Module,
    image: torch.Tensor,
    outputs: list[str],
    about: str,
    as_bytes: bool = False,
) -> bytes:
    """A network of one picture, (N, 3, H, W) of any multiple of 32, as the content of an ONNX file.

    Large weights are stored as float16 or as bytes. Refuses a result that differs too much from
    PyTorch's.
    """
    import onnxruntime

    with torch.no_grad():
        expected = network(image)
        expected = expected if isinstance(expected, tuple) else (expected,)
        fold(network)
        height = torch.export.Dim("height", min=2, max=64) * STRIDE
        width = torch.export.Dim("width", min=2, max=64) * STRIDE
        with tempfile.TemporaryDirectory() as folder:
            full = Path(folder) / "full.onnx"
            torch.onnx.export(
                network,
                (image,),
                full,
                input_names=["image"],
                output_names=outputs,
                dynamic_shapes={"image": {2: height, 3: width}},
                dynamo=True,
                external_data=False,
            )
            model = onnx.load(full)
    store_weights(model, as_bytes)
    for node in model.graph.node:  # the exporter notes source lines of this machine
        del node.metadata_props[:]
        node.doc_string = ""
    del model.graph.metadata_props[:]
    model.doc_string = f"{about}; see MODEL_CARD.md"
    onnx.checker.check_model(model, full_check=True)
    data = model.SerializeToString()
    session = onnxruntime.InferenceSession(data, providers=["CPUExecutionProvider"])
    results = session.run(None, {"image": image.numpy()})
    off = max(float(np.abs(r - e.numpy()).max()) for r, e in zip(results, expected, strict=True))
    limit = TOLERANCE_OF_BYTES if as_bytes else TOLERANCE
    if off > limit:
        raise SystemExit(f"off by {off:.4f} (limit {limit}): not written")
    print(f"{len(data) / 1e6:.2f} MB, differs from PyTorch by at most {off:.5f}")
    return bytes(data)


def export(checkpoints: list[Path], shares: list[float], out: Path) -> None:
    """Exports, and refuses a file that is too large."""
    network = SkyMaps(load(checkpoints, shares)).eval()
    about = "Probability of sky and of water"
    data = to_onnx(
        network, torch.rand(1, 3, SIZE, SIZE), list(SkyMaps.OUTPUTS), about, as_bytes=True
    )
    if len(data) > LIMIT:
        raise SystemExit(f"{len(data)} bytes (limit {LIMIT}): not written")
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_bytes(data)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--checkpoint", type=Path, nargs="+", default=[Path("build/sky/last.pt")])
    parser.add_argument("--shares", type=float, nargs="+", help="of each checkpoint in the mean")
    parser.add_argument("--out", type=Path, default=Path("sunwidget/analysis/models/sky.onnx"))
    options = parser.parse_args()
    export(options.checkpoint, options.shares or [1.0] * len(options.checkpoint), options.out)


if __name__ == "__main__":
    main()
