"""One photo of a batch, from its file to the bytes of its pictures, wherever that happens.

A worker writes nothing into the folder of the results: it hands bytes back, and the process that
runs the batch is the only one that writes. So a worker may die at any moment, may stand on
another machine, and no photo comes out twice or by halves.
"""

from __future__ import annotations

import hashlib
import os
import socket
import tempfile
import threading
import time
import warnings
from dataclasses import dataclass, field
from pathlib import Path

from sunwidget.batches.request import Wish
from sunwidget.progress import Progress, part
from sunwidget.version import __version__

# Two photos at a time in one process would take twice the memory for one GL context.
_one_at_a_time = threading.Lock()


@dataclass(frozen=True)
class Job:
    """One photo to be developed.

    ``path`` is absolute, ``digest`` the SHA-256 of its bytes, ``data`` the bytes themselves for a
    worker that does not see the path, ``output`` the name of the picture; ``threads`` limits what
    the libraries may use, None leaves them alone.
    """

    number: int
    path: str
    digest: str
    output: str
    wish: Wish
    data: bytes | None = field(default=None, repr=False)
    threads: int | None = None
    version: str = __version__


@dataclass(frozen=True)
class Outcome:
    """What became of a job: the files by name, the picture itself last, or an error's sentence.

    ``unseen`` says that this worker cannot read the photo and needs its bytes.
    """

    number: int
    files: dict[str, bytes] = field(default_factory=dict, repr=False)
    error: str = ""
    unseen: bool = False
    notes: tuple[str, ...] = ()
    seconds: float = 0.0
    worker: str = ""


def develop(job: Job, progress: Progress | None = None) -> Outcome:
    """Open, analyse, render and encode one photo. What goes wrong becomes the outcome's error.

    Raises
    ------
    RendererError
        When nothing can be rendered on this machine: every other photo would fail as well.
    RuntimeError
        When the batch was started by another version of sunwidget.
    """
    from sunwidget.errors import RendererError

    if job.version != __version__:
        raise RuntimeError(f"it has sunwidget {__version__}, the batch is run by {job.version}")
    with _one_at_a_time:
        begin = time.perf_counter()
        where = f"{socket.gethostname()}:{os.getpid()}"
        notes: list[str] = []
        try:
            files = _files(job, notes, progress)
        except _UnseenError:
            return Outcome(job.number, unseen=True, worker=where)
        except _Stopped as stopped:
            raise stopped.reason from None
        except RendererError:
            raise
        except MemoryError:
            error = "There was not enough memory for this photo. Use fewer workers."
        except Exception as wrong:  # noqa: BLE001 - a failed photo is reported, and the rest is done
            error = sentence(wrong)
        else:
            seconds = time.perf_counter() - begin
            return Outcome(job.number, files, notes=tuple(notes), seconds=seconds, worker=where)
        seconds = time.perf_counter() - begin
        return Outcome(job.number, error=error, notes=tuple(notes), seconds=seconds, worker=where)


def sentence(error: BaseException) -> str:
    """Return an error as one line; our own errors are sentences, others get their type's name."""
    text = " ".join(str(error).split())
    if type(error).__module__.startswith("sunwidget"):
        return text
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


class _UnseenError(Exception):
    """The photo's path does not lead to the photo here."""


class _Stopped(BaseException):
    """What ``progress`` raised: it ends the batch and is no failure of the photo."""

    def __init__(self, reason: Exception) -> None:
        super().__init__(reason)
        self.reason = reason


def _files(job: Job, notes: list[str], progress: Progress | None) -> dict[str, bytes]:
    limit_threads(job.threads)
    with tempfile.TemporaryDirectory(prefix="sunwidget-", dir=_scratch()) as folder:
        photo = _photo(job, Path(folder))
        results = Path(folder) / "results"
        results.mkdir()
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            try:
                scene_notes = _save(job, photo, results / Path(job.output).name, progress)
            finally:
                # Not once a photo and a library: only what sunwidget itself says is for people.
                own = [str(w.message) for w in heard if _is_ours(w.category)]
                notes.extend(dict.fromkeys(own))
        notes.extend(note for note in scene_notes if note not in notes)
        parent = Path(job.output).parent
        main = Path(job.output).name
        names = sorted((p.name for p in results.iterdir()), key=lambda name: (name == main, name))
        return {str(parent / name): (results / name).read_bytes() for name in names}


def _is_ours(category: type[Warning]) -> bool:
    return category.__module__.startswith("sunwidget")


def _save(job: Job, photo: Path, path: Path, progress: Progress | None) -> tuple[str, ...]:
    from sunwidget.analysis.analyze import analyze
    from sunwidget.export.stills import save
    from sunwidget.photo.decode_apart import open_apart

    wish = job.wish
    report = _stopping(progress)
    scene = analyze(open_apart(photo), progress=part(report, 0.0, 0.6), **wish.analysis)
    edit = wish.edit_of(scene)
    own = scene.photo.size
    size = own if wish.long_edge is None else scene.photo.size_within(wish.long_edge)
    rest = part(report, 0.6, 1.0)
    save((scene, edit), path, size=None if size == own else size, progress=rest, **wish.options)
    return scene.warnings


def _stopping(progress: Progress | None) -> Progress:
    """Return ``progress`` in such a way that what it raises ends the batch, not this photo."""

    def report(fraction: float, message: str) -> None:
        if progress is None:
            return
        try:
            progress(fraction, message)
        except Exception as reason:
            raise _Stopped(reason) from reason

    return report


def _photo(job: Job, folder: Path) -> Path:
    """Return where the photo can be read: its own path, or a copy of the bytes that came."""
    if job.data is None:
        path = Path(job.path)
        try:
            seen = digest_of(path) == job.digest
        except OSError:
            seen = False
        if not seen:
            raise _UnseenError
        return path
    copy = folder / Path(job.path).name  # the name tells the kind of a raw file
    copy.write_bytes(job.data)
    return copy


def digest_of(path: Path) -> str:
    """Return the SHA-256 of a file."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def limit_threads(count: int | None) -> None:
    """Let OpenCV, the networks and Mesa's software rendering use ``count`` threads at most."""
    if count is None:
        return
    import cv2

    cv2.setNumThreads(count)  # the networks follow it (analysis/networks/onnx_file.py)
    # Mesa reads it when the context is made, with the first photo.
    os.environ.setdefault("LP_NUM_THREADS", str(count))


def _scratch() -> str | None:
    """Return Dask's folder of this worker, which goes away with it; else the system's own."""
    try:
        from distributed import get_worker

        return str(get_worker().local_directory)
    except (ImportError, ValueError):  # no Dask, or not on a worker
        return None
