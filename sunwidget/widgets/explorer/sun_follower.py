"""The sun of SkyExplorer: placed by the user, by a place's time, or by a measured sky.

The browser moves the sun along the path in ``_day``, which the kernel computes.
"""

from __future__ import annotations

import contextlib
import datetime as dt
import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import traitlets

from sunwidget.explorer import table
from sunwidget.geometry import solar
from sunwidget.geometry.place import wrap_angle
from sunwidget.validation import measurements
from sunwidget.widgets.explorer.answers import scans
from sunwidget.widgets.explorer.parameters import ExplorerParameters

SUN = ("sun_azimuth", "sun_elevation")
_SAME_PLACE = 0.01  # degrees; the browser's arithmetic differs slightly from the kernel's


class SunFollower(ExplorerParameters):
    """A widget with the explorer's parameters whose sun follows a time or a measured scan."""

    # Without pvlib the sun cannot follow a place.
    _refusals = (traitlets.TraitError, ImportError)

    _day: traitlets.List = traitlets.List().tag(sync=True, echo_update=False)
    _measured: Any = traitlets.Any(None).tag(sync=True, echo_update=False)
    _scans: traitlets.List = traitlets.List().tag(sync=True, echo_update=False)

    def __init__(self, **parameters: Any) -> None:
        self._moving = False
        super().__init__(_scans=scans(), **parameters)
        self._refresh_day()
        # The sun's position is as given, else from the time, else from the scan.
        if self.scan is not None:
            self._measured = measurements.load().scan_json(self.scan)
        self._place_sun(*self._followed_sun())
        for name in SUN:
            if name in parameters:
                setattr(self, name, parameters[name])
        self._on_sun(None)
        self.observe(self._on_place, list(table.PLACE))
        self.observe(self._on_time, "time")
        self.observe(self._on_scan, "scan")
        self.observe(self._on_sun, list(SUN))

    def set_place(
        self, latitude: float, longitude: float, date: dt.date | str | None = None
    ) -> None:
        """Set position and day of the observer; ``time`` then moves the sun.

        Parameters
        ----------
        latitude, longitude : float
            Degrees, positive to the north and to the east.
        date : datetime.date or "YYYY-MM-DD", optional
            Default: the present one, else today.
        """
        day = date or self.date or dt.datetime.now(dt.UTC).date()
        with self.hold_trait_notifications():
            for name, value in zip(table.PLACE, (day, latitude, longitude), strict=True):
                setattr(self, name, value)

    def refresh_scans(self) -> None:
        """Search this machine for measured skies again, after ``measurements.download()``."""
        self._scans = scans()

    @contextlib.contextmanager
    def _moving_the_sun(self) -> Iterator[None]:
        """Mark that the time or the scan moves the sun meanwhile, not the user."""
        self._moving = True
        try:
            with self.hold_sync():
                yield
        finally:
            self._moving = False

    def _refresh_day(self) -> None:
        place = [getattr(self, name) for name in table.PLACE]
        if None in place:
            self._day = []
            return
        try:
            path = solar.day_path(*place)
        except ImportError:
            self._day = []  # do not keep the path of another place
            raise
        self._day = np.round(path, 6).tolist()

    def _followed_sun(self) -> tuple[float, float]:
        """Return azimuth and elevation from the time, else the scan, else the table's defaults."""
        if self._day and self.time is not None:
            azimuth, elevation = solar.sun_on_path(self._day, self.time)
            # The parameter ends at -12°; it is night below that, too.
            return azimuth, max(elevation, table.parameter("sun_elevation").minimum)
        if self.scan is not None:
            return self._measured["sun_azimuth"], self._measured["sun_elevation"]
        return table.parameter("sun_azimuth").default, table.parameter("sun_elevation").default

    def _sun_follows(self) -> bool:
        """Return whether the sun is where the time, the scan or else the table puts it."""
        azimuth, elevation = self._followed_sun()
        turn = wrap_angle(self.sun_azimuth - azimuth)
        return math.hypot(turn, self.sun_elevation - elevation) < _SAME_PLACE

    def _follow_time(self) -> None:
        if self._day and self.time is not None:
            with self._moving_the_sun():
                self._place_sun(*self._followed_sun())

    def _on_place(self, _change: Any) -> None:
        with self._lock:
            self._refresh_day()
            self._follow_time()

    def _on_time(self, _change: Any) -> None:
        if not self._from_browser():  # the browser has already moved the sun
            with self._lock:
                self._follow_time()

    def _on_sun(self, _change: Any) -> None:
        # The user moved the sun off its path; the browser does the same.
        if self._moving or self._from_browser():
            return
        if self._day and not self._sun_follows():
            self.time = None

    def _on_scan(self, _change: Any) -> None:
        with self._lock:
            self._show_scan()

    def _show_scan(self) -> None:
        if self.scan is None:
            self._measured = None
            return
        self._measured = measurements.load().scan_json(self.scan)
        with self._moving_the_sun():
            self.time = None
            self._place_sun(*self._followed_sun())

    def _place_sun(self, azimuth: float, elevation: float) -> None:
        self.sun_azimuth, self.sun_elevation = azimuth, elevation

    @traitlets.validate("scan")
    def _validate_scan(self, proposal: Any) -> int | None:
        value: int | None = proposal["value"]
        if value is not None:
            try:
                count = len(measurements.load())
            except measurements.MeasurementsError as error:
                raise traitlets.TraitError(str(error)) from None
            if value >= count:
                raise traitlets.TraitError(
                    f"scan = {value} is not one of the scans 0 to {count - 1}."
                )
        return value
