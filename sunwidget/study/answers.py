"""Answers of two-alternative comparisons and their CSV files."""

from __future__ import annotations

import csv
import math
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from sunwidget.errors import StudyError
from sunwidget.files import complete_or_absent, target

CHOICES = ("left", "right", "tie")
_SHOWN = 80  # characters of a refused value


class Answer(NamedTuple):
    """One comparison: a row of the CSV file.

    Parameters
    ----------
    rater : str
        The rater's name.
    trial : int
        Position of the comparison in this rater's order, from 1.
    picture : str
        Name of the photo; "" in a study of one photo.
    left, right : str
        Methods of the shown pictures.
    choice : {"left", "right", "tie"}
    seconds : float
        From the pictures' appearance to the answer.
    timestamp : str
        Time of the answer, ISO 8601 in UTC.
    """

    rater: str
    trial: int
    picture: str
    left: str
    right: str
    choice: str
    seconds: float
    timestamp: str

    @classmethod
    def from_row(cls, row: Mapping[str, Any]) -> Answer:
        """Return the answer of a row from a CSV reader or from the browser.

        Raises
        ------
        StudyError
            When a column is missing or a value is invalid.
        """
        if not isinstance(row, Mapping):
            raise StudyError(f"An answer must be a mapping of columns, not {type(row).__name__}.")
        lacking = [name for name in cls._fields if row.get(name) is None]
        if lacking:
            raise StudyError(
                f"An answer has columns {', '.join(cls._fields)}; {lacking[0]} is missing."
            )
        try:
            trial, seconds = int(row["trial"]), float(row["seconds"])
        except (TypeError, ValueError, OverflowError):
            trial, seconds = 0, math.nan
        texts = {name: str(row[name]) for name in cls._fields if name not in ("trial", "seconds")}
        answer = cls(trial=trial, seconds=seconds, **texts)
        if trial < 1 or not math.isfinite(seconds) or seconds < 0:
            raise StudyError(
                "trial must be a whole number from 1 and seconds a number from 0, not "
                f"{str(row['trial'])[:_SHOWN]!r} and {str(row['seconds'])[:_SHOWN]!r}."
            )
        if answer.choice not in CHOICES:
            raise StudyError(f"choice must be left, right or tie, not {answer.choice[:_SHOWN]!r}.")
        if answer.left == answer.right or not answer.left or not answer.right:
            raise StudyError(
                "left and right must name two different methods, not "
                f"{answer.left[:_SHOWN]!r} and {answer.right[:_SHOWN]!r}."
            )
        return answer


def write_csv(answers: Iterable[Answer], path: Any, *, overwrite: bool = False) -> Path:
    """Write one row per answer, with the columns of ``Answer``, as UTF-8; return the path.

    Raises
    ------
    FileExistsError
        When ``path`` exists and ``overwrite`` is false.
    """
    place = target(path, overwrite=overwrite)
    with (
        complete_or_absent(place, overwrite=overwrite) as unfinished,
        unfinished.open("w", encoding="utf-8", newline="") as file,
    ):
        writer = csv.writer(file)
        writer.writerow(Answer._fields)
        writer.writerows(answers)
    return place


def read_csv(*paths: str | os.PathLike[str]) -> list[Answer]:
    """Read the answers of one or more files, for example of several raters.

    An answer that occurs in several files, such as two files of one session, counts once.

    Raises
    ------
    StudyError
        For a file without the columns of ``Answer``, or an invalid row; the message names file and
        line.
    """
    found: dict[Answer, None] = {}
    for path in paths:
        try:
            # A spreadsheet may have written a byte order mark before the first column's name.
            with Path(path).open(encoding="utf-8-sig", newline="") as file:
                reader = csv.DictReader(file)
                for row in reader:
                    try:
                        found[Answer.from_row(row)] = None
                    except StudyError as error:
                        line = reader.line_num
                        raise StudyError(f"{Path(path).name}, line {line}: {error}") from None
        except (csv.Error, UnicodeDecodeError) as error:
            raise StudyError(f"{Path(path).name} is not a study's CSV file: {error}") from None
    return list(found)
