import datetime as dt

import frames_of_a_camera
import numpy as np
import pytest
from frames_of_a_camera import EXPOSURES, SHAKEN, frame

from sunwidget.analysis.frame_inputs import surface
from sunwidget.edit.table import Edit
from sunwidget.errors import PhotoError
from sunwidget.geometry.place import Place, sun_at
from sunwidget.photo.photo import open_photo
from sunwidget.renderer.offscreen import render
from sunwidget.timelapses.fits import Reading, steady, weighted_median
from sunwidget.timelapses.frames import Clock
from sunwidget.timelapses.scenes import FrameScenes
from sunwidget.timelapses.sun import Sample, middle_direction, track_sun

MOVED = Edit(sun_elevation=4, sun_azimuth=-8)


@pytest.fixture(scope="module")
def film():
    return frames_of_a_camera.film()


def test_all_frames_share_what_does_not_move(film):
    _, scenes, row = film
    assert len(scenes) == len(row) == 7
    for number in (1, 2, 3, 4, 6):
        assert row[number].sky is row[0].sky
        assert row[number].water_map is row[0].water_map
        assert row[number].atmosphere == row[0].atmosphere
        assert np.array_equal(*(surface(scene)[..., 3] for scene in (row[number], row[0])))


def test_a_shaken_frame_takes_the_maps_with_it(film):
    _, scenes, row = film
    offset = scenes.offsets[SHAKEN]
    assert offset.x * 192 == pytest.approx(3, abs=0.4)
    assert offset.y * 192 == pytest.approx(1, abs=0.4)
    assert all(o.x == o.y == 0 for i, o in enumerate(scenes.offsets) if i != SHAKEN)
    moved = np.roll(row[0].sky, (1, 3), axis=(0, 1))[8:-8, 8:-8]
    assert np.abs(row[SHAKEN].sky[8:-8, 8:-8] - moved).mean() < 0.005


def test_unmoved_frames_are_the_frames_to_the_bit(film):
    frames, _, row = film
    for number in (0, 3, SHAKEN):
        assert np.array_equal(render(row[number], Edit()), frames[number])


def test_a_moved_sun_adds_no_flicker(film):
    frames, _, row = film
    sky, land = row[0].sky > 0.98, row[0].sky < 0.02
    still = [0, 1, 2, 3, 4, 6]
    out = [render(row[i], MOVED) for i in still]
    assert np.abs(out[0].astype(int) - frames[0]).mean() > 5  # the sun has moved

    def jumps(pictures, where):
        light = np.array([np.log((p[where] / 255.0) ** 2.2 + 1e-3).mean() for p in pictures])
        return np.diff(light, 2).std()

    for where in (sky, land):
        source, moved = jumps([frames[i] for i in still], where), jumps(out, where)
        assert source > 0.05  # the exposure jitters
        # A contrastier picture shows the camera's own jitter by as much more.
        assert moved < 1.25 * source


def test_the_gain_follows_the_exposure_and_is_else_steady(film):
    _, scenes, _ = film
    gain = np.log([fit.gain for fit in scenes.fits])
    rest = gain - np.array(EXPOSURES)[:, None]
    assert gain.std(axis=0).min() > 0.04
    assert rest.std(axis=0).max() < 0.3 * gain.std(axis=0).min()


def test_clouds_do_not_move_the_camera(film):
    for number in (3, 9, 20):
        offset = film.scenes.fixed.offset(open_photo(frame(number, drift=20)))
        assert offset == (0.0, 0.0, True)


def test_a_camera_that_has_moved_is_refused_by_name(film):
    scenes = film.scenes
    away = [*film.frames[:2], frame(3, shift=(24, 0))]
    assert scenes.fixed.offset(open_photo(away[2])).far
    with pytest.raises(PhotoError, match="camera has moved by 1[123]% of the picture at frame 3"):
        FrameScenes.survey(
            away,
            scenes.fixed,
            scenes.track,
            scenes.film,
            Clock(None, 3),
            scenes.size,
            lambda _fraction, _message: None,
        )


