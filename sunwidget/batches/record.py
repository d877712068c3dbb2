"""What a batch has done, kept beside its pictures, so that it can go on where it stopped.

One line of JSON a picture, appended when the picture is whole; of a picture's lines the last one
counts, and a line that a crash cut short counts as none.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from sunwidget.batches.develop import digest_of
from sunwidget.batches.request import Wish
from sunwidget.version import __version__

FILE_NAME = ".sunwidget-batch.jsonl"


@dataclass(frozen=True)
class Entry:
    """A picture that was made: of which photo, by which recipe, and its files' SHA-256."""

    photo: str
    size: int
    modified: int
    digest: str
    recipe: str
    files: dict[str, str]


class Record:
    """The record of one folder of results."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.path = folder / FILE_NAME
        self.entries: dict[str, Entry] = {}
        self._digests: dict[tuple[str, int, int], str] = {}
        self._sums: dict[str, str] = {}
        if self.path.is_file():
            for line in self.path.read_text("utf-8", errors="replace").splitlines():
                self._read(line)

    def _read(self, line: str) -> None:
        try:
            stored = json.loads(line)
            entry = Entry(**{f.name: stored[f.name] for f in dataclasses.fields(Entry)})
            self._keep(stored["output"], entry)
        except (ValueError, KeyError, TypeError):
            return  # cut short, or of another version: that picture is made again

    def _keep(self, output: str, entry: Entry) -> None:
        self.entries[output] = entry
        self._digests[entry.photo, entry.size, entry.modified] = entry.digest
        self._sums |= entry.files

    def digest(self, photo: Path) -> str:
        """Return the SHA-256 of a photo, read again only when its size or time has changed."""
        stat = photo.stat()
        known = self._digests.get((str(photo), stat.st_size, stat.st_mtime_ns))
        return known or digest_of(photo)

    def is_done(self, output: str, digest: str, recipe: str) -> bool:
        """Whether this very picture of this photo by this recipe is there."""
        entry = self.entries.get(output)
        return (
            entry is not None
            and (entry.digest, entry.recipe) == (digest, recipe)
            and all((self.folder / name).is_file() for name in entry.files)
        )

    def is_own(self, name: str) -> bool:
        """Whether a file is what a batch wrote and nobody has changed since."""
        path = self.folder / name
        return name in self._sums and path.is_file() and digest_of(path) == self._sums[name]

    def has_made(self, path: Path) -> bool:
        """Whether a path is one of the pictures of the record, and hence no photo."""
        try:
            return str(path.relative_to(self.folder)) in self._sums
        except ValueError:
            return False

    def add(
        self, output: str, photo: Path, digest: str, recipe: str, files: dict[str, bytes]
    ) -> None:
        """Note a picture whose files have been written."""
        stat = photo.stat()
        sums = {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}
        entry = Entry(str(photo), stat.st_size, stat.st_mtime_ns, digest, recipe, sums)
        line = json.dumps({"output": output, **dataclasses.asdict(entry)}) + "\n"
        # A line that a crash cut short must not swallow this one.
        if self.path.is_file() and not _ends_in_newline(self.path):
            line = "\n" + line
        with self.path.open("a", encoding="utf-8") as file:
            file.write(line)
        self._keep(output, entry)


def _ends_in_newline(path: Path) -> bool:
    with path.open("rb") as file:
        if file.seek(0, os.SEEK_END) == 0:
            return True
        file.seek(-1, os.SEEK_END)
        return file.read(1) == b"\n"


def recipe_key(wish: Wish) -> str:
    """Return what tells recipes apart: a hash of edit, preset, analysis, options and version."""
    told = {
        "version": __version__,
        "edit": wish.edit.to_dict(),
        **{f.name: getattr(wish, f.name) for f in dataclasses.fields(wish) if f.name != "edit"},
    }
    text = json.dumps(told, sort_keys=True, default=_plain)
    return hashlib.sha256(text.encode()).hexdigest()


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        content = hashlib.sha256(np.ascontiguousarray(value).tobytes()).hexdigest()
        return [str(value.dtype), value.shape, content]
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return [type(value).__name__, dataclasses.asdict(value)]
    raise TypeError(
        f"A batch cannot remember {type(value).__name__} from run to run: in analysis and options "
        "pass numbers, texts, paths and arrays."
    )
