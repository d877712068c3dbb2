"""Precomputed tables on the disk: the user's cache folder, ``$XDG_CACHE_HOME`` or ``~/.cache``.

A table lies there as 16-bit logarithms: relative error at most 0.034 % from 2⁻⁴⁸ to 2¹⁶, at any
brightness, in half the room of float32 (half floats lose the twilight). The cache is a help and
never a duty: a file that cannot be read is made again, a folder that cannot be written is
warned of and left alone.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import warnings
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.cache import cache_folder
from sunwidget.files import complete_or_absent

VERSION = 2
_LOWEST = -48.0  # log2 of the least value that is kept
_STEPS = 1023.0  # per octave
_MOST_BYTES = 400_000_000


def key(*what: Any) -> str:
    """Return a name for all that a table depends on (anything that JSON can hold)."""
    text = json.dumps([VERSION, *what], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def path(name: str) -> Path:
    """Return where the table of this key lies or would lie."""
    return cache_folder() / f"sky-{name}.npz"


def read(name: str, shape: tuple[int, ...]) -> NDArray[np.float32] | None:
    """Return the table of this key, or None when there is none that can be used."""
    file = path(name)
    try:
        with np.load(file, allow_pickle=False) as data:
            codes = data["logarithms"]
    except (OSError, EOFError, ValueError, KeyError, zipfile.BadZipFile):
        return None
    if codes.shape != shape or codes.dtype != np.uint16:
        return None
    with contextlib.suppress(OSError):
        os.utime(file)  # used now: pruned last
    return decode(codes)


def write(name: str, table: NDArray[np.float32]) -> None:
    """Keep a table under this key; a reader never sees half of it."""
    target = path(name)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        with complete_or_absent(target, overwrite=True) as unfinished:
            np.savez(unfinished, logarithms=encode(table))
        _prune(target.parent)
    except OSError as error:
        reason = error.strerror or str(error)
        warnings.warn(
            f"The precomputed sky could not be kept in {target.parent} ({reason}); "
            "it will be made again next time. Set XDG_CACHE_HOME to a folder that can be written.",
            stacklevel=3,
        )


def encode(table: NDArray[np.float32]) -> NDArray[np.uint16]:
    """Return 16-bit logarithms of values from zero up; below 2⁻⁴⁸ counts as zero."""
    with np.errstate(divide="ignore"):
        place = (np.log2(table) - _LOWEST) * _STEPS
    codes = np.clip(np.rint(place), -1, 65534) + 1
    return codes.astype(np.uint16)


def decode(codes: NDArray[np.uint16]) -> NDArray[np.float32]:
    """Undo ``encode``, within 0.034 %."""
    values = np.exp2((codes.astype(np.float32) - 1) / np.float32(_STEPS) + np.float32(_LOWEST))
    return np.where(codes > 0, values, np.float32(0))


def _prune(where: Path) -> None:
    """Remove the tables that were not used for longest when there are too many."""
    files = sorted(where.glob("sky-*.npz"), key=lambda file: file.stat().st_mtime, reverse=True)
    total = 0
    for file in files:
        total += file.stat().st_size
        if total > _MOST_BYTES:
            file.unlink(missing_ok=True)
