"""LandNet: how the land lies, what it is made of, and what light falls on it.

The sky network's encoder and decoder, begun from its weights, under heads for everything that a
relit picture needs. Any size of multiples of 32, proportions kept.
"""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from training.model import SkyNet, conv
from training.worlds import CLASSES

STRIDE = 32
"""Height and width of the input must be multiples of this (pixels)."""
HALF = 2
"""The maps but ``sunlit`` and ``sky`` are smaller than the input by this factor."""
BEARINGS = 8
"""Directions, from the camera's heading on clockwise, for which ``rise`` is told."""
SOFTNESS = 0.08
"""Sine of the sun's height over which it rises above what hides it."""
MATTER = len(CLASSES)


class LandNet(SkyNet):
    """``(N, 3, H, W)`` sRGB in [0, 1] -> a dict of maps and of what is one number a picture.

    ``sky``, ``sunlit`` (N, 1, H, W) logits; at half the size ``normal`` (N, 3, h, w) unit vectors
    to the camera's right, up and towards it; ``depth`` (N, 1, h, w) log2 of metres but for a
    constant; ``rise`` (N, 8, h, w) sine of the height from which a sun in each of ``BEARINGS``
    reaches the place; ``openness`` (N, 1, h, w) and ``matter`` (N, 8, h, w) logits; ``view``
    (N, 8): row of the horizon in heights from the middle down, its slope, log2 of the focal length
    in heights, three numbers of the sun's direction (right, up, ahead), logit of sunshine, and log
    variance of the direction.
    """

    def __init__(self) -> None:
        super().__init__()
        self.shape = nn.Sequential(conv(64, 64), nn.Conv2d(64, 4 * 4, 3, padding=1))
        self.kind = nn.Sequential(conv(64, 48), nn.Conv2d(48, 4 * (MATTER + 1), 3, padding=1))
        self.rise = nn.Sequential(conv(64, 48), nn.Conv2d(48, 4 * BEARINGS, 3, padding=1))
        self.lit = nn.Sequential(conv(32, 32), nn.Conv2d(32, 4, 3, padding=1))
        self.view = nn.Sequential(nn.Linear(224 + 96, 128), nn.ReLU(), nn.Linear(128, 8))

    def maps(self, image: Tensor) -> dict[str, Tensor]:
        half = self.stem(image * 4.0 - 2.0)
        quarter = self.quarter(half)
        eighth = self.eighth(quarter)
        sixteenth = self.sixteenth(eighth)
        deep = self.deep(sixteenth)
        x16 = self.to_sixteenth(deep, sixteenth)
        x4 = self.to_quarter(self.to_eighth(x16, eighth), quarter)
        x2 = self.to_half(x4, half)
        shape = F.pixel_shuffle(self.shape(x4), 2)
        kind = F.pixel_shuffle(self.kind(x4), 2)
        rows = x16.shape[2]
        # Where in the picture something is matters for the horizon: means of upper and lower part.
        up, down = x16[:, :, : rows // 2].mean((2, 3)), x16[:, :, rows // 2 :].mean((2, 3))
        seen = torch.cat([deep.mean((2, 3)), 0.5 * (up - down)], 1)
        return {
            "sky": F.pixel_shuffle(self.head(x2), 2),
            "sunlit": F.pixel_shuffle(self.lit(x2), 2),
            "normal": F.normalize(shape[:, :3], dim=1, eps=1e-4),
            "depth": 4 * shape[:, 3:] + 5,
            "rise": F.pixel_shuffle(self.rise(x4), 2) + 0.3,
            "openness": kind[:, :1],
            "matter": kind[:, 1:],
            "view": self.view(seen),
        }

    def forward(self, image: Tensor) -> Tensor:
        return self.maps(image)["sky"]


class LandMaps(nn.Module):
    """The shipped graph: ``image`` in; maps of ``LandNet``, logits made shares in [0, 1]."""

    OUTPUTS = ("sky", "sunlit", "normal", "depth", "rise", "openness", "matter", "view")

    def __init__(self, network: LandNet) -> None:
        super().__init__()
        self.network = network

    def forward(self, image: Tensor) -> tuple[Tensor, ...]:
        m = self.network.maps(image)
        return (
            m["sky"].sigmoid(), m["sunlit"].sigmoid(), m["normal"], m["depth"],
            m["rise"], m["openness"].sigmoid(), m["matter"].softmax(1), m["view"],
        )  # fmt: skip


def towards(rise: Tensor, azimuth: Tensor) -> Tensor:
    """Return the height at one bearing of each picture, (N, 1, h, w); ``azimuth`` (N,) radians."""
    at = azimuth[:, None] / (2 * torch.pi) * BEARINGS - torch.arange(BEARINGS, device=rise.device)
    apart = (at + BEARINGS / 2) % BEARINGS - BEARINGS / 2
    weight = (1 - apart.abs()).clamp(min=0)
    return (rise * weight[:, :, None, None]).sum(1, keepdim=True)


def losses(out: dict[str, Tensor], target: dict[str, Tensor]) -> dict[str, Tensor]:
    """Return the losses of a batch of worlds, each a scalar.

    ``target`` holds, at the input's size: ``sky``, ``sunlit`` (N, 1, H, W) in [0, 1]; ``land``
    alike, 1 where light is asked for; at half of it ``solid`` (N, 1, h, w), 1 on land, ``normal``,
    ``depth`` (0 in the sky), ``openness``, ``matter`` (N, h, w) int; ``view`` (N, 7) without the
    variance. ``passed`` (N, 2, 1, h, w) is what of two suns reaches each place, ``suns`` (N, 2, 3)
    their azimuths, sines of the elevation, and whether anything is known of them.
    """
    land, solid = target["land"], target["solid"]
    lit = F.binary_cross_entropy_with_logits(out["sunlit"], target["sunlit"], reduction="none")
    count = solid.sum().clamp(min=1)
    cosine = (out["normal"] * target["normal"]).sum(1, keepdim=True)
    level = (out["depth"] - target["depth"]) * solid
    here = solid.sum((1, 2, 3), keepdim=True).clamp(min=1)
    shift = level.sum((1, 2, 3), keepdim=True) / here
    apart = (level - shift) * solid
    steps = sum(
        (apart.diff(dim=d).abs() * solid.diff(dim=d).abs().lt(0.5)).clamp(max=2).mean()
        for d in (2, 3)
    )
    dry = solid * (target["matter"] > 1)[:, None]
    passed = 0.0
    for i in range(2):
        azimuth, height, known = target["suns"][:, i].unbind(1)
        level_ = (height[:, None, None, None] - towards(out["rise"], azimuth)) / SOFTNESS
        miss = F.binary_cross_entropy_with_logits(level_, target["passed"][:, i], reduction="none")
        weight = dry * known[:, None, None, None]
        passed = passed + (miss * weight).sum() / weight.sum().clamp(min=1)
    open_ = (out["openness"].sigmoid() - target["openness"]).abs() * solid
    view, truth = out["view"], target["view"]
    way, shining = truth[:, 3:6], truth[:, 6:7]
    spread = view[:, 7:].clamp(-6, 2)
    off = ((view[:, 3:6] - way) ** 2).sum(1, keepdim=True)
    return {
        "sunlit": 2 * (lit * land).sum() / land.sum().clamp(min=1),
        "sky": F.binary_cross_entropy_with_logits(out["sky"], target["sky"]),
        "normal": 2 * ((1 - cosine) * solid).sum() / count,
        "depth": 0.7 * (apart.abs()).sum() / count + 0.5 * steps + 0.03 * shift.abs().mean(),
        "rise": 0.7 * passed,
        "openness": 2 * open_.sum() / count,
        "matter": 0.5 * F.cross_entropy(out["matter"], target["matter"]),
        "view": F.smooth_l1_loss(view[:, :3], truth[:, :3], beta=0.1)
        + 0.1 * F.binary_cross_entropy_with_logits(view[:, 6:7], shining)
        + 0.1 * (shining * (off * torch.exp(-spread) + 3 * spread) / 2).mean(),
    }
