"""Gain maps of iPhones before iOS 18, converted to ISO 21496-1.

Apple, "Applying Apple HDR effect to your photos" (developer documentation, 2023): with the headroom
h, a factor, and the map's levels g without their sRGB curve, light is multiplied by 1 + (h - 1) g.
"""

from __future__ import annotations

import contextlib
import io
import re
import struct
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.formats.color import srgb_to_linear
from sunwidget.formats.exif import quiet
from sunwidget.formats.gain_map import GainMap, packed, pictures_behind

_EXIF, _MAKER_NOTE = 0x8769, 0x927C
_HEAD = b"Apple iOS\0"
_HEADROOM, _GAIN = 0x21, 0x30  # tags of the maker note
_IN_XMP = re.compile(rb"HDRGainMapHeadroom(?:>|=[\"'])([\d.]+)")  # in the map's XMP, newer files
_MARK = b"HDRGainMapVersion"


def gain_map(levels: NDArray[np.uint8], headroom: float) -> GainMap | None:
    """Return the map of ``levels`` (h, w) and ``headroom``, a factor; None if that is invalid."""
    if not 1 < headroom <= 256:
        return None
    most = float(np.log2(headroom))
    stops = np.log2(1 + (headroom - 1) * srgb_to_linear(levels / np.float32(255)))
    shares = np.rint(255 * stops / most).astype(np.uint8)[..., None]
    nothing = (0.0, 0.0, 0.0)
    meaning = GainMap(
        b"", nothing, (most,) * 3, base_offset=nothing, other_offset=nothing, headroom=most
    )
    return replace(meaning, jpeg=packed(shares, meaning))


def find(data: bytes, exif: Any) -> GainMap | None:
    """Return the map after an iPhone's JPEG ``data``; None without one."""
    from PIL import Image

    for part in pictures_behind(data):
        # Untrusted bytes may fail anywhere in a parser.
        with contextlib.suppress(Exception):
            if _MARK not in part:
                continue
            with quiet(), Image.open(io.BytesIO(part), formats=("JPEG",)) as found:
                levels = np.asarray(found.convert("L"))
            if factor := headroom(exif, part):
                return gain_map(levels, factor)
    return None


def headroom(exif: Any, data: bytes = b"") -> float | None:
    """Return the headroom, a factor, from ``data`` or the maker note; None without one."""
    if match := _IN_XMP.search(data):
        return float(match[1])
    note = exif.get_ifd(_EXIF).get(_MAKER_NOTE) if exif is not None else None
    found = _rationals(note) if isinstance(note, bytes) else {}
    if _HEADROOM not in found or _GAIN not in found:
        return None
    high, gain = found[_HEADROOM], found[_GAIN]
    if high < 1:
        stops = 1.8 - 20 * gain if gain <= 0.01 else 1.601 - 0.101 * gain
    else:
        stops = 3.0 - 70 * gain if gain <= 0.01 else 2.303 - 0.303 * gain
    return float(2 ** max(stops, 0.0))


def _rationals(note: bytes) -> dict[int, float]:
    """Return the signed fractions of an Apple maker note by tag; its directory is at byte 14."""
    if not note.startswith(_HEAD) or len(note) < 16:
        return {}
    order = "<" if note[12:14] == b"II" else ">"
    found = {}
    for number in range(struct.unpack_from(f"{order}H", note, 14)[0]):
        at = 16 + 12 * number
        if at + 12 > len(note):
            break
        tag, kind, count, place = struct.unpack_from(f"{order}HHII", note, at)
        if kind == 10 and count == 1 and place + 8 <= len(note):  # signed rational
            above, below = struct.unpack_from(f"{order}ii", note, place)
            if below:
                found[tag] = above / below
    return found
