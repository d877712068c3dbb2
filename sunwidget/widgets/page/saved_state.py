"""The widget state that a notebook file keeps if a program runs and saves it.

Such programs (``jupyter nbconvert --execute``, papermill) store everything that a widget sends,
although no browser receives it: photo and maps would be megabytes that nobody sees. For JupyterLab
the front end reduces the saved state, ``js/src/host/saved_state.js``.
"""

from __future__ import annotations

from typing import Any

import anywidget

from sunwidget.widgets.kernel.output import unattended


class SavedLight(anywidget.AnyWidget):
    """A widget that sends a reduced state in a program's kernel, and all of it in a user's."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        # Set before the first message. Later ones are sent from threads, which belong to no cell.
        self._stored = unattended()
        super().__init__(*args, **kwargs)

    def get_state(self, key: Any = None, drop_defaults: bool = False) -> dict[str, Any]:
        """Return the traits as they are sent and stored."""
        state = self.whole_state(key, drop_defaults)
        if not self._stored:
            return state
        light = self._light_state()
        kept = {name: light.get(name, value) for name, value in state.items()}
        return kept | {"_saved": "photo"} if key is None else kept

    def whole_state(self, key: Any = None, drop_defaults: bool = False) -> dict[str, Any]:
        """Return the traits for a page.

        Parameters
        ----------
        key : str or iterable of str, optional
            Names of the requested traits; default all.
        drop_defaults : bool, default False
            Omit those with default values.
        """
        state: dict[str, Any] = super().get_state(key, drop_defaults)
        return state

    def _light_state(self) -> dict[str, Any]:
        """Return the replacements of the large traits, by name."""
        raise NotImplementedError
