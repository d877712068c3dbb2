"""Transfer functions and primaries: convert between code values and linear Rec. 709 light.

A :class:`ColorProfile` is three tone curves and one matrix. Its two directions are exact inverses
in float, so an unchanged code value survives the round trip. Matrices use the D50 profile
connection space with the Bradford-adapted Rec. 709 primaries of every sRGB profile (Lindbloom
2017).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]

LUMINANCE = np.array([0.2126, 0.7152, 0.0722], np.float32)
"""Rec. 709 luminance weights of linear R, G, B."""

REC709_TO_D50 = np.array(
    [
        [0.4360747, 0.3850649, 0.1430804],
        [0.2225045, 0.7168786, 0.0606169],
        [0.0139322, 0.0971045, 0.7141733],
    ]
)

REC709_CHROMATICITIES = (0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290)
"""CIE x, y of Rec. 709's red, green, blue and white (D65)."""

# Pixels processed at a time: temporaries of 3 MB stay in the cache.
_STRIP_PIXELS = 1 << 18


def primaries_to_xyz(chromaticities: tuple[float, ...]) -> NDArray[np.float64]:
    """Return the matrix from linear RGB to XYZ at its own white; CIE x, y of R, G, B and white.

    SMPTE RP 177 (1993). Raises ``numpy.linalg.LinAlgError`` for primaries on one line.
    """
    xy = np.reshape(np.asarray(chromaticities, float), (4, 2))
    x, y = xy.T
    xyz = np.stack([x, y, 1 - x - y]) / np.maximum(y, 1e-6)
    return np.asarray(xyz[:, :3] * np.linalg.solve(xyz[:, :3], xyz[:, 3]), float)


