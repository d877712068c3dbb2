"""Easing functions, after CSS (CSS Easing Functions Level 1)."""

from __future__ import annotations

from collections.abc import Callable


def _bezier(first: tuple[float, float], second: tuple[float, float]) -> Callable[[float], float]:
    """Return the easing that CSS calls cubic-bezier(x1, y1, x2, y2)."""
    (x1, y1), (x2, y2) = first, second

    def at(a: float, b: float, s: float) -> float:
        return 3 * (1 - s) ** 2 * s * a + 3 * (1 - s) * s**2 * b + s**3

    def ease(fraction: float) -> float:
        low, high = 0.0, 1.0
        for _ in range(40):  # x increases with s, so bisection finds it
            s = (low + high) / 2
            low, high = (s, high) if at(x1, x2, s) < fraction else (low, s)
        return at(y1, y2, (low + high) / 2)

    # Bisection only approaches the ends, which a film's first and last frames must reach.
    return lambda fraction: fraction if fraction in (0.0, 1.0) else ease(fraction)


EASINGS: dict[str, Callable[[float], float]] = {
    "linear": lambda fraction: fraction,
    "ease_in": _bezier((0.42, 0.0), (1.0, 1.0)),
    "ease_out": _bezier((0.0, 0.0), (0.58, 1.0)),
    "ease_in_out": _bezier((0.42, 0.0), (0.58, 1.0)),
    # Passes through key frames without stopping: see _track in film/path.py.
    "smooth": lambda fraction: fraction,
}
