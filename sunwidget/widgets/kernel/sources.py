"""What the editors take: a photo or a scene, with keywords for its analysis and its edit."""

from __future__ import annotations

import inspect
from typing import Any

from sunwidget.analysis.analyze import analyze
from sunwidget.analysis.scene import Scene
from sunwidget.edit.table import PARAMETERS, unknown_name_message
from sunwidget.photo.photo import Photo, open_photo
from sunwidget.widgets.kernel.known_scenes import recall

_NAMES = tuple(p.name for p in PARAMETERS)
# Strokes are a parameter of the edit, and progress has its own line on the stage.
_ANALYSIS = tuple(
    name
    for name, p in inspect.signature(analyze).parameters.items()
    if p.kind is p.KEYWORD_ONLY and name not in (*_NAMES, "progress")
)


def opened(
    source: Any, options: dict[str, Any], widget: str
) -> tuple[Photo | Scene, dict[str, Any]]:
    """Open ``source`` and take the options of ``analyze`` out of ``options``.

    Returns
    -------
    Photo or Scene
        A scene where one was given, or where this photo was analysed before.
    dict
        Options for the analysis that is still to come.

    Raises
    ------
    TypeError
        For a keyword that neither ``Edit`` nor ``analyze`` has, and for one of ``analyze``
        beside a Scene. ``widget`` is the name in the message.
    """
    for name in options:
        if name not in _NAMES and name not in _ANALYSIS:
            raise TypeError(f"{widget}: {unknown_name_message(name, _ANALYSIS)}")
    analysis = {name: options.pop(name) for name in _ANALYSIS if name in options}
    if not isinstance(source, Scene):
        photo = open_photo(source)
        known = recall(photo, analysis)
        return (photo, analysis) if known is None else (known, {})
    if analysis:
        raise TypeError(
            f"{widget} takes {next(iter(analysis))}= with a photo; this scene is analysed "
            "already. Pass the photo, or analyze(photo, ...) with the option."
        )
    return source, analysis
