"""Sweeps: a moving sun as a film, as pictures one by one, or as a sheet."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from sunwidget.export.ahead import ahead
from sunwidget.export.film import (
    LOOPS,
    Film,
    Frames,
    is_sequence,
    sequence_target,
    whole_sequence,
    writer,
)
from sunwidget.export.sun_path import SunPath, film_edits
from sunwidget.files import complete_or_absent, target
from sunwidget.time_left import Progress, with_time_left

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.edit import Edit

# Beyond this, H.264 at 4:2:0 leaves the levels that phones and browsers decode; a GIF of that
# size has a hundred megabytes.
LONGEST_SIDE = {".gif": 720}
LONGEST_SIDE_ELSE = 1920
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
    place = Path(out)
    write = writer(place)
    if loop not in LOOPS:
        raise ValueError(f"loop must be one of {', '.join(LOOPS)}, not {loop!r:.40}.")
    if isinstance(quality, bool) or not isinstance(quality, int) or not 1 <= quality <= 100:
        raise ValueError(f"quality must be a whole number from 1 to 100, not {quality!r:.40}.")
    suffix = place.suffix.lower()
    camera = scene.camera
    size = film_size(
        (camera.width, camera.height), size, LONGEST_SIDE.get(suffix, LONGEST_SIDE_ELSE)
    )
    if suffix == ".mp4":
        size = (size[0] - size[0] % 2, size[1] - size[1] % 2)
    one_by_one = is_sequence(place)
    place = (sequence_target if one_by_one else target)(place, overwrite=overwrite)
    row = film_edits(scene, path, fps=fps, frames=frames, seconds=seconds, easing=easing)
    order = list(range(len(row)))
    if loop == "there_and_back":
        order += order[-2:0:-1]
    film = Film(size, fps, len(order), loop, quality)
    whole = (whole_sequence if one_by_one else complete_or_absent)(place, overwrite=overwrite)
    with (
        whole as unfinished,
        contextlib.closing(ahead(_rendered(scene, row, order, size))) as pictures,
    ):
        write(_told(pictures, len(order), with_time_left(progress)), unfinished, film)
    return place.parent if one_by_one else place


def film_size(
    photo: tuple[int, int], size: tuple[int, int] | None, longest: int = LONGEST_SIDE_ELSE
) -> tuple[int, int]:
    """Return (width, height) of the film: ``size``, or the photo's within ``longest`` a side."""
    if size is None:
        scale = min(1.0, longest / max(photo))
        size = (max(2, round(photo[0] * scale)), max(2, round(photo[1] * scale)))
    try:
        width, height = (int(n) for n in size)
    except (TypeError, ValueError):
        raise ValueError(f"size must be (width, height) in pixels, not {size!r:.40}.") from None
    if not (2 <= width <= 8192 and 2 <= height <= 8192):
        raise ValueError(f"A film of {width}×{height} is not possible; 2 to 8192 pixels a side.")
    return width, height


def _rendered(scene: Scene, row: list[Edit], order: list[int], size: tuple[int, int]) -> Frames:
    """Render the edits of ``row`` in the ``order`` of their numbers, each but once if it fits."""
    from sunwidget.renderer.render import render

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


def _told(frames: Frames, count: int, progress: Progress) -> Frames:
    """Pass frames on and tell ``progress`` when each has been taken."""
    for done, frame in enumerate(frames, start=1):
        yield frame
        progress(done / count, f"frame {done} of {count}")
