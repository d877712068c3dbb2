"""The Edit's parameters as traits of a widget, made from the one table in ``edit.py``."""

from __future__ import annotations

from typing import Any

import traitlets

from sunwidget.edit import PARAMETERS, Edit, EditError, Parameter


class EditTrait(traitlets.TraitType):
    """One parameter: whatever ``Edit`` accepts for it, normalised as ``Edit`` does.

    A value that ``Edit`` refuses raises ``TraitError`` with the sentence that ``Edit`` says,
    and the trait keeps what it held.
    """

    def __init__(self, parameter: Parameter) -> None:
        super().__init__(
            default_value=parameter.default,
            allow_none=parameter.default is None,
            help=f"{parameter.help} {span_text(parameter)}".strip(),
        )
        self.parameter = parameter
        self.tag(sync=True, to_json=_to_json, group=parameter.section)

    def validate(self, _obj: Any, value: Any) -> Any:
        """Return ``value`` as an Edit holds it."""
        name = self.parameter.name
        try:
            return getattr(Edit(**{name: value}), name)
        except EditError as error:
            raise traitlets.TraitError(str(error)) from None


def edit_traits() -> dict[str, EditTrait]:
    """Return a trait for every row of the table, by name."""
    return {p.name: EditTrait(p) for p in PARAMETERS}


def span_text(parameter: Parameter) -> str:
    """Say range, unit and default of a parameter, for help texts."""
    if parameter.kind != "number":
        return ""
    default = "found in the photo" if parameter.default is None else f"{parameter.default:g}"
    span = f"{parameter.minimum:g} to {parameter.maximum:g} {parameter.unit}".rstrip()
    return f"Range {span}; default {default}."


def _to_json(value: Any, _widget: Any) -> Any:
    if isinstance(value, tuple):
        return [_to_json(item, _widget) for item in value]
    if hasattr(value, "points"):  # a Stroke
        points = [list(point) for point in value.points]
        return {"label": value.label, "points": points, "radius": value.radius}
    return value
