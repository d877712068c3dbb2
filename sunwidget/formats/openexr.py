"""OpenEXR files: linear light as half or single floats; needs the ``exr`` extra.

Colors are linear Rec. 709 with 1 = white of the display. The standard attributes record this
(``chromaticities``, and ``whiteLuminance`` if light is absolute).
"""

from __future__ import annotations

import errno
import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.errors import PhotoError
from sunwidget.formats.color import REC709_CHROMATICITIES, primaries_to_rec709
from sunwidget.formats.pixels import check_size

MAGIC = b"v/1\x01"
_NOTE = "sunwidget."
_LARGEST_HALF = np.float32(65504)
_MISSING = "OpenEXR files need the OpenEXR package: pip install 'sunwidget[exr]'."


@dataclass
class Exr:
    """Contents: (H, W, 3) float32 linear Rec. 709, straight alpha or None, notes, dpi."""

    light: NDArray[np.float32]
    alpha: NDArray[np.float32] | None
    notes: dict[str, str]
    dpi: tuple[float, float] | None = None


def library() -> Any:
    """Return the OpenEXR package.

    Raises
    ------
    PhotoError
        When the package is not installed.
    """
    try:
        import OpenEXR
    except ImportError as error:
        raise PhotoError(_MISSING) from error
    return OpenEXR


def write(
    path: Path,
    channels: dict[str, NDArray[Any]],
    attributes: dict[str, Any],
    notes: dict[str, str],
    *,
    bits: int = 16,
) -> None:
    """Write channels as a scan-line file with lossless ZIP compression.

    Parameters
    ----------
    path : Path
        File to write.
    channels : dict of (H, W) arrays
        By full name: ``"R"``, ``"sky.R"``, ``"matte.Y"`` …
    attributes : dict
        Further standard attributes of OpenEXR by name, each a text, float or tuple.
    notes : dict of str
        sunwidget's own texts, which :func:`read` returns.
    bits : {16, 32}
        Half floats have 11 bits of precision up to 65504; brighter light is clipped.

    Raises
    ------
    PhotoError
        Without the ``exr`` extra.
    OSError
        When the folder is missing or the disk full.
    """
    exr = library()
    header = {
        "compression": exr.ZIP_COMPRESSION,
        "type": exr.scanlineimage,
        "chromaticities": REC709_CHROMATICITIES,
    }
    packed = {}
    for name, values in channels.items():
        if bits == 16:
            values = np.clip(values, -_LARGEST_HALF, _LARGEST_HALF).astype(np.float16)
        packed[name] = np.ascontiguousarray(values, np.float16 if bits == 16 else np.float32)
    own = {_NOTE + name: text for name, text in notes.items()}
    try:
        exr.File(header | attributes | own, packed).write(str(path))
    except RuntimeError as error:  # the library's only error, even for a full disk
        failure = OSError(f"The OpenEXR file was not written: {error}")
        if os.strerror(errno.ENOSPC) in str(error):
            failure.errno = errno.ENOSPC
        raise failure from error


def read(data: bytes, name: str) -> Exr:
    """Read the color of a file's first part; further layers are ignored.

    Parameters
    ----------
    data : bytes
        Content of the file.
    name : str
        Name of the file in error messages.

    Raises
    ------
    PhotoError
        Without the ``exr`` extra, for a damaged file, and for one without R, G, B or Y.
    """
    exr = library()
    with tempfile.TemporaryDirectory() as folder:
        # Versions before 3.5 read files only.
        path = Path(folder, "picture.exr")
        path.write_bytes(data)
        try:
            header = exr.File(str(path), header_only=True).header()
            low, high = header["dataWindow"]
            width, height = (int(n) + 1 for n in high - low)
            check_size(width, height, name)
            found = exr.File(str(path), separate_channels=True).channels()
            planes = {key: channel.pixels for key, channel in found.items()}
        except PhotoError:
            raise
        except Exception as error:  # errors of the C++ library
            raise _damaged(name) from error
    names = ("R", "G", "B") if {"R", "G", "B"} <= set(planes) else ("Y", "Y", "Y")
    if names[0] not in planes:
        raise PhotoError(
            f"{name} is an OpenEXR file without the channels R, G, B or Y (it has "
            f"{', '.join(sorted(planes))[:80] or 'none'}). Save its picture as R, G and B."
        )
    wanted = [planes[key] for key in names]
    if any(plane.shape != (height, width) or plane.dtype.kind != "f" for plane in wanted):
        raise _damaged(name)
    light = np.stack(wanted, axis=-1).astype(np.float32)
    alpha = planes.get("A")
    if alpha is not None:
        alpha = np.clip(alpha.astype(np.float32), 0, 1)
        # OpenEXR colors are premultiplied by alpha ("Technical Introduction to OpenEXR").
        light /= np.maximum(alpha, 1e-6)[..., None]
    matrix = primaries_to_rec709(_numbers(header.get("chromaticities"), REC709_CHROMATICITIES))
    if matrix is not None:
        light = light @ matrix.T.astype(np.float32)
    notes = {
        key.removeprefix(_NOTE): value
        for key, value in header.items()
        if key.startswith(_NOTE) and isinstance(value, str)
    }
    (density,) = _numbers((header.get("xDensity"),), (0.0,))
    return Exr(light, alpha, notes, (density, density) if 1 <= density <= 65535 else None)


def _numbers(value: Any, otherwise: tuple[float, ...]) -> tuple[float, ...]:
    """Return an attribute as finite numbers, or ``otherwise`` if it has not as many numbers."""
    try:
        found = tuple(float(number) for number in value)
    except (TypeError, ValueError):
        return otherwise
    return found if len(found) == len(otherwise) and np.isfinite(found).all() else otherwise


def _damaged(name: str) -> PhotoError:
    return PhotoError(f"{name} is a damaged OpenEXR file. Copy or download it again.")
