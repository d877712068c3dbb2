"""Frames to a file: MP4, GIF, WebP, or a picture each."""

from __future__ import annotations

import contextlib
import errno
import itertools
import os
import re
import subprocess
import tempfile
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sunwidget.files import complete_or_absent, explained, folder_target, target
from sunwidget.film.gif import write_gif
from sunwidget.formats.pixels import size_within
from sunwidget.messages import shown
from sunwidget.progress import Progress

Frames = Iterator[NDArray[np.uint8]]
LOOPS = ("once", "forever", "there_and_back")

# Beyond this, H.264 at 4:2:0 leaves the levels that phones and browsers decode; a GIF of that
# size has a hundred megabytes.
_LONGEST_SIDE = {".gif": 720}
_LONGEST_SIDE_ELSE = 1920

# %d, %4d or %04d, as ffmpeg and printf name files in a row.
_NUMBER = re.compile(r"%(?:0?\d)?d(?![a-z])")
_PNG_WORKERS = 2
_BT709 = "colorspace=bt709:color_primaries=bt709:color_trc=bt709:range=tv"


@dataclass(frozen=True)
class Film:
    """What a writer needs to know: (width, height), rate, number of frames, loop, quality."""

    size: tuple[int, int]
    fps: float
    count: int
    loop: str
    quality: int

    def durations(self, unit: int) -> list[int]:
        """Return how long each frame stands in 1/unit s, so that no frame drifts off its time."""
        ends = [round(i * unit / self.fps) for i in range(self.count + 1)]
        return [b - a for a, b in itertools.pairwise(ends)]


Writer = Callable[[Frames, Path, Film], None]


def longest_side(path: Path) -> int:
    """Return how many pixels a side a film of this name has at most, unless asked for more."""
    return _LONGEST_SIDE.get(path.suffix.lower(), _LONGEST_SIDE_ELSE)


def film_size(
    photo: tuple[int, int], size: tuple[int, int] | None, longest: int = _LONGEST_SIDE_ELSE
) -> tuple[int, int]:
    """Return (width, height) of the film: ``size``, or the photo's within ``longest`` a side."""
    if size is None:
        width, height = size_within(photo, longest)
        size = max(2, width), max(2, height)
    try:
        width, height = (int(n) for n in size)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(
            f"size must be (width, height) in pixels, not {shown(size, 40)}."
        ) from None
    if not (2 <= width <= 8192 and 2 <= height <= 8192):
        asked = f"{shown(width, 9)}×{shown(height, 9)}"
        raise ValueError(f"A film of {asked} is not possible; 2 to 8192 pixels a side.")
    return width, height


def size_for(path: Path, photo: tuple[int, int], size: tuple[int, int] | None) -> tuple[int, int]:
    """Return (width, height) of the film of this name; MP4 has even ones."""
    width, height = film_size(photo, size, longest_side(path))
    even = path.suffix.lower() == ".mp4"
    return (width - width % 2, height - height % 2) if even else (width, height)


def is_sequence(path: Path) -> bool:
    """Whether the name is a pattern of names in a row, as frames/%04d.png."""
    return _NUMBER.search(path.name) is not None


def writer(path: Path) -> Writer:
    """Return what writes films of this ending, before the first frame is rendered.

    Raises
    ------
    ValueError
        For an ending that is no film's; the message names those that are.
    ModuleNotFoundError
        For MP4 without the ``video`` extra.
    """
    suffix = path.suffix.lower()
    if is_sequence(path):
        if suffix != ".png" or len(_NUMBER.findall(path.name)) > 1:
            raise ValueError(f"Frames one by one are named as frames/%04d.png, not {path.name!r}.")
        return _write_pngs
    writers = {".mp4": _write_mp4, ".gif": _write_gif, ".webp": _write_webp}
    if suffix not in writers:
        raise ValueError(
            f"A film ends in .mp4, .gif or .webp, not {suffix or 'nothing'!r}; frames one by one "
            "are named as frames/%04d.png."
        )
    if suffix == ".mp4":
        try:
            import imageio_ffmpeg  # noqa: F401 - fail before the first frame is rendered
        except ImportError as error:
            raise ModuleNotFoundError(
                "MP4 needs imageio-ffmpeg: pip install 'sunwidget[video]'. GIF and WebP do not."
            ) from error
    return writers[suffix]


