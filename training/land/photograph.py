"""From a world's radiance to its photo: white balance, exposure, a camera's curve, noise."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

Random = np.random.Generator
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722], np.float32)


@dataclass(frozen=True)
class Box:
    """A part of a picture, and the size that it is brought to, in pixels."""

    top: int
    left: int
    height: int
    width: int
    rows: int
    columns: int
    mirrored: bool

    def of(self, picture: np.ndarray, interpolation: int = cv2.INTER_LINEAR) -> np.ndarray:
        """Return the part of a picture (H, W, ...), brought to size."""
        part = picture[self.top : self.top + self.height, self.left : self.left + self.width]
        if self.mirrored:
            part = part[:, ::-1]
        part = np.ascontiguousarray(part)
        return cv2.resize(part, (self.columns, self.rows), interpolation=interpolation)


def box(random: Random, shape: tuple[int, int], rows: int, columns: int) -> Box:
    """Return a part of the wanted proportions, near the middle, most of the picture."""
    height, width = shape
    scale = min(height / rows, width / columns) * (
        1 if random.random() < 0.4 else random.uniform(0.65, 1)
    )
    high, wide = int(rows * scale), int(columns * scale)
    spare = height - high, width - wide
    top = int(spare[0] * np.clip(random.normal(0.5, 0.2), 0, 1))
    left = int(spare[1] * np.clip(random.normal(0.5, 0.2), 0, 1))
    return Box(top, left, high, wide, rows, columns, bool(random.random() < 0.5))


def glare(light: np.ndarray, random: Random) -> np.ndarray:
    """Return the light spread by a lens round what is very bright."""
    share = np.exp(random.uniform(np.log(3e-4), np.log(8e-3)))
    width = light.shape[1]
    bright = np.minimum(light, 3e3)
    wide = cv2.GaussianBlur(bright, (0, 0), width * 0.12)
    near = cv2.GaussianBlur(bright, (0, 0), width * 0.015)
    return light + share * (wide + 3 * near)


def develop(light: np.ndarray, random: Random) -> np.ndarray:
    """Return a camera's picture (H, W, 3) uint8 sRGB of radiance (H, W, 3)."""
    mean = np.exp(np.log(np.maximum(light, 1e-6)).mean((0, 1)))
    grey = np.exp(np.log(mean).mean())
    balance = (grey / mean) ** random.uniform(0.15, 0.85) * np.exp(random.normal(0, 0.06, 3))
    light = light * balance.astype(np.float32)
    if random.random() < 0.35:  # evenings warmer, or colder, than any model's
        tint = random.normal(0, 0.3) * np.array([1, 0, -1]) + random.normal(0, 0.08, 3)
        light = light * np.exp(tint).astype(np.float32)
    luminance = light @ _LUMINANCE
    key = 0.16 * 2 ** random.normal(0.1, 0.75)
    if random.random() < 0.5:
        light = light * np.float32(key / np.exp(np.log(np.maximum(luminance, 1e-6)).mean()))
    else:  # for the bright part
        light = light * np.float32(2 ** random.normal(0.0, 0.5) / np.percentile(luminance, 88))
    linear = _tone(light, random)
    grey = linear @ _LUMINANCE
    linear = grey[..., None] + random.uniform(0.8, 1.35) * (linear - grey[..., None])
    rows, columns = linear.shape[:2]
    y, x = np.mgrid[-1 : 1 : rows * 1j, -1 : 1 : columns * 1j]
    if random.random() < 0.4:
        linear = linear * (1 - random.uniform(0, 0.25) * (x * x + y * y) / 2)[..., None]
    linear = np.clip(linear, 0, 1).astype(np.float32)
    if random.random() < 0.6:
        noise = random.uniform(0.001, 0.02)
        linear = linear + random.normal(0, 1, linear.shape) * noise * np.sqrt(linear + 0.01)
    picture = _encode(np.clip(linear, 0, 1))
    if random.random() < 0.5:  # contrast about the middle
        bend = random.uniform(-0.12, 0.22)
        picture = picture + bend * (picture - 0.5) * (1 - (2 * picture - 1) ** 2)
    picture = np.rint(np.clip(picture, 0, 1) * 255).astype(np.uint8)
    if random.random() < 0.3:
        picture = cv2.GaussianBlur(picture, (0, 0), random.uniform(0.4, 1.0))
    if random.random() < 0.6:
        quality = int(random.integers(45, 96))
        _, data = cv2.imencode(".jpg", picture[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, quality])
        picture = cv2.imdecode(data, cv2.IMREAD_COLOR)[..., ::-1]
    return np.ascontiguousarray(picture)


def _tone(light: np.ndarray, random: Random) -> np.ndarray:
    """Return display-linear light, 0 to 1: one of several shoulders."""
    kind = random.integers(3)
    if kind == 0:
        return 1 - np.exp(-light * random.uniform(0.9, 1.4))
    if kind == 1:  # Reinhard's, with a white point
        white = random.uniform(1.5, 6.0)
        return np.minimum(light * (1 + light / white**2) / (1 + light), 1.0)
    limit = random.uniform(0.6, 0.95)  # straight, then round
    over = np.maximum(light - limit, 0)
    return np.minimum(light, limit) + (1 - limit) * (1 - np.exp(-over / (1 - limit)))


def _encode(linear: np.ndarray) -> np.ndarray:
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
