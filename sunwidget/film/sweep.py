"""Sweeps: a moving sun as a film, as pictures one by one, or as a sheet."""

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
from sunwidget.film.prefetch import ahead
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
from sunwidget.messages import shown
from sunwidget.progress import Progress, with_time_left

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.edit.table import Edit

# Frames kept for the way back; what does not fit is rendered again.
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
        What ``analyze`` returned.
    path : sequence or Day
        Two steps are the ends of a move. A step is an Edit, a recipe (dict), a recipe's file
        or the name of a preset. More than two are passed through at even distances; more than
        two Edits are one frame each, unless ``frames`` or ``seconds`` ask for a path through
        them. Key frames are pairs ``(seconds, step)``. A ``sunwidget.Day`` is a real day at a
        place. Methods, strokes and hints must be the same in all.
    out : path
        ``.mp4`` (H.264, yuv420p, tagged BT.709; needs the ``video`` extra), ``.gif``,
        ``.webp``, or a pattern as ``frames/%04d.png`` for frames one by one, from 1.
    fps : float
        Frames a second, 1–120. A GIF shows at most 50.
    frames : int, optional
        Number of frames, at least 2.
    seconds : float, optional
        Length of the film, instead of ``frames``. Default: the last key frame's time, else 5.
        Key frames are stretched to it.
    size : (width, height), optional
        Pixels. Default: the photo's own size, at most 1920 on the longer side, 720 for a GIF.
        MP4 rounds both down to even numbers.
    easing : {"linear", "ease_in", "ease_out", "ease_in_out", "smooth"}
        How the sun starts and stops at each step, as CSS means it. "smooth" passes through
        the steps between without a stop, on a monotone cubic.
    loop : {"forever", "once", "there_and_back"}
        Whether a GIF or WebP repeats; an MP4 leaves that to the player. "there_and_back" adds
        the way back, so that the film is nearly twice as long and repeats without a jump.
    quality : int
        Of MP4 and WebP, 1–100.
    overwrite : bool
        Replace an existing file.
    progress : callable, optional
        Called as ``progress(fraction, message)`` after every frame, with the time that is
        left. What it raises cancels the export, and no half-written file is left.

    Returns
    -------
    Path
        Where the film is; for frames one by one their folder.

    Raises
    ------
    FileExistsError
        When ``out`` exists and ``overwrite`` is false.
    ValueError
        For an unknown file type, an impossible size, length or rate, or edits that no path
        joins.
    ModuleNotFoundError
        When MP4 is asked for without the ``video`` extra.

    Examples
    --------
    >>> sw.sweep(scene, ["golden_hour", "sunset", "blue_hour"], "evening.mp4", seconds=8)
    >>> sw.sweep(scene, [(0, sw.Edit()), (4, sw.Edit(sun_elevation=-4))], "frames/%04d.png")
    """
    checked_scene(scene)
    place = Path(out)
    write = writer(place)
    if not isinstance(loop, str) or loop not in LOOPS:
        raise ValueError(f"loop must be one of {', '.join(LOOPS)}, not {shown(loop, 40)}.")
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
        contextlib.closing(ahead(_rendered(scene, row, order, size))) as pictures,
    ):
        write(with_progress(pictures, len(order), with_time_left(progress)), unfinished, film)
    return place.parent if is_sequence(place) else place


def _rendered(scene: Scene, row: list[Edit], order: list[int], size: tuple[int, int]) -> Frames:
    """Render the edits of ``row`` in the ``order`` of their numbers, each but once if it fits."""
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
