"""The edit of a widget with a common undo history and named versions.

All of it is stored in synchronized traits, so that Python, the browser and a second view agree, and
a reloaded page restores it. The side that makes a step writes the history: the browser for
gestures, this class for values set in Python.
"""

from __future__ import annotations

import contextlib
import json
from collections.abc import Iterator
from typing import Any

import traitlets

from sunwidget.edit.recipe import edit_of
from sunwidget.edit.table import PARAMETERS, Edit
from sunwidget.errors import EditError
from sunwidget.messages import did_you_mean
from sunwidget.widgets.kernel.edit_traits import ChangedByBrowser, edit_traits

NAMES = tuple(p.name for p in PARAMETERS)
HISTORY_LENGTH = 100
# Every step contains all strokes, and a message of 10 MiB would break the connection.
HISTORY_BYTES = 2_000_000
VERSIONS = 100
NAME_LENGTH = 80

Recipe = dict[str, Any]


class EditHistory(ChangedByBrowser):
    """A widget whose traits are the parameters of an ``Edit``.

    Parameters
    ----------
    start : Edit
        Initial values of the traits; not a step of the history.
    **state
        Values of other traits.
    """

    # Recipes before and after the current one.
    _history = traitlets.Dict().tag(sync=True)
    # Named versions, oldest first: {"name": …, "recipe": …}.
    _versions: traitlets.List = traitlets.List().tag(sync=True)

    # One trait per row of the table; in a class body, locals() is the class namespace.
    locals().update(edit_traits())

    def __init__(self, start: Edit, **state: Any) -> None:
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
        """Undo the last step, made in Python or in the browser."""
        with self._lock:
            past, future = self._steps()
            if past:
                self._travel(past[-1], past[:-1], [self.edit.to_dict(), *future])

    def redo(self) -> None:
        """Redo the last undone step."""
        with self._lock:
            past, future = self._steps()
            if future:
                self._travel(future[0], [*past, self.edit.to_dict()], future[1:])

    def reset(self) -> None:
        """Set every parameter to its default, which shows the original photo, as one step."""
        self._step(Edit())

    @property
    def versions(self) -> dict[str, Edit]:
        """The edits kept by name, oldest first; see ``keep``."""
        return {v["name"]: Edit.from_dict(v["recipe"]) for v in self._versions}

    def keep(self, name: str, *, overwrite: bool = False) -> None:
        """Keep the current edit under a name, for ``go_to``.

        Parameters
        ----------
        name : str
            At most 80 characters.
        overwrite : bool, default False
            Replace another edit of that name.

        Raises
        ------
        EditError
            For a name of another edit, an empty or too long name, or the 101st version.

        Examples
        --------
        >>> editor.keep("warm")
        >>> editor.reset()
        >>> editor.go_to("warm")
        """
        name = _checked_name(name)
        with self._lock:
            kept = list(self._versions)
            at = next((i for i, v in enumerate(kept) if v["name"] == name), len(kept))
            version = {"name": name, "recipe": self.edit.to_dict()}
            if at == VERSIONS:
                raise EditError(f"{VERSIONS} versions are already kept. Forget one of them first.")
            if at < len(kept) and not overwrite and self.versions[name] != self.edit:
                raise EditError(
                    f"Another edit is kept as {name!r}. Choose another name, or pass "
                    "overwrite=True."
                )
            self._versions = [*kept[:at], version, *kept[at + 1 :]]

    def go_to(self, name: str) -> None:
        """Restore the edit kept as ``name``, as one step.

        Raises
        ------
        EditError
            When there is no such version; the message suggests the nearest name.
        """
        with self._lock:
            self._step(Edit.from_dict(self._version(name)["recipe"]))

    def forget(self, name: str) -> None:
        """Delete the version ``name``; raises EditError if there is none."""
        with self._lock:
            version = self._version(name)
            self._versions = [v for v in self._versions if v is not version]

    def _set_aside(self) -> dict[str, Any]:
        """Return edit, history and versions, for ``_take_up``."""
        return {
            "edit": self.edit,
            "_history": self._history,
            "_versions": self._versions,
        }

    def _take_up(self, edit: Edit, **state: Any) -> None:
        """Replace the current edit and history by stored ones."""
        with self._lock, self.hold_sync():
            self._history = state.get("_history", {"past": [], "future": []})
            self._versions = state.get("_versions", [])
            self._apply(edit)

    def _version(self, name: str) -> dict[str, Any]:
        names = [v["name"] for v in self._versions]
        if name not in names:
            hint = did_you_mean(name, names, "editor.keep(name) keeps one.", cutoff=0.4)
            raise EditError(f"No version is named {str(name)[:80]!r}.{hint}")
        version: dict[str, Any] = self._versions[names.index(name)]
        return version

    def set_state(self, sync_data: dict[str, Any]) -> None:
        """Apply state from the browser; report a rejected value instead of raising."""
        with self._lock:
            try:
                super().set_state(sync_data)
            finally:
                self._committed = self.edit

    @traitlets.validate("_history")
    def _check_history(self, proposal: dict[str, Any]) -> dict[str, Any]:
        history: dict[str, Any] = proposal["value"]
        if all(isinstance(history.get(row, []), list) for row in ("past", "future")):
            return history
        raise traitlets.TraitError("A history must have two lists of recipes, past and future.")

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
        if self._applying or self._from_browser():
            return
        with self._lock:
            edit = self.edit
            # Values set together notify one by one; record them as one step.
            if edit != self._committed:
                self._remember(self._committed)
                self._committed = edit


def _checked_name(name: Any) -> str:
    text = name.strip() if isinstance(name, str) else ""
    if not 0 < len(text) <= NAME_LENGTH:
        raise EditError(f"A version's name must be a string of 1 to {NAME_LENGTH} characters.")
    return text


def newest(steps: list[Recipe]) -> list[Recipe]:
    """Return the last steps within the limits; twin of ``newest`` in ``state.js``."""
    kept: list[Recipe] = []
    size = 0
    for recipe in reversed(steps[-HISTORY_LENGTH:]):
        size += len(json.dumps(recipe))
        if kept and size > HISTORY_BYTES:
            break
        kept.append(recipe)
    return kept[::-1]
