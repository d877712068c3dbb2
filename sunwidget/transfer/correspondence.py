"""Dense correspondence between two pictures.

The descriptor of a pixel holds its color, the color and contrast of its surroundings, its position
and whether it is sky. A k-d tree finds the nearest descriptors deterministically: the same two
pictures always correspond in the same way, and a picture corresponds to itself pixel by pixel.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_NEIGHBOURS = 4
# A neighbor may be this share farther than the nearest: five times as fast between different
# pictures, and a pixel still finds itself in the same picture.
_NEARLY = 1.0
_SURROUNDINGS = 3.0  # px, deviation of the Gaussian
# Weights relative to a difference of 1 in encoded color. Looks depend on height (ground, walls,
# sky) more than on the side; sky and land should not mix.
_SKY, _HEIGHT, _SIDE, _AROUND, _ROUGH = 1.0, 0.4, 0.12, 0.7, 1.0
_ALIKE = 0.1  # distance of descriptors at which the likeness is one half
_LEAST_SHARE = 0.01
_SPREAD = (0.6, 1.6)


@dataclass(frozen=True, eq=False)
class Correspondence:
    """Similar pixels of the second picture, with weights, for each pixel of the first.

    Attributes
    ----------
    index : (h, w, k) int
        Flat index into the second picture.
    weight : (h, w, k) float32
        Sums to 1.
    likeness : (h, w) float32
        Similarity of the nearest pixel: 1 for the same, 0 for nothing similar.
    """

    index: np.ndarray
    weight: np.ndarray
    likeness: np.ndarray

    def carry(self, values: np.ndarray) -> np.ndarray:
        """Transfer values (h2, w2, …) of the second picture to the first."""
        flat = values.reshape(-1, *values.shape[2:])
        shape = (*self.weight.shape, *(1,) * (flat.ndim - 1))
        found = sum(
            self.weight.reshape(shape)[:, :, i] * flat[self.index[:, :, i]]
            for i in range(self.weight.shape[-1])
        )
        return np.asarray(found)


def correspond(
    first: np.ndarray, first_sky: np.ndarray, second: np.ndarray, second_sky: np.ndarray
) -> Correspondence:
    """Find the pixels of ``second`` that are similar to each pixel of ``first``.

    Parameters
    ----------
    first, second : (h, w, 3), (h2, w2, 3) float32
        Encoded colors of similar level (``normalization``).
    first_sky, second_sky : (h, w), (h2, w2) float32
    """
    from scipy.spatial import cKDTree

    described = _descriptions(second, second_sky)
    tree = cKDTree(described.reshape(-1, described.shape[-1]))
    asked = _descriptions(first, first_sky)
    count = min(_NEIGHBOURS, second.shape[0] * second.shape[1])
    distance, index = tree.query(
        asked.reshape(-1, asked.shape[-1]), k=list(range(1, count + 1)), eps=_NEARLY
    )
    weight = 1 / (np.square(distance) + 1e-5)
    weight /= weight.sum(-1, keepdims=True)
    shape = (*first.shape[:2], count)
    likeness = 1 / (1 + np.square(distance[:, 0] / _ALIKE))
    return Correspondence(
        index.reshape(shape),
        weight.reshape(shape).astype(np.float32),
        likeness.reshape(first.shape[:2]).astype(np.float32),
    )


def normalization(
    first: np.ndarray, first_sky: np.ndarray, second: np.ndarray, second_sky: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return gain and shift (h, w, 3) that give ``first`` the mean and deviation of ``second``.

    Sky and land are separate if both pictures have them. The same picture gives gain 1, shift 0.
    """
    gain, shift = np.zeros_like(first), np.zeros_like(first)
    apart = all(_LEAST_SHARE < sky.mean() < 1 - _LEAST_SHARE for sky in (first_sky, second_sky))
    for label in (0, 1):
        mine = first_sky if label else 1 - first_sky
        theirs = second_sky if label else 1 - second_sky
        if not apart:
            theirs = np.ones_like(second_sky)
        own, other = _tones(first, mine if apart else np.ones_like(mine)), _tones(second, theirs)
        ratio = np.clip(other[1] / np.maximum(own[1], 1e-4), *_SPREAD)
        gain += mine[..., None] * ratio
        shift += mine[..., None] * (other[0] - ratio * own[0])
    return gain, shift


def _tones(image: np.ndarray, weight: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    share = weight.ravel().astype(np.float64)
    colors = image.reshape(-1, 3).astype(np.float64)
    total = max(float(share.sum()), 1e-9)
    mean = share @ colors / total
    deviation = np.sqrt(share @ np.square(colors - mean) / total)
    # One spread for all channels: three would change hues.
    spread = np.maximum(float(np.sqrt(np.mean(np.square(deviation)))), 1e-3)
    return mean.astype(np.float32), np.full(3, spread, np.float32)


def _descriptions(image: np.ndarray, sky: np.ndarray) -> np.ndarray:
    import cv2

    height, width = sky.shape
    rows, columns = np.mgrid[:height, :width].astype(np.float32)
    around = cv2.GaussianBlur(image, (0, 0), _SURROUNDINGS)
    variance = cv2.GaussianBlur(np.square(image), (0, 0), _SURROUNDINGS) - np.square(around)
    rough = np.sqrt(np.maximum(variance, 0)).mean(-1)
    # Luminance and two color differences, so that hue counts as much as level.
    opponent = np.array([[0.33, 0.34, 0.33], [1, -1, 0], [0.5, 0.5, -1]], np.float32)
    return np.dstack(
        [
            image @ opponent.T,
            _AROUND * (around @ opponent.T),
            _ROUGH * rough,
            _SKY * sky,
            _HEIGHT * (rows + 0.5) / height,
            _SIDE * (columns + 0.5) / width,
        ]
    )
