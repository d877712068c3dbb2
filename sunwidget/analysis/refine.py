"""Refinement: from the network's coarse sky to a matte that follows the skyline (thesis 3.1.1.2).

Two steps. A method of ``METHODS`` decides sky or land on a copy of at most 384 px and says where
it is sure; then a guided filter, weighted by that sureness, carries the decision to every pixel of
the photo along its own edges (He et al., "Guided image filtering", 2013; weights after Liba et
al., "Sky optimization", 2020, section 3.2).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from sunwidget.analysis.dense_crf import mean_field
from sunwidget.analysis.edges import snap
from sunwidget.analysis.enlarge import Box, enlarged_part, pixels_of
from sunwidget.analysis.working import Working, channel_sum, encode, resize, shrink
from sunwidget.edit import Stroke
from sunwidget.photo import Photo

SIDE = 384
MINIMUM_SIDE = 4  # below this there is no neighbourhood to refine in
RADIUS, EPSILON = 6, 1e-4  # of the matte's guided filter, in working pixels and code values
CLEAR, OPAQUE = 0.06, 0.94  # what a guided filter makes of land and of sky
_TILE = 64  # working pixels
_ROUNDING = 1e-4  # far above float32's


class Decision(NamedTuple):
    """Sky or land at low resolution.

    ``sky`` (h, w) float32 in [0, 1], and ``sureness`` (h, w) float32 in (0, 1]. What is ``final``
    is a matte already: it is resized to the photo and follows no edges.
    """

    sky: np.ndarray
    sureness: np.ndarray
    final: bool = False


def none(working: Working, probability: np.ndarray) -> Decision:
    """Keep the coarse map as it is: a mask that the caller gave, say."""
    return Decision(probability, np.ones_like(probability), final=True)


def grabcut_rect(working: Working, probability: np.ndarray) -> Decision:
    """GrabCut from the bounding box of the coarse mask, as the thesis does.

    Source: Rother et al., "GrabCut", 2004. Nothing outside the box can become sky, and land
    inside it is told from sky by colour alone.
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
    """GrabCut from a trimap, then network and local colours together at working size.

    The trimap is sure where the network is sure and away from its own skyline. GrabCut's
    smooth contour loses what is thinner than its grid (twigs, pylons, the sky between leaves);
    the colours of sky and land near each pixel find it again.
    """
    image, coarse = _small(working, probability)
    sky = cut(image, trimap(coarse), iterations=2)
    if not sky.any() or sky.all() or min(working.width, working.height) < 16:
        return _decision(sky, coarse)
    cutout = sky.astype(np.float32)
    evidence = coarse
    # A network that is not sure of its own sky (a white wall indoors: 0.6 to 0.7 on average,
    # skies 0.8 and more) must not be spread by colour.
    trust = float(coarse[coarse > 0.5].mean()) if (coarse > 0.5).any() else 0.0
    weight = 0.8 * min(max((trust - 0.65) / 0.1, 0.0), 1.0)
    # The second round learns from what the first one found, and is the one at working size.
    rounds = (shrink(working.guide, SIDE), 0.4), (working.guide, 0.1)
    for guide, doubt in rounds:
        height, width = guide.shape[:2]
        certain = np.clip(resize(probability, width, height), 0.01, 0.99)
        cutout = resize(cutout, width, height)
        colours = local_evidence(guide, cutout > 0.5, certain, doubt)
        evidence = np.log(certain / (1 - certain)) + 0.4 * (2 * cutout - 1)
        evidence += weight * np.clip(colours, -6, 6)
        cutout = (evidence > 0).astype(np.float32)
    sureness = np.clip(np.abs(evidence) / 4, 0.02, 1)
    return Decision(cutout, sureness.astype(np.float32))


def edge(working: Working, probability: np.ndarray) -> Decision:
    """Draw the coarse border to the strongest edges within 2 px of 384 (``edges.snap``)."""
    image, coarse = _small(working, probability)
    return _decision(snap(image, coarse), coarse)


