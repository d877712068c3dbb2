"""Photo: linear-light pixels, and everything in the file that must survive an edit.

Pixel (0, 0) is at the top left; EXIF orientation is already applied.
"""

from __future__ import annotations

import datetime as dt
import warnings
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from sunwidget.edit.table import Edit
from sunwidget.errors import EditError, PhotoError, PhotoWarning
from sunwidget.formats import exif as exif_tags
from sunwidget.formats import xmp as xmp_packet
from sunwidget.formats.color import SRGB, ColorProfile, strips
from sunwidget.formats.gain_map import GainMap
from sunwidget.formats.pixels import size_within
from sunwidget.formats.png import cell_output
from sunwidget.photo.decode import Decoded
from sunwidget.photo.decode_heif import DepthMap
from sunwidget.photo.sources import decode_source

__all__ = ["FieldOfView", "Photo", "PhotoError", "PhotoWarning", "open_photo"]

_SHOWN_EDGE = 480  # pixels of the longer side, in a notebook
_DECODED_AT_ONCE = 1 << 23  # pixels: 100 MB of light


class FieldOfView(NamedTuple):
    """Vertical field of view in degrees, and its source: "exif" or "assumed"."""

    vertical: float
    source: str


@dataclass(frozen=True, eq=False)
class Photo:
    """An opened picture. Made by :func:`open_photo`.

    Attributes
    ----------
    encoded : (H, W, 3) uint8, uint16 or float32 array, read-only
        Code values of the file in its own ``profile``, upright; float32 is already linear
        Rec. 709 light. Gray is repeated in all channels.
    profile : ColorProfile
        Converts ``encoded`` to light.
    alpha : (H, W) float32 array in 0–1, or None
        Opacity from the file; the edit ignores it, and it is saved again.
    name, format : str
        File name, or "array"; "JPEG", "PNG", "TIFF", "WEBP", "EXR", "HDR", "RAW" … or None.
    icc, exif, xmp : bytes or None
        Metadata that is saved again; the orientation in ``exif`` is 1.
    dpi : (float, float) or None
        Print resolution.
    facts : CameraFacts
        Facts about the shot from the EXIF.
    turned : bool
        True if EXIF orientation turned the picture by a quarter.
    recorded : dict or None
        Recipe in the file of the edit that made this picture, saved again; ``recipe`` is the
        edit.
    notes : tuple of str
        Sentences about what could not be kept; also issued as PhotoWarning.
    gain_map : GainMap or None
        How much brighter a screen may show the picture, from the file. The edit ignores it; it
        is saved again if nothing was moved.
    depth : DepthMap or None
        Depth that a phone stored in its HEIC: ``values`` (h, w) float32 up to scale and shift;
        ``kind`` is "inverse" if they grow towards the camera, else "depth". ``analyze`` uses it
        unless another depth is given.
    sun : (x, y) or None
        Position of the sun in pixels, if sunwidget composed the picture (``replace_sky``);
        ``analyze`` uses it as a hint. It may lie outside the picture.
    """

    encoded: NDArray[Any]
    name: str = "array"
    format: str | None = None
    profile: ColorProfile = SRGB
    alpha: NDArray[np.float32] | None = None
    icc: bytes | None = None
    exif: bytes | None = None
    xmp: bytes | None = None
    dpi: tuple[float, float] | None = None
    facts: exif_tags.CameraFacts = field(default_factory=exif_tags.CameraFacts)
    turned: bool = False
    recorded: dict[str, Any] | None = None
    notes: tuple[str, ...] = ()
    gain_map: GainMap | None = None
    depth: DepthMap | None = None
    sun: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        self.encoded.flags.writeable = False
        if self.alpha is not None:
            self.alpha.flags.writeable = False

    def __repr__(self) -> str:
        width, height = self.size
        return f"<Photo {self.name!r} {width}×{height}, {self.bit_depth} bit, {self.profile.name}>"

    def _repr_mimebundle_(self, **_kwargs: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        return cell_output(self.preview(_SHOWN_EDGE), repr(self), self.name)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        return self.encoded.shape[1], self.encoded.shape[0]

    @property
    def width(self) -> int:
        """Width in pixels."""
        return self.size[0]

    @property
    def height(self) -> int:
        """Height in pixels."""
        return self.size[1]

    @property
    def bit_depth(self) -> int:
        """Bits per channel: 8, 16, or 32 for float light."""
        return self.encoded.dtype.itemsize * 8

    @cached_property
    def pixels(self) -> NDArray[np.float32]:
        """Linear Rec. 709 light, (H, W, 3) float32, read-only, 1 = white.

        Not clamped: colors outside Rec. 709 have channels below 0 or above 1. It is cached on
        first access, and takes two to four times the memory of the code values.
        """
        light = self.light()
        light.flags.writeable = False
        return light

    def light(self, rows: slice = slice(None)) -> NDArray[np.float32]:
        """Return the ``rows`` of ``pixels``, (h, W, 3) float32, without caching them."""
        if self.encoded.dtype.kind == "f":
            return np.asarray(self.encoded[rows])
        if "pixels" in self.__dict__:
            return np.asarray(self.pixels[rows])
        return self.profile.decode(self.encoded[rows])

    @cached_property
    def field_of_view(self) -> FieldOfView:
        """Vertical field of view in degrees and its source, "exif" or "assumed" (50°)."""
        degrees = exif_tags.field_of_view(self.facts, self.size, self.turned)
        if degrees is None:
            return FieldOfView(exif_tags.ASSUMED_FOV, "assumed")
        return FieldOfView(degrees, "exif")

    @property
    def latitude(self) -> float | None:
        """Degrees north, from the EXIF's GPS block."""
        return self.facts.latitude

    @property
    def longitude(self) -> float | None:
        """Degrees east, from the EXIF's GPS block."""
        return self.facts.longitude

    @property
    def heading(self) -> float | None:
        """Heading of the camera in degrees from north, clockwise."""
        return self.facts.heading

    @property
    def time(self) -> dt.datetime | None:
        """Time of the shot; naive local time if the file has no time zone."""
        return self.facts.time

    @cached_property
    def recipe(self) -> Edit | None:
        """The edit that made this picture, if sunwidget wrote it.

        None without a recipe, and for a recipe that this version cannot read.
        """
        try:
            return None if self.recorded is None else Edit.from_dict(self.recorded)
        except EditError:
            return None

    def preview(self, long_edge: int = 2048) -> NDArray[np.uint8]:
        """Return the picture as sRGB uint8 (h, w, 3), at most ``long_edge`` pixels long.

        It is averaged over areas in linear light and never enlarged; colors outside sRGB are
        clamped. An 8-bit sRGB photo that is small enough is returned unchanged.
        """
        small = self.size_within(long_edge)
        if small == self.size:
            if self.encoded.dtype == np.uint8 and self.profile.is_srgb:
                return self.encoded
            return SRGB.encode(self.light())
        return SRGB.encode(self._shrunk(small))

    def size_within(self, long_edge: int) -> tuple[int, int]:
        """Return width and height, scaled down to at most ``long_edge`` pixels."""
        return size_within(self.size, long_edge)

    def resized(self, size: tuple[int, int]) -> NDArray[np.float32]:
        """Return ``pixels`` averaged over areas at ``size`` (width, height), without caching."""
        import cv2

        if size == self.size:
            return self.light()
        smaller = size[0] <= self.width and size[1] <= self.height
        if smaller and self.width * self.height > _DECODED_AT_ONCE:
            return self._shrunk(size)
        return np.asarray(cv2.resize(self.light(), size, interpolation=cv2.INTER_AREA), np.float32)

    def _shrunk(self, size: tuple[int, int]) -> NDArray[np.float32]:
        """Average over areas in linear light, in strips, so that 150 MP need no float copy."""
        import cv2

        narrow = np.empty((self.height, size[0], 3), np.float32)
        for rows in strips(self.encoded.shape):
            light = self.light(rows)
            target = (size[0], light.shape[0])
            narrow[rows] = cv2.resize(light, target, interpolation=cv2.INTER_AREA)
        return np.asarray(cv2.resize(narrow, size, interpolation=cv2.INTER_AREA), np.float32)


def open_photo(source: Any) -> Photo:
    """Open a photo. Public as ``sunwidget.open``.

    Parameters
    ----------
    source : path, bytes, binary file object, PIL image, array or Photo
        Files are JPEG, PNG, TIFF, WebP, AVIF, BMP, GIF, Radiance HDR, HEIC (extra ``heif``),
        OpenEXR (extra ``exr``) or camera raw (extra ``raw``).
        Arrays are (H, W), (H, W, 3) or (H, W, 4), also with 1 or 2 channels: uint8 and
        uint16 are read as sRGB code values, floats as *linear* Rec. 709 light with
        1 = white. A Photo is returned unchanged.

    Returns
    -------
    Photo

    Raises
    ------
    PhotoError
        If the source cannot be opened; the message says what to do.

    Warns
    -----
    PhotoWarning
        If part of the file could not be kept, such as further frames.
    """
    if isinstance(source, Photo):
        return source
    name, decoded = decode_source(source)
    for note in decoded.notes:
        warnings.warn(note, PhotoWarning, stacklevel=2)
    return photo_of(decoded, name)


def photo_of(decoded: Decoded, name: str) -> Photo:
    """Return a decoded picture as a photo."""
    return Photo(
        encoded=decoded.codes,
        name=name,
        format=decoded.format,
        profile=decoded.profile,
        alpha=decoded.alpha,
        icc=decoded.icc,
        exif=exif_tags.dump(decoded.exif),
        xmp=decoded.xmp,
        dpi=decoded.dpi,
        facts=exif_tags.camera_facts(decoded.exif),
        turned=decoded.turned,
        recorded=decoded.recipe or exif_tags.recipe(decoded.exif) or xmp_packet.recipe(decoded.xmp),
        notes=tuple(decoded.notes),
        gain_map=decoded.gain_map,
        depth=decoded.depth,
    )
