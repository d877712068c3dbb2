"""One network finds sky and water, once per photo."""

import numpy as np

import sunwidget as sw
from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks import sky
from training.synthetic import room


def test_the_coast_has_sky_above_and_water_below():
    maps = sky.look_at_sky(Working.of(sw.sample("coast")))
    assert maps.sky.shape == maps.water.shape == (384, 384)
    for one in maps:
        assert one.dtype == np.float32
        assert 0 <= one.min() <= one.max() <= 1
    assert maps.sky[:100].mean() > 0.9
    assert maps.sky[-100:].max() < 0.1
    assert maps.water[:150].mean() < 0.05
    assert maps.water[300:330, 250:].mean() > 0.9
    assert not ((maps.sky > 0.5) & (maps.water > 0.5)).any()


def test_a_photo_is_looked_at_once(monkeypatch):
    working = Working.of(sw.sample("meadow"))
    first = sky.look_at_sky(working)
    monkeypatch.setattr(sky, "run_twice", None)
    assert sky.look_at_sky(working) is first


def test_a_room_has_no_sky_and_says_so():
    wall = np.full((300, 400, 5), 120, np.uint8)
    for seed in range(3):
        picture = room(320, np.random.default_rng(seed), lambda: wall)
        scene = sw.analyze(picture)
        assert (scene.sky > 0.5).mean() < 0.005
        assert any("No sky found" in note for note in scene.warnings)
