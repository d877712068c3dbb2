"""SkyExplorer: see how the clear sky comes about, in a notebook.

The browser draws every frame itself from the traits below; the kernel adds what it alone can
do: the sun's path over a place, Bruneton's table, measured skies, pictures and code. Handlers
may run on any thread: JupyterLab sends messages to kernel subshells.
"""

from __future__ import annotations

import contextlib
import datetime as dt
import math
import os
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import traitlets

from sunwidget.atmosphere.constants import (
    MESOSPHERE_ALTITUDE,
    MESOSPHERE_SCALE_HEIGHT,
    RAYLEIGH_SCALE_HEIGHT,
    rayleigh_optical_depth,
)
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.presets import PRESETS
from sunwidget.explorer import table
from sunwidget.explorer.table import EXPLORER_PARAMETERS
from sunwidget.explorer.values import effective_values
from sunwidget.formats.png import encode_png
from sunwidget.geometry import solar
from sunwidget.progress import Progress
from sunwidget.validation import measurements
from sunwidget.widgets.explorer.answers import actions, bruneton_slice, scans
from sunwidget.widgets.kernel.edit_traits import AnswersRefusals, edit_traits
from sunwidget.widgets.kernel.front_end import front_end
from sunwidget.widgets.kernel.output import with_picture
from sunwidget.widgets.kernel.payload import parameter_json
from sunwidget.widgets.kernel.requests import Action, Requests
from sunwidget.widgets.page.framed import StaticPage
from sunwidget.widgets.page.standalone import explorer_page, written_page

if TYPE_CHECKING:
    from numpy.typing import NDArray
_NAMES = tuple(p.name for p in EXPLORER_PARAMETERS)
_ALIASES = ("turbidity", "visibility")
_SUN = ("sun_azimuth", "sun_elevation")
_SAME_PLACE = 0.01  # degrees; the browser's arithmetic is not to the bit the kernel's
_PICTURE_SIZE = (480, 320)  # of the static picture


