"""Run the shaders that precompute the sky (``precomputed_sky.py``), a band of rows at a time."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.progress import Progress
from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.graph import Programs

if TYPE_CHECKING:
    from collections.abc import Mapping

    import moderngl
    from numpy.typing import NDArray

    Floats = NDArray[np.float32]


PASSES = (
    "bruneton/first",
    "bruneton/incident",
    "bruneton/irradiance",
    "bruneton/source",
    "bruneton/table",
)
"""Shaders that only this module runs; ``bruneton_view`` is a pass of the explorer's graph."""

ALL_ORDERS = 8
"""Orders that "all orders" needs in clear air; white haze over snow needs 24."""

_MOST_ORDERS = 24
_LAST_SHARE = 0.003  # of the light: the most that a geometric series may replace
_DIRECTIONS = (16, 16)  # zeniths and azimuths of the quadrature, as in bruneton/field.glsl
_BAND_SECONDS = 0.15
_FIRST_BAND_TEXELS = 2048


@dataclass(frozen=True)
class Size:
    """Sample counts: the table's r, mu, mu_s, nu; and the source's r, mu_s, theta, phi."""

    table: tuple[int, int, int, int]
    field: tuple[int, int, int, int]

    @property
    def atlas(self) -> tuple[int, int]:
        """Width and height of one table as a texture."""
        r, mu, mu_s, nu = self.table
        return mu * nu, r * mu_s

    def texels(self) -> dict[str, int]:
        """Return the texels of each pass, per order for passes that are repeated."""
        r, mu_s, theta, phi = self.field
        incident = r * mu_s * math.prod(_DIRECTIONS)
        return {
            "bruneton/first": incident,
            "bruneton/incident": incident,
            "bruneton/source": 2 * r * mu_s * theta * phi,
            "bruneton/table": math.prod(self.table),
        }


SIZES: dict[str, Size] = {
    "small": Size((16, 64, 40, 12), (16, 40, 17, 9)),
    "full": Size((32, 64, 40, 12), (24, 40, 33, 17)),
    # For tests: coarse enough to take a second.
    "tiny": Size((9, 32, 24, 8), (9, 24, 13, 7)),
}


