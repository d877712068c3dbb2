"""A widget of an analyzed photo, which reports the progress of the analysis."""

from __future__ import annotations

import contextlib
import threading
from typing import Self

import traitlets

from sunwidget.analysis.scene import Scene
from sunwidget.photo.photo import Photo
from sunwidget.widgets.kernel.analyst import Analyst
from sunwidget.widgets.kernel.output import unattended
from sunwidget.widgets.page.saved_state import SavedLight

OPENING = {"stage": "opening", "fraction": 0.0, "message": "Opening the photo …"}


class Analysed(SavedLight):
    """A widget that shows a photo at once, and its scene when the ``Analyst`` has finished."""

    _status = traitlets.Dict().tag(sync=True, echo_update=False)

    photo: Photo
    _analyst: Analyst
    _lock: threading.RLock

    @property
    def scene(self) -> Scene:
        """The analyzed photo; waits for the analysis."""
        return self._analyst.wait()

    def wait(self, timeout: float | None = None) -> Self:
        """Block until the photo is analyzed and return the widget; raise errors of the analysis.

        Parameters
        ----------
        timeout : float, optional
            Seconds after which to raise ``TimeoutError``. Default: no limit.
        """
        self._analyst.wait(timeout)
        return self

    def _can_show_edits(self) -> bool:
        """Return whether the scene is ready; in an unattended kernel, wait for it."""
        if unattended():
            with contextlib.suppress(Exception):  # after a failure the photo is shown
                self._analyst.wait()
        return self._analyst.ready

    def _report(self, stage: str, fraction: float, message: str) -> None:
        with self._lock:
            self._status = {"stage": stage, "fraction": fraction, "message": message}
