"""Move the coarse sky's border to the strongest edges near it."""

from __future__ import annotations

import numpy as np


def snap(image: np.ndarray, probability: np.ndarray, band: int = 2) -> np.ndarray:
    """Let sky and land grow towards each other until they meet on the strongest edge.

    This is the watershed of the color gradient with two sources, the sure sky and the sure land
    (Beucher & Meyer, "The morphological approach to segmentation: the watershed
    transformation", 1993; flooding after Meyer 1992). Unlike a path with one row per column
    (Lie et al., "A robust dynamic programming algorithm to extract skyline in images for
    navigation", 2005), it allows holes and overhangs.

    Parameters
    ----------
    image : (h, w, 3) uint8
        Encoded picture.
    probability : (h, w) float32
        The network's probability; the border is where it crosses 0.5.
    band : int
        Pixels on either side of the border in which edges are searched.

    Returns
    -------
    (h, w) bool
        Sky.
    """
    import cv2

    sky = probability > 0.5
    if sky.all() or not sky.any():
        return np.asarray(sky)
    sources = np.zeros(sky.shape, np.int32)
    sources[_sure(sky, band)] = 1
    sources[_sure(~sky, band)] = 2
    # OpenCV never floods the outermost pixels: pad the picture by one pixel on each side.
    image = cv2.copyMakeBorder(image, 1, 1, 1, 1, cv2.BORDER_REPLICATE)
    flooded = np.pad(sources, 1, mode="edge")
    cv2.watershed(np.ascontiguousarray(image), flooded)
    return _without_dam(image.astype(np.int32), flooded, sky)


def _without_dam(image: np.ndarray, flooded: np.ndarray, sky: np.ndarray) -> np.ndarray:
    """Give each pixel of the dam between the floods to its neighbor of the most similar color."""
    height, width = sky.shape
    inner = slice(1, -1), slice(1, -1)
    result = np.where(flooded[inner] > 0, flooded[inner] == 1, sky)
    nearest = np.full(sky.shape, np.inf)
    for row, column in ((0, 1), (1, 0), (1, 2), (2, 1)):
        window = slice(row, row + height), slice(column, column + width)
        difference = np.abs(image[inner] - image[window]).sum(axis=-1)
        alike = (flooded[inner] < 0) & (flooded[window] > 0) & (difference < nearest)
        result[alike] = flooded[window][alike] == 1
        nearest[alike] = difference[alike]
    return result


def _sure(mask: np.ndarray, band: int) -> np.ndarray:
    """Return pixels more than ``band`` inside, and thin parts such as masts, which have none."""
    import cv2

    def disc(radius: int) -> np.ndarray:
        return cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * radius + 1, 2 * radius + 1))

    inside = cv2.erode(mask.astype(np.uint8), disc(band))
    # Two pixels wider than the erosion, so that rounded corners of thick parts do not count.
    thick = cv2.dilate(inside, disc(band + 2))
    return np.asarray((inside > 0) | (mask & (thick == 0)))
