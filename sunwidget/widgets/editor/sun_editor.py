"""SunEditor: drag the sun in a photo, in a notebook.

The browser draws every frame itself from the traits below; the kernel analyzes the photo, applies
corrections and renders exports. Handlers may run on any thread: JupyterLab sends messages to
kernel subshells.
"""

from __future__ import annotations

import itertools
import uuid
from collections.abc import Callable
from typing import Any, NamedTuple

import traitlets

from sunwidget import presets
from sunwidget.analysis.scene import Scene
from sunwidget.edit.recipe import edit_of, read_code
from sunwidget.edit.table import CORRECTIONS, Edit
from sunwidget.photo.photo import Photo
from sunwidget.progress import Progress
from sunwidget.widgets.editor.editor_state import scene_state, source_state
from sunwidget.widgets.editor.exports import Exports
from sunwidget.widgets.editor.place_clock import PlaceClock
from sunwidget.widgets.editor.uploads import Uploads
from sunwidget.widgets.kernel.analysed import OPENING
from sunwidget.widgets.kernel.analyst import Analyst
from sunwidget.widgets.kernel.front_end import front_end
from sunwidget.widgets.kernel.payload import (
    MAP_TRAITS,
    encode_map,
    encode_preview,
    map_json,
    other_horizons,
    parameter_json,
    saved_photo,
)
from sunwidget.widgets.kernel.preload import preload
from sunwidget.widgets.kernel.requests import Action, Answer, Requests
from sunwidget.widgets.kernel.sources import opened


class SunPlace(NamedTuple):
    """Position of the sun in degrees, as in the parameters."""

    azimuth: float
    elevation: float


