"""Computing the next items of an iterator while the current one is used."""

from __future__ import annotations

from collections import deque
from collections.abc import Generator, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

T = TypeVar("T")

# Items computed in advance: enough to absorb a slow one, few enough for memory.
_AHEAD = 2


def prefetch(items: Iterator[T]) -> Generator[T]:
    """Yield the items of ``items`` (never None) while a thread computes the next two.

    Exceptions of ``items`` are raised here. Closing the generator (``contextlib.closing``), or an
    exception in its consumer, waits for the item in progress and computes no more.
    """
    pool = ThreadPoolExecutor(1, thread_name_prefix="sunwidget-prefetch")
    try:
        waiting = deque(pool.submit(next, items, None) for _ in range(_AHEAD))
        while (item := waiting.popleft().result()) is not None:
            waiting.append(pool.submit(next, items, None))
            yield item
    finally:
        pool.shutdown(cancel_futures=True)
