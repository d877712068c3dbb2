"""The photos of a batch and the names of their pictures."""

from __future__ import annotations

import glob
import os
import string
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from sunwidget.export.formats import FORMATS

FIELDS = ("name", "folder", "number", "ending")

# Extensions searched for in a folder. A pattern or a list may name any file.
_PICTURES = frozenset(
    {".jpg", ".jpeg", ".png", ".tif", ".tiff", ".webp", ".bmp", ".heic", ".heif", ".avif"}
    | {".dng", ".nef", ".cr2", ".cr3", ".arw", ".orf", ".rw2", ".raf", ".pef", ".srw"}
)


def find(photos: Any) -> list[Path]:
    """Return absolute paths without duplicates, in the given order, sorted within a pattern.

    Parameters
    ----------
    photos : path, pattern, folder, or an iterable of these
        ``"photos/*.jpg"``, ``"photos/**/*.jpg"``; a folder stands for its pictures.

    Raises
    ------
    FileNotFoundError
        When a pattern or folder has no picture. The path of a missing file is kept: the batch
        reports it.
    """
    named = [photos] if isinstance(photos, (str, os.PathLike)) else photos
    if not isinstance(named, Iterable):
        raise TypeError(
            f"photos must be a path, a pattern such as 'photos/*.jpg', a folder or a list of "
            f"these, not {type(photos).__name__}."
        )
    found: dict[Path, None] = {}
    for entry in named:
        if not isinstance(entry, (str, os.PathLike)):
            raise TypeError(
                f"A batch takes paths, not {type(entry).__name__}: it identifies a photo by its "
                "file when it resumes. Save the photo first."
            )
        for path in _expand(os.path.expanduser(os.fspath(entry))):  # noqa: PTH111 - a pattern, not a path
            # Not resolved: the photo keeps the name of a link.
            found[Path(os.path.abspath(path))] = None  # noqa: PTH100
    if not found:
        raise FileNotFoundError("No photos were given.")
    return list(found)


def _expand(text: str) -> Sequence[str]:
    # An existing file is not a pattern, even if its name is IMG[1].jpg.
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
    """Return the name of each photo's picture, relative to the output folder.

    Parameters
    ----------
    photos : sequence of Path
    template : str
        With ``{name}``, ``{folder}``, ``{number}`` and ``{ending}`` of the photo; a slash creates a
        subfolder.
    ending : str or None
        File extension, ".png" …; None keeps the photo's own if it can be written, otherwise .tif.

    Raises
    ------
    ValueError
        For an unknown field or extension, a name outside the folder, or two photos with the same
        name.
    """
    _check(template)
    if ending is not None:
        ending = "." + ending.lower().lstrip(".")
        if ending not in FORMATS:
            raise ValueError(
                f"format = {ending.lstrip('.')!r} cannot be written. Choose one of "
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
        # File names are case-insensitive on Windows and macOS.
        other = taken.setdefault(str(Path(name)).casefold(), photo)
        if other is not photo:
            raise ValueError(
                f"{other} and {photo} would both be called {name}. Distinguish them with name=, "
                "for example '{folder}-{name}-sun' or '{name}-{ending}-sun'."
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
            f"name = {template!r} has the unknown field {{{unknown[0]}}}. Known fields: "
            f"{', '.join(f'{{{name}}}' for name in FIELDS)}."
        )
