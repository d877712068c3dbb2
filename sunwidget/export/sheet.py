"""Several named pictures side by side in one picture."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from sunwidget.export import lettering

if TYPE_CHECKING:
    from PIL import Image

_GAP, _BAND, _SIZE = 4, 26, 15  # pixels: between pictures, above each one, size of the letters
_WIDEST = 5  # width over height
_BACK, _TEXT = (32, 32, 32), (236, 236, 236)


def sheet(pictures: Mapping[str, np.ndarray], columns: int | None = None) -> Image.Image:
    """Return pictures of one size in rows, each under its name.

    Parameters
    ----------
    pictures : mapping
        (H, W, 3) uint8 arrays, sRGB, by name; at least one.
    columns : int, optional
        Pictures per row. Default: as many as keep the sheet at most five times as wide as high.

    Returns
    -------
    PIL.Image.Image
        RGB.
    """
    from PIL import Image, ImageDraw

    height, width = next(iter(pictures.values())).shape[:2]
    across = columns or _across(len(pictures), width, height + _BAND)
    rows = math.ceil(len(pictures) / across)
    size = (across * (width + _GAP) - _GAP, rows * (height + _BAND + _GAP) - _GAP)
    whole = Image.new("RGB", size, _BACK)
    draw = ImageDraw.Draw(whole)
    for i, (name, picture) in enumerate(pictures.items()):
        x = i % across * (width + _GAP)
        y = i // across * (height + _BAND + _GAP)
        lettering.write(draw, (x + 8, y + 4), lettering.cut(name, width - 16, _SIZE), _SIZE, _TEXT)
        whole.paste(Image.fromarray(picture), (x, y + _BAND))
    return whole


def _across(count: int, width: int, height: int) -> int:
    """Return the number of pictures per row: all, unless the sheet becomes too wide."""

    def aspect(across: int) -> float:
        return (across * width) / (math.ceil(count / across) * height)

    return max((n for n in range(1, count + 1) if aspect(n) <= _WIDEST), key=aspect, default=1)
