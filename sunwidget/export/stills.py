"""Stills on disk: the picture in the photo's own encoding, with its metadata.

What an edit did not touch keeps its code values exactly: an unmoved photo, saved again
as PNG or TIFF, has the very pixels it was opened with, in 8 and 16 bits and in any
colour profile.
"""

from __future__ import annotations

import difflib
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget import exif as exif_tags
from sunwidget.color import strips
from sunwidget.edit import Edit
from sunwidget.export.formats import FORMATS, Encoder, Still
from sunwidget.files import complete_or_absent, target
from sunwidget.photo import Photo, PhotoError, open_photo

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
    progress: Callable[[float, str], object] | None = None,
) -> Path:
    """Write a picture as PNG, JPEG, TIFF or WebP, whole or not at all.

    Parameters
    ----------
    picture : (Scene, Edit), Scene, Photo or (H, W, 3) array
        A scene and an edit are rendered at full size and written in the photo's own
        profile and bit depth, with the recipe in the EXIF's user comment. uint8 and
        uint16 arrays are sRGB, float arrays linear Rec. 709 light.
    path : path
        The ending chooses the format: .png, .jpg, .tif, .webp.
    like : Photo or Scene, optional
        For arrays: whose profile and metadata (EXIF, ICC, XMP, resolution) to carry.
    overwrite : bool
        Replace an existing file.
    quality : int
        Of JPEG and WebP, 1–100. WebP is lossless at 100.
    bit_depth : {8, 16}, optional
        Bits a channel. Default: the photo's or the array's own; 16 for floats.
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
        When ``path`` exists and ``overwrite`` is false.
    PhotoError
        For an unknown ending, or a picture that this format or this function cannot take.
    OSError
        When the folder is missing or the disk full; no half-written file is left.

    Warns
    -----
    PhotoWarning
        When the format cannot keep something, such as transparency in a JPEG.
    """
    place = target(path, overwrite=overwrite)
    encoder, bits = _encoder(place, bit_depth)
    if isinstance(quality, bool) or not isinstance(quality, int) or not 1 <= quality <= 100:
        raise PhotoError(f"quality must be a whole number from 1 to 100, not {quality!r:.40}.")
    still = _still(picture, _photo_of(like), bits, exact=bit_depth is not None, progress=progress)
    still.quality = quality
    data = encoder(still)
    try:
        with complete_or_absent(place, overwrite=overwrite) as unfinished:
            unfinished.write_bytes(data)
    except FileExistsError:
        raise
    except OSError as error:
        reason = error.strerror or str(error)
        raise type(error)(f"{path} was not written: {reason}. No part of it was left.") from error
    return place


def encode_like(photo: Photo, light: NDArray[Any], *, bit_depth: int | None = None) -> NDArray[Any]:
    """Encode light in the profile of ``photo``; pixels that equal its own keep their codes.

    Parameters
    ----------
    photo : Photo
        Whose profile and, by default, bit depth to use.
    light : (H, W, 3) float array
        Linear Rec. 709. Colours outside the profile's gamut are clamped.
    bit_depth : {8, 16}, optional
        Default: the photo's own, 16 for a float photo.

    Returns
    -------
    (H, W, 3) uint8 or uint16 array
        Changed pixels of 8 bits are dithered (triangular, half a level, fixed seed), so
        that a smooth sky does not band.
    """
    bits = bit_depth or min(photo.bit_depth, 16)
    dtype = np.dtype(np.uint8 if bits == 8 else np.uint16)
    codes = photo.profile.encode(light, dtype, dither=dtype == np.uint8)
    if photo.encoded.shape != light.shape or photo.encoded.dtype.kind == "f":
        return codes
    own = photo.encoded
    if own.dtype != dtype:
        # 257 takes each 8-bit level to its 16-bit one, and back after rounding.
        own = own * np.uint16(257) if bits == 16 else np.rint(own / 257).astype(np.uint8)
    for rows in strips(light.shape):
        was = photo.pixels[rows]
        same = np.abs(light[rows] - was) <= _SAME_LIGHT + _SAME_SHARE * np.abs(was)
        kept = same.all(axis=-1)
        codes[rows][kept] = own[rows][kept]
    return codes


