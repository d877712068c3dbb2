"""The actions that SkyExplorer's browser side can request; ``requests.py`` routes them here."""

from __future__ import annotations

from collections.abc import Mapping
from time import perf_counter
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.explorer import table
from sunwidget.explorer.values import effective_values
from sunwidget.formats.png import encode_png
from sunwidget.progress import Progress
from sunwidget.validation import measurements
from sunwidget.widgets.kernel.requests import Action, Answer

if TYPE_CHECKING:
    from numpy.typing import NDArray

_SNAPSHOT_SIZE = (960, 640)
_LARGEST_SNAPSHOT = 4096


class Explorer(Protocol):
    """The part of SkyExplorer that the actions use."""

    def parameters(self) -> dict[str, Any]:
        """Return the values of all parameters by name."""

    def compare_measured(
        self, models: Any, scan: int | None, progress: Progress | None
    ) -> list[dict[str, Any]]:
        """Return the errors of models against one measured sky, or against all."""

    def code(self) -> str:
        """Return Python code that creates this explorer."""

    def refresh_scans(self) -> None:
        """Send the browser the list of measured skies again."""

    def render(self, size: tuple[int, int], *, progress: Progress | None) -> NDArray[np.uint8]:
        """Draw the sky at a size (width, height)."""


def actions(explorer: Explorer) -> dict[str, Action]:
    """Return the actions that the browser can request, by name."""

    def values(content: dict[str, Any]) -> dict[str, float]:
        """Return the uniforms of the traits, overridden by the request's parameters."""
        changes = content.get("parameters") or {}
        chosen = {name: table.checked(table.parameter(name), v) for name, v in changes.items()}
        return effective_values({**explorer.parameters(), **chosen})["edit"]

    def bruneton(content: dict[str, Any], progress: Progress) -> Answer:
        begin = perf_counter()
        texture = np.ascontiguousarray(bruneton_slice(values(content), progress), np.float32)
        rows, columns = texture.shape[:2]
        seconds = perf_counter() - begin
        return {"rows": rows, "cols": columns, "seconds": seconds}, [texture.tobytes()]

    def bruneton_cost(content: dict[str, Any], _progress: Progress) -> Answer:
        from sunwidget.renderer.bruneton import precomputed_sky as bruneton

        air, orders = _air_and_orders(values(content))
        cached = bruneton.is_cached(air, orders)
        seconds = 0.0 if cached else bruneton.bruneton_cost(orders=orders)
        return {"cached": cached, "seconds": seconds}, []

    def rmse(content: dict[str, Any], progress: Progress) -> Answer:
        from sunwidget.errors import RendererError

        measurements.load()  # fails before the table is computed if there are no measurements
        models, scan = content.get("models"), content.get("scan")
        try:
            rows = explorer.compare_measured(tuple(models or table.MODELS), scan, progress)
        except RendererError:
            if models:
                raise
            # Bruneton's table needs EGL; the other models do not.
            rest = tuple(name for name in table.MODELS if name != "bruneton")
            rows = explorer.compare_measured(rest, scan, progress)
        return {"rows": rows}, []

    def code(_content: dict[str, Any], _progress: Progress) -> Answer:
        return {"code": explorer.code()}, []

    def download(_content: dict[str, Any], progress: Progress) -> Answer:
        measurements.download(progress=progress)
        explorer.refresh_scans()
        return {"scans": scans()}, []

    def snapshot(content: dict[str, Any], progress: Progress) -> Answer:
        width, height = content.get("size") or _SNAPSHOT_SIZE
        size = _snapshot_edge(width), _snapshot_edge(height)
        picture = explorer.render(size, progress=progress)
        return {"name": "sky.png", "type": "image/png"}, [encode_png(picture)]

    return {
        "bruneton": bruneton,
        "bruneton_cost": bruneton_cost,
        "rmse": rmse,
        "code": code,
        "download_measurements": download,
        "snapshot": snapshot,
    }


def bruneton_slice(
    values: Mapping[str, float], progress: Progress | None = None
) -> NDArray[np.float32]:
    """Return the slice of Bruneton's table for these uniforms; compute the table if needed."""
    from sunwidget.renderer.bruneton.precomputed_sky import bruneton_table

    air, orders = _air_and_orders(values)
    return bruneton_table(air, orders=orders, progress=progress).slice()


def scans() -> list[dict[str, Any]]:
    """Return the measured scans on this machine in the browser's format; [] if there are none."""
    return measurements.load().scans_json() if measurements.is_available() else []


def _air_and_orders(values: Mapping[str, float]) -> tuple[Atmosphere, int]:
    """Return the air and orders on which Bruneton's table depends."""
    air = Atmosphere(**{name: values[name] for name in table.AIR})
    return air, round(values["scattering_orders"])


def _snapshot_edge(pixels: Any) -> int:
    return int(np.clip(pixels, 1, _LARGEST_SNAPSHOT))
