"""LandNet: how the land lies, what it is made of, and what light falls on it.

The sky network's encoder, with what it knows of the world, and a decoder with skips up to 1/2 under
heads for everything that a relit picture needs. Any size of multiples of 32, proportions kept.
"""

from __future__ import annotations

import torch
import torch.nn.functional as F
from torch import Tensor, nn

from training.encoder import LEVELS, Encoder
from training.model import Merge, Residual, StripContext, conv
from training.worlds import CLASSES

STRIDE = 32
"""Height and width of the input must be multiples of this (pixels)."""
HALF = 2
"""The maps but ``sunlit`` and ``sky`` are smaller than the input by this factor."""
TRANSFER = 12
"""Functions of a sun's direction of which ``transfer`` holds the shares (``sun_basis``)."""
MATTER = len(CLASSES)
AIR = 48
"""Channels of the head of the air's light."""
SUN_TURNS = torch.arange(-150.0, 181, 30)
SUN_HEIGHTS = torch.tensor([-2.0, 2.0, 8.0, 18.0, 35.0, 60.0])
"""Azimuths from the camera's heading and elevations of ``sun``, degrees; as in
sunwidget/analysis/fit/confidence.py."""
SUNS = len(SUN_TURNS) * len(SUN_HEIGHTS)


class LandNet(nn.Module):
    """``(N, 3, H, W)`` sRGB in [0, 1] -> a dict of maps and of what is one number a picture.

    ``sky``, ``sunlit`` (N, 1, H, W) logits; at half the size ``normal`` (N, 3, h, w) unit vectors
    to the camera's right, up and towards it; ``depth`` (N, 1, h, w) log2 of metres but for a
    constant; ``transfer`` (N, 12, h, w), whose product with ``sun_basis`` is the expected share of
    any sun's light on the place, relative to the light on a surface that faces it; ``facing``
    (N, 1, h, w) logits of the cosine between the normal and the photo's sun, where it shines;
    ``air`` (N, 1, h, w) logits of the air's share of the light;
    ``matter`` (N, 8, h, w) logits; ``view`` (N, 4): row of the horizon in heights from the middle
    down, its slope, log2 of the focal length in heights, and logit of sunshine; ``sun`` (N, 72)
    logits of where the photo's sun is, by ``SUN_HEIGHTS`` and within each by ``SUN_TURNS``.
    """

    def __init__(self) -> None:
        super().__init__()
        self.encoder = Encoder()
        half, quarter, eighth, sixteenth, deep = LEVELS
        self.context = StripContext(deep, 96)
        self.to_sixteenth = Merge(deep, sixteenth, 96)
        self.wide = nn.Sequential(StripContext(96, 64), Residual(96, 64), StripContext(96, 64))
        self.to_eighth = Merge(96, eighth, 64)
        self.to_quarter = Merge(64, quarter, 64)
        self.to_half = Merge(64, half, 32)
        self.head = nn.Conv2d(32, 4, 3, padding=1)  # four sub-pixels, shuffled to full resolution
        self.shape = nn.Sequential(conv(64, 64), nn.Conv2d(64, 4 * 4, 3, padding=1))
        self.kind = nn.Sequential(conv(64, 48), nn.Conv2d(48, 4 * MATTER, 3, padding=1))
        self.transfer = nn.Sequential(conv(64, 64), nn.Conv2d(64, 4 * TRANSFER, 3, padding=1))
        self.lit = nn.Sequential(conv(32, 32), nn.Conv2d(32, 4, 3, padding=1))
        self.facing = nn.Sequential(conv(64, 32), nn.Conv2d(32, 4, 3, padding=1))
        self.air = nn.Sequential(
            conv(64, AIR), Residual(AIR, AIR), Residual(AIR, AIR), nn.Conv2d(AIR, 4, 3, padding=1)
        )
        self.view = nn.Sequential(
            nn.Linear(4 * 96 + 2 * deep, 64), nn.ReLU(), nn.Dropout(0.5), nn.Linear(64, 4)
        )
        self.sun = nn.Sequential(
            nn.Linear(4 * 96 + 3 * deep, 64), nn.ReLU(), nn.Dropout(0.5), nn.Linear(64, SUNS)
        )

    def features(self, image: Tensor) -> tuple[Tensor, ...]:
        """Return the features at 1/2, 1/4, 1/8, 1/16 and 1/32; the last two know the picture."""
        half, quarter, eighth, sixteenth, deep = self.encoder(image)
        deep = self.context(deep)
        return half, quarter, eighth, self.wide(self.to_sixteenth(deep, sixteenth)), deep

    def fine(self, image: Tensor) -> Tensor:
        """Return the features at 1/4, (N, 64, h, w), which the heads of maps see."""
        _, quarter, eighth, x16, _ = self.features(image)
        return self.to_quarter(self.to_eighth(x16, eighth), quarter)

    def seen(self, image: Tensor) -> tuple[Tensor, Tensor]:
        """Return what the heads of the horizon and of the sun see, (N, 800) and (N, 1008)."""
        *_, x16, deep = self.features(image)
        return moments(x16, deep), sides(x16, deep)

    def maps(self, image: Tensor) -> dict[str, Tensor]:
        half, quarter, eighth, x16, deep = self.features(image)
        x4 = self.to_quarter(self.to_eighth(x16, eighth), quarter)
        x2 = self.to_half(x4, half)
        shape = F.pixel_shuffle(self.shape(x4), 2).float()
        return {
            "sky": F.pixel_shuffle(self.head(x2), 2),
            "sunlit": F.pixel_shuffle(self.lit(x2), 2),
            "normal": F.normalize(shape[:, :3], dim=1, eps=1e-4),
            "depth": 4 * shape[:, 3:] + 5,
            "transfer": F.pixel_shuffle(self.transfer(x4), 2),
            "facing": F.pixel_shuffle(self.facing(x4), 2),
            "matter": F.pixel_shuffle(self.kind(x4), 2),
            "air": F.pixel_shuffle(self.air(x4), 2),
            "view": self.view(moments(x16, deep)),
            "sun": self.sun(sides(x16, deep)),
        }

    def forward(self, image: Tensor) -> Tensor:
        return self.maps(image)["sky"]


