"""Read camera, place and time from a photo's EXIF, and prepare EXIF for writing.

EXIF is untrusted and often wrong: every reader here returns None for nonsense and never raises.
"""

from __future__ import annotations

import contextlib
import datetime as dt
import json
import math
import threading
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from sunwidget.formats import exif_gps
from sunwidget.formats.exif_values import number, positive, text

_ORIENTATION = 0x0112
_SOFTWARE = 0x0131
_EXIF_IFD = 0x8769
_GPS_IFD = 0x8825
_INTEROPERABILITY_IFD = 0xA005
_USER_COMMENT = 0x9286
_PIXEL_WIDTH, _PIXEL_HEIGHT = 0xA002, 0xA003
_MAKER_NOTE = 0x927C
# Tags that describe the pixel storage of one particular file, and metadata that is copied
# separately (XMP 700, ICC 34675). A copied picture must not inherit them.
_STORAGE_TAGS = frozenset(
    {254, 255, 256, 257, 258, 259, 262, 266, 273, 277, 278, 279, 280, 281, 284, 290, 291, 297}
    | {301, 317, 318, 319, 320, 321, 322, 323, 324, 325, 330, 332, 333, 334, 336, 338, 339, 340}
    | {341, 342, 347, *range(512, 522), 529, 530, 531, 532, 700, 34377, 34675, 37724, 50341}
)
_filters_lock = threading.RLock()
_MM_PER_UNIT = {2: 25.4, 3: 10.0, 4: 1.0, 5: 0.001}
_DIAGONAL_35MM = 43.267  # hypot(36, 24)

ASSUMED_FOV = 50.0
"""Vertical field of view in degrees of a photo whose EXIF does not give it."""


@dataclass(frozen=True)
class CameraFacts:
    """Facts of the shot, each None if the file does not have it.

    Lengths are in millimetres. ``stored_size`` is the width and height that the camera wrote,
    before turning. Latitude and longitude are in degrees, north and east positive; heading is
    clockwise in degrees from north, from magnetic north if ``heading_magnetic``; altitude is in
    metres. ``clock`` is the camera's clock, without a zone. ``utc_offset`` is the hours that it
    was ahead of UTC, from its own tag (``offset_tagged``) or from the GPS. ``gps_time`` is the
    UTC time of the last GPS fix, which may be some minutes before the shot. ``time`` is the best
    of them, see ``exif_gps.best_time``.
    """

    focal_length: float | None = None
    focal_35mm: float | None = None
    focal_plane_mm_per_px: float | None = None
    digital_zoom: float = 1.0
    stored_size: tuple[float, float] | None = None
    latitude: float | None = None
    longitude: float | None = None
    altitude: float | None = None
    heading: float | None = None
    heading_magnetic: bool = False
    time: dt.datetime | None = None
    clock: dt.datetime | None = None
    utc_offset: float | None = None
    offset_tagged: bool = False
    gps_time: dt.datetime | None = None


def load(block: bytes) -> Any:
    """Parse an EXIF block into a Pillow Exif; None if it is damaged."""
    from PIL import Image

    exif = Image.Exif()
    try:
        with quiet():
            exif.load(block)
            exif.get_ifd(_EXIF_IFD)
            exif.get_ifd(_GPS_IFD)
            # Pillow decodes values on first access and may fail then: access them now.
            for tag in list(exif):
                if not _decodes(exif, tag):
                    del exif[tag]
            keep_texts(exif)
    except Exception:  # noqa: BLE001 - a hostile block may fail anywhere inside Pillow's parser
        return None
    return exif


class _Text(str):
    """Text as Pillow reads it, in Latin-1; Pillow would write each é and © as "?".

    EXIF texts are ASCII by the standard and UTF-8 in many files; Latin-1 preserves their bytes.
    """

    __slots__ = ()

    def encode(self, *_asked: Any, **_more: Any) -> bytes:
        """Return the bytes that were read, whatever the requested encoding."""
        return super().encode("latin-1", "replace")


def keep_texts(exif: Any) -> None:
    """Make a Pillow Exif write its texts with the bytes that were read."""
    for values in (exif, exif.get_ifd(_EXIF_IFD), exif.get_ifd(_GPS_IFD)):
        for tag, value in list(values.items()):
            if isinstance(value, str) and not value.isascii():
                values[tag] = _Text(value)


