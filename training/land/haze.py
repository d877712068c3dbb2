"""Haze outlined by eye: what share of the land's light in photos is that of air before it.

``haze.csv`` beside this file: file, haze. The latter holds polygons, parted by ``;``: a level, then
corners ``x,y`` in per cent of width and height. Levels: 1 slight, 2 half, 3 strong, 4 nothing but
fog, ? unknown. Later polygons paint over earlier ones; the rest of the land is clear, and so is
all of a photo without polygons. The photos are not in this repository.
"""

from __future__ import annotations

import csv
import zlib
from functools import cache
from pathlib import Path

import cv2
import numpy as np

from training.outlines import outlines_of

LABELS = Path(__file__).with_name("haze.csv")
SHARES = {"1": 0.25, "2": 0.5, "3": 0.75, "4": 0.95, "?": -1.0}
_JUDGES = 4  # one photo of so many only judges
_BLUR = 0.01  # of the longer side: how exactly outlines were drawn


@cache
def outlines() -> dict[str, list[tuple[float, np.ndarray]]]:
    """By file the shares (-1 unknown) and polygons (n, 2) in fractions of width and height."""
    found: dict[str, list[tuple[float, np.ndarray]]] = {}
    with LABELS.open(encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            parts = [part.split(maxsplit=1) for part in row["haze"].split(";") if part]
            found[row["file"]] = [(SHARES[level], outlines_of(text)[0]) for level, text in parts]
    return found


def judges(file: str) -> bool:
    """Whether a photo only judges."""
    return zlib.crc32(file.encode()) % _JUDGES == 0


def haze_map(file: str, sky: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the share of the air's light in an outlined photo, and where it is known.

    Parameters
    ----------
    file : str
        Folder and name, as in the table.
    sky : (h, w) uint8
        Its sky: 255, 0, or 128, unknown.

    Returns
    -------
    share : (h, w) float32
        In [0, 1].
    known : (h, w) bool
        Land, away from borders between levels and what nobody could tell.
    """
    size = sky.shape[::-1]
    drawn = np.zeros(sky.shape, np.float32)
    for share, polygon in outlines()[file]:
        cv2.fillPoly(drawn, [np.round(polygon * size).astype(np.int32)], share)
    kernel = np.ones((2 * max(1, round(_BLUR * max(size))) + 1,) * 2, np.uint8)
    border = cv2.dilate(drawn, kernel) != cv2.erode(drawn, kernel)
    return np.maximum(drawn, 0), (sky < 64) & ~border & (drawn >= 0)
