"""What became of each photo of a batch, as rows, as text, as HTML and as CSV."""

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

_SHOWN = 40  # rows of a table on a screen; failed ones are always shown
_HEADINGS = ("photo", "picture", "state", "seconds", "what")


@dataclass(frozen=True)
class BatchRow:
    """What became of one photo.

    Attributes
    ----------
    photo : Path
    output : Path or None
        Its picture; None when it failed.
    state : {"done", "skipped", "failed"}
        Skipped: an earlier run had made this very picture.
    seconds : float
        On its worker; 0 when nothing was done.
    error : str
        Why it failed and what to do; else empty.
    worker : str
        Machine and process that did it.
    notes : tuple of str
        What a person should know about the photo, such as that it shows no sky.
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
        The whole batch took.
    where : str
        Who did it: "2 worker processes", "this process" …; empty when nothing was to be done.
    """

    rows: tuple[BatchRow, ...]
    seconds: float
    where: str

    @property
    def done(self) -> tuple[BatchRow, ...]:
        """Rows of the pictures that this run made."""
        return self._rows("done")

    @property
    def skipped(self) -> tuple[BatchRow, ...]:
        """Rows of the pictures that were there already."""
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
        """One sentence: how many of each, how long, and where."""
        parts = [f"{len(self.done)} done"]
        parts += [f"{len(self.skipped)} skipped"] if self.skipped else []
        parts += [f"{len(self.failed)} failed"]
        where = f" ({self.where})" if self.where else ""
        return (
            f"{len(self)} {'photo' if len(self) == 1 else 'photos'}: {', '.join(parts)} in "
            f"{_duration(self.seconds)}{where}."
        )

    def __str__(self) -> str:
        """Return the table of a terminal, with the summary below."""
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
        """Return the rows for a screen, and how many are left out: never one that failed."""
        told = [row for row in self.rows if row.state == "failed"]
        quiet = [row for row in self.rows if row.state != "failed"]
        kept = {id(row) for row in [*told, *quiet[: max(0, _SHOWN - len(told))]]}
        rows = [row for row in self.rows if id(row) in kept]
        return rows, len(self.rows) - len(rows)

    def to_csv(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> Path:
        """Write all rows as CSV (UTF-8, RFC 4180) with a line of headings.

        Parameters
        ----------
        path : path
            Where to write them.
        overwrite : bool
            Replace an existing file.

        Returns
        -------
        Path
            Where they are.

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
            # Names of files need not be text.
            unfinished.write_text(text.getvalue(), "utf-8", "backslashreplace", newline="")
        return place


_COLUMNS = tuple(field.name for field in dataclasses.fields(BatchRow))


def is_table(path: Path) -> bool:
    """Whether a file is the table of an earlier run, which the same command may replace."""
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
    """Return what was found wrong first; all of it, and what to do, stands in the CSV."""
    return re.split(r"(?<=\.)\s+(?=[A-Z])", notes[0], maxsplit=1)[0] if notes else ""


def _duration(seconds: float) -> str:
    if seconds < 100:
        return f"{seconds:.1f} s"
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest} s" if minutes < 60 else f"{minutes // 60} h {minutes % 60} min"
