"""Warnings about data that a picture format cannot hold."""

from __future__ import annotations

import warnings

from sunwidget.errors import PhotoWarning

# Frames up to the caller of save(): this function, the encoder, save(), its caller.
_CALLER = 4


def warn_dropped(note: str) -> None:
    """Warn of dropped data at the line that called save(); encoders call this."""
    warnings.warn(note, PhotoWarning, stacklevel=_CALLER)
