"""Contact sheets: some frames of a film on one sheet."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np

from sunwidget.analysis.scene import checked_scene
from sunwidget.export.sheet import sheet
from sunwidget.files import target
from sunwidget.film.day import Day
from sunwidget.film.path import SunPath, film_edits
from sunwidget.messages import short_repr
from sunwidget.progress import Progress, with_time_left

if TYPE_CHECKING:
    from PIL import Image

    from sunwidget.analysis.scene import Scene
    from sunwidget.edit.table import Edit

_LONG_EDGE = 400  # in pixels, of a picture on the sheet
_MOST = 400


def contact_sheet(
    scene: Scene,
    path: SunPath,
    out: str | os.PathLike[str] | None = None,
    *,
    columns: int | None = None,
    frames: int = 12,
    size: tuple[int, int] | None = None,
    easing: str = "linear",
    overwrite: bool = False,
    progress: Progress | None = None,
) -> Image.Image:
    """Return evenly spaced frames of a film on one sheet, each with its sun's elevation.

    Parameters
    ----------
    scene, path, easing
        As for ``sweep``. The frames of a ``Day`` are labeled with their time in UTC.
    out : path, optional
        File to save the sheet to as well: .png, .jpg, .tif or .webp.
    columns : int, optional
        Frames per row. Default: four, three for upright photos.
    frames : int
        Number of frames, 2–400, including the first and the last of the film.
    size : (width, height), optional
        Pixels of one frame. Default: the photo's shape, 400 on the longer side.
    overwrite : bool
        Replace an existing file.
    progress : callable, optional
        Called as ``progress(fraction, message)`` after every frame. An exception from it cancels.

    Returns
    -------
    PIL.Image.Image
        RGB.

    Raises
    ------
    FileExistsError
        When ``out`` exists and ``overwrite`` is false.
    ValueError
        For an invalid number of frames or columns, or an invalid path.

    Examples
    --------
    >>> sw.contact_sheet(scene, [sw.Edit(), "sunset"])
    """
    from sunwidget.export.stills import save
    from sunwidget.film.writer import film_size
    from sunwidget.renderer.offscreen import render

    camera = checked_scene(scene).camera
    width, height = camera.width, camera.height
    columns = (4 if width >= height else 3) if columns is None else columns
    for name, value, least in (("frames", frames, 2), ("columns", columns, 1)):
        if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= _MOST:
            raise ValueError(
                f"{name} must be a whole number from {least} to {_MOST}, "
                f"not {short_repr(value, 40)}."
            )
    if out is not None:
        target(out, overwrite=overwrite)
    report = with_time_left(progress)
    size = film_size((width, height), size, _LONG_EDGE)
    pictures: dict[str, np.ndarray] = {}
    for i, edit in enumerate(film_edits(scene, path, frames=frames, easing=easing), start=1):
        name = _name(scene, edit, timed=isinstance(path, Day))
        pictures[f"{i}  {name}"] = render(scene, edit, size=size)
        report(i / frames, f"frame {i} of {frames}")
    whole = sheet(pictures, min(columns, frames))
    if out is not None:
        save(np.asarray(whole), out, overwrite=overwrite)
    return whole


def _name(scene: Scene, edit: Edit, *, timed: bool) -> str:
    from sunwidget.analysis.heading import clock

    elevation = edit.sun_elevation
    if elevation is None:
        elevation = scene.automatic["sun_elevation"]
    moon = scene.lit_by_moon if edit.light_source == "automatic" else edit.light_source == "moon"
    name = f"{'moon' if moon else 'sun'} {elevation:.1f}°".replace("-", "\N{MINUS SIGN}")
    if timed and edit.place is not None:
        name = f"{clock(edit.place.time)} UTC  {name}"
    return name
