"""How a command of the command line ends: in order, and with one line when something is wrong."""

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

_LONGEST = 800  # signs: a flag's value may be a whole file


class EndedError(BaseException):
    """The system asked the command to end; what is half-made goes on the way out."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.status = 128 + number


@contextlib.contextmanager
def ended_in_order() -> Iterator[None]:
    """Let SIGTERM and SIGHUP end the command like an error, so that it leaves nothing half-made."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    # What is ignored, as SIGHUP is under nohup, stays ignored.
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
    signal.signal(number, signal.SIG_IGN)  # once: the way out is not to be cut short
    raise EndedError(number)


def one_line(words: object) -> str:
    """Return an error or a warning as one line that a terminal only shows."""
    if isinstance(words, OSError) and words.strerror:
        name = "" if words.filename is None else f": {words.filename}"
        words = f"{words.strerror}{name}."
    text = printable(" ".join(str(words).split())) or type(words).__name__
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 1]}…"


def print_anything() -> None:
    """Make standard output take every file name, also one that is no text."""
    if isinstance(sys.stdout, io.TextIOWrapper) and sys.stdout.errors == "strict":
        sys.stdout.reconfigure(errors="backslashreplace")


def nobody_reads() -> int:
    """Return the status of a command whose output's reader has gone, as ``| head`` goes."""
    # What is still to be flushed at the end must not fail once more.
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 128 + getattr(signal, "SIGPIPE", 13)
