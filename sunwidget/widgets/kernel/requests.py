"""Answer the browser's requests. The browser's twin is ``js/src/host/channel.js``.

Every request has an id and gets exactly one response, errors included; progress may come
before it. Work runs on a thread of its own, so that a long export blocks no slider. Cancelled
work ends where it tells its progress next.

browser → kernel  ``{type: "request", id, action, …}``
                  ``{type: "cancel", id}``
kernel → browser  ``{type: "progress", id, fraction, message}``
                  ``{type: "piece", id}`` with a buffer that comes before the response's own
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

# Buffers beyond this travel in messages of their own: one very large message breaks connections.
_MESSAGE_BYTES = 16_000_000


class Cancelled(Exception):  # noqa: N818 - a person's wish, no error
    """The work was cancelled: raised in it where it tells its progress."""


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
        self._running: dict[str, threading.Event] = {}  # set: to be cancelled

    def __call__(self, _widget: Any, content: Any, buffers: Any) -> None:
        """Take a custom message; anything but a request is somebody else's.

        An action finds the message's buffers in its content.
        """
        if not isinstance(content, dict):
            return
        if content.get("type") == "cancel":
            self.cancel(str(content.get("id")))
        if content.get("type") != "request":
            return
        with self._lock:
            key = str(content.get("id"))
            if key in self._running:  # the message came twice
                return
            self._running[key] = threading.Event()  # so that it can be cancelled from now on
        background.start(self._answer, {**content, "buffers": buffers}, name="sunwidget-request")

    def cancel(self, key: str | None = None) -> None:
        """Cancel the request with this id, or all that are under way."""
        with self._lock:
            for own, wish in self._running.items():
                if key in {None, own}:
                    wish.set()

    def _wish(self, content: dict[str, Any]) -> threading.Event:
        with self._lock:
            return self._running.setdefault(str(content.get("id")), threading.Event())

    def _answer(self, content: dict[str, Any]) -> None:
        key, name = content.get("id"), content.get("action")
        wish = self._wish(content)

        def progress(fraction: float, message: str) -> None:
            if wish.is_set() or background.leaving():
                raise Cancelled(f"{str(name).capitalize()} was cancelled.")
            self._send({"type": "progress", "id": key, "fraction": fraction, "message": message})

        result: dict[str, Any] | None = None
        error: str | None = None
        buffers: list[bytes] = []
        try:
            if name not in self._actions:
                raise ValueError(f"The kernel has no action {name!r:.40}.")
            result, buffers = self._actions[name](content, progress)
        except Exception as caught:  # noqa: BLE001 - whatever it is, the person must read it
            error = str(caught) or type(caught).__name__
        finally:
            with self._lock:
                self._running.pop(str(key), None)
        if background.leaving():
            return
        while len(buffers) > 1 and sum(map(len, buffers)) > _MESSAGE_BYTES:
            if wish.is_set():  # nobody listens any more
                buffers = []
                break
            self._send({"type": "piece", "id": key}, buffers[:1])
            buffers = buffers[1:]
        self._send({"type": "response", "id": key, "result": result, "error": error}, buffers)
