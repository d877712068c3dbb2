"""The reference sky against measured skies and other models: rows 3 and 4 of docs/atmosphere.md.

Kider et al. 2014: 15 scans of 81 directions on one clear day, 360-720 nm, cleaned by Bruneton
2017. The data belong to others and are not part of the project: without them, skipped.
"""

import csv

import numpy as np
import pytest

from sunwidget.atmosphere.constants import solar_irradiance
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.sky import SkyTable

pytestmark = pytest.mark.shared


def rows(path):
    with path.open(newline="") as file:
        return list(csv.reader(file))[1:]


def numbers(table, first=0):
    return np.array([[float(value) for value in row[first:]] for row in table])


class Day:
    """The measured day, what other models say of it, and ours."""

    def __init__(self, folder):
        table = rows(folder / "kider2014_clear_sky_models_40bins.csv")
        self.scan = np.array([row[0] for row in table])
        values = numbers(table, 1)
        spectra = numbers(rows(folder / "clear_sky_models_input_spectra_40bins.csv"))
        self.visible = spectra[:, 0] <= 720
        self.nm, solar, self.albedo = spectra[self.visible][:, [0, 1, 5]].T
        self.solar = solar / solar_irradiance(self.nm)
        self.sun, self.azimuth = 90 - values[:, 0], values[:, 4 + 1] - values[:, 1]
        self.elevation = 90 - values[:, 4]
        self.measured = values[:, 6:][:, self.visible]

        def model(name):
            return numbers(rows(folder / "csm_model_outputs" / f"dump_{name}.csv"), 1)[:, 6:]

        self.bruneton = model("elek")[:, self.visible]
        self.nishita93 = model("nishita93")[:, self.visible]

    def ours(self, air, **kwargs):
        """Over grass, whose albedo their spectrum gives: radiance is all but linear in it."""
        dark, bright = (
            self.over(air.replace(ground_albedo=albedo), **kwargs) for albedo in (0.0, 0.1)
        )
        share = self.albedo / 0.1
        return dark * (1 - share) + bright * share

    def over(self, air, **kwargs):
        table = SkyTable(air, self.nm, **kwargs)
        sky = np.zeros_like(self.measured)
        for scan in np.unique(self.scan):
            of = self.scan == scan
            sky[of] = table.radiance(self.elevation[of], self.azimuth[of], self.sun[of][0])
        return sky * self.solar

    def per_scan(self, figure):
        return np.array([figure(self.scan == scan) for scan in np.unique(self.scan)])

    def rmse(self, sky):
        """Quadratic mean over scans, mW m⁻² sr⁻¹ nm⁻¹."""
        error = (sky - self.measured) * 1000
        return np.sqrt(np.mean(self.per_scan(lambda of: np.mean(error[of] ** 2))))


@pytest.fixture(scope="module")
def day(shared):
    folder = shared / "data" / "sky-reference"
    if not (folder / "kider2014_clear_sky_models_40bins.csv").is_file():
        pytest.skip(f"no measured skies in {folder}")
    return Day(folder)


@pytest.fixture(scope="module")
def sky(day):
    return day.ours(Atmosphere())


def test_reading_is_right_for_other_models_have_their_published_error(day):
    assert day.rmse(day.bruneton) == pytest.approx(11.34, abs=0.02)
    assert day.rmse(day.nishita93) == pytest.approx(26.49, abs=0.02)


def test_error_against_measured_skies_is_that_of_the_best_model(day, sky):
    # Bruneton's own, all orders: 11.3. The data's floor is about 11.
    assert day.rmse(sky) < 13


def test_mean_level_of_every_scan_is_right(day, sky):
    level = day.per_scan(lambda of: sky[of].mean() / day.measured[of].mean())
    assert level.min() > 0.87
    assert level.max() < 1.04


def test_single_scattering_alone_is_not_enough(day):
    assert day.rmse(day.ours(Atmosphere(), multiple_scattering=False)) > 22


def test_all_orders_agree_with_brunetons_code(day):
    # His run has no ozone.
    ratio = day.ours(Atmosphere(ozone=0)) / day.bruneton
    assert np.sqrt(np.mean((ratio - 1) ** 2)) < 0.05


def test_single_scattering_agrees_with_nishitas(day):
    ratio = day.ours(Atmosphere(ozone=0), multiple_scattering=False) / day.nishita93
    assert np.sqrt(np.mean((ratio - 1) ** 2)) < 0.04


def test_pattern_of_every_scan_is_right(day, sky):
    def pattern(of):
        ours, theirs = sky[of].mean(axis=1), day.measured[of].mean(axis=1)
        return np.sqrt(np.mean((ours / ours.mean() / (theirs / theirs.mean()) - 1) ** 2))

    assert day.per_scan(pattern).max() < 0.12
