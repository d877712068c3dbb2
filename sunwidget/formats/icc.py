"""Read matrix/TRC color profiles (ICC.1:2022) into float curves and one matrix.

Only the tags of display and camera RGB profiles are read, with every offset checked: a profile
is untrusted input. LittleCMS handles profiles that are built on look-up tables.
"""

from __future__ import annotations

import struct

import numpy as np
from numpy.typing import NDArray

from sunwidget.formats.color import (
    REC709_TO_D50,
    SRGB_CURVE,
    ColorProfile,
    Curve,
    ParametricCurve,
    TableCurve,
)

# A profile nearer to sRGB than this counts as sRGB: a little over half an 8-bit level. A browser
# can then use its code values as they are.
_SAME_CURVE = 0.003
_SAME_MATRIX = 0.004

_BRADFORD = np.array(
    [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
)


class ProfileError(ValueError):
    """A color profile that is damaged or not of the matrix/TRC kind."""


def color_space(icc: bytes) -> str:
    """Return the profile's data color space, such as "RGB", "GRAY" or "CMYK"."""
    if len(icc) < 132 or icc[36:40] != b"acsp":
        raise ProfileError("it has no ICC header")
    return icc[16:20].decode("latin-1").strip()


def read_profile(icc: bytes) -> ColorProfile:
    """Read a matrix/TRC RGB profile, or a gray one, whose curve applies to all channels.

    Raises
    ------
    ProfileError
        When the profile is damaged, or is built on look-up tables.
    """
    space = color_space(icc)
    tags = _tags(icc)
    if space == "GRAY" and b"kTRC" in tags:
        curve = _snapped(_curve(tags[b"kTRC"]))
        return ColorProfile((curve, curve, curve), None, "grey")
    wanted = (b"rXYZ", b"gXYZ", b"bXYZ", b"rTRC", b"gTRC", b"bTRC")
    if space != "RGB" or not all(tag in tags for tag in wanted):
        raise ProfileError(f"it is a {space} profile without matrix and tone curves")
    columns = np.column_stack([_xyz(tags[tag]) for tag in wanted[:3]])
    curves = [_snapped(_curve(tags[tag])) for tag in wanted[3:]]
    matrix = _to_rec709(columns)
    if np.abs(matrix - np.eye(3)).max() < _SAME_MATRIX:
        return ColorProfile((curves[0], curves[1], curves[2]), None, _name(tags))
    return ColorProfile((curves[0], curves[1], curves[2]), matrix, _name(tags))


def _tags(icc: bytes) -> dict[bytes, bytes]:
    (count,) = struct.unpack_from(">I", icc, 128)
    if count > 200 or 132 + 12 * count > len(icc):
        raise ProfileError("its tag table runs past its end")
    tags = {}
    for index in range(count):
        name, offset, size = struct.unpack_from(">4sII", icc, 132 + 12 * index)
        if offset + size <= len(icc):
            tags[name] = icc[offset : offset + size]
    return tags


def _xyz(tag: bytes) -> NDArray[np.float64]:
    if len(tag) < 20 or tag[:4] != b"XYZ ":
        raise ProfileError("a primary is not an XYZ value")
    return np.array(struct.unpack_from(">3i", tag, 8)) / 65536.0


def _curve(tag: bytes) -> Curve:
    if len(tag) < 12:
        raise ProfileError("a tone curve is cut short")
    if tag[:4] == b"para":
        return _parametric(tag)
    if tag[:4] != b"curv":
        raise ProfileError("a tone curve is of an unknown type")
    (count,) = struct.unpack_from(">I", tag, 8)
    if 12 + 2 * count > len(tag):
        raise ProfileError("a tone curve is cut short")
    if count == 0:
        return ParametricCurve(1.0)
    values = np.frombuffer(tag, ">u2", count, 12).astype(np.float64)
    if count == 1:
        return _checked(ParametricCurve(values[0] / 256.0))
    # A table that dips has no inverse; its running maximum has.
    samples = np.maximum.accumulate(values / 65535.0)
    if samples[-1] - samples[0] < 0.5:
        raise ProfileError("a tone curve is flat")
    return TableCurve(samples)


def _parametric(tag: bytes) -> ParametricCurve:
    (kind,) = struct.unpack_from(">H", tag, 8)
    if kind > 4:
        raise ProfileError("a tone curve is of an unknown type")
    count = (1, 3, 4, 5, 7)[kind]
    if len(tag) < 12 + 4 * count:
        raise ProfileError("a tone curve is cut short")
    p = [value / 65536.0 for value in struct.unpack_from(f">{count}i", tag, 12)]
    if kind == 0:
        return _checked(ParametricCurve(p[0]))
    g, a, b = p[:3]
    if a <= 0:
        raise ProfileError("a tone curve falls")
    if kind == 1:
        return _checked(ParametricCurve(g, a, b, 0.0, -b / a))
    if kind == 2:
        return _checked(ParametricCurve(g, a, b, 0.0, -b / a, p[3], p[3]))
    if kind == 3:
        return _checked(ParametricCurve(g, a, b, p[3], p[4]))
    return _checked(ParametricCurve(g, a, b, p[3], p[4], p[5], p[6]))


def _checked(curve: ParametricCurve) -> ParametricCurve:
    if not 0.1 <= curve.g <= 10:
        raise ProfileError(f"a tone curve has the exponent {curve.g:g}")
    light = curve.decode(np.linspace(0.0, 1.0, 65))
    if (np.diff(light) < -1e-4).any() or light[-1] - light[0] < 0.5:
        raise ProfileError("a tone curve falls or is flat")
    return curve


def _snapped(curve: Curve) -> Curve:
    code = np.linspace(0.0, 1.0, 256)
    seen = SRGB_CURVE.encode(np.clip(curve.decode(code), 0, 1))
    return SRGB_CURVE if np.abs(seen - code).max() < _SAME_CURVE else curve


def _to_rec709(columns: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the matrix from linear RGB to linear Rec. 709; white maps to white exactly."""
    white = columns.sum(axis=1)
    # Real color spaces have condition numbers of 5 to 20; near-parallel primaries amplify noise.
    if np.linalg.cond(columns) > 500 or (white <= 0.1).any() or (white > 2).any():
        raise ProfileError("its primaries do not span a color space")
    # Some old profiles store primaries that were not adapted to D50.
    have, want = _BRADFORD @ white, _BRADFORD @ REC709_TO_D50.sum(axis=1)
    adapt = np.linalg.inv(_BRADFORD) @ np.diag(want / have) @ _BRADFORD
    return np.linalg.inv(REC709_TO_D50) @ adapt @ columns


def _name(tags: dict[bytes, bytes]) -> str:
    tag = tags.get(b"desc", b"")
    if tag[:4] == b"mluc" and len(tag) >= 28:
        size, offset = struct.unpack_from(">II", tag, 20)
        text = tag[offset : offset + size].decode("utf-16-be", "replace")
    elif tag[:4] == b"desc" and len(tag) > 12:
        (size,) = struct.unpack_from(">I", tag, 8)
        text = tag[12 : 12 + size].decode("latin-1")
    else:
        text = ""
    text = "".join(letter for letter in text if letter.isprintable()).strip()
    return text[:80] or "RGB profile"
