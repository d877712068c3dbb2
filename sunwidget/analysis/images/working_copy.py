"""The small copy of the photo on which every stage except the final matte works."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sunwidget.analysis.images.color_transfer import to_lab
from sunwidget.formats.color import LUMINANCE
from sunwidget.photo.photo import Photo

LONG_SIDE = 1024


def encode(linear: np.ndarray) -> np.ndarray:
    """Apply the sRGB transfer (IEC 61966-2-1) to linear values, clipped to [0, 1]."""
    x = np.clip(linear, 0, 1)
    return np.where(
        x <= 0.0031308, 12.92 * x, 1.055 * np.power(np.maximum(x, 1e-9), 1 / 2.4) - 0.055
    ).astype(np.float32)


def smoothstep(low: float, high: float, x: np.ndarray | float) -> np.ndarray:
    """Rise from 0 at ``low`` to 1 at ``high`` without corners (Hermite), in the type of ``x``."""
    t = np.clip((x - low) / (high - low), 0, 1)
    return np.asarray(t * t * (3 - 2 * t))


def log_odds(probability: np.ndarray) -> np.ndarray:
    """Return ln(p / (1 - p)), limited to that of one in a thousand."""
    return np.asarray(np.log((probability + 1e-3) / (1.001 - probability)))


def channel_sum(image: np.ndarray) -> np.ndarray:
    """Sum the channels of (…, 3), ten times as fast as NumPy's sum over a last axis of three."""
    return np.asarray(image[..., 0] + image[..., 1] + image[..., 2])


def saturation(encoded: np.ndarray) -> np.ndarray:
    """Return the HSI saturation of encoded colors (…, 3): 0 gray, 1 pure, and 1 for black."""
    # Separate planes are twenty times as fast as NumPy's minimum over a last axis of three.
    least = np.minimum(np.minimum(encoded[..., 0], encoded[..., 1]), encoded[..., 2])
    return np.asarray(1 - 3 * least / np.maximum(channel_sum(encoded), 1 / 255))


def code_values(
    photo: Photo, rows: slice = slice(None), columns: slice = slice(None)
) -> np.ndarray:
    """Return a part of the photo as encoded float32 in [0, 1], for any bit depth and profile.

    It is close enough to sRGB for edge detection, and does not decode a large photo first.
    """
    part = photo.encoded[rows, columns]
    if part.dtype.kind == "f":
        return encode(part)
    return np.multiply(part, 1 / np.iinfo(part.dtype).max, dtype=np.float32)


def shrink(image: np.ndarray, long_side: int) -> np.ndarray:
    """Shrink by area averaging until the longer side is at most ``long_side``; never enlarge."""
    height, width = image.shape[:2]
    scale = long_side / max(height, width)
    return image if scale >= 1 else resize(image, width * scale, height * scale)


def resize(image: np.ndarray, width: float, height: float) -> np.ndarray:
    """Resize to a size (rounded, at least 1 × 1): by area if smaller, bilinear if larger."""
    import cv2

    size = (max(1, round(width)), max(1, round(height)))
    if image.shape[1::-1] == size:
        return image
    smaller = size[0] * size[1] < image.shape[0] * image.shape[1]
    return cv2.resize(
        np.ascontiguousarray(image),
        size,
        interpolation=cv2.INTER_AREA if smaller else cv2.INTER_LINEAR,
    )


@dataclass(frozen=True, eq=False)
class Working:
    """The photo at ≤ 1024 px on its longer side.

    Parameters
    ----------
    linear : (h, w, 3) float32
        Linear Rec. 709.
    encoded : (h, w, 3) float32
        The same, sRGB-encoded, [0, 1].
    guide : (h, w, 3) float32
        The file's own code values, [0, 1], as ``code_values`` returns them at full size.
    zoom : (x, y)
        Pixels of the photo per working pixel.
    """

    linear: np.ndarray
    encoded: np.ndarray
    guide: np.ndarray
    zoom: tuple[float, float]

    @classmethod
    def of(cls, photo: Photo, long_side: int = LONG_SIDE) -> Working:
        """Shrink a photo; negative light becomes 0."""
        linear = np.maximum(photo.resized(photo.size_within(long_side)), 0)
        if photo.encoded.dtype.kind == "f":
            guide = encode(linear)
        else:
            guide = shrink(photo.encoded, long_side).astype(np.float32)
            guide *= np.float32(1 / np.iinfo(photo.encoded.dtype).max)
        zoom = (photo.width / linear.shape[1], photo.height / linear.shape[0])
        return cls(linear, encode(linear), guide, zoom)

    def shrunk(self, long_side: int) -> Working:
        """Return a smaller copy of the same photo; never a larger one."""
        if max(self.linear.shape[:2]) <= long_side:
            return self
        linear = shrink(self.linear, long_side)
        ratio = self.width / linear.shape[1], self.height / linear.shape[0]
        return Working(
            linear,
            encode(linear),
            shrink(self.guide, long_side),
            (self.zoom[0] * ratio[0], self.zoom[1] * ratio[1]),
        )

    @property
    def height(self) -> int:
        """Rows."""
        return int(self.linear.shape[0])

    @property
    def width(self) -> int:
        """Columns."""
        return int(self.linear.shape[1])

    @cached_property
    def bytes(self) -> np.ndarray:
        """sRGB-encoded 8-bit copy, RGB."""
        return np.round(self.encoded * 255).astype(np.uint8)

    @cached_property
    def lab(self) -> np.ndarray:
        """lαβ (h, w, 3) float64 of color_transfer.py; cached, since every correction uses it."""
        return to_lab(self.linear)

    @property
    def luminance(self) -> np.ndarray:
        """Linear luminance (h, w) float32."""
        return self.linear @ LUMINANCE
