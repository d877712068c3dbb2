"""The argument parser: one-line errors that suggest the flag that was probably meant."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Sequence
from itertools import takewhile
from typing import Any, NoReturn

from sunwidget.cli.ending import one_line
from sunwidget.messages import did_you_mean

_CHOICES = re.compile(r"invalid choice: '(.*)' \(choose from (.*)\)$")


class Parser(argparse.ArgumentParser):
    """An ArgumentParser with one-line errors and without abbreviated flags.

    ``several`` is the error message for more than one photo; None where a command takes many
    photos or no photo.
    """

    def __init__(self, **options: Any) -> None:
        super().__init__(allow_abbrev=False, **options)
        self.several: str | None = None
        # A sun left of the picture, --sun -300,200, is a value, not a flag.
        self._negative_number_matcher = re.compile(r"-\d[\d.,e+-]*$", re.IGNORECASE)
        self.add_argument(
            "--debug",
            action="store_true",
            default=argparse.SUPPRESS,
            help="show an error's traceback",
        )

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse; report misspelled flags before missing arguments."""
        given = sys.argv[1:] if args is None else list(args)
        self._refuse_misspelt(given)
        first = list(takewhile(lambda text: not text.startswith("-"), given))
        if self.several and len(first) > 1:
            self.error(f"{self.several} Too many: {' '.join(first[1:])}")
        options, rest = super().parse_known_args(given, namespace)
        if self.several and rest and not any(text.startswith("-") for text in rest):
            self.error(f"{self.several} Too many: {' '.join(rest)}")
        return options, rest

    def error(self, message: str) -> NoReturn:
        """Print the error in one line and exit with status 2."""
        choices = _CHOICES.search(message)
        if choices:
            names = [name.strip("'") for name in choices[2].split(", ")]
            message += f".{did_you_mean(choices[1], names, quote='')}"
        self.exit(2, f"{self.prog}: {one_line(message)}\n")

    def _refuse_misspelt(self, given: Sequence[str]) -> None:
        flags = list(takewhile(lambda text: text != "--", given))
        if self._subparsers is not None:  # later flags belong to the command
            flags = list(takewhile(lambda text: text.startswith("-"), flags))
        known = self._option_string_actions
        for text in flags:
            name = text.partition("=")[0]
            # As in argparse, an argument with a space is not a flag.
            if name.startswith("--") and " " not in text and name not in known:
                shown = [flag for flag in known if flag.startswith("--")]
                self.error(f"unrecognized flag {name}.{did_you_mean(name, shown, quote='')}")
