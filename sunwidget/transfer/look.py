"""The look of a before/after pair, transferred to another photo.

After Shih et al., "Data-driven Hallucination of Different Times of Day from a Single Outdoor Photo"
(2013): a locally affine color transform is learned from two registered pictures (two frames of one
time-lapse camera, or a picture and its retouched version) and transferred to the photo by dense
correspondence. Instead of their matting solver, the transforms are smoothed along the photo's
edges. They are applied to the full photo, so that its detail remains.
"""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np

from sunwidget.analysis.images.working_copy import Working, resize, shrink
from sunwidget.analysis.segmentation import coarse_sky
from sunwidget.errors import AnalysisError
from sunwidget.formats.color import linear_to_srgb, srgb_to_linear, strips
from sunwidget.photo.photo import Photo, open_photo
from sunwidget.transfer.correspondence import correspond, normalization
from sunwidget.transfer.encode import check_strength, photo_like
from sunwidget.transfer.land import rows_at
from sunwidget.transfer.local_affine import (
    apply,
    base_of,
    global_affine,
    limit_contrast_loss,
    local_affine,
    local_contrast,
    smooth_along_edges,
)

if TYPE_CHECKING:
    from sunwidget.progress import Progress

_LONG_SIDE = 240  # of the compared copies: 40,000 points match in seconds
_LEARNED_SIDE = 640  # of the pair when the transforms are fitted
# Windows are shares of the long side; other values are variances in squared encoded units.
_WINDOW, _FLAT = 0.012, 1e-3  # of the fit
_SMOOTH, _EDGE = 0.012, 1e-3  # of the smoothing along the photo's edges
_DETAIL, _STRONG = 0.01, 1e-2  # finer and weaker structure is detail
_CALM = 0.08  # standard deviation of the Gaussian that smooths the sky's transforms
_LEAST = 0.01  # least share of a picture for a usable sky or land
_CONTRAST = 1.5  # largest gain of detail


def transfer_look(
    photo: Any,
    before: Any,
    after: Any,
    *,
    strength: float = 1.0,
    progress: Progress | None = None,
) -> Photo:
    """Apply the change from ``before`` to ``after`` to a photo (``sunwidget.transfer_look``).

    Parameters
    ----------
    photo : Photo or Scene, or any source for ``open``
    before, after : likewise
        Two pictures of one view, registered pixel by pixel: frames of a fixed camera, or a picture
        and its edited version. ``before`` should resemble the photo.
    strength : float, default 1
        0 (exactly the photo) to 1.
    progress : callable, optional
        Called with (fraction, message); raise in it to cancel.

    Returns
    -------
    Photo
        Size, depth, profile and metadata of ``photo``.

    Raises
    ------
    AnalysisError
        When the pair's shapes differ, or ``strength`` is not a number from 0 to 1.
    PhotoError
        When a picture cannot be opened.
    """
    check_strength(strength)
    report = progress or (lambda _fraction, _message: None)
    photo, before, after = (_photo(picture) for picture in (photo, before, after))
    if abs(before.width * after.height - after.width * before.height) > max(
        before.width + before.height, after.width + after.height
    ):
        raise AnalysisError(
            f"before ({before.width}×{before.height}) and after ({after.width}×{after.height}) "
            "must show the same view pixel by pixel. Crop them to the same shape."
        )
    if strength == 0:
        return dataclasses.replace(photo)
    report(0.0, "Comparing the photo with the pair")
    change, contrast = _find_change(photo, before, after)
    light = np.empty((photo.height, photo.width, 3), np.float32)
    reach = max(1, round(_DETAIL * max(photo.size)))
    for rows in strips(light.shape):
        # Include pixels beside the strip; otherwise the base would show its borders.
        first, last = max(rows.start - 2 * reach, 0), min(rows.stop + 2 * reach, photo.height)
        inner = slice(rows.start - first, rows.stop - first)
        code = linear_to_srgb(photo.pixels[first:last])
        base = base_of(code, reach, _STRONG)[inner]
        here, code = photo.pixels[rows], code[inner]
        by_pixel = np.stack(
            [rows_at(change[..., i, :], rows, photo.size) for i in range(3)], axis=-2
        )
        gain = rows_at(contrast, rows, photo.size)[..., None] - 1
        step = apply(by_pixel, base) + gain * (code - base)
        changed = np.clip(code + strength * step, 0, 1)
        # Add a difference of light, so that no change is exact and no color is clipped.
        light[rows] = here + srgb_to_linear(changed) - srgb_to_linear(code)
        report(0.5 + 0.5 * rows.stop / photo.height, "Changing the colors")
    return photo_like(photo, light)


