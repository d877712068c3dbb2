"""How a command ends: it cleans up after a signal and reports an error in one line."""

from __future__ import annotations

import contextlib
import io
import os
import signal
import sys
import threading
from collections.abc import Iterator
from types import FrameType
from typing import NoReturn

from sunwidget.messages import printable

_LONGEST = 800  # characters: a flag's value may be a whole file


class StoppedError(BaseException):
    """The system asked the command to stop; unfinished files are removed on the way out."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.status = 128 + number


@contextlib.contextmanager
def raise_on_signals() -> Iterator[None]:
    """Let SIGTERM and SIGHUP raise an error, so that the command removes unfinished files."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    # Ignored signals stay ignored, such as SIGHUP under nohup.
    numbers = (getattr(signal, name, None) for name in ("SIGTERM", "SIGHUP"))
    asked = [n for n in numbers if n is not None and signal.getsignal(n) is signal.SIG_DFL]
    for number in asked:
        signal.signal(number, _end)
    try:
        yield
    finally:
        for number in asked:
            signal.signal(number, signal.SIG_DFL)


def _end(number: int, _frame: FrameType | None) -> NoReturn:
    signal.signal(number, signal.SIG_IGN)  # once: cleaning up must not be interrupted
    raise StoppedError(number)


def one_line(words: object) -> str:
    """Return an error or a warning as one line without control characters."""
    if isinstance(words, OSError) and words.strerror:
        name = "" if words.filename is None else f": {words.filename}"
        words = f"{words.strerror}{name}."
    text = printable(" ".join(str(words).split())) or type(words).__name__
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"


def accept_any_file_name() -> None:
    """Let standard output print every file name, even one that is not valid text."""
    if isinstance(sys.stdout, io.TextIOWrapper) and sys.stdout.errors == "strict":
        sys.stdout.reconfigure(errors="backslashreplace")


def discard_output() -> int:
    """Discard further output and return the exit status of a broken pipe (``| head``)."""
    # The flush at exit must not fail again.
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 128 + getattr(signal, "SIGPIPE", 13)
