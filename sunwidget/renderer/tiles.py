"""Draw large pictures: reductions once from a small copy, everything else strip by strip.

Passes of another size than the picture's (shadows, mirrored sky, the sun's visibility …) read a
small copy of the whole picture. Passes of the picture's size read scene textures of the strip's
rows only. GPU memory therefore does not grow with the picture, and no side has to fit into a
texture: longer rows are folded into pieces, one below the other (frame/strip.glsl).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from sunwidget.analysis.frame_inputs import TEXTURES, layers, quantise_map, surface, texture
from sunwidget.formats.pixels import size_within

if TYPE_CHECKING:
    import numpy.typing as npt

    from sunwidget.analysis.scene import Scene

    Array = npt.NDArray[Any]
    Size = tuple[int, int]

# Up to this size the scene textures of the whole picture stay on the GPU: 20 bytes per pixel.
RESIDENT_PIXELS = 1 << 23
# Longer side of the copy of a larger picture, as for the browser's preview.
COPY_EDGE = 2048
# Most pixels of a strip: six RGBA32F targets of 1 MP are 100 MB.
STRIP_PIXELS = 1 << 20
_OF_ITS_SIZE = ("layers", "surface")
_MARGIN = 1  # rows that a pixel reads around it (clouds/retouch.glsl)


def is_resident(size: Size, limit: int) -> bool:
    """Return whether all of a picture's scene textures stay on the GPU at once."""
    return size[0] * size[1] <= RESIDENT_PIXELS and max(size) <= limit


def copy_size(size: Size, limit: int) -> Size:
    """Return the size of the scene textures that represent a whole picture of ``size``.

    Parameters
    ----------
    size : (width, height)
        Size of the picture in pixels.
    limit : int
        Longest side of a texture in pixels.
    """
    if is_resident(size, limit):
        return size
    return size_within(size, min(COPY_EDGE, limit))


def pieces(size: Size, pixels: int, limit: int) -> list[tuple[slice, list[slice]]]:
    """Return the strips of a picture, from the top, each as its rows and pieces of columns.

    Parameters
    ----------
    size : (width, height)
        Size of the picture in pixels.
    pixels : int
        Approximate number of pixels in a strip.
    limit : int
        Longest side of a texture in pixels.
    """
    width, height = size
    folds = math.ceil(width / limit)
    rows = math.ceil(height / max(1, math.ceil(width * height / pixels)))
    # A folded strip with its margin must not be higher than a texture.
    rows = max(1, min(rows, limit // folds - 2 * _MARGIN))
    across = math.ceil(width / folds)
    columns = [slice(left, min(left + across, width)) for left in range(0, width, across)]
    return [(slice(top, min(top + rows, height)), columns) for top in range(0, height, rows)]


def fold(image: Array, limit: int) -> Array:
    """Return a strip (h, w, n) in the layout of a texture.

    Rows longer than ``limit`` are split into pieces, one below the other; zeros pad the last.
    """
    height, width, channels = image.shape
    count = math.ceil(width / limit)
    if count == 1:
        return np.ascontiguousarray(image)
    across = math.ceil(width / count)
    out = np.zeros((count * height, across, channels), image.dtype)
    for i in range(count):
        piece = image[:, i * across : (i + 1) * across]
        out[i * height : (i + 1) * height, : piece.shape[1]] = piece
    return out


def scene_textures(scene: Scene, size: Size, *, lit: bool = True) -> dict[str, Array]:
    """Return the scene textures of the frame graph at ``size`` (width, height).

    ``lit`` False leaves the texture of lit windows dark, so that no network has to find windows.
    """
    textures: dict[str, Array] = {"photo": scene.photo.resized(size)}
    for name in TEXTURES:
        dark = name == "lamps" and not lit
        textures[name] = np.zeros((1, 1, 4), np.uint8) if dark else texture(scene, name, size)
    return textures


def _picture(scene: Scene, size: Size) -> dict[str, Array]:
    """Return the scene textures of the picture's size."""
    return {
        "photo": scene.photo.resized(size),
        **{name: texture(scene, name, size) for name in _OF_ITS_SIZE},
    }


class Strips:
    """The scene textures of a large picture, some rows at a time.

    Parameters
    ----------
    scene : Scene
    size : (width, height)
        Size of the drawn picture in pixels.
    """

    def __init__(self, scene: Scene, size: Size) -> None:
        self.scene, self.size = scene, size
        # At another size, maps are averaged over areas, which cannot be done row by row.
        self._resized = None if scene.photo.size == size else _picture(scene, size)

    def textures(self, rows: slice) -> tuple[dict[str, Array], tuple[float, ...]]:
        """Return the textures by name for drawing ``rows``, and the uniform ``picture_strip``.

        The textures have an additional row on either side, if the picture has one.
        """
        width, height = self.size
        held = slice(max(rows.start - _MARGIN, 0), min(rows.stop + _MARGIN, height))
        strip = (float(held.start), float(width), float(height), float(held.stop - held.start))
        if self._resized is not None:
            return {name: image[held] for name, image in self._resized.items()}, strip
        found: dict[str, Array] = {
            "photo": self.scene.photo.light(held),
            "layers": quantise_map(layers(self.scene, rows=held)),
            "surface": quantise_map(surface(self.scene, rows=held)),
        }
        return found, strip
