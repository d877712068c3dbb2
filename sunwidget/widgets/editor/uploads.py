"""Photos uploaded from the browser, and fingerprints that identify photos."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Callable
from typing import Any

import numpy as np

from sunwidget.errors import PhotoError
from sunwidget.photo.decode_apart import keep_process, open_apart
from sunwidget.photo.photo import Photo
from sunwidget.progress import Progress
from sunwidget.widgets.kernel.requests import Answer

UPLOAD_BYTES = 400_000_000
_SAMPLE = 512  # approximate limit of rows and columns that a fingerprint reads


def fingerprint(photo: Photo) -> str:
    """Return 32 hexadecimal digits that identify a photo by its pixels, not its name.

    They depend on size, depth and a grid of pixels, so that 150 megapixels take milliseconds.
    """
    rows, columns = (max(1, n // _SAMPLE) for n in photo.encoded.shape[:2])
    digest = hashlib.blake2b(digest_size=16)
    digest.update(repr((photo.encoded.shape, photo.encoded.dtype.str)).encode())
    digest.update(np.ascontiguousarray(photo.encoded[::rows, ::columns]).tobytes())
    return digest.hexdigest()


class Uploads:
    """Assembles a file from pieces, since large messages break the connection.

    Parameters
    ----------
    opened : callable
        ``opened(photo)``, called with the photo when its last piece has arrived.
    """

    def __init__(self, opened: Callable[[Photo], None]) -> None:
        self._opened = opened
        self._key: Any = None
        self._data = bytearray()

    def __call__(self, content: dict[str, Any], progress: Progress) -> Answer:
        """Take one piece: ``upload`` (a key), ``name``, ``size``, ``offset`` and one buffer.

        Raises
        ------
        PhotoError
            When the pieces do not fit together, are too many, or are not a picture.
        """
        size, offset = int(content["size"]), int(content["offset"])
        if size > UPLOAD_BYTES:
            raise PhotoError(
                f"This file has {size / 1e6:.0f} MB; the limit of an upload is "
                f"{UPLOAD_BYTES / 1e6:.0f} MB. Open it in Python: editor.open('path')."
            )
        if offset == 0:
            self._key, self._data = content["upload"], bytearray()
        (piece,) = content["buffers"]
        if content["upload"] != self._key or offset != len(self._data):
            raise PhotoError("Another upload interrupted this one. Drop the photo again.")
        self._data += piece
        if len(self._data) > size:
            raise PhotoError("More bytes arrived than the file's size. Drop the photo again.")
        if len(self._data) == size:
            progress(1.0, "Opening the photo …")
            file = io.BytesIO(bytes(self._data))
            self._key, self._data = None, bytearray()
            file.name = str(content["name"])[:200]
            with keep_process():  # closed at once, since a notebook stays open for days
                photo = open_apart(file)
            self._opened(photo)
        return {}, []
