"""Short texts on pictures that the kernel makes."""

from __future__ import annotations

import math
from typing import Any

# The bundled font has no such signs.
_SIGNS = str.maketrans({"×": "x", "–": "-", "—": "-", "≤": "<", "≥": ">", "−": "-", "→": ">"})


def font(size: int) -> Any:
    """Return Pillow's own font at a size in pixels."""
    from PIL import ImageFont

    return ImageFont.load_default(size)


def width(text: str, size: int) -> int:
    """Return how wide a text is, in pixels."""
    return math.ceil(font(size).getlength(text.translate(_SIGNS)))


def write(draw: Any, at: tuple[int, int], text: str, size: int, colour: Any) -> None:
    """Draw a text with its top left corner at ``at``."""
    draw.text(at, text.translate(_SIGNS), font=font(size), fill=colour)


def cut(text: str, room: int, size: int) -> str:
    """Return the text, or as much of it as fits, with an ellipsis."""
    if width(text, size) <= room:
        return text
    while text and width(text + "…", size) > room:
        text = text[:-1]
    return text + "…"


def wrapped(text: str, room: int, size: int) -> list[str]:
    """Break a text into lines at its blanks."""
    lines, line = [], ""
    for word in text.split():
        longer = f"{line} {word}".strip()
        if line and width(longer, size) > room:
            lines.append(line)
            longer = word
        line = longer
    return [*lines, cut(line, room, size)] if line else lines
