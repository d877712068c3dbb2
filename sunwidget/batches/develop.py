"""Development of one photo of a batch, from its file to the bytes of its pictures.

A worker returns bytes; only the process that runs the batch writes into the output folder. A worker
may therefore die at any moment or run on another machine, and no picture is written twice or in
part.
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

from sunwidget.batches.request import Request
from sunwidget.progress import Progress, part
from sunwidget.version import __version__

# Two photos at a time would take twice the memory but share one GL context.
_one_at_a_time = threading.Lock()


@dataclass(frozen=True)
class Job:
    """One photo to be developed.

    ``path`` is absolute; ``digest`` is the SHA-256 of its bytes; ``data`` holds the bytes for a
    worker that cannot read the path; ``output`` is the name of the picture; ``threads`` limits the
    libraries' threads, None does not.
    """

    number: int
    path: str
    digest: str
    output: str
    request: Request
    data: bytes | None = field(default=None, repr=False)
    threads: int | None = None
    version: str = __version__


@dataclass(frozen=True)
class Outcome:
    """The result of a job: its files by name, the picture last, or an error message.

    ``unreadable`` means that this worker cannot read the photo and needs its bytes.
    """

    number: int
    files: dict[str, bytes] = field(default_factory=dict, repr=False)
    error: str = ""
    unreadable: bool = False
    notes: tuple[str, ...] = ()
    seconds: float = 0.0
    worker: str = ""


def develop(job: Job, progress: Progress | None = None) -> Outcome:
    """Open, analyze, render and encode one photo. Exceptions become the outcome's error.

    Raises
    ------
    RendererError
        When this machine cannot render: every other photo would fail as well.
    RuntimeError
        When another version of sunwidget started the batch.
    """
    from sunwidget.errors import RendererError

    if job.version != __version__:
        raise RuntimeError(f"it has sunwidget {__version__}, but the batch has {job.version}")
    with _one_at_a_time:
        begin = time.perf_counter()
        where = f"{socket.gethostname()}:{os.getpid()}"
        notes: list[str] = []
        try:
            files = _files(job, notes, progress)
        except _UnreadableError:
            return Outcome(job.number, unreadable=True, worker=where)
        except _CancelledError as stopped:
            raise stopped.reason from None
        except RendererError:
            raise
        except MemoryError:
            error = "Not enough memory for this photo. Use fewer workers."
        except Exception as wrong:  # noqa: BLE001 - a failed photo must not end the batch
            error = sentence(wrong)
        else:
            seconds = time.perf_counter() - begin
            return Outcome(job.number, files, notes=tuple(notes), seconds=seconds, worker=where)
        seconds = time.perf_counter() - begin
        return Outcome(job.number, error=error, notes=tuple(notes), seconds=seconds, worker=where)


def sentence(error: BaseException) -> str:
    """Return an error as one line, with its type unless it is one of sunwidget's own."""
    text = " ".join(str(error).split())
    if type(error).__module__.startswith("sunwidget"):
        return text
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


class _UnreadableError(Exception):
    """The photo cannot be read at its path on this machine."""


class _CancelledError(BaseException):
    """An exception of ``progress``, which ends the batch and is not a failure of the photo."""

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
                # Keep sunwidget's own warnings; those of libraries are not for users.
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

    request = job.request
    report = _cancel_on_error(progress)
    scene = analyze(open_apart(photo), progress=part(report, 0.0, 0.6), **request.analysis)
    edit = request.edit_of(scene)
    own = scene.photo.size
    size = own if request.long_edge is None else scene.photo.size_within(request.long_edge)
    rest = part(report, 0.6, 1.0)
    save((scene, edit), path, size=None if size == own else size, progress=rest, **request.options)
    return scene.warnings


def _cancel_on_error(progress: Progress | None) -> Progress:
    """Wrap ``progress`` so that its exceptions end the batch and not only this photo."""

    def report(fraction: float, message: str) -> None:
        if progress is None:
            return
        try:
            progress(fraction, message)
        except Exception as reason:
            raise _CancelledError(reason) from reason

    return report


def _photo(job: Job, folder: Path) -> Path:
    """Return a readable path of the photo: its own, or a copy of the received bytes."""
    if job.data is None:
        path = Path(job.path)
        try:
            readable = digest_of(path) == job.digest
        except OSError:
            readable = False
        if not readable:
            raise _UnreadableError
        return path
    copy = folder / Path(job.path).name  # the extension identifies the raw format
    copy.write_bytes(job.data)
    return copy


def digest_of(path: Path) -> str:
    """Return the SHA-256 of a file."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def limit_threads(count: int | None) -> None:
    """Limit OpenCV, the networks and Mesa's software rendering to ``count`` threads."""
    if count is None:
        return
    import cv2

    cv2.setNumThreads(count)  # the networks follow it (analysis/networks/onnx_file.py)
    # Mesa reads the variable when the context is created, with the first photo.
    os.environ.setdefault("LP_NUM_THREADS", str(count))


def _scratch() -> str | None:
    """Return this worker's Dask folder, deleted with the worker; None for the system's default."""
    try:
        from distributed import get_worker

        return str(get_worker().local_directory)
    except (ImportError, ValueError):  # no Dask, or not on a worker
        return None
