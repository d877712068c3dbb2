"""Open untrusted picture files in a separate process with limited memory and time.

Decoders are C code that reads untrusted data. In batches, time-lapses and uploads, a file whose
decoder crashes, hangs or takes all memory fails alone, and the work goes on. The process stays
alive for the next file; a dead one is replaced.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import signal
import subprocess
import sys
import threading
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from sunwidget.errors import PhotoError, PhotoWarning
from sunwidget.photo.photo import Photo, open_photo
from sunwidget.photo.sources import read_file

MEMORY = 8 << 30
"""Most bytes for decoding one picture, if the system can limit them."""

SECONDS = 180.0
"""Most seconds for decoding one picture. A raw file of 100 million pixels takes about 30 s."""

_PROCESSOR = 600  # seconds over all cores; a fallback if the parent process is gone
_COMMAND = (
    sys.executable,
    "-P",
    "-m",
    "sunwidget.photo.decode_child",
)  # -P: import nothing from the working folder
_lock = threading.Lock()
_kept: list[_Child] = []


def open_apart(source: Any) -> Photo:
    """Open a photo as ``sunwidget.open`` does, but decode files in a separate process.

    Parameters
    ----------
    source
        As for ``sunwidget.open``. Arrays, Pillow images and Photos are opened in this process.

    Returns
    -------
    Photo

    Raises
    ------
    PhotoError
        As ``sunwidget.open``, and for a file whose decoder crashes, takes longer than ``SECONDS``
        or needs more than ``MEMORY``.

    Warns
    -----
    PhotoWarning
        As ``sunwidget.open``.
    """
    found = None if isinstance(source, Photo) else read_file(source)
    if found is None:
        return open_photo(source)
    name, data = found
    with _lock:
        photo = _child().open(name, data)
    for note in photo.notes:
        warnings.warn(note, PhotoWarning, stacklevel=2)
    return photo


def release() -> None:
    """End the process that waits for the next file; the next call starts a new one."""
    with _lock:
        while _kept:
            _kept.pop().end()


@contextlib.contextmanager
def keep_process() -> Iterator[None]:
    """Keep the process while many files are opened, and end it after the last."""
    try:
        yield
    finally:
        release()


def _child() -> _Child:
    while _kept and not _kept[0].alive():
        _kept.pop().end()
    if not _kept:
        _kept.append(_Child())
    return _kept[0]


class _Child:
    """A process that decodes one picture after another; see :mod:`sunwidget.photo.decode_child`."""

    def __init__(self) -> None:
        import sunwidget

        # The child imports the same sunwidget, even from a checkout that is not installed.
        home = str(Path(sunwidget.__file__).parents[1])
        path = os.pathsep.join([home, *filter(None, [os.environ.get("PYTHONPATH")])])
        # One malloc arena per thread would waste the limited address space.
        extra = {"PYTHONPATH": path, "MALLOC_ARENA_MAX": "2", "OPENBLAS_NUM_THREADS": "1"}
        self._owner = os.getpid()
        try:
            self._process = subprocess.Popen(  # noqa: S603 - no shell, no word of a photo
                [*_COMMAND, str(MEMORY), str(_PROCESSOR)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                env=os.environ | extra,
            )
        except OSError as error:
            raise PhotoError(
                f"The process that reads photos could not be started ({error.strerror}). Close "
                "other programs and try again."
            ) from error

    def alive(self) -> bool:
        """Return whether the process runs and was started by this process."""
        return self._owner == os.getpid() and self._process.poll() is None

    def open(self, name: str, data: bytes) -> Photo:
        """Decode a picture in the child process.

        Raises
        ------
        PhotoError
            If the picture cannot be decoded, or the process fails in any way.
        """
        from sunwidget.photo.decode_child import receive, receive_photo, send

        assert self._process.stdin is not None
        assert self._process.stdout is not None
        late = threading.Event()
        timer = threading.Timer(SECONDS, self._give_up, (late,))
        timer.daemon = True
        timer.start()
        try:
            send(self._process.stdin, {"name": name, "length": len(data)}, data)
            head = receive(self._process.stdout)
            if "error" in head:
                raise PhotoError(str(head["error"]))
            return receive_photo(self._process.stdout, head)
        except PhotoError:
            raise
        except (OSError, EOFError, ValueError, TypeError, KeyError, RecursionError) as error:
            raise PhotoError(self._explain_failure(name, late=late.is_set())) from error
        except BaseException:  # Ctrl-C before the answer: the next request would receive it
            self.end()
            raise
        finally:
            timer.cancel()

    def _give_up(self, late: threading.Event) -> None:
        late.set()
        self._process.kill()

    def _explain_failure(self, name: str, *, late: bool) -> str:
        """End the process and return why it gave no photo."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(1)
        code = self._process.poll()
        self.end()
        if late or code == -getattr(signal, "SIGXCPU", 0):
            return (
                f"Reading {name} was stopped: it took longer than {SECONDS:g} s. Save it again in "
                "another program."
            )
        how = "without a message" if code is None or code >= 0 else _signal(-code)
        return (
            f"{name} crashed the process that read it ({how}): it is damaged, or needs more than "
            f"{MEMORY / 2**30:g} GB of memory. Copy it again, or save it again in another program."
        )

    def end(self) -> None:
        """Kill the process; it has no state worth saving."""
        if self._owner != os.getpid():
            return
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout):
            with contextlib.suppress(OSError):  # unread data is discarded
                if stream is not None:
                    stream.close()


def _signal(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


atexit.register(release)
