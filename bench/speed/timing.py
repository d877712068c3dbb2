"""How a time is taken: by the clock and by the processors, several runs, the first not counted."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple


class Times(NamedTuple):
    """Seconds of each run by the clock, and of processors (all threads of this process)."""

    wall: list[float]
    processor: list[float]

    @property
    def median(self) -> float:
        return statistics.median(self.wall)

    @property
    def work(self) -> float:
        """Median processor time: what to compare by on a busy machine."""
        return statistics.median(self.processor)


@contextmanager
def clock(times: Times) -> Iterator[None]:
    """Add the block as one run."""
    wall, processor = time.perf_counter(), time.process_time()
    yield
    times.processor.append(time.process_time() - processor)
    times.wall.append(time.perf_counter() - wall)


def timed(task: Callable[[int], Any], runs: int) -> Times:
    """Time ``task(i)`` for i from 1 to ``runs``, after ``task(0)``, which is not counted."""
    task(0)
    times = Times([], [])
    for i in range(1, runs + 1):
        with clock(times):
            task(i)
    return times


def in_turn(
    ours: Callable[[int], Any], theirs: Callable[[int], Any], runs: int, peer_runs: int
) -> tuple[Times, Times]:
    """Time two tasks in turn, so that a busy machine slows both; ``theirs`` less often."""
    ours(0)
    theirs(0)
    times = Times([], []), Times([], [])
    block = max(1, runs // peer_runs)
    for i in range(1, peer_runs + 1):
        for k in range(block):
            with clock(times[0]):
                ours((i - 1) * block + k + 1)
        with clock(times[1]):
            theirs(i)
    return times


def ratio(ours: Times, theirs: Times) -> float:
    """What the peer takes over what we take, by processor time."""
    return theirs.work / max(ours.work, 1e-9)
