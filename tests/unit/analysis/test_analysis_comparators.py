"""The comparators of the refinement, on pictures whose sky is known."""

import cv2
import numpy as np
import pytest

from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.segmentation import matting, refine
from sunwidget.analysis.segmentation.dense_crf import _bilateral, mean_field
from sunwidget.analysis.segmentation.edges import snap
from sunwidget.photo.photo import open_photo

HEIGHT, WIDTH = 96, 128


def hills() -> np.ndarray:
    """Return a true sky over hills, with a pond of sky in a gate and a kite in the sky."""
    columns = np.arange(WIDTH)
    skyline = 50 + 14 * np.sin(columns / 11) + 6 * np.sin(columns / 3.7)
    sky = np.arange(HEIGHT)[:, None] < skyline
    sky[74:86, 50:66] = True
    sky[14:24, 90:104] = False
    return sky


def paint(sky: np.ndarray, noise: float = 3.0) -> np.ndarray:
    picture = np.where(sky[..., None], (120.0, 160.0, 215.0), (95.0, 90.0, 60.0))
    picture += np.linspace(20, -20, WIDTH)[:, None]  # the sky darkens to the right
    picture += np.random.default_rng(0).normal(0, noise, picture.shape)
    return np.clip(np.round(picture), 0, 255).astype(np.uint8)


def moved(sky: np.ndarray, by: int = 2) -> np.ndarray:
    """Return what a network off by a few pixels makes of it."""
    shifted = np.roll(sky.astype(np.float32), (by, by), axis=(0, 1))
    shifted[:by], shifted[:, :by] = shifted[by], shifted[:, by : by + 1]
    return cv2.GaussianBlur(0.05 + 0.9 * shifted, (0, 0), 1.5)


def wrong(decision: np.ndarray, truth: np.ndarray) -> float:
    return float(np.mean(decision != truth))


def test_snapping_finds_every_edge_again_hole_and_kite_too():
    truth = hills()
    coarse = moved(truth)
    assert wrong(coarse > 0.5, truth) > 0.03
    found = snap(paint(truth), coarse, band=4)
    assert wrong(found, truth) < 0.004
    assert found[78:82, 54:62].all()
    assert not found[17:21, 94:100].any()


def test_snapping_moves_nothing_beyond_its_band():
    truth = hills()
    other = paint(np.roll(truth, 25, axis=0))  # edges far from the network's border
    coarse = truth.astype(np.float32)
    found = snap(other, coarse, band=3)
    distance = np.where(
        truth,
        cv2.distanceTransform(truth.astype(np.uint8), cv2.DIST_L2, 5),
        cv2.distanceTransform((~truth).astype(np.uint8), cv2.DIST_L2, 5),
    )
    assert np.array_equal(found[distance > 5], truth[distance > 5])


def test_what_is_thinner_than_the_band_stays():
    sky = np.ones((HEIGHT, WIDTH), bool)
    sky[70:] = False
    sky[20:70, 60:62] = False  # a mast
    found = snap(paint(sky), np.where(sky, 0.9, 0.1).astype(np.float32), band=5)
    assert not found[22:68, 60:62].any()


def test_the_grid_filters_as_the_sum_over_all_pixels_does():
    """Against the kernel's definition, every pixel with every other; the grid is an estimate."""
    generator = np.random.default_rng(1)
    image = cv2.GaussianBlur(generator.integers(0, 256, (14, 18, 3)).astype(np.uint8), (0, 0), 1)
    values = np.where(np.arange(18) > 8, 1, -1) * np.ones((14, 1), np.float32)
    reach, colour = 5.0, 40.0
    rows, columns = np.mgrid[:14, :18]
    place = np.column_stack([rows.ravel() / reach, columns.ravel() / reach])
    place = np.concatenate([place, image.reshape(-1, 3) / colour], axis=1)
    kernel = np.exp(-np.square(place[:, None] - place[None]).sum(axis=-1) / 2)
    norm = 1 / np.sqrt(kernel.sum(axis=1))
    exact = (norm * (kernel @ (norm * values.ravel()))).reshape(14, 18)
    found = _bilateral(image, reach, colour)(values)
    assert np.corrcoef(found.ravel(), exact.ravel())[0, 1] > 0.996
    assert np.abs(found - exact).mean() < 0.04


def test_the_field_follows_the_colours_where_the_network_was_wrong():
    truth = hills()
    coarse = moved(truth, 3)
    before = wrong(coarse > 0.5, truth)
    marginal = mean_field(paint(truth), coarse)
    assert before > 0.05
    assert wrong(marginal > 0.5, truth) < before / 10
    assert marginal.dtype == np.float32
    assert 0 <= marginal.min() <= marginal.max() <= 1


def test_without_pairs_the_field_is_the_network_s_probability():
    coarse = moved(hills())
    marginal = mean_field(paint(hills()), coarse, appearance=0, smoothness=0)
    assert np.allclose(marginal, np.clip(coarse, 0.01, 0.99), atol=1e-5)


def test_the_smoothness_alone_removes_specks():
    coarse = np.full((40, 40), 0.8, np.float32)
    coarse[10, 10] = 0.3
    marginal = mean_field(np.full((40, 40, 3), 128, np.uint8), coarse, appearance=0)
    assert marginal[10, 10] > 0.5


@pytest.mark.parametrize("method", ["edge", "dense_crf"])
def test_a_comparator_is_a_method_and_gives_the_same_bits_twice(method):
    truth = hills()
    photo = open_photo(paint(truth))
    working = Working.of(photo)
    first, second = (
        matting.matte(photo, working, refine.METHODS[method](working, moved(truth)))
        for _ in range(2)
    )
    assert np.array_equal(first, second)
    assert wrong(first > 0.5, truth) < wrong(moved(truth) > 0.5, truth) / 2


@pytest.mark.parametrize("method", ["edge", "dense_crf"])
@pytest.mark.parametrize("shape", [(1, 1), (1, 500), (500, 1), (3, 3), (2, 40)])
@pytest.mark.parametrize("level", [0.0, 0.5, 1.0, None])
def test_every_refinement_takes_any_size_and_any_coarse_map(method, shape, level):
    generator = np.random.default_rng(0)
    photo = open_photo(generator.integers(0, 256, (*shape, 3)).astype(np.uint8))
    coarse = generator.random((8, 8)) if level is None else np.full((8, 8), level)
    decision = refine.METHODS[method](Working.of(photo), coarse.astype(np.float32))
    assert decision.sky.shape == decision.confidence.shape
    assert set(np.unique(decision.sky)) <= {0, 1}
    assert 0 < decision.confidence.min() <= decision.confidence.max() <= 1