def _decodes(exif: Any, tag: int) -> bool:
    try:
        return exif[tag] is not None
    except Exception:  # noqa: BLE001 - likewise
        return False


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Silence the warnings of libraries, one thread at a time.

    Warning filters belong to the whole process: two threads that save and restore them
    interleaved would silence all warnings permanently.
    """
    with _filters_lock, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def orientation(exif: Any) -> int:
    """Return the orientation tag, 1–8; 1 if it is missing or invalid."""
    value = exif.get(_ORIENTATION, 1) if exif is not None else 1
    return value if isinstance(value, int) and 1 <= value <= 8 else 1


def is_adobe_rgb(exif: Any) -> bool:
    """Return whether a camera set to Adobe RGB marked a photo without a profile (DCF 2.0, R03)."""
    if exif is None or exif.get_ifd(_EXIF_IFD).get(0xA001) == 1:
        return False
    try:
        with quiet():
            return text(exif.get_ifd(_INTEROPERABILITY_IFD).get(1)) == "R03"
    except Exception:  # noqa: BLE001 - a damaged pointer; before Pillow 13 also a missing one
        return False


def dump(
    exif: Any,
    size: tuple[int, int] | None = None,
    recipe: dict[str, Any] | None = None,
    software: str | None = None,
) -> bytes | None:
    """Serialize for an upright picture of ``size`` (width, height), without a stale thumbnail.

    ``recipe`` is stored as JSON in the user comment, ``software`` as the program that made the
    picture. Returns None if no tag is left.
    """
    from PIL import Image

    kept = Image.Exif()
    # Only plain values: private tags of camera makers that do not serialize are dropped.
    for tag, value in dict(exif).items() if exif is not None else ():
        if tag not in _STORAGE_TAGS and tag not in (_EXIF_IFD, _GPS_IFD) and tag < 0xC000:
            kept[tag] = value
    if _ORIENTATION in kept:
        kept[_ORIENTATION] = 1
    if software is not None:
        kept[_SOFTWARE] = software
    for ifd in (_EXIF_IFD, _GPS_IFD):
        values = dict(exif.get_ifd(ifd)) if exif is not None else {}
        values.pop(_INTEROPERABILITY_IFD, None)  # an offset into the old file
        if ifd == _EXIF_IFD:
            if size is not None and (_PIXEL_WIDTH in values or _PIXEL_HEIGHT in values):
                values[_PIXEL_WIDTH], values[_PIXEL_HEIGHT] = size
            if recipe is not None:
                values[_USER_COMMENT] = b"ASCII\0\0\0" + json.dumps(recipe).encode("ascii")
        if values:
            kept[ifd] = values
    if not dict(kept):
        return None
    block = _serialize(kept)
    if block is not None:
        return block
    # One value that Pillow reads but cannot write must not drop the others.
    for tag in list(kept):
        if tag in (_EXIF_IFD, _GPS_IFD):
            kept[tag] = {k: v for k, v in kept[tag].items() if _writable(tag, k, v)}
        elif not _writable(None, tag, kept[tag]):
            del kept[tag]
    return _serialize(kept)


def shortened(block: bytes, limit: int) -> tuple[bytes | None, str]:
    """Shorten a block to ``limit`` bytes by dropping as little as possible.

    Returns the block, or None if it cannot be shortened enough, and a name of the dropped part.
    """
    for tags, what in (
        ((_MAKER_NOTE,), "maker's note"),
        ((_USER_COMMENT,), "comment with the recipe"),
        ((_MAKER_NOTE, _USER_COMMENT), "maker's note and the comment with the recipe"),
    ):
        exif = load(block)
        if exif is None:
            break
        for tag in tags:
            exif.get_ifd(_EXIF_IFD).pop(tag, None)
        shorter = dump(exif)
        if shorter is not None and len(shorter) <= limit:
            return shorter, what
    return None, "metadata"


def _serialize(exif: Any) -> bytes | None:
    try:
        with quiet():
            return exif.tobytes()
    except Exception:  # noqa: BLE001 - a private tag fails anywhere inside Pillow's writer
        return None


def _writable(ifd: int | None, tag: int, value: Any) -> bool:
    from PIL import Image

    alone = Image.Exif()
    if ifd is None:
        alone[tag] = value
    else:
        alone[ifd] = {tag: value}
    return _serialize(alone) is not None


def recipe(exif: Any) -> dict[str, Any] | None:
    """Return the recipe that :func:`dump` wrote, or None."""
    comment = exif.get_ifd(_EXIF_IFD).get(_USER_COMMENT) if exif is not None else None
    if not isinstance(comment, bytes) or not comment.startswith(b"ASCII\0\0\0{"):
        return None
    try:
        found = json.loads(comment[8:])
    except (ValueError, RecursionError):
        return None
    return found if isinstance(found, dict) else None


def camera_facts(exif: Any) -> CameraFacts:
    """Collect the facts of the shot from a Pillow Exif."""
    if exif is None:
        return CameraFacts()
    shot, gps = exif.get_ifd(_EXIF_IFD), exif.get_ifd(_GPS_IFD)
    unit = number(shot.get(0xA210)) or 2.0
    per_unit = positive(shot.get(0xA20E))
    mm = _MM_PER_UNIT.get(int(unit))
    width, height = positive(shot.get(_PIXEL_WIDTH)), positive(shot.get(_PIXEL_HEIGHT))
    return CameraFacts(
        focal_length=positive(shot.get(0x920A)),
        focal_35mm=positive(shot.get(0xA405)),
        focal_plane_mm_per_px=mm / per_unit if mm and per_unit else None,
        digital_zoom=positive(shot.get(0xA404)) or 1.0,
        stored_size=(width, height) if width and height else None,
        **exif_gps.facts(exif, shot, gps),
    )


def field_of_view(facts: CameraFacts, size: tuple[int, int], turned: bool) -> float | None:
    """Return the vertical field of view in degrees of a picture of ``size`` (w, h), or None.

    Tries the focal plane's resolution, then the 35 mm equivalent by the diagonal
    convention f_px = f₃₅·hypot(W, H)/43.267. ``turned`` is true if the picture was turned by
    a quarter after the camera stored it. A digital zoom crops the sensor: the 35 mm equivalent
    already includes it (as ExifTool reads it), the focal plane's resolution does not.
    """
    stored = (size[1], size[0]) if turned else size
    from_plane = _focal_from_plane(facts, stored)
    from_35mm = _focal_from_35mm(facts, stored)
    # Software that resizes a photo often leaves the focal plane's resolution stale; a difference
    # of more than a fifth from the 35 mm equivalent reveals that.
    stale = from_plane and from_35mm and not 0.8 < from_plane / from_35mm < 1.25
    for focal in (None if stale else from_plane, from_35mm):
        if focal:
            degrees = math.degrees(2 * math.atan(size[1] / 2 / focal))
            if 0.5 <= degrees <= 150:
                return degrees
    return None


def _focal_from_plane(facts: CameraFacts, stored: tuple[int, int]) -> float | None:
    if not (facts.focal_length and facts.focal_plane_mm_per_px):
        return None
    pixels = facts.focal_length / facts.focal_plane_mm_per_px * facts.digital_zoom
    return pixels * _resized(facts, stored)


def _focal_from_35mm(facts: CameraFacts, stored: tuple[int, int]) -> float | None:
    if not facts.focal_35mm:
        return None
    width, height = facts.stored_size or stored
    return facts.focal_35mm * math.hypot(width, height) / _DIAGONAL_35MM * _resized(facts, stored)


def _resized(facts: CameraFacts, stored: tuple[int, int]) -> float:
    """Return the picture's scale relative to the stored one; 1 for a crop (another aspect)."""
    if facts.stored_size is None:
        return 1.0
    across, down = stored[0] / facts.stored_size[0], stored[1] / facts.stored_size[1]
    if abs(across / down - 1) < 0.02:
        return across
    # A crop: the scale is unknown. Full resolution is likeliest, but a picture that exceeds the
    # camera's own frame must have been enlarged.
    return max(1.0, across, down)
