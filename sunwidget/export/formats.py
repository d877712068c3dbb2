"""Encoders of code values and metadata, and the table of picture formats."""

from __future__ import annotations

import io
import struct
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from sunwidget.errors import PhotoError
from sunwidget.export.dropped import warn_dropped
from sunwidget.export.gain_map_file import append_gain_map, with_gain_map_xmp
from sunwidget.export.linear import exr, hdr
from sunwidget.export.still import Still
from sunwidget.export.tiff import EFFORT, tiff
from sunwidget.formats import exif as exif_tags
from sunwidget.formats import openexr
from sunwidget.messages import did_you_mean, short_repr

# A JPEG segment holds 65533 bytes; Pillow's EXIF header uses six of them.
_SEGMENT = 65_500


def jpeg(still: Still) -> bytes:
    """Encode as JPEG, 4:4:4 from quality 90, followed by the gain map. Drops alpha."""
    _refuse_longer_than(still, 65_500, "JPEG")
    if still.alpha is not None:
        warn_dropped("JPEG has no transparency; it was dropped. PNG, TIFF and WebP keep it.")
    options: dict[str, Any] = {"subsampling": 0 if still.quality >= 90 else 2}
    if still.dpi:
        options["dpi"] = still.dpi
    block = still.exif
    if block and len(block) > _SEGMENT:
        block, missing = exif_tags.shortened(block, _SEGMENT)
        warn_dropped(
            f"The EXIF is too long for a JPEG; its {missing} was dropped. PNG and TIFF keep it."
        )
    if block:
        options["exif"] = block
    packet = still.xmp
    if packet and len(packet) > _SEGMENT:
        warn_dropped("The XMP metadata is too long for a JPEG and was dropped.")
        packet = None
    if still.gain_map is not None:
        packet = with_gain_map_xmp(packet, still.gain_map, _SEGMENT)
    if packet:
        options["xmp"] = packet
    picture = _pillow(still, "JPEG", options)
    return picture if still.gain_map is None else append_gain_map(picture, still.gain_map)


def webp(still: Still) -> bytes:
    """Encode as WebP; quality 100 is lossless."""
    _refuse_longer_than(still, 16_383, "WebP")
    options: dict[str, Any] = {"lossless": still.quality >= 100, "exact": True, "method": 4}
    options.update(exif=still.exif or b"", xmp=still.xmp or b"")
    return _pillow(still, "WEBP", options)


def _pillow(still: Still, format_name: str, options: dict[str, Any]) -> bytes:
    from PIL import Image

    samples = still.codes if format_name == "JPEG" else still.samples
    out = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(samples)).save(
        out, format_name, quality=still.quality, icc_profile=still.icc, **options
    )
    return out.getvalue()


def png(still: Still) -> bytes:
    """Encode as PNG with 8 or 16 bits: OpenCV compresses the pixels, the metadata is added here."""
    import cv2

    samples = still.samples
    order = [2, 1, 0, 3][: samples.shape[2]]
    succeeded, packed = cv2.imencode(
        ".png",
        np.ascontiguousarray(samples[..., order]),
        [cv2.IMWRITE_PNG_COMPRESSION, EFFORT[samples.itemsize]],
    )
    if not succeeded:
        raise PhotoError("OpenCV could not encode the picture as PNG.")
    data = packed.tobytes()
    chunks = []
    if still.icc:
        chunks.append(_chunk(b"iCCP", b"ICC profile\0\0" + zlib.compress(still.icc)))
    else:
        chunks.append(_chunk(b"sRGB", b"\0"))
    if still.dpi:
        per_metre = [round(value / 0.0254) for value in still.dpi]
        chunks.append(_chunk(b"pHYs", struct.pack(">IIB", *per_metre, 1)))
    if still.exif:
        chunks.append(_chunk(b"eXIf", still.exif.removeprefix(b"Exif\0\0")))
    if still.xmp:
        chunks.append(_chunk(b"iTXt", b"XML:com.adobe.xmp\0\0\0\0\0" + still.xmp))
    # The signature has 8 bytes, the header chunk, always the first, 25.
    return b"".join([data[:33], *chunks, data[33:]])


