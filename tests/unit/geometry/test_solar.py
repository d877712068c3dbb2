"""Where the sun stands: against NREL's own example, at the poles, and between the rows of a day."""

import datetime as dt
import sys

import numpy as np
import pytest

from sunwidget.atmosphere.sun import true_elevation
from sunwidget.geometry.solar import apparent_elevation, day_path, solar_position, sun_on_path

pytest.importorskip("pvlib")

ITHACA = (42.443449, -76.481962)


def test_nrels_own_example_is_met():
    # Reda & Andreas 2004, appendix A.5: zenith 50.11162°, azimuth 194.34024° at 820 hPa, 11 °C.
    # Without its refraction (their eq. 42) the zenith distance is 50.12795°. The algorithm is
    # good to 0.0003°; here the same algorithm is run, so that the last digit printed decides.
    # The observer's 1830 m move the sun by 9" · 1.8 km / 6378 km, a millionth of a degree.
    lift = (
        820 / 1010 * 283 / (273 + 11) * 1.02 / (60 * np.tan(np.radians(39.872046 + 10.3 / 44.98)))
    )
    sun = solar_position("2003-10-17T12:30:30-07:00", 39.742476, -105.1786)
    assert sun.true_elevation == pytest.approx(90 - 50.11162 - lift, abs=2e-5)
    assert sun.azimuth == pytest.approx(194.34024, abs=2e-5)
    # Bennett, at sea level's pressure, lifts a little more than their 820 hPa do.
    assert lift < sun.apparent_elevation - sun.true_elevation < 1.3 * lift


def test_zones_are_understood_and_a_bare_time_is_utc():
    local = solar_position("2024-06-21T08:00-04:00", *ITHACA)
    assert solar_position(np.datetime64("2024-06-21T12:00"), *ITHACA) == local
    assert solar_position("2024-06-21T12:00", *ITHACA) == local
    several = solar_position(["2024-06-21T12:00", "2024-06-21T18:00Z"], *ITHACA)
    assert several.azimuth.shape == (2,)
    assert several.azimuth[0] == local.azimuth


def test_apparent_elevation_undoes_true_elevation_where_the_sun_is_seen():
    apparent = np.linspace(-1, 90, 500)
    assert apparent_elevation(true_elevation(apparent)) == pytest.approx(apparent, abs=1e-9)


def test_the_lift_fades_without_a_jump_and_is_none_in_twilight():
    true = np.linspace(-12, 3, 3001)
    apparent = apparent_elevation(true)
    # Steps of 0.005°: the sun never turns back, and never jumps.
    assert np.diff(apparent).min() > 0
    assert np.diff(apparent).max() < 0.01
    assert np.array_equal(apparent[true <= -6], true[true <= -6])


def test_a_day_has_a_row_every_five_minutes_from_0_to_24_hours():
    path = day_path("2013-05-27", *ITHACA)
    assert path.shape == (289, 4)
    assert path[[0, -1], 0].tolist() == [0, 24]
    noon = path[path[:, 3].argmax()]
    # Noon at 76.48° W: 12 h + 5.099 h - 2.8 min (equation of time); height 90 - 42.44 + 21.3.
    assert noon[0] == pytest.approx(17.05, abs=5 / 60)
    assert noon[1] == pytest.approx(180, abs=4)
    assert noon[3] == pytest.approx(68.9, abs=0.1)
    assert np.array_equal(day_path(dt.date(2013, 5, 27), *ITHACA), path)


@pytest.mark.parametrize(
    ("date", "place"),
    [
        ("2013-05-27", ITHACA),
        ("2024-06-21", (70.0, 25.0)),  # midnight sun: the azimuth goes through north
        ("2024-03-20", (0.0, 0.0)),  # equator at the equinox: the sun passes the zenith
        ("2024-12-21", (-89.9, 0.0)),
    ],
)
def test_between_two_rows_the_sun_is_where_it_truly_is(date, place):
    path = day_path(date, *place)
    rng = np.random.default_rng(1)
    hours = np.append(rng.uniform(0, 24, 40), path[:, 0][path[:, 3].argmax()] + 2.5 / 60)
    midnight = np.datetime64(date)
    truth = solar_position(
        [midnight + np.timedelta64(round(h * 3.6e6), "ms") for h in hours], *place
    )
    for i, hour in enumerate(hours):
        azimuth, elevation = np.radians(sun_on_path(path, hour))
        a, e = np.radians([truth.azimuth[i], truth.apparent_elevation[i]])
        cosine = np.sin(e) * np.sin(elevation)
        cosine += np.cos(e) * np.cos(elevation) * np.cos(a - azimuth)
        # The sun's own radius is 0.27°. The bend of refraction near the horizon, 0.05° at most
        # within a step, is what a mix of two rows leaves out.
        assert np.degrees(np.arccos(min(cosine, 1))) < 0.03, hour


def test_midnight_sun_and_polar_night_have_a_path_too():
    summer, winter = (day_path(day, 70.0, 25.0) for day in ("2024-06-21", "2024-12-21"))
    assert summer[:, 2].min() > 0
    assert winter[:, 2].max() < 0
    # All the way round, through north.
    assert np.ptp(summer[:, 1]) > 355
    midnight = summer[summer[:, 3].argmin()]
    assert min(midnight[1], 360 - midnight[1]) < 2


def test_the_ends_of_the_day_can_be_asked_for():
    path = day_path("2013-05-27", *ITHACA)
    for hours, row in ((0, 0), (24, -1)):
        azimuth, elevation = sun_on_path(path, hours)
        assert azimuth % 360 == pytest.approx(path[row, 1])
        assert elevation == pytest.approx(path[row, 2])


@pytest.mark.parametrize("place", [(91, 0), (0, 181), (float("nan"), 0)])
def test_a_place_that_is_not_on_the_globe_is_refused(place):
    with pytest.raises(ValueError, match=r"must be a number from"):
        solar_position("2024-01-01", *place)


def test_without_pvlib_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "pvlib", None)
    with pytest.raises(ImportError, match=r"sunwidget\[solar\]"):
        day_path("2024-01-01", 0, 0)
