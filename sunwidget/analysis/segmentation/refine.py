"""Refinement: turn the network's coarse sky into a decision that follows the skyline.

A method of ``METHODS`` decides sky or land on a copy of at most 384 px and gives its confidence
(thesis 3.1.1.2); ``matting`` extends the decision to every pixel of the photo.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.images.working_copy import (
    Working,
    channel_sum,
    resize,
    shrink,
    smoothstep,
)
from sunwidget.analysis.networks.sky import look_at_sky
from sunwidget.analysis.segmentation.dense_crf import mean_field
from sunwidget.analysis.segmentation.edges import snap

SIDE = 384
MINIMUM_SIDE = 4  # smaller pictures have no neighborhood for refinement
_WATER = (0.5, 0.9)  # share of water in what is not sky: less is land, more is water


class Decision(NamedTuple):
    """Sky or land at low resolution.

    ``sky`` is (h, w) float32 in [0, 1], its confidence ``confidence`` (h, w) float32 in (0, 1]. A
    ``final`` decision is a matte already: it is only resized to the photo.
    """

    sky: np.ndarray
    confidence: np.ndarray
    final: bool = False


def none(working: Working, probability: np.ndarray) -> Decision:
    """Keep the coarse map unchanged, for example a mask from the caller."""
    return Decision(probability, np.ones_like(probability), final=True)


def grabcut_rect(working: Working, probability: np.ndarray) -> Decision:
    """GrabCut from the bounding box of the coarse mask, as the thesis does.

    Source: Rother et al., "GrabCut", 2004. Nothing outside the box can become sky, and inside it
    only color separates land from sky.
    """
    import cv2

    image, coarse = _small(working, probability)
    labels = np.full(coarse.shape, cv2.GC_BGD, np.uint8)
    rows, columns = np.nonzero(coarse > 0.5)
    if rows.size:
        box = slice(rows.min(), rows.max() + 1), slice(columns.min(), columns.max() + 1)
        labels[box] = cv2.GC_PR_FGD
    return _decision(cut(image, labels, iterations=5), coarse)


def grabcut_mask(working: Working, probability: np.ndarray) -> Decision:
    """GrabCut from a trimap, then network and local colors together at working size.

    The trimap is sure where the network is sure and away from its skyline. GrabCut's smooth
    contour loses details thinner than its grid (twigs, pylons, the sky between leaves); the colors
    of sky and land near each pixel recover them. Water has the sky's colors: between these two the
    bundled network decides alone.
    """
    image, coarse = _small(working, probability)
    sky = cut(image, trimap(coarse), iterations=2)
    if not sky.any() or sky.all() or min(working.width, working.height) < 16:
        return _decision(sky, coarse)
    cutout = sky.astype(np.float32)
    evidence = coarse
    # An unsure sky (a white wall indoors: 0.6 to 0.7 on average, skies 0.8 and more) must not
    # spread by color.
    trust = float(coarse[coarse > 0.5].mean()) if (coarse > 0.5).any() else 0.0
    weight = 0.8 * min(max((trust - 0.65) / 0.1, 0.0), 1.0)
    seen = look_at_sky(working)
    dry = 1 - smoothstep(*_WATER, seen.water / np.maximum(1 - seen.sky, 1e-3))
    # The second round, at working size, learns from the result of the first.
    rounds = (shrink(working.guide, SIDE), 0.4), (working.guide, 0.1)
    for guide, doubt in rounds:
        height, width = guide.shape[:2]
        certain = np.clip(resize(probability, width, height), 0.01, 0.99)
        cutout = resize(cutout, width, height)
        colors = local_evidence(guide, cutout > 0.5, certain, doubt)
        seen_here = 0.4 * (2 * cutout - 1) + weight * np.clip(colors, -6, 6)
        evidence = np.log(certain / (1 - certain)) + resize(dry, width, height) * seen_here
        cutout = (evidence > 0).astype(np.float32)
    confidence = np.clip(np.abs(evidence) / 4, 0.02, 1)
    return Decision(cutout, confidence.astype(np.float32))


def edge(working: Working, probability: np.ndarray) -> Decision:
    """Move the coarse border to the strongest edges within 2 px of 384 (``edges.snap``)."""
    image, coarse = _small(working, probability)
    return _decision(snap(image, coarse), coarse)


def dense_crf(working: Working, probability: np.ndarray) -> Decision:
    """Apply the mean field of a fully connected CRF (``dense_crf.mean_field``)."""
    image, coarse = _small(working, probability)
    marginal = mean_field(image, coarse)
    return _decision(marginal > 0.5, marginal)


METHODS: dict[str, Callable[[Working, np.ndarray], Decision]] = {
    "none": none,
    "edge": edge,
    "dense_crf": dense_crf,
    "grabcut_rect": grabcut_rect,
    "grabcut_mask": grabcut_mask,
}


def _small(working: Working, probability: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    image = shrink(working.bytes, SIDE)
    return image, resize(probability, image.shape[1], image.shape[0])


def trimap(coarse: np.ndarray, sure: float = 0.95, band: int = 5) -> np.ndarray:
    """Turn probabilities into GrabCut labels: sure above ``sure`` and ``band`` px inside."""
    import cv2

    sky = (coarse > 0.5).astype(np.uint8)
    ellipse = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * band + 1, 2 * band + 1))
    # Erosion treats the outside as a continuation of the picture: no band along the frame.
    inside = cv2.erode(sky, ellipse)
    outside = cv2.erode(1 - sky, ellipse)
    labels = np.where(sky == 1, cv2.GC_PR_FGD, cv2.GC_PR_BGD).astype(np.uint8)
    labels[(inside == 1) & (coarse > sure)] = cv2.GC_FGD
    labels[(outside == 1) & (coarse < 1 - sure)] = cv2.GC_BGD
    return labels


def cut(image: np.ndarray, labels: np.ndarray, iterations: int) -> np.ndarray:
    """Run GrabCut and return (h, w) bool sky; the labels stay if there is nothing to learn.

    It is deterministic: OpenCV's generator is seeded, so that recipes replay to the bit.
    """
    import cv2

    sky = (labels == cv2.GC_FGD) | (labels == cv2.GC_PR_FGD)
    unsure = (labels == cv2.GC_PR_FGD) | (labels == cv2.GC_PR_BGD)
    components = 5  # of GrabCut's color models: fewer pixels cannot be clustered
    enough = min(np.count_nonzero(sky), np.count_nonzero(~sky)) > components
    if not enough or not unsure.any() or min(labels.shape) < MINIMUM_SIDE:
        return np.asarray(sky)
    cv2.setRNGSeed(0)
    labels = labels.copy()
    models = np.zeros((1, 65)), np.zeros((1, 65))
    cv2.grabCut(
        np.ascontiguousarray(image), labels, None, *models, iterations, cv2.GC_INIT_WITH_MASK
    )
    return (labels == cv2.GC_FGD) | (labels == cv2.GC_PR_FGD)


def local_evidence(
    guide: np.ndarray, sky: np.ndarray, probability: np.ndarray, doubt: float
) -> np.ndarray:
    """Return the log likelihood ratio sky : land of each pixel's color, by the colors near it.

    Both are normal distributions with a mean and a variance of each opponent channel that
    change slowly over the picture, after Liba et al. 2020 (section 3.1, density estimation),
    but local: the sky beside a tree identifies the sky between its leaves.

    Parameters
    ----------
    guide : (h, w, 3) float32
        Encoded picture.
    sky : (h, w) bool
        Present decision.
    probability : (h, w) float32
        The network's probability. Sky below ``doubt``, land above 0.4 and uncertain land of the
        sky's own color are not used for learning.

    Returns
    -------
    (h, w) float32
    """
    import cv2

    color = opponent(guide)
    few = shrink(color, SIDE)

    def learn(mask: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        inner = cv2.erode(mask.astype(np.uint8), np.ones((5, 5), np.uint8))
        return local_moments(few, shrink(inner.astype(np.float32), SIDE), color.shape)

    mean, variance = learn(sky & (probability > doubt))
    difference = np.square(color - mean)
    # Sky behind a tree crown or a wheel: the network is not sure that it is land, and it has almost
    # the color of the sky beside it. Land learned from it would look like sky.
    like_sky = channel_sum(difference / np.minimum(variance, 0.02**2)) < 9
    ratio = difference / -variance
    mean, other = learn(~sky & (probability < 0.4) & ~(like_sky & (probability > 0.03)))
    ratio += np.square(color - mean) / other
    other /= variance
    spread = other[..., 0] * other[..., 1] * other[..., 2]
    return np.asarray((channel_sum(ratio) + np.log(spread)) / 2, np.float32)


def opponent(picture: np.ndarray) -> np.ndarray:
    """Return brightness, red against blue and green against magenta of a picture (h, w, 3)."""
    return picture @ np.array(
        [[1 / 3, 0.5, -0.25], [1 / 3, 0, 0.5], [1 / 3, -0.5, -0.25]], np.float32
    )


def local_moments(
    color: np.ndarray, weight: np.ndarray, shape: tuple[int, ...]
) -> tuple[np.ndarray, np.ndarray]:
    """Return mean and variance of weighted colors near each pixel, or of far ones if none is."""
    import cv2

    scale = min(1.0, 160 / max(weight.shape))
    size = max(4, round(weight.shape[1] * scale)), max(4, round(weight.shape[0] * scale))
    share = resize(weight, *size)
    sums = [resize(color**power * weight[..., None], *size) for power in (1, 2)]
    total = max(float(share.sum()), 1e-6)
    moments = [np.broadcast_to(x.sum(axis=(0, 1)) / total, x.shape) for x in sums]
    for sigma in (40, 16, 6):  # of 160 px: the finest scale with data dominates
        near = cv2.GaussianBlur(share, (0, 0), sigma)[..., None] + 0.02
        moments = [
            (cv2.GaussianBlur(x, (0, 0), sigma) + 0.02 * m) / near
            for x, m in zip(sums, moments, strict=True)
        ]
    mean, square = moments
    variance = np.maximum(square - mean**2, 0) + 0.02**2
    height, width = shape[:2]
    return (
        resize(mean.astype(np.float32), width, height),
        resize(variance.astype(np.float32), width, height),
    )


def _decision(sky: np.ndarray, coarse: np.ndarray) -> Decision:
    """Add the confidence: low along the skyline and where network and GrabCut disagree."""
    import cv2

    mask = sky.astype(np.uint8)
    edge = cv2.morphologyEx(mask, cv2.MORPH_GRADIENT, np.ones((3, 3), np.uint8))
    agreement = np.where(sky, coarse, 1 - coarse)
    confidence = np.clip(agreement, 0.05, 1) * np.where(edge == 1, 0.05, 1)
    return Decision(mask.astype(np.float32), confidence.astype(np.float32))
