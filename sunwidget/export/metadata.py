"""Metadata of a saved picture: the photo's own, and the edit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sunwidget.formats import exif as exif_tags
from sunwidget.formats import xmp
from sunwidget.formats.exif_values import text

if TYPE_CHECKING:
    from sunwidget.photo.photo import Photo

_SOFTWARE = 0x0131


def software() -> str:
    """Return program and version, as written into files."""
    from sunwidget.version import __version__

    return f"sunwidget {__version__}"


def metadata_for(
    photo: Photo, size: tuple[int, int], recipe: dict[str, Any] | None = None
) -> dict[str, Any]:
    """Return the metadata fields of a ``Still`` for a picture of ``photo`` at ``size``.

    Parameters
    ----------
    photo : Photo
        Source of EXIF, XMP, ICC profile and resolution.
    size : (width, height)
        Size of the written picture, recorded in the EXIF.
    recipe : dict, optional
        The edit. It is written into the EXIF user comment and the XMP, whose history gets one more
        entry, and sunwidget becomes the file's ``Software``. Without it the photo's metadata stays
        unchanged.
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
