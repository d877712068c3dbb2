"""Background threads of widgets, which end before Python does.

A daemon thread that is inside a C++ library when the interpreter exits is killed there, which
aborts the process ("terminate called without an active exception"). At exit, all threads are
therefore signaled and joined.
"""

from __future__ import annotations

import atexit
import threading
import time
import weakref
from collections.abc import Callable
from typing import Any

_PATIENCE = 10.0  # seconds for all threads together; the longest step of an analysis takes a few

_running: weakref.WeakSet[threading.Thread] = weakref.WeakSet()
_leaving = threading.Event()


def start(work: Callable[..., Any], *args: Any, name: str) -> None:
    """Call ``work(*args)`` on a new thread; it should check ``leaving`` regularly."""
    thread = threading.Thread(target=work, args=args, name=name, daemon=True)
    _running.add(thread)
    thread.start()


def leaving() -> bool:
    """Return whether Python is about to exit, so that work should stop."""
    return _leaving.is_set()


@atexit.register
def _wait() -> None:
    _leaving.set()
    end = time.monotonic() + _PATIENCE
    for thread in list(_running):
        thread.join(max(0.0, end - time.monotonic()))
