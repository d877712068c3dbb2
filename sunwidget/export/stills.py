"""Stills on disk: the picture in the photo's own encoding, or as light, with its metadata.

What an edit did not touch keeps its code values exactly: an unmoved photo, saved again
as PNG or TIFF, has the very pixels it was opened with, in 8 and 16 bits and in any
colour profile.
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
from sunwidget.export.layers import LAYERS, layer_alone, layers_of
from sunwidget.export.metadata import metadata_for
from sunwidget.export.still import Still
from sunwidget.files import complete_or_absent, target
from sunwidget.formats.color import strips
from sunwidget.photo.photo import Photo, open_photo
from sunwidget.progress import Progress

__all__ = ["check_format", "encode_like", "save"]

# Light that differs less than this from the photo's own is the photo's own: it is the
# noise of float32 arithmetic, but near black a gamma of 2.2 would blow it up to dozens
# of 16-bit levels.
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
    """Write a picture as PNG, JPEG, TIFF, WebP, OpenEXR or Radiance HDR, whole or not at all.

    Parameters
    ----------
    picture : (Scene, Edit), Scene, Photo or (H, W, 3) array
        A scene and an edit are rendered at full size and written in the photo's own profile and
        bit depth, with the recipe in EXIF and XMP. uint8 and uint16 arrays are sRGB, float arrays
        linear Rec. 709 light.
    path : path
        The ending chooses the format: .png, .jpg, .tif, .webp; .exr (half floats; needs the
        ``exr`` extra) and .hdr hold linear Rec. 709 light, 1 = white.
    like : Photo or Scene, optional
        For arrays: whose profile and metadata (EXIF, ICC, XMP, resolution) to carry.
    overwrite : bool
        Replace an existing file.
    quality : int
        Of JPEG and WebP, 1–100. WebP is lossless at 100, and a gain map then makes up for what
        JPEG has rounded of its picture's luminance.
    bit_depth : {8, 16, 32}, optional
        Bits a channel. Default: the photo's or the array's own; 16 for floats. 32 are floats of
        linear light, in .tif and .exr.
    size : (width, height), optional
        Of a rendered scene, in pixels. Default: the photo's own.
    layers : bool
        Also write the sky, the clouds, the land and the matte of a scene (``export.layers``): as
        pages of a .tif, as ``sky.R`` … of an .exr, as files ``out.sky.png`` … beside a .png or
        .webp.
    headroom : float, 0–8
        Stops of light above white to keep of a rendered scene: of the moved sun, its glow and
        glitter (``render``). In .jpg as a gain map (ISO 21496-1, "Ultra HDR"): screens that can
        show them brighter than white, and its own pixels are the picture without. In .exr, .hdr
        and 32-bit .tif in the light itself. An unmoved photo keeps the gain map that its file came
        with, whatever is asked for.
    progress : callable, optional
        Called as ``progress(fraction, message)`` while a scene is rendered; what it raises
        cancels the export.

    Returns
    -------
    Path
        Where the picture is.

    Raises
    ------
    FileExistsError
        When ``path``, or a file for a layer, exists and ``overwrite`` is false.
    PhotoError
        For an unknown ending, or a picture that this format or this function cannot take.
    EditError
        For a size or headroom out of range.
    OSError
        When the folder is missing or the disk full; no half-written file is left.

    Warns
    -----
    PhotoWarning
        When the format cannot keep something, such as transparency in a JPEG, and when nothing is
        brighter than white, so that there is no gain map.
    """
    place = target(path, overwrite=overwrite)
    headroom = checked_headroom(headroom)
    form = check_format(place, bit_depth, layers=layers, headroom=headroom)
    check_quality(quality)
    names = LAYERS if layers and form.layers == "beside" else ()
    places = {name: place.with_suffix(f".{name}{place.suffix}") for name in names}
    for beside in places.values():
        target(beside, overwrite=overwrite)
    wanted = _Wanted(form, bit_depth, size, layers, headroom, quality, progress)
    still = _still(picture, _photo_of(like), wanted)
    still.quality = quality
    files = {place: form.encode(still)}
    for name, beside in places.items():
        files[beside] = form.encode(layer_alone(still, name))
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
    """Encode light in the profile of ``photo``; pixels that equal its own keep their codes.

    Parameters
    ----------
    photo : Photo
        Whose profile and, by default, bit depth to use.
    light : (H, W, 3) float array
        Linear Rec. 709. Colours outside the profile's gamut are clamped.
    bit_depth : {8, 16}, optional
        Default: the photo's own, 16 for a float photo.
    rows : slice, optional
        Which rows of the photo ``light`` is. Default: all.

    Returns
    -------
    (H, W, 3) uint8 or uint16 array
        Changed pixels of 8 bits are dithered (triangular, half a level, fixed seed), so
        that a smooth sky does not band.
    """
    bits = bit_depth or min(photo.bit_depth, 16)
    dtype = np.dtype(np.uint8 if bits == 8 else np.uint16)
    first = rows.indices(photo.height)[0]
    # Strips must not repeat one another's noise.
    codes = photo.profile.encode(light, dtype, dither=dtype == np.uint8, seed=first)
    own = photo.encoded[rows]
    if own.shape != light.shape or own.dtype.kind == "f":
        return codes
    if own.dtype != dtype:
        # 257 takes each 8-bit level to its 16-bit one, and back after rounding.
        own = own * np.uint16(257) if bits == 16 else np.rint(own / 257).astype(np.uint8)
    for part in strips(light.shape):
        was = photo.light(slice(first + part.start, first + part.stop))
        same = np.abs(light[part] - was) <= _SAME_LIGHT + _SAME_SHARE * np.abs(was)
        kept = same.all(axis=-1)
        codes[part][kept] = own[part][kept]
    return codes


class _Wanted(NamedTuple):
    """What was asked for besides the picture."""

    form: Format
    bit_depth: int | None
    size: tuple[int, int] | None
    layers: bool
    headroom: float
    quality: int
    progress: Progress | None

    def bits(self, own: int) -> int:
        """Bits a channel for a picture that has ``own``."""
        if self.bit_depth is not None or self.form.linear:
            return self.bit_depth or self.form.depths[0]
        return min(16 if own > 8 else 8, self.form.depths[0])

    def is_light(self, bits: int) -> bool:
        """Tell whether the file holds linear light in floats."""
        return self.form.linear or bits == 32


def checked_headroom(headroom: Any) -> float:
    """Return stops of light above white; an EditError says what is wrong with others."""
    if type(headroom) in {int, float} and headroom == 0:
        return 0.0  # without the renderer, which pictures from elsewhere do not need
    from sunwidget.renderer.offscreen import checked_headroom as checked

    return checked(headroom)


def _photo_of(like: Any) -> Photo | None:
    photo = getattr(like, "photo", like)
    if photo is None or isinstance(photo, Photo):
        return photo
    raise PhotoError(f"like must be a Photo or Scene, not {type(like).__name__}.")


def _still(picture: Any, like: Photo | None, wanted: _Wanted) -> Still:
    """Bring whatever a person passed to codes or light, and metadata."""
    if hasattr(picture, "photo"):
        picture = (picture, None)
    if isinstance(picture, tuple):
        return _of_scene(*_scene_and_edit(picture), wanted)
    if wanted.size is not None or wanted.layers:
        raise PhotoError("size and layers are of a rendered scene: save (scene, edit).")
    if wanted.headroom and not isinstance(picture, Photo):
        raise PhotoError("headroom is of a rendered scene: save (scene, edit).")
    array = open_photo(picture)
    bits = wanted.bits(array.bit_depth)
    source = like or array
    if wanted.is_light(bits):
        codes: NDArray[Any] = array.pixels
    elif like is None or like.profile.is_srgb:
        codes = _own_codes(array, bits)
    else:
        codes = encode_like(like, array.pixels, bit_depth=bits)
    alpha = array.alpha if array.alpha is not None else source.alpha
    still = _with_metadata(codes, source, alpha, bits)
    still.gain_map = array.gain_map
    return still


def _of_scene(scene: Any, edit: Edit | None, wanted: _Wanted) -> Still:
    photo: Photo = scene.photo
    bits = wanted.bits(photo.bit_depth)
    is_light = wanted.is_light(bits)

    def drawn(edit: Edit | None, share: float, done: float) -> NDArray[Any]:
        def progress(fraction: float, message: str) -> None:
            if wanted.progress is not None:
                wanted.progress(done + share * fraction, message)

        white = wanted.headroom if is_light else 0.0
        return _rendered(scene, edit, 32 if is_light else bits, wanted.size, progress, white)

    makes_map = wanted.form.gain_map and wanted.headroom > 0
    codes = drawn(edit, 0.5 if wanted.layers or makes_map else 1.0, 0.0)
    recipe = edit.to_dict() if edit is not None else None
    still = _with_metadata(codes, photo, photo.alpha, bits, recipe)
    if edit is None or edit == Edit() or np.array_equal(codes, photo.encoded):
        still.gain_map = photo.gain_map
    elif makes_map:
        still.quality = wanted.quality
        still.gain_map = gain_map_of(scene, edit, still, wanted.headroom, wanted.progress)
    if wanted.layers:
        still.layers = layers_of(scene, edit or Edit(), codes, lambda e: drawn(e, 0.5, 0.5))
    return still


def _scene_and_edit(pair: tuple[Any, ...]) -> tuple[Any, Edit | None]:
    if len(pair) == 2 and hasattr(pair[0], "photo"):
        scene, edit = pair
        if edit is None or isinstance(edit, Edit):
            return scene, edit
        if isinstance(edit, dict):
            return scene, Edit.from_dict(edit)
    raise PhotoError(
        f"A tuple to save is (scene, edit), not ({', '.join(type(x).__name__ for x in pair)})."
    )


def _own_codes(photo: Photo, bits: int) -> NDArray[Any]:
    if photo.bit_depth == bits:
        return photo.encoded
    codes = np.empty(photo.encoded.shape, np.uint8 if bits == 8 else np.uint16)
    for rows in strips(codes.shape):
        codes[rows] = encode_like(photo, photo.light(rows), bit_depth=bits, rows=rows)
    return codes


def _rendered(
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
        # The same call as sw.render: the file is the very frame that the canvas shows.
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
        still.icc = None  # it is of the encoding that was undone
    return still


def _alpha_codes(alpha: NDArray[np.float32] | None, codes: NDArray[Any]) -> NDArray[Any] | None:
    """Alpha in the type and size of ``codes``; None where the shape is another (a cut-out)."""
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
