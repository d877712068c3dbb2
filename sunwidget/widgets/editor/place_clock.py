"""The editor's clock: place and time move the sun along its path over the day.

The browser moves the sun along the path in ``_day``, which the kernel computes.
"""

from __future__ import annotations

import contextlib
import datetime as dt
from collections.abc import Iterator
from typing import Any

import traitlets

from sunwidget.analysis.heading import HeadingMatch, heading_by_sun
from sunwidget.analysis.place_resolver import ResolvedPlace, resolve_place
from sunwidget.edit.table import Edit
from sunwidget.errors import EditError
from sunwidget.geometry.place import Place
from sunwidget.photo.photo import Photo
from sunwidget.photo.place import PhotoPlace, from_photo
from sunwidget.widgets.editor.editor_state import day_key, day_state
from sunwidget.widgets.editor.history import EditHistory
from sunwidget.widgets.kernel import background
from sunwidget.widgets.kernel.analysed import Analysed

_POSITION_AND_TIME = (
    "where and when it was taken, in degrees and hours UTC: "
    'editor.set_place(41.0, 29.0, "2026-06-21", 17.5)'
)
_REMEDIES = dict.fromkeys(("latitude", "longitude", "date", "time"), _POSITION_AND_TIME) | {
    "heading": "degrees clockwise from north: editor.set_place(heading=270)"
}


class PlaceClock(EditHistory, Analysed):
    """An editing widget whose sun follows a clock."""

    # The day for the browser: its key, and the sun's path or the reason why there is none.
    _day = traitlets.Dict().tag(sync=True, echo_update=False)
    # Place and time as the photo's file records them.
    _photo_place = traitlets.Dict().tag(sync=True, echo_update=False)

    place: Place | None

    def __init__(self, start: Edit, **state: Any) -> None:
        self._made = False
        super().__init__(start, _photo_place=recorded_place(self.photo), **state)
        self._made = True
        self.observe(self._on_place, "place")
        self.observe(self._on_source, "_source")
        if start.place is not None:
            # pvlib takes a second to load; the first picture does not wait for it.
            background.start(self._refresh_day, name="sunwidget-day")

    @property
    def photo_place(self) -> PhotoPlace:
        """Place, time and heading as the photo's file records them."""
        return from_photo(self.photo)

    @property
    def time(self) -> float | None:
        """Hours UTC on the place's date; None without a place. Assign hours to move the sun.

        Place and sun change in one undo step. Without a place, the photo's file provides it; the
        errors are those of ``set_place``.
        """
        return None if self.place is None else self.place.time

    @time.setter
    def time(self, hours: float) -> None:
        with _as_edit_error():
            place = self.place or self._with_heading(self._resolved())
            self._step(self.edit.at(place.replace(time=hours)))

    def set_place(
        self,
        latitude: float | None = None,
        longitude: float | None = None,
        date: dt.date | str | None = None,
        time: float | None = None,
        heading: float | None = None,
    ) -> None:
        """Set where and when the photo was taken and which way the camera looked.

        A value that is not given stays as it is; if it is not set, the photo's file provides it.
        A heading in neither is derived from the photo's sun at the time at which the photo was
        taken: the time given here, else the file's, else the one that is set. This waits for the
        analysis. The sun does not move until ``time`` is assigned.

        Parameters
        ----------
        latitude, longitude : float, optional
            Degrees, positive to the north and to the east.
        date : datetime.date or "YYYY-MM-DD", optional
            Day in UTC.
        time : float, optional
            Hours UTC at which the photo was taken.
        heading : float, optional
            Degrees clockwise from true north.

        Raises
        ------
        EditError
            If a value is out of range, or missing in the call, the place and the file.
        ImportError
            Without pvlib (``pip install 'sunwidget[solar]'``), if a heading has to be derived.

        Examples
        --------
        >>> editor.set_place(41.0, 29.0, "2024-06-21", time=16.5)
        >>> editor.time = 17.5
        """
        given = {
            "latitude": latitude,
            "longitude": longitude,
            "date": date,
            "time": time,
            "heading": heading,
        }
        with _as_edit_error():
            place = self._with_heading(self._resolved(given))
        self._step(self.edit.replace(place=place))

    def heading_by_sun(self) -> HeadingMatch:
        """Set the heading that places the photo's sun where it stood at the set time and place.

        Waits for the analysis. The time must be that at which the photo was taken, not one to
        which the clock was moved.

        Returns
        -------
        HeadingMatch
            ``note`` says how well the elevations agree. If they do not, the clock or its time zone
            may be wrong; ``agreeing`` lists the times of that day at which they would.

        Raises
        ------
        EditError
            Without a place; ValueError for a photo of the moon; ImportError without pvlib.
        """
        with _as_edit_error():
            place = self._resolved().place
        found = heading_by_sun(self.scene, place)
        self._step(self.edit.replace(place=found.place))
        return found

    def _resolved(self, given: dict[str, Any] | None = None) -> ResolvedPlace:
        return resolve_place(self.photo, _REMEDIES, given=given, place=self.place)

    def _with_heading(self, resolved: ResolvedPlace) -> Place:
        """Return the place with its heading; waits for the analysis only to derive one."""
        known = resolved.place.heading is not None
        return resolved.place if known else resolved.with_heading(self.scene)[0]

    def get_state(self, key: Any = None, drop_defaults: bool = False) -> Any:
        """Return the traits as they are sent; a full state includes the path of the place's day."""
        if self._made and key is None and self.place is not None and not self._day:
            self._refresh_day()
        return super().get_state(key, drop_defaults)

    def _on_place(self, change: Any) -> None:
        if change.new is None or day_key(change.new) != self._day.get("key"):
            self._refresh_day()

    def _on_source(self, _change: Any) -> None:
        self._photo_place = recorded_place(self.photo)

    def _refresh_day(self) -> None:
        with self._lock:
            self._day = day_state(self.place)


@contextlib.contextmanager
def _as_edit_error() -> Iterator[None]:
    try:
        yield
    except ValueError as error:
        raise EditError(str(error)) from None


def recorded_place(photo: Photo) -> dict[str, Any]:
    """Return the place and time that a photo's file records, for the browser."""
    recorded = from_photo(photo)
    return recorded.values() | {
        # If no time zone is known, the browser guesses one once it has a longitude.
        "clock": recorded.clock.isoformat() if recorded.clock is not None else None,
        "notes": list(recorded.notes),
    }
