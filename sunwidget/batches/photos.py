"""Which photos a batch is of, and what their pictures are called."""

from __future__ import annotations

import glob
import os
import string
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from sunwidget.export.formats import FORMATS

FIELDS = ("name", "folder", "number", "ending")

# What a folder is searched for. A pattern or a list names its files itself.
_PICTURES = frozenset(
    {".jpg", ".jpeg", ".png", ".tif", ".tiff", ".webp", ".bmp", ".heic", ".heif", ".avif"}
    | {".dng", ".nef", ".cr2", ".cr3", ".arw", ".orf", ".rw2", ".raf", ".pef", ".srw"}
)


def find(photos: Any) -> list[Path]:
    """Return absolute paths, each once, in the order named and sorted within a pattern.

    Parameters
    ----------
    photos : path, pattern, folder, or an iterable of these
        ``"photos/*.jpg"``, ``"photos/**/*.jpg"``; of a folder the pictures in it.

    Raises
    ------
    FileNotFoundError
        When a pattern or folder holds nothing. A path that names one missing file is kept: the
        batch reports it.
    """
    named = [photos] if isinstance(photos, (str, os.PathLike)) else photos
    if not isinstance(named, Iterable):
        raise TypeError(
            f"photos must be a path, a pattern as 'photos/*.jpg', a folder or a list of these, "
            f"not {type(photos).__name__}."
        )
    found: dict[Path, None] = {}
    for entry in named:
        if not isinstance(entry, (str, os.PathLike)):
            raise TypeError(
                f"A batch takes paths, not {type(entry).__name__}: a photo is known by its file "
                "when the batch goes on. Save it first."
            )
        for path in _of(os.path.expanduser(os.fspath(entry))):  # noqa: PTH111 - a pattern is no path
            # Not resolved: a link's own name is the photo's name.
            found[Path(os.path.abspath(path))] = None  # noqa: PTH100
    if not found:
        raise FileNotFoundError("No photos were named.")
    return list(found)


def _of(text: str) -> Sequence[str]:
    # A file may be called IMG[1].jpg: what exists is no pattern.
    if Path(text).is_dir():
        inside = sorted(p for p in Path(text).iterdir() if p.suffix.lower() in _PICTURES)
        if not inside:
            raise FileNotFoundError(f"There is no picture in the folder {text}.")
        return [str(p) for p in inside]
    if Path(text).exists() or not glob.has_magic(text):
        return [text]
    matches = sorted(p for p in glob.glob(text, recursive=True) if not Path(p).is_dir())  # noqa: PTH207
    if not matches:
        raise FileNotFoundError(f"No file matches {text}. Looked in {Path.cwd()}.")
    return matches


def names(photos: Sequence[Path], template: str, ending: str | None) -> list[str]:
    """Return the name of each photo's picture, relative to the folder of the results.

    Parameters
    ----------
    photos : sequence of Path
    template : str
        With ``{name}``, ``{folder}``, ``{number}`` and ``{ending}`` of the photo; a slash makes a
        folder.
    ending : str or None
        ".png" …; None keeps the photo's own where it can be written, and takes .tif elsewhere.

    Raises
    ------
    ValueError
        For an unknown field or ending, a name that leaves the folder, or two photos with one
        name.
    """
    _check(template)
    if ending is not None:
        ending = "." + ending.lower().lstrip(".")
        if ending not in FORMATS:
            raise ValueError(
                f"format = {ending.lstrip('.')!r} cannot be written; there are "
                f"{', '.join(known.lstrip('.') for known in FORMATS)}."
            )
    taken: dict[str, Path] = {}
    found = []
    for number, photo in enumerate(photos, start=1):
        own = photo.suffix.lower()
        try:
            stem = template.format(
                name=photo.stem, folder=photo.parent.name, number=number, ending=own.lstrip(".")
            )
        except (ValueError, AttributeError, IndexError, KeyError) as error:
            raise ValueError(f"name = {template!r} cannot be filled in: {error}.") from error
        name = stem + (ending or (own if own in FORMATS else ".tif"))
        parts = Path(name).parts
        if Path(name).is_absolute() or ".." in parts or not stem or stem.endswith("/"):
            raise ValueError(f"name = {template!r} makes {name!r}, which is not a valid file name.")
        # Folders of Windows and macOS do not tell capitals apart.
        other = taken.setdefault(str(Path(name)).casefold(), photo)
        if other is not photo:
            raise ValueError(
                f"{other} and {photo} would both be called {name}. Tell them apart by name=, for "
                "example '{folder}-{name}-sun' or '{name}-{ending}-sun'."
            )
        found.append(str(Path(name)))
    return found


def _check(template: str) -> None:
    try:
        fields = {part[1] for part in string.Formatter().parse(template) if part[1] is not None}
    except ValueError as error:
        raise ValueError(f"name = {template!r} is not a valid template: {error}.") from error
    unknown = sorted(fields.difference(FIELDS))
    if unknown:
        raise ValueError(
            f"name = {template!r} asks for {{{unknown[0]}}}; there are "
            f"{', '.join(f'{{{name}}}' for name in FIELDS)}."
        )
