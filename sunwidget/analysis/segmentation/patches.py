"""Classify isolated patches of sky and of land one by one.

Refinement follows colors: it turns clouds and suns into islands of land, and windows, snow and haze
into sky. For each piece except the largest of its kind, a logistic regression decides from two
networks' outputs and the piece's colors. ``training/calibrate_patches.py`` fits it to masks of
photos that trained neither network.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.images.working_copy import Working, channel_sum, log_odds, resize, shrink
from sunwidget.analysis.networks.land import look_at_land
from sunwidget.analysis.segmentation.refine import SIDE, local_moments, opponent

LEAST = 0.002
"""Share of the picture; smaller patches stay, such as sky between leaves and girders."""
_SAME = 0.3  # deviations that do not count
# Bias, then the weights of ``features``.
WEIGHTS = (2.33, 1.02, 0.29, -3.77, -0.65, 1.05)


def settle(sky: np.ndarray, coarse: np.ndarray, working: Working) -> np.ndarray:
    """Return the refined sky with each patch classified as a whole.

    Parameters
    ----------
    sky : (h, w) float32
        The refined sky, at any size.
    coarse : (h, w) float32
        Probability before refinement, at any size.
    working : Working
        The small photo.

    Returns
    -------
    (h, w) float32
    """
    labels, is_sky = find(sky)
    if not is_sky.size:
        return sky
    seen = features(labels, sky, is_sky, coarse, working)
    verdict = WEIGHTS[0] + seen @ np.array(WEIGHTS[1:]) > 0
    changed = np.append(False, verdict != is_sky)
    return np.asarray(np.where(changed[labels], sky <= 0.5, sky), np.float32)


def find(sky: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the patch of each pixel, and which of the n patches are sky.

    Returns
    -------
    labels : (h, w) int32
        From 1; 0 in the largest pieces of sky and land and in pieces that are too small.
    is_sky : (n,) bool
    """
    import cv2

    labels = np.zeros(sky.shape, np.int32)
    is_sky: list[bool] = []
    # Pixels that touch at a corner connect only as land, since twigs are thin.
    for kind, connectivity in ((True, 4), (False, 8)):
        pieces = ((sky > 0.5) == kind).astype(np.uint8)
        _, found, stats, _ = cv2.connectedComponentsWithStats(pieces, connectivity=connectivity)
        order = 1 + np.argsort(-stats[1:, cv2.CC_STAT_AREA], kind="stable")
        for number in order[1:]:
            if stats[number, cv2.CC_STAT_AREA] <= LEAST * sky.size:
                break
            is_sky.append(kind)
            labels[found == number] = len(is_sky)
    return labels, np.array(is_sky, bool)


def features(
    labels: np.ndarray, sky: np.ndarray, is_sky: np.ndarray, coarse: np.ndarray, working: Working
) -> np.ndarray:
    """Return the regression's features of each patch of ``find``, (n, 5).

    They are the log odds of ``coarse`` and of the land network; whether refinement made it sky;
    and the logs of the deviations of its color from nearby sky and from nearby land.
    """
    import cv2

    picture = shrink(working.guide, SIDE)
    height, width = picture.shape[:2]

    def nearest(kinds: np.ndarray) -> np.ndarray:
        return cv2.resize(
            kinds.astype(np.float32), (width, height), interpolation=cv2.INTER_NEAREST
        )

    small, mask = nearest(labels), nearest(sky > 0.5)
    rim = np.ones((5, 5), np.uint8)
    pieces = small + 0.5 * mask
    core = cv2.erode(pieces, rim) == cv2.dilate(pieces, rim)
    color = opponent(picture)
    channels = [*np.moveaxis(color, -1, 0)]
    for kind in (1, 0):
        own = (core & (mask == kind) & (small == 0)).astype(np.float32)
        for moment in local_moments(color, own, color.shape):
            channels += [*np.moveaxis(moment, -1, 0)]
    beliefs = coarse, look_at_land(working).sky
    channels += [log_odds(resize(belief, width, height)) for belief in beliefs]

    index = small.astype(int).ravel()
    # Rims are soft and count little, but a patch may have nothing else.
    weight = core.ravel() + 1e-3
    total = np.bincount(index, weight, is_sky.size + 1)
    sums = [np.bincount(index, weight * channel.ravel(), total.size) for channel in channels]
    own, *moments = np.split((np.array(sums) / total)[:15, 1:].T, 5, axis=1)
    return np.column_stack(
        [
            (np.array(sums) / total)[15:, 1:].T,
            is_sky,
            *(
                np.log(_SAME + np.sqrt(channel_sum(np.square(own - mean) / variance)))
                for mean, variance in (moments[:2], moments[2:])
            ),
        ]
    )
