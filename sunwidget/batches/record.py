"""The record of a batch, kept beside its pictures, from which an interrupted batch resumes.

Each finished picture appends one line of JSON. The last line of a picture is valid; a line that a
crash truncated is ignored.
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
from sunwidget.batches.request import Request
from sunwidget.version import __version__

FILE_NAME = ".sunwidget-batch.jsonl"


@dataclass(frozen=True)
class Entry:
    """A finished picture: its photo, its recipe, and the SHA-256 of its files."""

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
            return  # truncated, or of another version: the picture is written again

    def _keep(self, output: str, entry: Entry) -> None:
        self.entries[output] = entry
        self._digests[entry.photo, entry.size, entry.modified] = entry.digest
        self._sums |= entry.files

    def digest(self, photo: Path) -> str:
        """Return the SHA-256 of a photo; read it again only if its size or time changed."""
        stat = photo.stat()
        known = self._digests.get((str(photo), stat.st_size, stat.st_mtime_ns))
        return known or digest_of(photo)

    def is_done(self, output: str, digest: str, recipe: str) -> bool:
        """Return whether the picture of this photo by this recipe exists."""
        entry = self.entries.get(output)
        return (
            entry is not None
            and (entry.digest, entry.recipe) == (digest, recipe)
            and all((self.folder / name).is_file() for name in entry.files)
        )

    def is_own(self, name: str) -> bool:
        """Return whether a batch wrote the file and it has not changed since."""
        path = self.folder / name
        return name in self._sums and path.is_file() and digest_of(path) == self._sums[name]

    def has_made(self, path: Path) -> bool:
        """Return whether a path is a picture of the record and therefore not a photo."""
        try:
            return str(path.relative_to(self.folder)) in self._sums
        except ValueError:
            return False

    def add(
        self, output: str, photo: Path, digest: str, recipe: str, files: dict[str, bytes]
    ) -> None:
        """Record a picture whose files have been written."""
        stat = photo.stat()
        sums = {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}
        entry = Entry(str(photo), stat.st_size, stat.st_mtime_ns, digest, recipe, sums)
        line = json.dumps({"output": output, **dataclasses.asdict(entry)}) + "\n"
        # Do not append to a line that a crash truncated.
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


def recipe_key(request: Request) -> str:
    """Return a hash of edit, preset, analysis, options and version, which identifies a recipe."""
    described = {
        "version": __version__,
        "edit": request.edit.to_dict(),
        **{
            f.name: getattr(request, f.name)
            for f in dataclasses.fields(request)
            if f.name != "edit"
        },
    }
    text = json.dumps(described, sort_keys=True, default=_plain)
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
        f"A batch cannot record a {type(value).__name__} for later runs. Pass numbers, strings, "
        "paths and arrays in analysis and options."
    )
