"""Writers of frames: MP4, GIF, WebP, or numbered PNG files."""

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

from sunwidget.files import complete_or_absent, explain_write_errors, folder_target, target
from sunwidget.film.gif import write_gif
from sunwidget.formats.pixels import size_within
from sunwidget.messages import short_repr
from sunwidget.progress import Progress

Frames = Iterator[NDArray[np.uint8]]
LOOPS = ("once", "forever", "there_and_back")

# Larger H.264 at 4:2:0 exceeds the levels that phones and browsers decode. A GIF of 1920 pixels
# has a hundred megabytes.
_LONGEST_SIDE = {".gif": 720}
_LONGEST_SIDE_ELSE = 1920

# %d, %4d or %04d, as ffmpeg and printf number files.
_NUMBER = re.compile(r"%(?:0?\d)?d(?![a-z])")
_PNG_WORKERS = 2
_BT709 = "colorspace=bt709:color_primaries=bt709:color_trc=bt709:range=tv"


@dataclass(frozen=True)
class Film:
    """Parameters of a writer: (width, height), rate, number of frames, loop, quality."""

    size: tuple[int, int]
    fps: float
    count: int
    loop: str
    quality: int

    def durations(self, unit: int) -> list[int]:
        """Return each frame's duration in 1/unit s, rounded so that errors do not accumulate."""
        ends = [round(i * unit / self.fps) for i in range(self.count + 1)]
        return [b - a for a, b in itertools.pairwise(ends)]


Writer = Callable[[Frames, Path, Film], None]


def longest_side(path: Path) -> int:
    """Return the default limit, in pixels, of the longer side of a film of this name."""
    return _LONGEST_SIDE.get(path.suffix.lower(), _LONGEST_SIDE_ELSE)


def film_size(
    photo: tuple[int, int], size: tuple[int, int] | None, longest: int = _LONGEST_SIDE_ELSE
) -> tuple[int, int]:
    """Return (width, height) of the film: ``size``, or the photo's limited to ``longest``."""
    if size is None:
        width, height = size_within(photo, longest)
        size = max(2, width), max(2, height)
    try:
        width, height = (int(n) for n in size)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(
            f"size must be (width, height) in pixels, not {short_repr(size, 40)}."
        ) from None
    if not (2 <= width <= 8192 and 2 <= height <= 8192):
        asked = f"{short_repr(width, 9)}×{short_repr(height, 9)}"
        raise ValueError(f"A film must have 2 to 8192 pixels per side, not {asked}.")
    return width, height


def size_for(path: Path, photo: tuple[int, int], size: tuple[int, int] | None) -> tuple[int, int]:
    """Return (width, height) of the film of this name; both are even for MP4."""
    width, height = film_size(photo, size, longest_side(path))
    even = path.suffix.lower() == ".mp4"
    return (width - width % 2, height - height % 2) if even else (width, height)


def is_sequence(path: Path) -> bool:
    """Return whether the name is a pattern of numbered files, such as frames/%04d.png."""
    return _NUMBER.search(path.name) is not None


