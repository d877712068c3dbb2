"""Values in messages, short and on one line whatever they are, and as Python."""

from __future__ import annotations

import dataclasses
import difflib
from collections.abc import Iterable, Mapping
from typing import Any

_READABLE = 1e6  # whole numbers below are written without a point


def shown(value: Any, most: int = 80) -> str:
    """Return the start of a value's ``repr``, for a message; never fails."""
    try:
        return repr(value)[:most]
    except Exception:  # noqa: BLE001 - numbers of 5000 digits, lists a thousand deep, a person's own
        return f"this {type(value).__name__}"


def printable(text: str) -> str:
    """Return a text without signs that a terminal obeys, such as escapes in a file's name."""
    return "".join(sign if sign.isprintable() else ascii(sign)[1:-1] for sign in text)


def did_you_mean(
    name: Any,
    known: Iterable[str],
    otherwise: str = "",
    *,
    cutoff: float = 0.6,
    quote: str = "'",
) -> str:
    """Return a sentence that suggests the nearest of ``known``, or ``otherwise``; space first.

    ``cutoff`` in [0, 1] is how alike they must be; ``otherwise`` says what to do where none is.
    """
    spelled = name[:80] if isinstance(name, str) else ""
    near = difflib.get_close_matches(spelled, list(known), n=1, cutoff=cutoff)
    sentence = f"Did you mean {quote}{near[0]}{quote}?" if near else otherwise
    return f" {sentence}" if sentence else ""


def called(name: str, arguments: Mapping[str, Any], module: str = "") -> str:
    """Return the Python that calls ``name``, in ``module`` ("sw."), with these arguments."""
    parts = (f"{key}={_code(value, module)}" for key, value in arguments.items())
    return f"{module}{name}({', '.join(parts)})"


def _code(value: Any, module: str) -> str:
    if dataclasses.is_dataclass(value):
        arguments = {f.name: getattr(value, f.name) for f in dataclasses.fields(value)}
        return called(type(value).__name__, arguments, module)
    if isinstance(value, float) and value.is_integer() and abs(value) < _READABLE:
        return str(int(value))
    if isinstance(value, tuple):
        inner = ", ".join(_code(item, module) for item in value)
        return f"({inner}{',' * (len(value) == 1)})"
    return repr(value)
