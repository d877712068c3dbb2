"""Short texts drawn on pictures."""

from __future__ import annotations

import math
from typing import Any

# The bundled font lacks these characters.
_SIGNS = str.maketrans({"×": "x", "–": "-", "—": "-", "≤": "<", "≥": ">", "−": "-", "→": ">"})


def font(size: int) -> Any:
    """Return Pillow's own font at a size in pixels."""
    from PIL import ImageFont

    return ImageFont.load_default(size)


def width(text: str, size: int) -> int:
    """Return the width of a text in pixels."""
    return math.ceil(font(size).getlength(text.translate(_SIGNS)))


def write(draw: Any, at: tuple[int, int], text: str, size: int, color: Any) -> None:
    """Draw a text with its top left corner at ``at``."""
    draw.text(at, text.translate(_SIGNS), font=font(size), fill=color)


def cut(text: str, room: int, size: int) -> str:
    """Return the text, shortened with an ellipsis where it does not fit."""
    if width(text, size) <= room:
        return text
    while text and width(text + "…", size) > room:
        text = text[:-1]
    return text + "…"


def wrapped(text: str, room: int, size: int) -> list[str]:
    """Break a text into lines at its spaces."""
    lines, line = [], ""
    for word in text.split():
        longer = f"{line} {word}".strip()
        if line and width(longer, size) > room:
            lines.append(line)
            longer = word
        line = longer
    return [*lines, cut(line, room, size)] if line else lines
