"""Locally affine color transforms, learned from a registered pair and applied to a picture.

A transform is a map (h, w, 3, 4): row i gives output channel i from R, G, B and 1.
"""

from __future__ import annotations

import numpy as np

_GRAIN = 2e-4  # variance of grain in squared encoded units
_LEAST_CONTRAST = 0.45  # least share of a color difference that a transform may leave
_RIDGE = 1e-4  # of the global fit, in squared encoded units


def global_affine(
    before: np.ndarray, after: np.ndarray, weight: np.ndarray | None = None
) -> np.ndarray:
    """Return the least-squares affine (3, 4) from ``before`` to ``after`` (h, w, 3).

    It is regularized towards the identity. ``weight`` (h, w) weights the pixels; default equally.
    """
    x = before.reshape(-1, 3).astype(np.float64)
    y = after.reshape(-1, 3).astype(np.float64)
    share = np.ones(len(x)) if weight is None else weight.ravel().astype(np.float64)
    share = share / max(float(share.sum()), 1e-9)
    mean_x, mean_y = share @ x, share @ y
    covariance = (x - mean_x).T @ ((x - mean_x) * share[:, None])
    cross = (x - mean_x).T @ ((y - mean_y) * share[:, None])
    ridge = _RIDGE * np.eye(3)
    matrix = np.linalg.solve(covariance + ridge, cross + ridge).T
    return np.column_stack([matrix, mean_y - matrix @ mean_x])


def local_affine(before: np.ndarray, after: np.ndarray, radius: int, epsilon: float) -> np.ndarray:
    """Fit an affine in the window around each pixel, regularized towards the global one.

    The regression of the guided filter (He et al. 2010, eq. 19), in which a flat window falls back
    to the global affine instead of zero.

    Parameters
    ----------
    before, after : (h, w, 3) float32
        Registered, encoded in [0, 1].
    radius : int
        Radius of the window in pixels.
    epsilon : float
        Variance, in squared encoded units, below which the global affine dominates.

    Returns
    -------
    (h, w, 3, 4) float32
    """
    fallback = global_affine(before, after)
    x, y = before.astype(np.float64), after.astype(np.float64)
    mean_x, mean_y = _mean(x, radius), _mean(y, radius)

    def covariance(a: np.ndarray, b: np.ndarray, of_a: np.ndarray, of_b: np.ndarray) -> np.ndarray:
        products = (a[..., :, None] * b[..., None, :]).reshape(*a.shape[:2], 9)
        return _mean(products, radius).reshape(*a.shape[:2], 3, 3) - (
            of_a[..., :, None] * of_b[..., None, :]
        )

    regular = covariance(x, x, mean_x, mean_x) + epsilon * np.eye(3)
    cross = covariance(x, y, mean_x, mean_y) + epsilon * fallback[:, :3].T
    matrix = np.swapaxes(np.linalg.solve(regular, cross), -1, -2)
    shift = mean_y - np.einsum("hwij,hwj->hwi", matrix, mean_x)
    return np.concatenate([matrix, shift[..., None]], -1).astype(np.float32)


def limit_contrast_loss(transforms: np.ndarray, pivot: np.ndarray) -> np.ndarray:
    """Prevent transforms from flattening or inverting color differences.

    Where things moved between the two pictures, the regression finds no contrast or inverts it:
    haze, or dark instead of white clouds. Its effect on the mean is still valid.

    Parameters
    ----------
    transforms : (h, w, 3, 4) float32
    pivot : (h, w, 3) float32
        Colors whose result is kept: means of the neighborhood.

    Returns
    -------
    (h, w, 3, 4) float32
        Mixed with a plain gain until every direction keeps at least ``_LEAST_CONTRAST``.
    """
    matrix = transforms[..., :3]
    lowest = np.linalg.eigvalsh((matrix + np.swapaxes(matrix, -1, -2)) / 2)[..., 0]
    gain = np.maximum(np.trace(matrix, axis1=-2, axis2=-1) / 3, 2 * _LEAST_CONTRAST)
    missing = (_LEAST_CONTRAST - lowest) / np.maximum(gain - lowest, 1e-6)
    share = np.clip(missing, 0, 1)[..., None, None]
    plain = gain[..., None, None] * np.eye(3, dtype=np.float32)
    kept = matrix + share * (plain - matrix)
    shift = transforms[..., 3] + np.einsum("hwij,hwj->hwi", matrix - kept, pivot)
    return np.concatenate([kept, shift[..., None]], -1).astype(np.float32)


def local_contrast(before: np.ndarray, after: np.ndarray, radius: int, limit: float) -> np.ndarray:
    """Return the deviation of ``after`` over that of ``before`` in the window around each pixel.

    A regression blurs detail that moved between the two pictures; the ratio of deviations keeps it
    sharp.

    Returns
    -------
    (h, w) float32 in 1 / limit … limit
    """
    spread = []
    for picture in (before, after):
        x = picture.astype(np.float64)
        variance = _mean(np.square(x), radius) - np.square(_mean(x, radius))
        spread.append(np.sqrt(np.maximum(variance.mean(-1), 0) + _GRAIN))
    ratio = spread[1] / spread[0]
    return np.clip(ratio, 1 / limit, limit).astype(np.float32)


def base_of(image: np.ndarray, radius: int, epsilon: float) -> np.ndarray:
    """Return the picture without detail: smoothed, but not across strong edges."""
    import cv2

    return np.asarray(cv2.ximgproc.guidedFilter(image, image, radius, epsilon))


def smooth_along_edges(
    transforms: np.ndarray, guide: np.ndarray, radius: int, epsilon: float
) -> np.ndarray:
    """Smooth a map (h, w, …) along the edges of ``guide`` (h, w, 3), without seams."""
    import cv2

    flat = np.asarray(transforms.reshape(*transforms.shape[:2], -1), np.float32)
    parts = [
        cv2.ximgproc.guidedFilter(guide, np.ascontiguousarray(flat[..., i]), radius, epsilon)
        for i in range(flat.shape[-1])
    ]
    return np.stack(parts, -1).reshape(transforms.shape)


def apply(transforms: np.ndarray, image: np.ndarray) -> np.ndarray:
    """Apply (h, w, 3, 4) transforms to (h, w, 3) colors."""
    return np.einsum("hwij,hwj->hwi", transforms[..., :3], image) + transforms[..., 3]


def _mean(values: np.ndarray, radius: int) -> np.ndarray:
    """Return the mean over the square window around each pixel, reflected at the border."""
    import cv2

    size = (2 * radius + 1, 2 * radius + 1)
    parts = [
        cv2.blur(np.ascontiguousarray(values[..., i]), size, borderType=cv2.BORDER_REFLECT)
        for i in range(values.shape[-1])
    ]
    return np.stack(parts, -1)
