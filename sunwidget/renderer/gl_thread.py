"""One worker thread that creates and owns the GL context.

A moderngl context belongs to the thread that created it, but JupyterLab calls a widget's handlers
on several threads. Therefore all GL calls of the kernel run on this thread.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import struct
import sys
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, TypeVar

from sunwidget.errors import RendererError
from sunwidget.renderer.missing_gl import NO_FLOATS, explain

if TYPE_CHECKING:
    import moderngl

T = TypeVar("T")

_MOST_DEVICES = 8
# Errors after which the drawing is invalid; moderngl has no name for a lost context.
_FAILURES = ("GL_OUT_OF_MEMORY", "GL_INVALID_FRAMEBUFFER_OPERATION", "GL_UNKNOWN_ERROR")


class _Worker:
    def __init__(self) -> None:
        self.pid = os.getpid()
        self.pool = ThreadPoolExecutor(max_workers=1, thread_name_prefix="sunwidget-gl")
        self.thread: int | None = None
        self.context: moderngl.Context | None = None

    def run(self, task: Callable[[moderngl.Context], T]) -> T:
        """Run a task; if OpenGL fails, run it once more on a new context.

        A context is lost when the driver restarts or the graphics card sleeps. A new context
        also starts with free memory on the card.
        """
        try:
            return self._run_once(task)
        except _FailedError as failure:
            self._discard_context()
            first = failure
        try:
            return self._run_once(task)
        except _FailedError as failure:
            self._discard_context()
            raise RendererError(
                f"OpenGL failed twice while drawing: {first}; {failure}. A smaller size needs less "
                "memory on the graphics card; LIBGL_ALWAYS_SOFTWARE=1, set before Python starts, "
                "draws without the card."
            ) from failure

    def _run_once(self, task: Callable[[moderngl.Context], T]) -> T:
        context = self.make_context()
        try:
            result = task(context)
        except Exception as error:
            if type(error).__module__ == "_moderngl":
                raise _FailedError(str(error)) from error
            raise
        if (code := _error_of(context)) in _FAILURES:
            raise _FailedError(code)
        return result

    def _discard_context(self) -> None:
        context, self.context = self.context, None
        if context is not None:
            with contextlib.suppress(Exception):  # a lost context cannot be released
                context.release()

    def make_context(self) -> moderngl.Context:
        self.thread = threading.get_ident()
        if self.context is None:
            try:
                self.context = _new_context()
            except Exception as error:  # moderngl raises bare Exception here
                raise RendererError(explain(error)) from error
            # The GL object of a deleted wrapper is freed by the next ctx.gc() on this thread;
            # "auto" would call GL on the thread that deletes the wrapper.
            self.context.gc_mode = "context_gc"
        self.context.gc()
        return self.context


class _FailedError(Exception):
    """OpenGL failed; the message is its error."""


def _error_of(context: moderngl.Context) -> str:
    return context.error


def _new_context() -> moderngl.Context:
    """Create a context on the first device that works.

    Graphics cards come first and software drawing last. A card that cannot be used (a container
    without its driver, a user outside the group "render") must not block the others.
    """
    import moderngl

    if not sys.platform.startswith("linux"):  # EGL is for Linux; other systems have their own API
        return moderngl.create_context(standalone=True, require=330)
    first: Exception | None = None
    # glcontext reads this variable: a device that the user chose is the only one tried.
    for device in range(1 if "GLCONTEXT_DEVICE_INDEX" in os.environ else _MOST_DEVICES):
        try:
            context = moderngl.create_context(
                standalone=True, backend="egl", require=330, device_index=device
            )
        except Exception as error:  # noqa: BLE001 - glcontext raises bare Exceptions
            first = first or error
            if not str(error).startswith("egl"):  # no such device, or no EGL at all
                break
        else:
            if _draws_floats(context):
                return context
            context.release()
            first = first or RuntimeError(NO_FLOATS)
    assert first is not None
    raise first


def _draws_floats(context: moderngl.Context) -> bool:
    """Return whether passes can draw into float textures, as the frame's passes do."""
    try:
        texture = context.texture((1, 1), 4, dtype="f4")
        framebuffer = context.framebuffer([texture])
        framebuffer.clear(0.25, 2.0, -3.0, 1.0)
        drawn = struct.unpack("4f", texture.read())
    except Exception:  # noqa: BLE001 - moderngl.Error, or any error of such a driver
        return False
    return drawn == (0.25, 2.0, -3.0, 1.0)


_worker: _Worker | None = None
_lock = threading.Lock()


def on_gl_thread(task: Callable[[moderngl.Context], T]) -> T:
    """Run ``task(context)`` on the GL thread and return its result or raise its error.

    Raises
    ------
    RendererError
        If no EGL context can be created on this machine, or if OpenGL fails twice. The second
        run has a new context, so a task must look up its objects by the context that it gets.
    """
    global _worker
    with _lock:
        # A forked child inherits the object but not the thread: start a new one.
        if _worker is None or _worker.pid != os.getpid():
            _worker = _Worker()
            atexit.register(_worker.pool.shutdown, wait=False)
        worker = _worker
    if threading.get_ident() == worker.thread:
        return task(worker.make_context())
    return worker.pool.submit(worker.run, task).result()


def require_renderer() -> None:
    """Raise RendererError if this machine cannot draw, before long work that needs it."""
    on_gl_thread(lambda _context: None)
