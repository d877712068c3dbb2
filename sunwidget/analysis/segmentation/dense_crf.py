"""Fully connected conditional random field with two classes, sky and land.

It connects all pairs of pixels, more strongly the nearer and the more alike in color they are
(Krähenbühl & Koltun, "Efficient inference in fully connected CRFs with Gaussian edge
potentials", 2011). Instead of their permutohedral lattice it uses a plain grid in (x, y, r, g, b),
as in Chen, Paris & Durand, "Real-time edge-aware image processing with the bilateral grid", 2007:
at 384 px and these widths it has fewer than a million cells.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

ITERATIONS = 5  # more iterations change one pixel in 100 000
# Linear splatting and slicing spread by 1/3 cell², the blur by 1/2: together σ² = 5/6 cell².
CELL = np.sqrt(6 / 5)


def mean_field(
    image: np.ndarray,
    probability: np.ndarray,
    reach: float = 0.15,
    color: float = 13.0,
    appearance: float = 10.0,
    smoothness: float = 3.0,
    sigma: float = 1.0,
) -> np.ndarray:
    """Return the sky's marginal probability after mean-field inference; deterministic.

    Parameters
    ----------
    image : (h, w, 3) uint8
        Encoded picture.
    probability : (h, w) float32
        The network's probability; the unary potential is its logarithm.
    reach : float
        Standard deviation of the appearance kernel in units of the picture's longer side.
    color : float
        Standard deviation of the appearance kernel in code values.
    appearance, smoothness : float
        Weights of the appearance kernel (position and color) and of the smoothness kernel
        (position only), each normalized to 1; 10 and 3 in the authors' program.
    sigma : float
        Standard deviation of the smoothness kernel in pixels.

    Returns
    -------
    (h, w) float32
        Probability in [0, 1].
    """
    import cv2

    certain = np.clip(probability.astype(np.float32), 0.01, 0.99)
    unary = np.log(certain / (1 - certain))
    bilateral = _bilateral(image, reach * max(image.shape[:2]), color)
    logit = unary
    for _ in range(ITERATIONS):
        vote = np.tanh(logit / 2)  # P(sky) - P(land)
        near = cv2.GaussianBlur(vote, (0, 0), sigma, borderType=cv2.BORDER_REFLECT)
        logit = unary + appearance * bilateral(vote) + smoothness * near
    return np.asarray(1 / (1 + np.exp(-logit)), np.float32)


def _bilateral(image: np.ndarray, reach: float, color: float) -> Callable[[Any], np.ndarray]:
    """Return the filter of (h, w) maps with the kernel in position and color.

    It is normalized symmetrically, by 1/√n before and after with n the filtered ones, as in the
    authors' program: otherwise pixels in large even areas would connect only to each other.
    """
    from scipy import sparse

    height, width = image.shape[:2]
    rows, columns = np.mgrid[:height, :width].astype(np.float32) / (reach * CELL)
    colors = image.reshape(-1, 3).astype(np.float32) / (color * CELL)
    place = np.column_stack([rows.ravel(), columns.ravel(), colors]) + 1  # a cell of margin
    shape = [int(n) + 3 for n in place.max(axis=0)]
    low = place.astype(np.int32)
    share = place - low
    # A pixel's weight is divided among the 32 corners of its cell, axis by axis.
    weights = np.ones((place.shape[0], 1), np.float32)
    cells = np.zeros((place.shape[0], 1), np.int32)
    stride = 1
    for axis in reversed(range(5)):
        upper, first = share[:, axis, None], low[:, axis, None] * stride
        weights = np.concatenate([weights * (1 - upper), weights * upper], axis=1)
        cells = np.concatenate([cells + first, cells + first + stride], axis=1)
        stride *= shape[axis]
    begins = np.arange(place.shape[0] + 1, dtype=np.int32) * weights.shape[1]
    grid = (place.shape[0], stride)
    slicing = sparse.csr_array((weights.ravel(), cells.ravel(), begins), shape=grid)
    splatting = slicing.T

    def raw(values: np.ndarray) -> np.ndarray:
        lattice = (splatting @ values).reshape(shape)
        for axis in range(5):
            lattice = _blur(lattice, axis)
        return np.asarray(slicing @ lattice.ravel())

    scale = 1 / np.sqrt(np.maximum(raw(np.ones(height * width, np.float32)), 1e-6))
    return lambda values: (scale * raw(scale * values.ravel())).reshape(height, width)


def _blur(lattice: np.ndarray, axis: int) -> np.ndarray:
    """Filter with (1, 2, 1) / 4 along an axis; both ends are empty."""
    moved = np.moveaxis(lattice, axis, 0)
    out = moved * 0.5
    out[1:] += moved[:-1] * 0.25
    out[:-1] += moved[1:] * 0.25
    return np.moveaxis(out, 0, axis)
