"""Decode picture files to code values: bytes in, :class:`Decoded` or a PhotoError out.

Pillow reads everything that it can read without loss. OpenCV reads 16-bit color and float TIFF,
which Pillow would reduce to 8 bits or refuse. OpenEXR, Radiance HDR, HEIC and camera raw have
separate readers.
"""

from __future__ import annotations

import base64
import contextlib
import importlib
import io
import json
import threading
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.errors import PhotoError
from sunwidget.formats import apple_gain_map, openexr, radiance, xmp
from sunwidget.formats import exif as exif_tags
from sunwidget.formats import gain_map as gain_maps
from sunwidget.formats.color import SRGB, ColorProfile
from sunwidget.formats.deep import decode_with_opencv, is_deep, tiff_tags
from sunwidget.formats.pixels import check_light, check_size, split_alpha, upright
from sunwidget.photo import decode_heif, decode_raw
from sunwidget.photo.color_management import Coded, by_hints, by_primaries, by_profile, cmyk_to_srgb

# Not EPS, WMF and similar formats, which can start other programs.
_PLUGINS = ("Jpeg", "Mpo", "Png", "Tiff", "WebP", "Bmp", "Gif", "Avif")
_READABLE = "JPEG, PNG, TIFF, WebP, AVIF, HEIC, BMP, GIF, OpenEXR, Radiance HDR or camera raw"
_FOREIGN = {
    b"%PDF": "a PDF",
    b"<svg": "an SVG drawing",
    b"<?xm": "an XML file",
    b"<!DO": "a web page",
    b"<htm": "a web page",
    b"PK\x03\x04": "a ZIP archive",
    b"8BPS": "a Photoshop file",
}
_TIFF = (b"II*\0", b"MM\0*")
_bomb_lock = threading.Lock()


@dataclass
class Decoded:
    """A picture as its file stores it, turned upright.

    ``codes`` is (H, W, 3) uint8 or uint16 in ``profile``, or float32 linear Rec. 709.
    ``exif`` is a Pillow Exif or None; ``notes`` are sentences for the user; ``recipe`` is the
    recorded recipe in a format without EXIF.
    """

    codes: NDArray[Any]
    alpha: NDArray[np.float32] | None = None
    profile: ColorProfile = SRGB
    icc: bytes | None = None
    exif: Any = None
    xmp: bytes | None = None
    dpi: tuple[float, float] | None = None
    format: str | None = None
    turned: bool = False
    notes: list[str] = field(default_factory=list)
    recipe: dict[str, Any] | None = None
    gain_map: gain_maps.GainMap | None = None
    depth: decode_heif.DepthMap | None = None


def decode_bytes(data: bytes, name: str) -> Decoded:
    """Decode the picture file ``data``; error messages call it ``name``.

    Raises
    ------
    PhotoError
        If the bytes are no picture, a damaged one, or one of more than MAX_PIXELS.
    """
    if not data:
        raise PhotoError(f"{name} is empty (0 bytes). Copy or download it again.")
    if data.startswith((openexr.MAGIC, *radiance.MAGIC)):
        return _decode_light(data, name)
    if decode_heif.is_heif(data):
        return _decode_heif(data, name)
    tags = tiff_tags(data) if data.startswith(_TIFF) else {}
    if decode_raw.is_raw(data, name, tags):
        codes, exif, turned = decode_raw.develop(data, name)
        packet = xmp.upright(_bytes(tags.get(700)))
        return Decoded(codes, exif=exif, xmp=packet, format="RAW", turned=turned)
    image = _open(data, name)
    if image is None:
        return _decode_odd_tiff(data, name)
    with image:
        return decode_image(image, name, data)


def decode_image(image: Any, name: str, data: bytes | None = None) -> Decoded:
    """Decode a Pillow image; with its file in ``data``, deep pictures keep their 16 bits.

    Raises
    ------
    PhotoError
        As :func:`decode_bytes`.
    """
    try:
        return _decode_image(image, name, data)
    except PhotoError:
        raise
    except MemoryError as error:
        raise PhotoError(f"There is not enough memory to open {name}. Scale it down.") from error
    except Exception as error:  # decoders raise many errors; all mean a damaged file
        if data is None:
            raise PhotoError(
                f"{name}, a Pillow image, cannot be read ({reason(error)}). Pass its file instead."
            ) from error
        raise PhotoError(
            f"{name} is damaged: its {image.format or 'picture'} data ends early or is invalid "
            f"({reason(error)}). Copy or download it again."
        ) from error


