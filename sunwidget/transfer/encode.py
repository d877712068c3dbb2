"""Encoding light as a Photo with the depth, profile and metadata of another."""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from sunwidget.errors import AnalysisError
from sunwidget.export.stills import encode_like

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.photo.photo import Photo


def photo_like(photo: Photo, light: np.ndarray) -> Photo:
    """Return ``light`` (H, W, 3) display-linear as a photo in the encoding of ``photo``.

    Unchanged light keeps the photo's code values. The recipe is dropped, since it describes the
    first photo.
    """
    if photo.encoded.dtype.kind == "f":
        codes = np.ascontiguousarray(light, np.float32)
    else:
        codes = encode_like(photo, light)
    return dataclasses.replace(photo, encoded=codes, recorded=None, gain_map=None)


def as_scene(source: Any) -> Scene:
    """Return a scene unchanged; analyze any other source."""
    from sunwidget.analysis.analyze import analyze
    from sunwidget.analysis.scene import Scene

    return source if isinstance(source, Scene) else analyze(source)


def check_strength(strength: Any) -> None:
    """Raise AnalysisError unless ``strength`` is a number from 0 to 1."""
    if not isinstance(strength, (int, float)) or not math.isfinite(strength):
        raise AnalysisError(f"strength must be a number from 0 to 1, not {strength!r:.40}.")
    if not 0 <= strength <= 1:
        raise AnalysisError(f"strength must lie between 0 and 1, not {strength!r:.40}.")