class SunEditor(PlaceClock, Exports):
    """Drag the sun in a photo.

    Every parameter of ``Edit`` is a trait of the same name, synchronized in both directions:
    setting a trait changes the picture, and editing the picture sets the traits. ``None`` means
    "as detected in the photo".

    Parameters
    ----------
    source : path, bytes, file object, PIL image, array, Photo or Scene
        The picture; see ``sunwidget.open``. The photo is shown at once, and analyzed in the
        background unless a Scene is given.
    recipe : Edit or dict, optional
        The initial edit.
    **options
        Any parameter of ``Edit``, which overrides ``recipe``, and any option of
        ``sunwidget.analyze``: ``sky=mask``, ``refine="dense_crf"``, ``fov=38``.

    Raises
    ------
    TypeError
        For an unknown keyword; the nearest spelling is suggested. For an option of ``analyze``
        together with a Scene, which is already analyzed.
    PhotoError, EditError
        For a picture that cannot be opened, or a value out of range.

    Examples
    --------
    >>> editor = sw.SunEditor("beach.jpg", sun_elevation=3, clouds="rb_ratio")
    >>> editor.sun_azimuth = -4
    >>> editor.save("evening.jpg")
    """

    _esm, _css = front_end("sun_editor", "SunEditor")

    _parameters: traitlets.List = traitlets.List(read_only=True).tag(sync=True)
    _maps: traitlets.List = traitlets.List(read_only=True).tag(sync=True)
    _photo = traitlets.Bytes(b"").tag(sync=True, echo_update=False)
    _layers = traitlets.Bytes(b"").tag(sync=True, echo_update=False)
    _surface = traitlets.Bytes(b"").tag(sync=True, echo_update=False)
    _backdrop = traitlets.Bytes(b"").tag(sync=True, echo_update=False)
    _clear_sky = traitlets.Bytes(b"").tag(sync=True, echo_update=False)
    _relief = traitlets.Bytes(b"").tag(sync=True, echo_update=False)
    _transfer = traitlets.Bytes(b"").tag(sync=True, echo_update=False)
    _lamps = traitlets.Bytes(b"").tag(sync=True, echo_update=False)
    _scene = traitlets.Dict().tag(sync=True, echo_update=False)
    # Identity of the photo: its name, a fingerprint of its pixels, and a key of this editor.
    _source = traitlets.Dict().tag(sync=True, echo_update=False)

    def __init__(
        self,
        source: Any,
        *,
        recipe: Edit | dict[str, Any] | None = None,
        **options: Any,
    ) -> None:
        source, analysis = opened(source, options, "SunEditor")
        start = edit_of(recipe).replace(**options)
        self.photo: Photo = source.photo if isinstance(source, Scene) else source
        self._set_asides: dict[str, dict[str, Any]] = {}  # edits of other photos, by fingerprint
        self._revisions = itertools.count(1)
        self._shown: Scene | None = None  # the scene that the browser shows
        super().__init__(
            start,
            _photo=encode_preview(self.photo),
            _source=source_state(self.photo, uuid.uuid4().hex),
            _status=OPENING,
        )
        self._requests = Requests(self.send, self._actions())
        self.on_msg(self._requests)
        self.observe(self._on_connection, "comm")
        self._analyst = self._analyst_of(source, analysis)
        self.observe(lambda _: self._analyst.ask(self.edit), list(CORRECTIONS))
        preload(source)
        self._analyst.ask(start)

    @traitlets.default("_parameters")
    def _default_parameters(self) -> list[dict[str, Any]]:
        return parameter_json()

    @traitlets.default("_maps")
    def _default_maps(self) -> list[dict[str, Any]]:
        return map_json()

    def open(
        self, source: Any = None, *, recipe: Edit | dict[str, Any] | None = None, **options: Any
    ) -> None:
        """Open another photo in this editor with a new edit.

        The previous photo's edit, history and versions are kept and restored when that photo is
        opened again; a given ``recipe`` is then one more step on top of them. ``source``,
        ``options`` and errors are those of the class.

        Examples
        --------
        >>> editor.open("mountains.jpg")
        """
        if source is None:  # ipywidgets' method of this name, which connects to the browser
            super().open()
            return
        source, analysis = opened(source, options, "SunEditor")
        given = recipe is not None or bool(options)
        start = edit_of(recipe).replace(**options)
        photo = source.photo if isinstance(source, Scene) else source
        preview = encode_preview(photo)
        preload(source)
        with self._lock, self.hold_sync():
            self._set_asides[self._source["fingerprint"]] = self._set_aside()
            self._analyst.cancel()
            self.photo, self._shown = photo, None
            self._analyst = self._analyst_of(source, analysis)
            self._photo, self._status, self._scene = preview, OPENING, {}
            self._layers = self._surface = self._backdrop = b""
            self._clear_sky = self._relief = self._transfer = self._lamps = b""
            self._source = source_state(photo, self._source["session"])
            aside = self._set_asides.pop(self._source["fingerprint"], None)
            self._take_up(**(aside or {"edit": start}))
            if aside and given:
                self._step(start)
            self._analyst.ask(self.edit)

    @property
    def sun(self) -> SunPlace:
        """Present position of the sun: (azimuth, elevation) in degrees.

        These are the traits ``sun_azimuth`` and ``sun_elevation``. If one is None, its value is
        that detected in the photo, which waits for the analysis.
        """
        edit = self.edit
        azimuth, elevation = edit.sun_azimuth, edit.sun_elevation
        if azimuth is None or elevation is None:
            found = self.scene.automatic
            azimuth = found["sun_azimuth"] if azimuth is None else azimuth
            elevation = found["sun_elevation"] if elevation is None else elevation
        return SunPlace(azimuth, elevation)

    def cancel(self) -> None:
        """Stop the analysis and the browser's requests at their next step.

        Earlier results and the edit are kept. Corrections and ``retry`` restart the analysis;
        until then ``scene`` and ``render`` raise ``AnalysisError``.
        """
        self._cancel_analysis()
        self._requests.cancel()

    def _cancel_analysis(self) -> None:
        self._analyst.cancel()

    def retry(self) -> None:
        """Restart an analysis that was cancelled or failed."""
        self._analyst.ask(self.edit)

    def apply_preset(self, name: str) -> None:
        """Apply a preset of ``sunwidget.presets`` for the time of day, in one step.

        It sets sun, light and exposure; everything else stays unchanged. Waits for the analysis,
        since a preset's position of the sun depends on the photo.

        Parameters
        ----------
        name : {"dawn", "golden_hour", "noon", "sunset", "blue_hour", "dusk_lights", "moonlight"}

        Raises
        ------
        EditError
            For an unknown name; the nearest spelling is suggested.

        Examples
        --------
        >>> editor.apply_preset("sunset")
        """
        presets.find(name)
        self._step(self.edit.replace(**presets.values(name, self.scene)))

    def _light_state(self) -> dict[str, Any]:
        maps = dict.fromkeys(MAP_TRAITS, b"")
        return {**maps, "_scene": {}, "_photo": saved_photo(self.photo)}

    def _on_connection(self, change: Any) -> None:
        if change.new is None:  # closed: nobody receives the answers
            self._requests.cancel()

    def _analyst_of(self, source: Photo | Scene, options: dict[str, Any]) -> Analyst:
        def report(stage: str, fraction: float, message: str) -> None:
            # An analysis of a previous photo may still be running.
            if analyst is self._analyst:
                self._report(stage, fraction, message)

        analyst = Analyst(source, options, self._deliver, report)
        return analyst

    def _deliver(self, scene: Scene) -> None:
        state = scene_state(scene, next(self._revisions))
        with self._lock:
            if scene.photo is not self.photo:
                return
            self._shown = scene
            # Send one message, so that a view never has maps of two scenes.
            with self.hold_sync():
                for name, value in state.items():
                    setattr(self, name, value)

    def _actions(self) -> dict[str, Action]:
        """Return the actions that the browser can request, by name."""
        return {
            "save": self._save_for_browser,
            "exports": self._describe_exports,
            "still": self._export_still,
            "film": self._export_film,
            "page": self._page_for_browser,
            "detail": self._detail_for_browser,
            "cancel": _without_answer(self._cancel_analysis),
            "retry": _without_answer(self.retry),
            "upload": Uploads(self.open),
            "recipe": lambda content, _: (read_code(str(content.get("text"))).to_dict(), []),
            "alive": lambda _content, _: ({}, []),
            "map": lambda content, _: (
                {},
                [encode_map(self._shown_scene(), str(content.get("name")))],
            ),
            "horizons": lambda _content, _: (other_horizons(self._shown_scene()), []),
        }

    def _shown_scene(self) -> Scene:
        with self._lock:
            if self._shown is None:
                raise ValueError("The photo is not analysed yet.")
            return self._shown


def _without_answer(work: Callable[[], None]) -> Action:
    """Return an action with an empty answer."""

    def action(_content: dict[str, Any], _progress: Progress) -> Answer:
        work()
        return {}, []

    return action
