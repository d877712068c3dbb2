"""What a notebook file keeps of a widget where a program runs and saves it.

Such programs (``jupyter nbconvert --execute``, papermill) store whatever a widget tells a browser,
and no browser listens: photo and maps would be megabytes that nobody looks at. What JupyterLab
saves is made light by the front end, ``js/src/host/saved_state.js``.
"""

from __future__ import annotations

from typing import Any

import anywidget

from sunwidget.widgets.kernel.output import unattended


class SavedLight(anywidget.AnyWidget):
    """A widget that tells a program's kernel what is worth keeping, and a person's everything."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        # Before the first message. Later ones are sent from threads, which belong to no cell.
        self._stored = unattended()
        super().__init__(*args, **kwargs)

    def get_state(self, key: Any = None, drop_defaults: bool = False) -> dict[str, Any]:
        """Return the traits as they are sent, and stored."""
        state = self.whole_state(key, drop_defaults)
        if not self._stored:
            return state
        light = self._light_state()
        kept = {name: light.get(name, value) for name, value in state.items()}
        return kept | {"_saved": "photo"} if key is None else kept

    def whole_state(self, key: Any = None, drop_defaults: bool = False) -> dict[str, Any]:
        """Return the traits as a page needs them.

        Parameters
        ----------
        key : str or iterable of str, optional
            Of the traits that are wanted, default all.
        drop_defaults : bool, default False
            Leave out those that are as in a new widget.
        """
        state: dict[str, Any] = super().get_state(key, drop_defaults)
        return state

    def _light_state(self) -> dict[str, Any]:
        """Return what stands for the heavy traits, by name."""
        raise NotImplementedError
