"""Time and place on both sides: the browser's code, run by node, against Python's."""

import numpy as np
import pytest

from sunwidget.analysis.heading import match
from sunwidget.edit.table import Edit
from sunwidget.geometry.place import Place, at_hours, day_table, hours_of_day, solar_day

pytest.importorskip("pvlib")

SCRIPT = """
import * as place from "./src/geometry/place.js";
answer(asked.map(({ here, path, seen }) => {
  const hours = place.hoursOfDay(here);
  return {
    day: place.solarDay(here),
    hours,
    back: place.atHours(here, hours),
    next: place.atHours(here, hours + 7.5),
    edit: place.editAt(here, path, hours),
    match: place.matchHeading(here, path, seen),
    solar: place.solarTime(here),
  };
}));
"""


def places():
    """Random places, and those where dates and directions turn."""
    rng = np.random.default_rng(7)
    odd = [
        Place(-33.87, 151.21, "2024-06-21", 23.99, 10.0),
        Place(21.3, -157.9, "2024-12-31", 23.5, 350.0),
        Place(70.0, 25.0, "2024-06-21", 0.0, None),
        Place(0.0, 180.0, "2024-03-01", 12.0, 0.0),
        Place(-89.9, -180.0, "2024-12-21", 24.0, 180.0),
    ]
    return odd + [
        Place(
            float(rng.uniform(-80, 80)),
            float(rng.uniform(-180, 180)),
            f"2024-{rng.integers(1, 13):02d}-{rng.integers(1, 29):02d}",
            float(rng.uniform(0, 24)),
            float(rng.uniform(0, 359)),
        )
        for _ in range(20)
    ]


@pytest.fixture(scope="module")
def answers(in_node):
    rng = np.random.default_rng(8)
    seen = [(float(rng.uniform(-40, 40)), float(rng.uniform(0, 40))) for _ in places()]
    asked = [
        {"here": vars(p), "path": day_table(p).tolist(), "seen": s}
        for p, s in zip(places(), seen, strict=True)
    ]
    return list(zip(places(), seen, in_node(SCRIPT, asked), strict=True))


def test_days_and_hours_are_counted_alike(answers):
    for place, _, told in answers:
        hours = hours_of_day(place)
        assert told["day"] == solar_day(place)
        assert told["hours"] == pytest.approx(hours, abs=1e-9)
        assert told["back"] == pytest.approx(vars(at_hours(place, hours)), abs=1e-9)
        assert told["next"] == pytest.approx(vars(at_hours(place, hours + 7.5)), abs=2e-4)
        assert told["solar"] == pytest.approx(place.solar_time, abs=1e-9)


def test_the_clock_makes_the_same_edit(answers):
    for place, _, told in answers:
        edit = Edit().at(place).to_dict()
        edit.pop("version")
        assert told["edit"].keys() == edit.keys()
        for name in edit.keys() - {"place"}:
            assert told["edit"][name] == pytest.approx(edit[name], abs=2e-4)


def test_the_heading_by_the_sun_is_the_same(answers):
    for place, (azimuth, elevation), told in answers:
        found = match(place, azimuth, elevation)
        assert told["match"]["place"] == pytest.approx(vars(found.place), abs=2e-4)
        assert told["match"]["mismatch"] == pytest.approx(found.mismatch, abs=1e-9)
        assert told["match"]["agreeing"] == [
            # A third of a second, to which times are rounded, turns the sun by this much.
            pytest.approx(vars(one), abs=4e-3)
            for one in found.agreeing
        ]
    # Some of them have such times, and some have none.
    assert len({len(told["match"]["agreeing"]) for _, _, told in answers}) > 1
