"""How long long work still takes, said in its progress messages."""

from __future__ import annotations

import math
import re
import time
from collections.abc import Callable

Progress = Callable[[float, str], object]

# Before this, the first frames (shaders, caches) would tell a time that is far off.
_SECONDS_BEFORE = 1.0
_SHARE_BEFORE = 0.02
# How far back the rate looks: about this share of the time that the work has taken so far.
_MEMORY = 0.3
_OF_A_PART = re.compile(r"( · |^)[^·]* left$")


def with_time_left(
    progress: Progress | None, *, clock: Callable[[], float] = time.monotonic
) -> Progress:
    """Wrap a progress callable so that its messages end in " · 12 s left".

    Parameters
    ----------
    progress : callable or None
        Takes ``(fraction, message)``, fraction 0–1. What it raises passes through, so that
        raising cancels the work as before. None makes a callable that does nothing.
    clock : callable
        Seconds that only grow.

    Returns
    -------
    callable
        To be called with (fraction, message). Nothing is added in the first second, below
        2 % and at the end. A fraction that falls back begins another piece of work.
    """
    if progress is None:
        return lambda _fraction, _message: None
    rate = _Rate()

    def report(fraction: float, message: str) -> object:
        left = rate.seconds_left(fraction, clock())
        if left is None:
            return progress(fraction, message)
        # What a part of the work said of itself; the whole's own time is the later one.
        message = _OF_A_PART.sub("", message)
        words = time_left_text(left)
        return progress(fraction, f"{message} · {words}" if message else words)

    return report


def part(progress: Progress, start: float, end: float) -> Progress:
    """Return what tells ``progress`` of one part of its work, the one from ``start`` to ``end``."""
    return lambda fraction, message: progress(start + (end - start) * fraction, message)


def time_left_text(seconds: float) -> str:
    """Return "12 s left", "3 min left" or "1 h 20 min left", no finer than it can be known."""
    if seconds < 20:
        return f"{max(1, math.ceil(seconds - 1e-6))} s left"
    if seconds < 90:
        return f"{math.ceil(seconds / 5) * 5} s left"
    minutes = round(seconds / 60)
    if minutes < 60:
        return f"{minutes} min left"
    hours, rest = divmod(minutes, 60)
    # Ten minutes is as fine as hours are known.
    hours, rest = (hours + 1, 0) if rest >= 55 else (hours, round(rest, -1))
    return f"{hours} h {rest} min left" if rest else f"{hours} h left"


class _Rate:
    """Work done a second, smoothed over the last third of the time spent."""

    def __init__(self) -> None:
        self._forget(0.0, None)

    def _forget(self, fraction: float, now: float | None) -> None:
        self.first = self.last = now
        self.fraction = self.first_fraction = fraction
        self.rate = 0.0

    def seconds_left(self, fraction: float, now: float) -> float | None:
        """Return the seconds that are left, None while they are not known."""
        if self.first is None or self.last is None:
            # The clock starts with the first report: what came before may be other work.
            self._forget(fraction if fraction < 1 else 0.0, now)
            return None
        if fraction < self.fraction:
            self._forget(fraction, now)
            return None
        passed, spent = now - self.last, now - self.first
        done = fraction - self.first_fraction
        if passed > 0 and fraction > self.fraction:
            own = (fraction - self.fraction) / passed
            # The weight of a report follows the time it covers, however often reports come.
            weight = 1 - math.exp(-passed / max(_MEMORY * spent, 1e-9))
            self.rate += (own - self.rate) * (weight if self.rate else 1)
            self.last, self.fraction = now, fraction
        if fraction >= 1 or spent < _SECONDS_BEFORE or done < _SHARE_BEFORE or not self.rate:
            return None
        return max(0.0, (1 - fraction) / self.rate - (now - self.last))
