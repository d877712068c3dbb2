"""Measure speed: a table on stdout, build/bench.json, and a plot against the pixel count.

usage: python bench/bench.py [--quick] [--only NAME,NAME] [--compare OLD.json] [--docs]
       python bench/bench.py --against REV [--turns 3] [--quick] [--only NAME,NAME]

Every goal of speed.md is a row, met or MISSED, and so is every peer. Times are medians of
wall-clock time, with processor time beside them, which a busy machine hardly changes. A row that
cannot be measured gives the reason; the others continue. Groups (--only): bench/speed/groups.py.
"""

from __future__ import annotations

import argparse
import json
import shutil
import sys
from pathlib import Path

from speed import against, plots, table
from speed.effort import FULL, QUICK
from speed.groups import GROUPS, measure
from speed.machine import machine
from speed.rows import Row

ROOT = Path(__file__).resolve().parents[1]
BUILD, DOCS = ROOT / "build", ROOT / "docs" / "developer"
MARKS = ("<!-- the table, written by bench/bench.py --docs -->", "<!-- end of the table -->")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="fewer runs and sizes, two minutes")
    parser.add_argument("--only", default="", help=f"groups, of {', '.join(GROUPS)}")
    parser.add_argument("--compare", type=Path, metavar="OLD", help="a bench.json to compare with")
    parser.add_argument(
        "--docs", action="store_true", help="write docs/developer/speed.md's table and plot"
    )
    parser.add_argument("--against", metavar="REV", help="measure this tree and REV in turn")
    parser.add_argument("--turns", type=int, default=3, help="how often each with --against")
    options = parser.parse_args()
    chosen = [name for name in options.only.split(",") if name] or list(GROUPS)
    unknown = [name for name in chosen if name not in GROUPS]
    if unknown:
        parser.error(f"no group {', '.join(unknown)}; there are {', '.join(GROUPS)}")
    if options.against:
        then = against.checked_out(options.against, ROOT)
        arguments = ["--only", ",".join(chosen), *(["--quick"] if options.quick else [])]
        against.show(against.in_turn(ROOT, then, arguments, options.turns), options.against)
        return 0
    # Read first: it may be the file that is written below.
    before = json.loads(options.compare.read_text("utf-8")) if options.compare else None
    facts = machine()
    print(f"{facts['processor']}, {facts['cores']} cores, {facts['renderer']}")
    print(f"load average {facts['load_average']}\n\n{table.heading()}")
    rows: list[Row] = []
    seconds: dict[str, float] = {}
    for name in chosen:
        print(f"\n{name}")
        found, seconds[name] = measure(name, QUICK if options.quick else FULL, table.show)
        rows += found
    write(rows, facts, seconds)
    if options.docs:
        write_docs(table.markdown(rows, facts))
    if before is not None:
        table.compare(rows, before)
    judged = [row for row in rows if row.met is not None]
    missed = [row.what for row in judged if not row.met]
    print(f"\n{len(judged) - len(missed)} of {len(judged)} goals met", end="")
    print(f"; missed: {'; '.join(missed)}" if missed else "")
    print(f"{sum(seconds.values()):.0f} s; build/bench.json")
    return 0


def write(rows: list[Row], facts: dict[str, object], seconds: dict[str, float]) -> None:
    """Write build/bench.json and the plot."""
    BUILD.mkdir(exist_ok=True)
    kept = {"machine": facts, "seconds": seconds, "rows": [row.as_json() for row in rows]}
    text = json.dumps(kept, indent=1, ensure_ascii=False)
    (BUILD / "bench.json").write_text(text + "\n", "utf-8")
    plots.against_pixels(rows, BUILD / "bench-pixels.svg")


def write_docs(text: str) -> None:
    """Put the table between its marks in docs/developer/speed.md, and the plot below it."""
    page, plot = DOCS / "speed.md", BUILD / "bench-pixels.svg"
    if plot.is_file():
        shutil.copyfile(plot, DOCS / "speed-pixels.svg")
        text += "\n![Time and peak memory against the pixel count](speed-pixels.svg)\n"
    before, _, rest = page.read_text("utf-8").partition(MARKS[0])
    _, _, after = rest.partition(MARKS[1])
    page.write_text(f"{before}{MARKS[0]}\n{text}{MARKS[1]}{after}", "utf-8")


if __name__ == "__main__":
    sys.exit(main())
