"""One worker thread that makes and owns the GL context.

A moderngl context belongs to the thread that made it, while JupyterLab calls a widget's
handlers on several threads; so every GL call of the kernel is sent to this one.
"""

from __future__ import annotations

import atexit
import os
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    import moderngl

T = TypeVar("T")

_EGL_HELP = (
    "sunwidget renders exports with OpenGL through EGL, and no EGL context could be made: {why}\n"
    "On Debian or Ubuntu: apt-get install libegl1 libgl1 libegl-mesa0 libgl1-mesa-dri\n"
    "`sunwidget doctor` shows what was found."
)


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
                import moderngl

                self.context = moderngl.create_context(standalone=True, backend="egl", require=330)
            except Exception as error:  # moderngl raises bare Exception here
                raise RendererError(_EGL_HELP.format(why=error)) from error
            # Dropping a Python wrapper frees its GL object at the next ctx.gc() on this
            # thread; "auto" would call GL from whichever thread drops it.
            self.context.gc_mode = "context_gc"
        self.context.gc()
        return self.context


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