def _decode_image(image: Any, name: str, data: bytes | None) -> Decoded:
    check_size(image.width, image.height, name)
    notes = []
    if getattr(image, "n_frames", 1) > 1 and image.format != "MPO":
        notes.append(f"{name} holds {image.n_frames} frames; only the first is used.")
    deep = is_deep(image)
    # Loading turns a TIFF and drops its orientation; a PNG has its EXIF only after loading.
    orientation = image.getexif().get(274, 1) if image.format == "TIFF" else None
    image.load()
    metadata = exif_tags.load(_exif_block(image))
    if deep and image.format == "TIFF" and image.tag_v2.get(284, 1) != 1:
        # Both Pillow and OpenCV read this kind wrongly, without an error.
        raise PhotoError(
            f"{name} is a TIFF with 16 bits in separate planes. Save it with interleaved channels."
        )
    found = decode_with_opencv(data) if deep and data is not None else None
    if deep and found is None:
        hint = "" if data is not None else " Pass its file instead of a Pillow image."
        notes.append(f"The 16-bit channels of {name} could only be read with 8 bits.{hint}")
    icc = image.info.get("icc_profile") or None
    result = Decoded(np.empty(0), icc=icc, exif=metadata, format=_format(image), notes=notes)
    if found is not None:
        _fill_from_array(result, found, name)
    else:
        _fill_from_image(result, image, name)
    if result.icc is not None:
        _take(result, by_profile(result.codes, result.icc, name))
    elif icc is None:
        _take(result, by_hints(result.codes, metadata, image.info, name))
    orientation = orientation if orientation is not None else exif_tags.orientation(metadata)
    _turn_upright(result, orientation)
    packet = image.info.get("xmp")
    packet = xmp.upright(packet.encode() if isinstance(packet, str) else packet)
    result.xmp = xmp.without_gain_map(packet)  # added again when the map is written
    if data is not None:
        gain_map = gain_maps.find(data) or apple_gain_map.find(data, metadata)
        result.gain_map = gain_map and gain_map.turned(orientation)
    result.dpi = _dpi(image)
    return result


def _open(data: bytes, name: str) -> Any:
    from PIL import Image, UnidentifiedImageError

    formats = _formats()
    # Pillow's own limit against decompression bombs is lower than ours, only warns at first, and
    # is global. It is lifted while the header is read; check_size() follows.
    with _bomb_lock:
        limit, Image.MAX_IMAGE_PIXELS = Image.MAX_IMAGE_PIXELS, None
        try:
            with exif_tags.quiet():
                return Image.open(io.BytesIO(data), formats=formats)
        except UnidentifiedImageError as error:
            if data[:4] in _TIFF:
                return None
            raise PhotoError(_unknown(data, name)) from error
        except Exception as error:  # header parsers raise many errors
            raise PhotoError(
                f"{name} is damaged: its header is invalid ({reason(error)}). Copy or download it "
                "again."
            ) from error
        finally:
            Image.MAX_IMAGE_PIXELS = limit


@cache
def _formats() -> tuple[str, ...]:
    """Load Pillow's readers and return the names of their formats; AVIF needs Pillow 11.3."""
    from PIL import Image

    for plugin in _PLUGINS:
        with contextlib.suppress(ImportError):
            importlib.import_module(f"PIL.{plugin}ImagePlugin")
    return tuple(name for plugin in _PLUGINS if (name := plugin.upper()) in Image.OPEN)


def _unknown(data: bytes, name: str) -> str:
    what = next((text for head, text in _FOREIGN.items() if data.startswith(head)), None)
    if what:
        return f"{name} is {what}. Export it as {_READABLE} and open that."
    known = (b"\xff\xd8", b"\x89PNG", b"RIFF", b"GIF8", b"BM")
    if data.startswith(known):
        return f"{name} is damaged: it starts like a picture but is invalid. Copy it again."
    return f"{name} is not a picture that sunwidget reads. Expected {_READABLE}."


def reason(error: BaseException) -> str:
    """Return an error's message in one line without a full stop; its type if it has none."""
    text = str((isinstance(error, OSError) and error.strerror) or error)
    first = (text.splitlines() or [""])[0][:120].rstrip(". ")
    return "".join(c for c in first if c.isprintable()) or type(error).__name__


def _format(image: Any) -> str | None:
    return "JPEG" if image.format == "MPO" else image.format


def _exif_block(image: Any) -> bytes:
    try:
        block = image.info.get("exif") if image.format != "TIFF" else None
        if not block:
            exif = image.getexif()
            exif_tags.keep_texts(exif)
            block = exif.tobytes()
    except Exception:  # noqa: BLE001 - damaged metadata is dropped, the picture kept
        return b""
    return block if isinstance(block, bytes) else b""


def _decode_light(data: bytes, name: str) -> Decoded:
    """Decode OpenEXR or Radiance HDR, with the notes of :mod:`sunwidget.export.linear`."""
    if data.startswith(openexr.MAGIC):
        exr = openexr.read(data, name)
        result, notes = Decoded(exr.light, exr.alpha, dpi=exr.dpi, format="EXR"), exr.notes
    else:
        hdr = radiance.read(data, name)
        result, notes = Decoded(hdr.light, format="HDR"), hdr.notes
    check_light(result.codes, name)
    result.codes = np.ascontiguousarray(result.codes)
    with contextlib.suppress(ValueError, RecursionError):  # notes are untrusted text
        recipe = json.loads(notes.get("recipe", "null"))
        result.recipe = recipe if isinstance(recipe, dict) else None
        result.xmp = base64.b64decode(notes.get("xmp", ""), validate=True) or None
        result.exif = exif_tags.load(base64.b64decode(notes.get("exif", ""), validate=True) or b"?")
    return result


