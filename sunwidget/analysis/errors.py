"""What the analysis raises when it cannot go on; everything less is a warning of the Scene."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene


class AnalysisError(ValueError):
    """An input, hint or method that cannot be used; the message says what to do."""


def checked_scene(scene: Any) -> Scene:
    """Return what ``analyze`` returned; raises AnalysisError for a photo, a path or any other."""
    if not hasattr(scene, "automatic"):
        raise AnalysisError(
            f"A Scene is needed here, not {type(scene).__name__}: scene = sw.analyze(photo)."
        )
    found: Scene = scene
    return found
