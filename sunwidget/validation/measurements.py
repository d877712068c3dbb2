"""Errors of clear-sky models against the measured skies of ``measured_skies``.

The measures follow Bruneton, "A Qualitative and Quantitative Evaluation of 8 Clear Sky Models"
(2017): error of the radiance, level, and pattern of the brightness.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sunwidget.atmosphere.constants import WAVELENGTHS
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.sky import SkyTable
from sunwidget.progress import Progress
from sunwidget.validation.download import MeasurementsError, download
from sunwidget.validation.measured_skies import Measurements, is_available, load
from sunwidget.validation.path_tracer import trace

__all__ = [
    "AIR_OF_THE_DAY",
    "COMPARED_WAVELENGTHS",
    "Comparison",
    "Measurements",
    "MeasurementsError",
    "compare",
    "compare_scans",
    "download",
    "is_available",
    "load",
]

Array = NDArray[np.float64]
Radiance = Callable[[Array, Array, float], Array]

AIR_OF_THE_DAY = Atmosphere(ground_albedo=0.05)
"""``Atmosphere()``, whose aerosol was fitted to this day, over grass. Bruneton 2017's spectral
albedo of grass has a mean of 0.05 from 360 to 720 nm."""

COMPARED_WAVELENGTHS: Array = 360 + 11.75 * np.arange(31.0)
"""The samples of Bruneton 2017 up to 720 nm, for comparison with his figures."""


class Comparison(NamedTuple):
    """Errors of a model against the measured skies.

    ``rmse`` in mW m⁻² sr⁻¹ nm⁻¹ over directions and 360-720 nm, quadratic mean over scans;
    ``level``, the model's mean radiance over the measured one, mean over scans; ``pattern``, the
    rms deviation of the brightness distributions scaled to the same mean, maximum over scans.
    """

    model: str
    rmse: float
    level: float
    pattern: float


def compare(
    models: Sequence[str] = ("single", "multiple"),
    scan: int | None = None,
    atmosphere: Atmosphere | None = None,
    *,
    data: Measurements | None = None,
    others: Mapping[str, Radiance] | None = None,
    paths: int = 30,
    progress: Progress | None = None,
) -> list[Comparison]:
    """Compare models of the sky with the measured radiance, over one scan or all.

    Parameters
    ----------
    models : sequence of str
        ``"single"`` (Nishita 1993), ``"multiple"`` (all orders), ``"reference"`` (path tracing,
        about a second per scan) and names in ``others``.
    scan : int, optional
        Index of one scan. Default: all.
    atmosphere : Atmosphere, optional
        The air. Default: ``AIR_OF_THE_DAY``.
    data : Measurements, optional
        Default: ``load()``.
    others : mapping, optional
        Further models by name: ``radiance(elevation, azimuth from the sun, sun elevation)`` of
        shape (81, 4) at the shaders' four wavelengths. These and path tracing are extended to the
        whole spectrum by their ratio to ``"multiple"``, which varies little.
    paths : int, default 30
        Paths for each direction and wavelength of ``"reference"``. Their noise, a few percent of
        the multiply scattered light, is small compared with the error.
    progress : callable, optional
        ``progress(fraction, message)``; raise in it to cancel.

    Returns
    -------
    list of Comparison
        In the order of ``models``.

    Raises
    ------
    MeasurementsError
        Without data.
    ValueError
        For an unknown model or scan.
    """
    found = compare_scans(
        models,
        scan=scan,
        atmosphere=atmosphere,
        data=data,
        others=others,
        paths=paths,
        progress=progress,
    )
    return [
        Comparison(
            model=model,
            rmse=math.sqrt(statistics.fmean(row.rmse**2 for row in rows)),
            level=statistics.fmean(row.level for row in rows),
            pattern=max(row.pattern for row in rows),
        )
        for model, rows in found.items()
    ]


def compare_scans(
    models: Sequence[str] = ("single", "multiple"),
    scan: int | None = None,
    atmosphere: Atmosphere | None = None,
    *,
    data: Measurements | None = None,
    others: Mapping[str, Radiance] | None = None,
    paths: int = 30,
    progress: Progress | None = None,
) -> dict[str, list[Comparison]]:
    """Compare models like ``compare``, but separately for each scan."""
    data = load() if data is None else data
    air = AIR_OF_THE_DAY if atmosphere is None else atmosphere
    if scan is not None and not 0 <= scan < len(data):
        raise ValueError(f"scan must be from 0 to {len(data) - 1}, not {scan}.")
    chosen = range(len(data)) if scan is None else [scan]
    known = {"single", "multiple", "reference", *(others or {})}
    for model in models:
        if model not in known:
            raise ValueError(f"There is no model {model!r:.80}. Choose among {', '.join(known)}.")
    skies = _Skies(data, air, others or {}, paths)
    measured = data.at(COMPARED_WAVELENGTHS)
    found: dict[str, list[Comparison]] = {model: [] for model in models}
    for k, (model, i) in enumerate((model, i) for model in models for i in chosen):
        if progress:
            progress(k / len(models) / len(chosen), f"Comparing with the measured skies: {model} …")
        found[model].append(_comparison(model, skies.of(model, i), measured[i]))
    return found


class _Skies:
    """The models' skies in the measured directions, each computed once."""

    def __init__(
        self, data: Measurements, air: Atmosphere, others: Mapping[str, Radiance], paths: int
    ) -> None:
        self.data, self.air, self.others, self.paths = data, air, others, paths
        self._kept: dict[tuple[str, int], Array] = {}
        self._tables: dict[tuple[int, int], SkyTable] = {}

    def of(self, model: str, i: int) -> Array:
        """Return a scan's radiance, shape (81, 31)."""
        if (model, i) not in self._kept:
            if model in ("single", "multiple"):
                sky = self._numpy(model, i, COMPARED_WAVELENGTHS)
            else:
                sky = self._carried(model, i)
            self._kept[model, i] = sky
        return self._kept[model, i]

    def _where(self, i: int) -> tuple[Array, Array, float]:
        data = self.data
        return data.elevation, data.azimuth - data.sun_azimuth[i], float(data.sun_elevation[i])

    def _numpy(self, model: str, i: int, nm: Array) -> Array:
        orders = 1 if model == "single" else 0
        if (orders, len(nm)) not in self._tables:
            self._tables[orders, len(nm)] = SkyTable(self.air, nm, orders=orders)
        return self._tables[orders, len(nm)].radiance(*self._where(i))

    def _carried(self, model: str, i: int) -> Array:
        elevation, azimuth, sun = self._where(i)
        if model == "reference":
            e, a = np.radians([elevation, azimuth])
            level = np.cos(e)
            views = np.stack([level * np.sin(a), np.sin(e), level * np.cos(a)], axis=1)
            four = trace(self.air, views, sun, paths=self.paths)[0]
        else:
            four = self.others[model](elevation, azimuth, sun)
        ratio = four / self._numpy("multiple", i, WAVELENGTHS)
        order = np.argsort(WAVELENGTHS)
        spectrum = [
            np.interp(COMPARED_WAVELENGTHS, WAVELENGTHS[order], row[order]) for row in ratio
        ]
        return self.of("multiple", i) * np.array(spectrum)


def _comparison(model: str, sky: Array, measured: Array) -> Comparison:
    ours, theirs = sky.mean(axis=1), measured.mean(axis=1)
    shares = (ours / ours.mean()) / (theirs / theirs.mean())
    return Comparison(
        model=model,
        rmse=1000 * float(np.sqrt(np.mean((sky - measured) ** 2))),
        level=float(ours.mean() / theirs.mean()),
        pattern=float(np.sqrt(np.mean((shares - 1) ** 2))),
    )
