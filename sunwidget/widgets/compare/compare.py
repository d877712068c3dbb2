"""Compare: methods or recipes side by side on one photo, under one sun.

The browser draws the pictures in turn with one frame graph. The kernel analyzes the photo once, and
corrects it once for every recipe with different strokes or hints.
"""

from __future__ import annotations

import math
import os
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import traitlets

from sunwidget.analysis import correct
from sunwidget.analysis.scene import Scene
from sunwidget.edit.recipe import edit_of
from sunwidget.edit.table import Edit, parameter
from sunwidget.formats.png import encode_small_png
from sunwidget.photo.photo import Photo, open_photo
from sunwidget.widgets.compare.variants import common_sun, corrections, variants
from sunwidget.widgets.kernel.analysed import OPENING, Analysed
from sunwidget.widgets.kernel.analyst import Analyst
from sunwidget.widgets.kernel.edit_traits import AnswersRefusals, edit_traits
from sunwidget.widgets.kernel.front_end import front_end
from sunwidget.widgets.kernel.output import with_picture
from sunwidget.widgets.kernel.payload import (
    encode_maps,
    encode_preview,
    parameter_json,
    saved_photo,
    scene_json,
    thumbnail,
)
from sunwidget.widgets.kernel.sources import opened
from sunwidget.widgets.page.framed import StaticPage
from sunwidget.widgets.page.standalone import widget_state, write_page

if TYPE_CHECKING:
    from PIL import Image

_SUN = ("sun_azimuth", "sun_elevation")
_SMALL_EDGE = 480  # limit of each picture in the static one
_SMALL_PIXELS = 300_000  # limit of all together, since notebooks store them
_NOTES = ("Drag the sun in any picture: everything happens in this file, and nothing leaves it.",)
LAYOUTS = ("side_by_side", "wipe")


