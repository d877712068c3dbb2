"""Interpret a file's code values as colors, by its profile, its EXIF, or its gamma.

Matrix/TRC profiles are kept, and with them the code values. Everything else is converted to sRGB
once, with a note for the user.
"""

from __future__ import annotations

import io
import struct
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.formats import exif as exif_tags
from sunwidget.formats.color import (
    ADOBE_RGB,
    SRGB,
    SRGB_CURVE,
    ColorProfile,
    ParametricCurve,
    primaries_to_rec709,
)
from sunwidget.formats.icc import ProfileError, color_space, read_profile


@dataclass
class Coded:
    """Code values (H, W, 3) with their profile; ``icc`` is saved again with them."""

    codes: NDArray[Any]
    profile: ColorProfile = SRGB
    icc: bytes | None = None
    notes: list[str] = field(default_factory=list)


def by_profile(codes: NDArray[Any], icc: bytes, name: str) -> Coded:
    """Interpret code values by the embedded profile ``icc``.

    Float values become linear Rec. 709 light. Values in a gray or table profile, which cannot
    describe an edited picture, become sRGB.
    """
    try:
        profile = read_profile(icc)
    except (ProfileError, struct.error):
        return _through_table(codes, icc, name)
    if codes.dtype.kind == "f":
        return Coded(profile.to_light(codes))
    if color_space(icc) == "RGB":
        return Coded(codes, profile, icc)
    if profile.is_srgb:
        return Coded(codes)
    note = f"{name} has a gray tone curve; it was converted to sRGB."
    return Coded(_to_srgb(codes, profile), notes=[note])


def by_hints(codes: NDArray[Any], exif: Any, info: dict[str, Any], name: str) -> Coded:
    """Interpret code values of a file without a profile, by its EXIF or PNG gamma."""
    if codes.dtype.kind == "f":
        return Coded(codes)
    gamma = info.get("gamma")  # PNG's gAMA, which its sRGB chunk overrides
    if exif_tags.is_adobe_rgb(exif):
        note = f"{name} is Adobe RGB according to its EXIF only; it was converted to sRGB."
        return Coded(_to_srgb(codes, ADOBE_RGB), notes=[note])
    if gamma and "srgb" not in info and 0.1 <= gamma <= 10 and abs(gamma - 0.45455) > 0.02:
        note = f"{name} has a gamma of {gamma:.3g}; it was converted to sRGB."
        profile = ColorProfile((ParametricCurve(1 / gamma),) * 3)
        return Coded(_to_srgb(codes, profile), notes=[note])
    return Coded(codes)


def by_primaries(codes: NDArray[Any], chromaticities: tuple[float, ...], name: str) -> Coded:
    """Interpret code values of a HEIC without a profile: sRGB's curve, the file's primaries."""
    matrix = primaries_to_rec709(chromaticities)
    if matrix is None:
        return Coded(codes)
    note = f"{name} has other primaries than sRGB and no profile; it was converted to sRGB."
    return Coded(_to_srgb(codes, ColorProfile((SRGB_CURVE,) * 3, matrix)), notes=[note])


def cmyk_to_srgb(image: Any, icc: bytes | None, name: str) -> tuple[Any, list[str]]:
    """Convert a Pillow image in CMYK to sRGB, by its profile if that is readable."""
    notes = [f"{name} is CMYK; it was converted to sRGB and will be saved as RGB."]
    try:
        if icc and color_space(icc) == "CMYK":
            return _through_littlecms(image, icc), notes
    except ProfileError:
        notes.append(f"The CMYK profile of {name} is damaged; its colors are approximate.")
    return image.convert("RGB"), notes


def _to_srgb(codes: NDArray[Any], profile: ColorProfile) -> NDArray[Any]:
    return SRGB.encode(profile.decode(codes), codes.dtype)


def _through_table(codes: NDArray[Any], icc: bytes, name: str) -> Coded:
    from PIL import Image

    try:
        if color_space(icc) != "RGB" or codes.dtype.kind == "f":
            raise ProfileError("not an RGB profile")
        eight = codes if codes.dtype == np.uint8 else np.rint(codes / 257.0).astype(np.uint8)
        converted = np.asarray(_through_littlecms(Image.fromarray(eight), icc))
    except ProfileError:
        note = f"The color profile of {name} cannot be read; sRGB is assumed."
        return Coded(codes, notes=[note])
    note = (
        f"The color profile of {name} is a look-up table; the picture was converted to "
        "sRGB with 8 bits per channel."
    )
    return Coded(converted, notes=[note])


def _through_littlecms(image: Any, icc: bytes) -> Any:
    from PIL import ImageCms

    try:
        source = ImageCms.ImageCmsProfile(io.BytesIO(icc))
        target = ImageCms.createProfile("sRGB")
        return ImageCms.profileToProfile(image, source, target, outputMode="RGB")
    except (ImageCms.PyCMSError, OSError) as error:
        raise ProfileError(str(error)) from error
