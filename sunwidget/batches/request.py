"""The request of a batch: edit and options for every photo."""

from __future__ import annotations

import inspect
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from sunwidget import presets
from sunwidget.edit.recipe import edit_of, is_recipe_file, read_recipe
from sunwidget.edit.table import Edit
from sunwidget.errors import EditError
from sunwidget.messages import did_you_mean, short_repr

# Parts of a recipe that apply to one photo only.
_OF_ONE_PHOTO = ("strokes", "sun_hint", "horizon_hint", "fov_hint")


@dataclass(frozen=True)
class Request:
    """Edit and options for every photo of a batch.

    ``edit`` is the recipe. ``preset``, a time of day, overrides it; the values of ``flags``
    override both. ``analysis`` are arguments of ``analyze``, ``options`` of ``save``.
    ``long_edge`` limits the picture's longer side in pixels.
    """

    edit: Edit
    preset: str | None = None
    flags: dict[str, Any] = field(default_factory=dict)
    analysis: dict[str, Any] = field(default_factory=dict)
    options: dict[str, Any] = field(default_factory=dict)
    long_edge: int | None = None

    def edit_of(self, scene: Any) -> Edit:
        """Return the edit of one photo, on which a preset depends."""
        from sunwidget import presets

        edit = self.edit
        if self.preset is not None:
            edit = presets.edit(self.preset, scene, edit)
        return edit.replace(**self.flags)


def check_request(
    edit: Any,
    analysis: dict[str, Any] | None,
    options: dict[str, Any],
    long_edge: int | None,
    *,
    corrections: bool,
) -> Request:
    """Return the request of a call of ``batch``, checked before any work.

    Raises
    ------
    EditError, ValueError, TypeError
        For an unusable recipe, size or option.
    """
    from sunwidget.analysis.analyze import analyze
    from sunwidget.export.stills import save

    if long_edge is not None:
        check_whole("long_edge", long_edge, 16)
    _check_known(
        "batch", options, save, {"picture", "path", "like", "overwrite", "size", "progress"}
    )
    _check_known("analysis", analysis or {}, analyze, {"photo", "progress"})
    request = edit if isinstance(edit, Request) else Request(_edit(edit), _preset(edit))
    recipe = request.edit
    if not corrections:
        recipe = recipe.replace(**dict.fromkeys(_OF_ONE_PHOTO[1:]), strokes=())
    return Request(recipe, request.preset, request.flags, dict(analysis or {}), options, long_edge)


def _preset(edit: Any) -> str | None:
    return presets.find(edit).name if isinstance(edit, str) and edit in presets.NAMES else None


def _edit(edit: Any) -> Edit:
    if isinstance(edit, (Edit, Mapping)):
        return edit_of(edit)
    if isinstance(edit, str) and edit in presets.NAMES:
        return Edit()
    if isinstance(edit, (str, os.PathLike)):
        if not is_recipe_file(edit):
            raise EditError(
                f"There is no recipe {short_repr(os.fspath(edit))}. The presets are "
                f"{', '.join(presets.NAMES)}."
            )
        return read_recipe(edit)
    raise EditError(f"A batch needs an Edit, a recipe or a preset, not {type(edit).__name__}.")


def _check_known(what: str, arguments: dict[str, Any], function: Any, refused: set[str]) -> None:
    """Raise TypeError for an argument that ``function`` lacks or that the batch sets itself."""
    known = [name for name in inspect.signature(function).parameters if name not in refused]
    for name in arguments:
        if name not in known:
            hint = did_you_mean(name, known, f"Known arguments: {', '.join(known)}.")
            raise TypeError(f"{what} does not take {name!r}.{hint}")


def check_endings(outputs: Iterable[str], request: Request) -> None:
    """Raise an error if a file type does not support the requested options."""
    from sunwidget.export.stills import check_format, checked_headroom

    layers = bool(request.options.get("layers"))
    headroom = checked_headroom(request.options.get("headroom", 0))
    bits = request.options.get("bit_depth")
    for suffix in sorted({Path(output).suffix for output in outputs}):
        check_format(Path("picture" + suffix), bits, layers=layers, headroom=headroom)


def check_whole(name: str, value: Any, least: int) -> None:
    """Raise ValueError unless a value is None or an integer of at least ``least``."""
    if value is None:
        return
    if isinstance(value, bool) or not isinstance(value, int) or value < least:
        raise ValueError(
            f"{name} must be a whole number from {least} upwards, not {short_repr(value, 40)}."
        )
