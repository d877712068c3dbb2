"""Saving stills in the photo's own encoding, or as linear light, with metadata.

Pixels that an edit does not change keep their exact code values: an unmoved photo saved as PNG or
TIFF has the pixels that it was opened with, in 8 and 16 bits and in any color profile.
"""

from __future__ import annotations

import contextlib
import os
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from sunwidget.edit.table import Edit
from sunwidget.errors import PhotoError
from sunwidget.export.formats import Format, check_format, check_quality
from sunwidget.export.gain_map import gain_map_of
from sunwidget.export.layers import LAYERS, extract_layer, layers_of
from sunwidget.export.metadata import metadata_for
from sunwidget.export.still import Still
from sunwidget.files import complete_or_absent, target
from sunwidget.formats.color import strips
from sunwidget.photo.photo import Photo, open_photo
from sunwidget.progress import Progress

__all__ = ["check_format", "encode_like", "save"]

# Differences from the photo's light below this are float32 noise. Near black a gamma of 2.2 would
# amplify them to dozens of 16-bit levels.
_SAME_LIGHT = 2e-7
_SAME_SHARE = 1e-6


def save(
    picture: Any,
    path: str | os.PathLike[str],
    *,
    like: Any = None,
    overwrite: bool = False,
    quality: int = 95,
    bit_depth: int | None = None,
    size: tuple[int, int] | None = None,
    layers: bool = False,
    headroom: float = 0.0,
    progress: Progress | None = None,
) -> Path:
    """Save a picture as PNG, JPEG, TIFF, WebP, OpenEXR or Radiance HDR.

    The file appears only when it is complete.

    Parameters
    ----------
    picture : (Scene, Edit), Scene, Photo or (H, W, 3) array
        A scene and an edit are rendered at full size and saved in the photo's profile and bit
        depth, with the recipe in EXIF and XMP. uint8 and uint16 arrays are sRGB, float arrays
        linear Rec. 709 light.
    path : path
        The extension selects the format: .png, .jpg, .tif, .webp; .exr (half floats; needs the
        ``exr`` extra) and .hdr hold linear Rec. 709 light, 1 = white.
    like : Photo or Scene, optional
        For arrays: source of the profile and metadata (EXIF, ICC, XMP, resolution).
    overwrite : bool
        Replace an existing file.
    quality : int
        JPEG and WebP quality, 1–100. At 100 WebP is lossless, and a JPEG's gain map also corrects
        the rounding of the picture's luminance.
    bit_depth : {8, 16, 32}, optional
        Bits per channel. Default: as the photo or array; 16 for floats. 32 saves floats of linear
        light, in .tif and .exr.
    size : (width, height), optional
        Size of a rendered scene in pixels. Default: the photo's own.
    layers : bool
        Also save the sky, clouds, land and matte of a scene (``export.layers``): as pages of a
        .tif, as ``sky.R`` … in an .exr, as files ``out.sky.png`` … beside a .png or .webp.
    headroom : float, 0–8
        Stops of light above white to keep of a rendered scene: the moved sun, its glow and glitter
        (``render``). A .jpg stores them as a gain map (ISO 21496-1, "Ultra HDR"): HDR screens show
        them brighter than white, others show the plain picture. An .exr, .hdr or 32-bit .tif
        stores them as light. An unmoved photo always keeps the gain map of its file.
    progress : callable, optional
        Called as ``progress(fraction, message)`` while a scene is rendered. An exception from it
        cancels the export.

    Returns
    -------
    Path
        The saved file.

    Raises
    ------
    FileExistsError
        When ``path``, or a file for a layer, exists and ``overwrite`` is false.
    PhotoError
        For an unknown extension, or a picture that the format or this function does not support.
    EditError
        For a size or headroom out of range.
    OSError
        When the folder is missing or the disk is full. No half-written file is left.

    Warns
    -----
    PhotoWarning
        When the format drops something, such as transparency in a JPEG, and when no pixel is
        brighter than white, so that no gain map is written.
    """
    place = target(path, overwrite=overwrite)
    headroom = checked_headroom(headroom)
    form = check_format(place, bit_depth, layers=layers, headroom=headroom)
    check_quality(quality)
    names = LAYERS if layers and form.layers == "beside" else ()
    places = {name: place.with_suffix(f".{name}{place.suffix}") for name in names}
    for beside in places.values():
        target(beside, overwrite=overwrite)
    options = _SaveOptions(form, bit_depth, size, layers, headroom, quality, progress)
    still = _make_still(picture, _photo_of(like), options)
    still.quality = quality
    files = {place: form.encode(still)}
    for name, beside in places.items():
        files[beside] = form.encode(extract_layer(still, name))
    with contextlib.ExitStack() as stack:
        for where, data in files.items():
            unfinished = stack.enter_context(complete_or_absent(where, overwrite=overwrite))
            unfinished.write_bytes(data)
    return place