class SkyExplorer(AnswersRefusals):
    """See how the clear sky comes about: sun, air, orders of scattering, models, measurements.

    Every row of ``sunwidget.explorer.table.EXPLORER_PARAMETERS`` is a trait of the same name,
    both ways: setting one changes the picture, and moving a slider sets it.

    Parameters
    ----------
    atmosphere : Atmosphere, optional
        What is in the air, for instance ``scene.atmosphere`` of a photo.
    turbidity : float, optional
        Optical depth of air with haze over that of air alone, at 550 nm; sets
        ``aerosol_optical_depth``.
    visibility : float, optional
        Meteorological visibility in metres; sets ``aerosol_optical_depth``.
    **parameters
        Any row of the table, which wins over ``atmosphere``.

    Raises
    ------
    TypeError
        For a keyword that is no parameter; the nearest spelling is suggested.
    TraitError
        For a value that its parameter does not take; the message says what it takes.
    ImportError
        For a date and place without pvlib (``pip install 'sunwidget[solar]'``).

    Examples
    --------
    >>> explorer = sw.SkyExplorer(sun_elevation=2, ozone=0)
    >>> explorer.show_multiple = False
    >>> explorer.set_place(41.0, 29.0, "2024-06-21")
    >>> explorer.time = 17.5
    >>> explorer.render(size=(640, 400))
    """

    _esm, _css = front_end("sky_explorer", "SkyExplorer")
    # Without pvlib there is no sun of a place.
    _refusals = (traitlets.TraitError, ImportError)

    _parameters: traitlets.List = traitlets.List(read_only=True).tag(sync=True)
    _aliases: traitlets.Dict = traitlets.Dict(read_only=True).tag(sync=True)
    _presets: traitlets.Dict = traitlets.Dict(read_only=True).tag(sync=True)
    _day: traitlets.List = traitlets.List().tag(sync=True, echo_update=False)
    _measured: Any = traitlets.Any(None).tag(sync=True, echo_update=False)
    _scans: traitlets.List = traitlets.List().tag(sync=True, echo_update=False)

    # One trait a row of the table; a class body's locals() is the class's own dictionary. Those
    # that are set below are named for the type checker.
    sun_azimuth: float
    sun_elevation: float
    time: float | None
    locals().update(edit_traits(EXPLORER_PARAMETERS, table.checked))

    def __init__(self, *, atmosphere: Atmosphere | None = None, **parameters: Any) -> None:
        for name in parameters:
            if name not in _NAMES and name not in _ALIASES:
                others = (*_ALIASES, "atmosphere")
                raise TypeError(f"SkyExplorer: {table.unknown_name_message(name, others)}")
        aliases = {name: parameters.pop(name) for name in _ALIASES if name in parameters}
        if len(aliases) + ("aerosol_optical_depth" in parameters) > 1:
            raise TypeError(
                "SkyExplorer takes one of turbidity=, visibility= and aerosol_optical_depth=: "
                "they are three names of one quantity."
            )
        if atmosphere is not None:
            parameters = {**atmosphere.parameters(), **parameters}
        self._lock = threading.RLock()
        self._browser_thread: int | None = None
        self._moving = False
        self._picture: tuple[Any, bytes] | None = None
        super().__init__(
            _scans=scans(),
            **parameters,
        )
        for name, value in aliases.items():
            setattr(self, name, value)
        self._refresh_day()
        # The sun is where it is said to be, else where the time puts it, else where the scan does.
        if self.scan is not None:
            self._measured = measurements.load().scan_json(self.scan)
        self._place_sun(*self._followed_sun())
        for name in _SUN:
            if name in parameters:
                setattr(self, name, parameters[name])
        self._on_sun(None)
        self.on_msg(Requests(self.send, self._actions()))
        self.observe(self._on_place, list(table.PLACE))
        self.observe(self._on_time, "time")
        self.observe(self._on_scan, "scan")
        self.observe(self._on_sun, list(_SUN))

    def __repr__(self) -> str:
        return f"<{self.code().removeprefix('sw.')}>"

    @traitlets.default("_parameters")
    def _default_parameters(self) -> list[dict[str, Any]]:
        return parameter_json(EXPLORER_PARAMETERS)

    @traitlets.default("_aliases")
    def _default_aliases(self) -> dict[str, float]:
        # Enough to go from turbidity and visibility to the aerosol optical depth and back, as
        # ``Atmosphere`` does, without the kernel.
        standard = Atmosphere(aerosol_optical_depth=0)
        return {
            "air_optical_depth_550": float(rayleigh_optical_depth(550.0)),
            "air_extinction_550": standard.extinction_550,
            "koschmieder": standard.visibility * standard.extinction_550,
            "mesosphere_altitude": MESOSPHERE_ALTITUDE,
            "mesosphere_share": MESOSPHERE_SCALE_HEIGHT / RAYLEIGH_SCALE_HEIGHT,
        }

    @traitlets.default("_presets")
    def _default_presets(self) -> dict[str, dict[str, float]]:
        return {name: air.parameters() for name, air in PRESETS.items()}

    @property
    def atmosphere(self) -> Atmosphere:
        """The air as it is drawn: what a switch hides is not in it. Assign one to set the air."""
        values = self.values()["edit"]
        return Atmosphere(**{name: values[name] for name in table.AIR})

    @atmosphere.setter
    def atmosphere(self, value: Atmosphere) -> None:
        with self.hold_sync():
            for name, number in value.parameters().items():
                setattr(self, name, number)

    @property
    def turbidity(self) -> float:
        """Optical depth of air with haze over that of air alone, at 550 nm. Assign to set it."""
        return self._air().turbidity

    @turbidity.setter
    def turbidity(self, value: float) -> None:
        self._set_haze("turbidity", value)

    @property
    def visibility(self) -> float:
        """Meteorological visibility at sea level, in metres. Assign to set it."""
        return self._air().visibility

    @visibility.setter
    def visibility(self, value: float) -> None:
        self._set_haze("visibility", value)

    def parameters(self) -> dict[str, Any]:
        """Return the value of every parameter by name, data such as place and date included."""
        return {name: getattr(self, name) for name in _NAMES}

    def values(self) -> dict[str, dict[str, float]]:
        """Return what the shaders get, by state and name; see ``explorer.values``."""
        return effective_values(self.parameters())

    def preset(self, name: str) -> None:
        """Set the air to the one called ``name``, in one step.

        They are ``sunwidget.atmosphere.presets.PRESETS``.

        Raises
        ------
        ValueError
            For a name that is none of them.
        """
        if name not in PRESETS:
            raise ValueError(f"There is no preset {name!r:.80}. Choose among {', '.join(PRESETS)}.")
        self.atmosphere = PRESETS[name]

    def set_place(
        self, latitude: float, longitude: float, date: dt.date | str | None = None
    ) -> None:
        """Say where and on which day the sky is seen; ``time`` then moves the sun.

        Parameters
        ----------
        latitude, longitude : float
            Degrees, positive to the north and to the east.
        date : datetime.date or "YYYY-MM-DD", optional
            Default: the one that is set, else today.
        """
        day = date or self.date or dt.datetime.now(dt.UTC).date()
        with self.hold_trait_notifications():
            for name, value in zip(table.PLACE, (day, latitude, longitude), strict=True):
                setattr(self, name, value)

    def render(
        self,
        size: tuple[int, int] = (960, 640),
        samples: int = 64,
        progress: Progress | None = None,
    ) -> NDArray[np.uint8]:
        """Return the picture as it is now.

        Parameters
        ----------
        size : (int, int), default (960, 640)
            Width and height in pixels.
        samples : int, default 64
            Paths a pixel of the model ``reference``, whose noise falls with their root. Without a
            graphics card a path for each of 960×640 pixels takes seconds.
        progress : callable, optional
            ``progress(fraction, message)``, where the model takes time; raise in it to cancel.

        Returns
        -------
        ndarray, shape (height, width, 3), uint8
            sRGB.

        Raises
        ------
        RendererError
            When no EGL context can be made on this machine.
        """
        from sunwidget.explorer.draw import draw

        bruneton = None
        if "bruneton" in (self.model, self.compare):
            bruneton = bruneton_slice(self.values()["edit"], progress)
        return draw(self.parameters(), size, bruneton=bruneton, samples=samples, progress=progress)

    def to_html(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        title: str = "Sky explorer",
        overwrite: bool = False,
    ) -> Path | str:
        """Write a page with the explorer as it stands: one file, no kernel, no network.

        Parameters
        ----------
        path : path, optional
            Where to write it. Default: nowhere, and the page is returned as text.
        title : str
            Of the page.
        overwrite : bool
            Replace an existing file.

        Returns
        -------
        Path or str
            Where the page is, or the page.

        Raises
        ------
        FileExistsError
            When ``path`` exists and ``overwrite`` is false.
        OSError
            When the folder is missing or the disk full; no half-written file is left.
        """
        return written_page(lambda: explorer_page(self, title=title), path, overwrite=overwrite)

    def render_static(self, *, title: str = "Sky explorer") -> StaticPage:
        """Return the page of ``to_html`` as a cell's output: live without a kernel.

        For notebooks that are exported: ``nbconvert --to html`` keeps it live, without a network.
        The notebook grows by the page, 0.3 MB.

        Parameters
        ----------
        title : str
            Of the page.
        """
        return StaticPage(explorer_page(self, title=title), title)

    def curve(self, name: str) -> NDArray[np.float32]:
        """Return one of the curves beside the picture, shape (n, 4).

        What it holds is told in docs/developer/frame-graph.md.

        Parameters
        ----------
        name : str
            "phase", "transmittance", "sun", "principal_plane" or "zenith".

        Returns
        -------
        (n, 4) float32

        Raises
        ------
        EditError
            For another name.
        RendererError
            When no EGL context can be made on this machine.
        """
        from sunwidget.explorer.draw import curve

        bruneton = bruneton_slice(self.values()["edit"]) if self.model == "bruneton" else None
        return curve(self.parameters(), f"curve_{name}", bruneton=bruneton)

    def compare_measured(
        self,
        models: tuple[str, ...] = ("single", "multiple"),
        scan: int | None = None,
        progress: Progress | None = None,
    ) -> list[dict[str, Any]]:
        """Compare the sky of the present air with the measured one.

        Parameters
        ----------
        models : tuple of str
            Among ``"single"``, ``"multiple"``, ``"bruneton"`` (whose table is made first, if need
            be) and ``"reference"`` (path tracing, about a second a scan).
        scan : int, optional
            Index of one scan; default all.
        progress : callable, optional
            ``progress(fraction, message)``; raise in it to cancel.

        Returns
        -------
        list of dict
            ``model``, ``rmse`` in mW m⁻² sr⁻¹ nm⁻¹, mean ``level`` and ``pattern``, for each model;
            see ``sunwidget.validation.measurements.Comparison``.

        Raises
        ------
        MeasurementsError
            When the measured skies are not on this machine; the message says how to get them.
        RendererError
            For Bruneton's model when no EGL context can be made on this machine.
        """
        data, air = measurements.load(), self.atmosphere
        others = {}
        if "bruneton" in models:
            from sunwidget.renderer.bruneton.precomputed_sky import bruneton_table

            others["bruneton"] = bruneton_table(air, progress=progress).radiance
        rows = measurements.compare(
            models, scan=scan, atmosphere=air, data=data, others=others, progress=progress
        )
        return [row._asdict() for row in rows]

    def refresh_scans(self) -> None:
        """Look again for measured skies on this machine, after ``measurements.download()``."""
        self._scans = scans()

    def code(self) -> str:
        """Return runnable Python for this state (``import sunwidget as sw`` first)."""
        changed = {
            p.name: getattr(self, p.name)
            for p in EXPLORER_PARAMETERS
            if getattr(self, p.name) != p.default
        }
        # Place and time, or a scan, bring the sun along.
        changed = {name: value for name, value in changed.items() if name not in _SUN}
        if not self._sun_follows():
            changed |= {name: getattr(self, name) for name in _SUN}
        arguments = ", ".join(f"{name}={value!r}" for name, value in changed.items())
        return f"sw.SkyExplorer({arguments})"

    def set_state(self, sync_data: dict[str, Any]) -> None:
        """Take over what the browser sent; a value that is refused is answered, not raised."""
        with self._lock:
            self._browser_thread = threading.get_ident()
            try:
                super().set_state(sync_data)
            finally:
                self._browser_thread = None

    def _air(self) -> Atmosphere:
        """Return the air as the sliders have it, whatever is switched off."""
        return Atmosphere(**{name: getattr(self, name) for name in table.AIR})

    def _set_haze(self, name: str, value: float) -> None:
        make = Atmosphere.with_turbidity if name == "turbidity" else Atmosphere.with_visibility
        row = table.parameter("aerosol_optical_depth")
        try:
            depth = make(self._air(), value).aerosol_optical_depth
            self.aerosol_optical_depth = table.checked(row, depth)
        except ValueError as error:
            raise traitlets.TraitError(f"{name} = {value!r:.80} cannot be set: {error}") from None

    @contextlib.contextmanager
    def _moving_the_sun(self) -> Iterator[None]:
        """Mark that what moves the sun meanwhile is the time or the scan, not a hand."""
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
            self._day = []  # never the path of another place
            raise
        self._day = np.round(path, 6).tolist()

    def _followed_sun(self) -> tuple[float, float]:
        """Azimuth and elevation that time, scan or else the table give."""
        if self._day and self.time is not None:
            azimuth, elevation = solar.sun_on_path(self._day, self.time)
            # The table ends at -12°: below it is night all the same.
            return azimuth, max(elevation, table.parameter("sun_elevation").minimum)
        if self.scan is not None:
            return self._measured["sun_azimuth"], self._measured["sun_elevation"]
        return table.parameter("sun_azimuth").default, table.parameter("sun_elevation").default

    def _sun_follows(self) -> bool:
        """Tell whether the sun is where time, scan or else the table put it."""
        azimuth, elevation = self._followed_sun()
        turn = (self.sun_azimuth - azimuth + 180) % 360 - 180
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
        if self._browser_thread != threading.get_ident():  # it has moved the sun itself
            with self._lock:
                self._follow_time()

    def _on_sun(self, _change: Any) -> None:
        # A hand moved the sun off its path; the browser does likewise.
        if self._moving or self._browser_thread == threading.get_ident():
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
                raise traitlets.TraitError(f"scan = {value}: there are scans 0 to {count - 1}.")
        return value

    def _actions(self) -> dict[str, Action]:
        """Return what the browser can ask for, by name."""
        return actions(self)

    def _static_picture(self) -> bytes:
        """Return a small PNG for viewers that run no widgets."""
        parameters = self.parameters()
        # Tables and paths take seconds to minutes, which no cell should wait for.
        for name in ("model", "compare"):
            if parameters[name] in ("bruneton", "reference"):
                parameters[name] = table.parameter(name).default
        if self._picture is None or self._picture[0] != parameters:
            from sunwidget.explorer.draw import draw

            self._picture = parameters, encode_png(draw(parameters, _PICTURE_SIZE))
        return self._picture[1]

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        return with_picture(super()._repr_mimebundle_(**kwargs), self._static_picture)
