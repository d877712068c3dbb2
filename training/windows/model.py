"""PaneNet: which pixels of a photo are glass of windows, and which belong to windows."""

from __future__ import annotations

import torch.nn.functional as F
from torch import Tensor, nn

from training.model import Merge, Residual, StripContext, conv


class PaneNet(nn.Module):
    """``(N, 3, H, W)`` sRGB in [0, 1] -> logits ``(N, 2, H, W)``; H, W multiples of 32.

    Glass without frames and bars, and whole windows.
    """

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
        self.pane = nn.Sequential(conv(16, 16), nn.Conv2d(16, 8, 1))
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
    """The shipped graph: ``image`` in, ``pane`` and ``window`` (N, 1, H, W) in [0, 1] out."""

    def __init__(self, network: PaneNet) -> None:
        super().__init__()
        self.network = network

    def forward(self, image: Tensor) -> tuple[Tensor, Tensor]:
        pane, window = self.network(image).sigmoid().split(1, 1)
        return pane, window


def losses(out: Tensor, known: Tensor) -> dict[str, Tensor]:
    """Losses of logits (N, 2, H, W) against ``draw.LAYERS`` (N, 4, H, W): scalars."""
    target, labeled = known[:, :2], 1 - known[:, 2:]
    plain = F.binary_cross_entropy_with_logits(out, target, reduction="none") * labeled
    pane, window = plain.sum((0, 2, 3)) / labeled.sum((0, 2, 3))
    p, target = out.sigmoid() * labeled, target * labeled
    both = (p * target).sum((2, 3))
    dice = 1 - (2 * both + 30) / (p.sum((2, 3)) + target.sum((2, 3)) + 30)
    return {
        "pane": 3 * pane,
        "window": 4 * window,
        "overlap": dice.mean(0) @ dice.new_tensor([0.5, 1]),
    }
