"""The part of a picture that a zoomed view asks for."""

import importlib
import math

import numpy as np
import pytest

import sunwidget as sw
from sunwidget.widgets.editor.detail import detail

EDIT = sw.Edit(sun_elevation=3.0)


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(sw.sample("coast").preview(192))


def test_a_part_is_cut_from_the_full_picture_at_whole_pixels(scene):
    box, pixels = detail(scene, EDIT, [0.251, 0.3, 0.5, 0.71], [1000, 1000])
    width, height = scene.photo.size
    left, top, right, bottom = (
        round(share * side) for share, side in zip(box, (width, height) * 2, strict=True)
    )
    assert (left, right) == (math.floor(0.251 * width), math.ceil(0.5 * width))
    assert np.array_equal(pixels, sw.render(scene, EDIT)[top:bottom, left:right])


def test_only_the_strips_in_sight_are_drawn(scene, monkeypatch):
    monkeypatch.setattr(
        importlib.import_module("sunwidget.renderer.offscreen"), "_BAND_PIXELS", 16 * 192
    )
    drawn = []
    _, pixels = detail(
        scene, EDIT, [0, 0.3, 1, 0.6], [400, 400], lambda done, _: drawn.append(done)
    )
    assert len(drawn) == 3  # of eight
    top = math.floor(0.3 * scene.height)
    assert np.array_equal(pixels, sw.render(scene, EDIT)[top : top + len(pixels)])


def test_no_more_pixels_travel_than_can_be_shown(scene):
    box, pixels = detail(scene, EDIT, [-0.2, 0, 1.3, 1], [96.4, 64])
    assert box == (0, 0, 1, 1)
    assert pixels.shape == (64, 96, 3)
    small = sw.render(scene, EDIT, size=(96, 64)).astype(int)
    assert np.abs(pixels - small).mean() < 4


@pytest.mark.parametrize(
    ("box", "size"),
    [
        (None, [10, 10]),
        ([0, 0, 1], [10, 10]),
        ([0, 0, "1", 1], [10, 10]),
        ([0, 0, math.nan, 1], [10, 10]),
        ([0.5, 0, 0.5, 1], [10, 10]),
        ([2, 0, 3, 1], [10, 10]),
        ([0, 0, 1, 1], [0, 10]),
        ([0, 0, 1, 1], {"width": 10}),
    ],
)
def test_a_hostile_question_is_refused(scene, box, size):
    with pytest.raises(ValueError, match=r"finite numbers|has no part"):
        detail(scene, EDIT, box, size)
