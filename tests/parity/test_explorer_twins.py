"""What SkyExplorer computes on both sides: the same numbers in Python and in the browser's code.

The browser's modules are run by node, as they are.
"""

import numpy as np
import pytest

from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.explorer.table import EXPLORER_PARAMETERS
from sunwidget.explorer.values import effective_values
from sunwidget.geometry.solar import apparent_elevation, day_path, sun_on_path
from sunwidget.widgets.explorer.sky_explorer import SkyExplorer
from sunwidget.widgets.kernel.payload import parameter_json

SCRIPT = """
import { effectiveValues } from "./src/explorer/values.js";
import { sunAt, trueElevation } from "./src/geometry/day.js";
import * as haze from "./src/explorer/haze.js";
answer({
  values: asked.states.map((state) => effectiveValues(asked.parameters, state)),
  suns: asked.days.map(([day, hours]) => hours.map((h) => sunAt(day, h))),
  true: asked.elevations.map(trueElevation),
  haze: asked.airs.map((air) => ({
    turbidity: haze.turbidity(asked.clean, air),
    visibility: haze.visibility(asked.clean, air),
    of_turbidity: haze.depthOfTurbidity(asked.clean, air, 2.5),
    of_visibility: haze.depthOfVisibility(asked.clean, air, 9000),
  })),
});
"""
# Ithaca, midnight sun, a sun through the zenith, the pole.
DAYS = (
    ("2013-05-27", 42.443449, -76.481962),
    ("2024-06-21", 70.0, 25.0),
    ("2024-03-20", 0.0, 0.0),
    ("2024-12-21", -89.9, 0.0),
)
HOURS = [0, 0.01, 4.9, 6.04, 11.99, 12.0, 12.13, 17.3, 23.99, 24]
ELEVATIONS = np.linspace(-12, 90, 103).tolist()


def states():
    """Random states of every switch, choice and number."""
    rng = np.random.default_rng(4)

    def value(row):
        if row.kind == "switch":
            return bool(rng.integers(2))
        if row.kind == "choice":
            return row.choices[rng.integers(len(row.choices))]
        return row.default if row.kind == "data" else float(rng.uniform(row.minimum, row.maximum))

    return [{row.name: value(row) for row in EXPLORER_PARAMETERS} for _ in range(40)]


def airs():
    return [
        Atmosphere(),
        Atmosphere(aerosol_optical_depth=0.4, air_density=1.3, rayleigh_scale_height=7000),
        Atmosphere(aerosol_optical_depth=0.1, aerosol_scale_height=2500),
    ]


@pytest.fixture(scope="module")
def browsers(in_node):
    """What the browser's modules answer."""
    asked = {
        "parameters": parameter_json(EXPLORER_PARAMETERS),
        "states": states(),
        "days": [[day_path(*day).tolist(), HOURS] for day in DAYS],
        "elevations": ELEVATIONS,
        "airs": [air.parameters() for air in airs()],
        "clean": SkyExplorer()._aliases,
    }
    return in_node(SCRIPT, asked)


def test_switches_and_choices_give_the_same_uniforms(browsers):
    for state, values in zip(states(), browsers["values"], strict=True):
        assert values == effective_values(state)


@pytest.mark.parametrize("i", range(len(DAYS)), ids=[day[0] for day in DAYS])
def test_time_puts_the_sun_at_the_same_place(browsers, i):
    pytest.importorskip("pvlib")
    path = day_path(*DAYS[i])
    for hour, sun in zip(HOURS, browsers["suns"][i], strict=True):
        azimuth, elevation = sun_on_path(path, hour)
        # The last digits of sine and arc tangent differ between libraries.
        assert (sun["azimuth"] - azimuth + 180) % 360 - 180 == pytest.approx(0, abs=1e-6)
        assert sun["apparent"] == pytest.approx(elevation, abs=1e-9)


def test_the_air_lifts_the_sun_by_the_same_angle(browsers):
    assert apparent_elevation(browsers["true"]) == pytest.approx(ELEVATIONS, abs=1e-9)


def test_turbidity_and_visibility_mean_the_same_haze(browsers):
    for air, haze in zip(airs(), browsers["haze"], strict=True):
        assert haze["turbidity"] == pytest.approx(air.turbidity, rel=1e-12)
        assert haze["visibility"] == pytest.approx(air.visibility, rel=1e-12)
        by_turbidity = air.with_turbidity(2.5).aerosol_optical_depth
        by_visibility = air.with_visibility(9000).aerosol_optical_depth
        assert haze["of_turbidity"] == pytest.approx(by_turbidity, rel=1e-9)
        assert haze["of_visibility"] == pytest.approx(by_visibility, rel=1e-9)