def test_exposure_jumps_stay_and_the_rest_is_smoothed():
    rng = np.random.default_rng(0)
    jitter, noise = rng.normal(0, 0.2, 60), rng.normal(0, 0.05, (60, 3))
    readings = [
        Reading(np.array([1.0, 2.0, 3.0]) + j + n, j, 1.0)
        for j, n in zip(jitter, noise, strict=True)
    ]
    gain, exposure = steady(readings, [(10.0, 20.0)] * 60)
    rest = gain - jitter[:, None] - [1.0, 2.0, 3.0]
    assert rest.std() < 0.6 * noise.std()
    assert np.allclose(exposure, jitter)
    readings[7] = None
    assert np.isfinite(
        steady(readings, [None if i == 7 else (10.0, 20.0) for i in range(60)])[0]
    ).all()


def test_nothing_is_smoothed_across_a_jump_of_the_sun():
    readings = [Reading(np.full(3, float(i >= 10)), 0.0, 1.0) for i in range(20)]
    suns = [(0.0, 10.0) if i < 10 else (90.0, 40.0) for i in range(20)]
    assert np.allclose(steady(readings, suns)[0][:, 0], [0.0] * 10 + [1.0] * 10, atol=1e-6)


def test_a_weighted_median_is_that_of_the_weight():
    values = np.array([5.0, 1.0, 3.0, 100.0])
    assert weighted_median(values, np.array([1e-9, 1.0, 1.0, 1.0])) == pytest.approx(3, abs=0.01)
    assert weighted_median(values, np.array([1e-9, 9.0, 1e-9, 1e-9])) == pytest.approx(1, abs=0.01)


PLACE = Place(50.0, 14.0, "2024-06-21", 17.0, 280.0)


def samples(offset):
    """Three samples, an hour apart, whose sun is seen ``offset`` from where the clock has it."""
    found = []
    for i, hours in enumerate((16.0, 17.0, 18.0)):
        sun = sun_at(PLACE.replace(time=hours))
        seen = (sun.azimuth + offset[0], sun.elevation + offset[1])
        moment = PLACE.replace(time=hours).moment
        found.append(Sample(10 * i, None, moment, seen))
    return found


def test_the_clock_tells_every_frames_sun_and_seen_suns_correct_it():
    track = track_sun(samples((1.0, -0.5)), PLACE, None, (0.0, 0.0))
    assert track.source == "clock"
    moment = PLACE.replace(time=17.5).moment
    true = sun_at(PLACE.replace(time=17.5))
    assert track.at(15, moment) == pytest.approx((true.azimuth + 1, true.elevation - 0.5), abs=0.05)
    # A frame whose file tells no time lies between its neighbours.
    assert track.at(15, None) == pytest.approx(track.at(15, moment), abs=0.3)


def test_a_heading_is_found_by_the_suns_that_are_seen():
    track = track_sun(samples((0.0, 0.0)), PLACE.replace(heading=None), None, (0.0, 0.0))
    assert track.place.heading == pytest.approx(280, abs=0.1)


def test_without_a_clock_seen_suns_are_joined_across_north():
    row = [Sample(0, None, None, (170.0, 20.0)), Sample(10, None, None, (-170.0, 10.0))]
    track = track_sun(row, None, None, (0.0, 0.0))
    assert track.source == "seen"
    assert track.at(5, None) == pytest.approx((180.0, 15.0)) or track.at(5, None)[0] == -180
    assert track.at(99, dt.datetime(2024, 1, 1, tzinfo=dt.UTC)) == pytest.approx((-170.0, 10.0))


def test_a_cloud_that_looks_like_a_sun_does_not_lead_the_way():
    sun = [(10.0 + i, 20.0 - i) for i in range(9)]
    row = [Sample(10 * i, None, None, s) for i, s in enumerate(sun)]
    row[4] = row[4]._replace(seen=(-25.0, 12.0))
    track = track_sun(row, None, None, (0.0, 0.0))
    assert track.at(40, None) == pytest.approx((14.0, 16.0), abs=0.01)
    only = [s._replace(seen=None) if i != 4 else s for i, s in enumerate(row)]
    assert track_sun(only, None, None, (3.0, 33.0)).source == "assumed"


def test_the_direction_that_most_agree_on_wins_over_outliers():
    assert middle_direction([(10, 20), (12, 21), (150, 60), (11, 20)], [1, 1, 1, 1])[0] in (
        10,
        11,
        12,
    )
    assert middle_direction([(10, 20), (150, 60)], [0.1, 1.0]) == (150, 60)
