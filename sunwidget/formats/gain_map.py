"""Gain maps: how much brighter than its picture a screen may show each pixel (ISO 21496-1).

A map is a small separate JPEG after the picture's, located by the multi-picture index of CIPA
DC-007. The meaning of its levels is stored in a segment by ISO 21496-1, in its XMP by "Ultra HDR
Image Format v1.1" (Android, 2024), or in both.
"""

from __future__ import annotations

import contextlib
import io
import struct
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.formats import xmp
from sunwidget.formats.deep import tiff_tags
from sunwidget.formats.exif import quiet
from sunwidget.formats.pixels import upright

ISO_NAME = b"urn:iso:std:iso:ts:21496:-1\0"
XMP_NAME = b"http://ns.adobe.com/xap/1.0/\0"
_MANY, _BASE_COLOURS, _BACKWARD, _COMMON = 0x80, 0x40, 0x04, 0x08
_MP_NAME = b"MPF\0"
_MP_ENTRIES, _MP_ENTRY = 0xB002, 16  # tag; bytes of each

Triple = tuple[float, float, float]


@dataclass(frozen=True)
class GainMap:
    """A gain map as a file holds it.

    With the map's levels ``g`` in 0–1, ``l = low + (high - low) * g ** (1 / gamma)`` are stops. A
    screen with enough headroom shows ``(light + base_offset) * 2 ** l - other_offset``, in the
    linear colors of the picture, 1 = white.

    Attributes
    ----------
    jpeg : bytes
        The map's own JPEG, gray or in color, upright like the picture, of any size.
    low, high : (float, float, float)
        Stops of the darkest and of the brightest level, by channel.
    gamma, base_offset, other_offset : (float, float, float)
        As above, by channel.
    least_headroom, headroom : float
        Headroom, in stops above white, up to which a screen ignores the map, and from which it
        applies the whole map.
    """

    jpeg: bytes
    low: Triple = (0.0, 0.0, 0.0)
    high: Triple = (1.0, 1.0, 1.0)
    gamma: Triple = (1.0, 1.0, 1.0)
    base_offset: Triple = (1 / 64, 1 / 64, 1 / 64)
    other_offset: Triple = (1 / 64, 1 / 64, 1 / 64)
    least_headroom: float = 0.0
    headroom: float = 1.0

    def __repr__(self) -> str:
        width, height = self.size
        return f"<GainMap {width}×{height}, up to {max(self.high):.2f} stops>"

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return self.levels.shape[1], self.levels.shape[0]

    @cached_property
    def levels(self) -> NDArray[np.uint8]:
        """The map's levels, (h, w, 1 or 3) uint8, read-only."""
        from PIL import Image

        with Image.open(io.BytesIO(self.jpeg), formats=("JPEG",)) as image:
            levels = np.asarray(image if image.mode in ("L", "RGB") else image.convert("RGB"))
        levels = levels.reshape(*levels.shape[:2], -1)
        levels.flags.writeable = False
        return levels

    def applied(self, light: NDArray[Any], headroom: float | None = None) -> NDArray[np.float32]:
        """Return the light that a screen shows.

        Parameters
        ----------
        light : (H, W, 3) float array
            The picture, linear in its own primaries, 1 = white.
        headroom : float, optional
            Headroom of the screen in stops above white. Default: enough for the whole map.

        Returns
        -------
        (H, W, 3) float32 array
            Linear light up to 2 ** headroom.
        """
        import cv2

        weight = 1.0
        if headroom is not None:
            span = max(self.headroom - self.least_headroom, 1e-6)
            weight = min(max((headroom - self.least_headroom) / span, 0.0), 1.0)
        low, high, gamma, base, other = (
            np.array(values, np.float32)
            for values in (self.low, self.high, self.gamma, self.base_offset, self.other_offset)
        )
        share = (self.levels / np.float32(255)) ** (1 / gamma)
        stops = np.asarray(low + (high - low) * share, np.float32)
        height, width = light.shape[:2]
        if stops.shape[:2] != (height, width):
            stops = np.asarray(cv2.resize(stops, (width, height), interpolation=cv2.INTER_LINEAR))
        return np.asarray((light + base) * np.exp2(weight * stops) - other, np.float32)

    def turned(self, orientation: int) -> GainMap:
        """Return the map turned upright from an EXIF orientation, like its picture.

        The JPEG is encoded again only if the map has to be turned.
        """
        if orientation == 1:
            return self
        levels = np.ascontiguousarray(upright(self.levels, orientation))
        return replace(self, jpeg=packed(levels, self))


def packed(levels: NDArray[np.uint8], meaning: GainMap, quality: int = 95) -> bytes:
    """Return levels (h, w, 1 or 3) as the JPEG of a map, with the metadata of ``meaning``."""
    from PIL import Image

    out = io.BytesIO()
    picture = levels[..., 0] if levels.shape[2] == 1 else levels
    Image.fromarray(picture).save(out, "JPEG", quality=quality, subsampling=0)
    data = out.getvalue()
    many = levels.shape[2] == 3
    return b"".join(
        [
            data[:2],
            segment(0xE1, XMP_NAME + xmp.gain_map_packet(_to_xmp(meaning, many))),
            segment(0xE2, ISO_NAME + _to_iso(meaning, many)),
            data[2:],
        ]
    )


def segment(marker: int, body: bytes) -> bytes:
    """Return a JPEG segment with its marker and length."""
    return struct.pack(">BBH", 0xFF, marker, len(body) + 2) + body


def segments(data: bytes) -> Iterator[tuple[int, int, bytes]]:
    """Yield the segments of a JPEG before its scan: marker, offset, body."""
    at = 2
    while at + 4 <= len(data) and data[at] == 0xFF and data[at + 1] != 0xDA:
        length = int.from_bytes(data[at + 2 : at + 4], "big")
        yield data[at + 1], at, data[at + 4 : at + 2 + length]
        at += 2 + length


