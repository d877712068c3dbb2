"""Making the next while the present one is being used."""

from __future__ import annotations

from collections import deque
from collections.abc import Generator, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

T = TypeVar("T")

# How many may wait: enough to even out a slow one, few enough for memory.
_AHEAD = 2


def ahead(items: Iterator[T]) -> Generator[T]:
    """Pass on what ``items`` yields (never None), the next two made on a thread meanwhile.

    What making one raises is raised here. Closing it (``contextlib.closing``), or leaving it by
    an error, waits for the one that is being made and makes no more.
    """
    pool = ThreadPoolExecutor(1, thread_name_prefix="sunwidget-ahead")
    try:
        waiting = deque(pool.submit(next, items, None) for _ in range(_AHEAD))
        while (item := waiting.popleft().result()) is not None:
            waiting.append(pool.submit(next, items, None))
            yield item
    finally:
        pool.shutdown(cancel_futures=True)
