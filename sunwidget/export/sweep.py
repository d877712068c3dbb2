"""Sweeps: a moving sun as a film (MP4, GIF or WebP)."""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from sunwidget.edit import NUMBERS, PARAMETERS, Edit, EditError
from sunwidget.files import complete_or_absent, target

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene

Progress = Callable[[float, str], object]
Frames = Iterator[np.ndarray]

DEFAULT_SECONDS = 5
# Beyond this, H.264 at 4:2:0 leaves the levels that phones and browsers decode.
LONGEST_SIDE = 1920


def sweep(
    scene: Scene,
    edits: Sequence[Edit],
    path: str | os.PathLike[str],
    *,
    fps: float = 24,
    frames: int | None = None,
    size: tuple[int, int] | None = None,
    overwrite: bool = False,
    progress: Progress | None = None,
) -> Path:
    """Render a row of edits of one scene as a film.

    Parameters
    ----------
    scene : Scene
        What ``analyze`` returned.
    edits : sequence of Edit
        Two edits are the ends of a move; more are one frame each, unless ``frames`` asks
        for a smooth path through them.
    path : path
        ``.mp4`` (H.264, yuv420p, tagged BT.709; needs the ``video`` extra), ``.gif`` or
        ``.webp``.
    fps : float
        Frames a second, 1–120. GIF rounds a frame to whole hundredths of a second.
    frames : int, optional
        Number of frames, at least 2. Default: five seconds' worth for two edits, else
        one for each edit.
    size : (width, height), optional
        Pixels. Default: the photo's own size, at most 1920 on the longer side. MP4 rounds
        both down to even numbers.
    overwrite : bool
        Replace an existing file.
    progress : callable, optional
        Called as ``progress(fraction, message)`` after every frame. What it raises
        cancels the export, and no half-written file is left.

    Returns
    -------
    Path
        Where the film is.

    Raises
    ------
    FileExistsError
        When ``path`` exists and ``overwrite`` is false.
    ValueError
        For an unknown file type, an impossible size or rate, or edits that no path joins.
    ModuleNotFoundError
        When MP4 is asked for without the ``video`` extra.
    """
    write = _writer(Path(path).suffix.lower())
    if not 1 <= fps <= 120:
        raise ValueError(f"fps = {fps!r} is outside 1 to 120 frames a second.")
    path = target(path, overwrite=overwrite)
    row = film_edits(edits, frames, fps, scene.automatic)
    size = film_size((scene.camera.width, scene.camera.height), size)
    if path.suffix.lower() == ".mp4":
        size = (size[0] - size[0] % 2, size[1] - size[1] % 2)
    with complete_or_absent(path, overwrite=overwrite) as unfinished:
        write(_render(scene, row, size, progress), unfinished, size, fps)
    return path


def film_edits(
    edits: Sequence[Edit], frames: int | None, fps: float, automatic: dict[str, Any]
) -> list[Edit]:
    """Return one Edit a frame: the edits as given, or a path through them."""
    edits = list(edits)
    if len(edits) < 2 or not all(isinstance(edit, Edit) for edit in edits):
        raise ValueError("A sweep needs two or more sunwidget.Edit objects.")
    if frames is None and len(edits) > 2:
        return edits
    count = round(DEFAULT_SECONDS * fps) if frames is None else frames
    if isinstance(count, bool) or not isinstance(count, int) or count < 2:
        raise ValueError(f"frames must be a whole number from 2 upwards, not {frames!r}.")
    row = []
    for position in np.linspace(0, len(edits) - 1, count):
        start = min(int(position), len(edits) - 2)
        row.append(between(edits[start], edits[start + 1], float(position - start), automatic))
    return row


def between(start: Edit, end: Edit, fraction: float, automatic: dict[str, Any]) -> Edit:
    """Return the Edit at ``fraction`` (0–1) of the straight way from ``start`` to ``end``.

    An automatic parameter stands for what the analysis found (``automatic``); the azimuth
    takes the shorter way round. Methods, strokes and hints cannot lie between two values,
    so both ends must agree on them; the place, which moves nothing, stays the first one's.
    """
    for p in PARAMETERS:
        if p.kind == "number" or p.name == "place":
            continue
        if getattr(start, p.name) != getattr(end, p.name):
            raise EditError(f"Both ends of a sweep need the same {p.name}.")
    changes: dict[str, float] = {}
    for p in NUMBERS:
        a, b = getattr(start, p.name), getattr(end, p.name)
        if a == b:
            continue
        a = automatic[p.name] if a is None else a
        b = automatic[p.name] if b is None else b
        if p.name == "sun_azimuth":
            b = a + (b - a + 180) % 360 - 180
            value = (a + (b - a) * fraction + 180) % 360 - 180
        else:
            value = a + (b - a) * fraction
        # What the analysis found may lie outside the slider's range.
        changes[p.name] = min(max(value, p.minimum), p.maximum)
    return start.replace(**changes)


