"""Formats that Pillow truncates or refuses: 16-bit color and floats by OpenCV, and TIFF tags."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.formats import exif as exif_tags


def is_deep(image: Any) -> bool:
    """Return whether a picture has 16-bit color, which Pillow would decode to 8 bits."""
    if image.mode not in ("RGB", "RGBA", "LA"):
        return False
    if image.format == "TIFF":
        return image.tag_v2.get(258, (8,))[0] == 16
    # An image that was not read from a file has no tiles.
    return any(";16" in str(tile[3]) for tile in getattr(image, "tile", ()))


def decode_with_opencv(data: bytes) -> NDArray[Any] | None:
    """Decode deep pictures to (H, W) or (H, W, 3 or 4) in RGB order; None if OpenCV fails."""
    import cv2

    try:
        with quiet_opencv():
            found = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    except cv2.error:
        return None
    if found is None or found.dtype not in (np.uint16, np.float32, np.float64):
        return None
    if found.dtype == np.float64:
        found = found.astype(np.float32)
    if found.ndim == 3 and found.shape[2] in (3, 4):
        order = [2, 1, 0, 3][: found.shape[2]]
        found = found[..., order]
    return np.asarray(found)


@contextlib.contextmanager
def quiet_opencv() -> Iterator[None]:
    """Keep OpenCV from writing to stderr about bad files; a PhotoError reports them instead."""
    import cv2

    # Until OpenCV 4.10 the two functions were in the main module.
    home = cv2.utils.logging if hasattr(cv2.utils, "logging") else cv2
    level = home.getLogLevel()
    home.setLogLevel(0)
    try:
        yield
    finally:
        home.setLogLevel(level)


def tiff_tags(data: bytes) -> dict[int, Any]:
    """Return the tags of a TIFF's first directory; empty if it is damaged."""
    from PIL import TiffImagePlugin

    try:
        with exif_tags.quiet():
            directory = TiffImagePlugin.ImageFileDirectory_v2(data[:8])
            stream = io.BytesIO(data)
            stream.seek(directory.next)
            directory.load(stream)
            return dict(directory)
    except Exception:  # noqa: BLE001 - a damaged directory; the caller reports it
        return {}
