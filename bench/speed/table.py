"""The table in print, what changed since another run, and the table of docs/developer/speed.md."""

from __future__ import annotations

from typing import Any

from .rows import Goal, Row


def figure(value: float | None) -> str:
    """Three significant digits, without an exponent where one can read it."""
    if value is None or value != value:  # noqa: PLR0124 - NaN is unlike itself
        return ""
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.3g}"


def cells(row: Row) -> dict[str, str]:
    """Return what stands in the columns."""
    goal: Goal | None = row.goal
    spread = ""
    if row.low is not None and row.runs > 1:
        spread = f"{figure(row.low)}–{figure(row.high)}"
    verdict = {True: "met", False: "MISSED", None: ""}[row.met]
    return {
        "what": row.what,
        "value": f"{figure(row.value)} {row.unit}".strip(),
        "spread": spread,
        "processor": figure(row.processor),
        "goal": "" if goal is None else str(goal),
        "of goal": "" if goal is None or row.error else f"{goal.share(row.value):.2f}×",
        "peer": "" if row.peer is None else f"{figure(row.peer)} {row.unit}",
        "ratio": "" if row.ratio is None else f"{figure(row.ratio)}×",
        "": verdict,
    }


WIDTHS = (66, 15, 13, 10, 7, 9, 12, 8, 7)


def line(columns: dict[str, str]) -> str:
    texts = list(columns.values())
    return texts[0].ljust(WIDTHS[0]) + "".join(
        text.rjust(width) for text, width in zip(texts[1:], WIDTHS[1:], strict=True)
    )


def heading() -> str:
    return line({**dict.fromkeys(cells(Row("", "", 0.0, "")), ""), "what": ""} | _NAMES)


_NAMES = {
    "what": "what",
    "value": "value",
    "spread": "runs",
    "processor": "processor",
    "goal": "goal",
    "of goal": "of goal",
    "peer": "peer",
    "ratio": "ratio",
}


def show(row: Row) -> None:
    """Print a row, and below it what is to be said of it."""
    if row.error:
        print(f"{row.what:66} not measured: {row.error}", flush=True)
        return
    print(line(cells(row)).rstrip(), flush=True)
    if row.note:
        print(f"    {row.note}", flush=True)


def compare(rows: list[Row], before: dict[str, Any]) -> None:
    """Print what each row is of what it was: by the processor where both runs know it."""
    old = {row["key"]: row for row in before["rows"] if not row["error"]}
    print(f"\nSince {before['machine']['time']} ({before['machine']['processor']}):")
    for row in rows:
        was = old.get(row.key)
        if was is None or row.error or not was["value"]:
            continue
        change = f"{row.value / was['value']:.2f}×"
        if row.processor and was["processor"]:
            change += f", {row.processor / was['processor']:.2f}× by the processor"
        print(
            f"{row.what:66}{figure(was['value']):>8} → {figure(row.value):>6} {row.unit:9} {change}"
        )


def markdown(rows: list[Row], facts: dict[str, Any]) -> str:
    """Return the tables of docs/developer/speed.md: goals first, then peers."""
    goals = [row for row in rows if row.goal is not None]
    peers = [row for row in rows if row.peer is not None]
    where = (
        f"Measured on {facts['cores']} cores ({facts['processor']}), {facts['renderer']}, "
        f"Python {facts['python']}, load average {facts['load_average']}, {facts['time'][:10]}. "
        "Runs: least and most."
    )
    lines = [
        where,
        "",
        "| what | measured | runs | goal | |",
        "|---|---|---|---|---|",
    ]
    for row in goals:
        c = cells(row)
        if row.error:
            lines.append(f"| {row.what} | not measured: {row.error} | | {c['goal']} | |")
        else:
            verdict = "met" if row.met else "**missed**"
            lines.append(
                f"| {c['what']} | {c['value']} | {c['spread']} | {c['goal']} | {verdict} |"
            )
    lines += ["", "| what, and its peer | ours | peer | peer / ours | |", "|---|---|---|---|---|"]
    for row in peers:
        c = cells(row)
        lines.append(f"| {c['what']} | {c['value']} | {c['peer']} | {c['ratio']} | {row.note} |")
    return "\n".join(lines) + "\n"
