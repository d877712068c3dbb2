"""Read a recipe from an Edit, its dictionary, a JSON file, or its Python text."""

from __future__ import annotations

import ast
import os
import textwrap
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from sunwidget.edit.table import Edit, Stroke
from sunwidget.errors import EditError
from sunwidget.geometry.place import Place
from sunwidget.messages import short_repr

# Strokes make a recipe long; a larger file is not a recipe.
_MOST_BYTES = 50_000_000

_PARTS: dict[str, Callable[..., Any]] = {"Stroke": Stroke, "Place": Place}


def edit_of(recipe: Edit | Mapping[str, Any] | None) -> Edit:
    """Return a recipe as an ``Edit``; None gives the edit that moves nothing.

    Raises
    ------
    EditError
        For any other type, and for a recipe that cannot be used.
    """
    if recipe is None:
        return Edit()
    if isinstance(recipe, Edit):
        return recipe
    return Edit.from_dict(recipe)


def is_recipe_file(name: str | os.PathLike[str]) -> bool:
    """Return whether a name is that of a file, which may be missing, rather than a preset's."""
    text = os.fspath(name)
    # Unlike Path.is_file it returns False, and does not raise, for names that no file can have.
    return text.lower().endswith(".json") or os.path.isfile(os.path.expanduser(text))  # noqa: PTH111, PTH113


def read_recipe(path: str | os.PathLike[str]) -> Edit:
    """Read a recipe's JSON file, in UTF-8 or in UTF-16, as Windows may write it.

    Raises
    ------
    EditError
        For a file that is missing, unreadable or not a recipe; the message names it.
    """
    name = short_repr(os.fspath(path), 400)  # the end of a path matters most
    try:
        with Path(path).expanduser().open("rb") as file:
            data = file.read(_MOST_BYTES + 1)
    except FileNotFoundError:
        raise EditError(f"There is no recipe file {name}.") from None
    except (OSError, ValueError, RuntimeError) as error:
        reason = getattr(error, "strerror", None) or error
        raise EditError(f"The recipe {name} cannot be read: {reason}.") from error
    if len(data) > _MOST_BYTES:
        raise EditError(
            f"{name} is not a recipe: it is larger than {_MOST_BYTES / 1e6:.0f} MB. "
            "Pass a file that Edit.to_json() wrote."
        )
    try:
        return Edit.from_json(data)
    except EditError as error:
        raise EditError(f"{name}: {error}") from error


def read_code(text: str) -> Edit:
    """Read the first ``Edit(…)`` of a Python text, such as ``Edit.to_code`` writes; nothing is run.

    Raises
    ------
    EditError
        For a text that is not Python or has no ``Edit(…)``, and for one of other than literals,
        ``Stroke(…)`` and ``Place(…)``.
    """
    try:
        tree = ast.parse(textwrap.dedent(text), "recipe")
        calls = (node for node in ast.walk(tree) if _called(node) == "Edit")
        call = next(calls, None)
        if not isinstance(call, ast.Call):
            raise EditError("There is no sw.Edit(…) in this Python.")
        if call.args:
            raise EditError("sw.Edit takes its values by name: sw.Edit(sun_elevation=3).")
        return Edit.from_dict({str(word.arg): _value(word.value) for word in call.keywords})
    except EditError:
        raise
    # SyntaxError: no Python; ValueError: zero bytes, places that are none; TypeError: arguments
    # that a part does not take; the others: brackets a thousand deep.
    except (SyntaxError, ValueError, TypeError, RecursionError, MemoryError) as error:
        raise EditError(f"This Python cannot be read as a recipe: {error}.") from None


def _called(node: ast.AST) -> str:
    """Return the name of what a node calls, without its module; empty for no call."""
    match node:
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name)):
            return name
    return ""


def _value(node: ast.expr) -> Any:
    match node:
        case ast.List(elts=items) | ast.Tuple(elts=items):
            return [_value(item) for item in items]
        case ast.Call(args=args, keywords=words) if part := _PARTS.get(_called(node)):
            named = {str(word.arg): _value(word.value) for word in words}
            return part(*map(_value, args), **named)
    try:
        return ast.literal_eval(node)
    except ValueError:
        source = short_repr(ast.unparse(node))
        raise EditError(
            f"Line {node.lineno} of the recipe: {source} is not a plain value."
        ) from None
