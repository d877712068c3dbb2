"""Add the time left to progress messages."""

from __future__ import annotations

import math
import re
import time
from collections.abc import Callable

Progress = Callable[[float, str], object]

# Earlier estimates would be far off: the first frames compile shaders and fill caches.
_SECONDS_BEFORE = 1.0
_SHARE_BEFORE = 0.02
# The rate averages over about this share of the time spent so far.
_MEMORY = 0.3
_OF_A_PART = re.compile(r"( · |^)[^·]* left$")


def with_time_left(
    progress: Progress | None, *, clock: Callable[[], float] = time.monotonic
) -> Progress:
    """Wrap a progress callable so that its messages end in " · 12 s left".

    Parameters
    ----------
    progress : callable or None
        Takes ``(fraction, message)``, fraction 0–1. An exception that it raises cancels the
        work, as without the wrapper. None gives a callable that does nothing.
    clock : callable
        Returns seconds and never runs backwards.

    Returns
    -------
    callable
        Takes (fraction, message). It adds nothing in the first second, below 2 % and at the
        end. A fraction that decreases starts a new piece of work.
    """
    if progress is None:
        return lambda _fraction, _message: None
    rate = _Rate()

    def report(fraction: float, message: str) -> object:
        left = rate.seconds_left(fraction, clock())
        if left is None:
            return progress(fraction, message)
        # Replaces the time left that a part of the work has added for itself.
        message = _OF_A_PART.sub("", message)
        words = time_left_text(left)
        return progress(fraction, f"{message} · {words}" if message else words)

    return report


def part(progress: Progress, start: float, end: float) -> Progress:
    """Return a callable for one part of the work, mapped to ``start`` … ``end`` of ``progress``."""
    return lambda fraction, message: progress(start + (end - start) * fraction, message)


def time_left_text(seconds: float) -> str:
    """Return "12 s left", "3 min left" or "1 h 20 min left", as precise as the estimate."""
    if seconds < 20:
        return f"{max(1, math.ceil(seconds - 1e-6))} s left"
    if seconds < 90:
        return f"{math.ceil(seconds / 5) * 5} s left"
    minutes = round(seconds / 60)
    if minutes < 60:
        return f"{minutes} min left"
    hours, rest = divmod(minutes, 60)
    # Above an hour the estimate is good to ten minutes.
    hours, rest = (hours + 1, 0) if rest >= 55 else (hours, round(rest, -1))
    return f"{hours} h {rest} min left" if rest else f"{hours} h left"


class _Rate:
    """Work done per second, smoothed over the last third of the time spent."""

    def __init__(self) -> None:
        self._reset(0.0, None)

    def _reset(self, fraction: float, now: float | None) -> None:
        self.first = self.last = now
        self.fraction = self.first_fraction = fraction
        self.rate = 0.0

    def seconds_left(self, fraction: float, now: float) -> float | None:
        """Return the seconds left, or None while they are unknown."""
        if self.first is None or self.last is None:
            # The clock starts with the first report: the time before may belong to other work.
            self._reset(fraction if fraction < 1 else 0.0, now)
            return None
        if fraction < self.fraction:
            self._reset(fraction, now)
            return None
        passed, spent = now - self.last, now - self.first
        done = fraction - self.first_fraction
        if passed > 0 and fraction > self.fraction:
            current = (fraction - self.fraction) / passed
            # A report counts by the time it covers, so that the frequency of reports is no matter.
            weight = 1 - math.exp(-passed / max(_MEMORY * spent, 1e-9))
            self.rate += (current - self.rate) * (weight if self.rate else 1)
            self.last, self.fraction = now, fraction
        if fraction >= 1 or spent < _SECONDS_BEFORE or done < _SHARE_BEFORE or not self.rate:
            return None
        return max(0.0, (1 - fraction) / self.rate - (now - self.last))
