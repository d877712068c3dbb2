"""Format values for messages: short, on one line, or as Python code."""

from __future__ import annotations

import dataclasses
import difflib
from collections.abc import Iterable, Mapping
from typing import Any

_READABLE = 1e6  # whole numbers below this are written without a decimal point


def short_repr(value: Any, most: int = 80) -> str:
    """Return the first characters of a value's ``repr`` for a message; never raises."""
    try:
        return repr(value)[:most]
    except Exception:  # noqa: BLE001 - 5000-digit numbers, lists nested 1000 deep, custom reprs
        return f"this {type(value).__name__}"


def printable(text: str) -> str:
    """Escape control characters, which a terminal would obey, such as those in a file's name."""
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)


def did_you_mean(
    name: Any,
    known: Iterable[str],
    otherwise: str = "",
    *,
    cutoff: float = 0.6,
    quote: str = "'",
) -> str:
    """Return a sentence that suggests the nearest of ``known``, with a leading space.

    ``cutoff`` in [0, 1] is the least similarity; ``otherwise`` is returned when no name reaches it.
    """
    spelled = name[:80] if isinstance(name, str) else ""
    near = difflib.get_close_matches(spelled, list(known), n=1, cutoff=cutoff)
    sentence = f"Did you mean {quote}{near[0]}{quote}?" if near else otherwise
    return f" {sentence}" if sentence else ""


def format_call(name: str, arguments: Mapping[str, Any], module: str = "") -> str:
    """Return Python code that calls ``name`` of ``module`` ("sw.") with ``arguments``."""
    parts = (f"{key}={_code(value, module)}" for key, value in arguments.items())
    return f"{module}{name}({', '.join(parts)})"


def _code(value: Any, module: str) -> str:
    if dataclasses.is_dataclass(value):
        arguments = {f.name: getattr(value, f.name) for f in dataclasses.fields(value)}
        return format_call(type(value).__name__, arguments, module)
    if isinstance(value, float) and value.is_integer() and abs(value) < _READABLE:
        return str(int(value))
    if isinstance(value, tuple):
        inner = ", ".join(_code(item, module) for item in value)
        return f"({inner}{',' * (len(value) == 1)})"
    return repr(value)
