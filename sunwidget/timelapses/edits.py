"""The edit of each frame of a time-lapse, whose frames have different scenes."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from sunwidget import presets
from sunwidget.analysis.scene import Scene
from sunwidget.edit.table import CORRECTIONS, NUMBERS, Edit
from sunwidget.film.day import Day
from sunwidget.film.path import EASINGS, edit_at, step

_NOT_CORRECTED = {name: getattr(Edit(), name) for name in CORRECTIONS}
_UNMOVED = {p.name: p.default for p in NUMBERS}


class FrameEdits:
    """One edit for all frames, or a path from the first to the last.

    Parameters
    ----------
    edit : Edit, recipe, recipe file, preset name, Day, or sequence of steps
        As for ``sunwidget.timelapse``.
    count : int
        Number of frames.
    easing : str
        Name in ``EASINGS``.

    Raises
    ------
    ValueError
        For any other value.
    """

    def __init__(self, edit: Any, count: int, easing: str) -> None:
        if easing not in EASINGS:
            raise ValueError(f"easing must be one of {', '.join(EASINGS)}, not {easing!r:.40}.")
        self.one = isinstance(edit, (Edit, Mapping, str, os.PathLike))
        self.count, self.easing = count, easing
        self.edit: Any = edit if self.one or isinstance(edit, Day) else _path(edit)
        if isinstance(edit, Day):
            first: Any = edit.edit
        else:
            first = self.edit if self.one else _without_time(self.edit[0])
        # A preset is a time of day, without corrections.
        self.corrections = Edit() if _is_preset(first) else step(None, first)  # type: ignore[arg-type]

    def of(self, scene: Scene, number: int, daylight: float) -> Edit:
        """Return the edit of a frame, without corrections, which the scene already contains.

        As daylight fades the edit fades out: light from lamps cannot be relit by a sun.
        """
        if self.one:
            edit = step(scene, self.edit)
        else:
            edit = edit_at(scene, self.edit, number / (self.count - 1), self.easing)
        edit = edit.replace(**_NOT_CORRECTED)
        if daylight == 1:
            return edit
        return edit_at(scene, [edit.replace(**_UNMOVED), edit], daylight)


def _path(edits: Any) -> list[Any]:
    """Return the steps of a path, each checked."""
    row = list(edits) if hasattr(edits, "__iter__") and not isinstance(edits, bytes) else []
    if len(row) < 2:
        raise ValueError(
            "A time-lapse takes an Edit, a recipe, a recipe file, a preset, or a path of two or "
            f"more of them, not {edits!r:.80}."
        )
    for what in map(_without_time, row):
        if not _is_preset(what):
            step(None, what)  # type: ignore[arg-type]  # only a preset needs the scene
    return row


def _without_time(what: Any) -> Any:
    return what[1] if isinstance(what, (tuple, list)) and len(what) == 2 else what


def _is_preset(what: Any) -> bool:
    return isinstance(what, str) and what in presets.NAMES