def encode_like(
    photo: Photo,
    light: NDArray[Any],
    *,
    bit_depth: int | None = None,
    rows: slice = slice(None),
) -> NDArray[Any]:
    """Encode light in the profile of ``photo``; unchanged pixels keep the photo's code values.

    Parameters
    ----------
    photo : Photo
        Source of the profile and of the default bit depth.
    light : (H, W, 3) float array
        Linear Rec. 709. Colors outside the profile's gamut are clamped.
    bit_depth : {8, 16}, optional
        Default: the photo's own, 16 for a float photo.
    rows : slice, optional
        Rows of the photo that ``light`` covers. Default: all.

    Returns
    -------
    (H, W, 3) uint8 or uint16 array
        Changed 8-bit pixels are dithered (triangular, half a level, fixed seed) against banding
        in a smooth sky.
    """
    bits = bit_depth or min(photo.bit_depth, 16)
    dtype = np.dtype(np.uint8 if bits == 8 else np.uint16)
    first = rows.indices(photo.height)[0]
    # The seed differs by strip, so that strips do not repeat the same noise.
    codes = photo.profile.encode(light, dtype, dither=dtype == np.uint8, seed=first)
    own = photo.encoded[rows]
    if own.shape != light.shape or own.dtype.kind == "f":
        return codes
    if own.dtype != dtype:
        # A factor of 257 maps 8-bit levels to 16-bit ones, and back after rounding.
        own = own * np.uint16(257) if bits == 16 else np.rint(own / 257).astype(np.uint8)
    for part in strips(light.shape):
        was = photo.light(slice(first + part.start, first + part.stop))
        same = np.abs(light[part] - was) <= _SAME_LIGHT + _SAME_SHARE * np.abs(was)
        kept = same.all(axis=-1)
        codes[part][kept] = own[part][kept]
    return codes


class _SaveOptions(NamedTuple):
    """The options of ``save``."""

    form: Format
    bit_depth: int | None
    size: tuple[int, int] | None
    layers: bool
    headroom: float
    quality: int
    progress: Progress | None

    def bits(self, own: int) -> int:
        """Return the file's bits per channel for a picture with ``own`` bits."""
        if self.bit_depth is not None or self.form.linear:
            return self.bit_depth or self.form.depths[0]
        return min(16 if own > 8 else 8, self.form.depths[0])

    def is_light(self, bits: int) -> bool:
        """Return whether the file holds linear light in floats."""
        return self.form.linear or bits == 32


def checked_headroom(headroom: Any) -> float:
    """Return the stops of light above white, or raise EditError."""
    if type(headroom) in {int, float} and headroom == 0:
        return 0.0  # avoids importing the renderer, which arrays and photos do not need
    from sunwidget.renderer.offscreen import checked_headroom as checked

    return checked(headroom)


def _photo_of(like: Any) -> Photo | None:
    photo = getattr(like, "photo", like)
    if photo is None or isinstance(photo, Photo):
        return photo
    raise PhotoError(f"like must be a Photo or Scene, not {type(like).__name__}.")


def _make_still(picture: Any, like: Photo | None, options: _SaveOptions) -> Still:
    """Convert any accepted picture to code values or light, with metadata."""
    if hasattr(picture, "photo"):
        picture = (picture, None)
    if isinstance(picture, tuple):
        return _make_still_of_scene(*_scene_and_edit(picture), options)
    if options.size is not None or options.layers:
        raise PhotoError("size and layers apply to a rendered scene only: save (scene, edit).")
    if options.headroom and not isinstance(picture, Photo):
        raise PhotoError("headroom applies to a rendered scene only: save (scene, edit).")
    array = open_photo(picture)
    bits = options.bits(array.bit_depth)
    source = like or array
    if options.is_light(bits):
        codes: NDArray[Any] = array.pixels
    elif like is None or like.profile.is_srgb:
        codes = _own_codes(array, bits)
    else:
        codes = encode_like(like, array.pixels, bit_depth=bits)
    alpha = array.alpha if array.alpha is not None else source.alpha
    still = _with_metadata(codes, source, alpha, bits)
    still.gain_map = array.gain_map
    return still


