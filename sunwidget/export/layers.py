"""A rendered scene taken apart: sky, clouds and land that make up the picture again.

Laid over each other from the bottom, sky, clouds, land, by plain "over" with straight alpha, the
layers give the saved picture back, to a level or two of 8 bits: of code values in PNG, TIFF and
WebP, as programs composite them, of light in OpenEXR and 32-bit TIFF.

The clear sky is the picture drawn again without clouds; behind land and clouds it goes on
smoothly. An alpha is the matte's or the clouds' opacity, and more where a layer would otherwise
need light below black or above white to give the picture (Smith & Blinn, "Blue Screen Matting",
1996: of one picture alone foregrounds are not unique; the least opaque one is taken).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.analysis.correct import corrected
from sunwidget.formats.color import strips
from sunwidget.formats.pixels import size_within

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.edit.table import Edit
    from sunwidget.export.still import Still

Floats = NDArray[np.float32]

LAYERS = ("sky", "clouds", "land", "matte")
"""Names, from the bottom; the matte (1 = sky) is no part of the picture."""

# Long edge at which the sky is continued behind the land: it is smooth.
_FILLED_EDGE = 512
# The matte from which on a pixel shows the sky alone.
_SKY_FROM, _SKY_ALONE = 0.9, 1.0
_BRIGHTEST = np.float32(16)  # of a layer in floats, display light
_LEAST = np.float32(1e-6)


def layers_of(
    scene: Scene, edit: Edit, codes: NDArray[Any], draw: Callable[[Edit], NDArray[Any]]
) -> dict[str, NDArray[Any]]:
    """Take a picture apart.

    Parameters
    ----------
    scene, edit
        What was drawn.
    codes : (H, W, 3) uint8, uint16 or float32
        The picture.
    draw : callable
        Draws another edit the same way.

    Returns
    -------
    dict
        ``sky`` (H, W, 3), ``clouds`` and ``land`` (H, W, 4), ``matte`` (H, W, 1), all in the type
        of ``codes``; floats are not bounded above.
    """
    clear = draw(edit.replace(cloud_opacity=0.0, added_clouds=0.0))
    scene = corrected(scene, edit)
    height, width = codes.shape[:2]
    matte, opacity = _resized(scene.sky, width, height), _resized(scene.clouds, width, height)
    top = np.float32(1 if codes.dtype.kind == "f" else np.iinfo(codes.dtype).max)
    around = _Around(codes, clear, matte, opacity, edit, top)
    made = {
        name: np.empty((height, width, count), codes.dtype)
        for name, count in zip(LAYERS, (3, 4, 4, 1), strict=True)
    }
    for rows in strips(codes.shape):
        share = _sky_share(matte[rows])[..., None]
        behind, veiled, thick = around.at(rows)
        share_of_cloud = edited_opacity(own_opacity(opacity[rows], matte[rows]), edit)
        sky = _levels(share * _shares(clear[rows], top) + (1 - share) * behind, codes.dtype)
        seen = share * _shares(codes[rows], top) + (1 - share) * veiled
        wanted = share[..., 0] * share_of_cloud + (1 - share[..., 0]) * thick
        made["sky"][rows] = sky
        made["clouds"][rows] = _over(_shares(sky, top), seen, wanted, codes.dtype)
        below = _composite(_shares(sky, top), _shares(made["clouds"][rows], top))
        made["land"][rows] = _over(below, _shares(codes[rows], top), 1 - matte[rows], codes.dtype)
        made["matte"][rows] = _levels(matte[rows][..., None], codes.dtype)
    return made


def layer_alone(still: Still, name: str) -> Still:
    """Return one layer as a picture of its own, the matte as grey."""
    import dataclasses

    samples = still.layers[name]
    color = samples[..., :3] if samples.shape[2] >= 3 else np.repeat(samples, 3, axis=2)
    alpha = samples[..., 3] if samples.shape[2] == 4 else None
    return dataclasses.replace(still, codes=color, alpha=alpha, layers={})


class _Around:
    """The sky, its clouds and their opacity where land stands before them, from around it."""

    def __init__(
        self,
        codes: NDArray[Any],
        clear: NDArray[Any],
        matte: Floats,
        opacity: Floats,
        edit: Edit,
        top: np.float32,
    ) -> None:
        from sunwidget.analysis.images.fill import fill_by_pyramid

        height, width = codes.shape[:2]
        size = size_within((width, height), _FILLED_EDGE)
        small = _resized(matte, *size)
        shares = edited_opacity(own_opacity(_resized(opacity, *size), small), edit)
        known = _sky_share(small)
        pictures = [_resized(image, *size).astype(np.float32) / top for image in (clear, codes)]
        self.size = (width, height)
        self.filled = [
            fill_by_pyramid(values, known) for values in (*pictures, shares[..., np.newaxis])
        ]

    def at(self, rows: slice) -> tuple[Floats, Floats, Floats]:
        """Return clear sky and clouded sky (h, W, 3) and opacity (h, W) of some rows."""
        import cv2

        width, height = self.size
        small_height, small_width = self.filled[0].shape[:2]
        x, y = small_width / width, small_height / height
        # From this strip's pixels to the small picture's, centres to centres.
        way = np.array([[x, 0, x / 2 - 0.5], [0, y, (rows.start + 0.5) * y - 0.5]])
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        target = (width, rows.stop - rows.start)
        bands = [
            cv2.warpAffine(band, way, target, flags=flags, borderMode=cv2.BORDER_REPLICATE)
            for band in self.filled
        ]
        return bands[0], bands[1], bands[2]


def _over(below: Floats, wanted: Floats, opacity: Floats, dtype: Any) -> NDArray[Any]:
    """Return the layer (h, W, 4) that makes ``wanted`` of ``below``, at least this opaque."""
    bounded = dtype.kind != "f"
    # Less than a level apart is the same.
    same = np.float32(1 / np.iinfo(dtype).max) if bounded else np.float32(1e-5)
    apart = wanted - below
    need = (-apart - same) / np.maximum(below, _LEAST)
    room = np.maximum(1 - below, _LEAST) if bounded else _BRIGHTEST
    need = np.maximum(need, (apart - same) / room)
    alpha = np.clip(np.maximum(opacity, need.max(axis=-1)), 0, 1)
    if bounded:
        top = np.float32(np.iinfo(dtype).max)
        alpha = np.ceil(alpha * top - np.float32(0.01)) / top
    color = below + apart / np.maximum(alpha, _LEAST)[..., None]
    # Where it shows nothing it has the picture's own colour, so that no fringe appears at its edge.
    color = np.where(alpha[..., None] > 0, color, wanted)
    return np.dstack([_levels(color, dtype), _levels(alpha[..., None], dtype)])


def _composite(below: Floats, layer: Floats) -> Floats:
    alpha = layer[..., 3:]
    return layer[..., :3] * alpha + below * (1 - alpha)


def _shares(levels: NDArray[Any], top: np.float32) -> Floats:
    return np.asarray(levels, np.float32) / top


def _levels(values: Floats, dtype: Any) -> NDArray[Any]:
    if dtype.kind == "f":
        return np.maximum(values, 0).astype(dtype)
    top = np.float32(np.iinfo(dtype).max)
    return np.rint(np.clip(values, 0, 1) * top).astype(dtype)


def _sky_share(matte: Floats) -> Floats:
    """How much of what is known of the sky at a pixel is the pixel's own."""
    x = np.clip((matte - _SKY_FROM) / (_SKY_ALONE - _SKY_FROM), 0, 1)
    return np.asarray(x * x * (3 - 2 * x), np.float32)


def own_opacity(clouds: Floats, matte: Floats) -> Floats:
    """Opacity of the clouds where they are seen: the map holds it times the matte."""
    return np.clip(clouds / np.maximum(matte, np.float32(1 / 255)), 0, 1)


def edited_opacity(opacity: Floats, edit: Edit) -> Floats:
    """Opacity as the edit makes it (docs/methods/clouds.md)."""
    q = np.float32(edit.cloud_opacity)
    if q <= 1:
        return q * opacity
    return np.asarray(1 - (1 - np.minimum(opacity, np.float32(0.98))) ** q, np.float32)


def _resized(image: NDArray[Any], width: int, height: int) -> NDArray[Any]:
    import cv2

    if image.shape[:2] == (height, width):
        return image
    smaller = width <= image.shape[1] and height <= image.shape[0]
    way = cv2.INTER_AREA if smaller else cv2.INTER_LINEAR
    return np.asarray(cv2.resize(image, (width, height), interpolation=way))
