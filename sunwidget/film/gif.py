"""Animated GIFs of a photograph, with palettes that follow the light and static dithering.

A GIF has 256 colors per frame. One palette for a whole sunset causes banding in part of the film;
independent palettes, or error diffusion, cause flicker. Here each frame's palette starts from the
previous one and moves to the new colors (k-means with a warm start, Lloyd 1982), the dithering
matrix (Bayer 1973) is static, and a pixel that would hardly change keeps its color, which also
makes the file smaller.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

_COLOURS = 255
_KEPT = 255  # the index of an unchanged pixel
# Color difference, in levels, below which a pixel keeps its color.
_UNSEEN = 3.5
_SAMPLES = 8000
# Cost of the grain of a mixture of two colors, relative to the same amount of color error.
_GRAIN = 0.4
_NEAREST = 6  # candidate palette entries for a mixture


def write_gif(
    frames: Iterator[NDArray[np.uint8]], file: BinaryIO, hundredths: list[int], *, forever: bool
) -> None:
    """Write frames as they arrive; only one is held in memory.

    Parameters
    ----------
    frames : iterator of (H, W, 3) uint8 arrays
        sRGB.
    file : binary file
        The file to write.
    hundredths : list of int
        Duration of each frame in hundredths of a second.
    forever : bool
        Repeat without end; otherwise stop at the last frame.
    """
    from PIL import Image
    from PIL.GifImagePlugin import getdata

    palette: _Palette | None = None
    shown: NDArray[np.float32] | None = None
    for i, frame in enumerate(frames):
        height, width = frame.shape[:2]
        if palette is None:
            palette = _Palette(frame)
            file.write(b"GIF89a" + struct.pack("<HHBBB", width, height, 0x70, 0, 0))
            if forever:
                file.write(b"!\xff\x0bNETSCAPE2.0\x03\x01\x00\x00\x00")
        else:
            palette.follow(frame)
        indices = palette.dither(frame)
        new = palette.colors[indices]
        if shown is not None:
            kept = ((new - shown) ** 2).sum(axis=-1) < _UNSEEN**2
            indices[kept] = _KEPT
            new[kept] = shown[kept]
        shown = new
        picture = Image.fromarray(indices)
        picture.putpalette(palette.colors.astype(np.uint8).tobytes() + bytes(3))
        blocks = getdata(
            picture,
            transparency=_KEPT,
            duration=hundredths[i] * 10,
            disposal=1,
            include_color_table=True,
        )
        file.writelines(blocks)
    file.write(b";")


class _Palette:
    """255 colors that follow a film's frames."""

    def __init__(self, frame: NDArray[np.uint8]) -> None:
        from PIL import Image

        sample = _sample(frame)
        cut = Image.fromarray(sample[None]).quantize(_COLOURS).getpalette() or []
        rgb = np.array(cut, np.uint8).reshape(-1, 3)[:_COLOURS]
        # With few colors in the picture, ``_move`` places the remaining entries.
        rgb = np.pad(rgb, ((0, _COLOURS - len(rgb)), (0, 0)), mode="edge")
        self.colors = rgb.astype(np.float32)
        self._move(sample, rounds=6)

    def follow(self, frame: NDArray[np.uint8]) -> None:
        """Move to the colors of the next frame."""
        self._move(_sample(frame), rounds=2)

    def dither(self, frame: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """Return the index of each pixel, (H, W): two colors mixed by a static threshold."""
        height, width = frame.shape[:2]
        threshold = np.tile(_BAYER, (-(-height // 8), -(-width // 8)))[:height, :width]
        # Pairs are searched for 6-bit colors; the rounding to 6 bits is dithered as well.
        rgb6 = (frame * np.int32(63) + threshold[..., None] * np.int32(4)) // 255
        code = rgb6[..., 0] << 12 | rgb6[..., 1] << 6 | rgb6[..., 2]
        used = np.flatnonzero(np.bincount(code.ravel(), minlength=1 << 18))
        place = np.zeros(1 << 18, np.int32)
        place[used] = np.arange(len(used))
        rgb = np.stack([used >> 12, used >> 6 & 63, used & 63], axis=-1)
        first, second, share = self._pairs(rgb * np.float32(255 / 63))
        at = place[code]
        return np.where(threshold < share[at] * 64, second[at], first[at])

    def _pairs(
        self, rgb: NDArray[np.float32]
    ) -> tuple[NDArray[np.uint8], NDArray[np.uint8], NDArray[np.float32]]:
        """Return, for each color, the two entries that mix to it and the share of the second."""
        from scipy.spatial import cKDTree

        _, near = cKDTree(self.colors).query(rgb, k=_NEAREST)
        first = self.colors[near[:, :1]]
        step = self.colors[near[:, 1:]] - first
        length = (step**2).sum(axis=-1)
        share = ((rgb[:, None] - first) * step).sum(axis=-1) / np.maximum(length, 1e-6)
        share = np.clip(share, 0, 1)
        miss = ((rgb[:, None] - first - share[..., None] * step) ** 2).sum(axis=-1)
        best = np.argmin(miss + _GRAIN * share * (1 - share) * length, axis=1)
        row = np.arange(len(rgb))
        second = near[row, best + 1]
        return (
            near[:, 0].astype(np.uint8),
            second.astype(np.uint8),
            share[row, best].astype(np.float32),
        )

    def _move(self, sample: NDArray[np.uint8], rounds: int) -> None:
        """Run Lloyd's iterations; unused entries move to the pixels with the largest error."""
        from scipy.spatial import cKDTree

        colors = self.colors
        for _ in range(rounds):
            miss, nearest = cKDTree(colors).query(sample)
            count = np.bincount(nearest, minlength=_COLOURS)
            sums = [np.bincount(nearest, sample[:, c], _COLOURS) for c in range(3)]
            moved = np.stack(sums, axis=-1) / np.maximum(count, 1)[:, None]
            idle = np.flatnonzero(count == 0)
            worst = np.argsort(-miss, kind="stable")[: 4 * len(idle) : 4]
            moved[idle] = colors[idle]
            moved[idle[: len(worst)]] = sample[worst]
            colors = moved.astype(np.float32)
        # Round to whole levels, as the file stores them, so that mixtures match the display.
        self.colors = np.rint(colors)


def _sample(frame: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return some thousand pixels, at the same positions in every frame."""
    height, width = frame.shape[:2]
    step = max(1, round((height * width / _SAMPLES) ** 0.5))
    return frame[step // 2 :: step, step // 2 :: step].reshape(-1, 3)


def _bayer(order: int) -> NDArray[np.uint8]:
    matrix = np.zeros((1, 1), np.uint8)
    for _ in range(order):
        matrix = np.block([[4 * matrix, 4 * matrix + 2], [4 * matrix + 3, 4 * matrix + 1]])
    return matrix.astype(np.uint8)


_BAYER = _bayer(3)  # 0–63