def _rows(x: Tensor) -> Tensor:
    """Return the rows' places from -1 on top to 1, (1, 1, H, 1); also in a graph of any size."""
    number = torch.ones_like(x[:1, :1, :, :1]).cumsum(2) - 1
    return 2 * number / number[:, :, -1:] - 1


def _columns(x: Tensor) -> Tensor:
    """Return the columns' places from -1 on the left to 1, (1, 1, 1, W)."""
    return _rows(x.transpose(2, 3)).transpose(2, 3)


def moments(x16: Tensor, deep: Tensor) -> Tensor:
    """Return what a picture holds, and how high up: (N, 4 * 96 + 2 * 208).

    Means of the features at 1/16 and 1/32, weighed with Legendre polynomials of the row.
    """
    y, y_deep = _rows(x16), _rows(deep)
    weights = (torch.ones_like(y), y, 1.5 * y * y - 0.5, 2.5 * y**3 - 1.5 * y)
    parts = [(x16 * weight).mean((2, 3)) for weight in weights]
    return torch.cat([*parts, deep.mean((2, 3)), (deep * y_deep).mean((2, 3))], 1)


def sides(x16: Tensor, deep: Tensor) -> Tensor:
    """Return what a picture holds, how high up and how far aside: (N, 4 * 96 + 3 * 208)."""
    y, x = _rows(x16), _columns(x16)
    parts = [(x16 * weight).mean((2, 3)) for weight in (torch.ones_like(y), y, x, y * x)]
    y, x = _rows(deep), _columns(deep)
    parts += [(deep * weight).mean((2, 3)) for weight in (torch.ones_like(y), y, x)]
    return torch.cat(parts, 1)


class LandMaps(nn.Module):
    """The shipped graph: ``image`` in; maps of ``LandNet``, logits made shares in [0, 1]."""

    OUTPUTS = (
        "sky", "sunlit", "normal", "depth", "transfer", "facing", "matter", "view", "sun",
        "air",
    )  # fmt: skip

    def __init__(self, network: LandNet) -> None:
        super().__init__()
        self.network = network

    def forward(self, image: Tensor) -> tuple[Tensor, ...]:
        m = self.network.maps(image)
        return (
            m["sky"].sigmoid(), m["sunlit"].sigmoid(), m["normal"], m["depth"],
            m["transfer"], m["facing"].sigmoid(), m["matter"].softmax(1), m["view"],
            m["sun"].softmax(1), m["air"].sigmoid(),
        )  # fmt: skip


