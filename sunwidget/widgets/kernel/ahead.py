"""What an analysis and the browser's maps will ask for, begun while its first stages work."""

from __future__ import annotations

import contextlib

from sunwidget.analysis.networks import land, sun
from sunwidget.analysis.networks.onnx_file import bundled_session
from sunwidget.analysis.scene import Scene
from sunwidget.analysis.segmentation import sky_network
from sunwidget.analysis.windows import panes
from sunwidget.photo.photo import Photo
from sunwidget.widgets.kernel import background

_NETWORKS = ((sky_network.BUNDLED, "sky"), (sun.BUNDLED, "sun"), (land.BUNDLED, "land"))


def look_ahead(source: Photo | Scene) -> None:
    """Load the networks, and look for windows, on a thread; of a Scene all is known."""
    if isinstance(source, Photo):
        background.start(_look, source, name="sunwidget-ahead")


def _look(photo: Photo) -> None:
    # Whoever needs what failed here tries again, and says why.
    with contextlib.suppress(Exception):
        for path, finds in (
            (sky_network.BUNDLED, "sky"),
            (sun.BUNDLED, "sun"),
            (land.BUNDLED, "land"),
        ):
            if background.leaving():
                return
            bundled_session(path, finds)
        panes.look(photo)
