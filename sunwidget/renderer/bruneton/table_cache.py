"""Cache of precomputed tables in the user's cache folder, ``$XDG_CACHE_HOME`` or ``~/.cache``.

Tables are stored as 16-bit logarithms: a relative error of at most 0.034 % from 2⁻⁴⁸ to 2¹⁶, at
any brightness, in half the size of float32 (half floats lose the twilight). The cache is optional:
an unreadable file is computed again, and a folder that is not writable causes a warning only.
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
_LOWEST = -48.0  # log2 of the smallest stored value
_STEPS = 1023.0  # per octave
_MOST_BYTES = 400_000_000


def key(*what: Any) -> str:
    """Return a name from everything that a table depends on (any JSON values)."""
    text = json.dumps([VERSION, *what], sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def path(name: str) -> Path:
    """Return the path of the table with this key; it need not exist."""
    return cache_folder() / f"sky-{name}.npz"


def read(name: str, shape: tuple[int, ...]) -> NDArray[np.float32] | None:
    """Return the table with this key, or None if there is no usable one."""
    file = path(name)
    try:
        with np.load(file, allow_pickle=False) as data:
            codes = data["logarithms"]
    except (OSError, EOFError, ValueError, KeyError, zipfile.BadZipFile):
        return None
    if codes.shape != shape or codes.dtype != np.uint16:
        return None
    with contextlib.suppress(OSError):
        os.utime(file)  # the table used most recently is pruned last
    return decode(codes)


def write(name: str, table: NDArray[np.float32]) -> None:
    """Store a table under this key, atomically."""
    target = path(name)
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        with complete_or_absent(target, overwrite=True) as unfinished:
            np.savez(unfinished, logarithms=encode(table))
        _prune(target.parent)
    except OSError as error:
        reason = error.strerror or str(error)
        warnings.warn(
            f"The precomputed sky could not be stored in {target.parent} ({reason}); it will be "
            "computed again next time. Set XDG_CACHE_HOME to a writable folder.",
            stacklevel=3,
        )


def encode(table: NDArray[np.float32]) -> NDArray[np.uint16]:
    """Return 16-bit logarithms of values of at least zero; below 2⁻⁴⁸ they become zero."""
    with np.errstate(divide="ignore"):
        place = (np.log2(table) - _LOWEST) * _STEPS
    codes = np.clip(np.rint(place), -1, 65534) + 1
    return codes.astype(np.uint16)


def decode(codes: NDArray[np.uint16]) -> NDArray[np.float32]:
    """Undo ``encode``, within 0.034 %."""
    values = np.exp2((codes.astype(np.float32) - 1) / np.float32(_STEPS) + np.float32(_LOWEST))
    return np.where(codes > 0, values, np.float32(0))


def _prune(where: Path) -> None:
    """Remove the least recently used tables if the cache is too large."""
    files = sorted(where.glob("sky-*.npz"), key=lambda file: file.stat().st_mtime, reverse=True)
    total = 0
    for file in files:
        total += file.stat().st_size
        if total > _MOST_BYTES:
            file.unlink(missing_ok=True)