def film_size(photo: tuple[int, int], size: tuple[int, int] | None) -> tuple[int, int]:
    """Return (width, height) of the film: ``size``, or the photo's, at most 1920 a side."""
    if size is None:
        scale = min(1.0, LONGEST_SIDE / max(photo))
        size = (max(2, round(photo[0] * scale)), max(2, round(photo[1] * scale)))
    width, height = size
    if not (2 <= width <= 8192 and 2 <= height <= 8192):
        raise ValueError(f"A film of {width}×{height} is not possible; 2 to 8192 pixels a side.")
    return int(width), int(height)


def _render(
    scene: Scene, edits: list[Edit], size: tuple[int, int], progress: Progress | None
) -> Frames:
    from sunwidget.renderer.render import render

    for done, edit in enumerate(edits, start=1):
        yield render(scene, edit, size=size)
        if progress is not None:
            progress(done / len(edits), f"frame {done} of {len(edits)}")


def _writer(suffix: str) -> Callable[[Frames, Path, tuple[int, int], float], None]:
    writers = {".mp4": _write_mp4, ".gif": _write_gif, ".webp": _write_webp}
    if suffix not in writers:
        raise ValueError(f"A film ends in .mp4, .gif or .webp, not {suffix or 'nothing'!r}.")
    if suffix == ".mp4":
        try:
            import imageio_ffmpeg  # noqa: F401 - fail before the first frame is rendered
        except ImportError as error:
            raise ModuleNotFoundError(
                "MP4 needs imageio-ffmpeg: pip install 'sunwidget[video]'. GIF and WebP do not."
            ) from error
    return writers[suffix]


def _write_mp4(frames: Frames, path: Path, size: tuple[int, int], fps: float) -> None:
    """Pipe frames into ffmpeg; unlike imageio's own writer, notice when ffmpeg fails."""
    import imageio_ffmpeg

    command = [
        *(imageio_ffmpeg.get_ffmpeg_exe(), "-nostdin", "-v", "error", "-y"),
        *("-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{size[0]}x{size[1]}"),
        *("-r", f"{fps:g}", "-i", "-", "-an"),
        *("-vf", "scale=out_color_matrix=bt709:out_range=tv", "-pix_fmt", "yuv420p"),
        *("-c:v", "libx264", "-crf", "18", "-preset", "veryfast"),
        *("-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"),
        *("-color_range", "tv", "-movflags", "+faststart", str(path)),
    ]
    with (
        tempfile.TemporaryFile() as messages,
        subprocess.Popen(  # noqa: S603 - no shell, and no word of it comes from a photo
            command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=messages
        ) as encoder,
    ):
        assert encoder.stdin is not None
        try:
            for frame in frames:
                encoder.stdin.write(np.ascontiguousarray(frame).data)
            encoder.stdin.close()
        except BrokenPipeError:
            pass  # ffmpeg has given up; its exit status and last words follow
        except BaseException:
            encoder.kill()
            raise
        if encoder.wait() != 0:
            messages.seek(0)
            words = messages.read().decode(errors="replace").strip().splitlines()
            raise OSError(f"ffmpeg could not write the film: {words[-1] if words else 'no reason'}")


def _write_gif(frames: Frames, path: Path, _size: tuple[int, int], fps: float) -> None:
    from PIL import Image

    def paletted(frame: np.ndarray) -> Image.Image:
        # A palette for each frame: one for all would band the sky at one end of the sweep.
        # Pillow dithers only onto a given palette, hence twice.
        picture = Image.fromarray(frame)
        return picture.quantize(palette=picture.quantize(256), dither=Image.Dither.FLOYDSTEINBERG)

    pictures = map(paletted, frames)
    first = next(pictures)
    duration = max(2, round(100 / fps)) * 10
    first.save(path, save_all=True, append_images=pictures, duration=duration, loop=0)


def _write_webp(frames: Frames, path: Path, _size: tuple[int, int], fps: float) -> None:
    from PIL import Image

    pictures = (Image.fromarray(frame) for frame in frames)
    first = next(pictures)
    first.save(
        path,
        save_all=True,
        append_images=pictures,
        duration=round(1000 / fps),
        loop=0,
        quality=85,
        method=2,
    )
