"""Time-lapses: frames of one camera under an edit or a path of edits, as a film or as stills."""

from __future__ import annotations

import contextlib
import inspect
import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from sunwidget.analysis.analyze import analyze
from sunwidget.analysis.scene import Scene
from sunwidget.errors import PhotoError, PhotoWarning
from sunwidget.export.formats import check_quality
from sunwidget.export.stills import save
from sunwidget.files import folder_target
from sunwidget.film.path import Step, SunPath, check_rate
from sunwidget.film.prefetch import prefetch
from sunwidget.film.writer import (
    Film,
    film_size,
    film_target,
    is_sequence,
    longest_side,
    size_for,
    whole_film,
    with_progress,
    writer,
)
from sunwidget.geometry.place import Place
from sunwidget.messages import did_you_mean
from sunwidget.photo.decode_apart import keep_process
from sunwidget.progress import Progress, part, with_time_left
from sunwidget.renderer.gl_thread import require_renderer
from sunwidget.timelapses.edits import FrameEdits
from sunwidget.timelapses.frames import Clock, Times, frame_sources, name_of
from sunwidget.timelapses.scenes import FrameScenes, Trouble

BROKEN = ("hold", "skip", "stop")
LOOPS = ("forever", "once")
_OPTIONS = ("fps", "size", "easing", "loop", "quality", "format", "place", "times", "broken")
_LOOKING = 0.3  # share of the work before the first frame is drawn


class FramesWarning(PhotoWarning):
    """Some frames of a time-lapse could not be used: ``unusable`` of ``count``."""

    def __init__(self, words: str, unusable: int, count: int) -> None:
        super().__init__(words)
        self.unusable = unusable
        self.count = count


def timelapse(
    frames: Any,
    edit: Step | SunPath,
    out: str | os.PathLike[str],
    *,
    fps: float = 24,
    size: tuple[int, int] | None = None,
    easing: str = "linear",
    loop: str = "forever",
    quality: int = 85,
    format: str | None = None,  # noqa: A002 - the usual word, as everywhere else
    place: Place | None = None,
    times: Times = None,
    broken: str = "hold",
    overwrite: bool = False,
    progress: Progress | None = None,
    **hints: Any,
) -> Path:
    """Move the sun in every frame of a time-lapse of one fixed camera.

    Skyline, horizon, camera, water and depth are found once, from several frames together. Clouds,
    exposure and the sun's direction are found for each frame and smoothed in time, so that the edit
    adds no flicker. Camera shake of less than 4 % of the picture is compensated.

    Parameters
    ----------
    frames : path or sequence
        A folder, a glob such as ``"frames/*.jpg"`` (both in natural order), or a sequence of
        sources for ``sunwidget.open``. Frames are opened twice and never held all at once.
    edit : Edit, recipe (dict), recipe file, preset name, or a path of them
        One edit for every frame, or, as for ``sunwidget.sweep``, a path of edits from the first
        frame to the last. Automatic values are those of each frame. Strokes and hints, in fractions
        of the picture, apply to all frames.
    out : path
        ``.mp4``, ``.gif`` or ``.webp``; a pattern such as ``"frames/%04d.png"``; or a folder,
        created if missing, for stills with the frames' names and metadata.
    fps : float
        Frames per second, 1–120.
    size : (width, height), optional
        Pixels. Default: the frames' own size; in a film at most 1920 on the longer side, 720 in
        a GIF. MP4 rounds both down to even numbers. Stills keep their aspect ratio within it.
    easing : str
        Easing along a path, as in ``sunwidget.sweep``.
    loop : {"forever", "once"}
        Whether a GIF or WebP repeats.
    quality : int
        MP4, WebP and JPEG quality, 1–100.
    format : str, optional
        File extension of stills, such as "png". Default: each frame's own.
    place : Place, optional
        Position of the camera; only latitude, longitude and heading are used. Together with times
        it determines the photographed sun. Default: the files' GPS. A missing heading follows from
        the suns visible in the frames.
    times : optional
        Times of the frames: a ``strptime`` pattern of their names ("%Y%m%d_%H%M%S"),
        ``(first, seconds between frames)``, or a datetime for each frame; UTC without a time zone.
        Default: the files' EXIF. Without place or times the photographed sun follows from the
        frames that show it; otherwise one direction is fitted for all frames.
    broken : {"hold", "skip", "stop"}
        For an unreadable frame: show the one before it again (stills: omit it), omit it, or raise
        PhotoError. A PhotoWarning lists the repeated or omitted frames.
    overwrite : bool
        Replace existing files.
    progress : callable, optional
        Called as ``progress(fraction, message)``. An exception from it cancels; finished stills
        remain, an unfinished film does not.
    **hints
        ``sky``, ``horizon``, ``fov``, ``water``, ``depth`` and methods as for
        ``sunwidget.analyze``, for all frames.

    Returns
    -------
    Path
        The film, or the folder of the stills.

    Raises
    ------
    FileNotFoundError
        When there are no frames.
    FileExistsError
        When an output file exists and ``overwrite`` is false.
    PhotoError
        When the camera moves, when fewer than two frames are usable, or when a frame is not usable
        and ``broken`` is "stop".
    ValueError
        For invalid options.
    RendererError
        When this machine has no EGL.

    Examples
    --------
    >>> sw.timelapse("frames/*.jpg", "sunset.json", "out.mp4")
    >>> sw.timelapse("frames", [sw.Edit(sun_elevation=20), sw.Edit(sun_elevation=-4)], "stills")
    """
    _check(fps=fps, loop=loop, quality=quality, broken=broken, hints=hints)
    sources = frame_sources(frames)
    place_out = Path(out).expanduser()
    film = is_sequence(place_out) or bool(place_out.suffix)
    long_edge = None if size is None else max(film_size((2, 2), size))
    if film:
        write = writer(place_out)
        place_out = film_target(place_out, overwrite=overwrite)
        long_edge = long_edge or longest_side(place_out)
    else:
        names = _still_names(sources, place_out, format, overwrite=overwrite)
    steps = FrameEdits(edit, len(sources), easing)
    require_renderer()  # before the long analysis of the frames
    report = with_time_left(progress)
    with keep_process():
        scenes = FrameScenes.of(
            sources,
            long_edge=long_edge,
            corrections=steps.corrections,
            place=place,
            clock=Clock(times, len(sources), None if place is None else place.longitude),
            hints=hints,
            progress=part(report, 0.0, _LOOKING),
        )
        _refuse_or_warn(scenes.troubles, len(sources), broken, film=film)

        drawing = part(report, _LOOKING, 1.0)
        if not film:
            place_out.mkdir(exist_ok=True)
            for number, scene in enumerate(scenes):
                drawing(number / len(sources), f"frame {number + 1} of {len(sources)}")
                if isinstance(scene, Scene):
                    moved = steps.of(scene, number, scenes.daylight[number])
                    save((scene, moved), names[number], overwrite=overwrite, quality=quality)
            drawing(1.0, f"{len(sources)} frames")
            return place_out
        count = len(sources) - (len(scenes.troubles) if broken == "skip" else 0)
        size = size_for(place_out, scenes.size, size)
        with (
            whole_film(place_out, overwrite=overwrite) as unfinished,
            contextlib.closing(prefetch(iter(scenes))) as prepared,
            contextlib.closing(
                prefetch(_draw_frames(prepared, steps, scenes.daylight, size, broken))
            ) as pictures,
        ):
            row = with_progress(pictures, count, drawing)
            write(row, unfinished, Film(size, fps, count, loop, quality))
        return place_out.parent if is_sequence(place_out) else place_out


