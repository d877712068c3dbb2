"""Writing files so that there is either the whole file or none."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path


def target(path: str | os.PathLike[str], *, overwrite: bool) -> Path:
    """Check where a file is to be written, before any work is spent on it.

    Raises
    ------
    FileExistsError
        When ``path`` exists and ``overwrite`` is false.
    FileNotFoundError
        When its folder does not exist.
    IsADirectoryError
        When ``path`` is a folder.
    """
    # Through a link: replacing it would leave the file it names unchanged.
    place = Path(os.path.realpath(Path(path).expanduser()))
    if place.is_dir():
        raise IsADirectoryError(f"{path} is a folder. Add a file name to it.")
    if place.exists() and not overwrite:
        raise FileExistsError(f"{path} exists already. Pass overwrite=True to replace it.")
    if not place.parent.is_dir():
        raise FileNotFoundError(f"There is no folder {place.parent} to write {place.name} into.")
    return place


@contextlib.contextmanager
def complete_or_absent(path: Path, *, overwrite: bool) -> Iterator[Path]:
    """Yield a temporary name beside ``path`` that becomes ``path`` only when all went well."""
    handle, name = tempfile.mkstemp(suffix=path.suffix, prefix=".sunwidget-", dir=path.parent)
    os.close(handle)
    unfinished = Path(name)
    try:
        yield unfinished
        # mkstemp makes files private; an export gets what the umask gives any new file.
        mask = os.umask(0)
        os.umask(mask)
        unfinished.chmod(0o666 & ~mask)
        if path.exists() and not overwrite:
            raise FileExistsError(f"{path} appeared while it was being made; it was kept.")
        unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)
