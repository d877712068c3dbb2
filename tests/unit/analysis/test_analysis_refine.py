"""Refinement and strokes: the matte follows the photo's edges, a stroke takes what it meant."""

import cv2
import numpy as np
import pytest

from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.sky import SkyMaps
from sunwidget.analysis.segmentation import matting, refine
from sunwidget.analysis.strokes import brush
from sunwidget.analysis.strokes.sky import Painting
from sunwidget.edit.table import Stroke
from sunwidget.photo.photo import Photo, open_photo

HEIGHT, WIDTH = 240, 320


def apply_strokes(working: Working, decision: refine.Decision, strokes: list) -> refine.Decision:
    """Replay strokes in order on a decision."""
    painting = Painting.begin(decision.sky, working)
    for stroke in strokes:
        painting = painting.stroke(stroke, working)
    return painting.on(decision)


def tree() -> tuple[np.ndarray, np.ndarray]:
    """Draw a bare tree before a pale sky: picture and true sky."""
    sky = np.ones((HEIGHT, WIDTH), np.uint8)
    sky[180:] = 0
    for end in range(60, 270, 15):
        cv2.line(sky, (160, 185), (end, 60 + abs(end - 160) // 4), 0, 2)
    generator = np.random.default_rng(0)
    picture = np.where(sky[..., None] == 1, (190, 205, 225), (60, 50, 40))
    picture = picture + generator.normal(0, 4, picture.shape)
    return np.clip(picture, 0, 255).astype(np.uint8), sky > 0


def blurred(sky: np.ndarray, size: int = 48) -> np.ndarray:
    """Return what a coarse network makes of it: low resolution, twigs taken for a bush."""
    opened = cv2.erode(sky.astype(np.uint8), np.ones((9, 9), np.uint8))
    small = cv2.resize(opened.astype(np.float32), (size, size), interpolation=cv2.INTER_AREA)
    return 0.12 + 0.85 * np.clip(small, 0, 1)


def overlap(matte: np.ndarray, truth: np.ndarray) -> float:
    return float(((matte > 0.5) & truth).sum() / ((matte > 0.5) | truth).sum())


def refined(photo: Photo, probability: np.ndarray, method: str = "grabcut_mask") -> np.ndarray:
    working = Working.of(photo)
    return matting.matte(photo, working, refine.METHODS[method](working, probability))


def test_refinement_finds_the_sky_between_the_twigs():
    picture, truth = tree()
    photo = open_photo(picture)
    before = overlap(cv2.resize(blurred(truth), (WIDTH, HEIGHT)), truth)
    after = overlap(refined(photo, blurred(truth)), truth)
    assert before < 0.85
    assert after > 0.98


@pytest.mark.parametrize("wet", [True, False])
def test_water_of_the_skys_color_is_no_sky_if_the_network_says_so(wet, monkeypatch):
    picture = np.full((HEIGHT, WIDTH, 3), (190, 205, 225), np.uint8)
    picture[200:] = (60, 50, 40)
    probability = np.full((48, 64), 0.95, np.float32)
    probability[30:] = 0.3  # below: a mirror of the sky, or a cloud
    probability[40:] = 0.02
    water = (probability < 0.5) * np.float32(0.65 if wet else 0.05)
    seen = SkyMaps(cv2.resize(probability, (48, 48)), cv2.resize(water, (48, 48)))
    monkeypatch.setattr(refine, "look_at_sky", lambda _: seen)
    mirror = refined(open_photo(picture), probability)[160:190]
    assert mirror.max() < 0.2 if wet else mirror.min() > 0.8


def test_no_method_leaves_zero_to_one_or_changes_the_size():
    picture, truth = tree()
    for method in refine.METHODS:
        matte = refined(open_photo(picture), blurred(truth), method)
        assert matte.shape == (HEIGHT, WIDTH)
        assert matte.dtype == np.float32
        assert 0 <= matte.min() <= matte.max() <= 1


def test_refining_twice_gives_the_same_bits():
    picture, truth = tree()
    first, second = (refined(open_photo(picture), blurred(truth)) for _ in range(2))
    assert np.array_equal(first, second)


def test_large_photos_are_cut_in_strips_without_seams():
    picture, truth = tree()
    photo = open_photo(np.repeat(np.repeat(picture, 8, axis=0), 8, axis=1))
    matte = refined(photo, blurred(truth))
    assert matte.shape == (8 * HEIGHT, 8 * WIDTH)
    assert overlap(matte, np.repeat(np.repeat(truth, 8, axis=0), 8, axis=1)) > 0.97


@pytest.mark.parametrize("level", [0.0, 1.0])
def test_nothing_but_sky_or_land_stays_what_it_is(level):
    picture, _ = tree()
    matte = refined(open_photo(picture), np.full((48, 48), level, np.float32))
    assert np.array_equal(matte, np.full((HEIGHT, WIDTH), level, np.float32))


def wall() -> tuple[Working, refine.Decision]:
    """Two grey walls that were taken for sky."""
    picture = np.empty((HEIGHT, WIDTH, 3), np.uint8)
    picture[:] = (110, 150, 210)
    picture[60:180, 30:110] = picture[60:180, 210:290] = (150, 148, 140)
    picture[180:] = (50, 60, 30)
    sky = np.ones((HEIGHT, WIDTH), np.float32)
    sky[180:] = 0
    return Working.of(open_photo(picture)), refine.Decision(sky, np.ones_like(sky))


def test_a_stroke_along_a_wall_takes_the_wall_and_nothing_else():
    working, decision = wall()
    stroke = Stroke("not_sky", ((0.15, 0.3), (0.28, 0.7)), 0.01)
    sky = apply_strokes(working, decision, [stroke]).sky
    assert sky[62:178, 32:108].mean() < 0.02
    assert sky[:55].min() == 1, "the sky above"
    assert sky[60:180, 210:290].min() == 1, "the other wall is not connected"
    assert sky[180:].max() == 0


def test_strokes_are_replayed_in_order_and_the_last_one_wins():
    working, decision = wall()
    line = ((0.15, 0.3), (0.28, 0.7))
    away = apply_strokes(working, decision, [Stroke("not_sky", line, 0.01)])
    back = apply_strokes(
        working, decision, [Stroke("not_sky", line, 0.01), Stroke("sky", line, 0.01)]
    )
    assert away.sky[120, 70] == 0
    assert back.sky[120, 70] == 1


def test_no_stroke_gives_the_very_same_decision():
    working, decision = wall()
    assert apply_strokes(working, decision, []) is decision


def test_a_dab_is_at_least_a_pixel_and_a_stroke_outside_paints_nothing():
    dab = brush.paint(Stroke("sky", ((0.5, 0.5),), 0.0005), 40, 30)
    assert 1 <= dab.sum() <= 5
    assert dab[14:16, 19:21].any()
    assert brush.paint(Stroke("sky", ((9.0, 9.0), (9.5, 9.0)), 0.01), 40, 30).sum() == 0


def test_doubted_land_of_the_skys_colour_does_not_teach_what_land_looks_like():
    """Sky in a crown or a wheel that the network takes for a thing, and a wall it is sure of."""
    generator = np.random.default_rng(1)
    guide = (0.8 + generator.normal(0, 0.01, (HEIGHT, WIDTH, 3))).astype(np.float32)
    guide[180:] = 0.2 + generator.normal(0, 0.01, (60, WIDTH, 3))
    probability = np.full((HEIGHT, WIDTH), 0.97, np.float32)
    probability[180:] = 0.01
    crown, wall = np.s_[110:180, 40:140], np.s_[110:180, 180:280]
    probability[crown], probability[wall] = 0.2, 0.01
    evidence = refine.local_evidence(guide, probability > 0.5, probability, 0.1)
    assert np.median(evidence[130:160, 70:110]) > 2
    assert np.median(evidence[130:160, 210:250]) < 1


def test_a_given_mask_is_kept_as_it_is_without_refinement():
    picture, truth = tree()
    mask = cv2.GaussianBlur(truth.astype(np.float32), (0, 0), 2.0)
    assert np.array_equal(refined(open_photo(picture), mask, "none"), mask)
