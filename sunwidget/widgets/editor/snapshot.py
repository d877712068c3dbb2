"""A still picture of an editor, as a cell's output that needs no widget."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np

from sunwidget.edit.table import Edit
from sunwidget.formats.png import cell_output, encode_png
from sunwidget.photo.photo import Photo

SNAPSHOT_EDGE = 1024


class Snapshot:
    """A fixed picture, which GitHub, nbconvert and every notebook show.

    The result of ``SunEditor.snapshot``.

    Attributes
    ----------
    pixels : (H, W, 3) uint8
        sRGB.
    edit : Edit
        The rendered edit.
    photo : Photo
        The photo that was rendered.
    """

    def __init__(self, pixels: np.ndarray, edit: Edit, photo: Photo) -> None:
        self.pixels = pixels
        self.edit = edit
        self.photo = photo

    def __repr__(self) -> str:
        height, width = self.pixels.shape[:2]
        return f"<Snapshot of {self.photo.name!r}, {width}×{height}: {self.edit!r}>"

    def save(self, path: str | os.PathLike[str], **options: Any) -> Path:
        """Save the picture at its own size; ``options`` as in ``sunwidget.save``."""
        from sunwidget.export.stills import save

        return save(self.pixels, path, like=self.photo, **options)

    def _repr_png_(self) -> bytes:
        return encode_png(self.pixels)

    def _repr_mimebundle_(self, **_kwargs: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        return cell_output(self.pixels, repr(self), f"{self.photo.name} with its sun moved")
