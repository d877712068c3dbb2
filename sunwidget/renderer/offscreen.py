"""Render Scene and Edit to pixels: the kernel's half of "described once, run twice"."""

from __future__ import annotations

import functools
import operator
from collections import OrderedDict
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from sunwidget.analysis.correct import corrected
from sunwidget.analysis.frame_inputs import texture, uniforms
from sunwidget.analysis.scene import checked_scene
from sunwidget.edit.recipe import edit_of
from sunwidget.edit.table import METHODS, Edit
from sunwidget.errors import EditError
from sunwidget.formats.pixels import MAX_PIXELS
from sunwidget.messages import short_repr
from sunwidget.renderer.compile_ahead import helped
from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.graph import FrameGraph, Programs, largest_texture
from sunwidget.renderer.shader_source import frame_graph
from sunwidget.renderer.tiles import (
    STRIP_PIXELS,
    Strips,
    copy_size,
    fold,
    is_resident,
    pieces,
    scene_textures,
)
from sunwidget.renderer.values import drawn_for, states

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import moderngl
    import numpy.typing as npt

    from sunwidget.analysis.scene import Scene

MAX_HEADROOM = 8
"""Most stops above white in a frame."""

# Frame-sized passes are drawn in bands of about this many pixels, which bounds memory at any
# size: three RGBA32F targets of 2.1 MP are 100 MB. A 1080p frame is one band, so that a film
# computes the sky of the unmoved sun once instead of for each frame.
_BAND_PIXELS = 2_100_000


@dataclass
class _Drawing:
    """A picture on the GL thread: its scene, its graph, and the strips of a large picture."""

    scene: Scene
    graph: FrameGraph
    strips: Strips | None
    loaded: slice | None = None
    lit: bool = False

    def light(self) -> None:
        """Upload the light behind windows, unless loaded; few edits switch it on."""
        if not self.lit:
            self.graph.set_texture("lamps", texture(self.scene, "lamps", self.scene.photo.size))
            self.lit = True

    def load(self, rows: slice, limit: int) -> None:
        """Upload the strip of ``rows``, unless loaded."""
        assert self.strips is not None
        if self.loaded == rows:
            return
        textures, strip = self.strips.textures(rows)
        folds = {name: fold(image, limit) for name, image in textures.items()}
        self.graph.set_strip(folds, strip)
        self.loaded = rows


class _Renderer:
    """State of the GL thread: the programs, and the scenes drawn last."""

    def __init__(self, context: moderngl.Context) -> None:
        self.context = context
        self.programs = Programs(context)
        self.drawings: OrderedDict[tuple[int, Any], _Drawing] = OrderedDict()

    def drawing(self, scene: Scene, size: tuple[int, int], *, lit: bool = False) -> _Drawing:
        """Return the drawing with the textures of ``scene`` at ``size``.

        ``lit`` also loads the light behind windows.
        """
        key = (id(scene), size)
        if key not in self.drawings:
            limit = largest_texture(self.context)
            # The entry keeps the scene alive, so that its id stays unique.
            self.drawings[key] = _Drawing(
                scene,
                FrameGraph(self.programs, scene_textures(scene, copy_size(size, limit), lit=False)),
                None if is_resident(size, limit) else Strips(scene, size),
            )
            while len(self.drawings) > 2:
                self.drawings.popitem(last=False)
        self.drawings.move_to_end(key)
        if lit:
            self.drawings[key].light()
        return self.drawings[key]

    def graph(self, scene: Scene, size: tuple[int, int]) -> FrameGraph:
        """Return the graph of the drawing."""
        return self.drawing(scene, size).graph


_renderers: dict[int, _Renderer] = {}


def _renderer(context: moderngl.Context) -> _Renderer:
    if id(context) not in _renderers:
        _renderers.clear()  # the old context was lost
        _renderers[id(context)] = _Renderer(context)
    return _renderers[id(context)]


