"""Writing files so that there is either the whole file or none."""

from __future__ import annotations

import contextlib
import errno
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from sunwidget.messages import shown

# What stood in the way, and what to do about it.
_OBSTACLES = {
    errno.ENOSPC: "the disk is full. Free some space or choose another folder",
    errno.EDQUOT: "the space that you may use is used up. Free some or choose another folder",
    errno.EFBIG: "a file may not be that large there. Choose another folder or a smaller size",
    errno.EIO: "the disk failed. Choose another one",
    errno.EROFS: "the folder is read-only. Choose another one",
    errno.EACCES: "the folder may not be written to. Choose another one",
    errno.EPERM: "the folder may not be written to. Choose another one",
    errno.ENOENT: "the folder is there no more. Make it again or choose another one",
}


class NotWrittenError(OSError):
    """A file that could not be written; the message says why. No part of it is left."""


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
    NotWrittenError
        For what no file can be called, and for a folder that may not be written to.
    """
    with _named(path):
        # Through a link: replacing it would leave the file it names unchanged.
        place = Path(os.path.realpath(Path(path).expanduser()))
        is_there = _is_there(place)
    if place.is_dir():
        raise IsADirectoryError(f"{path} is a folder. Add a file name to it.")
    if is_there and not overwrite:
        raise FileExistsError(f"{path} exists already. Pass overwrite=True to replace it.")
    if not place.parent.is_dir():
        raise FileNotFoundError(f"There is no folder {place.parent} to write {place.name} into.")
    _refuse_closed(place.parent, place.name)
    return place


def folder_target(folder: str | os.PathLike[str], *, parents: bool = False) -> Path:
    """Check a folder that files are to be written into, before any work is spent on them.

    Parameters
    ----------
    folder : path
    parents : bool
        Whether the folders that it lies in need not be there either.

    Raises
    ------
    NotADirectoryError
        When it is a file.
    FileNotFoundError
        When the folder that it is to be made in does not exist.
    NotWrittenError
        For what no folder can be called, and for one that may not be written to.
    """
    with _named(folder):
        place = Path(folder).expanduser()
        is_there = _is_there(place)
    if is_there and not place.is_dir():
        raise NotADirectoryError(f"{folder} is a file. Name a folder.")
    if not (is_there or parents or place.absolute().parent.is_dir()):
        raise FileNotFoundError(f"There is no folder {place.parent} to make {place.name} in.")
    outer = next((p for p in (place, *place.absolute().parents) if p.exists()), place)
    _refuse_closed(outer, place.name)
    return place


@contextlib.contextmanager
def complete_or_absent(path: Path, *, overwrite: bool) -> Iterator[Path]:
    """Yield a temporary name beside ``path`` that becomes ``path`` only when all went well.

    Raises
    ------
    FileExistsError
        When ``path`` has come to exist meanwhile and ``overwrite`` is false.
    NotWrittenError
        As ``explained``.
    """
    with explained(path):
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


@contextlib.contextmanager
def explained(path: Path) -> Iterator[None]:
    """Say of ``path`` why it was not written, where the system says so.

    Raises
    ------
    NotWrittenError
        Instead of the system's error about the disk or about the folder of ``path``.
    """
    try:
        yield
    except NotWrittenError:
        raise
    except OSError as error:
        obstacle = _OBSTACLES.get(error.errno or 0)
        place = path if error.filename is None else Path(error.filename)
        # What else was read or written meanwhile tells of itself.
        elsewhere = path.parent not in place.parents
        if obstacle is None or elsewhere or (error.errno == errno.ENOENT and place.parent.exists()):
            raise
        told = NotWrittenError(f"{path} was not written: {obstacle}. No part of it was left.")
        told.errno = error.errno
        raise told from error


@contextlib.contextmanager
def _named(path: Any) -> Iterator[None]:
    try:
        yield
    except PermissionError as error:
        raise NotWrittenError(
            f"{os.fspath(path)} cannot be written: the folder {_first_closed(path)} may not be "
            "entered. Choose another one."
        ) from error
    except (TypeError, ValueError, RuntimeError, OSError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        name = os.fspath(path) if isinstance(path, os.PathLike) else path
        raise NotWrittenError(f"No file can be called {shown(name)}: {reason}.") from error


def _first_closed(path: Any) -> Path:
    """Return the outermost folder of a path that may not be entered."""
    folders = Path(os.path.abspath(Path(path).expanduser())).parents  # noqa: PTH100 - as it is named
    return next((p for p in reversed(folders) if not os.access(p, os.X_OK)), folders[0])


def _refuse_closed(folder: Path, name: str) -> None:
    if not os.access(folder, os.W_OK):
        raise NotWrittenError(
            f"{name} cannot be written: the folder {folder} may not be written to. Choose another "
            "one."
        )


def _is_there(path: Path) -> bool:
    try:
        path.stat()
    except (FileNotFoundError, NotADirectoryError):
        return False
    return True
