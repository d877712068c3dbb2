"""The reference sky against measured skies and other models: rows 3 and 4 of atmosphere.md.

Kider et al. 2014: 15 scans of 81 directions on one clear day, 360-720 nm, cleaned as Bruneton 2017
did. The data belong to others and are not part of the project: without them, skipped.
"""

import numpy as np
import pytest

from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.validation import bruneton2017, measurements, report

pytestmark = pytest.mark.shared


@pytest.fixture(scope="module")
def folder(shared):
    folder = shared / "data" / "sky-reference"
    if not (folder / bruneton2017.EVALUATION).is_file() or not measurements.is_available(folder):
        pytest.skip(f"no measured skies in {folder}")
    return folder


@pytest.fixture(scope="module")
def day(folder):
    """The day as Bruneton cleaned it, and what other models say of it."""
    return bruneton2017.Evaluation(folder)


@pytest.fixture(scope="module")
def data(folder):
    """The same day as we clean it."""
    return measurements.load(folder)


def missed(rows):
    return [row for row in rows if not row.met]


def test_reading_is_right_for_other_models_have_their_published_error(day):
    assert day.rmse(day.model("elek")) == pytest.approx(11.34, abs=0.02)
    assert day.rmse(day.model("nishita93")) == pytest.approx(26.49, abs=0.02)


def test_error_level_and_pattern_against_measured_skies_are_those_of_the_best_models(data):
    rows = list(report.measured_radiance(data))
    assert len(rows) == 5
    assert missed(rows) == []


def test_other_models_skies_are_met(folder):
    rows = list(report.other_models(folder))
    assert len(rows) == 3
    assert missed(rows) == []


def test_over_grass_and_under_their_sun_the_error_is_hardly_another(day):
    # Their spectra of sun and grass instead of ours, which counts for less than 1.
    assert day.rmse(day.ours(Atmosphere())) == pytest.approx(11.9, abs=0.3)


def test_our_cleaning_is_brunetons(day, data):
    """Samples, the mended north, the sun's place: all from the raw scans."""
    measured = data.at(measurements.COMPARED_WAVELENGTHS)
    worst = 0.0
    for i, scan in enumerate(np.unique(day.scan)):
        of = day.scan == scan
        ours = np.round(data.elevation, 1) * 1000 + np.round(data.azimuth)
        # His azimuths lie between -180 and 180°, printed with six digits.
        vz, va = day.elevation[of], (day.azimuth[of] + day.suns_azimuth[of]) % 360
        theirs = np.round(vz, 1) * 1000 + np.round(va) % 360
        order = [int(np.flatnonzero(ours == key)[0]) for key in theirs]
        assert sorted(order) == list(range(81))
        assert measured[i][order] == pytest.approx(day.measured[of], rel=2e-5)
        # Angle between the sun's two places. Both are read off the sky's symmetry, which one may
        # do in more than one way: up to 1° apart, within a beam of the instrument (1°).
        high, low = np.radians([data.sun_elevation[i], day.sun[of][0]])
        turn = np.radians(data.sun_azimuth[i] - day.suns_azimuth[of][0])
        cosine = np.sin(high) * np.sin(low) + np.cos(high) * np.cos(low) * np.cos(turn)
        worst = max(worst, float(np.degrees(np.arccos(cosine))))
    assert worst < 1.1
