"""A rendered scene separated into sky, clouds and land, which composite to the picture again.

Composited from the bottom (sky, clouds, land) with plain "over" and straight alpha, the layers
reproduce the saved picture to a level or two of 8 bits. PNG, TIFF and WebP layers composite as code
values, as programs do it; OpenEXR and 32-bit TIFF layers as linear light.

The clear sky is the picture rendered without clouds, continued smoothly behind land and clouds. An
alpha is the opacity of the matte or of the clouds. It is higher where a layer would otherwise need
light below black or above white (Smith & Blinn, "Blue Screen Matting", 1996: one picture does not
determine its foreground; the least opaque one is taken).
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
"""Names from the bottom up; the matte (1 = sky) is not composited."""

# Long edge, in pixels, of the sky behind the land; it is smooth.
_FILLED_EDGE = 512
# Matte values over which a pixel comes to show sky alone.
_SKY_FROM, _SKY_ALONE = 0.9, 1.0
_BRIGHTEST = np.float32(16)  # display light, of a float layer
_LEAST = np.float32(1e-6)


def layers_of(
    scene: Scene, edit: Edit, codes: NDArray[Any], draw: Callable[[Edit], NDArray[Any]]
) -> dict[str, NDArray[Any]]:
    """Separate a picture into its layers.

    Parameters
    ----------
    scene, edit
        Scene and edit of the picture.
    codes : (H, W, 3) uint8, uint16 or float32
        The picture.
    draw : callable
        Draws another edit at the same size and type.

    Returns
    -------
    dict
        ``sky`` (H, W, 3), ``clouds`` and ``land`` (H, W, 4), ``matte`` (H, W, 1), all of the type
        of ``codes``; floats have no upper bound.
    """
    clear = draw(edit.replace(cloud_opacity=0.0, added_clouds=0.0))
    scene = corrected(scene, edit)
    height, width = codes.shape[:2]
    matte, opacity = _resized(scene.sky, width, height), _resized(scene.clouds, width, height)
    top = np.float32(1 if codes.dtype.kind == "f" else np.iinfo(codes.dtype).max)
    around = _BehindLand(codes, clear, matte, opacity, edit, top)
    layers = {
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
        layers["sky"][rows] = sky
        layers["clouds"][rows] = _make_layer(_shares(sky, top), seen, wanted, codes.dtype)
        below = _composite(_shares(sky, top), _shares(layers["clouds"][rows], top))
        layers["land"][rows] = _make_layer(
            below, _shares(codes[rows], top), 1 - matte[rows], codes.dtype
        )
        layers["matte"][rows] = _levels(matte[rows][..., None], codes.dtype)
    return layers


def extract_layer(still: Still, name: str) -> Still:
    """Return one layer as a separate picture, the matte as gray."""
    import dataclasses

    samples = still.layers[name]
    color = samples[..., :3] if samples.shape[2] >= 3 else np.repeat(samples, 3, axis=2)
    alpha = samples[..., 3] if samples.shape[2] == 4 else None
    return dataclasses.replace(still, codes=color, alpha=alpha, layers={})


class _BehindLand:
    """Sky, clouds and cloud opacity behind the land, filled in from around it."""

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
        # From this strip's pixels to the small picture's, center to center.
        to_small = np.array([[x, 0, x / 2 - 0.5], [0, y, (rows.start + 0.5) * y - 0.5]])
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        target = (width, rows.stop - rows.start)
        bands = [
            cv2.warpAffine(band, to_small, target, flags=flags, borderMode=cv2.BORDER_REPLICATE)
            for band in self.filled
        ]
        return bands[0], bands[1], bands[2]


def _make_layer(below: Floats, wanted: Floats, opacity: Floats, dtype: Any) -> NDArray[Any]:
    """Return the layer (h, W, 4) that turns ``below`` into ``wanted``, at least this opaque."""
    bounded = dtype.kind != "f"
    # Differences below one level do not count.
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
    # A transparent pixel keeps the picture's color, so that no fringe appears at the layer's edge.
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
    """Return the weight of a pixel's own color in the sky layer; the rest is filled in."""
    x = np.clip((matte - _SKY_FROM) / (_SKY_ALONE - _SKY_FROM), 0, 1)
    return np.asarray(x * x * (3 - 2 * x), np.float32)


def own_opacity(clouds: Floats, matte: Floats) -> Floats:
    """Return the opacity of the visible clouds; the map stores it multiplied by the matte."""
    return np.clip(clouds / np.maximum(matte, np.float32(1 / 255)), 0, 1)


def edited_opacity(opacity: Floats, edit: Edit) -> Floats:
    """Return the opacity under an edit (docs/methods/clouds.md)."""
    q = np.float32(edit.cloud_opacity)
    if q <= 1:
        return q * opacity
    return np.asarray(1 - (1 - np.minimum(opacity, np.float32(0.98))) ** q, np.float32)


def _resized(image: NDArray[Any], width: int, height: int) -> NDArray[Any]:
    import cv2

    if image.shape[:2] == (height, width):
        return image
    smaller = width <= image.shape[1] and height <= image.shape[0]
    filter_ = cv2.INTER_AREA if smaller else cv2.INTER_LINEAR
    return np.asarray(cv2.resize(image, (width, height), interpolation=filter_))
