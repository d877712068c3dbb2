"""The part of a picture in a zoomed view, at the photo's full resolution.

The browser has only a preview; the kernel renders finer detail.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.analysis.images.working_copy import resize
from sunwidget.analysis.scene import Scene
from sunwidget.edit.table import Edit
from sunwidget.renderer.offscreen import strips_of

Box = tuple[float, float, float, float]


def detail(
    scene: Scene,
    edit: Edit,
    box: Any,
    size: Any,
    progress: Callable[[float, str], Any] | None = None,
) -> tuple[Box, NDArray[np.uint8]]:
    """Draw a part of the picture from the full-size photo.

    Parameters
    ----------
    scene, edit : Scene, Edit
        As for ``sunwidget.render``.
    box : (left, top, right, bottom)
        The part, in fractions of the picture's width and height.
    size : (width, height)
        Pixels of the view; a larger part is reduced to it.
    progress : callable, optional
        Called with (fraction, message); raise in it to cancel.

    Returns
    -------
    box : (left, top, right, bottom)
        The part, extended to whole pixels, in fractions.
    pixels : array, (H, W, 3) uint8
        sRGB.

    Raises
    ------
    ValueError
        For an invalid part or size.
    """
    width, height = scene.photo.size
    left, top, right, bottom = (min(1.0, max(0.0, value)) for value in _numbers(box, 4))
    shown = tuple(round(value) for value in _numbers(size, 2))
    columns = slice(math.floor(left * width), math.ceil(right * width))
    rows = slice(math.floor(top * height), math.ceil(bottom * height))
    if columns.start >= columns.stop or rows.start >= rows.stop or min(shown) < 1:
        raise ValueError(f"The picture has no part {box!r:.80} of {size!r:.40} pixels.")
    pixels = np.concatenate(
        [
            strip[max(0, rows.start - held.start) : rows.stop - held.start, columns]
            for held, strip in strips_of(scene, edit, progress=progress, within=rows)
        ]
    )
    if shown[0] < pixels.shape[1] and shown[1] < pixels.shape[0]:
        pixels = resize(pixels, *shown)
    found = (
        columns.start / width,
        rows.start / height,
        columns.stop / width,
        rows.stop / height,
    )
    return found, pixels


def _numbers(value: Any, count: int) -> list[float]:
    """Return a message's numbers; ValueError for anything else."""
    plain = isinstance(value, list | tuple) and len(value) == count
    if not plain or not all(isinstance(one, int | float) and math.isfinite(one) for one in value):
        raise ValueError(f"Expected {count} finite numbers, not {value!r:.80}.")
    return [float(one) for one in value]
