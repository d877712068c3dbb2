"""The edit of a widget with its history: one undo over everything, and named versions.

All of it is synchronised traits, so it is the same from Python, from the browser and in a second
view, and comes back when the page is loaded again. Whoever makes a step writes the history: the
browser for its gestures, this class for what Python sets.
"""

from __future__ import annotations

import contextlib
import json
import threading
from collections.abc import Iterator
from typing import Any

import anywidget
import traitlets

from sunwidget.edit import PARAMETERS, Edit
from sunwidget.widgets.edit_traits import edit_traits

NAMES = tuple(p.name for p in PARAMETERS)
HISTORY_LENGTH = 100
# Every step repeats all strokes, and a message of 10 MiB would break the connection.
HISTORY_BYTES = 2_000_000

Recipe = dict[str, Any]


class EditHistory(anywidget.AnyWidget):
    """A widget whose traits are the parameters of an ``Edit``.

    Parameters
    ----------
    start : Edit
        What the traits begin with; no step of the history.
    **state
        Values of other traits.
    """

    # Recipes before and after the present one.
    _history = traitlets.Dict().tag(sync=True)

    # One trait a row of the table; a class body's locals() is the class's own dictionary.
    locals().update(edit_traits())

    def __init__(self, start: Edit, **state: Any) -> None:
        self._lock = threading.RLock()
        self._browser_thread: int | None = None
        self._applying = False
        self._committed = start
        values = {name: getattr(start, name) for name in NAMES}
        super().__init__(_history={"past": [], "future": []}, **values, **state)
        self.observe(self._on_edit, list(NAMES))

    @property
    def edit(self) -> Edit:
        """The traits as an ``Edit``. Assign an ``Edit`` or a recipe to set them all in one step."""
        return Edit(**{name: getattr(self, name) for name in NAMES})

    @edit.setter
    def edit(self, value: Edit | Recipe) -> None:
        self._step(edit_of(value))

    def undo(self) -> None:
        """Take back the last step, whether made here or in the browser."""
        with self._lock:
            past, future = self._steps()
            if past:
                self._travel(past[-1], past[:-1], [self.edit.to_dict(), *future])

    def redo(self) -> None:
        """Make the last undone step again."""
        with self._lock:
            past, future = self._steps()
            if future:
                self._travel(future[0], [*past, self.edit.to_dict()], future[1:])

    def reset(self) -> None:
        """Set every parameter to its default, as one step: the photo as it was."""
        self._step(Edit())

    def set_state(self, sync_data: dict[str, Any]) -> None:
        """Take over what the browser sent; a value that is refused is answered, not raised."""
        with self._lock:
            self._browser_thread = threading.get_ident()
            try:
                super().set_state(sync_data)
            except traitlets.TraitError as error:
                self.send({"type": "error", "error": str(error)})
                self.send_state([name for name in sync_data if name in self.keys])
            finally:
                self._browser_thread = None
                self._committed = self.edit

    def _steps(self) -> tuple[list[Recipe], list[Recipe]]:
        return list(self._history.get("past", [])), list(self._history.get("future", []))

    def _remember(self, before: Edit) -> None:
        past, _ = self._steps()
        self._history = {"past": newest([*past, before.to_dict()]), "future": []}

    def _step(self, edit: Edit) -> None:
        with self._lock:
            before = self.edit
            if edit != before:
                self._remember(before)
                self._apply(edit)

    def _travel(self, recipe: Recipe, past: list[Recipe], future: list[Recipe]) -> None:
        edit = Edit.from_dict(recipe)
        self._history = {"past": past, "future": future}
        self._apply(edit)

    def _apply(self, edit: Edit) -> None:
        with self._quietly(), self.hold_sync():
            for name in NAMES:
                setattr(self, name, getattr(edit, name))
        self._committed = edit

    @contextlib.contextmanager
    def _quietly(self) -> Iterator[None]:
        self._applying = True
        try:
            yield
        finally:
            self._applying = False

    def _on_edit(self, _change: Any) -> None:
        if self._applying or self._browser_thread == threading.get_ident():
            return
        with self._lock:
            edit = self.edit
            # Several values may have been set at once; their notifications come one by one.
            if edit != self._committed:
                self._remember(self._committed)
                self._committed = edit


def edit_of(recipe: Edit | Recipe | None) -> Edit:
    """Return what may be given as a recipe as an ``Edit``; None is one that moves nothing."""
    if recipe is None:
        return Edit()
    return recipe if isinstance(recipe, Edit) else Edit.from_dict(recipe)


def newest(steps: list[Recipe]) -> list[Recipe]:
    """Return the last steps, as many as may be kept; twin of ``newest`` in ``js/src/state.js``."""
    kept: list[Recipe] = []
    size = 0
    for recipe in reversed(steps[-HISTORY_LENGTH:]):
        size += len(json.dumps(recipe))
        if kept and size > HISTORY_BYTES:
            break
        kept.append(recipe)
    return kept[::-1]
