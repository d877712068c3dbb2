"""The rows of the table: what is measured, and the goals it is measured against."""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any, NamedTuple


class Goal(NamedTuple):
    """An upper bound, or a lower one where ``more`` is true, in the unit of its row."""

    limit: float
    more: bool = False

    def met(self, value: float) -> bool:
        return value >= self.limit if self.more else value <= self.limit

    def share(self, value: float) -> float:
        """How much of what is allowed is used up: 1 just meets the goal, more misses it."""
        return self.limit / value if self.more else value / self.limit

    def __str__(self) -> str:
        return f"{'≥' if self.more else '≤'} {self.limit:g}"


# The project's speed goals, by the key of the row that shows whether they are met. Times are
# those of two cores without a graphics card (Mesa's llvmpipe), unless the key says otherwise.
GOALS: dict[str, Goal] = {
    "import": Goal(0.5),
    "bundle sun_editor": Goal(300),
    "bundle sky_explorer": Goal(300),
    "bundle compare": Goal(300),
    "bundle study": Goal(120),
    "bundle standalone": Goal(120),
    "network file": Goal(5),
    "network": Goal(0.15),
    "first frame ever": Goal(8),
    "first frame": Goal(1.5),
    "canvas sun drag": Goal(33),
    "canvas sun drag, graphics card": Goal(2),
    "canvas turbidity drag": Goal(120),
    "explorer sun drag": Goal(33),
    "explorer turbidity drag": Goal(120),
    "kernel frame": Goal(40),
    "kernel turbidity drag": Goal(120),
    "kernel frame 12 MP": Goal(1.5),
    "kernel frame 24 MP": Goal(3),
    "peak memory 24 MP": Goal(1.5),
    "time against pixels": Goal(1.1),
    "memory against pixels": Goal(1.1),
    "one more effect": Goal(1.15),
    "first picture": Goal(1),
    "editable": Goal(5),
    "20 editors, frame": Goal(1.25),
    "20 editors, contexts": Goal(4),
    "stroke": Goal(0.3),
    "saved by JupyterLab, SunEditor": Goal(0.6),
    "saved by JupyterLab, SkyExplorer": Goal(0.5),
    "saved by JupyterLab, Compare": Goal(0.6),
    "saved by JupyterLab, Study": Goal(0.5),
    "saved by nbclient, SunEditor": Goal(0.6),
    "saved by nbclient, SkyExplorer": Goal(0.5),
    "saved by nbclient, Compare": Goal(0.6),
    "saved by nbclient, Study": Goal(0.5),
    "film": Goal(12, more=True),
    "thesis in NumPy": Goal(30, more=True),
}


@dataclass(frozen=True)
class Row:
    """One figure; times are medians.

    ``low`` and ``high`` are the least and the most of ``runs`` runs, ``processor`` the median
    processor time in the row's unit (a busy machine makes ``value`` longer, and this hardly).
    ``peer`` is what something else takes for the same, in the same unit and run; ``ratio`` what
    it takes times as much as we do.
    """

    key: str
    what: str
    value: float
    unit: str
    low: float | None = None
    high: float | None = None
    runs: int = 1
    processor: float | None = None
    peer: float | None = None
    ratio: float | None = None
    note: str = ""
    error: str = ""

    @property
    def goal(self) -> Goal | None:
        return GOALS.get(self.key)

    @property
    def met(self) -> bool | None:
        return None if self.goal is None or self.error else self.goal.met(self.value)

    def as_json(self) -> dict[str, Any]:
        goal = self.goal
        value = None if math.isnan(self.value) else self.value  # JSON has no NaN
        told = None if goal is None else str(goal)
        return {**asdict(self), "value": value, "goal": told, "met": self.met}


Rows = Iterator[Row]


def not_measured(key: str, reason: str) -> Row:
    """A row that the machine or an error kept from being measured."""
    return Row(key, key, float("nan"), "", runs=0, error=reason)


def of_times(key: str, what: str, times: Any, unit: str, **more: Any) -> Row:
    """Return the row of measured ``Times`` in ``unit``, "s" or "ms"."""
    scale = {"s": 1.0, "ms": 1000.0}[unit]
    return Row(
        key,
        what,
        scale * statistics.median(times.wall),
        unit,
        low=scale * min(times.wall),
        high=scale * max(times.wall),
        runs=len(times.wall),
        processor=scale * statistics.median(times.processor) if times.processor else None,
        **more,
    )
