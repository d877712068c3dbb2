"""Large pictures: reductions from a small copy, once; all else strip by strip.

Passes that are not of the picture's size (shadows, mirrored sky, the sun's visibility …) read a
copy of all of it; those that are read scene textures of the strip's rows alone. So the memory that
a picture takes on the GPU does not grow with it, and no side of it needs to fit into a texture:
rows that do not are folded, their pieces one below the other (frame/strip.glsl).
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

# Up to here the scene textures of the whole picture lie on the GPU: 20 bytes a pixel.
RESIDENT_PIXELS = 1 << 23
# Longer side of the copy of a larger one, as a browser's preview has it.
COPY_EDGE = 2048
# What a strip has of it at most: six RGBA32F targets of 1 MP are 100 MB.
STRIP_PIXELS = 1 << 20
_OF_ITS_SIZE = ("layers", "surface")
_MARGIN = 1  # rows: what a pixel reads around it (clouds/retouch.glsl)


def is_resident(size: Size, limit: int) -> bool:
    """Return whether all of a picture's scene textures lie on the GPU at once."""
    return size[0] * size[1] <= RESIDENT_PIXELS and max(size) <= limit


def copy_size(size: Size, limit: int) -> Size:
    """Return the size of the scene textures that stand for all of a picture of ``size``.

    Parameters
    ----------
    size : (width, height)
        Of the picture, in pixels.
    limit : int
        The longest side of a texture.
    """
    if is_resident(size, limit):
        return size
    return size_within(size, min(COPY_EDGE, limit))


def pieces(size: Size, pixels: int, limit: int) -> list[tuple[slice, list[slice]]]:
    """Return the strips of a picture, from the top, each as its rows and pieces of columns.

    Parameters
    ----------
    size : (width, height)
        Of the picture, in pixels.
    pixels : int
        About as many are in a strip.
    limit : int
        The longest side of a texture.
    """
    width, height = size
    folds = math.ceil(width / limit)
    rows = math.ceil(height / max(1, math.ceil(width * height / pixels)))
    # Folded, with its margin, a strip must be no higher than a texture.
    rows = max(1, min(rows, limit // folds - 2 * _MARGIN))
    across = math.ceil(width / folds)
    columns = [slice(left, min(left + across, width)) for left in range(0, width, across)]
    return [(slice(top, min(top + rows, height)), columns) for top in range(0, height, rows)]


def folded(image: Array, limit: int) -> Array:
    """Return a strip (h, w, n) as a texture holds it.

    Rows longer than ``limit`` lie there in pieces, one below the other, the last one filled up
    with zeros.
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

    ``lit`` False leaves dark what only lit windows need, and no network looks for them.
    """
    textures: dict[str, Array] = {"photo": scene.photo.resized(size)}
    for name in TEXTURES:
        dark = name == "lamps" and not lit
        textures[name] = np.zeros((1, 1, 4), np.uint8) if dark else texture(scene, name, size)
    return textures


def _picture(scene: Scene, size: Size) -> dict[str, Array]:
    """Return those of the picture's size."""
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
        Of the picture that is drawn, in pixels.
    """

    def __init__(self, scene: Scene, size: Size) -> None:
        self.scene, self.size = scene, size
        # What another size makes of maps that are averaged over areas is not known by rows.
        self._resized = None if scene.photo.size == size else _picture(scene, size)

    def textures(self, rows: slice) -> tuple[dict[str, Array], tuple[float, ...]]:
        """Return the textures by name for drawing ``rows``, and ``picture_strip`` of the shaders.

        They have a row more on either side, where there is one.
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
