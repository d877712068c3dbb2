"""Export of stills and films by an editor, from Python and from the browser's panel."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from sunwidget import presets
from sunwidget.edit.recipe import edit_of
from sunwidget.edit.table import Edit
from sunwidget.errors import EditError
from sunwidget.export.formats import FORMATS
from sunwidget.film.day import Day
from sunwidget.geometry.place import at_hours
from sunwidget.progress import Progress, with_time_left
from sunwidget.widgets.editor.export_files import FILMS, STILLS, kind_of, make_file, possible_stem
from sunwidget.widgets.editor.key_frames import (
    KeyFrame,
    KeyFrames,
    complete_key_frames,
    key_frames_json,
)
from sunwidget.widgets.editor.pictures import Pictures
from sunwidget.widgets.kernel.requests import Answer

_HEADROOM = 3.0  # stops of light above white, if requested


class Exports(Pictures):
    """A widget whose edit can be exported as a still or as a film."""

    key_frames = KeyFrames(
        help="Key frames of the film that sweep() writes: ((0.0, Edit()), (4.0, Edit(…)))."
    ).tag(sync=True, to_json=key_frames_json)

    def sweep(
        self,
        path: Any,
        *,
        to: Edit | dict[str, Any] | str | None = None,
        key_frames: Any = None,
        **options: Any,
    ) -> Path:
        """Write a film of the photo; ``options`` as in ``sunwidget.sweep``.

        Parameters
        ----------
        path : path
            The extension selects the format: .mp4, .gif, .webp, or ``frames/%04d.png``.
        to : Edit, recipe or a preset's name, optional
            The end of a film that starts at the current edit.
        key_frames : optional
            The path of the film instead: pairs of seconds and an ``Edit``, or any other path for
            ``sunwidget.sweep``, such as a ``Day``. Default: ``editor.key_frames`` with the current
            edit's strokes, methods and hints. With one key frame the film goes from it to the
            current edit; without key frames, from the photo to the current edit.
        **options
            As for ``sunwidget.sweep``: size, seconds, easing …

        Returns
        -------
        Path
            The written film.

        Raises
        ------
        EditError
            For both ``to`` and ``key_frames``, and when nothing moves. Other errors as for
            ``sunwidget.sweep``.

        Examples
        --------
        >>> editor.sweep("sunset.mp4", to="sunset", seconds=6, easing="ease_in_out")
        >>> editor.key_frames = [(0, sw.Edit()), (4, sw.Edit(sun_elevation=2))]
        >>> editor.sweep("evening.gif", size=(640, 427))
        """
        if to is not None and key_frames is not None:
            raise EditError("Pass either to= or key_frames=, not both.")
        edit = self.edit
        if to is not None:
            end = presets.edit(to, self.scene, edit) if isinstance(to, str) else edit_of(to)
            key_frames = [edit, end]
        elif key_frames is None:
            key_frames = self._film_path(self.key_frames, edit)
        return self._sweep(key_frames, path, **options)

    def _sweep(self, film_path: Any, path: Any, **options: Any) -> Path:
        from sunwidget.film.sweep import sweep

        return sweep(self._base_scene(), film_path, path, **options)

    @staticmethod
    def _film_path(key_frames: tuple[KeyFrame, ...], edit: Edit) -> Any:
        """Return a film's path: through the key frames, or from the photo to the edit."""
        frames = complete_key_frames(key_frames or ((0.0, Edit()),), edit)
        if len(frames) > 1:
            return frames
        ((_, start),) = frames
        if start == edit:
            raise EditError(
                "Nothing moves. Move the sun, pass to=, or set two key frames: "
                "editor.key_frames = [(0, sw.Edit()), (4, sw.Edit(sun_elevation=2))]."
            )
        return [start, edit]

    def _set_aside(self) -> dict[str, Any]:
        return {**super()._set_aside(), "key_frames": self.key_frames}

    def _take_up(self, edit: Edit, **state: Any) -> None:
        with self._lock, self.hold_sync():
            self.key_frames = state.get("key_frames", ())
            super()._take_up(edit, **state)

    def _describe_exports(self, _content: dict[str, Any], _progress: Progress) -> Answer:
        """Return the panel's choices and the defaults for this photo."""
        photo = self.photo
        own = Path(photo.name).suffix.lower()
        known = {".jpeg": ".jpg", ".tiff": ".tif"}.get(own, own)
        return {
            "folder": str(Path.cwd()),
            "name": f"{possible_stem(photo.name)}-sun",
            "suffix": known if known in {kind.suffix for kind in STILLS} else ".png",
            "bits": 16 if photo.bit_depth > 8 else 8,
            "size": list(photo.size),
            "stills": [kind.describe() | _capabilities(kind.suffix) for kind in STILLS],
            "films": [kind.describe() for kind in FILMS],
        }, []

    def _export_still(self, content: dict[str, Any], progress: Progress) -> Answer:
        """Export a still: ``name``, ``suffix``, ``bits``, ``quality``, ``long_edge`` …."""
        kind = kind_of(STILLS, content.get("suffix"))
        holds = _capabilities(kind.suffix)
        options = self._size_of(content)
        if len(holds["bits"]) > 1 and content.get("bits"):
            options["bit_depth"] = int(content["bits"])
        if kind.quality and content.get("quality"):
            options["quality"] = int(content["quality"])
        if holds["layers"] and content.get("layers"):
            options["layers"] = True
        if holds["above_white"] and content.get("above_white"):
            options["headroom"] = _HEADROOM
        report = with_time_left(progress)
        edit = self._requested_edit(content)

        def make(path: Path) -> None:
            report(0.0, "Rendering …")
            self._save(edit, path, progress=report, **options)

        in_folder = bool(content.get("in_folder"))
        return make_file(kind, content.get("name"), make, progress, in_folder=in_folder)

    def _export_film(self, content: dict[str, Any], progress: Progress) -> Answer:
        """Export a film: ``name``, ``suffix``, ``seconds``, ``fps``, ``easing``, ``loop``, ….

        ``hours``, if set, are the first and last hour of the place's day; otherwise the path
        follows ``key_frames``.
        """
        kind = kind_of(FILMS, content.get("suffix"))
        options = self._size_of(content)
        for name in ("fps", "seconds", "easing", "loop"):
            if content.get(name) is not None:
                options[name] = content[name]
        if kind.quality and content.get("quality"):
            options["quality"] = int(content["quality"])

        edit = self._requested_edit(content)
        frames = self.key_frames
        if content.get("key_frames") is not None:
            frames = KeyFrames().validate(self, content["key_frames"])

        def make(path: Path) -> None:
            progress(0.0, "Rendering …")
            hours = content.get("hours")
            film_path = _film_day(edit, *hours) if hours else self._film_path(frames, edit)
            self._sweep(film_path, path, progress=progress, **options)

        in_folder = bool(content.get("in_folder"))
        return make_file(kind, content.get("name"), make, progress, in_folder=in_folder)

    def _size_of(self, content: dict[str, Any]) -> dict[str, Any]:
        edge = content.get("long_edge")
        return {"size": self.photo.size_within(int(edge))} if edge else {}


def _film_day(edit: Edit, start: float, end: float) -> Day:
    """Return the day of the edit's place, between hours counted as on its sun path."""
    if edit.place is None:
        raise EditError("Set the photo's place first, in Time and place or with set_place().")
    place = at_hours(edit.place, start)
    return Day(place, start=place.time, end=end % 24, edit=edit)


def _capabilities(suffix: str) -> dict[str, Any]:
    """Return what a still format supports: bits per channel, layers, light above white."""
    form = FORMATS[suffix]
    return {
        "bits": sorted(form.depths),
        "layers": form.layers != "",
        "above_white": form.gain_map or form.linear,
    }
