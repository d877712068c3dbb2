"""One worker thread that makes and owns the GL context.

A moderngl context belongs to the thread that made it, while JupyterLab calls a widget's
handlers on several threads; so every GL call of the kernel is sent to this one.
"""

from __future__ import annotations

import atexit
import os
import sys
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, TypeVar

from sunwidget.renderer.missing_gl import explain

if TYPE_CHECKING:
    import moderngl

T = TypeVar("T")

_MOST_DEVICES = 8


class RendererError(RuntimeError):
    """The kernel's renderer cannot work; the message says what is missing."""


class _Worker:
    def __init__(self) -> None:
        self.pid = os.getpid()
        self.pool = ThreadPoolExecutor(max_workers=1, thread_name_prefix="sunwidget-gl")
        self.thread: int | None = None
        self.context: moderngl.Context | None = None

    def make_context(self) -> moderngl.Context:
        self.thread = threading.get_ident()
        if self.context is None:
            try:
                self.context = _new_context()
            except Exception as error:  # moderngl raises bare Exception here
                raise RendererError(explain(error)) from error
            # Dropping a Python wrapper frees its GL object at the next ctx.gc() on this
            # thread; "auto" would call GL from whichever thread drops it.
            self.context.gc_mode = "context_gc"
        self.context.gc()
        return self.context


def _new_context() -> moderngl.Context:
    """Make a context on the first device that gives one.

    Devices come with the graphics cards first and software drawing last. A card that may not
    be used (a container without its driver, a person outside the group "render") must not
    keep the others from working.
    """
    import moderngl

    if not sys.platform.startswith("linux"):  # EGL is Linux's; elsewhere the system's own way
        return moderngl.create_context(standalone=True, require=330)
    first: Exception | None = None
    # A device that a person chose stays chosen: glcontext takes it from the variable.
    for device in range(1 if "GLCONTEXT_DEVICE_INDEX" in os.environ else _MOST_DEVICES):
        try:
            return moderngl.create_context(
                standalone=True, backend="egl", require=330, device_index=device
            )
        except Exception as error:  # noqa: BLE001 - glcontext raises nothing finer
            first = first or error
            if not str(error).startswith("egl"):  # no such device, or no EGL at all
                break
    assert first is not None
    raise first


_worker: _Worker | None = None
_lock = threading.Lock()


def on_gl_thread(task: Callable[[moderngl.Context], T]) -> T:
    """Run ``task(context)`` on the GL thread and return its result or raise its error.

    Raises
    ------
    RendererError
        When no EGL context can be made on this machine.
    """
    global _worker
    with _lock:
        # A forked child inherits the object but not the thread: start afresh.
        if _worker is None or _worker.pid != os.getpid():
            _worker = _Worker()
            atexit.register(_worker.pool.shutdown, wait=False)
        worker = _worker
    if threading.get_ident() == worker.thread:
        return task(worker.make_context())
    return worker.pool.submit(lambda: task(worker.make_context())).result()
