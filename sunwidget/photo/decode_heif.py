"""Decode HEIC photos with libheif (the ``heif`` extra), with a phone's depth and gain map.

libheif turns the picture and its maps upright.
"""

from __future__ import annotations

import contextlib
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from sunwidget.errors import PhotoError
from sunwidget.formats import apple_gain_map
from sunwidget.formats import exif as exif_tags
from sunwidget.formats.gain_map import GainMap
from sunwidget.formats.pixels import check_size

# AVIF has the same container; Pillow reads it.
_BRANDS = (b"heic", b"heix", b"heim", b"heis", b"hevc", b"hevx", b"hevm", b"hevs")
_GENERAL = (b"mif1", b"mif2", b"msf1")
_HDR = {16: "PQ", 18: "HLG"}  # transfer characteristics of ITU-T H.273
_GAIN_MAP = "urn:com:apple:photo:2020:aux:hdrgainmap"
_UNIFORM_DEPTH = 2  # ITU-T H.265, depth_representation_type; the others grow towards the camera


class DepthMap(NamedTuple):
    """Depth of a photo from the phone, up to scale and, if inverse, shift.

    ``values`` is (h, w) float32, of any size. ``kind`` is "inverse" if values grow towards the
    camera, as disparities do, else "depth".
    """

    values: NDArray[np.float32]
    kind: str


class Heif(NamedTuple):
    """Contents of a HEIC. ``codes`` is (H, W) or (H, W, 1–4), uint8 or uint16, upright."""

    codes: NDArray[Any]
    icc: bytes | None
    primaries: tuple[float, ...]
    exif: Any
    xmp: bytes | None
    turned: bool
    depth: DepthMap | None
    gain_map: GainMap | None
    notes: list[str]


def is_heif(data: bytes) -> bool:
    """Return whether a file is a HEIC, by its first bytes."""
    if data[4:8] != b"ftyp":
        return False
    end = min(int.from_bytes(data[:4], "big"), 256)
    brands = [data[8:12], *(data[at : at + 4] for at in range(16, end, 4))]
    return brands[0] in _BRANDS or (brands[0] in _GENERAL and any(b in _BRANDS for b in brands))


def read(data: bytes, name: str) -> Heif:
    """Read a HEIC.

    Raises
    ------
    PhotoError
        Without the ``heif`` extra, and for a file that is damaged or of an unsupported kind.
    """
    try:
        import pillow_heif
    except ImportError as error:
        raise PhotoError(
            f"{name} is a HEIC photo. Reading it needs libheif: pip install 'sunwidget[heif]'; or "
            "export it as JPEG and open that."
        ) from error
    try:
        file = pillow_heif.open_heif(data, convert_hdr_to_8bit=False, hdr_to_16bit=False)
        width, height = file.size
        check_size(width, height, name)
        info = file.info
        transfer = _HDR.get(info.get("nclx_profile", {}).get("transfer_characteristics"))
        if transfer and not info.get("icc_profile"):
            raise PhotoError(
                f"{name} is a HEIC in {transfer}, an HDR encoding that sunwidget does not read. "
                "Export it as JPEG, TIFF or OpenEXR and open that."
            )
        codes = _codes(file)
        orientation = pillow_heif.set_orientation(info)
    except PhotoError:
        raise
    except MemoryError as error:
        raise PhotoError(f"There is not enough memory to open {name}. Scale it down.") from error
    except Exception as error:  # libheif fails in many ways; all mean a damaged file
        text = (str(error).splitlines() or [""])[0][:120].rstrip(". ") or type(error).__name__
        raise PhotoError(
            f"{name} is a HEIC photo that is damaged or of an unknown kind ({text}). Copy it "
            "again, or export it as JPEG."
        ) from error
    exif = exif_tags.load(info["exif"]) if info.get("exif") else None
    nclx = info.get("nclx_profile", {})
    corners = ("red", "green", "blue", "white")
    primaries = [nclx.get(f"color_primary_{c}_{axis}", 0.0) for c in corners for axis in "xy"]
    notes = []
    if len(file) > 1:
        notes.append(f"{name} holds {len(file)} pictures; only the main one is used.")
    return Heif(
        codes,
        info.get("icc_profile"),
        tuple(primaries) if any(primaries) else (),
        exif,
        info.get("xmp"),
        (orientation or 1) >= 5,
        _depth(file),
        _gain_map(file, exif, data),
        notes,
    )


def _codes(image: Any) -> NDArray[Any]:
    """Return code values scaled to the full range of 8 or 16 bits."""
    if image.premultiplied_alpha:
        return np.asarray(image.to_pillow().convert("RGBA"))
    codes = np.asarray(image)
    _, _, bits = image.mode.partition(";")
    if not bits:
        return codes.copy()
    top = (1 << int(bits.rstrip("L"))) - 1
    return np.rint(codes * (65535 / top)).astype(np.uint16)


def _has_proportions(values: NDArray[Any], size: tuple[int, int]) -> bool:
    """Return whether a map has the picture's proportions, within a twentieth."""
    height, width = values.shape
    return abs(width * size[1] - height * size[0]) < 0.05 * width * size[1]


def _depth(file: Any) -> DepthMap | None:
    for image in file.info.get("depth_images", ()):
        with contextlib.suppress(Exception):  # a damaged map is dropped, the picture kept
            values = np.array(image, np.float32)
            representation = image.info.get("metadata", {}).get("representation_type")
            kind = "depth" if representation == _UNIFORM_DEPTH else "inverse"
            if values.ndim == 2 and _has_proportions(values, file.size) and np.ptp(values) > 0:
                return DepthMap(values, kind)
    return None


def _gain_map(file: Any, exif: Any, data: bytes) -> GainMap | None:
    for number in file.info.get("aux", {}).get(_GAIN_MAP, ()):
        with contextlib.suppress(Exception):  # likewise
            levels = np.array(file.get_aux_image(number))
            headroom = apple_gain_map.headroom(exif, data)
            if headroom and levels.ndim == 2 and _has_proportions(levels, file.size):
                return apple_gain_map.gain_map(levels, headroom)
    return None
