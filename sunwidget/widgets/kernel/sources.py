"""The arguments of editors: a photo or a scene, with keywords for analysis and edit."""

from __future__ import annotations

import inspect
from typing import Any

from sunwidget.analysis.analyze import analyze
from sunwidget.analysis.scene import Scene
from sunwidget.edit.table import PARAMETERS, unknown_name_message
from sunwidget.photo.photo import Photo, open_photo
from sunwidget.widgets.kernel.known_scenes import recall

_NAMES = tuple(p.name for p in PARAMETERS)
# Strokes belong to the edit, and the widget shows progress itself.
_ANALYSIS = tuple(
    name
    for name, p in inspect.signature(analyze).parameters.items()
    if p.kind is p.KEYWORD_ONLY and name not in (*_NAMES, "progress")
)


def opened(
    source: Any, options: dict[str, Any], widget: str
) -> tuple[Photo | Scene, dict[str, Any]]:
    """Open ``source`` and remove the options of ``analyze`` from ``options``.

    Returns
    -------
    Photo or Scene
        A scene if ``source`` is one or if this photo was analyzed before.
    dict
        Options for the analysis, if it is still needed.

    Raises
    ------
    TypeError
        For a keyword of neither ``Edit`` nor ``analyze``, and for one of ``analyze`` together with
        a Scene. The message names ``widget``.
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
            f"{widget} takes {next(iter(analysis))}= only with a photo; this scene is already "
            "analyzed. Pass the photo, or the result of analyze(photo, ...) with the option."
        )
    return source, analysis
