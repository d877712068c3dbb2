"""The state of an editor's front end from scene and edit alone, for widget and page."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any

from sunwidget.analysis.correct import corrected
from sunwidget.analysis.frame_inputs import uniforms
from sunwidget.analysis.scene import Scene
from sunwidget.edit.table import PARAMETERS, Edit, plain
from sunwidget.geometry.place import Place, day_table, solar_day
from sunwidget.photo.photo import Photo
from sunwidget.widgets.editor.uploads import fingerprint
from sunwidget.widgets.kernel.front_end import front_end
from sunwidget.widgets.kernel.payload import (
    encode_maps,
    encode_preview,
    map_json,
    parameter_json,
    scene_json,
)


def editor_state(
    scene: Scene, edit: Edit, *, session: str, kept: Mapping[str, Any] | None = None
) -> dict[str, Any]:
    """Return the traits of an editor that shows ``edit``, for a page without a kernel.

    They equal those of a ``SunEditor``, except that private data are empty: history, notes, and the
    place that the photo's file records.

    Parameters
    ----------
    scene : Scene
        The scene without the corrections of ``edit``.
    edit : Edit
    session : str
        Key under which the browser keeps the edit.
    kept : mapping, optional
        ``_versions`` and ``key_frames`` in the format of the traits; none by default.

    Raises
    ------
    AnalysisError
        If a hint of the edit cannot be used.
    """
    script, style = front_end("sun_editor", "SunEditor")
    shown = scene_state(corrected(scene, edit), 1)
    shown["_scene"]["notes"] = []
    return {
        "_esm": script,
        "_css": style,
        "_parameters": parameter_json(),
        "_maps": map_json(),
        "_photo": encode_preview(scene.photo),
        **shown,
        "_source": source_state(scene.photo, session),
        "_status": {"stage": "ready", "fraction": 1.0, "message": ""},
        "_day": day_state(edit.place),
        "_photo_place": {},
        "_history": {"past": [], "future": []},
        "_versions": [],
        "key_frames": [],
        **(kept or {}),
        **{p.name: plain(getattr(edit, p.name)) for p in PARAMETERS},
    }


def scene_state(scene: Scene, revision: int) -> dict[str, Any]:
    """Return the traits of an analyzed photo: its encoded maps and ``_scene``.

    ``revision`` must differ between scenes, so that the browser notices the change.
    """
    with ThreadPoolExecutor(1) as pool:
        pool.submit(uniforms, scene)  # caches them for scene_json
        maps = encode_maps(scene)
    return {**maps, "_scene": scene_json(scene, revision)}


def source_state(photo: Photo, session: str) -> dict[str, str]:
    """Return an editor's photo as its name, a fingerprint of its pixels, and a key."""
    return {"name": photo.name, "fingerprint": fingerprint(photo), "session": session}


def day_state(place: Place | None) -> dict[str, Any]:
    """Return the sun's path over a place's day, or the error; empty without a place."""
    if place is None:
        return {}
    key = day_key(place)
    try:
        return {"key": key, "path": day_table(place).tolist()}
    except ImportError as error:
        # Without pvlib a place can still be set; only the clock is missing.
        return {"key": key, "error": str(error)}


def day_key(place: Place) -> list[Any]:
    """Return the values that determine the sun's path over a day."""
    return [place.latitude, place.longitude, solar_day(place)]
