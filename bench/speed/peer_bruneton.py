"""Our tables against Bruneton's precomputation of the whole sky.

Both run on the same driver and hold all orders of scattering. Bruneton's table is made once for an
air and then serves any sun and altitude; ours are small enough to be made anew whenever the air
changes, and one of them whenever the sun moves. The peer is
``sunwidget.renderer.bruneton.precomputed_sky``: its shaders are ours, and it iterates a smaller
table than Bruneton's own code does.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.explorer.draw import radiance_at, table
from sunwidget.explorer.table import EXPLORER_PARAMETERS
from sunwidget.renderer.bruneton.precomputed_sky import bruneton_table

from .effort import Effort
from .passes import table_bytes
from .rows import Row, Rows, of_times
from .timing import Times, clock, in_turn, ratio

KEYS = ("Bruneton, first sky", "Bruneton, new sun", "Bruneton, memory")
TABLES = ("columns_edit", "first_order_edit", "first_field_edit", "second_order_edit")
TABLES += ("transfer_edit", "multiple_scattering_edit", "sky_view_edit", "light_edit")


def rows(effort: Effort) -> Rows:
    made = Times([], [])
    with clock(made):
        peer = bruneton_table(Atmosphere(), size=effort.table, cache=False)
    size = f"Bruneton's ({effort.table} table)"
    cut = peer.slice()

    def ours(i: int, **more: Any) -> None:
        table(state(sun_elevation=10 + 0.5 * i, **more), "sky_view")

    def theirs(i: int) -> None:
        table(state(sun_elevation=10 + 0.5 * i, model="bruneton"), "bruneton_view", bruneton=cut)

    fresh, _ = in_turn(
        lambda i: ours(0, aerosol_optical_depth=0.05 + 0.01 * i), lambda _i: None, effort.runs, 1
    )
    yield of_times(
        "Bruneton, first sky",
        f"first sky of new air, beside {size}",
        fresh,
        "s",
        peer=made.median,
        ratio=ratio(fresh, made),
        note=f"radiances differ by {difference(cut):.1%}",
    )
    new, other = in_turn(ours, theirs, effort.runs, effort.runs)
    yield of_times(
        "Bruneton, new sun",
        f"sky of a new sun, beside {size}",
        new,
        "ms",
        peer=1000 * other.median,
        ratio=ratio(new, other),
    )
    own = table_bytes(TABLES) / 1e6
    yield Row(
        "Bruneton, memory",
        f"tables of the sky, beside {size}",
        own,
        "MB",
        peer=peer.tables.nbytes / 1e6,
        ratio=peer.tables.nbytes / 1e6 / own,
        note=f"of Bruneton's, {cut.nbytes / 1e6:.2g} MB lie on the graphics card for one altitude",
    )


def state(**values: Any) -> dict[str, Any]:
    """Every parameter of SkyExplorer."""
    return {p.name: p.default for p in EXPLORER_PARAMETERS} | {"sun_elevation": 20.0} | values


def difference(cut: np.ndarray) -> float:
    """Root mean square of the relative difference of radiance, over sky and suns."""
    elevation, azimuth = np.meshgrid([3.0, 12, 30, 60, 85], np.arange(0, 181, 30.0))
    where = np.stack([azimuth, elevation], axis=-1).reshape(-1, 2)
    found = []
    for sun in (2.0, 20.0, 60.0):
        values = state(sun_elevation=sun, sun_azimuth=0.0)
        theirs = radiance_at({**values, "model": "bruneton"}, where, bruneton=cut)
        found.append(theirs / radiance_at(values, where) - 1)
    return float(np.sqrt(np.mean(np.square(found))))