class Compare(Analysed, AnswersRefusals):
    """Show methods or recipes side by side on one photo.

    Dragging the sun in one picture moves it in all; zooming one zooms all.

    Parameters
    ----------
    source : path, bytes, file object, PIL image, array, Photo or Scene
        The picture; see ``sunwidget.open``.
    what : list or mapping
        2 to 9 of: an ``Edit`` or a recipe; the name of a method ("ratio", "thesis",
        "thesis_literal") or of a preset ("sunset" …); "photo", the original photo. A mapping
        sets labels: ``{"mine": edit, "thesis": "thesis"}``.
    recipe : Edit or dict, optional
        Base that each of them overrides.
    **options
        Any parameter of ``Edit``, which overrides ``recipe``, and any option of
        ``sunwidget.analyze``.

    Attributes
    ----------
    sun_azimuth, sun_elevation : float or None
        The sun of all pictures, in degrees; None is the photo's own.
    one_sun : bool
        Whether all pictures have one sun. Initially on, unless the pictures have different suns.
        When it is off, each picture has its own; moving the sun turns it on.
    arrangement : {"side_by_side", "wipe"}
        All side by side, or two over each other with a divider.
    difference : bool
        Whether each picture shows its difference from the first (CIEDE2000).

    Raises
    ------
    EditError
        For an unknown name, with the nearest spelling, or a value out of range.
    TypeError
        For an unknown keyword, or an option of ``analyze`` together with a Scene.
    PhotoError
        For a picture that cannot be opened.

    Examples
    --------
    >>> compare = sw.Compare("beach.jpg", ["photo", "ratio", "thesis"], sun_elevation=3)
    >>> pictures = compare.render(size=(1200, 800))
    """

    _esm, _css = front_end("compare", "Compare")

    _parameters: traitlets.List = traitlets.List().tag(sync=True)
    # The rows that this widget sets, with its initial values as defaults.
    _rows: traitlets.List = traitlets.List().tag(sync=True)
    _photo = traitlets.Bytes(b"").tag(sync=True, echo_update=False)
    _scenes: traitlets.List = traitlets.List().tag(sync=True, echo_update=False)
    _variants: traitlets.List = traitlets.List().tag(sync=True)
    _history = traitlets.Dict().tag(sync=True)

    one_sun = traitlets.Bool(True, help="Whether all pictures have one sun.").tag(sync=True)
    arrangement = traitlets.Enum(
        LAYOUTS, LAYOUTS[0], help="All side by side, or two with a divider."
    ).tag(sync=True)
    difference = traitlets.Bool(
        False, help="Whether each picture shows its difference from the first (CIEDE2000)."
    ).tag(sync=True)

    locals().update(edit_traits(parameter(name) for name in _SUN))

    def __init__(
        self,
        source: Any,
        what: Any,
        *,
        recipe: Edit | dict[str, Any] | None = None,
        **options: Any,
    ) -> None:
        source, analysis = opened(source, options, "Compare")
        self._shown = variants(what, edit_of(recipe).replace(**options))
        self.photo: Photo = source.photo if isinstance(source, Scene) else source
        self._lock = threading.RLock()
        self._revision = 0
        self._edits: dict[str, Edit] = {}  # by label, once the photo is analyzed
        sun = common_sun(self._shown)
        start = {
            "sun_azimuth": None if sun is None else sun[0],
            "sun_elevation": None if sun is None else sun[1],
            "one_sun": sun is not None,
        }
        super().__init__(
            _parameters=parameter_json(),
            _rows=[{"name": name, "default": value} for name, value in start.items()],
            _photo=encode_preview(self.photo),
            _variants=[{"label": variant.label} for variant in self._shown],
            _status=OPENING,
            _history={"past": [], "future": []},
            **start,
        )
        self._analyst = Analyst(source, analysis, self._deliver, self._report)
        self._analyst.ask(Edit())

    def __repr__(self) -> str:
        return f"<Compare of {self.photo.name!r}: {', '.join(each.label for each in self._shown)}>"

    @property
    def edits(self) -> dict[str, Edit]:
        """The edits by label, with the current sun; waits for the analysis."""
        self._analyst.wait()
        sun = {name: getattr(self, name) for name in _SUN}
        photos = {variant.label for variant in self._shown if variant.is_photo}
        return {
            label: edit.replace(**sun) if self.one_sun and label not in photos else edit
            for label, edit in self._edits.items()
        }

    def render(self, **options: Any) -> dict[str, Any]:
        """Return the pictures by label; ``options`` as in ``sunwidget.render``.

        Examples
        --------
        >>> study = sw.Study(compare.render(size=(1200, 800)))
        """
        from sunwidget.renderer.offscreen import render

        scene = self.scene
        return {label: render(scene, edit, **options) for label, edit in self.edits.items()}

    def sheet(self, long_edge: int = 640) -> Image.Image:
        """Return all pictures side by side, with their labels, as one picture.

        Parameters
        ----------
        long_edge : int, default 640
            Pixels of each picture's longer side, at most the photo's.

        Returns
        -------
        PIL.Image.Image

        Examples
        --------
        >>> compare.sheet().save("methods.png")
        """
        from sunwidget.export.sheet import sheet

        return sheet(self.render(size=self.photo.size_within(long_edge)))

    def to_html(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        title: str | None = None,
        overwrite: bool = False,
    ) -> Path | str:
        """Write a page in which the pictures can be compared: one file, no kernel, no network.

        Waits for the analysis.

        Parameters
        ----------
        path : path, optional
            The file to write. Default: return the page as text.
        title : str, optional
            Title of the page. Default: the photo's name.
        overwrite : bool
            Replace an existing file.

        Returns
        -------
        Path or str
            The written file, or the page.

        Raises
        ------
        FileExistsError
            When ``path`` exists and ``overwrite`` is false.
        """
        return write_page(lambda: self._page(title or self.photo.name), path, overwrite=overwrite)

    def render_static(self, *, title: str | None = None) -> StaticPage:
        """Return the page of ``to_html`` as a cell's output; its sun moves without a kernel.

        For exported notebooks; waits for the analysis. See ``SunEditor.render_static``.

        Parameters
        ----------
        title : str, optional
            Title of the page. Default: the photo's name.
        """
        name = title or self.photo.name
        return StaticPage(self._page(name), name)

    def _page(self, title: str) -> str:
        from sunwidget.widgets.page.html import Still, page

        self.wait()
        picture = self._static_picture()
        size = open_photo(picture).size
        still = Still(picture, size, f"{self.photo.name}: {', '.join(self._edits)}")
        with self._lock:
            embedded = widget_state(self)
        return page(embedded, still, title=title, notes=_NOTES)

    def _deliver(self, scene: Scene) -> None:
        edits = {variant.label: variant.edit(scene) for variant in self._shown}
        # Recipes with the same corrections share their maps.
        places: dict[tuple[Any, ...], int] = {}
        scenes: list[dict[str, Any]] = []
        for edit in edits.values():
            if corrections(edit) in places:
                continue
            places[corrections(edit)] = len(scenes)
            corrected = correct.corrected(scene, edit)
            self._revision += 1
            scenes.append({"scene": scene_json(corrected, self._revision)} | encode_maps(corrected))
        with self._lock, self.hold_sync():
            self._edits = edits
            self._scenes = scenes
            self._variants = [
                {
                    "label": variant.label,
                    "recipe": edits[variant.label].to_dict(),
                    "scene": places[corrections(edits[variant.label])],
                    "photo": variant.is_photo,
                }
                for variant in self._shown
            ]

    def _light_state(self) -> dict[str, Any]:
        return {"_photo": saved_photo(self.photo), "_scenes": []}

    def _static_picture(self) -> bytes:
        """Return a small PNG: all pictures if the scene is ready, otherwise the photo."""
        from sunwidget.errors import RendererError

        if self._can_show_edits():
            try:
                return encode_small_png(np.asarray(self.sheet(self._small_edge())))
            except RendererError:
                pass
        return thumbnail(self.photo)

    def _small_edge(self) -> int:
        width, height = self.photo.size_within(_SMALL_EDGE)
        room = _SMALL_PIXELS / (width * height * len(self._shown))
        return max(1, int(max(width, height) * min(1.0, math.sqrt(room))))

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        return with_picture(super()._repr_mimebundle_(**kwargs), self._static_picture)
