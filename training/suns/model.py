"""SunNet: where a photo's sun is, and what the sky looks like without it.

One small residual encoder-decoder with all its outputs at a quarter of the input's size: suns are
found and erased by the same features, since both ask what is glare and what is cloud.
"""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from training.model import Merge, Residual, StripContext, conv

STRIDE = 32
"""Height and width of the input must be multiples of this (pixels)."""
QUARTER = 4
"""The outputs are smaller than the input by this factor."""
LIGHT_FLOOR = 0.01
"""Added to display-linear light before its logarithm is taken."""


class SunNet(nn.Module):
    """``(N, 3, H, W)`` sRGB in [0, 1] -> ``(N, 7, H/4, W/4)``; H, W multiples of 32.

    Channels: logit of the sun's centre; log radius of its core in widths of the picture; logit of
    a sharp limb; log(clean + floor) - log(photo + floor) of display-linear R, G, B; and logit of
    water, which mirrors the sun.
    """

    def __init__(self) -> None:
        super().__init__()
        self.stem = conv(3, 16, 3, 2)
        self.quarter = nn.Sequential(conv(16, 32, 3, 2), Residual(32, 32))
        self.eighth = nn.Sequential(conv(32, 48, 3, 2), Residual(48, 48), Residual(48, 48))
        self.sixteenth = nn.Sequential(
            conv(48, 80, 3, 2), Residual(80, 64), StripContext(80, 48), Residual(80, 64)
        )
        self.deep = nn.Sequential(
            conv(80, 128, 3, 2), Residual(128, 80), StripContext(128, 64), Residual(128, 80)
        )
        self.to_sixteenth = Merge(128, 80, 80)
        self.to_eighth = Merge(80, 48, 48)
        self.to_quarter = Merge(48, 32, 32)
        self.sun = nn.Sequential(conv(32, 24), nn.Conv2d(24, 3, 1))
        self.clean = nn.Sequential(conv(32, 32), nn.Conv2d(32, 3, 1))
        self.water = nn.Sequential(conv(32, 24), nn.Conv2d(24, 1, 1))
        nn.init.constant_(self.sun[1].bias, -4.0)
        nn.init.zeros_(self.clean[1].weight)  # starts as: nothing to erase
        nn.init.zeros_(self.clean[1].bias)

    def forward(self, image: Tensor) -> Tensor:
        quarter = self.quarter(self.stem(image * 4.0 - 2.0))
        eighth = self.eighth(quarter)
        sixteenth = self.sixteenth(eighth)
        x = self.to_sixteenth(self.deep(sixteenth), sixteenth)
        x = self.to_quarter(self.to_eighth(x, eighth), quarter)
        return torch.cat([self.sun(x), self.clean(x), self.water(x)], 1)


class SunMaps(nn.Module):
    """The shipped graph: ``image`` in; ``sun``, ``clean`` and ``water`` out.

    ``sun`` is ``(N, 3, H/4, W/4)``: probability, radius in widths, probability of a sharp limb.
    ``clean`` is ``(N, 3, H/4, W/4)``: log of clean over photo, display-linear with the floor.
    ``water`` is ``(N, 1, H/4, W/4)``: probability.
    """

    def __init__(self, network: SunNet) -> None:
        super().__init__()
        self.network = network

    def forward(self, image: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        out = self.network(image)
        sun = torch.cat([out[:, :1].sigmoid(), out[:, 1:2].exp(), out[:, 2:3].sigmoid()], 1)
        return sun, out[:, 3:6], out[:, 6:].sigmoid()


def _mean(error: Tensor, weight: Tensor) -> Tensor:
    """Weighted mean of an error (N, 3, h, w); weight (N, 1, h, w)."""
    return (error.abs() * weight).sum() / (3 * weight.sum()).clamp(min=1)


def _edges(error: Tensor, weight: Tensor) -> Tensor:
    """Weighted mean differences of an error (N, 3, h, w) between pixels, summed over distances.

    How bright a wide halo is cannot be known; where it ends can.
    """
    parts = []
    for apart in (1, 2, 4, 8):
        for axis in (2, 3):
            size = error.shape[axis] - apart
            (here, there), (weighs_here, weighs_there) = (
                (x.narrow(axis, 0, size), x.narrow(axis, apart, size)) for x in (error, weight)
            )
            parts.append(_mean(there - here, torch.minimum(weighs_here, weighs_there)))
    return torch.stack(parts).sum()


def losses(out: Tensor, target: dict[str, Tensor]) -> dict[str, Tensor]:
    """Losses of a batch, each a scalar.

    Parameters
    ----------
    out : (N, 7, h, w)
    target : dict
        ``heat`` (N, 1, h, w) in [0, 1], exactly 1 at a centre; ``heat_weight`` alike;
        ``radius``, ``sharp`` (N, 1, 1, 1), NaN where unknown; ``clean`` (N, 3, h, w) and
        ``clean_weight`` (N, 1, h, w); ``water`` (N, 1, h, w) in [0, 1] and ``water_weight`` alike.
    """
    heat, weight = target["heat"], target["heat_weight"]
    at = (heat > 0.999).float() * weight
    p = torch.sigmoid(out[:, :1])
    # Focal loss of a heat map with soft negatives near the centre (Law and Deng 2018, "CornerNet").
    hit = -at * (1 - p) ** 2 * F.logsigmoid(out[:, :1])
    miss = -(1 - at) * weight * (1 - heat) ** 4 * p**2 * F.logsigmoid(-out[:, :1])
    count = at.sum().clamp(min=1)
    near = (heat > 0.6).float() * weight
    radius, sharp = target["radius"], target["sharp"]
    known_radius = near * torch.isfinite(radius)
    known_sharp = near * torch.isfinite(sharp)
    off = F.smooth_l1_loss(
        out[:, 1:2], torch.nan_to_num(radius).expand_as(heat), reduction="none", beta=0.1
    )
    limb = F.binary_cross_entropy_with_logits(
        out[:, 2:3], torch.nan_to_num(sharp).expand_as(heat), reduction="none"
    )
    wrong = out[:, 3:6] - target["clean"]
    wet = F.binary_cross_entropy_with_logits(out[:, 6:], target["water"], reduction="none")
    return {
        "centre": (hit.sum() + miss.sum()) / count,
        "radius": (off * known_radius).sum() / known_radius.sum().clamp(min=1),
        "sharp": 0.3 * (limb * known_sharp).sum() / known_sharp.sum().clamp(min=1),
        "clean": 6 * _mean(wrong, target["clean_weight"]),
        "edges": 3 * _edges(wrong, target["clean_weight"]),
        "water": 2
        * (wet * target["water_weight"]).sum()
        / target["water_weight"].sum().clamp(min=1),
    }
