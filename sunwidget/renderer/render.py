"""Scene and Edit to pixels: the kernel's half of "described once, run twice"."""

from __future__ import annotations

import functools
import math
import operator
from collections import OrderedDict
from typing import TYPE_CHECKING, Any

import numpy as np

from sunwidget.edit import METHODS, Edit, EditError
from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.graph import FrameGraph, Programs
from sunwidget.renderer.shader_source import frame_graph
from sunwidget.renderer.values import states

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import moderngl
    import numpy.typing as npt

    from sunwidget.analysis.scene import Scene

# Frame-sized passes are drawn in bands of about this many pixels, so that memory stays
# bounded at any size: three RGBA32F targets of 2.1 MP are 100 MB. A 1080p frame is one band,
# so that a film computes the sky of the unmoved sun once and not for each frame.
_BAND_PIXELS = 2_100_000
_OUTPUT = {"uint8": (255, np.uint8), "uint16": (65535, np.uint16)}


class _Renderer:
    """Lives on the GL thread: the programs, and the graphs of the last scenes drawn."""

    def __init__(self, context: moderngl.Context) -> None:
        self.context = context
        self.programs = Programs(context)
        self.graphs: OrderedDict[tuple[int, Any], tuple[Scene, FrameGraph]] = OrderedDict()

    def graph(self, scene: Scene, size: tuple[int, int]) -> FrameGraph:
        """Return the graph that holds the textures of ``scene`` at ``size``."""
        key = (id(scene), size)
        if key not in self.graphs:
            # The entry keeps the scene alive, so that its id stays its own.
            self.graphs[key] = (scene, FrameGraph(self.programs, scene_textures(scene, size)))
            while len(self.graphs) > 2:
                self.graphs.popitem(last=False)
        self.graphs.move_to_end(key)
        return self.graphs[key][1]


_renderers: dict[int, _Renderer] = {}


def _renderer(context: moderngl.Context) -> _Renderer:
    if id(context) not in _renderers:
        _renderers[id(context)] = _Renderer(context)
    return _renderers[id(context)]


def scene_textures(scene: Scene, size: tuple[int, int]) -> dict[str, npt.NDArray[Any]]:
    """Return the scene textures of the frame graph at ``size`` (width, height)."""
    import cv2

    from sunwidget.analysis.clear_sky import clear_sky

    photo = scene.photo.pixels
    layers, surface = scene.layers(), scene.surface(size)
    if (photo.shape[1], photo.shape[0]) != size:
        photo = cv2.resize(photo, size, interpolation=cv2.INTER_AREA)
        layers = cv2.resize(layers, size, interpolation=cv2.INTER_AREA)
    return {
        "photo": photo.astype(np.float32, copy=False),
        "layers": quantise_map(layers),
        "surface": quantise_map(surface),
        "backdrop": quantise_map(scene.backdrop),
        "clear_sky": quantise_map(clear_sky(scene)),
    }


def quantise_map(image: npt.NDArray[np.float32]) -> npt.NDArray[np.uint8]:
    """Return a map in [0, 1] as the 8-bit levels that both hosts read."""
    levels = np.clip(image * 255 + 0.5, 0, 255)
    return levels.astype(np.uint8)


