"""Large pictures: strips, folded rows and the copy that reductions are made of."""

import importlib

import numpy as np
import pytest
from relight_scenes import known_scene, sample_scene

import sunwidget as sw
from sunwidget.analysis import frame_inputs
from sunwidget.edit.table import METHODS
from sunwidget.renderer import render, render_pass, tiles

module = importlib.import_module("sunwidget.renderer.offscreen")  # a function hides it

MOVED = sw.Edit(sun_azimuth=20, sun_elevation=5)
# Clouds that change read a pixel's neighbours, for its grain; added ones another map.
CLOUDY = MOVED.replace(cloud_opacity=0.4, added_clouds=0.5)


def forget_pictures():
    for renderer in module._renderers.values():
        renderer.drawings.clear()


@pytest.fixture
def large(monkeypatch):
    """Take every picture for a large one, in strips of ``rows``; its copy is as large as itself."""

    def choose(rows, limit=None):
        monkeypatch.setattr(tiles, "RESIDENT_PIXELS", 0)
        monkeypatch.setattr(module, "_BAND_PIXELS", rows * 120)
        if limit is not None:
            monkeypatch.setattr(module, "largest_texture", lambda _: limit)
        forget_pictures()

    yield choose
    forget_pictures()


@pytest.mark.parametrize("edit", [MOVED, CLOUDY], ids=["moved", "cloudy"])
@pytest.mark.parametrize("method", METHODS)
def test_a_large_picture_is_to_the_bit_what_is_drawn_at_once(large, edit, method):
    scene = known_scene()
    whole = render(scene, edit, method=method, dtype="float32")
    large(rows=12)  # does not divide 80
    assert np.array_equal(render(scene, edit, method=method, dtype="float32"), whole)


def test_a_large_picture_at_another_size_is_to_the_bit_what_is_drawn_at_once(large):
    scene = known_scene()
    whole = render(scene, CLOUDY, size=(90, 60), dtype="float32")
    large(rows=12)
    assert np.array_equal(render(scene, CLOUDY, size=(90, 60), dtype="float32"), whole)


@pytest.mark.parametrize("limit", [50, 119])
def test_rows_longer_than_a_texture_change_no_bit(large, limit):
    scene = known_scene()
    large(rows=12)
    # A copy no larger than a texture may be: the same for both.
    edge = pytest.MonkeyPatch()
    edge.setattr(tiles, "COPY_EDGE", limit)
    whole = render(scene, CLOUDY, dtype="float32")
    large(rows=12, limit=limit)
    assert np.array_equal(render(scene, CLOUDY, dtype="float32"), whole)
    edge.undo()


@pytest.mark.parametrize("dtype", ["uint8", "uint16", "float32"])
def test_an_unmoved_sun_changes_nothing_of_a_large_picture(large, monkeypatch, dtype):
    scene = known_scene()
    whole = render(scene, dtype=dtype)
    large(rows=7, limit=64)
    monkeypatch.setattr(tiles, "COPY_EDGE", 40)
    assert np.array_equal(render(scene, dtype=dtype), whole)
    assert np.array_equal(render(scene, sw.Edit(**scene.automatic), dtype=dtype), whole)


def test_two_large_pictures_may_be_drawn_in_turn(large):
    scene = known_scene()
    one, other = render(scene, MOVED), render(scene, CLOUDY, size=(90, 60))
    large(rows=12)
    pairs = zip(
        module.strips_of(scene, MOVED), module.strips_of(scene, CLOUDY, size=(90, 60)), strict=False
    )
    count = 0
    for (rows, pixels), (other_rows, other_pixels) in pairs:
        assert np.array_equal(pixels, one[rows])
        assert np.array_equal(other_pixels, other[other_rows])
        count += 1
    assert count > 3


def test_a_pass_of_a_large_picture_is_that_of_the_whole(large):
    scene = known_scene()
    whole = render_pass(scene, CLOUDY, "retouched")
    large(rows=12)
    render(scene, CLOUDY)
    assert np.array_equal(render_pass(scene, CLOUDY, "retouched"), whole)


def test_reductions_of_a_copy_give_nearly_the_same_picture(monkeypatch):
    scene = sample_scene("coast", 480)
    whole = render(scene, MOVED).astype(int)
    monkeypatch.setattr(tiles, "RESIDENT_PIXELS", 0)
    monkeypatch.setattr(tiles, "COPY_EDGE", 240)
    forget_pictures()
    apart = np.abs(render(scene, MOVED) - whole)
    forget_pictures()
    # Normals of the land from depth in eight bits, and water by its sparkles, are what samples say.
    assert 0 < apart.mean() < 0.5
    assert np.percentile(apart, 99) <= 6


@pytest.mark.parametrize("size", [(20_000, 100), (100, 20_000), (12_000, 9000), (1, 1)])
def test_strips_cover_the_picture_once_and_fit_into_a_texture(size):
    limit = 16_384
    parts = tiles.pieces(size, 2_100_000, limit)
    assert [rows.start for rows, _ in parts[1:]] == [rows.stop for rows, _ in parts[:-1]]
    assert (parts[0][0].start, parts[-1][0].stop) == (0, size[1])
    folds = -(-size[0] // limit)
    for rows, columns in parts:
        assert [c.start for c in columns[1:]] == [c.stop for c in columns[:-1]]
        assert (columns[0].start, columns[-1].stop) == (0, size[0])
        assert max(c.stop - c.start for c in columns) <= limit
        assert (rows.stop - rows.start + 2) * folds <= limit


def test_the_copy_keeps_the_shape_and_fits_into_a_texture():
    assert tiles.copy_size((2048, 1365), 16_384) == (2048, 1365)
    assert tiles.copy_size((6000, 4000), 16_384) == (2048, 1365)
    assert tiles.copy_size((6000, 4000), 1024) == (1024, 683)
    assert tiles.copy_size((20_000, 100), 16_384) == (2048, 10)


def test_maps_by_rows_are_the_maps():
    coast = sample_scene("coast", 480)
    rows = slice(101, 220)
    assert (
        np.abs(frame_inputs.layers(coast, rows=rows) - frame_inputs.layers(coast)[rows]).max()
        <= 2e-7
    )
    assert (
        np.abs(frame_inputs.surface(coast, rows=rows) - frame_inputs.surface(coast)[rows]).max()
        <= 4e-7
    )
