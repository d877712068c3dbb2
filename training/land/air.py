"""The air in front of a world: clear, hazy or foggy, and its share of each pixel's light."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from sunwidget.formats.color import LUMINANCE
from training.land.camera import rays, to_sun, up

Random = np.random.Generator
_RAYLEIGH = np.array([0.0058, 0.0135, 0.0331], np.float32)  # 1 / km
_VISIBILITIES = ((40.0, 300.0), (3.0, 40.0), (0.06, 3.0))  # km: clear, hazy, foggy
_ODDS = (0.55, 0.28, 0.17)  # of the three; with more fog the network sees it everywhere
_LIES, _FOG_LIES = 0.3, 0.7  # odds that haze, or fog, thins out upwards
_ABOVE_FOG = 0.02  # 1 / km of aerosol
_BEHIND = 200.0  # km of air in front of the sky
_DEEPEST = 8.0  # times as long as level: the most that a path downwards counts
_GLOWS = 0.6  # odds that the air is brighter towards the sun


@dataclass(frozen=True)
class Air:
    """Air by its visibility and the height in which it thins out to 1/e (km; inf: nowhere)."""

    visibility: float
    height: float

    @classmethod
    def drawn(cls, random: Random) -> Air:
        """Return air by chance."""
        low, high = _VISIBILITIES[random.choice(3, p=_ODDS)]
        visibility = float(np.exp(random.uniform(np.log(low), np.log(high))))
        if random.random() > (_LIES if visibility > _VISIBILITIES[2][1] else _FOG_LIES):
            return cls(visibility, np.inf)
        height = np.exp(random.uniform(np.log(0.01), np.log(0.6))) * max(visibility, 0.3) ** 0.5
        return cls(visibility, float(height))

    def through(self, away: np.ndarray, climb: np.ndarray) -> np.ndarray:
        """Return the share of light that passes, (H, W, 3).

        ``away`` is the distance in km, inf in the sky; ``climb`` the sine of the elevation of the
        view. Level air hides no sky: it is what the sky's light came through.
        """
        sky = ~np.isfinite(away)
        aerosol = 3.0 / self.visibility
        if np.isinf(self.height):
            depth = np.where(sky, 0, away)[..., None] * (_RAYLEIGH + np.float32(aerosol))
            return np.exp(-depth)
        length = np.where(sky, _BEHIND, away)
        rate = climb / self.height
        rate = np.where(np.abs(rate) < 1e-4, 1e-4, rate)
        path = (1 - np.exp(np.clip(-length * rate, -30, 8))) / rate
        fog = aerosol * np.minimum(path, _DEEPEST * length)
        clear = np.where(sky, 0, away)[..., None] * (_RAYLEIGH + np.float32(_ABOVE_FOG))
        return np.exp(-clear - fog[..., None])


def with_air(
    world: dict[str, np.ndarray], sun: int, random: Random
) -> tuple[np.ndarray, np.ndarray]:
    """Return a world's radiance with air in front of it, and the air's share of the luminance.

    The light of the air is that of the world's sky at the horizon, by columns, somewhat brighter or
    darker, and brighter towards the sun.

    Parameters
    ----------
    world : dict
        As ``render.measure`` returns it, with ``suns`` and ``camera``.
    sun : int
        Index of the picture.
    random : Generator

    Returns
    -------
    radiance : (H, W, 3) float32
    share : (H, W) float32
        In [0, 1]; 1 in the sky.
    """
    light, log_depth = (world[key].astype(np.float32) for key in ("light", "depth"))
    light = light[sun]
    camera = world["camera"]
    view, length = rays(camera, log_depth.shape)
    sky = ~np.isfinite(log_depth)
    away = np.where(sky, np.inf, 2.0 ** np.minimum(log_depth, 20) / 1000 * length)
    through = Air.drawn(random).through(away, view @ up(camera)).astype(np.float32)
    horizon = (world["air"][sun] / world["scale"][sun]).astype(np.float32)
    air = cv2.resize(horizon[None], (light.shape[1], 1), interpolation=cv2.INTER_LINEAR)
    air = air * np.float32(np.exp(random.normal(0, 0.2)))
    _, elevation, covered = (float(v) for v in world["suns"][sun])
    if not covered and elevation > -0.03 and random.random() < _GLOWS:
        angle = np.arccos(np.clip(view @ to_sun(camera, world["suns"][sun]), -1, 1))
        width = np.exp(random.uniform(np.log(0.1), np.log(0.6)))
        glow = 1 + random.uniform(0, 3) * np.exp(-angle / width)
        air = air * glow[..., None].astype(np.float32)
    added = air * (1 - through)
    hazy = (light * through + added).astype(np.float32)
    share = (added @ LUMINANCE) / np.maximum(hazy @ LUMINANCE, 1e-9)
    return hazy, np.where(sky, 1, share).astype(np.float32)
