"""Bruneton's evaluation of clear sky models: the measured day and other models' skies.

Bruneton, "A Qualitative and Quantitative Evaluation of 8 Clear Sky Models" (2017). His code writes
the files, which are not part of sunwidget.
"""

from __future__ import annotations

import csv
import functools
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.atmosphere.constants import solar_irradiance
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.sky import SkyTable

Array = NDArray[np.float64]

EVALUATION = "kider2014_clear_sky_models_40bins.csv"


class Evaluation:
    """Bruneton's evaluation of clear sky models: the measured day and other models' skies.

    Parameters
    ----------
    folder : path
        With ``kider2014_clear_sky_models_40bins.csv``, ``csm_model_outputs/`` and
        ``clear_sky_models_input_spectra_40bins.csv``, as written by his code.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        table = _rows(folder / EVALUATION)
        self.scan = np.array([row[0] for row in table])
        values = _numbers(table, 1)
        spectra = _numbers(_rows(folder / "clear_sky_models_input_spectra_40bins.csv"))
        self._visible = spectra[:, 0] <= 720
        self.nm, solar, self.albedo = spectra[self._visible][:, [0, 1, 5]].T
        self._solar = solar / solar_irradiance(self.nm)
        self.sun, self.suns_azimuth = 90 - values[:, 0], values[:, 1]
        self.azimuth = values[:, 5] - self.suns_azimuth
        self.elevation = 90 - values[:, 4]
        self.measured = values[:, 6:][:, self._visible]

    @functools.cache  # noqa: B019 - two models, cached while the program runs
    def model(self, name: str) -> Array:
        """Return another model's sky, shape (15 · 81, 31)."""
        path = self._folder / "csm_model_outputs" / f"dump_{name}.csv"
        return _numbers(_rows(path), 1)[:, 6:][:, self._visible]

    def ours(self, air: Atmosphere, orders: int = 0) -> Array:
        """Return our sky over grass of their spectral albedo; radiance is almost linear in it."""
        dark, bright = (
            self._over(air.replace(ground_albedo=albedo), orders) for albedo in (0.0, 0.1)
        )
        share = self.albedo / 0.1
        return dark * (1 - share) + bright * share

    def per_scan(self, figure: Callable[[Any], float]) -> Array:
        """Return ``figure(rows)`` for the mask of the rows of each scan."""
        return np.array([figure(self.scan == scan) for scan in np.unique(self.scan)])

    def rmse(self, sky: Array) -> float:
        """Return the quadratic mean over scans, mW m⁻² sr⁻¹ nm⁻¹."""
        error = (sky - self.measured) * 1000
        return float(np.sqrt(np.mean(self.per_scan(lambda of: np.mean(error[of] ** 2)))))

    def _over(self, air: Atmosphere, orders: int) -> Array:
        table = SkyTable(air, self.nm, orders=orders)
        sky = np.zeros_like(self.measured)
        for scan in np.unique(self.scan):
            of = self.scan == scan
            sky[of] = table.radiance(self.elevation[of], self.azimuth[of], self.sun[of][0])
        return sky * self._solar


def _rows(path: Path) -> list[list[str]]:
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.reader(file))[1:]


def _numbers(table: list[list[str]], first: int = 0) -> Array:
    return np.array([[float(value) for value in row[first:]] for row in table])
