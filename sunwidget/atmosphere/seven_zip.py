"""Read a 7z archive of the plainest kind: one block of files, compressed by LZMA.

The measured skies are published so. The container is described in 7zFormat.txt of the LZMA SDK
(public domain); Python's ``lzma`` knows the compression but not the container. Anything else, and
anything damaged, is refused.
"""

from __future__ import annotations

import lzma
import struct
import zlib
from typing import NamedTuple

_SIGNATURE = b"7z\xbc\xaf\x27\x1c"
_LZMA = b"\x03\x01\x01"
_LARGEST = 1 << 30  # unpacked bytes; the published archives hold 5-10 MB

# Property ids of the header.
_END, _HEADER, _MAIN_STREAMS, _FILES = 0, 1, 4, 5
_PACK_INFO, _UNPACK_INFO, _SUBSTREAMS, _SIZE, _CRC, _FOLDER = 6, 7, 8, 9, 10, 11
_UNPACK_SIZE, _SUBSTREAM_COUNT, _EMPTY_STREAM, _NAMES, _ENCODED = 12, 13, 14, 17, 23


class ArchiveError(ValueError):
    """A file that is no 7z archive of the kind that is read here, or a damaged one."""


class _Streams(NamedTuple):
    offset: int
    packed: int
    properties: bytes
    unpacked: int
    crc: int | None
    sizes: list[int]
    crcs: list[int]


