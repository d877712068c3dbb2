"""Key frames of a film, as a trait: edits at seconds."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import traitlets

from sunwidget.edit.table import PARAMETERS, Edit
from sunwidget.errors import EditError

# Twins of those in js/src/editor/export/key_frames.js.
MOST = 100
LONGEST = 600.0  # seconds of a film

KeyFrame = tuple[float, Edit]

# What a film moves; all else is one for the whole film.
MOVED = tuple(p.name for p in PARAMETERS if p.kind == "number" and not p.analysis)


class KeyFrames(traitlets.TraitType):
    """Edits at seconds, sorted: ``((0.0, Edit()), (2.5, Edit(sun_elevation=3)))``.

    Takes pairs of seconds and an ``Edit`` or a recipe, and what travels to the browser:
    ``{"seconds": …, "recipe": …}``. Of each edit it keeps what a film moves.
    """

    default_value: Any = ()
    info_text = "pairs of seconds and an Edit"

    def validate(self, _obj: Any, value: Any) -> tuple[KeyFrame, ...]:
        """Return the key frames, sorted; TraitError says what is wrong with them."""
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
    """Return key frames as they travel."""
    return [{"seconds": seconds, "recipe": edit.to_dict()} for seconds, edit in value]


def along(frames: tuple[KeyFrame, ...], edit: Edit) -> list[KeyFrame]:
    """Return key frames of which ``edit`` gives all that a film does not move.

    Strokes, methods and hints are those of ``edit`` whenever the key frame was made, so that a
    correction made later is in all of the film.
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
        raise TypeError(f"seconds are a number, not {seconds!r:.40}.")
    if not (math.isfinite(seconds) and 0 <= seconds <= LONGEST):
        raise ValueError(f"seconds go from 0 to {LONGEST:g}, not {seconds!r:.40}.")
    try:
        edit = recipe if isinstance(recipe, Edit) else Edit.from_dict(recipe)
    except EditError as error:
        raise ValueError(str(error)) from None
    return float(seconds), Edit(**{name: getattr(edit, name) for name in MOVED})