def render(
    scene: Scene,
    edit: Edit | None = None,
    *,
    dtype: str = "uint8",
    size: tuple[int, int] | None = None,
    method: str | None = None,
    progress: Callable[[float, str], Any] | None = None,
) -> npt.NDArray[Any]:
    """Draw ``scene`` with ``edit`` applied.

    Parameters
    ----------
    scene : Scene
        What ``analyze`` returned.
    edit : Edit, optional
        What to change; ``Edit()``, the default, changes nothing.
    dtype : {"uint8", "uint16", "float32"}
        uint8 and uint16 are sRGB-encoded; float32 is linear Rec. 709, unclamped.
    size : (width, height), optional
        Output size in pixels, default the photo's own.
    method : {"ratio", "thesis", "thesis_literal"}, optional
        Overrides ``edit.method``.
    progress : callable, optional
        Called with (fraction, message) after each band; raise in it to cancel.

    Returns
    -------
    array, (height, width, 3)

    Raises
    ------
    EditError
        For an unknown dtype, method or size.
    RendererError
        When this machine has no EGL.
    """
    edit = Edit() if edit is None else edit
    if method is not None:
        edit = edit.replace(method=method)
    scene = scene.corrected(edit)
    own = (scene.photo.pixels.shape[1], scene.photo.pixels.shape[0])
    width, height = own if size is None else checked_size(size)
    out: npt.NDArray[Any] | None = None
    for rows, pixels in strips_of(scene, edit, dtype, (width, height), progress):
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
) -> Iterator[tuple[slice, npt.NDArray[Any]]]:
    """Draw ``scene`` with ``edit`` applied, some rows at a time.

    The strips together are the picture that ``render`` returns; only one is in memory at a
    time. Other pictures may be drawn between two strips.

    Parameters
    ----------
    scene, edit, dtype, size, progress
        As for ``render``.

    Yields
    ------
    rows : slice
        The rows of this strip, from the top downwards, without gap or overlap.
    pixels : array, (rows, width, 3)

    Raises
    ------
    EditError, RendererError
        As ``render``, when the first strip is asked for.
    """
    if dtype not in ("uint8", "uint16", "float32"):
        raise EditError(f"dtype must be 'uint8', 'uint16' or 'float32', not {dtype!r:.40}.")
    edit = Edit() if edit is None else edit
    scene = scene.corrected(edit)
    own = (scene.photo.pixels.shape[1], scene.photo.pixels.shape[0])
    width, height = size = own if size is None else checked_size(size)
    count = math.ceil(height / max(1, math.ceil(width * height / _BAND_PIXELS)))
    graph = on_gl_thread(lambda context: _renderer(context).graph(scene, size))
    for top in range(0, height, count):
        rows = slice(top, min(top + count, height))
        task = functools.partial(draw_rows, graph, scene, edit, size, dtype, rows)
        yield rows, on_gl_thread(lambda _, task=task: task())  # type: ignore[misc]
        if progress is not None:
            progress(rows.stop / height, "rendering")


def draw_rows(
    graph: FrameGraph,
    scene: Scene,
    edit: Edit,
    size: tuple[int, int],
    dtype: str,
    rows: slice | None = None,
) -> npt.NDArray[Any]:
    """Draw some rows of the picture, all of them by default, on the GL thread."""
    width, height = size
    first, last, _ = (rows or slice(None)).indices(height)
    values = states(edit, scene.automatic)
    band = (0, first, width, last - first)
    host = _host_values(size, dtype)
    target = graph.run(values, _scene_values(scene), host, band, (edit.method,))
    # Read as float and quantise here: the driver's own rounding differs between hosts.
    data = np.frombuffer(target.framebuffer.read(components=3, dtype="f4"), np.float32)
    pixels = data.reshape(last - first, width, 3)
    if dtype == "float32":
        return pixels
    scale, kind = _OUTPUT[dtype]
    return np.clip(pixels * scale + 0.5, 0, scale).astype(kind)


def render_pass(
    scene: Scene, edit: Edit, name: str, size: tuple[int, int] | None = None
) -> npt.NDArray[np.float32]:
    """Return what one pass of the frame graph draws, (h, w, 4) float32: for tests and lessons."""
    scene = scene.corrected(edit)
    own = (scene.photo.pixels.shape[1], scene.photo.pixels.shape[0])
    size = own if size is None else checked_size(size)

    def task(context: moderngl.Context) -> npt.NDArray[np.float32]:
        graph = _renderer(context).graph(scene, size)
        target = graph.run(
            states(edit, scene.automatic),
            _scene_values(scene),
            _host_values(size, "float32"),
            (0, 0, *size),
            (edit.method,),
            until=name,
        )
        width, height = target.texture.size
        data = np.frombuffer(target.texture.read(), np.float32)
        return data.reshape(height, width, 4).copy()

    return on_gl_thread(task)


def checked_size(size: Any) -> tuple[int, int]:
    """Return ``size`` as (width, height) in whole pixels, at least one; else raise EditError."""
    try:
        width, height = (operator.index(n) for n in size)
    except (TypeError, ValueError):
        width = height = 0
    if width < 1 or height < 1:
        raise EditError(f"size must be (width, height) in whole pixels, not {size!r:.40}.")
    return width, height


def _scene_values(scene: Scene) -> dict[str, Any]:
    uniforms = scene.uniforms()
    return {name: uniforms[name] for name in frame_graph()["scene_uniforms"]}


def _host_values(size: tuple[int, int], dtype: str) -> dict[str, Any]:
    return {
        "frame_size": (float(size[0]), float(size[1])),
        "canvas_flip": 0.0,
        "output_transfer": 0 if dtype == "float32" else 1,
        "dither": {"uint8": 0.5, "uint16": 0.5 / 257, "float32": 0.0}[dtype],
    }


__all__ = [
    "METHODS",
    "checked_size",
    "quantise_map",
    "render",
    "render_pass",
    "scene_textures",
    "strips_of",
]
