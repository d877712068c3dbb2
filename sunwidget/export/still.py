"""The input of every encoder: a picture ready to be written."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.formats.gain_map import GainMap


@dataclass
class Still:
    """A picture ready to be written.

    ``codes`` is (H, W, 3) uint8 or uint16, or float32 linear Rec. 709. ``alpha`` is (H, W) of the
    same type (floats: 0–1) or None. ``bits`` is the file's bits per channel. ``exif`` is a block as
    Pillow writes it, with its six-byte header. ``layers`` are (H, W, 1, 3 or 4) by name, typed as
    ``codes``, with straight alpha. ``attributes`` go into an OpenEXR header, ``gain_map`` after
    the JPEG data.
    """

    codes: NDArray[Any]
    alpha: NDArray[Any] | None = None
    icc: bytes | None = None
    exif: bytes | None = None
    xmp: bytes | None = None
    dpi: tuple[float, float] | None = None
    quality: int = 95
    bits: int = 8
    recipe: dict[str, Any] | None = None
    layers: dict[str, NDArray[Any]] = field(default_factory=dict)
    attributes: dict[str, Any] = field(default_factory=dict)
    gain_map: GainMap | None = None

    @property
    def samples(self) -> NDArray[Any]:
        """Color and, if present, alpha: (H, W, 3 or 4)."""
        if self.alpha is None:
            return self.codes
        return np.dstack([self.codes, self.alpha])
