"""Water: level surfaces below the horizon that mirror the sky.

``METHODS`` maps a name to a function ``(Working, sky, horizon_row) -> (h, w) float32``.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from sunwidget.analysis.working import Working


def none(working: Working, sky: np.ndarray, horizon_row: float) -> np.ndarray:
    """Call nothing water."""
    return np.zeros_like(sky)


METHODS: dict[str, Callable[[Working, np.ndarray, float], np.ndarray]] = {"none": none}
