"""The shipped ONNX file back into a network that can be trained further.

Export merges most batch normalisations into the convolutions before them. Here they come back: each
is given the statistics that its convolution really has on some photos, and the scale and offset
that undo them, so that the restored network computes the same as the file.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import onnx
import torch
from torch import Tensor, nn

from training.weights import read_weights


def restore(network: nn.Module, path: Path, photos: list[tuple[Tensor, ...]]) -> None:
    """Fills ``network`` in place.

    ``photos`` are batches whose first item is uint8 ``(N, 3, S, S)``.

    What is not in the file, as the head of the deep supervision, keeps its random start, and so
    do layers of another shape: a network may begin from the file of another one.
    """
    values = {
        name.removeprefix("network."): torch.tensor(weight).float()
        for name, weight in read_weights(onnx.load(path)).items()
    }
    state = network.state_dict()
    known = {k: v for k, v in values.items() if k in state and state[k].shape == v.shape}
    network.load_state_dict(known, strict=False)
    pairs = [
        (layer[i], layer[i + 1], values[f"{name}.{i}.bias"])
        for name, layer in network.named_modules()
        if isinstance(layer, nn.Sequential)
        for i in range(len(layer) - 1)
        if isinstance(layer[i], nn.Conv2d) and isinstance(layer[i + 1], nn.BatchNorm2d)
        if f"{name}.{i}.bias" in values and f"{name}.{i}.weight" in known
    ]
    network.eval()
    with torch.no_grad():
        for _, norm, bias in pairs:  # first as nothing but the offset ...
            norm.running_mean.zero_()
            norm.running_var.fill_(1 - norm.eps)
            norm.weight.fill_(1)
            norm.bias.copy_(bias)
        sums = [torch.zeros(3, norm.num_features) for _, norm, _ in pairs]
        hooks = [
            norm.register_forward_pre_hook(_gather(total))
            for (_, norm, _), total in zip(pairs, sums, strict=True)
        ]
        for image, *_ in photos:
            network(image.float().div_(255))
        for hook in hooks:
            hook.remove()
        for (_, norm, bias), (count, first, second) in zip(pairs, sums, strict=True):
            mean = first / count
            variance = (second / count - mean**2).clamp_min(1e-6)
            norm.running_mean.copy_(mean)
            norm.running_var.copy_(variance)
            norm.weight.copy_((variance + norm.eps).sqrt())  # ... then undoing its statistics
            norm.bias.copy_(bias + mean)


def _gather(total: Tensor) -> Callable[[nn.Module, tuple[Tensor]], None]:
    def hook(_: nn.Module, inputs: tuple[Tensor]) -> None:
        x = inputs[0].double()
        total[0] += x.numel() / x.shape[1]
        total[1] += x.sum((0, 2, 3)).float()
        total[2] += (x**2).sum((0, 2, 3)).float()

    return hook
