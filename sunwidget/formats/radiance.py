"""Radiance HDR files (.hdr, RGBE): linear light with 8 bits per channel and a common exponent.

Ward, "Real Pixels", Graphics Gems II (1991). OpenCV packs the pixels; this module writes the
header. A mantissa m with exponent e means m · 2^(e − 136), as in most programs.
"""

from __future__ import annotations

import re
import tempfile
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.errors import PhotoError
from sunwidget.formats.color import (
    REC709_CHROMATICITIES,
    REC709_TO_XYZ,
    primaries_to_rec709,
    strips,
)
from sunwidget.formats.deep import decode_with_opencv
from sunwidget.formats.pixels import check_size

MAGIC = (b"#?RADIANCE", b"#?RGBE")
# Readers with a fixed buffer (128 bytes in OpenCV) split longer lines.
_LINE = 100
_RESOLUTION = re.compile(rb"-Y (\d{1,9}) \+X (\d{1,9})\n")


@dataclass
class Hdr:
    """Contents: (H, W, 3) float32 linear Rec. 709, and the notes of the header."""

    light: NDArray[np.float32]
    notes: dict[str, str]


def pack(
    light: NDArray[np.float32], notes: dict[str, str], *, software: str = "sunwidget"
) -> bytes:
    """Return ``light``, (H, W, 3) linear Rec. 709, as a file; negative light becomes 0.

    ``notes`` are ASCII texts without line breaks, written as comments under their names.
    """
    import cv2

    levels = np.empty(light.shape, np.float32)
    for rows in strips(light.shape):
        levels[rows] = _on_levels(light[rows])[..., ::-1]
    done, packed = cv2.imencode(".hdr", levels)
    if not done:
        raise PhotoError(
            "OpenCV could not encode the picture as Radiance HDR. It needs free space in "
            f"{tempfile.gettempdir()}."
        )
    data = packed.tobytes()
    primaries = " ".join(f"{value:g}" for value in REC709_CHROMATICITIES)
    lines = ["#?RADIANCE", f"SOFTWARE={software}", f"PRIMARIES={primaries}"]
    for name, text in notes.items():
        starts = range(0, len(text), _LINE - len(name))
        lines += [f"# {name}: {text[i : i + _LINE - len(name)]}" for i in starts]
    lines += ["FORMAT=32-bit_rle_rgbe", "", ""]
    return "\n".join(lines).encode("ascii") + data[data.index(b"\n\n") + 2 :]


def _on_levels(light: NDArray[np.float32]) -> NDArray[np.float32]:
    """Round to the levels of RGBE and add a quarter level, since OpenCV truncates."""
    light = np.clip(light, 0, 1e30, dtype=np.float32)
    largest = light.max(axis=-1)
    _, exponent = np.frexp(largest)
    carries = np.rint(np.ldexp(largest, 8 - exponent)) > 255
    step = np.ldexp(np.float32(1), exponent + carries - 8)[..., None]
    return np.where(light > 1e-30, (np.rint(light / step) + np.float32(0.25)) * step, 0)


def read(data: bytes, name: str) -> Hdr:
    """Read a file: undo its EXPOSURE and convert its PRIMARIES to Rec. 709.

    Raises
    ------
    PhotoError
        For a damaged file, and for one whose pixels are not stored from the top left.
    """
    end = data.find(b"\n\n")
    size = _RESOLUTION.match(data, end + 2) if end >= 0 else None
    if size is None:
        raise PhotoError(
            f"{name} is a Radiance HDR file that is damaged or not stored from the top left "
            "(-Y … +X …). Save it again in another program."
        )
    height, width = (int(n) for n in size.groups())
    check_size(width, height, name)
    lines = data[:end].decode("latin-1").splitlines()
    plain = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + data[end + 2 :]
    found = decode_with_opencv(plain)
    if found is None or found.shape != (height, width, 3):
        raise PhotoError(f"{name} is a damaged Radiance HDR file. Copy or download it again.")
    light = found / np.float32(_exposure(lines))
    if (matrix := _matrix(lines)) is not None:
        light = light @ matrix.T
    return Hdr(np.asarray(light, np.float32), _notes(lines))


def _exposure(lines: list[str]) -> float:
    product = 1.0
    for line in lines:
        if line.startswith("EXPOSURE="):
            product *= max(_numbers(line)[:1] or [1.0])
    return product if 1e-20 < product < 1e20 else 1.0


def _matrix(lines: list[str]) -> NDArray[Any] | None:
    if any(line.startswith("FORMAT=32-bit_rle_xyze") for line in lines):
        return np.linalg.inv(REC709_TO_XYZ)
    for line in lines:
        if line.startswith("PRIMARIES=") and len(numbers := _numbers(line)) == 8:
            return primaries_to_rec709(tuple(numbers))
    return None


def _numbers(line: str) -> list[float]:
    try:
        return [float(word) for word in line.partition("=")[2].split()]
    except ValueError:
        return []


def _notes(lines: list[str]) -> dict[str, str]:
    notes: dict[str, str] = {}
    for line in lines:
        if found := re.match(r"# ([a-z-]+): (.*)", line):
            notes[found[1]] = notes.get(found[1], "") + found[2]
    return notes
