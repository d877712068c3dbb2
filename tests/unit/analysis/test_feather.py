"""The sky's border is as soft as the photo: spread in fog, sharp at an edge, given masks kept."""

import dataclasses
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
from relight_scenes import known_photo

import sunwidget as sw
from sunwidget.analysis import correct, frame_inputs
from sunwidget.analysis.segmentation.feather import softened_water, softening

HEIGHT, WIDTH, ROW = 180, 240, 100


def picture(top, bottom, blur=0.0):
    """Two grays, or with blur a ramp between them, with a little grain."""
    gray = np.full((HEIGHT, WIDTH, 3), top, np.float32)
    gray[ROW:] = bottom
    if blur:
        gray = cv2.GaussianBlur(gray, (0, 0), blur)
    gray += np.random.default_rng(3).normal(0, 0.004, gray.shape).astype(np.float32)
    return SimpleNamespace(encoded=gray)


def mask(row=ROW):
    return (np.arange(HEIGHT)[:, None].repeat(WIDTH, axis=1) < row).astype(np.float32)


NOTHING = np.zeros((HEIGHT, WIDTH), np.float32)


def change(photo, sky, clouds, glare):
    """What softening changes in matte and opacity, at its own size."""
    how = softening(photo, sky, clouds, glare)
    maps = np.stack([cv2.resize(m, how.shape[1::-1]) for m in (sky, clouds)], -1)
    return how[..., :2] + (how[..., 2:] - 1) * maps


def test_a_border_in_fog_spreads_without_a_step():
    sky = mask()
    added = change(picture(0.8, 0.76, blur=40), sky, NOTHING, NOTHING)
    profile = (sky + added[..., 0]).mean(1)
    assert np.abs(np.diff(profile)).max() < 0.1
    assert ((profile > 0.05) & (profile < 0.95)).sum() > 20
    assert profile[:40].min() > 0.99
    assert profile[-40:].max() < 0.01


@pytest.mark.parametrize("blur", [0, 1.5])
@pytest.mark.parametrize("shift", [-1, 0, 1])
def test_an_edge_of_the_photo_keeps_the_border(blur, shift):
    # Ramps of two pixels, and a mask that misses the edge by a pixel.
    sky = mask(ROW + shift)
    added = change(picture(0.8, 0.3, blur), sky, NOTHING, NOTHING)
    far = np.abs(np.arange(HEIGHT) - ROW) > 5
    assert np.abs(added[far]).max() < 0.06


def test_clouds_keep_their_share_of_the_sky():
    sky = mask()
    clouds = 0.6 * sky
    added = change(picture(0.8, 0.76, blur=40), sky, clouds, NOTHING)
    soft = sky + added[..., 0]
    shown = soft > 0.1
    assert shown[ROW:].any()
    share = (clouds + added[..., 1])[shown] / soft[shown]
    assert share == pytest.approx(0.6, abs=0.02)


def test_nothing_is_softened_where_the_old_sun_outshines_the_edges():
    glare = NOTHING.copy()
    glare[ROW - 20 : ROW + 20, :60] = 1
    added = change(picture(0.8, 0.76, blur=40), mask(), NOTHING, glare)
    assert np.abs(added[ROW - 20 : ROW + 20, :60]).max() < 1e-6
    assert np.abs(added[:, 120:]).max() > 0.2


def test_maps_of_other_sizes_and_large_photos_give_at_most_256_pixels():
    big = cv2.resize(picture(0.8, 0.76, blur=40).encoded, (480, 360))
    small = np.zeros((20, 30), np.float32)
    added = softening(SimpleNamespace(encoded=big), mask(), small, small)
    assert added.shape == (192, 256, 3)


def test_not_even_a_fine_line_of_the_border_is_left_in_fog():
    # The softening is a quarter as large as the map: the map's own border would remain.
    how = softening(picture(0.8, 0.76, blur=40), mask(), NOTHING, NOTHING)
    border = slice(ROW - 1, ROW + 1)
    assert how[border, :, 2].max() < 0.05
    large = cv2.resize(how, (4 * WIDTH, 4 * HEIGHT))
    sharp = np.repeat(np.repeat(mask(), 4, axis=0), 4, axis=1)
    profile = (sharp * large[..., 2] + large[..., 0]).mean(1)
    assert np.abs(np.diff(profile)).max() < 0.03


