"""Values in messages: short, on one line, whatever they are."""

from __future__ import annotations

from typing import Any


def shown(value: Any, most: int = 80) -> str:
    """Return the start of a value's ``repr``, for a message; never fails."""
    try:
        return repr(value)[:most]
    except Exception:  # noqa: BLE001 - numbers of 5000 digits, lists a thousand deep, a person's own
        return f"this {type(value).__name__}"


def printable(text: str) -> str:
    """Return a text without signs that a terminal obeys, such as escapes in a file's name."""
    return "".join(sign if sign.isprintable() else ascii(sign)[1:-1] for sign in text)