def find(data: bytes) -> GainMap | None:
    """Return the gain map after the JPEG ``data``; None without one, and for other files.

    An invalid map is ignored, since the picture can be shown without it.
    """
    for part in pictures_behind(data):
        # Untrusted bytes may fail anywhere in a parser.
        with contextlib.suppress(Exception):
            if (found := _read(part)) is not None:
                return found
    return None


def pictures_behind(data: bytes) -> list[bytes]:
    """Return the further JPEGs in a JPEG's multi-picture index; empty for other files."""
    found = []
    for marker, at, body in segments(data) if data[:2] == b"\xff\xd8" else ():
        if marker != 0xE2 or not body.startswith(_MP_NAME):
            continue
        index, start = body[4:], at + 8
        entries = tiff_tags(index).get(_MP_ENTRIES)
        if not isinstance(entries, bytes):
            continue
        order = "<" if index[:2] == b"II" else ">"
        for entry in range(_MP_ENTRY, len(entries) - _MP_ENTRY + 1, _MP_ENTRY):
            _, size, place = struct.unpack_from(f"{order}III", entries, entry)
            found.append(data[start + place : start + place + size])
    return [part for part in found if part[:2] == b"\xff\xd8"]


def _read(jpeg: bytes) -> GainMap | None:
    """Return the gain map that a JPEG's segments describe; None if they describe no map."""
    packet: bytes | None = None
    for marker, _, body in segments(jpeg):
        if marker == 0xE2 and body.startswith(ISO_NAME):
            return _valid_or_none(_from_iso(jpeg, body[len(ISO_NAME) :]))
        if marker == 0xE1 and body.startswith(XMP_NAME):
            packet = body[len(XMP_NAME) :]
    values = xmp.gain_map_values(packet)
    return None if values is None else _valid_or_none(_from_xmp(jpeg, values))


def _valid_or_none(found: GainMap) -> GainMap | None:
    numbers = [*found.low, *found.high, *found.gamma, *found.base_offset, *found.other_offset]
    bounded = all(np.isfinite(numbers)) and max(map(abs, numbers)) < 64 and min(found.gamma) > 0
    # A map that darkens a brighter picture is not supported.
    if not bounded or not found.least_headroom <= found.headroom < 64:
        return None
    with quiet():  # Pillow warns about large pictures, and refuses huge ones
        return found if found.levels.size else None


def _to_iso(meaning: GainMap, many: bool) -> bytes:
    """Encode metadata by ISO 21496-1:2025, annex C: versions, flags, fractions of 32 bits each."""
    out = struct.pack(">HHB", 0, 0, _BASE_COLOURS | (_MANY if many else 0))
    out += _fraction(meaning.least_headroom, ">II") + _fraction(meaning.headroom, ">II")
    for channel in range(3 if many else 1):
        for values, kind in (
            (meaning.low, ">iI"),
            (meaning.high, ">iI"),
            (meaning.gamma, ">II"),
            (meaning.base_offset, ">iI"),
            (meaning.other_offset, ">iI"),
        ):
            out += _fraction(values[channel], kind)
    return out


def _fraction(value: float, kind: str) -> bytes:
    near = Fraction(value).limit_denominator(1 << 20)
    return struct.pack(kind, near.numerator, near.denominator)


def _from_iso(jpeg: bytes, body: bytes) -> GainMap:
    oldest, _, flags = struct.unpack_from(">HHB", body)
    if oldest > 0 or flags & _BACKWARD:
        raise ValueError("unsupported kind of map")
    channels = 3 if flags & _MANY else 1
    signed = "iiIii" * channels
    if flags & _COMMON:
        below, *numbers = struct.unpack_from(f">III{signed}", body, 5)
        values = [number / below for number in numbers]
    else:
        pairs = "IIII" + "".join(f"{kind}I" for kind in signed)
        numbers = list(struct.unpack_from(f">{pairs}", body, 5))
        values = [above / below for above, below in zip(numbers[::2], numbers[1::2], strict=True)]
    rows = [values[2 + 5 * c : 7 + 5 * c] for c in range(channels)] * (3 // channels)
    low, high, gamma, base, other = (_triple(numbers) for numbers in zip(*rows, strict=True))
    return GainMap(jpeg, low, high, gamma, base, other, values[0], values[1])


def _triple(values: Any) -> Triple:
    one, two, three = (float(value) for value in values)
    return one, two, three


_XMP_FIELDS = {
    "GainMapMin": "low",
    "GainMapMax": "high",
    "Gamma": "gamma",
    "OffsetSDR": "base_offset",
    "OffsetHDR": "other_offset",
}


def _to_xmp(meaning: GainMap, many: bool) -> dict[str, list[float]]:
    values = {name: list(getattr(meaning, field)) for name, field in _XMP_FIELDS.items()}
    values = {name: numbers if many else numbers[:1] for name, numbers in values.items()}
    return {
        **values,
        "HDRCapacityMin": [meaning.least_headroom],
        "HDRCapacityMax": [meaning.headroom],
    }


def _from_xmp(jpeg: bytes, values: dict[str, list[float]]) -> GainMap:
    found = GainMap(jpeg)
    for name, field in _XMP_FIELDS.items():
        if name in values:
            numbers = values[name]
            change: dict[str, Any] = {field: _triple(numbers * (3 // len(numbers)))}
            found = replace(found, **change)
    return replace(
        found,
        least_headroom=values.get("HDRCapacityMin", [0.0])[0],
        headroom=values.get("HDRCapacityMax", [max(found.high)])[0],
    )
