"""HEIC files with auxiliary pictures, which pillow-heif does not write: they are marked afterwards.

ISO/IEC 23008-12 (HEIF) and 14496-12: an auxiliary picture is an item with a property ``auxC`` that
names its kind, and a reference ``auxl`` to the picture that it belongs to.
"""

import io
import struct

import numpy as np

DEPTH = "urn:mpeg:hevc:2015:auxid:2"
APPLE_GAIN_MAP = "urn:com:apple:photo:2020:aux:hdrgainmap"


def heic(codes, auxiliary=(), **info):
    """Return a HEIC of ``codes``; ``auxiliary`` are pairs of a kind and (h, w) uint8 levels."""
    import pillow_heif

    file = pillow_heif.HeifFile()
    for picture in (codes, *(levels for _, levels in auxiliary)):
        height, width = picture.shape[:2]
        mode = "RGB" if picture.ndim == 3 else "L"
        if picture.dtype == np.uint16:
            mode += ";16"
        file.add_frombytes(mode, (width, height), np.ascontiguousarray(picture).tobytes())
    out = io.BytesIO()
    file.save(out, quality=-1, chroma=444, matrix_coefficients=0, primary_index=0, **info)
    data = out.getvalue()
    return mark_auxiliary(data, [kind for kind, _ in auxiliary]) if auxiliary else data


def mark_auxiliary(data, kinds):
    """Return a HEIC whose pictures after the first are auxiliary ones of ``kinds`` to it."""
    top = list(boxes(data, 0, len(data)))
    start, end = next((a, b) for name, a, b in top if name == b"meta")
    parts = {n: data[a + 8 : b] for n, a, b in boxes(data, start + 12, end)}
    order = [n for n, _, _ in boxes(data, start + 12, end)]
    pictures = [item for item, kind in items(parts[b"iinf"]) if kind == b"hvc1"]
    properties = {n: parts[b"iprp"][a + 8 : b] for n, a, b in boxes(parts[b"iprp"], 0, None)}
    count = len(list(boxes(properties[b"ipco"], 0, None)))
    entries = associations(properties[b"ipma"])
    references = parts.get(b"iref", bytes(4))
    for number, (item, kind) in enumerate(zip(pictures[1:], kinds, strict=True)):
        properties[b"ipco"] += box(b"auxC", bytes(4) + kind.encode() + b"\0")
        entries[item].append(0x80 | (count + 1 + number))
        references += box(b"auxl", struct.pack(">HHH", item, 1, pictures[0]))
    properties[b"ipma"] = struct.pack(">II", 0, len(entries)) + b"".join(
        struct.pack(">HB", item, len(numbers)) + bytes(numbers) for item, numbers in entries.items()
    )
    parts[b"iprp"] = b"".join(box(name, properties[name]) for name in (b"ipco", b"ipma"))
    parts[b"iref"] = references
    order += [b"iref"] if b"iref" not in order else []

    def meta():
        return box(
            b"meta", data[start + 8 : start + 12] + b"".join(box(n, parts[n]) for n in order)
        )

    grown = len(meta()) - (end - start)
    parts[b"iloc"] = moved(parts[b"iloc"], grown)
    return data[:start] + meta() + data[end:]


def box(name, body):
    return struct.pack(">I4s", len(body) + 8, name) + body


def boxes(data, at, end):
    """Yield name, beginning and end of the boxes of a file or box."""
    end = len(data) if end is None else end
    while at < end:
        size, name = struct.unpack_from(">I4s", data, at)
        yield name, at, at + size
        at += size


def items(iinf):
    """Yield number and kind of each item."""
    wide = iinf[0] > 0
    for _, a, _ in boxes(iinf, 8 if wide else 6, None):
        assert iinf[a + 8] == 2  # version of the entry
        yield struct.unpack_from(">H", iinf, a + 12)[0], iinf[a + 16 : a + 20]


def associations(ipma):
    """Return the properties of each item, with the bit that says that they are essential."""
    assert ipma[:4] == bytes(4)  # numbers of one byte, items of two
    found, at = {}, 8
    for _ in range(struct.unpack_from(">I", ipma, 4)[0]):
        item, count = struct.unpack_from(">HB", ipma, at)
        found[item] = list(ipma[at + 3 : at + 3 + count])
        at += 3 + count
    return found


def moved(iloc, grown):
    """Return the places of the items, ``grown`` bytes later."""
    version, sizes, base = iloc[0], iloc[4], iloc[5] >> 4
    place, length, index = sizes >> 4, sizes & 15, iloc[5] & 15 if iloc[0] else 0
    assert index == 0
    out = bytearray(iloc)
    count, at = struct.unpack_from(">H", iloc, 6)[0], 8
    for _ in range(count):
        at += 2
        inside = version and struct.unpack_from(">H", iloc, at)[0] & 15
        at += 2 if version else 0
        at += 2 + base  # data reference, and where the extents count from: 0
        extents = struct.unpack_from(">H", iloc, at)[0]
        at += 2
        for _ in range(extents):
            if not inside:
                value = int.from_bytes(iloc[at : at + place], "big") + grown
                out[at : at + place] = value.to_bytes(place, "big")
            at += place + length
    return bytes(out)