def sun_basis(suns: Tensor) -> Tensor:
    """Return the basis functions of directions that describe the light on land, (..., 12).

    ``suns`` (..., 3) are unit vectors to the right, up, and ahead along the camera's heading.
    Linear ones for the cosine, square ones for shadows, and roots, since low suns set fast.
    """
    x, up, y = suns.unbind(-1)
    z = up.clamp(min=0)
    low = z.sqrt()
    along, across = x * x - y * y, 2 * x * y
    linear = [torch.ones_like(x), x, y, z]
    roots = [low, x * low, y * low]
    squares = [along, across, along * z, across * z, z * z]
    return torch.stack(linear + roots + squares, -1)


def openness(transfer: Tensor) -> Tensor:
    """Return the share of an even sky's light that reaches each place, (N, 1, h, w).

    The mean over the sky, weighed as on lying ground, of what its parts throw there.
    """
    one, height, root, square = (transfer[:, i : i + 1] for i in (0, 3, 4, 11))
    return 2 * one + height + 4 / 3 * root + 2 / 3 * square


def losses(out: dict[str, Tensor], target: dict[str, Tensor]) -> dict[str, Tensor]:
    """Return the losses of a batch of worlds, each a scalar.

    ``target`` holds, at the input's size: ``sky``, ``sunlit`` (N, 1, H, W) in [0, 1]; ``land``
    alike, 1 where light is asked for; at half of it ``solid`` (N, 1, h, w), 1 on land, ``normal``,
    ``depth`` (0 in the sky), ``openness``, ``air``, ``facing``, ``faced`` (weight of ``facing``,
    [0, 1]), ``matter`` (N, h, w) int; ``view`` (N, 4), of sunshine 0 or 1; ``sun`` (N, 72) shares.
    ``passed`` (N, 2, 1, h, w) is what of two suns falls on each place, ``suns`` (N, 2, 4) their
    directions, and whether anything is known of them.
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
        direction, known = target["suns"][:, i, :3], target["suns"][:, i, 3]
        predicted = torch.einsum("nkhw,nk->nhw", out["transfer"], sun_basis(direction))[:, None]
        predicted = F.leaky_relu(predicted, 0.1)  # less than no light is none
        weight = dry * known[:, None, None, None]
        miss = (predicted - target["passed"][:, i]) ** 2
        passed = passed + (miss * weight).sum() / weight.sum().clamp(min=1)
    open_ = (openness(out["transfer"]) - target["openness"]).abs() * solid
    cosine_ = F.binary_cross_entropy_with_logits(out["facing"], target["facing"], reduction="none")
    view, truth = out["view"], target["view"]
    shining = truth[:, 3]
    where = -(target["sun"] * out["sun"].log_softmax(1)).sum(1)
    return {
        "sunlit": 2 * (lit * land).sum() / land.sum().clamp(min=1),
        "sky": F.binary_cross_entropy_with_logits(out["sky"], target["sky"]),
        "normal": 2 * ((1 - cosine) * solid).sum() / count,
        "depth": 0.7 * (apart.abs()).sum() / count + 0.5 * steps + 0.03 * shift.abs().mean(),
        "transfer": 8 * passed,
        "openness": 2 * open_.sum() / count,
        "matter": 0.5 * F.cross_entropy(out["matter"], target["matter"]),
        "view": F.smooth_l1_loss(view[:, :3], truth[:, :3], beta=0.1)
        + 0.1 * F.binary_cross_entropy_with_logits(view[:, 3], shining),
        "facing": (cosine_ * target["faced"]).sum() / target["faced"].sum().clamp(min=1),
        "sun": 0.3 * (shining * where).sum() / shining.sum().clamp(min=1),
        "air": air_loss(out["air"], target["air"], solid),
    }


def air_loss(air: Tensor, share: Tensor, solid: Tensor) -> Tensor:
    """Return the loss of the air's share of the light, logits against [0, 1], (N, 1, h, w)."""
    miss = F.binary_cross_entropy_with_logits(air, share.clamp(0, 1), reduction="none")
    miss = miss + 2 * (air.sigmoid() - share).abs()
    return (miss * solid).sum() / solid.sum().clamp(min=1)