def render(
    scene: Scene,
    edit: Edit | dict[str, Any] | None = None,
    *,
    dtype: str = "uint8",
    size: tuple[int, int] | None = None,
    method: str | None = None,
    headroom: float = 0.0,
    progress: Callable[[float, str], Any] | None = None,
) -> npt.NDArray[Any]:
    """Draw ``scene`` with ``edit`` applied.

    Parameters
    ----------
    scene : Scene
        The result of ``analyze``.
    edit : Edit or dict, optional
        Edit or recipe; ``Edit()``, the default, changes nothing.
    dtype : {"uint8", "uint16", "float32"}
        uint8 and uint16 are sRGB-encoded; float32 is linear Rec. 709, unclamped.
    size : (width, height), optional
        Output size in pixels, default the photo's own.
    method : {"ratio", "thesis", "thesis_literal"}, optional
        Overrides ``edit.method``.
    headroom : float, 0–8
        Stops above white in a float32 picture: light that the edit adds (the sun's disc, its
        glow, glitter) reaches up to 2 ** headroom instead of 1; all other light stays the same.
        With 0, the default, nothing exceeds white. Only for the ``method`` "ratio".
    progress : callable, optional
        Called with (fraction, message) after each band; raise in it to cancel.

    Returns
    -------
    array, (height, width, 3)

    Raises
    ------
    EditError
        For an unknown dtype or method, an impossible size, or headroom that is out of range or
        for an integer dtype.
    AnalysisError
        If ``scene`` is not a Scene.
    RendererError
        If this machine has no EGL.
    """
    edit = edit_of(edit)
    if method is not None:
        edit = edit.replace(method=method)
    width, height = checked_scene(scene).photo.size if size is None else checked_size(size)
    out: npt.NDArray[Any] | None = None
    strips = strips_of(scene, edit, dtype, (width, height), progress, headroom=headroom)
    for rows, pixels in strips:
        if out is None:
            out = np.empty((height, width, 3), pixels.dtype)
        out[rows] = pixels
    assert out is not None  # a picture has at least one row
    return out


def strips_of(
    scene: Scene,
    edit: Edit | None = None,
    dtype: str = "uint8",
    size: tuple[int, int] | None = None,
    progress: Callable[[float, str], Any] | None = None,
    *,
    within: slice | None = None,
    headroom: float = 0.0,
) -> Iterator[tuple[slice, npt.NDArray[Any]]]:
    """Draw ``scene`` with ``edit`` applied, some rows at a time.

    The strips together are the picture that ``render`` returns, but only one is in memory at a
    time. Other pictures may be drawn between strips.

    Parameters
    ----------
    scene, edit, dtype, size, progress, headroom
        As for ``render``.
    within : slice, optional
        Draw only the strips that contain some of these rows.

    Yields
    ------
    rows : slice
        Rows of this strip, from top to bottom, without gaps or overlaps.
    pixels : array, (rows, width, 3)

    Raises
    ------
    EditError, RendererError
        As ``render``, when the first strip is requested.
    """
    if not isinstance(dtype, str) or dtype not in ("uint8", "uint16", "float32"):
        raise EditError(
            f"dtype must be 'uint8', 'uint16' or 'float32', not {short_repr(dtype, 40)}."
        )
    white = 2.0 ** checked_headroom(headroom, dtype)
    edit = edit_of(edit)
    scene = corrected(scene, edit)
    size = scene.photo.size if size is None else checked_size(size)
    lit = edit.window_lights > 0
    drawing, limit = on_gl_thread(
        lambda context: (
            _renderer(context).drawing(scene, size, lit=lit),
            largest_texture(context),
        )
    )

    def draw(rows: slice, columns: list[slice], context: moderngl.Context) -> npt.NDArray[Any]:
        nonlocal drawing
        if drawing.graph.context is not context:  # the context was lost and created again
            drawing = _renderer(context).drawing(scene, size, lit=lit)
        if drawing.strips is not None:
            # On the GL thread, so that no other picture's strip can be loaded in between.
            drawing.load(rows, limit)
        graph = drawing.graph
        parts = [draw_part(graph, scene, edit, size, dtype, rows, part, white) for part in columns]
        return parts[0] if len(parts) == 1 else np.concatenate(parts, axis=1)

    first, end, _ = (within or slice(None)).indices(size[1])
    pixels = _BAND_PIXELS if drawing.strips is None else min(STRIP_PIXELS, _BAND_PIXELS)
    for rows, columns in pieces(size, pixels, limit):
        if rows.stop <= first or rows.start >= end:
            continue
        yield rows, on_gl_thread(functools.partial(draw, rows, columns))
        if progress is not None:
            progress(rows.stop / size[1], "rendering")


