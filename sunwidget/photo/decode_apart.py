"""Foreign picture files opened in a process of their own, within memory and time.

A decoder is C code that reads what anybody may have written. Where files come in that nobody has
looked at (batches, time-lapses, uploads) one that crashes, hangs or takes all memory costs that
one file and not the work. The process stays for the next file; one that died is replaced.
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
from sunwidget.photo.sources import file_of

MEMORY = 8 << 30
"""Bytes that decoding one picture may take, where the system can limit them."""

SECONDS = 180.0
"""How long one picture may take. A raw file of 100 million pixels takes some 30 s."""

_PROCESSOR = 600  # seconds of all cores together; a backstop should this process be gone
_COMMAND = (
    sys.executable,
    "-P",
    "-m",
    "sunwidget.photo.decode_child",
)  # -P: nothing from the folder
_lock = threading.Lock()
_kept: list[_Child] = []


def open_apart(source: Any) -> Photo:
    """Open a photo as ``sunwidget.open`` does, a file in a process of its own.

    Parameters
    ----------
    source
        As for ``sunwidget.open``. Arrays, Pillow images and Photos are no foreign files and are
        taken as there.

    Returns
    -------
    Photo

    Raises
    ------
    PhotoError
        As ``sunwidget.open``; and for a file whose decoder crashes, takes longer than ``SECONDS``
        or more than ``MEMORY``.

    Warns
    -----
    PhotoWarning
        As ``sunwidget.open``.
    """
    found = None if isinstance(source, Photo) else file_of(source)
    if found is None:
        return open_photo(source)
    name, data = found
    with _lock:
        photo = _child().open(name, data)
    for note in photo.notes:
        warnings.warn(note, PhotoWarning, stacklevel=2)
    return photo


def release() -> None:
    """End the process that is kept for the next file; one is started again when it is needed."""
    with _lock:
        while _kept:
            _kept.pop().end()


@contextlib.contextmanager
def kept() -> Iterator[None]:
    """Keep the process while many files are opened, and end it with the last."""
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

        # The very sunwidget that asks, also from a checkout that is not installed.
        home = str(Path(sunwidget.__file__).parents[1])
        path = os.pathsep.join([home, *filter(None, [os.environ.get("PYTHONPATH")])])
        # An arena a thread would take address space, which is limited, for nothing.
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
                f"No process could be started to read photos in ({error.strerror}). Close other "
                "programs and try again."
            ) from error

    def alive(self) -> bool:
        """Whether it can be asked: it runs, and this process is the one that started it."""
        return self._owner == os.getpid() and self._process.poll() is None

    def open(self, name: str, data: bytes) -> Photo:
        """Have a picture decoded.

        Raises
        ------
        PhotoError
            When it cannot be, whatever happened to the process.
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
            raise PhotoError(self._ending(name, late=late.is_set())) from error
        except BaseException:  # Ctrl-C between question and answer: the next one would get it
            self.end()
            raise
        finally:
            timer.cancel()

    def _give_up(self, late: threading.Event) -> None:
        late.set()
        self._process.kill()

    def _ending(self, name: str, *, late: bool) -> str:
        """Return why there is no photo, once the process is gone."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(1)
        code = self._process.poll()
        self.end()
        if late or code == -getattr(signal, "SIGXCPU", 0):
            return (
                f"{name} was given up: reading it took longer than {SECONDS:g} s. Save it anew in "
                "another program."
            )
        how = "without a word" if code is None or code >= 0 else _signal(-code)
        return (
            f"{name} ended the process that read it ({how}): it is damaged, or needs more than "
            f"{MEMORY / 2**30:g} GB of memory. Copy it again, or save it anew in another program."
        )

    def end(self) -> None:
        """Kill the process; all that is worth keeping is here."""
        if self._owner != os.getpid():
            return
        self._process.kill()
        self._process.wait()
        for stream in (self._process.stdin, self._process.stdout):
            with contextlib.suppress(OSError):  # what was not read by it is thrown away
                if stream is not None:
                    stream.close()


def _signal(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


atexit.register(release)
