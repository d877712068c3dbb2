"""Islands of "land" in mid-sky: clouds and suns that GrabCut's colours took for land."""

from __future__ import annotations

import numpy as np


def fill_islands(sky: np.ndarray, coarse: np.ndarray) -> np.ndarray:
    """Return how much to add to the matte so that islands the network calls sky are sky.

    Twigs, masts and wires hang together with the land and stay; a bird or a balloon is lost
    to the sky unless a person paints it.

    Parameters
    ----------
    sky, coarse : (h, w) float32
        The refined matte and the network's map at one size.

    Returns
    -------
    (h, w) float32
        New lower bound of the matte, 0 where nothing changes.
    """
    import cv2

    land = (sky < 0.7).astype(np.uint8)
    count, labels = cv2.connectedComponents(land, connectivity=8)
    if count < 2:
        return np.zeros_like(sky)
    area = np.bincount(labels.ravel(), minlength=count)
    trust = np.bincount(labels.ravel(), coarse.ravel(), minlength=count) / np.maximum(area, 1)
    island = (trust > 0.5) & (area < 0.02 * sky.size)
    island[0] = False
    mask = island[labels].astype(np.uint8)
    grown = cv2.dilate(mask, np.ones((5, 5), np.uint8)).astype(np.float32)
    # The rim is soft where sky meets it, and does not creep over real land.
    return np.asarray(cv2.GaussianBlur(grown, (0, 0), 1.0) * (mask | (sky >= 0.7)), np.float32)