def _find_change(photo: Photo, before: Photo, after: Photo) -> tuple[np.ndarray, np.ndarray]:
    """Return the change of the photo's colors: affine maps for the base, a gain for detail.

    Returns
    -------
    (h, w, 3, 4), (h, w) float32
        Maps from encoded colors to their change; contrast of the detail.
    """
    ours, our_sky = _small(photo)
    theirs, their_sky = _small(before)
    gain, shift = normalization(ours, our_sky, theirs, their_sky)
    level = ours * gain + shift
    matched = correspond(level, our_sky, theirs, their_sky)
    learned, crisp = _learn(before, after, theirs.shape[1::-1])
    learned = _smooth_sky(learned, their_sky)
    # Where the pair shows nothing similar, use the global transform of its sky or land.
    alike = matched.likeness[..., None, None]
    plain = _by_label(before, after, our_sky, their_sky)
    carried = plain + alike * (matched.carry(learned) - plain)
    carried = limit_contrast_loss(carried, _pivot(level, our_sky))
    # The change by the transform, for the photo at the level of ``before``.
    carried[..., :3] -= np.eye(3, dtype=np.float32)
    change = np.empty_like(carried)
    change[..., :3] = carried[..., :3] * gain[..., None, :]
    change[..., 3] = np.einsum("hwij,hwj->hwi", carried[..., :3], shift) + carried[..., 3]
    # Smoothed on a finer copy of the photo, whose edges are sharper.
    guide = _fine(photo)
    # The less similar the pictures, the more the transforms are smoothed.
    reach = _SMOOTH * (1 + 4 * (1 - float(matched.likeness.mean())))
    radius = max(2, round(reach * max(guide.shape[:2])))
    size = guide.shape[1::-1]
    rows = [resize(np.ascontiguousarray(change[..., i, :], np.float32), *size) for i in range(3)]
    crisp = 1 + matched.likeness * (matched.carry(crisp) - 1)
    crisp = resize(np.asarray(crisp, np.float32), *size)
    return (
        smooth_along_edges(np.stack(rows, axis=-2), guide, radius, _EDGE),
        smooth_along_edges(crisp, guide, radius, _EDGE),
    )


def _by_label(
    before: Photo, after: Photo, our_sky: np.ndarray, their_sky: np.ndarray
) -> np.ndarray:
    """Return global transforms of sky and land, blended by the photo's sky, (h, w, 3, 4)."""
    height, width = their_sky.shape
    first, second = (resize(_fine(picture), width, height) for picture in (before, after))
    share = float(their_sky.mean())
    weights = [their_sky if share > _LEAST else None, 1 - their_sky if share < 1 - _LEAST else None]
    sky, land = (global_affine(first, second, weight) for weight in weights)
    return np.asarray(land + our_sky[..., None, None] * (sky - land), np.float32)


def _learn(before: Photo, after: Photo, size: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Return local transforms and contrasts of the pair at ``size``, fitted on finer copies."""
    pair = [_fine(before), _fine(after)]
    fine = pair[0].shape[1::-1]
    if pair[1].shape != pair[0].shape:
        pair[1] = resize(pair[1], *fine)
    radius = max(2, round(_WINDOW * max(fine)))
    # Fit on pictures without detail, on which the transforms will be applied.
    base = [base_of(p, max(1, round(_DETAIL * max(fine))), _STRONG) for p in pair]
    maps = local_affine(base[0], base[1], radius, _FLAT)
    rows = [resize(np.ascontiguousarray(maps[..., i, :]), *size) for i in range(3)]
    crisp = local_contrast(pair[0] - base[0], pair[1] - base[1], radius, _CONTRAST)
    return np.stack(rows, axis=-2), resize(crisp, *size)


def _smooth_sky(learned: np.ndarray, sky: np.ndarray) -> np.ndarray:
    """Smooth the transforms of the sky widely, since its clouds differ from the photo's."""
    import cv2

    deviation = _CALM * max(sky.shape)
    flat = learned.reshape(*sky.shape, 12) * sky[..., None]
    weight = cv2.GaussianBlur(np.asarray(sky, np.float32), (0, 0), deviation)
    parts = [cv2.GaussianBlur(flat[..., i], (0, 0), deviation) for i in range(12)]
    slow = np.stack(parts, -1) / np.maximum(weight, 1e-4)[..., None]
    share = sky[..., None, None]
    return np.asarray(learned + share * (slow.reshape(learned.shape) - learned), np.float32)


def _pivot(level: np.ndarray, sky: np.ndarray) -> np.ndarray:
    """Return mean colors of the neighborhood, a wide one in the sky, where clouds move."""
    import cv2

    near, wide = (cv2.GaussianBlur(level, (0, 0), s * max(sky.shape)) for s in (_WINDOW, _CALM))
    return np.asarray(near + sky[..., None] * (wide - near))


def _fine(photo: Photo) -> np.ndarray:
    """Return encoded colors at most ``_LEARNED_SIDE`` px."""
    return linear_to_srgb(shrink(np.maximum(photo.pixels, 0), _LEARNED_SIDE))


def _small(photo: Photo) -> tuple[np.ndarray, np.ndarray]:
    """Return encoded colors and coarse sky of a photo, at most ``_LONG_SIDE`` px."""
    working = Working.of(photo).shrunk(_LONG_SIDE)
    sky = coarse_sky.coarse(Working.of(photo), None, photo.size, None)
    return working.encoded, np.clip(resize(sky, working.width, working.height), 0, 1)


def _photo(source: Any) -> Photo:
    return open_photo(getattr(source, "photo", source))
