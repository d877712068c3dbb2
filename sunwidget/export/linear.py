"""Encoders for linear light: OpenEXR and Radiance HDR.

The light is the result of ``render(…, dtype="float32")``: linear Rec. 709, 1 = the display's
white. The sRGB (or the photo's own) encoding is undone, the camera's tone curve is not.
Neither format has fields for EXIF and XMP. Both are stored as notes that ``sunwidget.open`` reads;
EXR's standard attributes describe the shot for other programs.
"""

from __future__ import annotations

import base64
import json
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sunwidget.export.dropped import warn_dropped
from sunwidget.export.metadata import software
from sunwidget.formats import exif as exif_tags
from sunwidget.formats import openexr, radiance
from sunwidget.formats.exif_values import positive, text

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from sunwidget.export.still import Still

# EXIF tag -> OpenEXR's standard attribute ("Standard Optional Attributes").
_OF_SHOT = {0x829A: "expTime", 0x829D: "aperture", 0x8827: "isoSpeed"}
# Channels below this are colors outside Rec. 709, not noise.
_OUTSIDE = -1e-3


def exr(still: Still) -> bytes:
    """Encode as OpenEXR in half or single floats, with layers as ``layer.channel``."""
    channels = _channels("", still.samples)
    for name, samples in still.layers.items():
        channels |= _channels(f"{name}.", samples)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "picture.exr")
        openexr.write(path, channels, _attributes(still), _notes(still), bits=still.bits)
        return path.read_bytes()


def hdr(still: Still) -> bytes:
    """Encode as Radiance HDR. Drops alpha and clips colors outside Rec. 709."""
    if still.alpha is not None:
        warn_dropped("Radiance HDR has no transparency; it was dropped. OpenEXR keeps it.")
    if float(still.codes.min()) < _OUTSIDE:
        warn_dropped("Radiance HDR clips colors outside Rec. 709. OpenEXR keeps them.")
    return radiance.pack(still.codes, _notes(still), software=software())


def _channels(prefix: str, samples: NDArray[np.float32]) -> dict[str, NDArray[np.float32]]:
    count = samples.shape[2]
    names = "RGBA"[:count] if count >= 3 else "Y"
    color = samples
    if count == 4:  # OpenEXR's colors are multiplied by alpha
        color = samples.copy()
        color[..., :3] *= samples[..., 3:]
    return {prefix + name: color[..., i] for i, name in enumerate(names)}


def _attributes(still: Still) -> dict[str, Any]:
    found: dict[str, Any] = {"software": software()} | still.attributes
    if still.dpi:
        found["xDensity"] = float(still.dpi[0])  # pixels per inch
    exif = exif_tags.load(still.exif) if still.exif else None
    if exif is None:
        return found
    shot, facts = exif.get_ifd(0x8769), exif_tags.camera_facts(exif)
    for tag, name in _OF_SHOT.items():
        if (value := positive(shot.get(tag))) is not None:
            found[name] = value
    for name in ("latitude", "longitude", "altitude"):
        if (value := getattr(facts, name)) is not None:
            found[name] = float(value)
    if facts.clock is not None:
        found["capDate"] = facts.clock.strftime("%Y:%m:%d %H:%M:%S")
    if owner := text(exif.get(0x8298)):
        found["owner"] = owner
    return found


def _notes(still: Still) -> dict[str, str]:
    notes = {}
    if still.recipe is not None:
        notes["recipe"] = json.dumps(still.recipe)
    for name, block in (("exif", still.exif), ("xmp", still.xmp)):
        if block:
            notes[name] = base64.b64encode(block).decode("ascii")
    return notes