def draw_part(
    graph: FrameGraph,
    scene: Scene,
    edit: Edit,
    size: tuple[int, int],
    dtype: str,
    rows: slice = slice(None),
    columns: slice = slice(None),
    white: float = 1.0,
) -> npt.NDArray[Any]:
    """Draw a part of the picture, by default all of it, on the GL thread."""
    top, bottom, _ = rows.indices(size[1])
    left, right, _ = columns.indices(size[0])
    values = states(edit, scene.automatic)
    tile = (left, top, right - left, bottom - top)
    host = _host_values(size, dtype, white)
    asked = drawn_for(edit.method, values["edit"])
    frame = (values, _scene_values(scene), host, tile, asked)
    with helped(graph, frame):
        target = graph.run(*frame)
    shape = (bottom - top, right - left, 3)
    if dtype == "uint8":  # the shader has rounded already
        levels = np.empty(shape, np.uint8)
        target.framebuffer.read_into(levels, components=3, alignment=1)
        return levels
    pixels: npt.NDArray[Any] = np.empty(shape, np.float32)
    target.framebuffer.read_into(pixels, components=3, dtype="f4")
    if dtype == "float32":
        return pixels
    return np.clip(pixels * 65535 + 0.5, 0, 65535).astype(np.uint16)


def render_pass(
    scene: Scene, edit: Edit, name: str, size: tuple[int, int] | None = None
) -> npt.NDArray[np.float32]:
    """Return the output of one pass of the graph, (h, w, 4) float32, for tests and lessons."""
    scene = corrected(scene, edit)
    size = scene.photo.size if size is None else checked_size(size)

    def task(context: moderngl.Context) -> npt.NDArray[np.float32]:
        drawing = _renderer(context).drawing(scene, size, lit=edit.window_lights > 0)
        if drawing.strips is not None:
            drawing.load(slice(0, size[1]), largest_texture(context))
        values = states(edit, scene.automatic)
        target = drawing.graph.run(
            values,
            _scene_values(scene),
            _host_values(size, "float32"),
            (0, 0, *size),
            drawn_for(edit.method, values["edit"]),
            until=name,
        )
        width, height = target.texture.size
        data = np.frombuffer(target.texture.read(), np.float32)
        return data.reshape(height, width, 4).copy()

    return on_gl_thread(task)


def checked_size(size: Any) -> tuple[int, int]:
    """Return ``size`` as whole (width, height) in pixels, at least 1 and at most MAX_PIXELS.

    Raises
    ------
    EditError
        For any other size.
    """
    try:
        width, height = (operator.index(n) for n in size)
    except (TypeError, ValueError):
        width = height = 0
    if width < 1 or height < 1:
        raise EditError(
            f"size must be (width, height) in whole pixels, not {short_repr(size, 40)}."
        )
    if width * height > MAX_PIXELS:
        raise EditError(
            f"size = {short_repr((width, height), 40)} is more than {MAX_PIXELS / 1e6:.0f} "
            "megapixels. Choose a smaller size."
        )
    return width, height


def checked_headroom(headroom: Any, dtype: str = "float32") -> float:
    """Return ``headroom`` in stops above white, 0 to ``MAX_HEADROOM``.

    Raises
    ------
    EditError
        For any other value, and for headroom with an integer dtype.
    """
    number = isinstance(headroom, (int, float, np.number)) and not isinstance(headroom, bool)
    if not number or not 0 <= headroom <= MAX_HEADROOM:
        raise EditError(
            f"headroom must be a number of stops from 0 to {MAX_HEADROOM}, not "
            f"{short_repr(headroom, 40)}."
        )
    if headroom and dtype != "float32":
        raise EditError(f"headroom needs dtype='float32', since {dtype} has no light above white.")
    return float(headroom)


def _scene_values(scene: Scene) -> dict[str, Any]:
    known = uniforms(scene)
    return {name: known[name] for name in frame_graph()["scene_uniforms"]}


def _host_values(size: tuple[int, int], dtype: str, white: float = 1.0) -> dict[str, Any]:
    return {
        "frame_size": (float(size[0]), float(size[1])),
        "canvas_flip": 0.0,
        "output_transfer": 0 if dtype == "float32" else 1,
        "output_levels": 255 if dtype == "uint8" else 0,
        "output_white": white,
        "dither": {"uint8": 0.5, "uint16": 0.5 / 257, "float32": 0.0}[dtype],
    }


__all__ = [
    "METHODS",
    "checked_size",
    "render",
    "render_pass",
    "scene_textures",
    "strips_of",
]
