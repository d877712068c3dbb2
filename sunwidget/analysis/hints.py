"""Hints: what a person says about a photo, and whether it can be used."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from sunwidget.analysis.depth_network import DepthNetwork
from sunwidget.analysis.errors import AnalysisError
from sunwidget.camera import Point
from sunwidget.edit import Stroke, parameter


@dataclass(frozen=True)
class Hints:
    """What a person says about the photo; a hint wins over detection.

    Points are pixels of the photo. ``methods`` names the method of each stage; ``cloud_ratios``
    are m_min and m_max of the clouds; ``water`` is a given map (h, w) in [0, 1] of any size;
    ``depth`` a given map (h, w) in metres, or a network.
    """

    sun: Point | None = None
    horizon: float | tuple[Point, Point] | None = None
    fov: float | None = None
    strokes: tuple[Stroke, ...] = ()
    methods: tuple[tuple[str, str], ...] = ()
    cloud_ratios: tuple[float, float] = (
        parameter("cloud_ratio_min").default,
        parameter("cloud_ratio_max").default,
    )
    water: np.ndarray | None = field(default=None, repr=False, compare=False)
    depth: np.ndarray | DepthNetwork | None = field(default=None, repr=False, compare=False)

    def method(self, stage: str) -> str:
        """Name of the stage's method."""
        return dict(self.methods)[stage]


def check_point(name: str, value: Any) -> Point | None:
    """Return a point (x, y) in pixels; AnalysisError when it is none."""
    if value is None:
        return None
    try:
        x, y = (float(v) for v in value)
    except (TypeError, ValueError) as error:
        raise AnalysisError(
            f"{name} must be a pair (x, y) of pixels, not {value!r:.80}."
        ) from error
    if not (np.isfinite(x) and np.isfinite(y)):
        raise AnalysisError(f"{name} must be finite pixels, not {value!r:.80}.")
    return x, y


def check_horizon(value: Any) -> float | tuple[Point, Point] | None:
    """Return a row or two points in pixels; AnalysisError when it is neither."""
    if value is None:
        return None
    if np.ndim(value) == 0:
        try:
            row = float(value)
        except (TypeError, ValueError):
            row = np.nan
        if not np.isfinite(row):
            raise AnalysisError(
                f"horizon must be a row in pixels or two points, not {value!r:.80}."
            )
        return row
    if len(value) != 2:
        raise AnalysisError(f"horizon must be a row in pixels or two points, not {value!r:.80}.")
    first, second = check_point("horizon", value[0]), check_point("horizon", value[1])
    assert first is not None
    assert second is not None
    if first[0] == second[0]:
        raise AnalysisError(f"The horizon needs two points with different x, not {value!r:.80}.")
    return first, second


def check_fov(value: Any) -> float | None:
    """Return a vertical field of view in degrees; AnalysisError when it is none."""
    if value is None:
        return None
    try:
        degrees = float(value)
    except (TypeError, ValueError):
        degrees = np.nan
    if not 5 <= degrees <= 150:
        raise AnalysisError(f"fov must be 5 to 150 degrees (vertical), not {value!r:.80}.")
    return degrees
