"""The brush: the pixels that a stroke covers, and setting maps under it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from sunwidget.edit.table import Stroke


def paint(
    stroke: Stroke, width: int, height: int, box: tuple[slice, slice] | None = None
) -> np.ndarray:
    """Return the pixels under the brush, (height, width) bool; at least one pixel wide.

    ``box`` (rows, columns) limits the result to a part of the picture.
    """
    import cv2

    rows, columns = box or (slice(0, height), slice(0, width))
    canvas = np.zeros((rows.stop - rows.start, columns.stop - columns.start), np.uint8)
    fraction = 4  # bits of sub-pixel position
    points = np.array(
        [
            [(x * width - 0.5) * 2**fraction, (y * height - 0.5) * 2**fraction]
            for x, y in stroke.points
        ]
    )
    points = np.clip(np.round(points), -(2**24), 2**24).astype(np.int32)
    points -= np.array([columns.start, rows.start], np.int32) * 2**fraction
    radius = max(stroke.radius * max(width, height), 0.5)
    cv2.polylines(
        canvas,
        [points.reshape(-1, 1, 2)],
        False,
        1,
        max(1, round(2 * radius)),
        cv2.LINE_8,
        fraction,
    )
    for x, y in points:
        cv2.circle(
            canvas, (int(x), int(y)), round(radius * 2**fraction), 1, -1, cv2.LINE_8, fraction
        )
    return canvas > 0


def set_strokes(matte: np.ndarray, strokes: Sequence[Stroke]) -> None:
    """Set a map (H, W) under each brush, in place: strokes override everything else."""
    height, width = matte.shape
    for stroke in strokes:
        reach = stroke.radius * max(width, height) + 2
        xs = [x * width for x, _ in stroke.points]
        ys = [y * height for _, y in stroke.points]
        left, right = max(math.floor(min(xs) - reach), 0), min(math.ceil(max(xs) + reach), width)
        top, bottom = max(math.floor(min(ys) - reach), 0), min(math.ceil(max(ys) + reach), height)
        if left < right and top < bottom:
            # Painting only the stroke's box saves most of the time on a large photo.
            box = slice(top, bottom), slice(left, right)
            matte[box][paint(stroke, width, height, box)] = stroke.label in ("sky", "water")
