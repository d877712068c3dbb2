"""Loading what an analysis and the browser's maps will need, in parallel to the first stages."""

from __future__ import annotations

import contextlib

from sunwidget.analysis.networks import land, sky, sun
from sunwidget.analysis.networks.onnx_file import bundled_session
from sunwidget.analysis.scene import Scene
from sunwidget.analysis.windows import panes
from sunwidget.photo.photo import Photo
from sunwidget.widgets.kernel import background

_NETWORKS = ((sky.BUNDLED, "sky"), (sun.BUNDLED, "sun"), (land.BUNDLED, "land"))


def preload(source: Photo | Scene) -> None:
    """Load the networks and find windows on a thread; do nothing for a Scene."""
    if isinstance(source, Photo):
        background.start(_load, source, name="sunwidget-preload")


def _load(photo: Photo) -> None:
    # The analysis repeats a failed step and reports its error.
    with contextlib.suppress(Exception):
        for path, finds in _NETWORKS:
            if background.leaving():
                return
            bundled_session(path, finds)
        panes.look(photo)
