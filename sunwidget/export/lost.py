"""What a format cannot keep is said, not dropped in silence."""

from __future__ import annotations

import warnings

from sunwidget.errors import PhotoWarning

# Of whoever calls save(): this function, the encoder, save() itself, its caller.
_CALLER = 4


def warn_lost(note: str) -> None:
    """Warn a person, as from the line that asked for the export; called by an encoder."""
    warnings.warn(note, PhotoWarning, stacklevel=_CALLER)
