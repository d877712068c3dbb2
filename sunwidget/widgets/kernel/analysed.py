"""A widget of an analysed photo: it waits for the scene and tells how the work stands."""

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
    """A widget that shows a photo at once, and its scene when an ``Analyst`` has it."""

    _status = traitlets.Dict().tag(sync=True, echo_update=False)

    photo: Photo
    _analyst: Analyst
    _lock: threading.RLock

    @property
    def scene(self) -> Scene:
        """The analysed photo; waits for the analysis."""
        return self._analyst.wait()

    def wait(self, timeout: float | None = None) -> Self:
        """Block until the photo is analysed and return the widget; raises what the analysis did.

        Parameters
        ----------
        timeout : float, optional
            Seconds after which to raise ``TimeoutError``. Default: none.
        """
        self._analyst.wait(timeout)
        return self

    def _can_show_edits(self) -> bool:
        """Return whether the scene is there; a cell that nobody attends to waits for it."""
        if unattended():
            with contextlib.suppress(Exception):  # the analysis failed: there is still the photo
                self._analyst.wait()
        return self._analyst.ready

    def _report(self, stage: str, fraction: float, message: str) -> None:
        with self._lock:
            self._status = {"stage": stage, "fraction": fraction, "message": message}
