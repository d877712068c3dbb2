"""Outlines of water, as the network learns from them."""

import numpy as np
import pytest

from training.suns import water

SEA = "landscape-pseudo/sea.jpg"


@pytest.fixture
def outlined(tmp_path, monkeypatch):
    """Two outlined photos: a sea with a rock in it before wet sand, and a meadow."""
    path = tmp_path / "water.csv"
    sea = f'{SEA},"0,50 100,50 100,100 0,100","40,70 60,70 60,90 40,90","0,97 100,97 100,100 0,100"'
    path.write_text(f"file,water,without,unknown\n{sea}\nlandscape-pseudo/dry.jpg,,,\n")
    known = water.outlines(path)
    monkeypatch.setattr(water, "outlines", lambda _: known)


def sky(rows):
    return np.repeat((np.arange(100) < rows)[:, None] * np.uint8(255), 200, axis=1)


def test_inside_of_an_outline_is_water_but_for_what_stands_in_it_and_what_nobody_can_tell(outlined):
    found = water.water_map(SEA, sky(40))
    assert found[60, 20] == found[90, 199] == 255
    assert found[80, 100] == 0
    assert (found[98] == water.UNKNOWN).all()
    assert found[45, 100] == 0


def test_beside_an_outline_nothing_is_known_but_the_sky(outlined):
    found = water.water_map(SEA, sky(50))
    assert found[51, 100] == water.UNKNOWN
    assert found[49].max() == 0


def test_a_photo_without_a_polygon_has_none_and_one_not_listed_is_unknown(outlined):
    assert water.water_map("landscape-pseudo/dry.jpg", sky(30)).max() == 0
    other = water.water_map("landscape-pseudo/other.jpg", sky(30))
    assert other[:30].max() == 0
    assert (other[30:] == water.UNKNOWN).all()
    assert (water.water_map("sea-sky/1.jpg", sky(30))[30:] == 255).all()


def test_the_water_of_the_judged_list_is_never_learned():
    judged = water.outlines(water.JUDGED)
    wet = next(file for file, (polygons, *_) in judged.items() if polygons)
    no_sky = np.zeros((100, 200), np.uint8)
    assert (water.water_to_learn(wet, no_sky) == water.UNKNOWN).all()
    assert (water.water_map(wet, no_sky, water.JUDGED) == 255).any()
    learned = next(f for f in water.outlines() if f not in judged and f not in water.judging())
    assert np.array_equal(water.water_to_learn(learned, no_sky), water.water_map(learned, no_sky))