def _draw_frames(
    scenes: Iterator[Scene | Trouble],
    steps: FrameEdits,
    daylight: Sequence[float],
    size: tuple[int, int],
    broken: str,
) -> Iterator[np.ndarray]:
    """Draw the frames; an unusable one repeats the frame before it, or the first usable one."""
    from sunwidget.renderer.offscreen import render

    last: np.ndarray | None = None
    waiting = 0
    for number, scene in enumerate(scenes):
        if isinstance(scene, Scene):
            last = render(scene, steps.of(scene, number, daylight[number]), size=size)
            yield from [last] * (waiting + 1)
            waiting = 0
        elif broken == "hold" and last is None:
            waiting += 1
        elif broken == "hold" and last is not None:
            yield last


def _still_names(
    sources: Sequence[Any], folder: Path, ending: str | None, *, overwrite: bool
) -> list[Path]:
    """Return the path of each still; raise, before any work, if one cannot be written."""
    from sunwidget.export.formats import FORMATS

    folder_target(folder)
    names = []
    for number, source in enumerate(sources):
        name = Path(name_of(source, number))
        suffix = "." + ending.lstrip(".") if ending else name.suffix.lower()
        # Formats that cannot be written, such as camera raw, become TIFF, which keeps their depth.
        names.append(folder / f"{name.stem}{suffix if suffix in FORMATS else '.tif'}")
    if ending and "." + ending.lstrip(".") not in FORMATS:
        raise ValueError(f"format= takes one of {', '.join(FORMATS)}, not {ending!r:.40}.")
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"Two frames would be written as {twice.name}. Rename one of them.")
    taken = [name for name in names if name.exists()]
    if taken and not overwrite:
        raise FileExistsError(
            f"{taken[0]} exists already. Pass overwrite=True to replace it, or another folder."
        )
    return names


def _refuse_or_warn(troubles: Sequence[Trouble], count: int, broken: str, *, film: bool) -> None:
    if not troubles:
        return
    shown = "; ".join(f"{t.name}: {t.reason.rstrip('.')}" for t in troubles[:3])
    more = f"; and {len(troubles) - 3} more" if len(troubles) > 3 else ""
    words = f"{len(troubles)} of {count} frames cannot be used ({shown}{more})"
    if broken == "stop":
        raise PhotoError(f"{words}. Leave them out, or pass broken='hold' or broken='skip'.")
    done = "each repeats the frame before it" if film and broken == "hold" else "left out"
    warnings.warn(FramesWarning(f"{words}; {done}.", len(troubles), count), stacklevel=3)


def _check(*, fps: float, loop: str, quality: int, broken: str, hints: Mapping[str, Any]) -> None:
    known = inspect.signature(analyze).parameters.keys() - {"photo", "progress"}
    if unknown := sorted(hints.keys() - known):
        hint = did_you_mean(unknown[0], [*known, *_OPTIONS])
        raise TypeError(f"timelapse() takes no {unknown[0]!r:.40}.{hint}")
    check_rate(fps)
    if loop not in LOOPS:
        raise ValueError(f"loop must be one of {', '.join(LOOPS)}, not {loop!r:.40}.")
    check_quality(quality)
    if broken not in BROKEN:
        raise ValueError(f"broken must be one of {', '.join(BROKEN)}, not {broken!r:.40}.")
