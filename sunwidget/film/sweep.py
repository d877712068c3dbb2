"""Sweeps: a moving sun as a film or as numbered pictures."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from sunwidget.analysis.scene import checked_scene
from sunwidget.export.formats import check_quality
from sunwidget.film.path import SunPath, film_edits
from sunwidget.film.prefetch import prefetch
from sunwidget.film.writer import (
    LOOPS,
    Film,
    Frames,
    film_target,
    is_sequence,
    size_for,
    whole_film,
    with_progress,
    writer,
)
from sunwidget.messages import short_repr
from sunwidget.progress import Progress, with_time_left

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.edit.table import Edit

# Bytes of frames kept for the way back; others are rendered again.
_KEPT_BYTES = 400e6


def sweep(
    scene: Scene,
    path: SunPath,
    out: str | os.PathLike[str],
    *,
    fps: float = 24,
    frames: int | None = None,
    seconds: float | None = None,
    size: tuple[int, int] | None = None,
    easing: str = "linear",
    loop: str = "forever",
    quality: int = 85,
    overwrite: bool = False,
    progress: Progress | None = None,
) -> Path:
    """Render a scene along a path of edits as a film.

    Parameters
    ----------
    scene : Scene
        The result of ``analyze``.
    path : sequence or Day
        Two steps are the ends of a move. A step is an Edit, a recipe (dict), a recipe file or the
        name of a preset. More than two steps are evenly spaced stations; more than two Edits are
        one frame each, unless ``frames`` or ``seconds`` request a path through them. Key frames
        are pairs ``(seconds, step)``. A ``sunwidget.Day`` is a real day at a place. Methods,
        strokes and hints must be the same in all steps.
    out : path
        ``.mp4`` (H.264, yuv420p, tagged BT.709; needs the ``video`` extra), ``.gif``, ``.webp``,
        or a pattern such as ``frames/%04d.png`` for single frames, numbered from 1.
    fps : float
        Frames per second, 1–120. A GIF shows at most 50.
    frames : int, optional
        Number of frames, at least 2.
    seconds : float, optional
        Length of the film, instead of ``frames``. Default: the time of the last key frame, else
        5. Key frames are stretched to it.
    size : (width, height), optional
        Pixels. Default: the photo's own size, at most 1920 on the longer side, 720 for a GIF.
        MP4 rounds both down to even numbers.
    easing : {"linear", "ease_in", "ease_out", "ease_in_out", "smooth"}
        Easing of the sun at each step, as in CSS. "smooth" passes through the steps without
        stopping, on a monotone cubic.
    loop : {"forever", "once", "there_and_back"}
        Whether a GIF or WebP repeats; for an MP4 the player decides. "there_and_back" adds the
        way back, so that the film is nearly twice as long and repeats without a jump.
    quality : int
        MP4 and WebP quality, 1–100.
    overwrite : bool
        Replace an existing file.
    progress : callable, optional
        Called as ``progress(fraction, message)`` after every frame, with the remaining time in
        the message. An exception from it cancels the export and leaves no half-written file.

    Returns
    -------
    Path
        The film; for single frames, their folder.

    Raises
    ------
    FileExistsError
        When ``out`` exists and ``overwrite`` is false.
    ValueError
        For an unknown file type, an invalid size, length or rate, or edits that cannot be
        interpolated.
    ModuleNotFoundError
        For MP4 without the ``video`` extra.

    Examples
    --------
    >>> sw.sweep(scene, ["golden_hour", "sunset", "blue_hour"], "evening.mp4", seconds=8)
    >>> sw.sweep(scene, [(0, sw.Edit()), (4, sw.Edit(sun_elevation=-4))], "frames/%04d.png")
    """
    checked_scene(scene)
    place = Path(out)
    write = writer(place)
    if not isinstance(loop, str) or loop not in LOOPS:
        raise ValueError(f"loop must be one of {', '.join(LOOPS)}, not {short_repr(loop, 40)}.")
    check_quality(quality)
    size = size_for(place, (scene.camera.width, scene.camera.height), size)
    place = film_target(place, overwrite=overwrite)
    row = film_edits(scene, path, fps=fps, frames=frames, seconds=seconds, easing=easing)
    order = list(range(len(row)))
    if loop == "there_and_back":
        order += order[-2:0:-1]
    film = Film(size, fps, len(order), loop, quality)
    with (
        whole_film(place, overwrite=overwrite) as unfinished,
        contextlib.closing(prefetch(_render_each(scene, row, order, size))) as pictures,
    ):
        write(with_progress(pictures, len(order), with_time_left(progress)), unfinished, film)
    return place.parent if is_sequence(place) else place


def _render_each(scene: Scene, row: list[Edit], order: list[int], size: tuple[int, int]) -> Frames:
    """Render the edits of ``row`` in the given order; keep frames that recur, if they fit."""
    from sunwidget.renderer.offscreen import render

    kept: dict[int, NDArray[np.uint8]] = {}
    room = _KEPT_BYTES
    for i, number in enumerate(order):
        frame = kept.pop(number, None)
        if frame is None:
            frame = render(scene, row[number], size=size)
            if number in order[i + 1 :] and room >= frame.nbytes:
                kept[number] = frame
                room -= frame.nbytes
        yield frame
