"""Answer the browser's requests. The browser's twin is ``js/src/channel.js``.

Every request has an id and gets exactly one response, errors included; progress may come
before it. Work runs on a thread of its own, so that a long export blocks no slider.

browser → kernel  ``{type: "request", id, action, …}``
kernel → browser  ``{type: "progress", id, fraction, message}``
                  ``{type: "response", id, result, error}`` with buffers
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

Progress = Callable[[float, str], None]
Answer = tuple[dict[str, Any], list[bytes]]
Action = Callable[[dict[str, Any], Progress], Answer]


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

    def __call__(self, _widget: Any, content: Any, _buffers: Any) -> None:
        """Take a custom message; anything but a request is somebody else's."""
        if not isinstance(content, dict) or content.get("type") != "request":
            return
        thread = threading.Thread(target=self._answer, args=(content,), daemon=True)
        thread.start()

    def _answer(self, content: dict[str, Any]) -> None:
        key, name = content.get("id"), content.get("action")

        def progress(fraction: float, message: str) -> None:
            self._send({"type": "progress", "id": key, "fraction": fraction, "message": message})

        result: dict[str, Any] | None = None
        error: str | None = None
        buffers: list[bytes] = []
        try:
            if name not in self._actions:
                raise ValueError(f"The kernel knows no action {name!r:.40}.")
            result, buffers = self._actions[name](content, progress)
        except Exception as caught:  # noqa: BLE001 - whatever it is, the person must read it
            error = str(caught) or type(caught).__name__
        self._send({"type": "response", "id": key, "result": result, "error": error}, buffers)
