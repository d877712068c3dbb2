"""Continue a picture over unknown pixels: smoothly (push-pull pyramid), and with texture.

Gortler et al. 1996, "The Lumigraph", section 3.4.2.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.images.working_copy import resize, smoothstep

_FLAT = 6  # a sky's layers are that many times as wide as high
_LAYERED = 0.25  # correlation of left and right at which the whole texture continues; at 0 none
_STREAKS = 4.0, 8.0  # how much steeper layers are upwards than along their rows (squares)
_FINER = 0.004  # in longer sides: detail finer than that is grain
_RAGGED = 3.0  # rows over which the mirror edge of a texture is smoothed


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


def fill_by_layers(values: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Continue a sky along its rows first, since skies are layered.

    Rows that are known somewhere have their mean, gaps what lies left and right of them; only then
    is the rest continued alike in all directions. Parameters and result are those of
    ``fill_by_pyramid``.
    """
    import cv2

    height, width = weight.shape
    values = values.astype(np.float32)
    known = weight.sum(1)
    rows = np.flatnonzero(known > 0.02 * width)
    if not rows.size:
        return fill_by_pyramid(values, weight)
    means = (values * weight[..., None]).sum(1)[rows] / known[rows, None]
    means = cv2.GaussianBlur(means, (0, 0), sigmaX=1e-3, sigmaY=2.0) if len(rows) > 1 else means
    layers = np.stack([np.interp(np.arange(height), rows, mean) for mean in means.T], -1)[:, None]
    apart = (values - layers).astype(np.float32)
    narrow = resize(np.dstack([apart * weight[..., None], weight]), max(width // _FLAT, 2), height)
    sums, share = narrow[..., :-1], narrow[..., -1]
    along = fill_by_pyramid(sums / np.maximum(share, 1e-6)[..., None], np.clip(share, 0, 1))
    layers = layers + cv2.resize(along, (width, height)).reshape(values.shape)
    return np.asarray(layers + fill_by_pyramid((values - layers).astype(np.float32), weight))


def mirror_texture(values: np.ndarray, beside: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Continue a texture along its rows: fill each gap with its mirrored left and right sides.

    Most skies are layered, and a mirrored layer continues without a step. If left and right differ,
    there are no layers: the gap stays smooth, since fragments of clouds would look torn. So does a
    gap at the picture's side, unless the texture consists of streaks along the rows.

    Parameters
    ----------
    values : (h, w, c) float32
        A texture of mean 0; finite in the gaps, too.
    beside : (h, w) float32
        0 in the gaps, 1 beside them.
    known : (h, w) float32
        Confidence of the texture, [0, 1].

    Returns
    -------
    (h, w, c) float32
        ``values`` beside the gaps; near 0 in a gap without layers on both sides.
    """
    import cv2

    rows, columns = known.shape
    at = np.arange(columns, dtype=np.float32)
    outside = beside > 0.5
    left_edge = np.maximum.accumulate(np.where(outside, at, -columns), 1)
    right_edge = np.minimum.accumulate(np.where(outside, at, 2 * columns)[:, ::-1], 1)[:, ::-1]
    share_of_left = (right_edge - at) / np.maximum(right_edge - left_edge, 1)
    between = (left_edge >= 0) & (right_edge < columns)
    share_of_left = np.where(between, share_of_left, left_edge >= 0)
    texture = np.dstack([values * known[..., None], known]).astype(np.float32)
    row = np.broadcast_to(np.arange(rows, dtype=np.float32)[:, None], (rows, columns))
    sides = []
    for edge, share in ((left_edge, share_of_left), (right_edge, 1 - share_of_left)):
        # A ragged edge would shear the mirrored texture.
        edge = cv2.GaussianBlur(edge.astype(np.float32), (0, 0), sigmaX=1e-3, sigmaY=_RAGGED)
        seen = cv2.remap(texture, 2 * edge - at, row, cv2.INTER_LINEAR, borderValue=0)
        sides.append(seen * (share * ~outside)[..., None])
    (left, of_left), (right, of_right) = ((seen[..., :-1], seen[..., -1:]) for seen in sides)
    alike = _likeness(left * of_right, right * of_left)
    # Independent textures add in squares, equal ones linearly.
    squares = of_left**2 + of_right**2 + 2 * alike * of_left * of_right
    whole = np.minimum(of_left + of_right, 1) / np.maximum(np.sqrt(squares), 1e-3)
    streaks = _streaks(values, known)
    layered = np.where(between, max(float(smoothstep(0.0, _LAYERED, alike)), streaks), streaks)
    texture = np.asarray(layered[..., None] * whole * (left + right), np.float32)
    # Above and below the gap, mirrored rows meet the original: the step between them fades into
    # the gap (Perez et al. 2003, "Poisson image editing").
    gap = (~outside).astype(np.float32)
    rim = cv2.dilate(gap, np.ones((3, 3), np.uint8)) * known * outside
    step = values - fill_by_pyramid(texture, gap)
    texture = texture + fill_by_pyramid(step, rim.astype(np.float32))
    return np.where(outside[..., None], values, texture)


def _likeness(one: np.ndarray, other: np.ndarray) -> float:
    """Return the correlation of two textures of mean 0, at least 0."""
    strength = float(np.sqrt((one**2).sum() * (other**2).sum()))
    return max(float((one * other).sum()), 0.0) / max(strength, 1e-9)


def _streaks(values: np.ndarray, known: np.ndarray) -> float:
    """Return whether a texture consists of streaks along its rows, [0, 1]."""
    import cv2

    values = cv2.GaussianBlur(
        values.astype(np.float32), (0, 0), max(_FINER * max(known.shape), 0.5)
    )
    inside = np.minimum(known[1:, 1:], np.minimum(known[:-1, 1:], known[1:, :-1])) > 0.5
    along = np.square(values[1:, 1:] - values[1:, :-1])[inside].sum()
    across = np.square(values[1:, 1:] - values[:-1, 1:])[inside].sum()
    return float(smoothstep(*_STREAKS, across / max(float(along), 1e-9)))
