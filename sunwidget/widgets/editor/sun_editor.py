"""SunEditor: drag the sun in a photo, in a notebook.

The browser draws every frame itself from the traits below; the kernel analyses the photo,
answers corrections and renders what is kept. Handlers may run on any thread: JupyterLab
sends messages to kernel subshells.
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
    """Where the sun stands, in degrees as the parameters have them."""

    azimuth: float
    elevation: float


class SunEditor(PlaceClock, Exports):
    """Drag the sun in a photo.

    Every parameter of ``Edit`` is a trait of the same name, both ways: setting one moves the
    picture, and moving the picture sets them. ``None`` means "as found in the photo".

    Parameters
    ----------
    source : path, bytes, file object, PIL image, array, Photo or Scene
        The picture; see ``sunwidget.open``. The photo is shown at once, and analysed behind
        the scenes unless a Scene is given.
    recipe : Edit or dict, optional
        What to start from.
    **options
        Any parameter of ``Edit``, which wins over ``recipe``, and any option of
        ``sunwidget.analyze``: ``sky=mask``, ``refine="dense_crf"``, ``fov=38``.

    Raises
    ------
    TypeError
        For a keyword that is neither; the nearest spelling is suggested. For an option of
        ``analyze`` beside a Scene, which is analysed already.
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
    # Which photo it is: its name, a fingerprint of its pixels, and a key of this editor.
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
        self._shown: Scene | None = None  # the scene that the browser has
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
        """Take another photo into this editor, which then begins anew.

        The edit of the photo before, its history and its versions are set aside; they are back
        when that photo is opened again; a ``recipe`` that is given is then a step on top of them.
        ``source``, ``options`` and errors as for the class.

        Examples
        --------
        >>> editor.open("mountains.jpg")
        """
        if source is None:  # ipywidgets' own method of this name, which connects to the browser
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
        """Where the sun is now: (azimuth, elevation) in degrees.

        As the traits ``sun_azimuth`` and ``sun_elevation`` say; where one is None, as found in the
        photo, which waits for the analysis.
        """
        edit = self.edit
        azimuth, elevation = edit.sun_azimuth, edit.sun_elevation
        if azimuth is None or elevation is None:
            found = self.scene.automatic
            azimuth = found["sun_azimuth"] if azimuth is None else azimuth
            elevation = found["sun_elevation"] if elevation is None else elevation
        return SunPlace(azimuth, elevation)

    def cancel(self) -> None:
        """Stop the analysis, and what was asked for in the browser, at their next step.

        What was found before stays, and so does the edit. Corrections, and ``retry``, start the
        analysis again; until then ``scene`` and ``render`` raise ``AnalysisError``.
        """
        self._cancel_analysis()
        self._requests.cancel()

    def _cancel_analysis(self) -> None:
        self._analyst.cancel()

    def retry(self) -> None:
        """Start the analysis again that was cancelled, or went wrong."""
        self._analyst.ask(self.edit)

    def apply_preset(self, name: str) -> None:
        """Set the time of day to a preset of ``sunwidget.presets``, in one step.

        Sun, light and exposure are set; everything else stays as it is. Waits for the analysis,
        since where a preset puts the sun depends on the photo.

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
        if change.new is None:  # closed: nobody is there to take what was asked for
            self._requests.cancel()

    def _analyst_of(self, source: Photo | Scene, options: dict[str, Any]) -> Analyst:
        def report(stage: str, fraction: float, message: str) -> None:
            # Work on a photo that is no longer shown may still be under way.
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
            # One message, so that a view never sees maps of two scenes.
            with self.hold_sync():
                for name, value in state.items():
                    setattr(self, name, value)

    def _actions(self) -> dict[str, Action]:
        """Return what the browser can ask for, by name."""
        return {
            "save": self._save_for_browser,
            "exports": self._describe_exports,
            "still": self._export_still,
            "film": self._export_film,
            "page": self._page_for_browser,
            "detail": self._detail_for_browser,
            "cancel": _silently(self._cancel_analysis),
            "retry": _silently(self.retry),
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


def _silently(work: Callable[[], None]) -> Action:
    """Return an action that has nothing to answer."""

    def action(_content: dict[str, Any], _progress: Progress) -> Answer:
        work()
        return {}, []

    return action
