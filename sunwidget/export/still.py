"""A picture ready to be written: what every encoder takes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.formats.gain_map import GainMap


@dataclass
class Still:
    """A picture ready to be written.

    ``codes`` is (H, W, 3) uint8 or uint16, or float32 linear Rec. 709; ``alpha`` (H, W) in the
    same type (floats: 0–1) or None; ``bits`` those of a channel in the file. ``exif`` is a block as
    Pillow makes it, with its six-byte head. ``layers`` are (H, W, 1, 3 or 4) by name, in the type
    of ``codes``, alpha straight; ``attributes`` go into an OpenEXR's header; ``gain_map`` behind
    a JPEG.
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
        """Colour, and alpha where there is one: (H, W, 3 or 4)."""
        if self.alpha is None:
            return self.codes
        return np.dstack([self.codes, self.alpha])
