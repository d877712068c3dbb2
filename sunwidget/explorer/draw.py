"""SkyExplorer's picture and curves, drawn by the kernel with the browser's passes.

``frame-graph.md`` describes the passes; ``js/src/explorer/sky_frame.js`` is the twin.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from sunwidget.errors import EditError
from sunwidget.explorer.projection import Projection
from sunwidget.explorer.values import effective_values
from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.graph import FrameGraph, Programs, Target, largest_texture
from sunwidget.renderer.offscreen import checked_size
from sunwidget.renderer.shader_source import frame_graph

Floats = npt.NDArray[np.float32]

CURVES = (
    "curve_phase",
    "curve_transmittance",
    "curve_sun",
    "curve_principal_plane",
    "curve_zenith",
)
"""Names of the curves that ``curve`` returns."""
BACKGROUND = (20, 22, 27)
"""Code values around the dome and the panorama."""

# Pictures are drawn in bands of about this many pixels, which bounds memory at any size.
_BAND_PIXELS = 2_100_000
_graphs: dict[int, FrameGraph] = {}
_tables: dict[tuple[int, str], Any] = {}


def draw(
    values: Mapping[str, Any],
    size: tuple[int, int],
    *,
    bruneton: Floats | None = None,
    samples: int = 64,
    progress: Callable[[float, str], Any] | None = None,
) -> npt.NDArray[np.uint8]:
    """Draw the sky.

    Parameters
    ----------
    values : mapping
        Every parameter of ``EXPLORER_PARAMETERS`` by name.
    size : (width, height)
        In pixels.
    bruneton : array, shape (rows, columns, 4), float32, optional
        Slice of Bruneton's table for the altitude; required if ``model`` or ``compare`` is
        ``"bruneton"``.
    samples : int, default 64
        Paths per pixel of the ``"reference"``.
    progress : callable, optional
        Called with (fraction, message) after each sample and band; raise in it to cancel.

    Returns
    -------
    array, (height, width, 3), uint8
        sRGB, with ``BACKGROUND`` around the dome and the panorama.

    Raises
    ------
    EditError
        For an invalid size, and for Bruneton's model without its table.
    RendererError
        When this machine has no EGL.
    """
    size = checked_size(size)
    host = {"output_transfer": 1, "dither": 0.5}
    texels = _run(values, size, host, None, {"bruneton": bruneton}, samples, progress)
    around = np.array(BACKGROUND, np.float32) / 255
    color = texels[..., :3] + (1 - texels[..., 3:]) * around
    return np.clip(color * 255 + 0.5, 0, 255).astype(np.uint8)


def radiance_map(
    values: Mapping[str, Any],
    size: tuple[int, int],
    *,
    bruneton: Floats | None = None,
    samples: int = 64,
) -> Floats:
    """Return the spectral radiance of the sky that ``draw`` shows, without the sun's disc.

    Returns
    -------
    array, (height, width, 4), float32
        W m⁻² sr⁻¹ nm⁻¹ at 640, 580, 510 and 440 nm; NaN where no sky is shown.
    """
    size = checked_size(size)
    host = {"output_transfer": 0, "dither": 0.0}
    texels = _run(values, size, host, None, {"bruneton": bruneton}, samples, None)
    x, y = np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
    texels[np.isnan(projection(values, size).direction(x, y)[..., 0])] = np.nan
    return texels


def curve(values: Mapping[str, Any], name: str, *, bruneton: Floats | None = None) -> Floats:
    """Return one of ``CURVES``, (N, 4) float32; ``frame-graph.md`` describes it.

    Raises
    ------
    EditError
        For an unknown curve.
    """
    if name not in CURVES:
        raise EditError(f"There is no curve {name!r:.60}; choose among {', '.join(CURVES)}.")
    return table(values, name, bruneton=bruneton)[0]


def radiance_at(
    values: Mapping[str, Any], directions: npt.ArrayLike, *, bruneton: Floats | None = None
) -> Floats:
    """Return the radiance by ``model`` in ``directions`` (N, 2): azimuth, elevation in degrees.

    Returns
    -------
    array, (N, 4), float32
        W m⁻² sr⁻¹ nm⁻¹ at 640, 580, 510 and 440 nm.
    """
    angles = np.asarray(directions, np.float32)
    listed = np.zeros((1, len(angles), 4), np.float32)
    listed[0, :, :2] = angles
    textures = {"bruneton": bruneton, "directions": listed}
    return _run(values, (1, 1), {}, "curve_directions", textures)[0]


def table(values: Mapping[str, Any], name: str, *, bruneton: Floats | None = None) -> Floats:
    """Return the output of a pass of the explorer's graph, (rows, columns, 4) float32."""
    return _run(values, (1, 1), {}, name, {"bruneton": bruneton})


