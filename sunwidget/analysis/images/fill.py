"""Continue a picture over unknown pixels: smoothly (push-pull pyramid), and with texture.

Gortler et al. 1996, "The Lumigraph", section 3.4.2.
"""

from __future__ import annotations

import numpy as np

from sunwidget.analysis.images.working_copy import resize, smoothstep

_FLAT = 6  # a sky's layers are that many times as wide as high
_LAYERED = 0.25  # correlation of left and right at which the whole texture continues; at 0 none
_SEARCHED = 160  # pixels of the copy on which a match for a gap's surroundings is searched
_SURROUNDINGS = 0.04  # of its longer side: width of the compared ring around a gap
_ALL_KNOWN = 0.9  # least known share of such a place
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
    there are no layers: the gap stays smooth, since fragments of clouds would look torn.

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
    share_of_left = np.where(left_edge < 0, 0, np.where(right_edge >= columns, 1, share_of_left))
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
    layered = smoothstep(0.0, _LAYERED, alike)
    texture = np.asarray(layered * whole * (left + right), np.float32)
    if layered < 1:
        texture += (1 - layered) * transplant_texture(values, outside, known)
    # Above and below the gap, mirrored rows meet the original: the step between them fades into
    # the gap (Perez et al. 2003, "Poisson image editing").
    gap = (~outside).astype(np.float32)
    rim = cv2.dilate(gap, np.ones((3, 3), np.uint8)) * known * outside
    step = values - fill_by_pyramid(texture, gap)
    texture = texture + fill_by_pyramid(step, rim.astype(np.float32))
    return np.where(outside[..., None], values, texture)


def transplant_texture(values: np.ndarray, outside: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Fill a gap with the texture of the place whose surroundings match the gap's best.

    A single place, moved and perhaps mirrored, fills the whole gap, so that it remains one sky (as
    Criminisi et al. 2004, "Region filling", choose each patch). Its weight is the correlation of
    the two surroundings, and the similarity in strength of the texture to the gap's surroundings.

    Parameters
    ----------
    values : (h, w, c) float32
        A texture of mean 0.
    outside : (h, w) bool
        False in the gap.
    known : (h, w) float32
        Confidence of the texture, [0, 1].

    Returns
    -------
    (h, w, c) float32
        0 outside the gap, and everywhere if no known place is large enough.
    """
    import cv2

    if outside.all() or not outside.any():
        return np.zeros_like(values)
    scale = min(1.0, _SEARCHED / max(outside.shape))
    size = tuple(max(4, round(n * scale)) for n in outside.shape[::-1])
    likeness, down, right, flipped = _likest(
        resize(values.mean(-1), *size),
        resize(known * outside, *size) > 0.5,
        resize((~outside).astype(np.float32), *size) > 0.01,
    )
    source = np.ascontiguousarray(values[:, ::-1] if flipped else values, np.float32)
    move = np.array([[1, 0, -round(right / scale)], [0, 1, -round(down / scale)]], np.float32)
    seen = cv2.warpAffine(source, move, outside.shape[::-1], borderValue=0)
    return np.asarray(likeness * seen.reshape(values.shape) * ~outside[..., None], np.float32)


def _likest(gray: np.ndarray, known: np.ndarray, gap: np.ndarray) -> tuple[float, int, int, bool]:
    """Return the similarity, [0, 1], of the place that best matches a gap, and its position.

    The position is in rows down and columns right of the gap, and whether in the mirror image.
    Takes a texture (h, w) of mean 0, where it is known, and the gap (h, w) bool.
    """
    import cv2

    side = 2 * max(2, round(_SURROUNDINGS * max(gap.shape))) + 1
    near = cv2.dilate(gap.astype(np.uint8), np.ones((side, side), np.uint8)) > 0
    rows, columns = (np.flatnonzero(near.any(axis)) for axis in (1, 0))
    box = np.s_[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    ring = near & ~gap & known
    best = (0.0, 0, 0, False)
    if not ring.any():
        return best
    strength = np.sqrt(np.square(gray[ring]).mean()) + 1e-6
    around, inside = (mask[box].astype(np.float32) for mask in (ring, gap))
    whole = np.maximum(around, inside)
    for flipped in (False, True):
        image, clear = (
            np.ascontiguousarray(a[:, ::-1] if flipped else a, np.float32) for a in (gray, known)
        )
        like = cv2.matchTemplate(image, gray[box], cv2.TM_CCORR_NORMED, mask=around)
        # A cloud without counterpart in the surroundings would be a fragment in a clear sky.
        squares = cv2.matchTemplate(np.square(image), inside, cv2.TM_CCORR) / inside.sum()
        stronger = (np.sqrt(np.maximum(squares, 0)) + 1e-6) / strength
        like = like * np.minimum(stronger, 1 / stronger)
        share = cv2.matchTemplate(clear, whole, cv2.TM_CCORR) / whole.sum()
        like = np.where((share > _ALL_KNOWN) & np.isfinite(like), like, 0)
        row, column = np.unravel_index(int(like.argmax()), like.shape)
        if like[row, column] > best[0]:
            best = (float(like[row, column]), int(row - rows[0]), int(column - columns[0]), flipped)
    return best


def _likeness(one: np.ndarray, other: np.ndarray) -> float:
    """Return the correlation of two textures of mean 0, at least 0."""
    strength = float(np.sqrt((one**2).sum() * (other**2).sum()))
    return max(float((one * other).sum()), 0.0) / max(strength, 1e-9)
