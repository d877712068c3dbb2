"""Encode pictures as PNG, and as the output of a notebook cell."""

from __future__ import annotations

import base64
import io
from typing import Any

import numpy as np
from numpy.typing import NDArray

_FEW_BYTES = 100_000
_PALETTE_SIZE = (120, 80)


def encode_png(image: NDArray[np.uint8]) -> bytes:
    """Encode an (H, W, 3), (H, W, 4) or (H, W) uint8 picture as PNG, fast rather than small."""
    import cv2

    bgr = image[..., [2, 1, 0, 3][: image.shape[2]]] if image.ndim == 3 else image
    # OpenCV's default is tuned for speed: half the time of level 2, at about the same size.
    ok, data = cv2.imencode(".png", bgr)
    if not ok:
        raise RuntimeError(f"OpenCV could not encode a picture of shape {image.shape} as PNG.")
    return bytes(data)


def encode_small_png(image: NDArray[np.uint8]) -> bytes:
    """Encode an (H, W, 3) uint8 picture as a small PNG, for pictures that every notebook saves.

    Above ``_FEW_BYTES`` it has 256 colors and is dithered: a third of the bytes, for 20 ms.
    """
    from PIL import Image

    data = encode_png(image)
    if len(data) <= _FEW_BYTES:
        return data
    whole = Image.fromarray(image)
    # Colors are chosen from a smaller picture: on all pixels that would take most of the time.
    palette = whole.resize(_PALETTE_SIZE).quantize(256)
    small = io.BytesIO()
    whole.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG).save(small, "PNG")
    return min(data, small.getvalue(), key=len)


def cell_output(
    image: NDArray[np.uint8], text: str, alternative: str
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return data and metadata for ``_repr_mimebundle_``: the (H, W, 3) picture, and ``text``.

    ``alternative`` is the alternative text of the picture.
    """
    height, width = image.shape[:2]
    # PNG without HTML: a notebook saves every form that it receives.
    data = {"text/plain": text, "image/png": base64.b64encode(encode_png(image)).decode("ascii")}
    return data, {"image/png": {"width": width, "height": height, "alt": alternative}}