def _chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def _refuse_longer_than(still: Still, limit: int, format_name: str) -> None:
    height, width = still.codes.shape[:2]
    if max(width, height) > limit:
        raise PhotoError(
            f"{format_name} holds at most {limit} pixels per side; this picture has "
            f"{width}×{height}. Save it as PNG or TIFF."
        )


Encoder = Callable[[Still], bytes]


@dataclass(frozen=True)
class Format:
    """A kind of picture file.

    Attributes
    ----------
    encode : callable
        Still to bytes.
    depths : tuple of int
        Supported bits per channel, the default for deep pictures first.
    linear : bool
        Whether it holds light instead of code values.
    layers : {"inside", "beside", ""}
        Where layers go: into the file, into files beside it, or nowhere.
    gain_map : bool
        Whether it holds light above white as a gain map.
    """

    encode: Encoder
    depths: tuple[int, ...]
    linear: bool = False
    layers: str = ""
    gain_map: bool = False


_JPEG, _TIFF = Format(jpeg, (8,), gain_map=True), Format(tiff, (16, 8, 32), layers="inside")

FORMATS: dict[str, Format] = {
    ".png": Format(png, (16, 8), layers="beside"),
    ".jpg": _JPEG,
    ".jpeg": _JPEG,
    ".tif": _TIFF,
    ".tiff": _TIFF,
    ".webp": Format(webp, (8,), layers="beside"),
    ".exr": Format(exr, (16, 32), linear=True, layers="inside"),
    # Eight bits per channel and a shared exponent, which count as 32.
    ".hdr": Format(hdr, (32,), linear=True),
}
"""Formats by file extension."""


def check_quality(quality: Any) -> None:
    """Raise PhotoError, before any work, for an invalid quality of a picture or film."""
    if isinstance(quality, bool) or not isinstance(quality, int) or not 1 <= quality <= 100:
        raise PhotoError(
            f"quality must be a whole number from 1 to 100, not {short_repr(quality, 40)}."
        )


def check_format(
    path: Path, bit_depth: int | None = None, *, layers: bool = False, headroom: float = 0.0
) -> Format:
    """Return the format of a file's extension, checked before any work.

    Raises
    ------
    PhotoError
        For an unknown extension, for a depth, layers or light above white (``headroom``) that the
        format cannot hold, and for EXR without its extra.
    """
    suffix = path.suffix.lower()
    if suffix not in FORMATS:
        hint = did_you_mean(suffix, FORMATS)
        raise PhotoError(
            f"{path.name} ends in {suffix or 'nothing'!r}; expected one of "
            f"{', '.join(FORMATS)}.{hint}"
        )
    form = FORMATS[suffix]
    if bit_depth is not None and (type(bit_depth) is not int or bit_depth not in (8, 16, 32)):
        raise PhotoError(f"bit_depth must be 8, 16 or 32, not {short_repr(bit_depth, 40)}.")
    if bit_depth is not None and bit_depth not in form.depths:
        held = " or ".join(str(depth) for depth in sorted(form.depths))
        others = [key for key, other in FORMATS.items() if bit_depth in other.depths]
        raise PhotoError(
            f"{suffix} holds {held} bits per channel. Save {bit_depth} bits as "
            f"{' or '.join(others)}."
        )
    if layers and not form.layers:
        raise PhotoError(
            f"{suffix} has no transparency, which layers need. Save them as .tif, .exr, .png "
            "or .webp."
        )
    if headroom and not (form.gain_map or form.linear or bit_depth == 32):
        raise PhotoError(
            f"{suffix} cannot hold light above white (headroom). Save as .jpg (a gain map), .exr, "
            ".hdr, or .tif with 32 bits."
        )
    if suffix == ".exr":
        openexr.library()  # report a missing extra before the work
    return form
