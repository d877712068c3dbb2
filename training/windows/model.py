"""PaneNet: which pixels of a photo are glass of windows."""

from __future__ import annotations

import torch.nn.functional as F
from torch import Tensor, nn

from training.model import Merge, Residual, StripContext, conv


class PaneNet(nn.Module):
    """``(N, 3, H, W)`` sRGB in [0, 1] -> logits ``(N, 1, H, W)``; H, W multiples of 32."""

    def __init__(self) -> None:
        super().__init__()
        self.stem = nn.Sequential(conv(3, 12, 3, 2), conv(12, 16))
        self.quarter = nn.Sequential(conv(16, 24, 3, 2), Residual(24, 24))
        self.eighth = nn.Sequential(conv(24, 40, 3, 2), Residual(40, 40), Residual(40, 40))
        self.deep = nn.Sequential(conv(40, 48, 3, 2), StripContext(48, 24), Residual(48, 48))
        self.deepest = nn.Sequential(conv(48, 64, 3, 2), StripContext(64, 32), Residual(64, 48))
        self.to_deep = Merge(64, 48, 48)
        self.to_eighth = Merge(48, 40, 40)
        self.to_quarter = Merge(40, 24, 24)
        self.to_half = Merge(24, 16, 16)
        self.pane = nn.Sequential(conv(16, 16), nn.Conv2d(16, 4, 1))
        nn.init.constant_(self.pane[1].bias, -3.0)

    def forward(self, image: Tensor) -> Tensor:
        half = self.stem(image * 4.0 - 2.0)
        quarter = self.quarter(half)
        eighth = self.eighth(quarter)
        deep = self.deep(eighth)
        x = self.to_deep(self.deepest(deep), deep)
        x = self.to_half(self.to_quarter(self.to_eighth(x, eighth), quarter), half)
        return F.pixel_shuffle(self.pane(x), 2)


class PaneProbability(nn.Module):
    """The shipped graph: ``image`` in, ``pane`` (N, 1, H, W) in [0, 1] out."""

    def __init__(self, network: PaneNet) -> None:
        super().__init__()
        self.network = network

    def forward(self, image: Tensor) -> Tensor:
        return self.network(image).sigmoid()


def losses(out: Tensor, target: Tensor) -> dict[str, Tensor]:
    """Losses of logits against shares of glass, both (N, 1, H, W): two scalars."""
    plain = F.binary_cross_entropy_with_logits(out, target)
    p = out.sigmoid()
    both = (p * target).sum((1, 2, 3))
    dice = 1 - (2 * both + 30) / (p.sum((1, 2, 3)) + target.sum((1, 2, 3)) + 30)
    return {"pixels": 4 * plain, "overlap": dice.mean()}
