"""The report of a batch: one row per photo, as text, HTML and CSV."""

from __future__ import annotations

import csv
import dataclasses
import html
import io
import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from sunwidget.files import complete_or_absent, target
from sunwidget.messages import printable

State = Literal["done", "skipped", "failed"]

_SHOWN = 40  # rows of a table on screen; failed photos are always shown
_HEADINGS = ("photo", "picture", "state", "seconds", "what")


@dataclass(frozen=True)
class BatchRow:
    """The result of one photo.

    Attributes
    ----------
    photo : Path
    output : Path or None
        The written picture; None if the photo failed.
    state : {"done", "skipped", "failed"}
        "skipped": an earlier run wrote the same picture.
    seconds : float
        Time on the worker; 0 for a skipped photo.
    error : str
        The cause of a failure and its remedy, or "".
    worker : str
        Machine and process that developed the photo.
    notes : tuple of str
        Warnings about the photo, such as that it shows no sky.
    """

    photo: Path
    output: Path | None
    state: State
    seconds: float = 0.0
    error: str = ""
    worker: str = ""
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class BatchReport:
    """The rows of a batch in the order of its photos; prints as a table.

    Attributes
    ----------
    rows : tuple of BatchRow
    seconds : float
        Duration of the whole batch.
    where : str
        Where it ran: "2 worker processes", "this process" …; "" if there was nothing to do.
    """

    rows: tuple[BatchRow, ...]
    seconds: float
    where: str

    @property
    def done(self) -> tuple[BatchRow, ...]:
        """Rows of the pictures that this run wrote."""
        return self._rows("done")

    @property
    def skipped(self) -> tuple[BatchRow, ...]:
        """Rows of the pictures that an earlier run wrote."""
        return self._rows("skipped")

    @property
    def failed(self) -> tuple[BatchRow, ...]:
        """Rows of the photos without a picture."""
        return self._rows("failed")

    def _rows(self, state: State) -> tuple[BatchRow, ...]:
        return tuple(row for row in self.rows if row.state == state)

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[BatchRow]:
        return iter(self.rows)

    @property
    def summary(self) -> str:
        """One sentence: counts by state, duration and place."""
        parts = [f"{len(self.done)} done"]
        parts += [f"{len(self.skipped)} skipped"] if self.skipped else []
        parts += [f"{len(self.failed)} failed"]
        where = f" ({self.where})" if self.where else ""
        return (
            f"{len(self)} {'photo' if len(self) == 1 else 'photos'}: {', '.join(parts)} in "
            f"{_duration(self.seconds)}{where}."
        )

    def __str__(self) -> str:
        """Return the table for a terminal, followed by the summary."""
        rows, left_out = self._shown()
        cells = [_HEADINGS[:-1], *(_cells(row)[:-1] for row in rows)]
        widths = [max(len(line[i]) for line in cells) for i in range(len(cells[0]))]
        lines = []
        for i, line in enumerate(cells):
            padded = [text.ljust(width) for text, width in zip(line, widths, strict=True)]
            padded[3] = line[3].rjust(widths[3])
            lines.append(printable("  ".join(padded).rstrip()))
            if i and (what := _cells(rows[i - 1])[-1]):
                lines.append(printable(f"    {what}"))
        if left_out:
            lines.append(f"… and {left_out} more that are done or skipped")
        return "\n".join([*lines, "", self.summary])

    def _repr_html_(self) -> str:
        rows, left_out = self._shown()
        head = "".join(f"<th>{name}</th>" for name in _HEADINGS)
        body = "".join(
            "<tr>" + "".join(f"<td>{html.escape(text)}</td>" for text in _cells(row)) + "</tr>"
            for row in rows
        )
        more = f"<p>… and {left_out} more that are done or skipped</p>" if left_out else ""
        return (
            f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"
            f"<p>{html.escape(self.summary)}</p>"
        )

    def _shown(self) -> tuple[list[BatchRow], int]:
        """Return the rows for a screen and the number omitted; failed photos are never omitted."""
        failed = [row for row in self.rows if row.state == "failed"]
        others = [row for row in self.rows if row.state != "failed"]
        kept = {id(row) for row in [*failed, *others[: max(0, _SHOWN - len(failed))]]}
        rows = [row for row in self.rows if id(row) in kept]
        return rows, len(self.rows) - len(rows)

    def to_csv(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> Path:
        """Write all rows as CSV (UTF-8, RFC 4180) with a header line.

        Parameters
        ----------
        path : path
            The file to write.
        overwrite : bool
            Replace an existing file.

        Returns
        -------
        Path
            The written file.

        Raises
        ------
        FileExistsError
            When ``path`` exists and ``overwrite`` is false.
        """
        place = target(path, overwrite=overwrite)
        text = io.StringIO(newline="")
        writer = csv.writer(text)
        writer.writerow(_COLUMNS)
        for row in self.rows:
            seconds = f"{row.seconds:.3f}"
            output = "" if row.output is None else row.output
            notes = " ".join(row.notes)
            writer.writerow((row.photo, output, row.state, seconds, row.error, row.worker, notes))
        with complete_or_absent(place, overwrite=overwrite) as unfinished:
            # File names need not be valid text.
            unfinished.write_text(text.getvalue(), "utf-8", "backslashreplace", newline="")
        return place


_COLUMNS = tuple(field.name for field in dataclasses.fields(BatchRow))


def is_table(path: Path) -> bool:
    """Return whether a file is the table of an earlier run, which a new run may replace."""
    try:
        with path.open(encoding="utf-8", newline="") as file:
            return file.readline().rstrip() == ",".join(_COLUMNS)
    except (OSError, UnicodeDecodeError):
        return False


def _cells(row: BatchRow) -> tuple[str, ...]:
    output = "" if row.output is None else row.output.name
    seconds = f"{row.seconds:.1f}" if row.seconds else ""
    return row.photo.name, output, row.state, seconds, row.error or _first_sentence(row.notes)


def _first_sentence(notes: tuple[str, ...]) -> str:
    """Return the first sentence of the first note; the CSV has all of them."""
    return re.split(r"(?<=\.)\s+(?=[A-Z])", notes[0], maxsplit=1)[0] if notes else ""


def _duration(seconds: float) -> str:
    if seconds < 100:
        return f"{seconds:.1f} s"
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes < 60 else f"{minutes // 60} h {minutes % 60} min"
