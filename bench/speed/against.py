"""Measure this tree and another revision of it in turn, and print the ratio of each row.

Two runs of a busy machine an hour apart tell little; runs in turn share what disturbs them. Rows
are compared by the processor's time where both trees know it.
"""

from __future__ import annotations

import json
import math
import os
import shutil
import statistics
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

Table = dict[str, Any]  # a bench.json


class Change(NamedTuple):
    """One row in both trees: medians over the turns, and the median of the ratios now / then."""

    what: str
    unit: str
    then: float
    now: float
    ratio: float
    by_processor: bool


def checked_out(revision: str, root: Path) -> Path:
    """Return a folder in ``build/against`` that holds ``revision`` with its front end built.

    Raises
    ------
    SystemExit
        When git knows no such revision.
    """
    asked = ["git", "rev-parse", "--verify", "--quiet", f"{revision}^{{commit}}"]
    found = subprocess.run(asked, cwd=root, capture_output=True, text=True, check=False)
    if found.returncode:
        raise SystemExit(f"--against: git knows no revision {revision!r}; name a commit or a tag.")
    name = found.stdout.strip()
    folder = root / "build" / "against" / name[:12]
    made = folder / ".made"
    if made.exists():
        return folder
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    archive = subprocess.run(["git", "archive", name], cwd=root, capture_output=True, check=True)
    subprocess.run(["tar", "-x", "-C", folder], input=archive.stdout, check=True)
    # Of this tree: both are measured with the same libraries.
    (folder / "js" / "node_modules").symlink_to(root / "js" / "node_modules")
    subprocess.run(["npm", "--prefix", "js", "run", "--silent", "build"], cwd=folder, check=True)
    made.touch()
    return folder


def measured(tree: Path, arguments: Sequence[str]) -> Table:
    """Return the table that the bench of ``tree`` writes when run with ``arguments``."""
    paths = [str(tree), os.environ.get("PYTHONPATH", "")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths))}
    command = [sys.executable, "bench/bench.py", *arguments]
    subprocess.run(command, cwd=tree, env=environment, check=True, stdout=subprocess.DEVNULL)
    table: Table = json.loads((tree / "build" / "bench.json").read_text("utf-8"))
    return table


def in_turn(now: Path, then: Path, arguments: Sequence[str], turns: int) -> list[Change]:
    """Measure both trees ``turns`` times, first the one and then the other first."""
    pairs = []
    for turn in range(turns):
        order = (now, then) if turn % 2 == 0 else (then, now)
        tables = {tree: measured(tree, arguments) for tree in order}
        pairs.append((tables[now], tables[then]))
        print(f"turn {turn + 1} of {turns}", flush=True)
    return changes(pairs)


def changes(pairs: Sequence[tuple[Table, Table]]) -> list[Change]:
    """Compare tables (now, then) row by row; rows that one of them lacks are left out."""
    found = []
    tables = [tuple(_values(table) for table in pair) for pair in pairs]
    for key, row in tables[0][0].items():
        rows = [(now[key], then[key]) for now, then in tables if key in now and key in then]
        if len(rows) < len(tables):
            continue
        by_processor = all(side["processor"] for pair in rows for side in pair)
        figure = "processor" if by_processor else "value"
        now, then = ([pair[i][figure] for pair in rows] for i in (0, 1))
        ratios = [math.log(a / b) for a, b in zip(now, then, strict=True)]
        ratio = math.exp(statistics.median(ratios))
        medians = statistics.median(then), statistics.median(now)
        found.append(Change(row["what"], row["unit"], *medians, ratio, by_processor))
    return found


def _values(table: Table) -> dict[str, dict[str, Any]]:
    return {row["key"]: row for row in table["rows"] if not row["error"] and row["value"]}


def show(found: Sequence[Change], revision: str) -> None:
    """Print the changes, and of which rows the processor's time was compared."""
    print(f"\n{'':66}{revision[:10]:>10}{'now':>10}      ratio")
    for change in found:
        by = "  by the processor" if change.by_processor else ""
        print(
            f"{change.what:66}{change.then:>10.3g}{change.now:>10.3g} {change.unit:5}"
            f"{change.ratio:.2f}×{by}"
        )
