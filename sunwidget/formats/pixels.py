"""Split pixel arrays of any layout into color and alpha, and reject arrays that are no picture."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.errors import PhotoError
from sunwidget.formats.color import LUMINANCE

MAX_PIXELS = 200_000_000
"""Most pixels that a picture may have; without a limit a file of a few kB could use all memory."""

MAX_LIGHT = 1e18
"""Brightest light that a picture may have, 1 = white: its square still fits a float32."""


def size_within(size: tuple[int, int], long_edge: float) -> tuple[int, int]:
    """Return a (width, height) scaled down to at most ``long_edge`` pixels, at least 1 each."""
    scale = min(1.0, long_edge / max(size))
    return max(1, round(size[0] * scale)), max(1, round(size[1] * scale))


def check_size(width: int, height: int, name: str) -> None:
    """Refuse pictures without pixels or with more than MAX_PIXELS."""
    if width < 1 or height < 1:
        raise PhotoError(f"{name} has no pixels ({width}×{height}).")
    if width * height > MAX_PIXELS:
        raise PhotoError(
            f"{name} has {width}×{height} pixels, {width * height / 1e6:.0f} million; sunwidget "
            f"opens up to {MAX_PIXELS / 1e6:.0f} million. Scale it down first."
        )


def split_alpha(array: NDArray[Any], name: str) -> tuple[NDArray[Any], NDArray[np.float32] | None]:
    """Split (H, W) or (H, W, 1–4) into color (H, W, 3) and alpha (H, W) in 0–1 or None."""
    if array.ndim == 2:
        array = array[..., None]
    channels = array.shape[2] if array.ndim == 3 else 0
    if not 1 <= channels <= 4:
        hint = ""
        if array.ndim == 3 and array.shape[0] in (1, 3, 4):
            hint = " The channels come last: use numpy.moveaxis(array, 0, -1)."
        raise PhotoError(
            f"{name} has the shape {array.shape}; expected (H, W), (H, W, 3) or (H, W, 4).{hint}"
        )
    alpha = None
    if channels in (2, 4):
        top = np.iinfo(array.dtype).max if array.dtype.kind == "u" else 1
        alpha = np.clip(array[..., -1].astype(np.float32) / np.float32(top), 0, 1)
    color = array[..., :3] if channels >= 3 else np.repeat(array[..., :1], 3, axis=2)
    return np.ascontiguousarray(color), alpha


def check_light(light: NDArray[Any], name: str) -> None:
    """Refuse float pictures with NaN, infinity, too much light or negative luminance."""
    bad = light.size - int(np.isfinite(light).sum())
    if bad:
        raise PhotoError(
            f"{name} holds {bad} values that are NaN or infinite. Replace them first, "
            "for example with numpy.nan_to_num."
        )
    brightest = max(float(light.max()), -float(light.min()))
    if brightest > MAX_LIGHT:
        raise PhotoError(
            f"{name} holds light up to {brightest:.3g} (1 = white); the maximum is {MAX_LIGHT:g}. "
            "Limit it first, for example with numpy.clip."
        )
    luminance = light @ LUMINANCE
    # Single channels below 0 are colors outside Rec. 709, but no color has negative luminance.
    # The margin allows for resampling, which undershoots beside bright edges.
    lowest = float(luminance.min())
    if lowest < -0.05 * max(1.0, float(luminance.max())):
        raise PhotoError(
            f"{name} holds negative light (luminance down to {lowest:.3g}). Floats must be linear "
            "Rec. 709 light, 0 = black, 1 = white."
        )


def upright(array: NDArray[Any], orientation: int) -> NDArray[Any]:
    """Return an upright view of an array that is stored in an EXIF orientation, 1–8."""
    if orientation >= 5:
        array = np.swapaxes(array, 0, 1)
    if orientation in (2, 3, 6, 7):
        array = array[:, ::-1]
    if orientation in (3, 4, 7, 8):
        array = array[::-1]
    return array
