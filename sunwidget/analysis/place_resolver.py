"""Resolve a photo's place, date, time and camera heading by one rule for every caller.

Each field comes from the first of these that has it: the caller, the edit's place, the photo's
file. A heading that is still unknown is derived from the photo's own sun.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from sunwidget.analysis.heading import HeadingMatch, heading_by_sun
from sunwidget.geometry.place import Place
from sunwidget.photo.place import from_photo

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.photo.photo import Photo

_POSITION = ("latitude", "longitude")
_MOMENT = ("date", "time")

Fields = Mapping[str, Any]


class ResolvedPlace(NamedTuple):
    """The place of a photo, before an unknown heading is derived.

    Attributes
    ----------
    place : Place
        Where and when the sun is requested; ``heading`` is None if nothing records it.
    taken : Place or None
        The same place at the date and time at which the photo was taken; None if the heading is
        known but that moment is not.
    notes : tuple of str
        Which values from the photo's file are guesses, and why.
    """

    place: Place
    taken: Place | None
    notes: tuple[str, ...]

    def with_heading(self, scene: Scene) -> tuple[Place, HeadingMatch | None]:
        """Return the place with its heading, and the match if the photo's sun gave the heading.

        Raises
        ------
        ValueError
            If the photo shows the moon and the heading is unknown.
        ImportError
            Without pvlib, if the heading has to be derived.
        """
        if self.taken is None or self.place.heading is not None:
            return self.place, None
        found = heading_by_sun(scene, self.taken)
        return self.place.replace(heading=found.place.heading), found


def resolve_place(
    photo: Photo,
    remedies: Mapping[str, str],
    *,
    given: Fields | None = None,
    place: Place | None = None,
    moved_to: Fields | None = None,
    whole_day: bool = False,
) -> ResolvedPlace:
    """Return the place of a photo.

    Parameters
    ----------
    photo : Photo
    remedies : mapping
        How a user provides each field of a Place, by name: the words after "Give" in an error.
    given : mapping, optional
        Facts about the photo by the names of a Place's fields. None means unknown.
    place : Place, optional
        The edit's place.
    moved_to : mapping, optional
        The date and time to which the sun moves. They do not indicate when the photo was taken.
    whole_day : bool, default False
        If no time is known, use solar noon.

    Raises
    ------
    ValueError
        If position, date or time is unknown or out of range, or if both the heading and the time
        at which the photo was taken are unknown. The message says how to provide them.
    """
    given, known = given or {}, vars(place) if place is not None else {}
    recorded = from_photo(photo, _first("longitude", given, known))
    file = recorded.values()
    values = {name: _first(name, moved_to or {}, given, known, file) for name in file}
    if values["time"] is None and values["longitude"] is not None and whole_day:
        values["time"] = (12 - values["longitude"] / 15) % 24
    missing = [name for name in (*_POSITION, *_MOMENT) if values[name] is None]
    if missing:
        raise ValueError(
            "The sun's position needs a place, a date and a time, and the photo's file does not "
            f"record its {_listed(missing)}. Give {_remedy(missing, remedies)}."
        )
    resolved = Place(**values)
    # A given date or time takes precedence over the camera's clock, which precedes the edit's.
    dated = any(given.get(name) is not None for name in _MOMENT)
    sources = (given, known, file) if dated else (file, known)
    moment = {name: _first(name, *sources) for name in _MOMENT}
    if None not in moment.values():
        return ResolvedPlace(resolved, resolved.replace(**moment), recorded.notes)
    if resolved.heading is None:
        raise ValueError(
            "The camera's heading is found by the photo's sun at the time at which the photo was "
            f"taken, and its file does not record that. Give {remedies['heading']}."
        )
    return ResolvedPlace(resolved, None, recorded.notes)


def _first(name: str, *sources: Fields) -> Any:
    """Return the first known value of a field."""
    return next((source[name] for source in sources if source.get(name) is not None), None)


def _remedy(missing: list[str], remedies: Mapping[str, str]) -> str:
    return _listed(list(dict.fromkeys(remedies[name] for name in missing)))


def _listed(words: list[str]) -> str:
    """Join words as in "date, time and heading"."""
    *first, last = words
    return f"{', '.join(first)} and {last}" if first else last
