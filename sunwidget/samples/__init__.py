"""The bundled sample pictures, so that a first cell always runs.

They are computer-generated renders, not photographs: four procedural landscapes, path-traced
at 1536×1024 by the developers. Their EXIF has a fictional camera, date, place and heading that
agree with the sun in the picture. MIT license, like the code.
"""

from __future__ import annotations

from importlib import resources

from sunwidget.errors import PhotoError
from sunwidget.messages import did_you_mean
from sunwidget.photo.photo import Photo, open_photo

NAMES = ("coast", "mountains", "meadow", "harbour")
"""Names that :func:`sample` knows."""


def sample(name: str = "coast") -> Photo:
    """Open a bundled sample picture (a render, not a photograph).

    Parameters
    ----------
    name : {"coast", "mountains", "meadow", "harbour"}
        Name of the sample.

    Returns
    -------
    Photo
        1536×1024, 8-bit sRGB, with focal length, time, place and heading in its EXIF.

    Raises
    ------
    PhotoError
        For an unknown name; the nearest spelling is suggested.
    """
    if name not in NAMES:
        hint = did_you_mean(name, NAMES)
        raise PhotoError(
            f"There is no sample {str(name)[:80]!r}.{hint} The samples are {', '.join(NAMES)}."
        )
    file = resources.files(__name__) / f"{name}.jpg"
    with resources.as_file(file) as path:
        return open_photo(path)