def _decode_heif(data: bytes, name: str) -> Decoded:
    found = decode_heif.read(data, name)
    result = Decoded(np.empty(0), icc=found.icc, exif=found.exif, format="HEIF")
    result.notes, result.turned = found.notes, found.turned
    result.depth, result.gain_map = found.depth, found.gain_map
    _fill_from_array(result, found.codes, name)
    if result.icc is not None:
        _take(result, by_profile(result.codes, result.icc, name))
    else:
        _take(result, by_primaries(result.codes, found.primaries, name))
    result.xmp = xmp.without_gain_map(xmp.upright(found.xmp))
    return result


def _bytes(value: Any) -> bytes | None:
    return value if isinstance(value, bytes) else None


def _decode_odd_tiff(data: bytes, name: str) -> Decoded:
    """Decode a TIFF that Pillow does not support: RGB in float."""
    tags = tiff_tags(data)
    width, height = tags.get(256, 0), tags.get(257, 0)
    if isinstance(width, int) and isinstance(height, int) and width and height:
        check_size(width, height, name)
        found = (
            decode_with_opencv(data) if tags.get(262) in (1, 2) and tags.get(284, 1) == 1 else None
        )
        result = Decoded(np.empty(0), format="TIFF", exif=exif_tags.load(data))
        result.xmp = xmp.upright(_bytes(tags.get(700)))
        result.turned = exif_tags.orientation(result.exif) >= 5
        upright_size = (width, height) if result.turned else (height, width)
        if found is not None and found.shape[:2] == upright_size:
            _fill_from_array(result, found, name)
            if isinstance(icc := tags.get(34675), bytes):
                _take(result, by_profile(result.codes, icc, name))
            return result
    raise PhotoError(
        f"{name} is a TIFF of an unusual or damaged kind. Save it with 8 or 16 bits per channel, "
        "RGB or gray, and open that."
    )


def _fill_from_array(result: Decoded, found: NDArray[Any], name: str) -> None:
    result.codes, result.alpha = split_alpha(found, name)
    if result.codes.dtype.kind == "f":
        check_light(result.codes, name)


def _take(result: Decoded, coded: Coded) -> None:
    result.codes, result.profile, result.icc = coded.codes, coded.profile, coded.icc
    result.notes.extend(coded.notes)


def _fill_from_image(result: Decoded, image: Any, name: str) -> None:
    if image.mode == "La":  # converts only to LA
        image = image.convert("LA")
    mode = image.mode
    if mode == "F":
        _fill_from_array(result, np.asarray(image, np.float32), name)
    elif mode.startswith("I"):
        deep = np.asarray(image).astype(np.int64)
        if deep.min() < 0 or deep.max() > 65535:
            raise PhotoError(f"{name} has 32-bit integers. Save it with 16 bits per channel.")
        if image.format == "TIFF" and image.tag_v2.get(262) == 0:
            deep = 65535 - deep  # white is zero, which Pillow handles only with 8 bits
        _fill_from_array(result, deep.astype(np.uint16), name)
    elif mode == "1":
        _fill_from_array(result, np.asarray(image.convert("L")), name)
    elif mode in ("RGB", "RGBA", "L", "LA"):
        if "transparency" in image.info:
            image = image.convert("LA" if mode == "L" else "RGBA")
        _fill_from_array(result, np.asarray(image), name)
    elif mode == "CMYK":
        converted, notes = cmyk_to_srgb(image, result.icc, name)
        result.icc = None
        result.notes.extend(notes)
        _fill_from_array(result, np.asarray(converted), name)
    else:  # palettes, YCbCr, Lab, premultiplied alpha
        has_alpha = "transparency" in image.info or mode in ("PA", "RGBa")
        try:
            converted = image.convert("RGBA" if has_alpha else "RGB")
        except ValueError as error:
            raise PhotoError(f"{name} has pixels of the mode {mode}. Save it as RGB.") from error
        _fill_from_array(result, np.asarray(converted), name)


def _turn_upright(result: Decoded, orientation: int) -> None:
    result.turned = orientation in (5, 6, 7, 8)
    if orientation != 1 and result.format != "TIFF":  # Pillow and OpenCV turn TIFF themselves
        result.codes = np.ascontiguousarray(upright(result.codes, orientation))
        if result.alpha is not None:
            result.alpha = np.ascontiguousarray(upright(result.alpha, orientation))


def _dpi(image: Any) -> tuple[float, float] | None:
    try:
        across, down = (float(value) for value in image.info["dpi"])
    except (KeyError, TypeError, ValueError, ZeroDivisionError):
        return None
    return (across, down) if 1 <= across <= 65535 and 1 <= down <= 65535 else None
