"""TIFF 6.0 with 8 bits, 16 bits or float light, and one page per layer."""

from __future__ import annotations

import io
import os
import struct
import zlib
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.errors import PhotoError
from sunwidget.formats import exif as exif_tags

if TYPE_CHECKING:
    from sunwidget.export.still import Still

_STRIP_BYTES = 1 << 20
_LARGEST = 2**32 - 1
# Deflate levels by bytes per channel: level 6 takes three times as long and saves 8 % (8 bits) or
# 1 % (16 bits, whose low byte is noise) of the size.
EFFORT = {1: 4, 2: 1, 4: 1}


def tiff(still: Still) -> bytes:
    """Encode as TIFF 6.0 with deflate, integers with horizontal differencing.

    Layers follow as further pages named by ``PageName``, as GIMP opens them.
    """
    out = io.BytesIO()
    pages = [("", still.samples), *still.layers.items()]
    pointer = 0
    for number, (name, samples) in enumerate(pages):
        tags: dict[int, Any] = {}
        if len(pages) > 1:
            tags = {254: 2, 285: name or "picture", 297: (number, len(pages))}
        start = out.tell()
        directory, packed = _page(still if number == 0 else None, samples, tags, still.dpi)
        out.seek(start)
        directory.save(out)
        begin = max(start, 8)  # the file's header precedes the first
        entries = int(struct.unpack("<H", out.getbuffer()[begin : begin + 2])[0])
        if number > 0:
            out.seek(pointer)
            out.write(struct.pack("<I", begin))
        pointer = begin + 2 + 12 * entries
        out.seek(0, io.SEEK_END)
        for strip in packed:
            out.write(strip)
        out.write(b"\0" * (out.tell() % 2))  # directories begin at even offsets
        if out.tell() > _LARGEST:
            raise PhotoError("A TIFF holds 4 GB; this picture needs more. Save it with 8 bits.")
    return out.getvalue()


def _page(
    described: Still | None,
    samples: NDArray[Any],
    tags: dict[int, Any],
    dpi: tuple[float, float] | None,
) -> tuple[Any, list[bytes]]:
    """Return a page's directory, with the metadata of ``described``, and its strips."""
    from PIL import TiffImagePlugin

    height, width, count = samples.shape
    rows = max(1, _STRIP_BYTES // (width * count * samples.itemsize))
    with ThreadPoolExecutor(os.cpu_count()) as pool:  # zlib releases the GIL
        tops = range(0, height, rows)
        packed = list(pool.map(lambda top: _pack_strip(samples[top : top + rows]), tops))
    ends = np.cumsum([len(strip) for strip in packed])
    directory = TiffImagePlugin.ImageFileDirectory_v2(prefix=b"II")
    exif = exif_tags.load(described.exif) if described is not None and described.exif else None
    if exif is not None:
        for tag in exif:
            # Camera and GPS data are subdirectories; Pillow writes a dict as one.
            directory[tag] = dict(exif.get_ifd(tag)) if tag in (0x8769, 0x8825) else exif[tag]
    tags |= {
        256: width,
        257: height,
        258: (samples.itemsize * 8,) * count,
        259: 8,  # deflate
        262: 2 if count >= 3 else 1,  # RGB or gray
        # Relative to the end of the directory; Pillow adds its offset.
        273: tuple(int(end) - len(strip) for end, strip in zip(ends, packed, strict=True)),
        277: count,
        278: rows,
        279: tuple(len(strip) for strip in packed),
        284: 1,  # channels interleaved
    }
    if samples.dtype.kind == "f":
        tags[339] = (3,) * count
    else:
        tags[317] = 2  # horizontal differences
    if dpi:
        tags.update({282: dpi[0], 283: dpi[1], 296: 2})
    if count in (2, 4):
        tags[338] = 2  # straight alpha
    for tag, value in tags.items():
        directory[tag] = value
    if described is not None:
        for tag, block, kind in ((700, described.xmp, 1), (34675, described.icc, 7)):
            if block:
                directory.tagtype[tag] = kind
                directory[tag] = block
    return directory, packed


def _pack_strip(samples: NDArray[Any]) -> bytes:
    rows = samples
    if samples.dtype.kind == "u":
        rows = samples.copy()
        rows[:, 1:] -= samples[:, :-1]  # wraps around, as TIFF 6.0 section 14 requires
    return zlib.compress(
        rows.astype(rows.dtype.newbyteorder("<")).tobytes(), EFFORT[samples.itemsize]
    )
