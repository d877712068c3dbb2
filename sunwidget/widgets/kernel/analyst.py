"""Analyze a widget's photo in the background, and update the scene after each correction.

One daemon thread runs at a time. While it works, newer corrections replace waiting ones.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from sunwidget.analysis.analyze import analyze
from sunwidget.analysis.correct import corrected
from sunwidget.analysis.fit import fit
from sunwidget.analysis.scene import Scene
from sunwidget.analysis.windows import panes
from sunwidget.edit.table import Edit
from sunwidget.errors import AnalysisError
from sunwidget.photo.photo import Photo
from sunwidget.widgets.kernel import background
from sunwidget.widgets.kernel.known_scenes import remember

Report = Callable[[str, float, str], None]


class AnalysisCancelled(AnalysisError):  # noqa: N818 - requested by the user
    """The analysis was cancelled."""


class Analyst:
    """Keeps a scene up to date with the corrections of an edit.

    Parameters
    ----------
    source : Photo or Scene
        A photo is analyzed first; a scene is only corrected.
    options : dict
        Keyword arguments of ``analyze``.
    deliver : callable
        ``deliver(scene)``, called on the thread with every new scene.
    report : callable
        ``report(stage, fraction, message)`` with stage "analysing", "ready", "cancelled" or
        "error".
    """

    def __init__(
        self,
        source: Any,
        options: dict[str, Any],
        deliver: Callable[[Scene], None],
        report: Report,
    ) -> None:
        self._base: Scene | None = source if isinstance(source, Scene) else None
        self._photo = source
        self._options = options
        self._deliver = deliver
        self._report = report
        self._changed = threading.Condition()
        self._wanted: Edit | None = None
        self._busy = False
        self._cancelled = False
        self._scene: Scene | None = None
        self._delivered: Scene | None = None
        self._error: Exception | None = None

    @property
    def base(self) -> Scene | None:
        """The scene without corrections; None until the analysis is finished."""
        return self._base

    def ask(self, edit: Edit) -> None:
        """Request the corrections of ``edit``; return at once."""
        with self._changed:
            self._wanted = edit
            if self._busy:
                return
            self._busy = True
        background.start(self._work, name="sunwidget-analysis")

    def cancel(self) -> None:
        """Cancel running work at its next progress report; do nothing if there is none.

        Earlier corrections remain. ``ask`` starts again.
        """
        with self._changed:
            if self._busy:
                self._cancelled = True
                self._wanted = None

    @property
    def ready(self) -> bool:
        """Whether the scene is up to date, so that ``wait`` returns at once."""
        with self._changed:
            return not self._busy and self._error is None and self._scene is not None

    def wait(self, timeout: float | None = None) -> Scene:
        """Block until the scene is up to date and return it.

        Raises
        ------
        TimeoutError
            After ``timeout`` seconds.
        AnalysisError, PhotoError
            As raised by the analysis; AnalysisCancelled after ``cancel``.
        """
        with self._changed:
            if not self._changed.wait_for(lambda: not self._busy, timeout):
                raise TimeoutError(f"The analysis is not finished after {timeout:g} s.")
            if self._error is not None:
                raise self._error
            assert self._scene is not None
            return self._scene

    def _work(self) -> None:
        while True:
            with self._changed:
                edit, self._wanted = self._wanted, None
                self._cancelled = False  # applied to the previous work, which has ended
                if edit is None:
                    self._busy = False
                    self._changed.notify_all()
                    return
            try:
                self._update(edit)
            except AnalysisCancelled as error:
                with self._changed:
                    self._error = error
                self._tell("cancelled", "The analysis was cancelled.")
            except Exception as error:  # noqa: BLE001 - shown to the user and raised by wait()
                with self._changed:
                    self._error = error
                self._tell("error", str(error) or type(error).__name__)

    def _tell(self, stage: str, message: str) -> None:
        if not background.leaving():
            self._report(stage, 1.0, message)

    def _update(self, edit: Edit) -> None:
        def progress(fraction: float, message: str) -> None:
            with self._changed:
                if self._cancelled or background.leaving():
                    raise AnalysisCancelled("The analysis was cancelled. retry() starts it again.")
            self._report("analysing", fraction, f"{message} …")

        if self._base is None:
            progress(0.0, "Analysing the photo")
            background.start(_work_ahead, self._photo, name="sunwidget-ahead")
            self._base = analyze(self._photo, progress=progress, **self._options)
            remember(self._base, self._options)
        else:
            progress(0.5, "Applying the correction")
        scene = corrected(self._base, edit, progress)
        progress(1.0, "Preparing the picture")
        with self._changed:
            self._error = None
            newest = self._wanted is None
            self._scene = scene
        if newest:
            # The scene may be the same, for example if the method ignores a moved threshold.
            if scene is not self._delivered:
                self._deliver(scene)
                self._delivered = scene
            self._report("ready", 1.0, "")


def _work_ahead(photo: Photo) -> None:
    """Begin what needs no result of the analysis, which leaves a processor idle at times."""
    with suppress(AnalysisError):  # the analysis reports it
        fit.prepare()
        panes.look(photo)
