"""Read numbers and texts from EXIF values, which may be anything; None for nonsense."""

from __future__ import annotations

import math
from typing import Any


def number(value: Any) -> float | None:
    """Return a finite number, also from a sequence of one; None for anything else."""
    if isinstance(value, (tuple, list)) and len(value) == 1:
        value = value[0]
    try:
        found = float(value)
    except (TypeError, ValueError, ZeroDivisionError, OverflowError):
        return None
    return found if math.isfinite(found) else None


def positive(value: Any) -> float | None:
    """Return a number above 0; None for anything else."""
    found = number(value)
    return found if found is not None and found > 0 else None


def text(value: Any) -> str:
    """Return a text without its padding; empty for anything else."""
    if isinstance(value, bytes):
        value = value.decode("latin-1")
    return value.strip("\0 ") if isinstance(value, str) else ""
