"""Read a recipe from an Edit, its dictionary, or a JSON file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from sunwidget.edit.table import Edit
from sunwidget.errors import EditError
from sunwidget.messages import shown

# Strokes make a recipe long; a larger file is not a recipe.
_MOST_BYTES = 50_000_000


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
    name = shown(os.fspath(path), 400)  # the end of a path matters most
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
