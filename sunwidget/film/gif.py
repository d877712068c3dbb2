"""Animated GIF of a photograph: palettes that follow the light, dithering that holds still.

A GIF has 256 colours a frame. One palette for a whole sunset bands the sky at one end of it; a
palette of its own for each frame, or error diffusion, makes the picture boil. Here the palette
of a frame is that of the last one moved on to the new colours (k-means from a warm start, Lloyd
1982), the threshold matrix of the dithering (Bayer 1973) stands still, and a pixel that would
hardly change keeps its colour, which also makes the file smaller.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

_COLOURS = 255
_KEPT = 255  # the index of a pixel that stays as it was
# A pixel whose new colour lies nearer to the shown one than this, in levels, is left alone.
_UNSEEN = 3.5
_SAMPLES = 8000
# What a mixture of two colours costs for being grainy, against being off by the same amount.
_GRAIN = 0.4
_NEAREST = 6  # entries of the palette that a mixture is sought among


def write_gif(
    frames: Iterator[NDArray[np.uint8]], file: BinaryIO, hundredths: list[int], *, forever: bool
) -> None:
    """Write frames as they come; only one is held.

    Parameters
    ----------
    frames : iterator of (H, W, 3) uint8 arrays
        sRGB.
    file : binary file
        To write to.
    hundredths : list of int
        How long each frame stands, in hundredths of a second.
    forever : bool
        Repeat without end; otherwise it stops at the last frame.
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
        indices = palette.dithered(frame)
        new = palette.colours[indices]
        if shown is not None:
            kept = ((new - shown) ** 2).sum(axis=-1) < _UNSEEN**2
            indices[kept] = _KEPT
            new[kept] = shown[kept]
        shown = new
        picture = Image.fromarray(indices)
        picture.putpalette(palette.colours.astype(np.uint8).tobytes() + bytes(3))
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
    """255 colours that follow a film's frames."""

    def __init__(self, frame: NDArray[np.uint8]) -> None:
        from PIL import Image

        sample = _sample(frame)
        cut = Image.fromarray(sample[None]).quantize(_COLOURS).getpalette() or []
        rgb = np.array(cut, np.uint8).reshape(-1, 3)[:_COLOURS]
        # A picture of few colours: the rest are found where they are missed.
        rgb = np.pad(rgb, ((0, _COLOURS - len(rgb)), (0, 0)), mode="edge")
        self.colours = rgb.astype(np.float32)
        self._move(sample, rounds=6)

    def follow(self, frame: NDArray[np.uint8]) -> None:
        """Move on to the colours of the next frame."""
        self._move(_sample(frame), rounds=2)

    def dithered(self, frame: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """Return the index of each pixel, (H, W): two colours mixed by a still threshold."""
        height, width = frame.shape[:2]
        threshold = np.tile(_BAYER, (-(-height // 8), -(-width // 8)))[:height, :width]
        # Pairs are sought for colours of 6 bits; the rounding to them is dithered as well.
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
        """Return for each colour the two entries, and the second one's share, that mix to it."""
        from scipy.spatial import cKDTree

        _, near = cKDTree(self.colours).query(rgb, k=_NEAREST)
        first = self.colours[near[:, :1]]
        way = self.colours[near[:, 1:]] - first
        length = (way**2).sum(axis=-1)
        share = ((rgb[:, None] - first) * way).sum(axis=-1) / np.maximum(length, 1e-6)
        share = np.clip(share, 0, 1)
        miss = ((rgb[:, None] - first - share[..., None] * way) ** 2).sum(axis=-1)
        best = np.argmin(miss + _GRAIN * share * (1 - share) * length, axis=1)
        row = np.arange(len(rgb))
        second = near[row, best + 1]
        return (
            near[:, 0].astype(np.uint8),
            second.astype(np.uint8),
            share[row, best].astype(np.float32),
        )

    def _move(self, sample: NDArray[np.uint8], rounds: int) -> None:
        """Lloyd's iterations; entries that nothing is near to go where most is missed."""
        from scipy.spatial import cKDTree

        colours = self.colours
        for _ in range(rounds):
            miss, nearest = cKDTree(colours).query(sample)
            count = np.bincount(nearest, minlength=_COLOURS)
            sums = [np.bincount(nearest, sample[:, c], _COLOURS) for c in range(3)]
            moved = np.stack(sums, axis=-1) / np.maximum(count, 1)[:, None]
            idle = np.flatnonzero(count == 0)
            worst = np.argsort(-miss, kind="stable")[: 4 * len(idle) : 4]
            moved[idle] = colours[idle]
            moved[idle[: len(worst)]] = sample[worst]
            colours = moved.astype(np.float32)
        # The file has whole levels; what is mixed is what is shown.
        self.colours = np.rint(colours)


def _sample(frame: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return some thousand pixels, the same places in every frame."""
    height, width = frame.shape[:2]
    step = max(1, round((height * width / _SAMPLES) ** 0.5))
    return frame[step // 2 :: step, step // 2 :: step].reshape(-1, 3)


def _bayer(order: int) -> NDArray[np.uint8]:
    matrix = np.zeros((1, 1), np.uint8)
    for _ in range(order):
        matrix = np.block([[4 * matrix, 4 * matrix + 2], [4 * matrix + 3, 4 * matrix + 1]])
    return matrix.astype(np.uint8)


_BAYER = _bayer(3)  # 0–63
