"""Apply the user's corrections to a scene: strokes, hints and cloud method of an edit."""

from __future__ import annotations

import dataclasses
from typing import Any

from sunwidget.analysis.hints import Hints
from sunwidget.analysis.pipeline import Steps, complete, find_clouds_again
from sunwidget.analysis.scene import Scene, checked_scene
from sunwidget.analysis.strokes.apply import apply_strokes
from sunwidget.edit.table import Edit
from sunwidget.geometry.camera import Point
from sunwidget.progress import Progress


def corrected(scene: Scene, edit: Edit, progress: Progress | None = None) -> Scene:
    """Return the scene with the edit's strokes, hints and cloud method applied.

    The same edit always gives the same maps, to the bit; an edit without corrections returns the
    same object. Thresholds have no effect on un-mixed clouds.

    Parameters
    ----------
    scene : Scene
    edit : Edit
        Strokes and hints in fractions of the picture.
    progress : callable, optional
        As for ``analyze``; an exception that it raises cancels without any change.

    Returns
    -------
    Scene

    Raises
    ------
    AnalysisError
        If a hint cannot be used, or ``scene`` is not a Scene.
    """
    clouds = _cloud_choice(checked_scene(scene), edit)
    hints = (edit.sun_hint, edit.horizon_hint, edit.fov_hint)
    if hints == (None, None, None) and clouds is None and not edit.strokes:
        return scene
    # Strokes come last, on the scene with the hints, whose camera and fit they keep.
    base = scene.unstroked or scene
    if hints != (None, None, None):
        bare = base
        base = bare.memory.scene(
            hints,
            lambda: complete(bare.segmentation, _with_hints(scene, edit), Steps(progress)),
        )
    if clouds is not None:
        plain = base
        base = plain.memory.scene(clouds, lambda: find_clouds_again(plain, *clouds))
    return apply_strokes(base, scene.hints.strokes + edit.strokes, progress)


def _cloud_choice(scene: Scene, edit: Edit) -> tuple[str, tuple[float, float]] | None:
    """Return method and thresholds of the clouds if they differ from the analysis."""
    analysed = scene.hints.method("clouds")
    method = analysed if edit.cloud_method == "analysed" else edit.cloud_method
    ratios = (edit.cloud_ratio_min, edit.cloud_ratio_max)
    if method == analysed and (method == "unmix" or ratios == scene.hints.cloud_ratios):
        return None
    return method, ratios


def _with_hints(scene: Scene, edit: Edit) -> Hints:
    def pixels(point: Point) -> Point:
        return point[0] * scene.width, point[1] * scene.height

    changes: dict[str, Any] = {"strokes": ()}
    if edit.sun_hint is not None:
        hint = edit.sun_hint
        changes["sun"] = pixels(hint) if isinstance(hint, tuple) else hint
    if edit.horizon_hint is not None:
        changes["horizon"] = (pixels(edit.horizon_hint[0]), pixels(edit.horizon_hint[1]))
    if edit.fov_hint is not None:
        changes["fov"] = edit.fov_hint
    return dataclasses.replace(scene.hints, **changes)
