"""SkyExplorer: see how the clear sky comes about, in a notebook.

The browser draws every frame itself from the traits; the kernel provides the sun's path over a
place, Bruneton's table, measured skies, pictures and code.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.explorer import table
from sunwidget.explorer.table import EXPLORER_PARAMETERS
from sunwidget.formats.png import encode_png
from sunwidget.progress import Progress
from sunwidget.validation import measurements
from sunwidget.widgets.explorer.air import ALIASES, ExplorerAir
from sunwidget.widgets.explorer.answers import actions, bruneton_slice
from sunwidget.widgets.explorer.parameters import NAMES
from sunwidget.widgets.explorer.sun_follower import SUN, SunFollower
from sunwidget.widgets.kernel.front_end import front_end
from sunwidget.widgets.kernel.output import with_picture
from sunwidget.widgets.kernel.requests import Action, Requests
from sunwidget.widgets.page.framed import StaticPage
from sunwidget.widgets.page.standalone import explorer_page, write_page

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_PICTURE_SIZE = (480, 320)  # of the static picture


class SkyExplorer(SunFollower, ExplorerAir):
    """See how the clear sky comes about: sun, air, orders of scattering, models, measurements.

    Every row of ``sunwidget.explorer.table.EXPLORER_PARAMETERS`` is a trait of the same name,
    synchronized both ways: setting one changes the picture, and moving a slider sets it.

    Parameters
    ----------
    atmosphere : Atmosphere, optional
        The air, for instance ``scene.atmosphere`` of a photo.
    turbidity : float, optional
        Ratio of the optical depth with haze to that of air alone, at 550 nm; sets
        ``aerosol_optical_depth``.
    visibility : float, optional
        Meteorological visibility in metres; sets ``aerosol_optical_depth``.
    **parameters
        Any row of the table, which overrides ``atmosphere``.

    Raises
    ------
    TypeError
        For an unknown parameter; the nearest spelling is suggested.
    TraitError
        For an invalid value; the message says what is valid.
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

    def __init__(self, *, atmosphere: Atmosphere | None = None, **parameters: Any) -> None:
        for name in parameters:
            if name not in NAMES and name not in ALIASES:
                others = (*ALIASES, "atmosphere")
                raise TypeError(f"SkyExplorer: {table.unknown_name_message(name, others)}")
        aliases = {name: parameters.pop(name) for name in ALIASES if name in parameters}
        if len(aliases) + ("aerosol_optical_depth" in parameters) > 1:
            raise TypeError(
                "SkyExplorer takes one of turbidity=, visibility= and aerosol_optical_depth=: "
                "they are three names of one quantity."
            )
        if atmosphere is not None:
            parameters = {**atmosphere.parameters(), **parameters}
        self._picture: tuple[Any, bytes] | None = None
        super().__init__(**parameters)
        for name, value in aliases.items():
            setattr(self, name, value)
        self.on_msg(Requests(self.send, self._actions()))

    def __repr__(self) -> str:
        return f"<{self.code().removeprefix('sw.')}>"

    def render(
        self,
        size: tuple[int, int] = (960, 640),
        samples: int = 64,
        progress: Progress | None = None,
    ) -> NDArray[np.uint8]:
        """Return the present picture.

        Parameters
        ----------
        size : (int, int), default (960, 640)
            Width and height in pixels.
        samples : int, default 64
            Paths per pixel of the model ``reference``; noise falls with the square root. Without a
            graphics card one path for each of 960×640 pixels takes seconds.
        progress : callable, optional
            ``progress(fraction, message)``, for slow models; raise an exception in it to cancel.

        Returns
        -------
        ndarray, shape (height, width, 3), uint8
            sRGB.

        Raises
        ------
        RendererError
            If no EGL context can be created on this machine.
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
        """Write a page with the explorer in its present state: one file, no kernel, no network.

        Parameters
        ----------
        path : path, optional
            Where to write the page. By default it is not written but returned as text.
        title : str
            Title of the page.
        overwrite : bool
            Replace an existing file.

        Returns
        -------
        Path or str
            The path of the page, or its text.

        Raises
        ------
        FileExistsError
            If ``path`` exists and ``overwrite`` is false.
        OSError
            If the folder is missing or the disk is full; no partial file is left.
        """
        return write_page(lambda: explorer_page(self, title=title), path, overwrite=overwrite)

    def render_static(self, *, title: str = "Sky explorer") -> StaticPage:
        """Return the page of ``to_html`` as a cell's output: live without a kernel.

        It is for exported notebooks: ``nbconvert --to html`` keeps it live, without a network. The
        notebook grows by the page, 0.3 MB.

        Parameters
        ----------
        title : str
            Title of the page.
        """
        return StaticPage(explorer_page(self, title=title), title)

    def curve(self, name: str) -> NDArray[np.float32]:
        """Return one of the curves beside the picture, shape (n, 4).

        docs/developer/frame-graph.md describes its columns.

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
            For an unknown name.
        RendererError
            If no EGL context can be created on this machine.
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
        """Compare the sky of the present air with measured skies.

        Parameters
        ----------
        models : tuple of str
            Any of ``"single"``, ``"multiple"``, ``"bruneton"`` (whose table is computed first if
            necessary) and ``"reference"`` (path tracing, about a second per scan).
        scan : int, optional
            Index of one scan; default all.
        progress : callable, optional
            ``progress(fraction, message)``; raise an exception in it to cancel.

        Returns
        -------
        list of dict
            ``model``, ``rmse`` in mW m⁻² sr⁻¹ nm⁻¹, mean ``level`` and ``pattern``, for each model;
            see ``sunwidget.validation.measurements.Comparison``.

        Raises
        ------
        MeasurementsError
            If the measured skies are not on this machine; the message says how to get them.
        RendererError
            For Bruneton's model, if no EGL context can be created on this machine.
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

    def code(self) -> str:
        """Return runnable Python for this state (``import sunwidget as sw`` first)."""
        changed = {
            p.name: getattr(self, p.name)
            for p in EXPLORER_PARAMETERS
            if getattr(self, p.name) != p.default
        }
        # Place and time, or a scan, determine the sun.
        changed = {name: value for name, value in changed.items() if name not in SUN}
        if not self._sun_follows():
            changed |= {name: getattr(self, name) for name in SUN}
        arguments = ", ".join(f"{name}={value!r}" for name, value in changed.items())
        return f"sw.SkyExplorer({arguments})"

    def _actions(self) -> dict[str, Action]:
        """Return the actions that the browser can request, by name."""
        return actions(self)

    def _static_picture(self) -> bytes:
        """Return a small PNG for viewers that run no widgets."""
        parameters = self.parameters()
        # Tables and paths take seconds to minutes; a cell's output must not wait for them.
        for name in ("model", "compare"):
            if parameters[name] in ("bruneton", "reference"):
                parameters[name] = table.parameter(name).default
        if self._picture is None or self._picture[0] != parameters:
            from sunwidget.explorer.draw import draw

            self._picture = parameters, encode_png(draw(parameters, _PICTURE_SIZE))
        return self._picture[1]

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        return with_picture(super()._repr_mimebundle_(**kwargs), self._static_picture)
