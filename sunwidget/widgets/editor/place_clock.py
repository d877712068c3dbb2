"""The editor's clock: a place and a time move the sun along its path over the day.

The browser moves the sun itself, from the path in ``_day``; the kernel computes that path.
"""

from __future__ import annotations

import datetime as dt
from typing import Any

import traitlets

from sunwidget.analysis.heading import HeadingMatch, heading_by_sun
from sunwidget.edit.table import Edit
from sunwidget.errors import EditError
from sunwidget.geometry.place import Place, day_table, solar_day
from sunwidget.photo.photo import Photo
from sunwidget.photo.place import PhotoPlace, from_photo
from sunwidget.widgets.editor.history import EditHistory
from sunwidget.widgets.kernel import background
from sunwidget.widgets.kernel.analysed import Analysed


class PlaceClock(EditHistory, Analysed):
    """A widget of an edit whose sun follows a clock."""

    # What the browser needs of the day: its key and its path, or why there is none.
    _day = traitlets.Dict().tag(sync=True, echo_update=False)
    # What the photo's file says of place and time.
    _photo_place = traitlets.Dict().tag(sync=True, echo_update=False)

    place: Place | None

    def __init__(self, start: Edit, **state: Any) -> None:
        self._made = False
        super().__init__(start, _photo_place=_told(self.photo), **state)
        self._made = True
        self.observe(self._on_place, "place")
        self.observe(self._on_source, "_source")
        if start.place is not None:
            # pvlib takes a second to load, which the first picture shall not wait for.
            background.start(self._refresh_day, name="sunwidget-day")

    @property
    def photo_place(self) -> PhotoPlace:
        """What the photo's file says of place, time and heading."""
        return from_photo(self.photo)

    @property
    def time(self) -> float | None:
        """Hours UTC on the place's date; None without a place. Assign hours to move the sun.

        The sun goes where it stands at that time: one step with the place. With no place set,
        the one in the photo's file is taken; see ``set_place`` for what is raised.
        """
        return None if self.place is None else self.place.time

    @time.setter
    def time(self, hours: float) -> None:
        place = self.place if self.place is not None else self._found_place()
        try:
            self._step(self.edit.at(place.replace(time=hours)))
        except ValueError as error:
            raise EditError(str(error)) from None

    def set_place(
        self,
        latitude: float | None = None,
        longitude: float | None = None,
        date: dt.date | str | None = None,
        time: float | None = None,
        heading: float | None = None,
    ) -> None:
        """Say where and when the photo was taken and which way the camera looked.

        What is not given stays as it is set, else it is what the photo's file says; a heading
        that neither knows is found by the photo's sun (``heading_by_sun``), which waits for the
        analysis. The sun stays where it is until ``time`` is assigned.

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
            When something is missing that neither place nor file knows, or out of range.
        ImportError
            When a heading has to be found, without pvlib (``pip install 'sunwidget[solar]'``).

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
        self._step(self.edit.replace(place=self._found_place(given)))

    def heading_by_sun(self) -> HeadingMatch:
        """Set the heading so that the photo's own sun stands where time and place put it.

        Waits for the analysis. The time must be the photo's, not one the clock was moved to.

        Returns
        -------
        HeadingMatch
            ``note`` says how well the elevations agree; ``agreeing`` are the times of that day
            at which they do, when the clock or its zone may be wrong.

        Raises
        ------
        EditError
            Without a place; ValueError for a photo of the moon; ImportError without pvlib.
        """
        place = self.place if self.place is not None else self._found_place(match=False)
        found = heading_by_sun(self.scene, place)
        self._step(self.edit.replace(place=found.place))
        return found

    def _found_place(self, given: dict[str, Any] | None = None, *, match: bool = True) -> Place:
        """Return the place of what is given, else set, else told by the file."""
        values = {name: value for name, value in (given or {}).items() if value is not None}
        known = from_photo(self.photo, values.get("longitude")).values()
        if self.place is not None:
            known |= vars(self.place)
        values = {**known, **values}
        missing = [n for n in ("latitude", "longitude", "date", "time") if values.get(n) is None]
        if missing:
            *first, last = missing
            told = f"{', '.join(first)} and {last}" if first else last
            raise EditError(
                f"The photo's file does not say its {told}. Give where and when it was taken, in "
                'degrees and hours UTC: editor.set_place(41.0, 29.0, "2026-06-21", 17.5).'
            )
        try:
            place = Place(**values)
            if place.heading is None and match:
                place = heading_by_sun(self.scene, place).place
        except ValueError as error:
            raise EditError(str(error)) from None
        return place

    def get_state(self, key: Any = None, drop_defaults: bool = False) -> Any:
        """Return the traits as they travel; all of them with the path of the place's day."""
        if self._made and key is None and self.place is not None and not self._day:
            self._refresh_day()
        return super().get_state(key, drop_defaults)

    def _on_place(self, change: Any) -> None:
        if change.new is None or self._day_key(change.new) != self._day.get("key"):
            self._refresh_day()

    def _on_source(self, _change: Any) -> None:
        self._photo_place = _told(self.photo)

    def _refresh_day(self) -> None:
        with self._lock:
            place = self.place
            if place is None:
                self._day = {}
                return
            key = self._day_key(place)
            try:
                self._day = {"key": key, "path": day_table(place).tolist()}
            except ImportError as error:
                # Without pvlib there is a place all the same, only no clock.
                self._day = {"key": key, "error": str(error)}

    @staticmethod
    def _day_key(place: Place) -> list[Any]:
        return [place.latitude, place.longitude, solar_day(place)]


def _told(photo: Photo) -> dict[str, Any]:
    """Return what a photo's file tells, for the browser."""
    told = from_photo(photo)
    return told.values() | {
        # Where no zone is known, the browser guesses one once a longitude is said.
        "clock": told.clock.isoformat() if told.clock is not None else None,
        "notes": list(told.notes),
    }
