"""JPEG with light above white: an ordinary picture, followed by its gain map.

"Ultra HDR Image Format v1.1" (Android, 2024) and ISO 21496-1 leave the picture's scan unchanged.
Before it they add a multi-picture index (CIPA DC-007), an XMP entry and the ISO's marker.
"""

from __future__ import annotations

import struct

from sunwidget.formats import xmp
from sunwidget.formats.gain_map import ISO_NAME, GainMap, segment, segments

_INDEX = 8 + 2 + 3 * 12 + 4 + 2 * 16  # bytes of a multi-picture index with two entries


def append_gain_map(picture: bytes, gain_map: GainMap) -> bytes:
    """Return the JPEG ``picture`` followed by its map; its XMP must already announce the map."""
    end = 2
    for marker, at, body in segments(picture):
        if 0xE0 <= marker <= 0xEF:
            end = at + 4 + len(body)
    head = picture[:end] + segment(0xE2, ISO_NAME + bytes(4))  # version 0 of its reader and writer
    # Offsets count from the start of the index, after marker, length and name.
    start = len(head) + 8
    whole = start + _INDEX + len(picture) - end
    index = struct.pack(">2sHIH", b"MM", 42, 8, 3)
    index += struct.pack(">HHI4s", 0xB000, 7, 4, b"0100")
    index += struct.pack(">HHII", 0xB001, 4, 1, 2)
    index += struct.pack(">HHII", 0xB002, 7, 32, _INDEX - 32)
    index += struct.pack(">I", 0)
    index += struct.pack(">IIIHH", 0x030000, whole, 0, 0, 0)  # the primary picture
    index += struct.pack(">IIIHH", 0, len(gain_map.jpeg), whole - start, 0, 0)
    return head + segment(0xE2, b"MPF\0" + index) + picture[end:] + gain_map.jpeg


def with_gain_map_xmp(packet: bytes | None, gain_map: GainMap, longest: int) -> bytes:
    """Return the picture's XMP with the map's entry, or the entry alone if both are too long."""
    length = len(gain_map.jpeg)
    whole = xmp.with_gain_map(packet, length)
    return whole if len(whole) <= longest else xmp.with_gain_map(None, length)