def _write_mp4(frames: Frames, path: Path, film: Film) -> None:
    """Pipe frames into ffmpeg; unlike imageio's own writer, notice when ffmpeg fails."""
    import imageio_ffmpeg

    # 18, x264's "visually lossless", at quality 85; six steps halve the file.
    crf = round(18 + (85 - film.quality) * 0.3)
    command = [
        *(imageio_ffmpeg.get_ffmpeg_exe(), "-nostdin", "-v", "error", "-y"),
        *("-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{film.size[0]}x{film.size[1]}"),
        *("-r", f"{film.fps:g}", "-i", "-", "-an"),
        # Tags that are only asked of the encoder give way to those of the frames, which have none.
        *("-vf", f"scale=out_color_matrix=bt709:out_range=tv,setparams={_BT709}"),
        *("-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", f"{crf}", "-preset", "veryfast"),
        *("-movflags", "+faststart", str(path)),
    ]
    with (
        tempfile.TemporaryFile() as messages,
        subprocess.Popen(  # noqa: S603 - no shell, and no word of it comes from a photo
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=messages,
            # Ctrl-C goes to this process alone, which then ends ffmpeg in order.
            process_group=0,
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
            reason = words[-1] if words else f"it ended with {encoder.returncode}"
            said = f"ffmpeg could not write the film: {reason}"
            if os.strerror(errno.ENOSPC) in said:
                raise OSError(errno.ENOSPC, said)
            raise OSError(said)


def _write_gif(frames: Frames, path: Path, film: Film) -> None:
    # Browsers show a frame of less than 2/100 s for a tenth of a second.
    hundredths = [max(2, n) for n in film.durations(100)]
    with path.open("wb") as file:
        write_gif(frames, file, hundredths, forever=film.loop != "once")


def _write_webp(frames: Frames, path: Path, film: Film) -> None:
    from PIL import Image

    pictures = (Image.fromarray(frame) for frame in frames)
    first = next(pictures)
    first.save(
        path,
        save_all=True,
        append_images=pictures,
        duration=film.durations(1000),
        loop=1 if film.loop == "once" else 0,
        quality=film.quality,
        method=2,
    )


def _write_pngs(frames: Frames, folder: Path, _film: Film) -> None:
    """Write 1.png, 2.png … into a folder; ``whole_sequence`` gives them their names."""
    from PIL import Image

    def save(number: int, frame: NDArray[np.uint8]) -> None:
        Image.fromarray(frame).save(folder / f"{number}.png", compress_level=4)

    waiting: deque[Future[None]] = deque()
    with ThreadPoolExecutor(_PNG_WORKERS) as pool:
        for number, frame in enumerate(frames, start=1):
            waiting.append(pool.submit(save, number, frame))
            if len(waiting) > _PNG_WORKERS:
                waiting.popleft().result()
        for rest in waiting:
            rest.result()


def film_target(path: Path, *, overwrite: bool) -> Path:
    """Check where a film, or frames one by one, are to be written, before any work is spent."""
    return (sequence_target if is_sequence(path) else target)(path, overwrite=overwrite)


def whole_film(path: Path, *, overwrite: bool) -> contextlib.AbstractContextManager[Path]:
    """Yield where to write it; what is there becomes ``path`` only when all went well."""
    return (whole_sequence if is_sequence(path) else complete_or_absent)(path, overwrite=overwrite)


def with_progress(frames: Frames, count: int, progress: Progress) -> Frames:
    """Yield the frames and report each to ``progress`` once it is taken."""
    for done, frame in enumerate(frames, start=1):
        yield frame
        progress(done / count, f"frame {done} of {count}")


def sequence_target(path: Path, *, overwrite: bool) -> Path:
    """Check where frames one by one are to be written, before any work is spent on it.

    The folder is made when all is done; the one that it lies in must exist.

    Raises
    ------
    FileExistsError
        When a file has a name of the sequence and ``overwrite`` is false.
    FileNotFoundError, NotADirectoryError, NotWrittenError
        When there is no folder to write into, as ``folder_target``.
    """
    path = path.expanduser().absolute()
    folder_target(path.parent)
    taken = _numbered(path)
    for place in taken.values():
        if place.is_dir():
            raise IsADirectoryError(f"{place} is a folder. Name the frames otherwise.")
    if taken and not overwrite:
        raise FileExistsError(
            f"{taken[min(taken)]} exists already. Pass overwrite=True to replace the sequence."
        )
    return path


@contextlib.contextmanager
def whole_sequence(path: Path, *, overwrite: bool) -> Iterator[Path]:
    """Yield a folder whose 1.png, 2.png … become ``path`` numbered from 1, all or none.

    With ``overwrite`` the frames of an earlier sequence of that name are replaced, and those
    beyond the new one's end are removed: a longer one's last frames would show in the film.
    """
    folder = path.parent
    with (
        explained(folder),
        tempfile.TemporaryDirectory(
            prefix=".sunwidget-", dir=folder if folder.is_dir() else folder.parent
        ) as name,
    ):
        unfinished = Path(name)
        yield unfinished
        done = sorted(unfinished.iterdir(), key=lambda file: int(file.stem))
        sequence_target(path, overwrite=overwrite)  # again: the work may have taken long
        folder.mkdir(exist_ok=True)
        old = _numbered(path)
        for file in done:
            file.replace(_named(path, int(file.stem)))
        for number, file in old.items():
            if number > len(done):
                file.unlink(missing_ok=True)


def _numbered(path: Path) -> dict[int, Path]:
    """Return the files of a sequence that are there, by number, from 1 upwards without a gap."""
    found: dict[int, Path] = {}
    while (file := _named(path, len(found) + 1)).exists():
        found[len(found) + 1] = file
    return found


def _named(path: Path, number: int) -> Path:
    return path.with_name(_NUMBER.sub(lambda pattern: pattern[0] % number, path.name))
