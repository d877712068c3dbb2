"""Decode every kind of photo source: paths, bytes, files, Pillow images and arrays."""

from __future__ import annotations

import difflib
import io
import os
import stat
import sys
from pathlib import Path
from typing import Any

import numpy as np

from sunwidget.errors import PhotoError
from sunwidget.formats.pixels import check_light, check_size, split_alpha
from sunwidget.photo.decode import Decoded, decode_bytes, decode_image, reason

_TYPES = (
    "expected uint8 or uint16 (sRGB), or float (linear light). Convert it, for example with "
    ".astype('uint8')."
)


def decode_source(source: Any) -> tuple[str, Decoded]:
    """Return a name for messages and the decoded picture; ``source`` as for ``sunwidget.open``.

    Raises
    ------
    PhotoError
        If the source cannot be opened; the message says what to do.
    """
    if (file := read_file(source)) is not None:
        name, data = file
        return name, decode_bytes(data, name)
    if _is_pil(source):
        name = Path(str(getattr(source, "filename", ""))).name or "image"
        return _plain(name), decode_image(source, _plain(name))
    if hasattr(source, "__array__") or isinstance(source, (list, tuple)):
        return "array", _from_array(source)
    raise PhotoError(
        f"Cannot open {type(source).__name__} as a photo. Pass a path, bytes, a file opened "
        "with mode 'rb', a PIL image or a NumPy array."
    )


def read_file(source: Any) -> tuple[str, bytes] | None:
    """Return a picture file's name for messages and its bytes; None if the source is no file.

    Raises
    ------
    PhotoError
        For a file that cannot be read.
    """
    if isinstance(source, (str, os.PathLike)):
        return _read_path(source)
    if isinstance(source, (bytes, bytearray, memoryview)):
        data = bytes(source)
        _check_no_path(data)
        return "picture", data
    if not _is_pil(source) and callable(getattr(source, "read", None)):
        return _read_stream(source)
    return None


def _read_path(source: Any) -> tuple[str, bytes]:
    try:
        text = os.fsdecode(os.fspath(source))
    except Exception as error:  # a caller's own path object may raise anything
        kind = type(source).__name__
        text = f"This {kind} does not name a file: {reason(error)}. Pass a path."
        raise PhotoError(text) from error
    if not text:
        raise PhotoError("The path is empty. Pass the path of a picture file.")
    if "://" in text[:10] or text.startswith("data:"):
        raise PhotoError(
            f"{_plain(text[:80])} is a URL; sunwidget never downloads. Save the picture first."
        )
    name = _plain(text if len(text) <= 200 else f"{text[:200]}…")
    try:
        path = Path(text).expanduser()
        mode = path.stat().st_mode
        if stat.S_ISREG(mode):
            return _plain(path.name), path.read_bytes()
    except FileNotFoundError as error:
        raise PhotoError(_plain(_missing(path))) from error
    except PermissionError as error:
        raise PhotoError(f"No permission to read {name}. Check its access rights.") from error
    except (OSError, ValueError, RuntimeError) as error:
        # A picture's contents passed as a path contain null characters, which no path may have.
        hint = " Pass a picture's contents as bytes." if "\0" in text else ""
        raise PhotoError(f"Cannot read {name!r:.200}: {reason(error)}.{hint}") from error
    except MemoryError as error:
        raise PhotoError(f"There is not enough memory to read {name}.") from error
    if stat.S_ISDIR(mode):
        raise PhotoError(f"{name} is a folder. Pass the path of one picture in it.")
    raise PhotoError(f"{name} is a device or pipe, not a file. Pass a picture file.")


def _plain(text: str) -> str:
    """Return text that terminals, pages and messages can encode.

    File names that are not UTF-8 contain lone surrogates, which cannot be encoded.
    """
    return text.encode("utf-8", "replace").decode("utf-8")


def _missing(path: Path) -> str:
    if path.is_symlink():
        return f"{path} is a link to {path.readlink()}, which does not exist."
    try:
        near = _nearest(path.name, [p.name for p in path.parent.iterdir()])
    except OSError:
        return f"There is no file {path} and no folder {path.parent}."
    hint = f" Did you mean {near!r}?" if near else f" Looked in {path.parent.absolute()}."
    return f"There is no file {path}.{hint}"