class _Reader:
    def __init__(self, data: bytes) -> None:
        self.data = data
        self.at = 0

    def take(self, count: int) -> bytes:
        if count < 0 or self.at + count > len(self.data):
            raise ArchiveError("The archive's header ends too early.")
        self.at += count
        return self.data[self.at - count : self.at]

    def byte(self) -> int:
        return self.take(1)[0]

    def number(self) -> int:
        """Return an integer whose first byte's leading ones count the bytes that follow."""
        first, value = self.byte(), 0
        for i in range(8):
            mask = 0x80 >> i
            if not first & mask:
                return value | (first & (mask - 1)) << (8 * i)
            value |= self.byte() << (8 * i)
        return value

    def expect(self, wanted: int, what: str) -> None:
        found = self.number()
        if found != wanted:
            raise ArchiveError(f"The archive's {what} is of a kind that is not read (id {found}).")

    def bits(self, count: int) -> list[bool]:
        packed = self.take((count + 7) // 8)
        return [bool(packed[i // 8] & (0x80 >> i % 8)) for i in range(count)]

    def checksums(self, count: int) -> list[int]:
        if not self.byte():
            raise ArchiveError("The archive lacks checksums.")
        return list(struct.unpack(f"<{count}I", self.take(4 * count)))


def read_archive(data: bytes) -> dict[str, bytes]:
    """Return the files of a 7z archive by path.

    Parameters
    ----------
    data : bytes
        The whole archive.

    Raises
    ------
    ArchiveError
        For anything but one block of LZMA, or when a checksum is wrong.
    """
    if data[:6] != _SIGNATURE or len(data) < 32:
        raise ArchiveError("This is no 7z archive.")
    if struct.unpack("<I", data[8:12])[0] != zlib.crc32(data[12:32]):
        raise ArchiveError("The archive's first bytes are damaged.")
    offset, size, crc = struct.unpack("<QQI", data[12:32])
    header = data[32 + offset : 32 + offset + size]
    if len(header) != size or zlib.crc32(header) != crc:
        raise ArchiveError("The archive is damaged or not complete.")
    reader = _Reader(header)
    kind = reader.number()
    if kind == _ENCODED:
        reader = _Reader(_unpack(data, _streams(reader)))
        kind = reader.number()
    if kind != _HEADER:
        raise ArchiveError(f"The archive's header is of a kind that is not read (id {kind}).")
    reader.expect(_MAIN_STREAMS, "list of streams")
    streams = _streams(reader)
    reader.expect(_FILES, "list of files")
    names = _names(reader)
    whole = _unpack(data, streams)
    if len(names) != len(streams.sizes) or sum(streams.sizes) != len(whole):
        raise ArchiveError("The archive's lists of files and of sizes disagree.")
    files, start = {}, 0
    for name, length, checksum in zip(names, streams.sizes, streams.crcs, strict=True):
        files[name] = whole[start : start + length]
        if zlib.crc32(files[name]) != checksum:
            raise ArchiveError(f"{name!r:.120} in the archive is damaged.")
        start += length
    return files


def _streams(reader: _Reader) -> _Streams:
    """Read the description of one packed block and of the files in it."""
    reader.expect(_PACK_INFO, "list of packed streams")
    offset, count = reader.number(), reader.number()
    if count != 1:
        raise ArchiveError(f"The archive has {count} packed streams, one is read.")
    reader.expect(_SIZE, "packed size")
    packed = reader.number()
    reader.expect(_END, "list of packed streams")
    reader.expect(_UNPACK_INFO, "list of coders")
    reader.expect(_FOLDER, "list of coders")
    if reader.number() != 1 or reader.byte() or reader.number() != 1:
        raise ArchiveError("The archive has more than one block or coder.")
    flags = reader.byte()
    if flags & 0xF0 != 0x20 or reader.take(flags & 0x0F) != _LZMA:
        raise ArchiveError("The archive is not compressed by LZMA alone.")
    properties = reader.take(reader.number())
    reader.expect(_UNPACK_SIZE, "unpacked size")
    unpacked = reader.number()
    crc, sizes, crcs = None, [unpacked], []
    while (what := reader.number()) != _END:
        if what != _CRC:
            raise ArchiveError(f"The archive's block has a property that is not read (id {what}).")
        crc = reader.checksums(1)[0]
        crcs = [crc]
    while (what := reader.number()) != _END:
        if what != _SUBSTREAMS:
            raise ArchiveError(f"The archive has a list that is not read (id {what}).")
        files = 1
        while (part := reader.number()) != _END:
            if part == _SUBSTREAM_COUNT:
                files = reader.number()
                if not 0 < files <= len(reader.data):
                    raise ArchiveError(f"The archive claims {files} files.")
            elif part == _SIZE:
                sizes = [reader.number() for _ in range(files - 1)]
                sizes.append(unpacked - sum(sizes))
            elif part == _CRC:
                crcs = reader.checksums(files)
            else:
                raise ArchiveError(f"The archive has a property that is not read (id {part}).")
    return _Streams(offset, packed, properties, unpacked, crc, sizes, crcs)


def _names(reader: _Reader) -> list[str]:
    """Return the paths of all members that have content."""
    count = reader.number()
    names: list[str] = []
    empty: list[bool] = []
    while (what := reader.number()) != _END:
        part = _Reader(reader.take(reader.number()))
        if what == _EMPTY_STREAM:
            empty = part.bits(count)
        elif what == _NAMES:
            if part.byte():
                raise ArchiveError("The archive keeps its names elsewhere.")
            names = part.data[1:].decode("utf-16-le").split("\0")[:-1]
    if len(names) != count:
        raise ArchiveError("The archive does not name all its files.")
    return [name for i, name in enumerate(names) if not (empty and empty[i])]


def _unpack(data: bytes, streams: _Streams) -> bytes:
    """Return the block's bytes, its checksum compared."""
    if len(streams.properties) != 5 or not 0 <= streams.unpacked <= _LARGEST:
        raise ArchiveError("The archive's block is larger, or described otherwise, than is read.")
    first, dictionary = streams.properties[0], int.from_bytes(streams.properties[1:], "little")
    lc_lp, pb = first % 45, first // 45
    options = {"id": lzma.FILTER_LZMA1, "dict_size": max(dictionary, 4096)}
    options |= {"lc": lc_lp % 9, "lp": lc_lp // 9, "pb": pb}
    packed = data[32 + streams.offset : 32 + streams.offset + streams.packed]
    try:
        decoder = lzma.LZMADecompressor(lzma.FORMAT_RAW, filters=[options])
        whole = decoder.decompress(packed, streams.unpacked)
    except (lzma.LZMAError, ValueError) as error:
        raise ArchiveError(f"The archive's block cannot be unpacked: {error}") from error
    if len(whole) != streams.unpacked:
        raise ArchiveError("The archive's block ends too early.")
    if streams.crc is not None and zlib.crc32(whole) != streams.crc:
        raise ArchiveError("The archive's block is damaged.")
    return whole
