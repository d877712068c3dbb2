"""Write files atomically: a file is either complete or absent."""

from __future__ import annotations

import contextlib
import errno
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from sunwidget.messages import short_repr

# Reason and remedy by error number, for messages.
_OBSTACLES = {
    errno.ENOSPC: "the disk is full. Free some space or choose another folder",
    errno.EDQUOT: "your disk quota is used up. Free some space or choose another folder",
    errno.EFBIG: "the file is too large for that disk. Choose another folder or a smaller size",
    errno.EIO: "the disk failed. Choose another one",
    errno.EROFS: "the folder is read-only. Choose another one",
    errno.EACCES: "the folder is not writable. Choose another one",
    errno.EPERM: "the folder is not writable. Choose another one",
    errno.ENOENT: "the folder no longer exists. Create it again or choose another one",
}


class NotWrittenError(OSError):
    """A file could not be written; the message says why. No part of it is left."""


def target(path: str | os.PathLike[str], *, overwrite: bool) -> Path:
    """Check the path of a file to be written, before any work is spent on it.

    Raises
    ------
    FileExistsError
        When ``path`` exists and ``overwrite`` is false.
    FileNotFoundError
        When its folder does not exist.
    IsADirectoryError
        When ``path`` is a folder.
    NotWrittenError
        For a name that no file can have, and for a folder that is not writable.
    """
    with _named(path):
        # Follows links: replacing the link would leave the file that it names unchanged.
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
    """Check a folder that files are to be written to, before any work is spent on them.

    Parameters
    ----------
    folder : path
    parents : bool
        Whether its parent folders may be missing too.

    Raises
    ------
    NotADirectoryError
        When ``folder`` is a file.
    FileNotFoundError
        When its parent folder does not exist.
    NotWrittenError
        For a name that no folder can have, and for a folder that is not writable.
    """
    with _named(folder):
        place = Path(folder).expanduser()
        is_there = _is_there(place)
    if is_there and not place.is_dir():
        raise NotADirectoryError(f"{folder} is a file. Name a folder.")
    if not (is_there or parents or place.absolute().parent.is_dir()):
        raise FileNotFoundError(f"There is no folder {place.parent} to create {place.name} in.")
    outer = next((p for p in (place, *place.absolute().parents) if p.exists()), place)
    _refuse_closed(outer, place.name)
    return place


@contextlib.contextmanager
def complete_or_absent(path: Path, *, overwrite: bool) -> Iterator[Path]:
    """Yield a temporary path beside ``path``, which is renamed to ``path`` on success only.

    Raises
    ------
    FileExistsError
        When ``path`` was created meanwhile and ``overwrite`` is false.
    NotWrittenError
        As ``explain_write_errors``.
    """
    with explain_write_errors(path):
        handle, name = tempfile.mkstemp(suffix=path.suffix, prefix=".sunwidget-", dir=path.parent)
        os.close(handle)
        unfinished = Path(name)
        try:
            yield unfinished
            # mkstemp makes files private; an export gets the permissions of any new file.
            mask = os.umask(0)
            os.umask(mask)
            unfinished.chmod(0o666 & ~mask)
            if path.exists() and not overwrite:
                raise FileExistsError(
                    f"{path} was created by another program meanwhile. It was kept; choose "
                    "another name, or pass overwrite=True."
                )
            unfinished.replace(path)
        finally:
            unfinished.unlink(missing_ok=True)


@contextlib.contextmanager
def explain_write_errors(path: Path) -> Iterator[None]:
    """Replace the system's errors about writing ``path`` by errors with a remedy.

    Raises
    ------
    NotWrittenError
        Instead of a system error about the disk or about the folder of ``path``.
    """
    try:
        yield
    except NotWrittenError:
        raise
    except OSError as error:
        obstacle = _OBSTACLES.get(error.errno or 0)
        place = path if error.filename is None else Path(error.filename)
        # Errors about other files, read or written meanwhile, pass through.
        elsewhere = path.parent not in place.parents
        if obstacle is None or elsewhere or (error.errno == errno.ENOENT and place.parent.exists()):
            raise
        clear = NotWrittenError(f"{path} was not written: {obstacle}. No part of it is left.")
        clear.errno = error.errno
        raise clear from error


@contextlib.contextmanager
def _named(path: Any) -> Iterator[None]:
    try:
        yield
    except PermissionError as error:
        raise NotWrittenError(
            f"{os.fspath(path)} cannot be written: you have no access to the folder "
            f"{_first_closed(path)}. Choose another one."
        ) from error
    except (TypeError, ValueError, RuntimeError, OSError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        name = os.fspath(path) if isinstance(path, os.PathLike) else path
        raise NotWrittenError(f"No file can have the name {short_repr(name)}: {reason}.") from error


def _first_closed(path: Any) -> Path:
    """Return the outermost folder of a path that the user may not enter."""
    folders = Path(os.path.abspath(Path(path).expanduser())).parents  # noqa: PTH100 - as it is named
    return next((p for p in reversed(folders) if not os.access(p, os.X_OK)), folders[0])


def _refuse_closed(folder: Path, name: str) -> None:
    if not os.access(folder, os.W_OK):
        raise NotWrittenError(
            f"{name} cannot be written: the folder {folder} is not writable. Choose another one."
        )


def _is_there(path: Path) -> bool:
    try:
        path.stat()
    except (FileNotFoundError, NotADirectoryError):
        return False
    return True
