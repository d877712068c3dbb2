"""Answer the browser's requests. The browser's twin is ``js/src/host/channel.js``.

Every request has an id and gets exactly one response, errors included; progress may precede it.
Each request runs on its own thread, so that a long export does not block a slider. Cancelled work
ends at its next progress report.

browser → kernel  ``{type: "request", id, action, …}``
                  ``{type: "cancel", id}``
kernel → browser  ``{type: "progress", id, fraction, message}``
                  ``{type: "piece", id}`` with a buffer that precedes the response's own
                  ``{type: "response", id, result, error}`` with buffers
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from sunwidget.progress import Progress
from sunwidget.widgets.kernel import background

Answer = tuple[dict[str, Any], list[bytes]]
Action = Callable[[dict[str, Any], Progress], Answer]

# Larger buffers are sent in separate messages: one very large message breaks connections.
_MESSAGE_BYTES = 16_000_000


class Cancelled(Exception):  # noqa: N818 - requested by the user, not an error
    """The work was cancelled; raised where it reports its progress."""


class Requests:
    """Routes requests to actions by name.

    Parameters
    ----------
    send : callable
        The widget's ``send(content, buffers)``.
    actions : dict
        ``action(content, progress) -> (result, buffers)`` by name.
    """

    def __init__(self, send: Callable[..., None], actions: dict[str, Action]) -> None:
        self._send = send
        self._actions = actions
        self._lock = threading.Lock()
        self._running: dict[str, threading.Event] = {}  # set when cancelled

    def __call__(self, _widget: Any, content: Any, buffers: Any) -> None:
        """Handle a custom message; ignore all but requests and cancellations.

        An action receives the message's buffers in its content.
        """
        if not isinstance(content, dict):
            return
        if content.get("type") == "cancel":
            self.cancel(str(content.get("id")))
        if content.get("type") != "request":
            return
        with self._lock:
            key = str(content.get("id"))
            if key in self._running:  # the message arrived twice
                return
            self._running[key] = threading.Event()  # allows cancelling from now on
        background.start(self._answer, {**content, "buffers": buffers}, name="sunwidget-request")

    def cancel(self, key: str | None = None) -> None:
        """Cancel the request with this id, or all running requests."""
        with self._lock:
            for own, cancelled in self._running.items():
                if key in {None, own}:
                    cancelled.set()

    def _cancel_event(self, content: dict[str, Any]) -> threading.Event:
        with self._lock:
            return self._running.setdefault(str(content.get("id")), threading.Event())

    def _answer(self, content: dict[str, Any]) -> None:
        key, name = content.get("id"), content.get("action")
        cancelled = self._cancel_event(content)

        def progress(fraction: float, message: str) -> None:
            if cancelled.is_set() or background.leaving():
                raise Cancelled(f"{str(name).capitalize()} was cancelled.")
            self._send({"type": "progress", "id": key, "fraction": fraction, "message": message})

        result: dict[str, Any] | None = None
        error: str | None = None
        buffers: list[bytes] = []
        try:
            if name not in self._actions:
                raise ValueError(f"The kernel has no action {name!r:.40}.")
            result, buffers = self._actions[name](content, progress)
        except Exception as caught:  # noqa: BLE001 - the browser shows every error
            error = str(caught) or type(caught).__name__
        finally:
            with self._lock:
                self._running.pop(str(key), None)
        if background.leaving():
            return
        while len(buffers) > 1 and sum(map(len, buffers)) > _MESSAGE_BYTES:
            if cancelled.is_set():  # the browser no longer waits
                buffers = []
                break
            self._send({"type": "piece", "id": key}, buffers[:1])
            buffers = buffers[1:]
        self._send({"type": "response", "id": key, "result": result, "error": error}, buffers)