class Precomputation:
    """Draw the passes in bands, so that other tasks of the GL thread wait for one band only."""

    def __init__(
        self, atmosphere: Atmosphere, orders: int, size: Size, progress: Progress | None
    ) -> None:
        self.size = size
        self.orders = orders or ALL_ORDERS
        self.all = orders == 0
        self.progress = progress
        self.values: dict[str, Any] = {
            **atmosphere.parameters(),
            "field_size": size.field,
            "table_size": size.table,
            "tile_origin": (0.0, 0.0),
        }
        self.textures: dict[str, moderngl.Texture] = {}
        cost = size.texels()
        # Relative cost of one texel of each pass, used only for the progress.
        more = self.orders - 1
        self.todo_before_tables = 3.0 * (cost["bruneton/first"] + more * cost["bruneton/source"])
        self.todo_before_tables += 10.0 * max(more - 1, 0) * cost["bruneton/incident"]
        self.todo = self.todo_before_tables + 16.0 * cost["bruneton/table"]
        self.done = 0.0

    def run(self) -> Floats:
        """Return the three tables, (3, r, mu_s, mu, nu, 4); free all intermediate textures."""
        try:
            return self._run()
        finally:
            on_gl_thread(lambda _: self.textures.clear())

    def _run(self) -> Floats:
        r, mu_s, theta, phi = self.size.field
        zeniths, azimuths = _DIRECTIONS
        directions = (mu_s * azimuths, r * zeniths)
        source_size, irradiance_size = (mu_s * phi, 2 * r * theta), (mu_s, 1)
        self._draw("atmosphere/columns", "columns", (256, 64), 0.0)
        self._draw("bruneton/first", "incident", directions, 3.0)
        sources, irradiances = [], []
        for order in range(2, (_MOST_ORDERS if self.all else self.orders) + 1):
            message = f"scattering, order {order}"
            self._draw("bruneton/irradiance", "irradiance", irradiance_size, 0.0, message)
            self._draw("bruneton/source", "source", source_size, 3.0, message)
            irradiances.append(self._read("irradiance"))
            sources.append(self._read("source"))
            if self._is_last(order, sources):
                break
            self._draw("bruneton/incident", "incident", directions, 10.0, message)
        self.done = self.todo_before_tables
        self.upload("source", self._sum(sources, source_size))
        self.upload("irradiance", self._sum(irradiances, irradiance_size))
        tables = []
        for part, message in enumerate(("single scattering", "haze", "all orders")):
            weight = 10.0 if part == 2 else 3.0
            self._draw("bruneton/table", "table", self.size.atlas, weight, message, part=part)
            tables.append(self._read("table"))
        r, mu, mu_s, nu = self.size.table
        return np.stack(tables).reshape(3, r, mu_s, mu, nu, 4)

    def _is_last(self, order: int, sources: list[Floats]) -> bool:
        """Return whether ``order`` is the last requested, or the rest is small enough."""
        if not self.all:
            return order >= self.orders
        if order < 4:
            return False
        rest = _rest_of_series(sources) / np.maximum(np.sum(sources, axis=0), 1e-30)
        return bool(rest.mean(axis=(0, 1)).max() < _LAST_SHARE)

    def _sum(self, orders: list[Floats], size: tuple[int, int]) -> Floats:
        """Return the sum of the orders, plus the rest of the series if all are requested."""
        if not orders:
            return np.zeros((size[1], size[0], 4), np.float32)
        total = np.sum(orders, axis=0)
        return np.asarray(total + _rest_of_series(orders) if self.all else total, np.float32)

    def _draw(
        self,
        shader: str,
        name: str,
        size: tuple[int, int],
        weight: float,
        message: str = "scattering, first order",
        **values: Any,
    ) -> None:
        """Draw one pass into the texture ``name``, one band of rows per task of the GL thread."""
        width, height = size
        values = {**self.values, **values, "pass_size": (float(width), float(height))}

        def prepare(context: moderngl.Context) -> moderngl.Framebuffer:
            texture = self.textures.get(name)
            if texture is None or texture.size != size:
                self.textures[name] = texture = context.texture(size, 4, dtype="f4")
            return context.framebuffer([texture])

        framebuffer = on_gl_thread(prepare)
        # With more orders than expected the progress stands still; with fewer it jumps.
        limit = self.todo if shader == "bruneton/table" else self.todo_before_tables
        top, rows = 0, max(1, _FIRST_BAND_TEXELS // width)
        while top < height:
            band = (0, top, width, min(rows, height - top))
            task = partial(_draw_band, shader, framebuffer, band, values, self.textures)
            seconds = on_gl_thread(task)
            top += band[3]
            self.done = min(self.done + weight * width * band[3], limit)
            if self.progress is not None:
                self.progress(self.done / self.todo, message)
            rows = max(1, min(4 * rows, int(rows * _BAND_SECONDS / max(seconds, 1e-4))))

    def _read(self, name: str) -> Floats:
        def task(_: moderngl.Context) -> Floats:
            width, height = self.textures[name].size
            data = np.frombuffer(self.textures[name].read(), np.float32)
            return data.reshape(height, width, 4).copy()

        return on_gl_thread(task)

    def upload(self, name: str, image: Floats) -> None:
        """Upload ``image`` (h, w, 4) into the texture ``name``."""

        def task(context: moderngl.Context) -> None:
            height, width, _ = image.shape
            self.textures[name] = context.texture((width, height), 4, image.tobytes(), dtype="f4")

        on_gl_thread(task)


def _rest_of_series(orders: list[Floats]) -> Floats:
    """Return the sum of all later orders, a geometric series by the ratio of the last two."""
    last, before = orders[-1], orders[-2]
    ratio = np.clip(last / np.maximum(before, 1e-30), 0, 0.95)
    return np.asarray(last * ratio / (1 - ratio), np.float32)


def _draw_band(
    shader: str,
    framebuffer: moderngl.Framebuffer,
    band: tuple[int, int, int, int],
    values: Mapping[str, Any],
    textures: Mapping[str, moderngl.Texture],
    context: moderngl.Context,
) -> float:
    """Draw the rows of ``band`` and return the seconds it took."""
    programs = _programs(context)
    programs.get(shader)
    framebuffer.scissor = band
    framebuffer.use()
    unit = 0
    for uniform, member in programs.uniforms[shader].items():
        if uniform in textures:
            textures[uniform].use(unit)
            member.value = unit
            unit += 1
        else:
            member.value = values[uniform]
    start = time.perf_counter()
    programs.arrays[shader].render(vertices=3)
    context.finish()
    return time.perf_counter() - start


_compiled: dict[int, Programs] = {}


def _programs(context: moderngl.Context) -> Programs:
    if id(context) not in _compiled:
        _compiled[id(context)] = Programs(context)
    return _compiled[id(context)]


_measured: dict[str, float] = {}


def measured_rates() -> dict[str, float]:
    """Return seconds per texel to march single scattering, gather the source, and make it."""
    if not _measured:
        size = SIZES["small"]
        work = Precomputation(Atmosphere(), 2, size, None)
        width, _ = size.atlas
        r, mu_s, theta, phi = size.field
        shapes = {"source": (mu_s * phi, 2 * r * theta), "irradiance": (mu_s, 1)}
        shapes |= {"incident": (mu_s * 16, r * 16), "columns": (256, 64), "target": size.atlas}
        for name, (columns, rows) in shapes.items():
            work.upload(name, np.ones((rows, columns, 4), np.float32))

        def task(context: moderngl.Context) -> None:
            framebuffer = context.framebuffer([work.textures["target"]])
            bound = {name: work.textures[name] for name in shapes if name != "target"}
            for kind, shader, part in (
                ("single", "bruneton/table", 0),
                ("gather", "bruneton/table", 2),
                ("source", "bruneton/source", 0),
            ):
                values = {**work.values, "part": part}
                # The first draw compiles.
                for rows in (1, 8):
                    band = (0, 0, width, rows)
                    seconds = _draw_band(shader, framebuffer, band, values, bound, context)
                _measured[kind] = seconds / (width * 8)

        on_gl_thread(task)
        on_gl_thread(lambda _: work.textures.clear())
    return _measured
