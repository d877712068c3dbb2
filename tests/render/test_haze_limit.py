"""Land lies no farther than air could hide how dark it is."""

import dataclasses
import re
from importlib.resources import files

import numpy as np
from relight_scenes import exact_fit, known_photo

from sunwidget.analysis import frame_inputs
from sunwidget.analysis.depth import haze_limit
from sunwidget.analysis.depth.haze_limit import log_limit
from sunwidget.analysis.images.working_copy import Working
from sunwidget.photo.photo import open_photo


def limit_of(level):
    """Limits of land of one level in 255, (h, w) metres."""
    photo = known_photo(clouds=False)
    picture = photo.bytes.copy()
    land = photo.sky < 0.5
    picture[land] = level
    working = Working.of(open_photo(picture))
    return np.exp(log_limit(working, land, photo.camera, exact_fit(photo)))[land]


def test_the_darker_the_land_the_nearer_it_is():
    limits = [np.median(limit_of(level)) for level in (2, 20, 60)]
    assert limits == sorted(limits)
    assert limits[0] < 0.1 * limits[2]


def test_land_as_bright_as_air_may_be_anywhere():
    assert limit_of(255).min() > 60_000


def test_one_dark_place_tells_of_what_is_beside_it():
    photo = known_photo(clouds=False)
    picture = photo.bytes.copy()
    picture[photo.sky < 0.5] = 255
    picture[-6:-4, 50:52] = 0
    land = photo.sky < 0.5
    working = Working.of(open_photo(picture))
    limit = np.exp(log_limit(working, land, photo.camera, exact_fit(photo)))
    assert limit[-5, 51] < 0.1 * limit[-5, 100]


def test_a_told_or_known_depth_is_not_doubted_and_a_guess_is():
    photo = known_photo(clouds=False)
    far, land = np.full((80, 120), 40_000, np.float32), photo.sky < 0.5
    black = photo.bytes.copy()
    black[land] = 2
    told = photo.analyze(black, depth=far)
    hints = photo.analyze(black).hints
    known = dataclasses.replace(told, hints=hints, known_depth=told.depth_field)
    guess = dataclasses.replace(told, hints=hints)
    vars(guess)["depth_field"] = told.depth_field  # as if it were found
    level = np.log2(40_000) / 16
    for sure in (told, known):
        assert abs(frame_inputs.surface(sure)[..., 3][land].mean() - level) < 0.01
    assert frame_inputs.surface(guess)[..., 3][land].max() < np.log2(5_000) / 16


def test_the_air_is_the_shaders():
    text = (files("sunwidget") / "shaders/atmosphere/extinction.glsl").read_text("utf-8")
    scattering, steps = (
        [float(v) for v in re.search(rf"{name} = vec3\((.*)\)", text)[1].split(",")]
        for name in ("kAirScattering", "kWavelengthSteps")
    )
    assert scattering == list(haze_limit._AIR_SCATTERING)
    assert steps == list(haze_limit._STEPS)
    air = (files("sunwidget") / "shaders/land/read_air.glsl").read_text("utf-8")
    assert f"kFarthestAir = {haze_limit._FARTHEST_AIR:.1f};" in air
