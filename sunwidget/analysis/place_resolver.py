"""Which place, date, time and camera heading hold for a photo: one rule for every caller.

Each field is the first of these that is known: what the caller gives, what the edit's place holds,
what the photo's file records. A heading that is still unknown is found by the photo's own sun.
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
    """The place of a photo, before its camera's heading is searched for.

    Attributes
    ----------
    place : Place
        Where and when the sun is wanted; ``heading`` is None where nothing records it.
    taken : Place or None
        The same place at the date and time at which the photo was taken; None where the heading
        is known and that moment is not.
    notes : tuple of str
        What the photo's file leaves to a guess, and why.
    """

    place: Place
    taken: Place | None
    notes: tuple[str, ...]

    def facing(self, scene: Scene) -> tuple[Place, HeadingMatch | None]:
        """Return the place with its heading, and how the photo's sun gave that if it did.

        Raises
        ------
        ValueError
            When the photo shows the moon and the heading is unknown.
        ImportError
            When the heading has to be found, without pvlib.
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
        How a person provides each field of a Place, by its name: what follows "Give" in an error.
    given : mapping, optional
        Facts about the photo by the names of a Place's fields. None stands for unknown.
    place : Place, optional
        The edit's place.
    moved_to : mapping, optional
        The date and the time to which the sun moves. They say nothing about when the photo was
        taken.
    whole_day : bool, default False
        Whether any time at which the sun is up serves where none is known.

    Raises
    ------
    ValueError
        When position, date or time are unknown or out of range, or the heading is unknown and so
        is the moment at which the photo was taken. The message says how to provide them.
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
    # A date or a time that somebody gives outweighs the camera's clock, and that the edit's clock.
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
    """Return the first value of a field that is known."""
    return next((source[name] for source in sources if source.get(name) is not None), None)


def _remedy(missing: list[str], remedies: Mapping[str, str]) -> str:
    return _listed(list(dict.fromkeys(remedies[name] for name in missing)))


def _listed(words: list[str]) -> str:
    """Join words as in "date, time and heading"."""
    *first, last = words
    return f"{', '.join(first)} and {last}" if first else last