@pytest.fixture(scope="module")
def foggy():
    """A scene with ground of nearly the sky's light, whose mask was not given."""
    plain = known_photo(sun=(60.0, 14.0), noise=0.0, clouds=False)
    fog = cv2.GaussianBlur(plain.linear[:52].mean((0, 1)) + 0 * plain.linear, (0, 0), 3)
    fog[60:] *= 0.7
    fog = cv2.GaussianBlur(fog.astype(np.float32), (0, 0), 9)
    scene = dataclasses.replace(plain, linear=fog).analyze()
    return dataclasses.replace(scene, decision=scene.decision._replace(final=False))


def test_the_frames_matte_is_soft_and_the_scenes_mask_is_not(foggy):
    matte = frame_inputs.layers(foggy)[..., 0]
    assert set(np.unique(foggy.sky)) == {0, 1}
    assert ((matte > 0.1) & (matte < 0.9)).mean() > 0.05
    assert 0 <= matte.min() <= matte.max() <= 1


def test_a_given_mask_is_kept(foggy):
    given = dataclasses.replace(foggy, decision=foggy.decision._replace(final=True))
    assert np.array_equal(frame_inputs.layers(given)[..., 0], given.sky)


def test_what_a_stroke_changed_is_kept_and_the_rest_stays_soft(foggy):
    stroke = sw.Stroke("not_sky", ((0.1, 0.6), (0.2, 0.6)), 0.03)
    brushed = correct.corrected(foggy, sw.Edit(strokes=(stroke,)))
    changed = np.abs(brushed.sky - foggy.sky) > 0.01
    assert changed.any()
    matte, before = (frame_inputs.layers(scene)[..., 0] for scene in (brushed, foggy))
    assert np.array_equal(matte[changed], brushed.sky[changed])
    near = cv2.dilate(changed.astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    kept = ~near & (before != foggy.sky)
    assert kept.any()
    assert np.array_equal(matte[kept], before[kept])


def test_a_moved_sun_draws_no_line_in_fog(foggy):
    hard = dataclasses.replace(foggy, decision=foggy.decision._replace(final=True))

    def line(scene, elevation):
        rows = (
            sw.render(scene, sw.Edit(sun_elevation=elevation, aerial_perspective=0))
            .astype(float)
            .mean((1, 2))
        )
        return np.abs(np.diff(rows))[40:70].max()

    assert line(foggy, 2.0) < min(2.9, line(hard, 2.0))
    assert line(foggy, 3.0) < 2.45 < 0.6 * line(hard, 3.0)
    assert line(foggy, 5.0) < 0.35 * line(hard, 5.0)
    assert np.array_equal(sw.render(foggy, sw.Edit()), foggy.photo.encoded)


def shore_of(photo, odds, sky=NOTHING):
    """Water below the row, softened; its mean in each row."""
    water = 1 - mask()
    return softened_water(photo, sky, water, np.where(water > 0, 0.9, odds)).mean(1)


def test_water_without_a_visible_shore_begins_slowly_where_networks_doubt():
    even, edged = picture(0.5, 0.5), picture(0.4, 0.6)
    slow, sharp = shore_of(even, 0.3), shore_of(edged, 0.3)
    assert ((slow > 0.1) & (slow < 0.9)).sum() > 20
    assert ((sharp > 0.1) & (sharp < 0.9)).sum() <= 4
    assert 0.2 < slow[ROW - 5] < slow[ROW + 5] < 0.8


def test_water_spreads_to_no_land_of_which_the_networks_are_sure():
    sure = shore_of(picture(0.5, 0.5), 0.01)
    assert sure[: ROW - 4].max() == 0
    assert 0.3 < sure[ROW + 5] < 0.8


def test_water_as_white_as_the_sky_above_it_stays_water():
    assert shore_of(picture(0.9, 0.9), 0.3, sky=mask())[ROW + 1 :].min() > 0.97
