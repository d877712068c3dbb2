"""Noise, and the land of a world: heights, water, slopes, its mesh and what covers it."""

import numpy as np
import pytest
from world_meshes import chance, check, coarsen, facing, grid, rolling

from training.worlds.ground import Ground, Noise


def test_noise_is_told_by_its_seed():
    places = grid()
    assert np.array_equal(Noise(chance(3))(*places), Noise(chance(3))(*places))
    one, other = Noise(chance(3))(*places).ravel(), Noise(chance(4))(*places).ravel()
    assert abs(np.corrcoef(one, other)[0, 1]) < 0.1


def test_noise_is_bounded_even_and_smooth():
    noise = Noise(chance())
    x, y = grid()
    found = noise(x, y)
    assert np.abs(found).max() < 0.75
    assert abs(found.mean()) < 0.02
    assert found.std() > 0.15
    assert noise(np.floor(x), np.floor(y)) == pytest.approx(0)
    assert np.abs(noise(x + 1e-4, y) - found).max() < 1e-3


def test_fractal_noise_and_ridges_are_bounded():
    noise = Noise(chance())
    fractal, ridges = noise.fractal(*grid(), 20.0), noise.ridges(*grid(), 20.0)
    assert np.abs(fractal).max() < 1.4
    assert ridges.min() >= 0
    assert 1 < ridges.max() < 2


def test_water_is_the_lowest_that_the_land_is_told_to_be():
    x, y = grid(step=3.0)
    dry, wet = rolling().at(x, y), rolling(0.5).at(x, y)
    assert np.array_equal(dry, rolling().heights(x, y))
    assert dry.min() < 0
    assert np.array_equal(wet, np.maximum(dry, 0.5))
    sheet = rolling(0.5).sheet()
    check(sheet)
    assert sheet.names == ("water",)
    assert (sheet.vertices[:, 2] == 0.5).all()
    assert (facing(sheet)[:, 2] > 0).all()


def test_slope_is_the_tangent():
    plane = Ground(lambda x, y: 0.3 * x - 0.4 * y, lambda x, *_: 0 * x, ("rock",))
    assert plane.slope(*grid()) == pytest.approx(0.5)


@pytest.mark.parametrize("half_angle", [0.2, 0.9, 3.1])
def test_the_land_s_mesh_follows_the_heights_without_a_gap(half_angle, monkeypatch):
    coarsen(monkeypatch)
    land = rolling()
    found = land.mesh(half_angle)
    check(found)
    x, y, z = found.vertices.T
    assert np.array_equal(z, land.heights(x, y))
    assert np.hypot(x, y).max() > 10_000  # no end is to be seen
    assert np.hypot(x, y).min() == 0  # and no hole at the camera's feet
    turn = np.sort(np.arctan2(x, y)[np.hypot(x, y) > 10_000])
    steps = np.diff([*turn, turn[0] + 2 * np.pi])
    ring = 0.5 * np.hypot(x, y).max() ** 2 * np.sin(steps).sum()
    assert np.abs(facing(found)[:, 2]).sum() / 2 == pytest.approx(ring)
    counts = np.bincount(found.faces.ravel(), minlength=len(x))
    assert counts.min() >= 2


def test_the_land_faces_up(monkeypatch):
    coarsen(monkeypatch)
    assert (facing(rolling().mesh(0.4))[:, 2] > 0).all()


def test_the_land_is_finest_in_view_and_near():
    found = rolling().mesh(0.4)
    centres = found.vertices[found.faces].mean(1)
    angle = np.arctan2(centres[:, 0], centres[:, 1])
    seen = np.abs(angle) < 0.4
    assert seen.mean() > 0.7
    far = np.hypot(*centres[:, :2].T)
    size = np.sqrt(np.linalg.norm(facing(found), axis=1))
    assert size[seen & (far < 3)].max() < 0.2 < size[seen & (far > 1000)].min()
    ring = (far > 90) & (far < 110)
    assert size[ring & seen].max() < 0.5 * size[ring & ~seen].min()


def test_the_land_lies_about_where_it_is_asked_for(monkeypatch):
    coarsen(monkeypatch)
    found = rolling().mesh(0.4, (300.0, -40.0))
    x, y, z = found.vertices.T
    assert np.hypot(x - 300, y + 40).min() == 0
    assert np.array_equal(z, rolling().heights(x, y))


def test_what_covers_the_land_is_told_by_height_and_slope():
    land = rolling()
    found = land.mesh(0.5)
    assert found.names == land.names
    x, y, z = found.vertices[found.faces].mean(1).T
    near = np.hypot(x, y) < 300
    steep = np.hypot(np.cos(x / 30) / 15, np.sin(y / 50) / 50)
    sure = near & (np.abs(steep - 0.06) > 0.005)
    wanted = np.where(steep > 0.06, 2, np.where(z > 1, 1, 0))
    assert set(wanted[sure]) == {0, 1, 2}
    assert np.array_equal(found.materials[sure], wanted[sure])
