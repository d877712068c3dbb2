"""A trait for the key frames of a film: pairs of seconds and an edit."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import traitlets

from sunwidget.edit.table import PARAMETERS, Edit
from sunwidget.errors import EditError

# Twins of the constants in js/src/editor/export/key_frames.js.
MOST = 100
LONGEST = 600.0  # seconds of a film

KeyFrame = tuple[float, Edit]

# Parameters that a film moves; the others are constant.
MOVED = tuple(p.name for p in PARAMETERS if p.kind == "number" and not p.analysis)


class KeyFrames(traitlets.TraitType):
    """Key frames sorted by time: ``((0.0, Edit()), (2.5, Edit(sun_elevation=3)))``.

    Accepts pairs of seconds and an ``Edit`` or a recipe, and the browser's format
    ``{"seconds": …, "recipe": …}``. Keeps only the parameters that a film moves.
    """

    default_value: Any = ()
    info_text = "pairs of seconds and an Edit"

    def validate(self, _obj: Any, value: Any) -> tuple[KeyFrame, ...]:
        """Return the sorted key frames; raise TraitError if they are invalid."""
        try:
            frames = sorted((_key_frame(item) for item in value), key=lambda frame: frame[0])
        except (TypeError, ValueError) as error:
            raise traitlets.TraitError(f"key_frames are {self.info_text}: {error}") from None
        if len(frames) > MOST:
            raise traitlets.TraitError(f"A film has at most {MOST} key frames.")
        seconds = [frame[0] for frame in frames]
        if len(set(seconds)) < len(seconds):
            raise traitlets.TraitError("Two key frames have the same time.")
        return tuple(frames)


def key_frames_json(value: tuple[KeyFrame, ...], _widget: Any) -> list[dict[str, Any]]:
    """Return key frames in the browser's format."""
    return [{"seconds": seconds, "recipe": edit.to_dict()} for seconds, edit in value]


def complete_key_frames(frames: tuple[KeyFrame, ...], edit: Edit) -> list[KeyFrame]:
    """Return key frames with the constant parameters of ``edit``.

    Strokes, methods and hints are those of ``edit``, so that a correction made after a key frame
    applies to the whole film.
    """
    return [
        (seconds, edit.replace(**{name: getattr(frame, name) for name in MOVED}))
        for seconds, frame in frames
    ]


def _key_frame(item: Any) -> KeyFrame:
    if isinstance(item, Mapping):
        item = (item["seconds"], item["recipe"]) if {"seconds", "recipe"} <= item.keys() else ()
    seconds, recipe = item
    if isinstance(seconds, bool) or not isinstance(seconds, (int, float)):
        raise TypeError(f"seconds must be a number, not {seconds!r:.40}.")
    if not (math.isfinite(seconds) and 0 <= seconds <= LONGEST):
        raise ValueError(f"seconds must be from 0 to {LONGEST:g}, not {seconds!r:.40}.")
    try:
        edit = recipe if isinstance(recipe, Edit) else Edit.from_dict(recipe)
    except EditError as error:
        raise ValueError(str(error)) from None
    return float(seconds), Edit(**{name: getattr(edit, name) for name in MOVED})