def _nearest(name: str, names: list[str]) -> str | None:
    """Return the most similar name, ignoring its suffix and case."""
    ending = Path(name).suffix.casefold()
    # Of names that differ only in the suffix, the last is used: one with this suffix.
    names = sorted(names, key=lambda other: Path(other).suffix.casefold() == ending)
    stems = {Path(other).stem.casefold(): other for other in names}
    near = difflib.get_close_matches(Path(name).stem.casefold(), stems, n=1, cutoff=0.75)
    return stems[near[0]] if near else None


def _check_no_path(data: bytes) -> None:
    """Refuse the name of a file in bytes, since bytes must be a file's contents."""
    if 0 < len(data) < 1024 and b"\0" not in data and os.path.exists(data):  # noqa: PTH110 - bytes
        raise PhotoError(
            f"{_plain(os.fsdecode(data))} is a path in bytes, but bytes must be a picture's "
            "contents. Pass the path as text: os.fsdecode(path)."
        )


def _read_stream(source: Any) -> tuple[str, bytes]:
    label = getattr(source, "name", None)
    name = _plain(Path(label).name if isinstance(label, str) else "") or "picture"
    as_text = PhotoError(f"{name} was opened as text. Open it with mode 'rb'.")
    if isinstance(source, io.TextIOBase):
        raise as_text
    try:
        data = source.read()
    except Exception as error:  # a caller's own file object may raise anything
        raise PhotoError(f"Reading {name} failed: {reason(error)}.") from error
    if isinstance(data, str):
        raise as_text
    if not isinstance(data, (bytes, bytearray, memoryview)):
        raise PhotoError(f"Reading {name} gave {type(data).__name__}, not bytes. Pass its bytes.")
    if not data:
        raise PhotoError(
            f"{name} has no bytes left to read: it is empty, or was read before. Open it again."
        )
    return name, bytes(data)


def _is_pil(source: Any) -> bool:
    """Return whether ``source`` is a PIL image, without importing Pillow."""
    module = sys.modules.get("PIL.Image")
    return module is not None and isinstance(source, module.Image)


def _from_array(source: Any) -> Decoded:
    hidden = int(np.ma.count_masked(source)) if isinstance(source, np.ma.MaskedArray) else 0
    if hidden:
        raise PhotoError(
            f"The array hides {hidden} values behind its mask. Fill them first: array.filled(0)."
        )
    try:
        array = np.asarray(source)
    except MemoryError as error:
        raise PhotoError("There is not enough memory for this array. Scale it down.") from error
    except Exception as error:  # a foreign array's own conversion may raise anything
        raise PhotoError(f"This array cannot be read: {reason(error)}.") from error
    if array.ndim >= 2:
        check_size(array.shape[1], array.shape[0], "The array")
    kind = array.dtype.newbyteorder("=")  # both ways below copy: a Photo shares no memory
    if kind not in (np.uint8, np.uint16) and kind.kind != "f":
        raise PhotoError(f"The array has the type {array.dtype}; {_TYPES}")
    if kind.kind == "f":
        with np.errstate(all="ignore"):
            array = array.astype(np.float32)
    else:
        array = array.astype(kind)
    codes, alpha = split_alpha(array, "The array")
    if codes.dtype.kind != "f":
        return Decoded(codes, alpha)
    check_light(codes, "The array")
    return Decoded(codes, alpha, notes=_code_values(codes))


def _code_values(light: np.ndarray) -> list[str]:
    """Return a note if floats look like code values: whole numbers far above white."""
    brightest = float(light.max())
    if brightest < 2 or not _whole(light[0]) or not _whole(light):
        return []
    note = (
        f"The array's floats are whole numbers up to {brightest:g}. They are read as linear light, "
        "where 1 is white. If they are sRGB code values, pass array.astype('uint8')."
    )
    return [note]


def _whole(values: np.ndarray) -> bool:
    return bool((values == np.rint(values)).all())
