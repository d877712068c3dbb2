"""Continuing a picture over what is not known: smoothly (push-pull pyramid), and with texture.

Gortler et al. 1996, "The Lumigraph", section 3.4.2.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.working import resize, smoothstep

_LAYERED = 0.25  # correlation of left and right from which all of a texture goes on; at 0 none
_RAGGED = 3.0  # rows over which the edge that a texture is mirrored at is smoothed


def fill_by_pyramid(values: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Push–pull: average upwards by weight, then fill downwards where weight is missing.

    Parameters
    ----------
    values : (h, w, c) float32
    weight : (h, w) float32
        Trust in each value, [0, 1].

    Returns
    -------
    (h, w, c) float32
        ``values`` where the weight is 1, a smooth continuation where it is 0.
    """
    import cv2

    height, width = weight.shape
    if height <= 2 or width <= 2:
        total = float(weight.sum())
        mean = (values * weight[..., None]).sum((0, 1)) / total if total > 0 else 0 * values[0, 0]
        return np.broadcast_to(mean, values.shape).astype(np.float32).copy()
    weighted = np.dstack([values * weight[..., None], weight])
    sums = resize(weighted, (width + 1) // 2, (height + 1) // 2)
    coarse_weight = sums[..., -1]
    coarse = sums[..., :-1] / np.maximum(coarse_weight, 1e-6)[..., None]
    coarse = fill_by_pyramid(coarse, np.clip(coarse_weight * 4, 0, 1))
    below = cv2.resize(coarse, (width, height), interpolation=cv2.INTER_LINEAR)
    below = cv2.GaussianBlur(below, (0, 0), 1.0).reshape(values.shape)
    share = weight[..., None]
    return (share * values + (1 - share) * below).astype(np.float32)


def mirrored(values: np.ndarray, beside: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Continue a texture along its rows: each gap shows what lies left and right of it, mirrored.

    Most skies are layered, and a mirrored layer goes on without a step. Where left and right are
    not alike there are no layers: the gap stays smooth, since scraps of clouds would look torn.

    Parameters
    ----------
    values : (h, w, c) float32
        A texture of mean 0; finite in the gaps, too.
    beside : (h, w) float32
        0 in the gaps, 1 beside them.
    known : (h, w) float32
        How far the texture is known, [0, 1].

    Returns
    -------
    (h, w, c) float32
        ``values`` beside the gaps; near 0 where no layers are seen on both sides of the gap.
    """
    import cv2

    rows, columns = known.shape
    at = np.arange(columns, dtype=np.float32)
    outside = beside > 0.5
    left_edge = np.maximum.accumulate(np.where(outside, at, -columns), 1)
    right_edge = np.minimum.accumulate(np.where(outside, at, 2 * columns)[:, ::-1], 1)[:, ::-1]
    share_of_left = (right_edge - at) / np.maximum(right_edge - left_edge, 1)
    share_of_left = np.where(left_edge < 0, 0, np.where(right_edge >= columns, 1, share_of_left))
    texture = np.dstack([values * known[..., None], known]).astype(np.float32)
    row = np.broadcast_to(np.arange(rows, dtype=np.float32)[:, None], (rows, columns))
    sides = []
    for edge, share in ((left_edge, share_of_left), (right_edge, 1 - share_of_left)):
        # A ragged edge would shear what is mirrored at it.
        edge = cv2.GaussianBlur(edge.astype(np.float32), (0, 0), sigmaX=1e-3, sigmaY=_RAGGED)
        seen = cv2.remap(texture, 2 * edge - at, row, cv2.INTER_LINEAR, borderValue=0)
        sides.append(seen * (share * ~outside)[..., None])
    (left, of_left), (right, of_right) = ((seen[..., :-1], seen[..., -1:]) for seen in sides)
    alike = _likeness(left * of_right, right * of_left)
    # Two textures that know nothing of each other add as their squares do, like ones as they are.
    squares = of_left**2 + of_right**2 + 2 * alike * of_left * of_right
    whole = np.minimum(of_left + of_right, 1) / np.maximum(np.sqrt(squares), 1e-3)
    whole = whole * smoothstep(0.0, _LAYERED, alike)
    texture = np.asarray(whole * (left + right), np.float32)
    # Above and below, rows that are mirrored meet rows that are not: the step between them fades
    # into the gap (Perez et al. 2003, "Poisson image editing").
    gap = (~outside).astype(np.float32)
    rim = cv2.dilate(gap, np.ones((3, 3), np.uint8)) * known * outside
    step = values - fill_by_pyramid(texture, gap)
    texture = texture + fill_by_pyramid(step, rim.astype(np.float32))
    return np.where(outside[..., None], values, texture)


def _likeness(one: np.ndarray, other: np.ndarray) -> float:
    """Return the correlation of two textures of mean 0, not below 0."""
    strength = float(np.sqrt((one**2).sum() * (other**2).sum()))
    return max(float((one * other).sum()), 0.0) / max(strength, 1e-9)
