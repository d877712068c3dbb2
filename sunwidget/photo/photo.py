"""Photo: linear-light pixels, and everything of the file that must survive an edit.

Pixel (0, 0) is the top-left one; EXIF orientation is already applied.
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
from sunwidget.photo.sources import decoded_from

__all__ = ["FieldOfView", "Photo", "PhotoError", "PhotoWarning", "open_photo"]

_SHOWN_EDGE = 480  # pixels of the longer side, in a notebook
_DECODED_AT_ONCE = 1 << 23  # pixels: 100 MB of light


class FieldOfView(NamedTuple):
    """Vertical field of view in degrees, and where it comes from: "exif" or "assumed"."""

    vertical: float
    source: str


@dataclass(frozen=True, eq=False)
class Photo:
    """A picture as it was opened. Made by :func:`open_photo`.

    Attributes
    ----------
    encoded : (H, W, 3) uint8, uint16 or float32 array, read-only
        The code values of the file in its own ``profile``, upright; float32 is linear
        Rec. 709 light already. Grey is repeated in all channels.
    profile : ColorProfile
        How ``encoded`` becomes light.
    alpha : (H, W) float32 array in 0–1, or None
        Opacity that the file stores; it takes no part in the edit and is saved again.
    name, format : str
        File name, or "array"; "JPEG", "PNG", "TIFF", "WEBP", "EXR", "HDR", "RAW" … or None.
    icc, exif, xmp : bytes or None
        Metadata to be written again; the orientation in ``exif`` is 1.
    dpi : (float, float) or None
        Print resolution.
    facts : CameraFacts
        What the EXIF says about the shot.
    turned : bool
        True when EXIF orientation turned the picture by a quarter.
    recorded : dict or None
        Recipe of the edit that made this picture as the file has it, to be written again;
        ``recipe`` is the edit.
    notes : tuple of str
        Sentences about what could not be kept; also given as PhotoWarning.
    gain_map : GainMap or None
        How much brighter a screen may show the picture, as its file tells it. It takes no part in
        the edit, and is saved again where nothing was moved.
    depth : DepthMap or None
        Depth that a phone has kept in its HEIC: ``values`` (h, w) float32 up to scale and shift;
        ``kind`` is "inverse" where they grow towards the camera, or "depth". ``analyze`` takes it
        unless it is told another.
    sun : (x, y) or None
        Where the sun stands in pixels, when sunwidget composed the picture and knows it
        (``replace_sky``); ``analyze`` takes it for a hint. May lie outside the picture.
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
        """Bits a channel: 8, 16, or 32 for float light."""
        return self.encoded.dtype.itemsize * 8

    @cached_property
    def pixels(self) -> NDArray[np.float32]:
        """Linear Rec. 709 light, (H, W, 3) float32, read-only, 1 = white.

        Not clamped: colours of a wider gamut have channels below 0 or above 1. It is kept once
        it was asked for, and takes four to two times the memory of the code values.
        """
        light = self.light()
        light.flags.writeable = False
        return light

    def light(self, rows: slice = slice(None)) -> NDArray[np.float32]:
        """Return the ``rows`` of ``pixels``, (h, W, 3) float32, without keeping what is decoded."""
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
        """Where the camera looked, degrees from north, clockwise."""
        return self.facts.heading

    @property
    def time(self) -> dt.datetime | None:
        """Time of the shot; naive local time when the file names no zone."""
        return self.facts.time

    @cached_property
    def recipe(self) -> Edit | None:
        """The edit that made this picture, when sunwidget wrote it.

        None, too, for a recipe that this version cannot read.
        """
        try:
            return None if self.recorded is None else Edit.from_dict(self.recorded)
        except EditError:
            return None

    def preview(self, long_edge: int = 2048) -> NDArray[np.uint8]:
        """Return the picture as sRGB uint8 (h, w, 3), no longer than ``long_edge`` pixels.

        Averaged over areas in linear light; never enlarged; colours outside sRGB are
        clamped. An 8-bit sRGB photo that is small enough comes back as it is.
        """
        small = self.size_within(long_edge)
        if small == self.size:
            if self.encoded.dtype == np.uint8 and self.profile.is_srgb:
                return self.encoded
            return SRGB.encode(self.light())
        return SRGB.encode(self._shrunk(small))

    def size_within(self, long_edge: int) -> tuple[int, int]:
        """Return width and height, shrunk in proportion to at most ``long_edge`` pixels."""
        return size_within(self.size, long_edge)

    def resized(self, size: tuple[int, int]) -> NDArray[np.float32]:
        """Return ``pixels`` averaged over areas at ``size`` (width, height), kept nowhere."""
        import cv2

        if size == self.size:
            return self.light()
        smaller = size[0] <= self.width and size[1] <= self.height
        if smaller and self.width * self.height > _DECODED_AT_ONCE:
            return self._shrunk(size)
        return np.asarray(cv2.resize(self.light(), size, interpolation=cv2.INTER_AREA), np.float32)

    def _shrunk(self, size: tuple[int, int]) -> NDArray[np.float32]:
        """Area average in linear light; strip by strip, so that 150 MP need no float copy."""
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
        uint16 are taken as sRGB code values, floats as *linear* Rec. 709 light with
        1 = white. A Photo is returned as it is.

    Returns
    -------
    Photo

    Raises
    ------
    PhotoError
        For everything that cannot be opened; the message says what to do.

    Warns
    -----
    PhotoWarning
        When something in the file could not be kept, such as further frames.
    """
    if isinstance(source, Photo):
        return source
    name, decoded = decoded_from(source)
    for note in decoded.notes:
        warnings.warn(note, PhotoWarning, stacklevel=2)
    return photo_of(decoded, name)


def photo_of(decoded: Decoded, name: str) -> Photo:
    """Return what was decoded as a photo."""
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
