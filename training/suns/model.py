"""SunNet: where a photo's sun is, and what the sky looks like without it.

The encoder of the sky network up to 1/16, with what it knows of the world, strip pooling, and the
same decoder. Suns are found and erased by the same features, since both ask what is glare and what
is cloud. The erased light has half of the input's size, for rays are narrow.
"""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from training.encoder import LEVELS, Encoder
from training.model import Merge, Residual, StripContext, conv

STRIDE = 32
"""Height and width of the input must be multiples of this (pixels)."""
QUARTER = 4
"""The maps of the sun and of water are smaller than the input by this factor."""
HALF = 2
"""The map of erased light is smaller than the input by this factor."""
LIGHT_FLOOR = 0.01
"""Added to display-linear light before its logarithm is taken."""


class SunNet(nn.Module):
    """``(N, 3, H, W)`` sRGB in [0, 1] -> three maps; H, W multiples of 32.

    ``(N, 3, H/4, W/4)``: logit of the sun's centre; log radius of its core in widths of the
    picture; logit of a sharp limb. ``(N, 3, H/2, W/2)``: log(clean + floor) - log(photo + floor)
    of display-linear R, G, B. ``(N, 1, H/4, W/4)``: logit of water, which mirrors the sun.
    """

    def __init__(self) -> None:
        super().__init__()
        self.encoder = Encoder(levels=4)
        half, quarter, eighth, sixteenth = LEVELS[:4]
        self.context = nn.Sequential(
            conv(sixteenth, 96, 1), StripContext(96, 64), Residual(96, 64), StripContext(96, 64)
        )
        self.to_eighth = Merge(96, eighth, 64)
        self.to_quarter = Merge(64, quarter, 48)
        self.to_half = Merge(48, half, 32)
        self.sun = nn.Sequential(conv(48, 32), nn.Conv2d(32, 3, 1))
        self.clean = nn.Sequential(conv(32, 32), nn.Conv2d(32, 3, 1))
        self.water = nn.Sequential(conv(48, 24), nn.Conv2d(24, 1, 1))
        nn.init.constant_(self.sun[1].bias, -4.0)
        nn.init.zeros_(self.clean[1].weight)  # starts as: nothing to erase
        nn.init.zeros_(self.clean[1].bias)

    def forward(self, image: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        half, quarter, eighth, sixteenth = self.encoder(image)
        x = self.to_quarter(self.to_eighth(self.context(sixteenth), eighth), quarter)
        return self.sun(x), self.clean(self.to_half(x, half)), self.water(x)


class SunMaps(nn.Module):
    """The shipped graph: ``image`` in; ``sun``, ``clean`` and ``water`` out.

    ``sun`` is ``(N, 3, H/4, W/4)``: probability, radius in widths, probability of a sharp limb.
    ``clean`` is ``(N, 3, H/2, W/2)``: log of clean over photo, display-linear with the floor.
    ``water`` is ``(N, 1, H/4, W/4)``: probability.
    """

    def __init__(self, network: SunNet) -> None:
        super().__init__()
        self.network = network

    def forward(self, image: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        out, clean, water = self.network(image)
        sun = torch.cat([out[:, :1].sigmoid(), out[:, 1:2].exp(), out[:, 2:].sigmoid()], 1)
        return sun, clean, water.sigmoid()


def _mean(error: Tensor, weight: Tensor) -> Tensor:
    """Weighted mean of an error (N, 3, h, w); weight (N, 1, h, w)."""
    return (error.abs() * weight).sum() / (3 * weight.sum()).clamp(min=1)


def _edges(error: Tensor, weight: Tensor) -> Tensor:
    """Weighted mean differences of an error (N, 3, h, w) between pixels, summed over distances.

    How bright a wide halo is cannot be known; where it ends can.
    """
    parts = []
    for apart in (1, 2, 4, 8, 16):
        for axis in (2, 3):
            size = error.shape[axis] - apart
            (here, there), (weighs_here, weighs_there) = (
                (x.narrow(axis, 0, size), x.narrow(axis, apart, size)) for x in (error, weight)
            )
            parts.append(_mean(there - here, torch.minimum(weighs_here, weighs_there)))
    return torch.stack(parts).sum()


def _focal(logit: Tensor, heat: Tensor, weight: Tensor) -> Tensor:
    """Focal loss of a heat map with soft negatives near peaks (Law and Deng 2018, "CornerNet")."""
    at, p = (heat > 0.999).float() * weight, torch.sigmoid(logit)
    hit = -at * (1 - p) ** 2 * F.logsigmoid(logit)
    miss = -(1 - at) * weight * (1 - heat) ** 4 * p**2 * F.logsigmoid(-logit)
    return (hit.sum() + miss.sum()) / at.sum().clamp(min=1)


def losses(maps: tuple[Tensor, ...], target: dict[str, Tensor]) -> dict[str, Tensor]:
    """Losses of a batch, each a scalar.

    Parameters
    ----------
    maps : (N, 3, h, w), (N, 3, 2h, 2w), (N, 1, h, w)
        What the network returns.
    target : dict
        ``heat`` (N, 1, h, w) in [0, 1], exactly 1 at a centre; ``heat_weight`` alike;
        ``radius``, ``sharp`` (N, 1, 1, 1), NaN where unknown; ``clean`` (N, 3, 2h, 2w) and
        ``clean_weight`` (N, 1, 2h, 2w); ``water`` (N, 1, h, w) in [0, 1] and ``water_weight``
        alike.
    """
    out, clean, water = maps
    heat, weight = target["heat"], target["heat_weight"]
    near = (heat > 0.6).float() * weight
    radius, sharp = target["radius"], target["sharp"]
    known_radius = near * torch.isfinite(radius)
    known_sharp = near * torch.isfinite(sharp)
    off = F.smooth_l1_loss(
        out[:, 1:2], torch.nan_to_num(radius).expand_as(heat), reduction="none", beta=0.1
    )
    limb = F.binary_cross_entropy_with_logits(
        out[:, 2:], torch.nan_to_num(sharp).expand_as(heat), reduction="none"
    )
    wrong = clean - target["clean"]
    wet = F.binary_cross_entropy_with_logits(water, target["water"], reduction="none")
    return {
        "centre": _focal(out[:, :1], heat, weight),
        "radius": (off * known_radius).sum() / known_radius.sum().clamp(min=1),
        "sharp": 0.3 * (limb * known_sharp).sum() / known_sharp.sum().clamp(min=1),
        "clean": 6 * _mean(wrong, target["clean_weight"]),
        "edges": 2.4 * _edges(wrong, target["clean_weight"]),
        "water": 2
        * (wet * target["water_weight"]).sum()
        / target["water_weight"].sum().clamp(min=1),
    }