def _make_still_of_scene(scene: Any, edit: Edit | None, options: _SaveOptions) -> Still:
    photo: Photo = scene.photo
    bits = options.bits(photo.bit_depth)
    is_light = options.is_light(bits)

    def draw(edit: Edit | None, share: float, done: float) -> NDArray[Any]:
        def progress(fraction: float, message: str) -> None:
            if options.progress is not None:
                options.progress(done + share * fraction, message)

        white = options.headroom if is_light else 0.0
        return _draw(scene, edit, 32 if is_light else bits, options.size, progress, white)

    makes_map = options.form.gain_map and options.headroom > 0
    codes = draw(edit, 0.5 if options.layers or makes_map else 1.0, 0.0)
    recipe = edit.to_dict() if edit is not None else None
    still = _with_metadata(codes, photo, photo.alpha, bits, recipe)
    if edit is None or edit == Edit() or np.array_equal(codes, photo.encoded):
        still.gain_map = photo.gain_map
    elif makes_map:
        still.quality = options.quality
        still.gain_map = gain_map_of(scene, edit, still, options.headroom, options.progress)
    if options.layers:
        still.layers = layers_of(scene, edit or Edit(), codes, lambda e: draw(e, 0.5, 0.5))
    return still


def _scene_and_edit(pair: tuple[Any, ...]) -> tuple[Any, Edit | None]:
    if len(pair) == 2 and hasattr(pair[0], "photo"):
        scene, edit = pair
        if edit is None or isinstance(edit, Edit):
            return scene, edit
        if isinstance(edit, dict):
            return scene, Edit.from_dict(edit)
    raise PhotoError(
        f"A tuple must be (scene, edit), not ({', '.join(type(x).__name__ for x in pair)})."
    )


def _own_codes(photo: Photo, bits: int) -> NDArray[Any]:
    if photo.bit_depth == bits:
        return photo.encoded
    codes = np.empty(photo.encoded.shape, np.uint8 if bits == 8 else np.uint16)
    for rows in strips(codes.shape):
        codes[rows] = encode_like(photo, photo.light(rows), bit_depth=bits, rows=rows)
    return codes


def _draw(
    scene: Any,
    edit: Edit | None,
    bits: int,
    size: tuple[int, int] | None,
    progress: Progress,
    headroom: float,
) -> NDArray[Any]:
    """Draw the picture: code values in the photo's profile, or light for 32 bits."""
    from sunwidget.renderer.offscreen import checked_size, render, strips_of

    photo: Photo = scene.photo
    more: dict[str, Any] = {"progress": progress}
    if size is not None:
        more["size"] = size = checked_size(size)
    if bits == 8 and photo.bit_depth == 8 and photo.profile.is_srgb:
        # The same call as sw.render: the file equals the frame that the canvas shows.
        return render(scene, edit, **more)
    if bits == 32:
        return render(scene, edit, dtype="float32", headroom=headroom, **more)
    width, height = size or photo.size
    codes = np.empty((height, width, 3), np.uint8 if bits == 8 else np.uint16)
    for rows, light in strips_of(scene, edit, "float32", **more):
        codes[rows] = encode_like(photo, light, bit_depth=bits, rows=rows)
    return codes


def _with_metadata(
    codes: NDArray[Any],
    photo: Photo,
    alpha: NDArray[np.float32] | None,
    bits: int,
    recipe: dict[str, Any] | None = None,
) -> Still:
    height, width = codes.shape[:2]
    still = Still(codes, alpha=_alpha_codes(alpha, codes), bits=bits)
    for name, value in metadata_for(photo, (width, height), recipe).items():
        setattr(still, name, value)
    if codes.dtype.kind == "f":
        still.icc = None  # the profile describes the encoding, which was undone
    return still


def _alpha_codes(alpha: NDArray[np.float32] | None, codes: NDArray[Any]) -> NDArray[Any] | None:
    """Return alpha in the type and size of ``codes``; None for another aspect ratio (a crop)."""
    if alpha is None:
        return None
    (height, width), own = codes.shape[:2], alpha.shape
    if own != (height, width):
        if abs(width * own[0] - height * own[1]) > max(own):
            return None
        import cv2

        alpha = np.asarray(cv2.resize(alpha, (width, height), interpolation=cv2.INTER_AREA))
    if codes.dtype.kind == "f":
        return alpha
    return np.rint(alpha * np.float32(np.iinfo(codes.dtype).max)).astype(codes.dtype)
