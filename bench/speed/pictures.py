"""What is measured on: the bundled sample at any size, with grain so that nothing is flat."""

from __future__ import annotations

import functools
import math
from pathlib import Path

import cv2
import numpy as np

import sunwidget as sw


def picture(width: int, height: int) -> np.ndarray:
    """Return the sample at another size, (height, width, 3) uint8."""
    small = sw.sample("coast").preview(4096)
    large = cv2.resize(small, (width, height), interpolation=cv2.INTER_CUBIC)
    random = np.random.default_rng(1)
    for top in range(0, height, 256):
        rows = large[top : top + 256]
        grain = random.integers(-2, 3, (*rows.shape[:2], 1), dtype=np.int16)
        rows[:] = np.clip(rows + grain, 0, 255)
    return large


@functools.lru_cache(maxsize=2)
def analysed(width: int, height: int) -> sw.Scene:
    """Return ``picture`` analysed; several groups draw the same one."""
    return sw.analyze(picture(width, height))


def size_of(megapixels: float) -> tuple[int, int]:
    """Width and height of a photo of the shape 3:2."""
    height = max(8, round(math.sqrt(megapixels * 1e6 / 1.5)))
    return round(1.5 * height), height


def photo_file(folder: Path, megapixels: float) -> Path:
    """Write a photo of about so many pixels as JPEG, as a camera's."""
    path = folder / f"photo-{megapixels:g}.jpg"
    pixels = picture(*size_of(megapixels))[..., ::-1]
    cv2.imwrite(str(path), pixels, [cv2.IMWRITE_JPEG_QUALITY, 92])
    return path
