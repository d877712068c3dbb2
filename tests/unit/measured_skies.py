"""Made-up skies in the files that Kider et al. publish: archives of spectra, 81 directions each."""

import lzma
import struct
import zlib

import numpy as np

# Elevations and numbers of azimuths of the instrument's rings.
RINGS = ((12.1151, 32), (33.749, 24), (53.3665, 16), (71.9187, 8), (90.0, 1))


def directions():
    """Index, azimuth counter-clockwise from north, elevation."""
    rows = [(360 * i / n, e) for e, n in RINGS for i in range(n)]
    return np.array([(i, a, e) for i, (a, e) in enumerate(rows)])


def sky(sun_azimuth, sun_elevation=40.0, seed=0):
    """Radiance (81, 651) of a sky that is symmetric about the sun, a little noisy."""
    _, azimuth, elevation = directions().T
    a, e, s = np.radians([-azimuth - sun_azimuth, elevation, np.full(81, sun_elevation)])
    nu = np.sin(e) * np.sin(s) + np.cos(e) * np.cos(s) * np.cos(a)
    shape = (1 + nu**2 + np.exp(4 * (nu - 1))) / np.sin(e)
    noise = 1 + 0.01 * np.random.default_rng(seed).standard_normal(81)
    return (shape * noise)[:, None] * 0.05 * (np.arange(350, 1001) / 450) ** -3.0


def number(value):
    """A 7z integer; up to 2³² is enough here."""
    return b"\xf0" + struct.pack("<I", value)


def archive(files, *, packed_header=True):
    """A 7z archive: one block of LZMA, the header packed too, as the published ones are."""
    filters = [{"id": lzma.FILTER_LZMA1, "dict_size": 1 << 20, "lc": 3, "lp": 0, "pb": 2}]
    properties = bytes([(2 * 5 + 0) * 9 + 3]) + struct.pack("<I", 1 << 20)

    def pack(data):
        return lzma.compress(data, lzma.FORMAT_RAW, filters=filters)

    def streams(offset, packed, unpacked, tail):
        return (
            b"\x06" + number(offset) + b"\x01\x09" + number(packed) + b"\x00"
            b"\x07\x0b\x01\x00\x01\x23\x03\x01\x01\x05" + properties + b"\x0c" + number(unpacked)
            + tail
        )  # fmt: skip

    whole = b"".join(files.values())
    body = pack(whole)
    sizes = b"".join(number(len(data)) for data in list(files.values())[:-1])
    sums = b"".join(struct.pack("<I", zlib.crc32(data)) for data in files.values())
    lists = (
        b"\x00\x08\x0d" + number(len(files)) + b"\x09" + sizes + b"\x0a\x01" + sums + b"\x00\x00"
    )
    # A folder without content, as the published archives have one.
    names = "".join(f"{name}\0" for name in [*files, "folder"]).encode("utf-16-le")
    count = len(files) + 1
    empty = np.packbits([0] * len(files) + [1]).tobytes()
    header = (
        b"\x01\x04" + streams(0, len(body), len(whole), lists)
        + b"\x05" + number(count)
        + b"\x0e" + number(len(empty)) + empty
        + b"\x11" + number(len(names) + 1) + b"\x00" + names + b"\x00\x00"
    )  # fmt: skip
    if packed_header:
        small = pack(header)
        tail = b"\x0a\x01" + struct.pack("<I", zlib.crc32(header)) + b"\x00\x00"
        header = b"\x17" + streams(len(body), len(small), len(header), tail)
        body += small
    start = struct.pack("<QQI", len(body), len(header), zlib.crc32(header))
    return (
        b"7z\xbc\xaf\x27\x1c\x00\x04" + struct.pack("<I", zlib.crc32(start)) + start + body + header
    )


def scan_files(name, radiance):
    """The text files of one scan, with raw counts beside each as some archives have them."""
    files = {}
    for (index, azimuth, elevation), spectrum in zip(directions(), radiance, strict=True):
        stem = f"{name}/{name}_-_{index:.0f}____{azimuth}___{elevation}.asd"
        lines = [
            f"{nm}\t {value:.9E} " for nm, value in zip(range(350, 1001), spectrum, strict=True)
        ]
        files[f"{stem}.rad.txt"] = "\n".join(["Wavelength\tname", *lines, "1001\t 0.1 "]).encode()
        files[f"{stem}.txt"] = b"counts"
    return files
