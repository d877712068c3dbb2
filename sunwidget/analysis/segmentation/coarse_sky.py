"""Coarse sky: a rough map of sky pixels (thesis 3.1.1.1).

``METHODS`` maps a name to a function ``(Working) -> (h, w) float32`` that gives the probability of
sky. ``analyze(sky=…)`` also takes a mask, or any segmentation network (``sky_network``).
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from sunwidget.analysis.images.working_copy import Working, resize
from sunwidget.analysis.networks.sky import look_at_sky
from sunwidget.analysis.segmentation.sky_network import SkyNetwork
from sunwidget.errors import AnalysisError, PhotoError
from sunwidget.photo.photo import open_photo


def network(working: Working) -> np.ndarray:
    """Ask the bundled network, at 384 × 384 (models/MODEL_CARD.md)."""
    return look_at_sky(working).sky


def skyline(working: Working) -> np.ndarray:
    """Find the sky without a network: everything above the first strong edge of each column.

    The edge threshold maximizes the uniformity of color in sky and land (Shen & Wang, "Sky region
    detection in a single image for autonomous ground robot navigation", 2013, equations 1–9). It
    works for an open horizon; branches, clouds and buildings mislead it.
    """
    import cv2

    width = min(working.width, 240)
    height = max(1, round(working.height * width / working.width))
    image = resize(working.encoded, width, height).astype(np.float32) * 255
    height, width = image.shape[:2]
    gray = cv2.GaussianBlur(image.mean(axis=2), (0, 0), 1.0)
    gradient = np.hypot(cv2.Sobel(gray, cv2.CV_32F, 1, 0), cv2.Sobel(gray, cv2.CV_32F, 0, 1))
    rows = np.arange(height)[:, None]
    best, sky = -np.inf, np.zeros((height, width), bool)
    for threshold in np.linspace(5, 600, 60):
        edge = gradient > threshold
        border = np.where(edge.any(axis=0), edge.argmax(axis=0), height)
        mask = rows < border
        if min(mask.sum(), (~mask).sum()) < 4:
            continue
        spread = [np.linalg.eigvalsh(np.cov(image[m].T)) for m in (mask, ~mask)]
        cost = 2 * (np.prod(spread[0]) + spread[0][-1]) + np.prod(spread[1]) + spread[1][-1]
        if 1 / max(cost, 1e-9) > best:
            best, sky = 1 / max(cost, 1e-9), mask
    # The kernel's weights sum to 1 only up to rounding.
    return np.minimum(cv2.GaussianBlur(sky.astype(np.float32), (0, 0), 1.0), 1)


METHODS: dict[str, Callable[[Working], np.ndarray]] = {"network": network, "skyline": skyline}


def coarse(
    working: Working,
    sky: Any = None,
    size: tuple[int, int] | None = None,
    label: int | str | None = None,
) -> np.ndarray:
    """Return the sky's probability (h, w) float32 at the size at which the method works.

    Parameters
    ----------
    working : Working
        The small photo.
    sky : None, str, Path, SkyNetwork or array_like
        Name in ``METHODS`` (default "network"), an ONNX network or its path, the path of a
        picture (white = sky), or a mask (any numeric or boolean type; values above 1 mean 8
        bits). A mask need not have the photo's size.
    size : (width, height), optional
        The photo's size, to reject masks of other proportions.
    label : int or str, optional
        The class "sky" of an ONNX network (``SkyNetwork.label``).

    Raises
    ------
    AnalysisError
        For an unknown name, a file that is not a network, a label without a network, or an array
        that is not a mask.
    """
    if isinstance(sky, (str, Path)) and str(sky).lower().endswith(".onnx"):
        sky = SkyNetwork(sky)
    if isinstance(sky, SkyNetwork):
        return (sky if label is None else dataclasses.replace(sky, label=label))(working)
    if label is not None:
        raise AnalysisError(
            f"sky_label={label!r:.80} names a class of an ONNX network; pass its path as sky=."
        )
    if sky is None:
        return network(working)
    if isinstance(sky, (str, Path)):
        if str(sky) in METHODS:
            return METHODS[str(sky)](working)
        if Path(sky).suffix.lower() in {".png", ".tif", ".tiff", ".bmp", ".jpg", ".jpeg"}:
            return mask_from(_read_mask(Path(sky)), size)
        raise AnalysisError(
            f"sky={str(sky)!r:.80} is neither a method ({', '.join(METHODS)}), an .onnx file "
            "nor a picture of the mask (.png)."
        )
    return mask_from(sky, size)


def _read_mask(path: Path) -> np.ndarray:
    """Read a picture's code values (h, w, 3), only with readers that cannot start programs."""
    try:
        return open_photo(path).encoded
    except PhotoError as error:
        raise AnalysisError(f"This sky mask cannot be read: {error}") from error


def mask_from(mask: Any, size: tuple[int, int] | None = None, of: str = "sky") -> np.ndarray:
    """Convert a caller's mask ``of`` something to (h, w) float32 in [0, 1].

    Raises
    ------
    AnalysisError
        If it is not a two-dimensional numeric array, contains NaN, or has other proportions
        than the photo by more than rounding.
    """
    try:
        array = np.asarray(mask)
        if array.ndim == 3:
            array = array[..., 0] if array.shape[2] in (1, 2) else array[..., :3].max(axis=2)
        boolean = array.dtype == bool
        array = plain_numbers(array)
    except (TypeError, ValueError) as error:
        raise AnalysisError(
            f"{of}= takes a mask array, a path or a method, not {mask!r:.80}."
        ) from error
    if array.ndim != 2 or array.size == 0:
        raise AnalysisError(f"A {of} mask must have shape (height, width), not {array.shape}.")
    if not np.isfinite(array).all():
        raise AnalysisError(
            f"The {of} mask has NaN or infinite values. All values must be from 0 to 1."
        )
    if not boolean and array.max() > 1:
        array = array / (255 if array.max() <= 255 else 65535)
    if size is not None:
        check_proportions(f"{of} mask", array.shape, size)
    return np.clip(array, 0, 1)


def plain_numbers(array: np.ndarray) -> np.ndarray:
    """Return integers or floats as float32; TypeError for anything else."""
    if array.dtype.kind not in "bfiu":
        raise TypeError(f"{array.dtype} has no plain numbers")
    with np.errstate(over="ignore"):  # too large values become infinite, which is refused later
        return array.astype(np.float32)


def check_proportions(name: str, shape: tuple[int, ...], size: tuple[int, int]) -> None:
    """Raise AnalysisError unless a map of ``shape`` (h, w) fits a photo of ``size`` (w, h)."""
    ratio = shape[1] / shape[0] * size[1] / size[0]
    slack = 1 + 1.5 / min(shape) + 1.5 / min(size)
    if not 1 / slack <= ratio <= slack:
        raise AnalysisError(
            f"The {name} is {shape[1]} × {shape[0]}, the photo {size[0]} × {size[1]}; their "
            "shapes must agree. Was one of them rotated?"
        )
