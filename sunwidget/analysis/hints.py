"""Hints: what the user states about a photo, and checks of it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from sunwidget.analysis.depth.network import DepthNetwork, SeenDepth
from sunwidget.edit.table import OUTSIDE, Stroke, SunHint, parameter
from sunwidget.errors import AnalysisError
from sunwidget.geometry.camera import Point

FARTHEST = 1e7
"""Most pixels from the photo's corner to a hint: farther out, a camera has no direction."""
_APART = 1e-3  # pixels: two points of the horizon that are closer together have no slope


@dataclass(frozen=True)
class Hints:
    """What the user states about the photo; a hint overrides detection.

    Points are pixels of the photo; ``sun`` is "outside" if the sun is not in the picture.
    ``methods`` has the method of each stage; ``cloud_ratios`` are m_min and m_max of the clouds;
    ``water`` is a given map (h, w) in [0, 1] of any size; ``depth`` is a given map (h, w) in
    metres, or a network.
    """

    sun: SunHint | None = None
    horizon: float | tuple[Point, Point] | None = None
    fov: float | None = None
    strokes: tuple[Stroke, ...] = ()
    methods: tuple[tuple[str, str], ...] = ()
    cloud_ratios: tuple[float, float] = (
        parameter("cloud_ratio_min").default,
        parameter("cloud_ratio_max").default,
    )
    water: np.ndarray | None = field(default=None, repr=False, compare=False)
    depth: np.ndarray | DepthNetwork | SeenDepth | None = field(
        default=None, repr=False, compare=False
    )

    def method(self, stage: str) -> str:
        """Return the name of the stage's method."""
        return dict(self.methods)[stage]

    @property
    def sun_outside(self) -> bool:
        """Whether the hint places the sun outside the picture."""
        return self.sun == OUTSIDE

    @property
    def sun_point(self) -> Point | None:
        """The hinted position of the sun, or None."""
        return self.sun if isinstance(self.sun, tuple) else None


def check_point(name: str, value: Any) -> Point | None:
    """Return a point (x, y) in pixels; AnalysisError for anything else."""
    if value is None:
        return None
    try:
        x, y = (float(v) for v in value)
    except (TypeError, ValueError) as error:
        raise AnalysisError(
            f"{name} must be a pair (x, y) of pixels, not {value!r:.80}."
        ) from error
    if not max(abs(x), abs(y)) <= FARTHEST:  # true for NaN, too
        raise AnalysisError(
            f"{name} must be finite pixels, at most {FARTHEST:g} away, not {value!r:.80}."
        )
    return x, y


def check_sun(value: Any) -> SunHint | None:
    """Return a point (x, y) in pixels or "outside"; AnalysisError for anything else."""
    if not isinstance(value, str):
        return check_point("sun", value)
    if value != OUTSIDE:
        raise AnalysisError(
            f"sun must be a pair (x, y) of pixels, or {OUTSIDE!r} if it is not in the picture, "
            f"not {value!r:.80}."
        )
    return OUTSIDE


def check_horizon(value: Any) -> float | tuple[Point, Point] | None:
    """Return a row or two points in pixels; AnalysisError for anything else."""
    if value is None:
        return None
    neither = AnalysisError(
        f"horizon must be a row in pixels or two points ((x0, y0), (x1, y1)), at most "
        f"{FARTHEST:g} away, not {value!r:.80}."
    )
    try:
        rows = np.asarray(value, float)
    except (TypeError, ValueError) as error:
        raise neither from error
    if rows.shape not in ((), (2, 2)) or not (np.abs(rows) <= FARTHEST).all():
        raise neither
    if rows.shape == ():
        return float(rows)
    (x0, y0), (x1, y1) = rows.tolist()
    if abs(x0 - x1) < _APART:
        raise AnalysisError(f"The horizon needs two points with different x, not {value!r:.80}.")
    return (x0, y0), (x1, y1)


def check_fov(value: Any) -> float | None:
    """Return a vertical field of view in degrees; AnalysisError for anything else."""
    if value is None:
        return None
    try:
        degrees = float(value)
    except (TypeError, ValueError):
        degrees = np.nan
    if not 1 <= degrees <= 150:
        raise AnalysisError(f"fov must be 1 to 150 degrees (vertical), not {value!r:.80}.")
    return degrees


def check_strokes(value: Any) -> tuple[Stroke, ...]:
    """Return strokes as a tuple; AnalysisError if anything else is among them."""
    strokes = tuple(value) if isinstance(value, (tuple, list)) else (value,)
    for stroke in strokes:
        if not isinstance(stroke, Stroke):
            raise AnalysisError(f"strokes must be a tuple of sunwidget.Stroke, not {value!r:.80}.")
    return strokes
