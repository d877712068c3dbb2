"""Enlarge maps of the working copy in parts, so that a large photo needs no map of its size."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from sunwidget.analysis.images.working_copy import resize

Box = tuple[slice, slice]


def resize_rows(
    image: np.ndarray,
    width: int,
    height: int,
    rows: slice = slice(None),
    columns: slice = slice(None),
) -> np.ndarray:
    """Return a part of ``image`` resized to (height, width) without computing the rest.

    A pixel has the same bits in any part, and the bits of ``resize`` except the last one of
    float32. A smaller picture is computed as a whole.
    """
    import cv2

    if image.shape[1::-1] == (width, height):
        return image if (rows, columns) == (slice(None), slice(None)) else image[rows, columns]
    if width * height < image.shape[0] * image.shape[1]:
        return np.asarray(resize(image, width, height)[rows, columns])
    first, last, _ = rows.indices(height)
    tall = image.shape[0]
    at = (np.arange(first, last) + 0.5) * (tall / height) - 0.5
    low = np.clip(np.floor(at).astype(int), 0, tall - 1)
    share = np.clip(at - low, 0, 1).astype(np.float32)
    begin, end = int(low[0]), min(int(low[-1]) + 2, tall)
    wide = cv2.resize(
        np.ascontiguousarray(image[begin:end], np.float32),
        (width, end - begin),
        interpolation=cv2.INTER_LINEAR,
    )[:, columns]
    step = np.zeros_like(wide)
    np.subtract(wide[1:], wide[:-1], out=step[:-1])
    out = np.empty((last - first, *wide.shape[1:]), np.float32)
    # Row by row, the data stays in the cache.
    for row, source, part in zip(out, low - begin, share, strict=True):
        np.multiply(step[source], part, out=row)
        row += wide[source]
    return out


def enlarged_part(
    small: np.ndarray, zoom: tuple[float, float], part: Box, corner: tuple[int, int] = (0, 0)
) -> np.ndarray:
    """Interpolate a map, or a piece of one, at some of the photo's pixels.

    Parameters
    ----------
    small : (h, w) or (h, w, n) float32
        Map in working pixels.
    zoom : (x, y)
        Pixels of the photo per working pixel.
    part : (rows, columns)
        Part in pixels of the photo.
    corner : (row, column)
        Top left corner of ``small`` in working pixels.

    Returns
    -------
    (H, W) or (H, W, n) float32
        Values in ``part``; outside ``small`` its edge is repeated.
    """
    import cv2

    rows, columns = part
    top, left = corner
    if zoom == (1.0, 1.0):
        return small[rows.start - top : rows.stop - top, columns.start - left : columns.stop - left]
    matrix = np.array(
        [
            [1 / zoom[0], 0, (columns.start + 0.5) / zoom[0] - 0.5 - left],
            [0, 1 / zoom[1], (rows.start + 0.5) / zoom[1] - 0.5 - top],
        ]
    )
    return cv2.warpAffine(
        small,
        matrix,
        (columns.stop - columns.start, rows.stop - rows.start),
        flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
        borderMode=cv2.BORDER_REPLICATE,
    )


def pixels_of(first: int, last: int, zoom: float) -> slice:
    """Return the photo's pixels whose centers lie in working pixels ``first`` to ``last``."""
    return slice(math.ceil(first * zoom - 0.5), math.ceil(last * zoom - 0.5))


def raise_to(matte: np.ndarray, least: np.ndarray, zoom: tuple[float, float]) -> None:
    """Raise a map (H, W) in place to at least a smaller one (h, w) where that is not 0."""
    for part in _touched(least, zoom):
        np.maximum(matte[part], enlarged_part(least, zoom, part), out=matte[part])


def take_from(matte: np.ndarray, share: np.ndarray, zoom: tuple[float, float]) -> None:
    """Remove a share, a smaller map (h, w), from a map (H, W) in place."""
    for part in _touched(share, zoom):
        matte[part] *= 1 - enlarged_part(share, zoom, part)


def _touched(small: np.ndarray, zoom: tuple[float, float]) -> Iterator[Box]:
    """Yield the part of the photo where a small map is not 0, if there is one."""
    rows, columns = np.flatnonzero(small.any(axis=1)), np.flatnonzero(small.any(axis=0))
    if not rows.size:
        return
    # Interpolation spreads the values by a pixel.
    top, bottom = max(rows[0] - 1, 0), min(rows[-1] + 2, small.shape[0])
    left, right = max(columns[0] - 1, 0), min(columns[-1] + 2, small.shape[1])
    yield pixels_of(top, bottom, zoom[1]), pixels_of(left, right, zoom[0])
