"""Corrections by hand of the masks of sky: where networks disagree, or are all wrong.

The masks of most training photos are votes of public networks, unknown where these disagree: on
just the far mountains, snow, sea and fog that are hard to tell from sky. ``sky_corrections.csv``
beside this file has a line for each corrected photo: file, and regions that are sky, land (anything
else) or unknown. Regions are parted by ``;``; each is an outline of corners ``x,y`` in per cent of
width and height, and its holes, if any, after ``|``. The photos are not in this repository.

``sky_judged.csv`` has the same for 299 photos that only judge, drawn by seeds, whatever networks
say of them: 180 that show their sun, 119 of all. Those without a region have a correct mask.
"""

from __future__ import annotations

import csv
import hashlib
from functools import cache
from pathlib import Path

import cv2
import numpy as np

from training.outlines import outlines_of

CORRECTIONS = Path(__file__).with_name("sky_corrections.csv")
JUDGED = Path(__file__).with_name("sky_judged.csv")
LEVELS = {"sky": 255, "land": 0, "unknown": 128}
JUDGES = 4
"""One corrected photo in this many (by a hash of its name) trains no sky network: it judges."""

Region = list[np.ndarray]
"""Rings (n, 2) in fractions of width and height: the outline, then its holes."""


@cache
def corrections(path: Path = CORRECTIONS) -> dict[str, list[tuple[int, Region]]]:
    """Level of the mask and region of every correction, by file as ``folder/name.jpg``."""
    with path.open(encoding="utf-8", newline="") as file:
        return {
            row["file"]: [
                (level, region) for name, level in LEVELS.items() for region in _regions(row[name])
            ]
            for row in csv.DictReader(file)
        }


def corrected(file: str, mask: np.ndarray) -> np.ndarray:
    """A photo's mask (h, w) uint8 with its corrections: 255 sky, 0 land, 128 unknown."""
    regions = corrections(JUDGED).get(file, corrections().get(file))
    if not regions:
        return mask
    mask, size = mask.copy(), mask.shape[::-1]
    for level, region in regions:
        # Rings within another are holes.
        cv2.fillPoly(mask, [np.round(ring * size).astype(np.int32) for ring in region], level)
    return mask


def judges(file: str) -> bool:
    """Whether a photo, ``folder/name.jpg``, is kept for judging."""
    if file in corrections(JUDGED):
        return True
    key = file.removesuffix(".jpg").encode()
    return file in corrections() and hashlib.sha256(key).digest()[0] % JUDGES == 0


def _regions(text: str) -> list[Region]:
    return [outlines_of(region, "|") for region in text.split(";") if region.strip()]
