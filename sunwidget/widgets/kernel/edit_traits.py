"""Rows of a parameter table, by default the Edit's, as traits of a widget."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import Any

import anywidget
import traitlets

from sunwidget.edit.table import PARAMETERS, Parameter, checked, plain
from sunwidget.errors import EditError

Check = Callable[[Parameter, Any], Any]


class EditTrait(traitlets.TraitType):
    """One parameter, with the values that its table accepts, normalized as in the table.

    A value that ``check`` rejects raises ``TraitError`` with its message; the trait keeps its old
    value.

    Parameters
    ----------
    parameter : Parameter
        Row of the table.
    check : callable, default ``edit.checked``
        ``check(parameter, value)`` returns the normalized value or raises ``EditError``.
    """

    def __init__(self, parameter: Parameter, check: Check = checked) -> None:
        super().__init__(
            default_value=parameter.default,
            allow_none=parameter.default is None,
            help=f"{parameter.help} {span_text(parameter)}".strip(),
        )
        self.parameter = parameter
        self.check = check
        self.tag(sync=True, to_json=_to_json, group=parameter.section)

    def validate(self, _obj: Any, value: Any) -> Any:
        """Return ``value`` normalized by the table."""
        try:
            return self.check(self.parameter, value)
        except EditError as error:
            raise traitlets.TraitError(str(error)) from None


class AnswersRefusals(anywidget.AnyWidget):
    """A widget that reports rejected values to the browser."""

    _refusals: tuple[type[Exception], ...] = (traitlets.TraitError,)

    def set_state(self, sync_data: dict[str, Any]) -> None:
        """Apply state from the browser; report a rejected value instead of raising."""
        try:
            super().set_state(sync_data)
        except self._refusals as error:
            self.send({"type": "error", "error": str(error)})
            self.send_state([name for name in sync_data if name in self.keys])


class ChangedByBrowser(AnswersRefusals):
    """A widget that knows whether the browser changes its traits, or Python.

    Handlers may run on any thread: JupyterLab sends messages to kernel subshells.
    """

    def __init__(self, **traits: Any) -> None:
        self._lock = threading.RLock()
        self._browser_thread: int | None = None
        super().__init__(**traits)

    def set_state(self, sync_data: dict[str, Any]) -> None:
        """Apply state from the browser; report a rejected value instead of raising."""
        with self._lock:
            self._browser_thread = threading.get_ident()
            try:
                super().set_state(sync_data)
            finally:
                self._browser_thread = None

    def _from_browser(self) -> bool:
        """Return whether this thread is applying state from the browser."""
        return self._browser_thread == threading.get_ident()


def edit_traits(
    rows: Iterable[Parameter] = PARAMETERS, check: Check = checked
) -> dict[str, EditTrait]:
    """Return a trait for every row of the table, by name."""
    return {p.name: EditTrait(p, check) for p in rows}


def span_text(parameter: Parameter) -> str:
    """Return range, unit and default of a parameter, for help texts."""
    if parameter.kind != "number":
        return ""
    default = "found in the photo" if parameter.default is None else f"{parameter.default:g}"
    span = f"{parameter.minimum:g} to {parameter.maximum:g} {parameter.unit}".rstrip()
    return f"Range {span}; default {default}."


def _to_json(value: Any, _widget: Any) -> Any:
    return plain(value)
