"""SkyNet: how much of every pixel is sky, and how much is water.

EfficientNet-Lite's first stages (``encoder.py``) know the world from ImageNet; strip pooling (Hou
et al. 2020) gives every pixel its whole row and column; a decoder of plain 3x3 convolutions brings
the result back to full resolution. Bytes for the weights (``weights.py``) keep the file small.
"""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from training.encoder import LEVELS, Encoder

STRIDE = 32
"""Height and width of the input must be multiples of this (pixels)."""


def conv(inputs: int, outputs: int, size: int = 3, stride: int = 1) -> nn.Sequential:
    """Convolution, batch normalisation, ReLU."""
    return nn.Sequential(
        nn.Conv2d(inputs, outputs, size, stride, size // 2, bias=False),
        nn.BatchNorm2d(outputs),
        nn.ReLU(inplace=True),
    )


class Residual(nn.Module):
    """Two 3x3 convolutions through ``middle`` channels, added to their input (He et al. 2016)."""

    def __init__(self, channels: int, middle: int) -> None:
        super().__init__()
        self.first = conv(channels, middle)
        self.second = nn.Sequential(
            nn.Conv2d(middle, channels, 3, 1, 1, bias=False), nn.BatchNorm2d(channels)
        )
        nn.init.zeros_(self.second[1].weight)  # starts as the identity

    def forward(self, x: Tensor) -> Tensor:
        return F.relu(x + self.second(self.first(x)))


class StripContext(nn.Module):
    """Adds each position the means of its row, its column and the whole photo; any size."""

    def __init__(self, channels: int, middle: int) -> None:
        super().__init__()
        self.row = nn.Conv2d(channels, middle, (3, 1), padding=(1, 0))
        self.column = nn.Conv2d(channels, middle, (1, 3), padding=(0, 1))
        self.photo = nn.Conv2d(channels, middle, 1)
        self.mix = nn.Sequential(
            nn.Conv2d(middle, channels, 1, bias=False), nn.BatchNorm2d(channels)
        )

    def forward(self, x: Tensor) -> Tensor:
        rows = self.row(x.mean(3, keepdim=True))
        columns = self.column(x.mean(2, keepdim=True))
        photo = self.photo(x.mean((2, 3), keepdim=True))
        return F.relu(x + self.mix(F.relu(rows + columns + photo)))


class Merge(nn.Module):
    """Doubles the resolution, adds the encoder's features of that resolution, convolves."""

    def __init__(self, deep: int, skip: int, outputs: int) -> None:
        super().__init__()
        self.lift = nn.Conv2d(deep, outputs, 1, bias=False)
        self.skip = nn.Conv2d(skip, outputs, 1, bias=False)
        self.join = nn.Sequential(
            nn.BatchNorm2d(outputs), nn.ReLU(inplace=True), conv(outputs, outputs)
        )

    def forward(self, deep: Tensor, skip: Tensor) -> Tensor:
        lifted = F.interpolate(
            self.lift(deep), scale_factor=2.0, mode="bilinear", align_corners=False
        )
        return self.join(lifted + self.skip(skip))


class SkyNet(nn.Module):
    """``(N, 3, H, W)`` sRGB in [0, 1] -> ``(N, 2, H, W)`` logits; H, W multiples of 32."""

    def __init__(self) -> None:
        super().__init__()
        self.encoder = Encoder()
        half, quarter, eighth, sixteenth, deep = LEVELS
        self.context = StripContext(deep, 96)
        self.to_sixteenth = Merge(deep, sixteenth, 96)
        self.wide = StripContext(96, 48)
        self.to_eighth = Merge(96, eighth, 64)
        self.to_quarter = Merge(64, quarter, 48)
        self.to_half = Merge(48, half, 32)
        self.head = nn.Sequential(conv(32, 32), nn.Conv2d(32, 8, 3, padding=1))
        self.coarse_head = nn.Conv2d(64, 2, 1)  # deep supervision while training only

    def features(self, image: Tensor) -> tuple[Tensor, Tensor]:
        """Logits at full resolution and at 1/8 of it."""
        half, quarter, eighth, sixteenth, deep = self.encoder(image)
        x = self.wide(self.to_sixteenth(self.context(deep), sixteenth))
        x = self.to_eighth(x, eighth)
        coarse = self.coarse_head(x)
        x = self.to_half(self.to_quarter(x, quarter), half)
        return F.pixel_shuffle(self.head(x), 2), coarse

    def forward(self, image: Tensor) -> Tensor:
        return self.features(image)[0]


class SkyMaps(nn.Module):
    """The shipped graph: ``image`` in, probabilities of sky and water out, (N, 1, H, W) each."""

    OUTPUTS = ("sky", "water")

    def __init__(self, network: SkyNet) -> None:
        super().__init__()
        self.network = network

    def forward(self, image: Tensor) -> tuple[Tensor, Tensor]:
        sky, water = torch.sigmoid(self.network(image)).split(1, 1)
        return sky, water