def dense_crf(working: Working, probability: np.ndarray) -> Decision:
    """Mean field of a fully connected conditional random field (``dense_crf.mean_field``)."""
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
    # Beyond the frame everything goes on as inside it: no band along the frame itself.
    inside = cv2.erode(sky, ellipse)
    outside = cv2.erode(1 - sky, ellipse)
    labels = np.where(sky == 1, cv2.GC_PR_FGD, cv2.GC_PR_BGD).astype(np.uint8)
    labels[(inside == 1) & (coarse > sure)] = cv2.GC_FGD
    labels[(outside == 1) & (coarse < 1 - sure)] = cv2.GC_BGD
    return labels


def cut(image: np.ndarray, labels: np.ndarray, iterations: int) -> np.ndarray:
    """Run GrabCut and return (h, w) bool sky; the labels stand when there is nothing to learn.

    Deterministic: OpenCV's generator is seeded, so that recipes replay to the bit.
    """
    import cv2

    sky = (labels == cv2.GC_FGD) | (labels == cv2.GC_PR_FGD)
    unsure = (labels == cv2.GC_PR_FGD) | (labels == cv2.GC_PR_BGD)
    components = 5  # of GrabCut's colour models: fewer pixels than that cannot be clustered
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
    """Log likelihood ratio sky : land of every pixel's colour, by the colours near it.

    Both are normal distributions with a mean and a variance of each opponent channel that
    change slowly over the picture, after Liba et al. 2020 (section 3.1, density estimation),
    but local: the sky beside a tree tells the sky between its leaves.

    Parameters
    ----------
    guide : (h, w, 3) float32
        Encoded picture.
    sky : (h, w) bool
        Present decision.
    probability : (h, w) float32
        Of the network; sky below ``doubt`` and land above 0.4 are not learned from, nor is
        doubted land of the sky's own colour.

    Returns
    -------
    (h, w) float32
    """
    import cv2

    # Brightness, red against blue, green against magenta.
    opponent = np.array([[1 / 3, 1 / 3, 1 / 3], [0.5, 0, -0.5], [-0.25, 0.5, -0.25]], np.float32)
    colour = guide @ opponent.T
    few = shrink(colour, SIDE)

    def learn(mask: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        inner = cv2.erode(mask.astype(np.uint8), np.ones((5, 5), np.uint8))
        return _local_moments(few, shrink(inner.astype(np.float32), SIDE), colour.shape)

    mean, variance = learn(sky & (probability > doubt))
    difference = np.square(colour - mean)
    # Sky seen through a crown or a wheel: the network doubts it is land, and it has very nearly
    # the colour of the sky beside. Land learned from it would look like sky.
    like_sky = channel_sum(difference / np.minimum(variance, 0.02**2)) < 9
    ratio = difference / -variance
    mean, other = learn(~sky & (probability < 0.4) & ~(like_sky & (probability > 0.03)))
    ratio += np.square(colour - mean) / other
    other /= variance
    spread = other[..., 0] * other[..., 1] * other[..., 2]
    return np.asarray((channel_sum(ratio) + np.log(spread)) / 2, np.float32)


def _local_moments(
    colour: np.ndarray, weight: np.ndarray, shape: tuple[int, ...]
) -> tuple[np.ndarray, np.ndarray]:
    """Mean and variance of weighted colours near each pixel, from afar where none is near."""
    import cv2

    scale = min(1.0, 160 / max(weight.shape))
    size = max(4, round(weight.shape[1] * scale)), max(4, round(weight.shape[0] * scale))
    share = resize(weight, *size)
    sums = [resize(colour**power * weight[..., None], *size) for power in (1, 2)]
    total = max(float(share.sum()), 1e-6)
    moments = [np.broadcast_to(x.sum(axis=(0, 1)) / total, x.shape) for x in sums]
    for sigma in (40, 16, 6):  # of the 160 px: the nearest scale that knows wins
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
    """Add the sureness: low along the skyline and where network and GrabCut disagree."""
    import cv2

    mask = sky.astype(np.uint8)
    edge = cv2.morphologyEx(mask, cv2.MORPH_GRADIENT, np.ones((3, 3), np.uint8))
    agreement = np.where(sky, coarse, 1 - coarse)
    sureness = np.clip(agreement, 0.05, 1) * np.where(edge == 1, 0.05, 1)
    return Decision(mask.astype(np.float32), sureness.astype(np.float32))


def matte(
    photo: Photo,
    working: Working,
    decision: Decision,
    strokes: Sequence[Stroke] = (),
    radius: int = RADIUS,
    epsilon: float = EPSILON,
) -> np.ndarray:
    """Carry a decision to the photo's own resolution along its edges.

    Parameters
    ----------
    photo : Photo
    working : Working
        Its small copy, on which the filter's coefficients are found.
    decision : Decision
        Low-resolution sky and sureness.
    strokes : sequence of Stroke
        Set hard under the brush.
    radius : int
        Half side of the filter's window in working pixels.
    epsilon : float
        Variance of the encoded photo below which an area is taken for flat.

    Returns
    -------
    (H, W) float32
        Alpha matte, 1 = sky.
    """
    width, height = photo.size
    if decision.final or min(working.width, working.height) < MINIMUM_SIDE:
        alpha = np.clip(resize(decision.sky, width, height), 0, 1)
    else:
        sky = resize(decision.sky, working.width, working.height)
        sureness = resize(decision.sureness, working.width, working.height)
        slope, offset = guided_coefficients(working.guide, sky, sureness, radius, epsilon)
        alpha = _at_full_size(photo, working.zoom, np.dstack([slope, offset]))
    set_strokes(alpha, strokes)
    return alpha


def _at_full_size(photo: Photo, zoom: tuple[float, float], lines: np.ndarray) -> np.ndarray:
    """Evaluate slope and offset (h, w, 4) at every pixel of the photo: (H, W) float32.

    Most tiles of a picture hold sky or land alone: whatever their pixels are, the matte is 1
    or 0 there, and they need not be looked at.
    """
    slope, offset = lines[..., :3], lines[..., 3]
    lowest = offset + np.minimum(slope, 0).sum(axis=-1)
    highest = offset + np.maximum(slope, 0).sum(axis=-1)
    width, height = photo.size
    alpha = np.empty((height, width), np.float32)
    for top in range(0, lines.shape[0], _TILE):
        for left in range(0, lines.shape[1], _TILE):
            bottom, right = min(top + _TILE, lines.shape[0]), min(left + _TILE, lines.shape[1])
            part = pixels_of(top, bottom, zoom[1]), pixels_of(left, right, zoom[0])
            # Interpolation sees a pixel more on each side.
            corner = max(top - 1, 0), max(left - 1, 0)
            near = slice(corner[0], bottom + 1), slice(corner[1], right + 1)
            if lowest[near].min() > OPAQUE + _ROUNDING:
                alpha[part] = 1
            elif highest[near].max() < CLEAR - _ROUNDING:
                alpha[part] = 0
            else:
                here = enlarged_part(np.ascontiguousarray(lines[near]), zoom, part, corner)
                alpha[part] = stretched(on_lines(here, photo, part))
    return alpha


def on_lines(lines: np.ndarray, photo: Photo, part: Box) -> np.ndarray:
    """Return slope · code values + offset for ``lines`` (h, w, 4) at a part of the photo's size."""
    import cv2

    code = photo.encoded[part]
    scale = 1.0
    if code.dtype.kind == "f":
        code = encode(code)
    else:
        scale = 1 / np.iinfo(code.dtype).max
    # With an opacity of 1 beside R, G and B one product takes in the offset.
    opaque = cv2.cvtColor(np.ascontiguousarray(code), cv2.COLOR_RGB2RGBA)
    product = cv2.multiply(lines, opaque, scale=scale, dtype=cv2.CV_32F)
    return cv2.transform(product, np.ones((1, 4), np.float32))


def stretched(alpha: np.ndarray) -> np.ndarray:
    """Stretch the ends: a guided filter leaves sure pixels a few percent short of 0 and 1."""
    return np.asarray(np.clip((alpha - CLEAR) / (OPAQUE - CLEAR), 0, 1), np.float32)


def set_strokes(matte: np.ndarray, strokes: Sequence[Stroke]) -> None:
    """Set the matte under each brush, in place: what a person says wins over everything."""
    for stroke in strokes:
        matte[paint(stroke, matte.shape[1], matte.shape[0])] = stroke.label == "sky"


def paint(
    stroke: Stroke, width: int, height: int, box: tuple[slice, slice] | None = None
) -> np.ndarray:
    """Return the pixels under the brush, (height, width) bool; at least one pixel wide.

    ``box`` (rows, columns) limits the answer to a part of the picture.
    """
    import cv2

    rows, columns = box or (slice(0, height), slice(0, width))
    canvas = np.zeros((rows.stop - rows.start, columns.stop - columns.start), np.uint8)
    fraction = 4  # bits of sub-pixel position
    points = np.array(
        [
            [(x * width - 0.5) * 2**fraction, (y * height - 0.5) * 2**fraction]
            for x, y in stroke.points
        ]
    )
    points = np.clip(np.round(points), -(2**24), 2**24).astype(np.int32)
    points -= np.array([columns.start, rows.start], np.int32) * 2**fraction
    radius = max(stroke.radius * max(width, height), 0.5)
    cv2.polylines(
        canvas,
        [points.reshape(-1, 1, 2)],
        False,
        1,
        max(1, round(2 * radius)),
        cv2.LINE_8,
        fraction,
    )
    for x, y in points:
        cv2.circle(
            canvas, (int(x), int(y)), round(radius * 2**fraction), 1, -1, cv2.LINE_8, fraction
        )
    return canvas > 0


def guided_coefficients(
    guide: np.ndarray, target: np.ndarray, weight: np.ndarray, radius: int, epsilon: float
) -> tuple[np.ndarray, np.ndarray]:
    """Fit ``target ≈ slope · guide + offset`` in every window, weighted, and average the fits.

    Parameters
    ----------
    guide : (h, w, 3) float32
    target, weight : (h, w) float32
    radius : int
        Half side of the window in pixels.
    epsilon : float
        Ridge on the slope, in squared units of the guide.

    Returns
    -------
    slope (h, w, 3), offset (h, w) : float32
    """
    import cv2

    side = (2 * radius + 1, 2 * radius + 1)

    def mean(x: np.ndarray) -> np.ndarray:
        return cv2.blur(np.ascontiguousarray(x), side, borderType=cv2.BORDER_REFLECT)

    total = np.maximum(mean(weight), 1e-6)
    mean_guide = mean(guide * weight[..., None]) / total[..., None]
    mean_target = mean(target * weight) / total
    covariance = mean(guide * (weight * target)[..., None]) / total[..., None]
    covariance -= mean_guide * mean_target[..., None]
    products = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]
    second = np.stack([guide[..., i] * guide[..., j] for i, j in products[:4]], axis=-1)
    third = np.stack([guide[..., i] * guide[..., j] for i, j in products[4:]], axis=-1)
    moments = np.concatenate(
        [mean(second * weight[..., None]), mean(third * weight[..., None])], axis=-1
    )
    moments /= total[..., None]
    rr, rg, rb, gg, gb, bb = (
        moments[..., k] - mean_guide[..., i] * mean_guide[..., j]
        for k, (i, j) in enumerate(products)
    )
    rr, gg, bb = rr + epsilon, gg + epsilon, bb + epsilon
    # Inverse of the symmetric 3 × 3 covariance by cofactors.
    c00, c01, c02 = gg * bb - gb * gb, gb * rb - rg * bb, rg * gb - gg * rb
    c11, c12, c22 = rr * bb - rb * rb, rb * rg - rr * gb, rr * gg - rg * rg
    determinant = rr * c00 + rg * c01 + rb * c02
    r, g, b = covariance[..., 0], covariance[..., 1], covariance[..., 2]
    slope = (
        np.stack(
            [c00 * r + c01 * g + c02 * b, c01 * r + c11 * g + c12 * b, c02 * r + c12 * g + c22 * b],
            axis=-1,
        )
        / np.maximum(determinant, 1e-18)[..., None]
    )
    offset = mean_target - np.einsum("hwc,hwc->hw", slope, mean_guide)
    # Windows that know more count more in the average, too.
    average = mean(total)
    slope = mean(slope * total[..., None]) / average[..., None]
    return slope.astype(np.float32), (mean(offset * total) / average).astype(np.float32)