REC709_TO_XYZ = primaries_to_xyz(REC709_CHROMATICITIES)
_BRADFORD = np.array(
    [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
)


def primaries_to_rec709(chromaticities: tuple[float, ...]) -> NDArray[Any] | None:
    """Return the matrix from linear RGB of other primaries to Rec. 709; None if they are equal.

    Another white is adapted by Bradford (Lindbloom 2017). Impossible primaries are treated as
    Rec. 709.
    """
    if len(chromaticities) != 8 or np.allclose(chromaticities, REC709_CHROMATICITIES, atol=2e-3):
        return None
    try:
        to_xyz = primaries_to_xyz(chromaticities)
        whites = [_BRADFORD @ matrix.sum(axis=1) for matrix in (REC709_TO_XYZ, to_xyz)]
        adapt = np.linalg.solve(_BRADFORD, np.diag(whites[0] / whites[1]) @ _BRADFORD)
        matrix = np.linalg.solve(REC709_TO_XYZ, adapt @ to_xyz)
    except np.linalg.LinAlgError:
        return None
    return matrix if np.isfinite(matrix).all() and np.abs(matrix).max() < 100 else None


@dataclass(frozen=True)
class ParametricCurve:
    """ICC parametric curve: y = (a·x + b)^g + e for x ≥ d, else c·x + f (ICC.1:2022, 10.18)."""

    g: float
    a: float = 1.0
    b: float = 0.0
    c: float = 0.0
    d: float = 0.0
    e: float = 0.0
    f: float = 0.0

    def decode(self, code: NDArray[Any]) -> NDArray[Any]:
        """Convert code values (0–1) to linear light (0–1), in the input's precision."""
        power = np.maximum(self.a * code + self.b, 0) ** self.g + self.e
        if self.d <= 0:
            return power
        return np.where(code >= self.d, power, self.c * code + self.f)

    def encode(self, light: NDArray[Any]) -> NDArray[Any]:
        """Convert linear light (0–1) to code values (0–1), in the input's precision."""
        power = (np.maximum(light - self.e, 0) ** (1 / self.g) - self.b) / self.a
        if self.d <= 0:
            return power
        toe = (light - self.f) / self.c if self.c > 0 else np.zeros_like(light)
        # Compares with the end of the toe: curves may have a tiny step at d.
        return np.where(light > self.c * self.d + self.f, np.maximum(power, self.d), toe)


@dataclass(frozen=True, eq=False)
class TableCurve:
    """A tone curve as equally spaced samples (ICC 'curv' with a table), interpolated linearly."""

    samples: NDArray[np.float64]

    @cached_property
    def _grid(self) -> NDArray[np.float64]:
        return np.linspace(0.0, 1.0, len(self.samples))

    def decode(self, code: NDArray[Any]) -> NDArray[Any]:
        """Convert code values (0–1) to linear light (0–1)."""
        return np.interp(code, self._grid, self.samples).astype(code.dtype)

    def encode(self, light: NDArray[Any]) -> NDArray[Any]:
        """Convert linear light (0–1) to code values (0–1)."""
        return np.interp(light, self.samples, self._grid).astype(light.dtype)


Curve = ParametricCurve | TableCurve

SRGB_CURVE = ParametricCurve(2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045)
"""IEC 61966-2-1: a shoulder of 1.055·y^(1/2.4) − 0.055 above a toe of 12.92·y."""


def srgb_to_linear(code: NDArray[Any]) -> Floats:
    """Decode sRGB values (any shape, 0–1) to linear light, float32. Not clamped above 1."""
    return np.asarray(SRGB_CURVE.decode(np.asarray(code, np.float32)), np.float32)


def linear_to_srgb(light: NDArray[Any]) -> Floats:
    """Encode linear light (any shape) as sRGB values, float32. Clamped to 0–1."""
    clamped = np.clip(np.asarray(light, np.float32), 0, 1)
    return np.asarray(SRGB_CURVE.encode(clamped), np.float32)


@dataclass(frozen=True, eq=False)
class ColorProfile:
    """A matrix/TRC color space: three tone curves and a matrix to linear Rec. 709.

    Parameters
    ----------
    curves : tuple of three curves
        Tone curves of R, G, B, from code values (0–1) to linear light.
    matrix : (3, 3) float64 array or None
        From linear RGB of the space to linear Rec. 709; None if they are the same.
    name : str
        The profile's own name.
    """

    curves: tuple[Curve, Curve, Curve]
    matrix: NDArray[np.float64] | None = None
    name: str = "sRGB"

    @property
    def is_srgb(self) -> bool:
        """True if code values are sRGB without conversion."""
        return self.matrix is None and all(curve == SRGB_CURVE for curve in self.curves)

    def decode(self, codes: NDArray[Any]) -> Floats:
        """Convert code values (H, W, 3), uint8 or uint16, to linear Rec. 709 float32.

        Colors outside Rec. 709 have values below 0 or above 1, which are kept.
        """
        light = np.empty(codes.shape, np.float32)
        tables = self._tables(codes.dtype)
        for rows in strips(codes.shape):
            light[rows] = self._mixed(_look_up(codes[rows], tables))
        return light

    def to_light(self, values: NDArray[Any]) -> Floats:
        """Convert float code values (H, W, 3), 0–1 and beyond, to linear Rec. 709 float32."""
        light = np.empty(values.shape, np.float32)
        for channel, curve in enumerate(self.curves):
            light[..., channel] = curve.decode(values[..., channel])
        return self._mixed(light)

    def linear(self, light: NDArray[Any]) -> Floats:
        """Convert linear Rec. 709 (H, W, 3) to linear RGB of this space, unclamped."""
        if self.matrix is None:
            return np.asarray(light, np.float32)
        return np.asarray(light, np.float32) @ np.linalg.inv(self.matrix).astype(np.float32).T

    def encode(
        self, light: NDArray[Any], dtype: Any = np.uint8, *, dither: bool = False, seed: int = 0
    ) -> NDArray[Any]:
        """Convert linear Rec. 709 (H, W, 3) to rounded code values, uint8 or uint16.

        Colors outside the profile's gamut are clamped per channel. ``dither`` adds triangular
        noise of half a level, the same on every call with the same ``seed``; a value on a level
        stays on it.
        """
        codes = np.empty(light.shape, dtype)
        top = np.float32(np.iinfo(codes.dtype).max)
        rng = np.random.default_rng(seed)
        for rows in strips(light.shape):
            level = self._levels(np.clip(self.linear(light[rows]), 0, 1)) * top
            if dither:
                level += (rng.random(level.shape, np.float32) - np.float32(0.5)) / 2
                level += (rng.random(level.shape, np.float32) - np.float32(0.5)) / 2
            codes[rows] = np.rint(np.clip(level, 0, top, out=level), out=level)
        return codes

    def _tables(self, dtype: Any) -> list[Floats]:
        code = np.linspace(0.0, 1.0, np.iinfo(dtype).max + 1)
        return [curve.decode(code).astype(np.float32) for curve in self.curves]

    def _mixed(self, light: Floats) -> Floats:
        return light if self.matrix is None else light @ self.matrix.T.astype(np.float32)

    def _levels(self, light: Floats) -> Floats:
        first, *others = self.curves
        if all(curve == first for curve in others):
            return first.encode(light)
        return np.stack([c.encode(light[..., i]) for i, c in enumerate(self.curves)], axis=-1)


def _look_up(codes: NDArray[Any], tables: list[Floats]) -> Floats:
    if codes.dtype == np.uint8:
        import cv2

        # Four times as fast as NumPy indexing.
        return np.asarray(cv2.LUT(codes, np.stack(tables, axis=-1)[:, None]), np.float32)
    return np.stack([table[codes[..., i]] for i, table in enumerate(tables)], axis=-1)


SRGB = ColorProfile((SRGB_CURVE,) * 3)

# Adobe RGB (1998): the same D65 white, another green; matrix by its primaries, section 4.3.
ADOBE_RGB = ColorProfile(
    (ParametricCurve(2.19921875),) * 3,
    np.array(
        [
            [1.3983557, -0.3983557, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, -0.0429289, 1.0429289],
        ]
    ),
    "Adobe RGB",
)


def strips(shape: tuple[int, ...], pixels: int = _STRIP_PIXELS) -> list[slice]:
    """Return row ranges of a picture of ``shape``, about ``pixels`` pixels each."""
    height, width = shape[:2]
    step = max(1, pixels // max(width, 1))
    return [slice(top, min(top + step, height)) for top in range(0, height, step)]
