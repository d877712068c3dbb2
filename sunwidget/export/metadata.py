"""What a saved picture tells besides its pixels: the photo's own metadata, and the edit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sunwidget.formats import exif as exif_tags
from sunwidget.formats import xmp
from sunwidget.formats.exif_values import text

if TYPE_CHECKING:
    from sunwidget.photo.photo import Photo

_SOFTWARE = 0x0131


def software() -> str:
    """Return program and version, as files name them."""
    from sunwidget.version import __version__

    return f"sunwidget {__version__}"


def metadata_for(
    photo: Photo, size: tuple[int, int], recipe: dict[str, Any] | None = None
) -> dict[str, Any]:
    """Return the fields of a ``Still`` that tell of ``photo``, for a picture of ``size``.

    Parameters
    ----------
    photo : Photo
        Whose EXIF, XMP, ICC profile and resolution to keep.
    size : (width, height)
        Of the picture to be written; the EXIF tells it.
    recipe : dict, optional
        The edit that was made now: it goes into the EXIF's user comment and into the XMP, where
        the history gets one more entry, and sunwidget becomes the file's ``Software``. Without it
        nothing is added to what the photo had.
    """
    read = exif_tags.load(photo.exif) if photo.exif else None
    packet = photo.xmp
    if recipe is not None:
        camera = text(read.get(_SOFTWARE)) if read is not None else ""
        packet = xmp.record(packet, recipe, software(), before=camera)
    made_by = None if recipe is None else software()
    known = recipe or photo.recorded
    return {
        "icc": photo.icc,
        "exif": exif_tags.dump(read, size, known, made_by),
        "xmp": packet,
        "dpi": photo.dpi,
        "recipe": known,
    }