def projection(values: Mapping[str, Any], size: tuple[int, int]) -> Projection:
    """Return the projection of ``values``."""
    name = values["projection"]
    view = {key: float(values[key]) for key in ("view_azimuth", "view_elevation", "fov")}
    return Projection(name=name, size=size, **view)


def methods(values: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the methods of a run, as named in the rows' ``when``: models, and single terms."""
    orders = () if values["show_single"] and values["show_multiple"] else ("orders",)
    return (values["model"], values["compare"], *orders)


def _run(
    values: Mapping[str, Any],
    size: tuple[int, int],
    host: Mapping[str, Any],
    until: str | None,
    textures: Mapping[str, Floats | None],
    samples: int = 1,
    progress: Callable[[float, str], Any] | None = None,
) -> Floats:
    # The compared model appears only in the picture, on its right half.
    asked = methods(values if until is None else {**values, "compare": "none"})
    if "bruneton" in asked and textures.get("bruneton") is None:
        raise EditError(
            "Bruneton's model needs its table: pass bruneton=bruneton_table(atmosphere)"
            ".slice(altitude) from sunwidget.renderer.bruneton.precomputed_sky."
        )
    states = effective_values(values)
    host = {"frame_size": (float(size[0]), float(size[1])), "canvas_flip": 0.0, **host}
    columns, rows = (int(n) for n in values["grid"].split("×"))
    sizes = {"grid": (columns, rows), "shown": (2 * columns, rows)}
    directions = textures.get("directions")
    if directions is not None:
        sizes["directions"] = (directions.shape[1], 1)

    def task(context: Any) -> Floats:
        if size[0] > (limit := largest_texture(context)):
            raise EditError(f"A picture of the sky is at most {limit} pixels wide, not {size[0]}.")
        graph = _graph(context, textures)

        def run(name: str | None, tile: tuple[int, int, int, int]) -> Target:
            return graph.run(states, {}, host, tile, asked, name, sizes)

        if until is not None:
            return _texels(run(until, (0, 0, *size)))
        width, height = size
        bands = []
        rows = max(1, _BAND_PIXELS // width)
        for top in range(0, height, rows):
            tile = (0, top, width, min(rows, height - top))
            if "reference" in asked:
                graph.targets.pop("reference", None)  # restart the accumulation
                for i in range(samples - 1):
                    run("reference", tile)
                    if progress is not None:
                        progress((top + tile[3] * (i + 1) / samples) / height, "tracing paths")
            bands.append(_texels(run(None, tile)))
            if progress is not None:
                progress((top + tile[3]) / height, "drawing")
        return np.concatenate(bands)

    return on_gl_thread(task)


def _texels(target: Target) -> Floats:
    width, height = target.texture.size
    return np.frombuffer(target.texture.read(), np.float32).reshape(height, width, 4).copy()


def _graph(context: Any, textures: Mapping[str, Floats | None]) -> FrameGraph:
    """Return the context's one graph with ``textures`` uploaded; runs on the GL thread."""
    if id(context) not in _graphs:
        _graphs.clear()  # drop those of a lost context
        _tables.clear()
        _graphs[id(context)] = FrameGraph(Programs(context), {}, frame_graph("explorer"))
    graph = _graphs[id(context)]
    for name, image in textures.items():
        key = (id(context), name)
        if image is not None and _tables.get(key) is not image:
            graph.set_texture(name, np.asarray(image, np.float32))
            _tables[key] = image  # keeps it alive, so that its id is not reused
    return graph
