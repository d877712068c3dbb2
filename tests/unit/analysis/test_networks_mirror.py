"""The networks see a photo and its mirror image alike, with left and right exchanged."""

import numpy as np
import pytest

import sunwidget as sw
from sunwidget.analysis.fit.confidence import TURNS
from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.land import look_at_land, sun_basis
from sunwidget.analysis.networks.sky import look_at_sky
from sunwidget.analysis.networks.sun import look_for_sun
from sunwidget.photo.photo import open_photo


@pytest.fixture(scope="module")
def both():
    picture = sw.sample("harbour").encoded
    return [Working.of(open_photo(p)) for p in (picture, np.ascontiguousarray(picture[:, ::-1]))]


@pytest.mark.parametrize(
    ("look", "names"),
    [
        (look_at_sky, ["sky", "water"]),
        (look_for_sun, ["probability", "radius", "sharpness", "clean", "water"]),
        (look_at_land, ["sky", "sunlit", "log_depth", "facing", "water"]),
    ],
)
def test_maps_of_a_mirror_image_are_the_mirrored_maps(both, look, names):
    photo, mirrored = (look(working) for working in both)
    for name in names:
        there = getattr(mirrored, name)[:, ::-1]
        assert np.ptp(there) > 0, name
        assert getattr(photo, name) == pytest.approx(there, abs=1e-4), name


def test_normals_and_light_of_a_mirror_image_exchange_left_and_right(both):
    photo, mirrored = (look_at_land(working) for working in both)
    assert np.linalg.norm(photo.normal, axis=-1) == pytest.approx(1, abs=1e-4)
    assert np.abs(photo.normal[..., 0]).mean() > 0.05
    assert photo.normal == pytest.approx(mirrored.normal[:, ::-1] * [-1, 1, 1], abs=1e-4)
    assert photo.horizon == pytest.approx(mirrored.horizon, abs=1e-5)
    sun = np.array([0.48, 0.6, 0.64])
    light = photo.transfer @ sun_basis(sun)
    there = (mirrored.transfer @ sun_basis(sun * [-1, 1, 1]))[:, ::-1]
    assert np.abs(light - photo.transfer @ sun_basis(sun * [-1, 1, 1])).mean() > 0.01
    assert light == pytest.approx(there, abs=1e-3)


def test_the_sun_of_a_mirror_image_stands_on_the_other_side(both):
    photo, mirrored = (look_at_land(working).sun for working in both)
    assert photo.sum() == pytest.approx(1, abs=1e-3)
    opposite = [int(np.argmin(np.abs((TURNS + turn + 180) % 360 - 180))) for turn in TURNS]
    assert np.abs(photo - mirrored).max() > 0.01
    assert photo == pytest.approx(mirrored[:, opposite], abs=1e-5)
