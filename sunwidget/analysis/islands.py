"""Islands of "land" in mid-sky: clouds and suns that GrabCut's colours took for land."""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.working import channel_sum


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


def grow_over_glow(sky: np.ndarray, coarse: np.ndarray, encoded: np.ndarray) -> np.ndarray:
    """Return how much to add where the matte ends in the middle of nothing.

    A skyline has an edge under it. Where sky runs on into "land" without one, over bright pixels
    that the network is not sure of (the glow round a low sun), it goes on to the next edge.

    Parameters
    ----------
    sky, coarse : (h, w) float32
        The refined matte and the network's map at one size.
    encoded : (h, w, 3) float32
        The photo, sRGB-encoded.

    Returns
    -------
    (h, w) float32
        New lower bound of the matte, 0 where nothing changes.
    """
    import cv2

    smooth = cv2.GaussianBlur(encoded, (0, 0), 1.0)
    across = cv2.Sobel(smooth, cv2.CV_32F, 1, 0, ksize=3) / 8
    down = cv2.Sobel(smooth, cv2.CV_32F, 0, 1, ksize=3) / 8
    slope = np.sqrt(channel_sum(across**2 + down**2))
    gentle = slope < 4.0 / max(sky.shape)
    doubtful = (sky < 0.5) & (coarse > 0.04) & gentle & (encoded.mean(-1) > 0.4)
    count, labels = cv2.connectedComponents(doubtful.astype(np.uint8), connectivity=4)
    if count < 2:
        return np.zeros_like(sky)
    # Open to the sky: much of the component's rim lies on the matte's own end.
    rim = cv2.dilate((sky >= 0.5).astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    area = np.bincount(labels.ravel(), minlength=count)
    contact = np.bincount(labels[rim & doubtful], minlength=count)
    chosen = (contact > 1.2 * np.sqrt(area)) & (area > 1e-4 * sky.size)
    chosen[0] = False
    mask = chosen[labels].astype(np.uint8)
    closed = cv2.morphologyEx(mask, cv2.MORPH_CLOSE, np.ones((5, 5), np.uint8))
    return cv2.GaussianBlur(closed.astype(np.float32), (0, 0), 1.0) * (closed > 0)
