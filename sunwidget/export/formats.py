"""Code values and metadata to the bytes of a JPEG, PNG, TIFF or WebP file."""

from __future__ import annotations

import io
import struct
import warnings
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget import exif as exif_tags
from sunwidget.photo import PhotoError, PhotoWarning

# A JPEG segment holds 65533 bytes, of which Pillow's EXIF head takes six.
_SEGMENT = 65_500
_STRIP_BYTES = 1 << 20
# Deflate levels by bytes a channel: level 6 takes three times as long for 8 % (8 bits) or
# 1 % (16 bits, whose low byte is noise) of the size.
_EFFORT = {1: 4, 2: 1}


@dataclass
class Still:
    """A picture ready to be written.

    ``codes`` is (H, W, 3) uint8 or uint16, ``alpha`` (H, W) in the same type or None;
    ``exif`` is a block as Pillow makes it, with its six-byte head.
    """

    codes: NDArray[Any]
    alpha: NDArray[Any] | None = None
    icc: bytes | None = None
    exif: bytes | None = None
    xmp: bytes | None = None
    dpi: tuple[float, float] | None = None
    quality: int = 95

    @property
    def samples(self) -> NDArray[Any]:
        """Colour, and alpha where there is one: (H, W, 3 or 4)."""
        if self.alpha is None:
            return self.codes
        return np.dstack([self.codes, self.alpha])


def jpeg(still: Still) -> bytes:
    """Encode as JPEG, 4:4:4 from quality 90 upwards. Alpha is lost."""
    _refuse_longer_than(still, 65_500, "JPEG")
    if still.alpha is not None:
        _warn("JPEG has no transparency; it is left out. PNG, TIFF and WebP keep it.")
    options: dict[str, Any] = {"subsampling": 0 if still.quality >= 90 else 2}
    if still.dpi:
        options["dpi"] = still.dpi
    block = still.exif
    if block and len(block) > _SEGMENT:
        block, missing = exif_tags.shortened(block, _SEGMENT)
        _warn(f"The EXIF is too long for a JPEG: its {missing} is left out. PNG and TIFF keep it.")
    if block:
        options["exif"] = block
    if still.xmp and len(still.xmp) > _SEGMENT:
        _warn("The XMP metadata is too long for a JPEG and is left out.")
    elif still.xmp:
        options["xmp"] = still.xmp
    return _pillow(still, "JPEG", options)


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
    """Encode as PNG with 8 or 16 bits: OpenCV packs the pixels, the metadata is ours."""
    import cv2

    samples = still.samples
    order = [2, 1, 0, 3][: samples.shape[2]]
    done, packed = cv2.imencode(
        ".png",
        np.ascontiguousarray(samples[..., order]),
        [cv2.IMWRITE_PNG_COMPRESSION, _EFFORT[samples.itemsize]],
    )
    if not done:
        raise PhotoError("OpenCV could not pack the picture as PNG.")
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
    # The signature is 8 bytes and the header chunk, always the first, 25.
    return b"".join([data[:33], *chunks, data[33:]])


def _chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def tiff(still: Still) -> bytes:
    """Encode as TIFF 6.0 with 8 or 16 bits, deflate with horizontal differences."""
    from PIL import Image, TiffImagePlugin

    samples = still.samples
    height, width, count = samples.shape
    rows = max(1, _STRIP_BYTES // (width * count * samples.itemsize))
    packed = [_pack_strip(samples[top : top + rows]) for top in range(0, height, rows)]
    ends = np.cumsum([len(strip) for strip in packed])

    directory = TiffImagePlugin.ImageFileDirectory_v2(prefix=b"II")
    if still.exif:
        exif = Image.Exif()
        exif.load(still.exif)
        for tag in exif:
            # Camera and place are directories of their own: Pillow writes a dict as one.
            directory[tag] = dict(exif.get_ifd(tag)) if tag in (0x8769, 0x8825) else exif[tag]
    tags: dict[int, Any] = {
        256: width,
        257: height,
        258: (samples.itemsize * 8,) * count,
        259: 8,  # deflate
        262: 2,  # RGB
        # Relative to the end of the directory; Pillow adds where that is.
        273: tuple(int(end) - len(strip) for end, strip in zip(ends, packed, strict=True)),
        277: count,
        278: rows,
        279: tuple(len(strip) for strip in packed),
        284: 1,  # channels interleaved
        317: 2,  # horizontal differences
    }
    if still.dpi:
        tags.update({282: still.dpi[0], 283: still.dpi[1], 296: 2})
    if count == 4:
        tags[338] = 2  # straight alpha
    for tag, value in tags.items():
        directory[tag] = value
    for tag, block, kind in ((700, still.xmp, 1), (34675, still.icc, 7)):
        if block:
            directory.tagtype[tag] = kind
            directory[tag] = block
    out = io.BytesIO()
    directory.save(out)
    return b"".join([out.getvalue(), *packed])


def _pack_strip(samples: NDArray[Any]) -> bytes:
    differences = samples.copy()
    differences[:, 1:] -= samples[:, :-1]  # wraps around, as TIFF 6.0 section 14 wants
    return zlib.compress(
        differences.astype(differences.dtype.newbyteorder("<")).tobytes(),
        _EFFORT[differences.itemsize],
    )


def _refuse_longer_than(still: Still, limit: int, format_name: str) -> None:
    height, width = still.codes.shape[:2]
    if max(width, height) > limit:
        raise PhotoError(
            f"{format_name} holds at most {limit} pixels a side, this picture is "
            f"{width}×{height}. Save it as PNG or TIFF."
        )


def _warn(note: str) -> None:
    warnings.warn(note, PhotoWarning, stacklevel=4)


Encoder = Callable[[Still], bytes]

FORMATS: dict[str, tuple[Encoder, int]] = {
    ".png": (png, 16),
    ".jpg": (jpeg, 8),
    ".jpeg": (jpeg, 8),
    ".tif": (tiff, 16),
    ".tiff": (tiff, 16),
    ".webp": (webp, 8),
}
"""File name ending to encoder and the most bits a channel it holds."""
