"""Decode camera raw files to code values with LibRaw (the ``raw`` extra).

Development keeps light in proportion: the camera's white balance, Rec. 709 primaries, no tone
curve and no automatic brightening; 16 bits in the sRGB encoding.
"""

from __future__ import annotations

import io
import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.errors import PhotoError
from sunwidget.formats import exif as exif_tags
from sunwidget.formats.pixels import check_size

_ENDING = re.compile(
    r"\.(3fr|arw|cr[23w]|dcr|dng|erf|fff|iiq|kdc|mef|mos|mrw|nef|nrw|orf|pef|raf|raw|rw[2l]|"
    r"sr[2fw]|x3f)$",
    re.IGNORECASE,
)
_MAGIC = (b"IIRO", b"IIRS", b"MMOR", b"IIU\0", b"FUJIFILM")
_TIFF = (b"II*\0", b"MM\0*")
_SRGB_GAMMA = (2.4, 12.92)
# Sensors often clip slightly below LibRaw's white level, which would tint a clipped sun. From this
# share of that level upwards, the brightest value counts as the sensor's limit. LibRaw's 0.75 would
# brighten many pictures without clipping, each by a different factor.
_SATURATED = 0.9
# Tags of the first directory that describe the shot. The others describe the file's layout, and
# some makers' contain whole pictures.
_SHOT_TAGS = (270, 271, 272, 274, 282, 283, 296, 305, 306, 315, 33432)
_FIRST_PICTURE = 254
_DNG_VERSION = 50706
_SUB_IMAGES = 330


def is_raw(data: bytes, name: str, tags: dict[int, Any]) -> bool:
    """Return whether a file is camera raw, by its name, first bytes and TIFF ``tags``."""
    if data.startswith(_MAGIC) or data[4:11] == b"ftypcrx":
        return True
    if not data.startswith(_TIFF):
        return data[6:14] == b"HEAPCCDR"  # Canon's first raw format, .crw
    if data[8:10] == b"CR" or _DNG_VERSION in tags:
        return True
    if name.lower().endswith((".tif", ".tiff")):
        return False
    small = tags.get(_FIRST_PICTURE) == 1 and _SUB_IMAGES in tags
    return small or _ENDING.search(name) is not None


def develop(data: bytes, name: str) -> tuple[NDArray[np.uint16], Any, bool]:
    """Return upright (H, W, 3) uint16 sRGB code values; Exif or None; whether it was turned.

    Raises
    ------
    PhotoError
        Without the ``raw`` extra, and for a file that LibRaw cannot read.
    """
    try:
        import rawpy
    except ImportError as error:
        raise PhotoError(
            f"{name} is a camera raw file. Reading it needs LibRaw: pip install 'sunwidget[raw]'; "
            "or develop it in another program and open the TIFF or JPEG."
        ) from error
    try:
        with rawpy.imread(io.BytesIO(data)) as raw:
            check_size(raw.sizes.width, raw.sizes.height, name)
            turned = raw.sizes.flip in (5, 6)
            exif = _exif(data, raw)
            codes = raw.postprocess(
                use_camera_wb=True,
                no_auto_bright=True,
                adjust_maximum_thr=_SATURATED,
                output_bps=16,
                gamma=_SRGB_GAMMA,
                output_color=rawpy.ColorSpace.sRGB,
            )
    except rawpy.LibRawError as error:
        version = ".".join(str(n) for n in rawpy.libraw_version)
        reason = error.args[0].decode() if isinstance(error.args[0], bytes) else error
        plain = " If it is a plain TIFF, name it .tif." if data.startswith(_TIFF) else ""
        raise PhotoError(
            f"{name} is a camera raw file that LibRaw {version} cannot read ({reason}). Copy it "
            f"again, or convert it to DNG or TIFF.{plain}"
        ) from error
    return np.asarray(codes, np.uint16), exif, turned


def _exif(data: bytes, raw: Any) -> Any:
    """Return the shot's Exif from the file's own directories, else from its JPEG preview."""
    block = data
    if data.startswith(_MAGIC):  # a TIFF except for its two magic bytes
        block = data[:2] + (b"*\0" if data[:2] == b"II" else b"\0*") + data[4:]
    exif = exif_tags.load(block) if block.startswith(_TIFF) else None
    if exif is None or not (exif.get(271) or exif.get_ifd(0x8769)):
        exif = _exif_of_preview(raw) or exif
    if exif is None:
        return None
    for tag in list(exif):
        if tag not in (*_SHOT_TAGS, 0x8769, 0x8825):
            del exif[tag]
    return exif


def _exif_of_preview(raw: Any) -> Any:
    from PIL import Image

    try:
        preview = raw.extract_thumb().data
        with Image.open(io.BytesIO(preview), formats=("JPEG",)) as image:
            return exif_tags.load(image.info.get("exif", b"")) if "exif" in image.info else None
    except Exception:  # noqa: BLE001 - a raw file without a preview, or with a damaged one
        return None
