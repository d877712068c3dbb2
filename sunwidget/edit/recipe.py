"""What may be given as a recipe: an Edit, its dictionary, or a file of its JSON."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from sunwidget.edit.table import Edit
from sunwidget.errors import EditError
from sunwidget.messages import shown

# Strokes make a recipe long; more than this is another kind of file.
_MOST_BYTES = 50_000_000


def edit_of(recipe: Edit | Mapping[str, Any] | None) -> Edit:
    """Return what may be given as a recipe as an ``Edit``; None is one that moves nothing.

    Raises
    ------
    EditError
        For anything else, and for a recipe that cannot be used.
    """
    if recipe is None:
        return Edit()
    if isinstance(recipe, Edit):
        return recipe
    return Edit.from_dict(recipe)


def is_recipe_file(name: str | os.PathLike[str]) -> bool:
    """Whether a name is that of a file, or of one that should be there, and so no preset's."""
    text = os.fspath(name)
    # Unlike Path.is_file it says no, and raises nothing, for what no file can be called.
    return text.lower().endswith(".json") or os.path.isfile(os.path.expanduser(text))  # noqa: PTH111, PTH113


def read_recipe(path: str | os.PathLike[str]) -> Edit:
    """Read a recipe's JSON file, in UTF-8 or, as Windows may write it, UTF-16.

    Raises
    ------
    EditError
        For a file that is missing, cannot be read or holds no recipe; the message names it.
    """
    name = shown(os.fspath(path), 400)  # its end tells most
    try:
        with Path(path).expanduser().open("rb") as file:
            data = file.read(_MOST_BYTES + 1)
    except FileNotFoundError:
        raise EditError(f"There is no recipe file {name}.") from None
    except (OSError, ValueError, RuntimeError) as error:
        reason = getattr(error, "strerror", None) or error
        raise EditError(f"The recipe {name} cannot be read: {reason}.") from error
    if len(data) > _MOST_BYTES:
        raise EditError(f"{name} is not a recipe: it has more than {_MOST_BYTES / 1e6:.0f} MB.")
    try:
        return Edit.from_json(data)
    except EditError as error:
        raise EditError(f"{name}: {error}") from error