def writer(path: Path) -> Writer:
    """Return the writer for a film's extension, before the first frame is rendered.

    Raises
    ------
    ValueError
        For an unknown extension; the message lists the known ones.
    ModuleNotFoundError
        For MP4 without the ``video`` extra.
    """
    suffix = path.suffix.lower()
    if is_sequence(path):
        if suffix != ".png" or len(_NUMBER.findall(path.name)) > 1:
            raise ValueError(f"Name single frames like frames/%04d.png, not {path.name!r}.")
        return _write_pngs
    writers = {".mp4": _write_mp4, ".gif": _write_gif, ".webp": _write_webp}
    if suffix not in writers:
        raise ValueError(
            f"A film must end in .mp4, .gif or .webp, not {suffix or 'nothing'!r}. Name single "
            "frames like frames/%04d.png."
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
    """Pipe frames into ffmpeg; unlike imageio's own writer, detect a failure of ffmpeg."""
    import imageio_ffmpeg

    # 18, x264's "visually lossless", at quality 85; six steps halve the file.
    crf = round(18 + (85 - film.quality) * 0.3)
    command = [
        *(imageio_ffmpeg.get_ffmpeg_exe(), "-nostdin", "-v", "error", "-y"),
        *("-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{film.size[0]}x{film.size[1]}"),
        *("-r", f"{film.fps:g}", "-i", "-", "-an"),
        # Tags set on the encoder alone are overridden by those of the frames, which are unset.
        *("-vf", f"scale=out_color_matrix=bt709:out_range=tv,setparams={_BT709}"),
        *("-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", f"{crf}", "-preset", "veryfast"),
        *("-movflags", "+faststart", str(path)),
    ]
    with (
        tempfile.TemporaryFile() as messages,
        subprocess.Popen(  # noqa: S603 - no shell, and no argument comes from a photo
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=messages,
            # Ctrl-C reaches only this process, which then stops ffmpeg.
            process_group=0,
        ) as encoder,
    ):
        assert encoder.stdin is not None
        try:
            for frame in frames:
                encoder.stdin.write(np.ascontiguousarray(frame).data)
            encoder.stdin.close()
        except BrokenPipeError:
            pass  # ffmpeg has stopped; its exit status and last message are read below
        except BaseException:
            encoder.kill()
            raise
        if encoder.wait() != 0:
            messages.seek(0)
            words = messages.read().decode(errors="replace").strip().splitlines()
            reason = words[-1] if words else f"exit status {encoder.returncode}"
            said = f"ffmpeg could not write the film: {reason}"
            if os.strerror(errno.ENOSPC) in said:
                raise OSError(errno.ENOSPC, said)
            raise OSError(said)


def _write_gif(frames: Frames, path: Path, film: Film) -> None:
    # Browsers display frames shorter than 2/100 s for a tenth of a second.
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
    """Write 1.png, 2.png … into a folder; ``whole_sequence`` renames them."""
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
    """Check the target of a film or of single frames before any work."""
    return (sequence_target if is_sequence(path) else target)(path, overwrite=overwrite)


def whole_film(path: Path, *, overwrite: bool) -> contextlib.AbstractContextManager[Path]:
    """Yield a temporary target that becomes ``path`` only if no error occurs."""
    return (whole_sequence if is_sequence(path) else complete_or_absent)(path, overwrite=overwrite)


def with_progress(frames: Frames, count: int, progress: Progress) -> Frames:
    """Yield the frames; report progress after each has been consumed."""
    for done, frame in enumerate(frames, start=1):
        yield frame
        progress(done / count, f"frame {done} of {count}")


def sequence_target(path: Path, *, overwrite: bool) -> Path:
    """Check the target of single frames before any work.

    The folder is created at the end; its parent must exist.

    Raises
    ------
    FileExistsError
        When a file of the sequence exists and ``overwrite`` is false.
    FileNotFoundError, NotADirectoryError, NotWrittenError
        When the folder cannot be written to, as in ``folder_target``.
    """
    path = path.expanduser().absolute()
    folder_target(path.parent)
    taken = _numbered(path)
    for place in taken.values():
        if place.is_dir():
            raise IsADirectoryError(f"{place} is a folder. Choose another name for the frames.")
    if taken and not overwrite:
        raise FileExistsError(
            f"{taken[min(taken)]} exists already. Pass overwrite=True to replace the sequence."
        )
    return path


@contextlib.contextmanager
def whole_sequence(path: Path, *, overwrite: bool) -> Iterator[Path]:
    """Yield a folder whose 1.png, 2.png … become ``path`` numbered from 1, all or none.

    With ``overwrite`` an earlier sequence of that name is replaced. Its frames beyond the end of
    the new one are removed, since they would appear in the film.
    """
    folder = path.parent
    with (
        explain_write_errors(folder),
        tempfile.TemporaryDirectory(
            prefix=".sunwidget-", dir=folder if folder.is_dir() else folder.parent
        ) as name,
    ):
        unfinished = Path(name)
        yield unfinished
        done = sorted(unfinished.iterdir(), key=lambda file: int(file.stem))
        sequence_target(path, overwrite=overwrite)  # again: files may have appeared meanwhile
        folder.mkdir(exist_ok=True)
        old = _numbered(path)
        for file in done:
            file.replace(_named(path, int(file.stem)))
        for number, file in old.items():
            if number > len(done):
                file.unlink(missing_ok=True)


def _numbered(path: Path) -> dict[int, Path]:
    """Return the existing files of a sequence by number, from 1 up to the first gap."""
    found: dict[int, Path] = {}
    while (file := _named(path, len(found) + 1)).exists():
        found[len(found) + 1] = file
    return found


def _named(path: Path, number: int) -> Path:
    return path.with_name(_NUMBER.sub(lambda pattern: pattern[0] % number, path.name))
