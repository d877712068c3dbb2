"""Clouds chosen in the edit: another method or other thresholds, on a scene already analysed."""

import numpy as np
import pytest
from analysis_pictures import seascape

import sunwidget as sw
from sunwidget.analysis import correct

OTHERS = ("rb_ratio", "rb_difference", "saturation", "learned")


@pytest.fixture(scope="module")
def cloudy():
    """A seascape with a white and a grey cloud in its blue sky."""
    picture = seascape(disc=None).astype(np.float32)
    rows, columns = np.mgrid[: picture.shape[0], : picture.shape[1]]
    for x, y, colour in ((60, 40, 235), (170, 50, 130)):
        alpha = np.clip(1.6 - np.hypot((columns - x) / 30, (rows - y) / 16), 0, 1)[..., None]
        picture = (1 - alpha) * picture + alpha * colour
    mask = np.zeros(picture.shape[:2], np.float32)
    mask[: round(0.6 * picture.shape[0])] = 1
    # A drawn white oval is as like a sun as a cloud.
    return sw.analyze(np.round(picture).astype(np.uint8), sky=mask, sun="outside")


@pytest.mark.parametrize("method", OTHERS)
def test_a_method_chosen_later_is_that_of_the_analysis(cloudy, method):
    chosen = correct.corrected(cloudy, sw.Edit(cloud_method=method))
    assert chosen.hints.method("clouds") == method
    assert chosen.clouds[40, 60] > 0.8
    assert chosen.clouds[50, 170] > 0.8
    assert not np.array_equal(chosen.clouds, cloudy.clouds)
    assert np.array_equal(chosen.sky, cloudy.sky)
    assert chosen.fitted is cloudy.fitted


def test_the_same_choice_gives_the_same_maps_by_any_way(cloudy):
    edit = sw.Edit(cloud_method="saturation", cloud_ratio_min=0.7)
    first = correct.corrected(cloudy, edit)
    for other in OTHERS:  # pushes the first out of the cache
        correct.corrected(cloudy, sw.Edit(cloud_method=other))
    again = correct.corrected(cloudy, edit)
    assert again is not first
    assert np.array_equal(again.clouds, first.clouds)
    assert np.array_equal(again.cloud_softness, first.cloud_softness)


def test_a_higher_minimum_finds_less_cloud(cloudy):
    covers = [
        float(
            correct.corrected(
                cloudy, sw.Edit(cloud_method="rb_ratio", cloud_ratio_min=m)
            ).clouds.mean()
        )
        for m in (0.3, 0.62, 0.99)
    ]
    assert covers[0] > covers[1] > covers[2]


def test_thresholds_change_nothing_while_clouds_are_unmixed(cloudy):
    assert correct.corrected(cloudy, sw.Edit(cloud_ratio_min=0.3, cloud_ratio_max=0.9)) is cloudy
    assert correct.corrected(cloudy, sw.Edit(cloud_method="unmix")) is cloudy


def test_a_scene_analysed_by_ratio_can_be_unmixed_later(cloudy):
    mask = cloudy.sky
    by_ratio = sw.analyze(cloudy.photo, sky=mask, clouds="rb_ratio", sun="outside")
    assert correct.corrected(by_ratio, sw.Edit(cloud_method="rb_ratio")) is by_ratio
    assert correct.corrected(by_ratio, sw.Edit(cloud_ratio_min=0.9)) is not by_ratio
    unmixed = correct.corrected(by_ratio, sw.Edit(cloud_method="unmix"))
    assert unmixed.clouds[40, 60] > 0.7
    assert unmixed.clouds[10, 120] < 0.2


def test_shade_tells_a_grey_cloud_from_a_white_one(cloudy):
    shade = cloudy.cloud_shade
    assert shade.shape == cloudy.sky.shape
    assert shade[40, 60] > 1.3 * shade[50, 170] > 0
    assert (correct.corrected(cloudy, sw.Edit(cloud_method="learned")).cloud_shade == 1).all()


def test_strokes_and_clouds_may_both_be_chosen(cloudy):
    stroke = sw.Stroke("not_sky", ((0.2, 0.2), (0.3, 0.2)), 0.03)
    both = correct.corrected(cloudy, sw.Edit(strokes=(stroke,), cloud_method="rb_ratio"))
    assert both.sky[32, 60] == 0
    assert both.clouds[32, 60] == 0
    assert both.clouds[50, 170] > 0.8
