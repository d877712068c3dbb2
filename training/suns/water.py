"""Hand-drawn outlines of water: which pixels of a photo are sea, lake or river.

``water.csv`` beside this file: file, water, without, unknown. The last three are polygons, parted
by ``;``, of corners ``x,y`` in per cent of width and height; ``without`` are rocks, boats and piers
in the water, ``unknown`` is what nobody can tell, as wet sand that mirrors. A photo that is listed
without a polygon has none. The photos are not in this repository.

``water_judged.csv`` has the same for 195 photos drawn by seeds, which only judge. Readers saw what
the analysis of November 2026 takes for water, and corrected it.
"""

from __future__ import annotations

import csv
from functools import cache
from pathlib import Path

import cv2
import numpy as np

from training.outlines import outlines_of
from training.suns.labels import judging

LABELS = Path(__file__).with_name("water.csv")
JUDGED = Path(__file__).with_name("water_judged.csv")
UNKNOWN = 128
_BLUR = 0.015  # of the longer side: how exactly outlines were drawn


@cache
def outlines(path: Path = LABELS) -> dict[str, tuple[list[np.ndarray], ...]]:
    """By file polygons (n, 2) in fractions of width and height: water, what is not, and unknown."""
    with path.open(encoding="utf-8", newline="") as file:
        return {
            r["file"]: tuple(outlines_of(r[name]) for name in ("water", "without", "unknown"))
            for r in csv.DictReader(file)
        }


def water_map(file: str, sky: np.ndarray, path: Path = LABELS) -> np.ndarray:
    """Water of a photo whose sky mask (h, w) uint8 is known: 255, 0, or UNKNOWN."""
    found = np.where(sky > 191, 0, UNKNOWN).astype(np.uint8)
    folder = file.split("/", maxsplit=1)[0]
    if folder == "sea-sky":
        found[sky < 64] = 255
    if folder == "camvid":
        found[:] = 0
    if file not in outlines(path):
        return found
    size = sky.shape[::-1]
    drawn = np.zeros(sky.shape, np.uint8)
    for value, polygons in zip((255, 0, UNKNOWN), outlines(path)[file], strict=True):
        for polygon in polygons:
            cv2.fillPoly(drawn, [np.round(polygon * size).astype(np.int32)], value)
    kernel = np.ones((2 * max(1, round(_BLUR * max(size))) + 1,) * 2, np.uint8)
    unsure = cv2.dilate(drawn, kernel) != cv2.erode(drawn, kernel)
    found = np.where(unsure, UNKNOWN, drawn)
    return np.where(sky > 191, 0, found).astype(np.uint8)


def water_to_learn(file: str, sky: np.ndarray) -> np.ndarray:
    """Water as :func:`water_map` knows it, all ``UNKNOWN`` in photos that only judge."""
    if file in judging() or file in outlines(JUDGED):
        return np.full_like(sky, UNKNOWN)
    return water_map(file, sky)
