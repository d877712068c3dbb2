"""How a training spends its minutes, in one go or several."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator


class Clock:
    """Counts the seconds that were spent of some minutes, and calls ``save`` now and then."""

    def __init__(self, minutes: float, save: Callable[[], None], every: float) -> None:
        self.limit, self.spent = 60 * minutes, 0.0
        self.save, self.every = save, every

    def shares(self, until: float = 1.0) -> Iterator[float]:
        """Yield the share of the time that is spent before each step, until some share is.

        ``save`` is called after a step when the last time is more than ``every`` seconds ago.
        """
        clock = saved = time.monotonic()
        while self.spent < until * self.limit:
            yield self.spent / self.limit
            now = time.monotonic()
            self.spent, clock = self.spent + now - clock, now
            if now - saved > self.every:
                self.save()
                saved = now