def _encoder(place: Path, bit_depth: int | None) -> tuple[Encoder, int]:
    suffix = place.suffix.lower()
    if suffix not in FORMATS:
        near = difflib.get_close_matches(suffix, FORMATS, n=1)
        hint = f" Did you mean {near[0]!r}?" if near else ""
        raise PhotoError(
            f"{place.name} ends in {suffix or 'nothing'!r}; expected one of "
            f"{', '.join(FORMATS)}.{hint}"
        )
    encoder, most = FORMATS[suffix]
    if bit_depth is None:
        return encoder, most
    if bit_depth not in (8, 16):
        raise PhotoError(f"bit_depth must be 8 or 16, not {bit_depth!r:.40}.")
    if bit_depth > most:
        raise PhotoError(f"{suffix} holds {most} bits a channel. Save 16 bits as .png or .tif.")
    return encoder, bit_depth


def _photo_of(like: Any) -> Photo | None:
    photo = getattr(like, "photo", like)
    if photo is None or isinstance(photo, Photo):
        return photo
    raise PhotoError(f"like must be a Photo or Scene, not {type(like).__name__}.")


def _still(
    picture: Any,
    like: Photo | None,
    bits: int,
    *,
    exact: bool,
    progress: Callable[[float, str], object] | None,
) -> Still:
    """Bring whatever a person passed to codes and metadata. ``exact``: ``bits`` was asked for."""
    if isinstance(picture, Photo):
        own = _own_bits(picture.bit_depth, bits, exact=exact)
        return _with_metadata(_own_codes(picture, own), picture)
    if hasattr(picture, "photo"):
        picture = (picture, None)
    if isinstance(picture, tuple):
        scene, edit = _scene_and_edit(picture)
        photo: Photo = scene.photo
        own = _own_bits(photo.bit_depth, bits, exact=exact)
        codes = _rendered(scene, edit, own, progress)
        return _with_metadata(codes, photo, edit.to_dict() if edit is not None else None)
    array = open_photo(picture)
    own = _own_bits(array.bit_depth, bits, exact=exact)
    if like is None:
        return _with_metadata(_own_codes(array, own), array)
    if like.profile.is_srgb:
        codes = _own_codes(array, own)
    else:
        codes = encode_like(like, array.pixels, bit_depth=own)
    still = _with_metadata(codes, like)
    if array.alpha is not None:
        still.alpha = _alpha_codes(array.alpha, codes)
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
    return encode_like(photo, photo.pixels, bit_depth=bits)


def _own_bits(depth: int, bits: int, *, exact: bool) -> int:
    return bits if exact else min(16 if depth > 8 else 8, bits)


def _rendered(
    scene: Any,
    edit: Edit | None,
    bits: int,
    progress: Callable[[float, str], object] | None,
) -> NDArray[Any]:
    from sunwidget.renderer.render import render

    photo: Photo = scene.photo
    if bits == 8 and photo.bit_depth == 8 and photo.profile.is_srgb:
        # The same call as sw.render: the file is the very frame that the canvas shows.
        return render(scene, edit, progress=progress)
    light = render(scene, edit, dtype="float32", progress=progress)
    return encode_like(photo, light, bit_depth=bits)


def _with_metadata(
    codes: NDArray[Any], photo: Photo, recipe: dict[str, Any] | None = None
) -> Still:
    height, width = codes.shape[:2]
    read = exif_tags.load(photo.exif) if photo.exif else None
    return Still(
        codes,
        alpha=None if photo.alpha is None else _alpha_codes(photo.alpha, codes),
        icc=photo.icc,
        exif=exif_tags.dump(read, (width, height), recipe or photo.recipe),
        xmp=photo.xmp,
        dpi=photo.dpi,
    )


def _alpha_codes(alpha: NDArray[np.float32], codes: NDArray[Any]) -> NDArray[Any] | None:
    """Alpha in the type of ``codes``; None when the picture's size is another."""
    if alpha.shape != codes.shape[:2]:
        return None
    return np.rint(alpha * np.float32(np.iinfo(codes.dtype).max)).astype(codes.dtype)
