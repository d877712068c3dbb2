"""Find the value of a uniform: in the Edit, the Scene or the host.

The browser's twin is ``js/src/gl/values.js``. Two states exist: ``source``, the unmoved
picture, and ``edit``, the current one. In the source state every parameter has its default,
and every automatic parameter the value that the analysis found.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sunwidget.edit.table import PARAMETERS, Edit

if TYPE_CHECKING:
    from collections.abc import Mapping

Value = float | int | tuple[float, ...]


def parameter_values(edit: Edit, automatic: Mapping[str, float]) -> dict[str, Value]:
    """Return all numbers of ``edit``, automatic ones filled in, and the indices of choices."""
    values: dict[str, Value] = {}
    for p in PARAMETERS:
        value = getattr(edit, p.name)
        if p.kind == "choice":
            values[p.name] = p.choices.index(value)
        elif p.kind == "number":
            values[p.name] = float(automatic[p.name] if value is None else value)
    return values


def states(edit: Edit, automatic: Mapping[str, float]) -> dict[str, dict[str, Value]]:
    """Return the values of both states, each with the ``source_…`` names added."""
    source = parameter_values(Edit(), automatic)
    current = parameter_values(edit, automatic)
    fixed = {f"source_{name}": value for name, value in source.items()}
    # The method is not a property of the picture: both states use the chosen one.
    source["method"] = current["method"]
    return {"source": {**source, **fixed}, "edit": {**current, **fixed}}


def drawn_for(method: str, values: Mapping[str, Value]) -> tuple[str, ...]:
    """Return what a row of the graph can be drawn for: the method, and parameters above zero."""
    return method, *(name for name, value in values.items() if value)


def uniform_value(shader: str, name: str, *tables: Mapping[str, Any]) -> Any:
    """Look up ``name`` in ``tables`` in order; the error names shader and uniform."""
    for table in tables:
        if name in table:
            return table[name]
    raise KeyError(
        f"Shader {shader!r} declares uniform {name!r}, which is neither a parameter of "
        "edit/table.py, a scene uniform of graph.json nor a host uniform."
    )
