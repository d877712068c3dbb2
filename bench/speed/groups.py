"""The groups of the table, in its order; each is a module with ``KEYS`` and ``rows(effort)``.

``KEYS`` are the rows that a group promises: those with a goal, and those against a peer.
"""

from __future__ import annotations

import importlib
import time
import traceback
from collections.abc import Callable

from .effort import Effort
from .rows import Row, Rows, not_measured

# Names that --only chooses by, and modules.
GROUPS = {
    "start": "start",
    "kernel": "kernel",
    "canvas": "canvas",
    "explorer": "explorer",
    "effects": "effects",
    "opening": "opening",
    "sizes": "sizes",
    "editors": "many_editors",
    "saved": "saved",
    "film": "film",
    "thesis": "peer_thesis",
    "grabcut": "peer_grabcut",
    "march": "peer_march",
    "bruneton": "peer_bruneton",
}


def keys(name: str) -> tuple[str, ...]:
    """Return the rows that a group promises."""
    promised: tuple[str, ...] = importlib.import_module(f"speed.{GROUPS[name]}").KEYS
    return promised


def measure(name: str, effort: Effort, show: Callable[[Row], None]) -> tuple[list[Row], float]:
    """Return a group's rows and the seconds it took; what fails becomes rows that say why."""
    begin = time.perf_counter()
    found: list[Row] = []
    reason = "the group did not yield it"
    try:
        rows: Rows = importlib.import_module(f"speed.{GROUPS[name]}").rows(effort)
        for row in rows:
            found.append(row)
            show(row)
    except Exception as error:  # noqa: BLE001 - the table goes on without this group
        traceback.print_exc()
        reason = f"{type(error).__name__}: {error}".splitlines()[0]
    there = {row.key for row in found}
    for key in keys(name):
        if key in there:
            continue
        row = not_measured(key, reason)
        found.append(row)
        show(row)
    return found, time.perf_counter() - begin
