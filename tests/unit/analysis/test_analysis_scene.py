"""analyze(): hints win, corrections replay, odd pictures warn instead of failing."""

import math
import re

import numpy as np
import pytest

import sunwidget as sw
from sunwidget.analysis import correct, frame_inputs
from sunwidget.errors import AnalysisError

HEIGHT, WIDTH, ROW = 150, 200, 90


def landscape() -> np.ndarray:
    picture = np.empty((HEIGHT, WIDTH, 3), np.uint8)
    picture[:ROW] = np.linspace((70, 120, 210), (170, 200, 235), ROW)[:, None]
    noise = np.random.default_rng(0).integers(-15, 15, (HEIGHT - ROW, WIDTH, 1))
    picture[ROW:] = np.clip(np.array((80, 90, 50)) + noise, 0, 255)
    return picture


def mask() -> np.ndarray:
    return np.arange(HEIGHT)[:, None].repeat(WIDTH, axis=1) < ROW


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(landscape(), sky=mask(), fov=40)


def test_maps_have_the_photos_size_type_and_range(scene):
    for name in ("sky", "sky_coarse", "clouds", "cloud_softness", "water"):
        found = getattr(scene, name)
        assert found.shape == (HEIGHT, WIDTH), name
        assert found.dtype == np.float32, name
        assert 0 <= found.min() <= found.max() <= 1, name
    assert scene.depth.shape == (HEIGHT, WIDTH)
    assert frame_inputs.layers(scene).shape == (HEIGHT, WIDTH, 4)
    assert frame_inputs.surface(scene).shape == (HEIGHT, WIDTH, 4)


def test_sky_is_infinitely_far_and_the_ground_nears_towards_the_feet(scene):
    assert np.isinf(scene.depth[: ROW - 5]).all()
    column = scene.depth[ROW + 5 :, WIDTH // 2]
    assert np.isfinite(column).all()
    assert (np.diff(column) <= 0.1 * column[:-1]).all()
    assert column[0] > 2 * column[-1]


def test_a_scene_says_what_it_is_in_three_short_lines(scene):
    photo, found, shares = repr(scene).splitlines()
    assert photo == f"<Scene of 'array', {WIDTH}×{HEIGHT}"
    assert found.startswith(" sun at azimuth ")
    assert found.endswith("field of view 40°")
    assert re.fullmatch(r" sky 60 %, clouds \d+ %, water \d+ %>", shares)
    assert max(map(len, (photo, found, shares))) < 100
    assert "array(" not in repr(scene.sun)
    hinted = sw.analyze(landscape(), sky=mask(), sun=(50, 30), fov=38)
    assert "° (hint); horizon in row" in repr(hinted)


def test_hinted_sun_horizon_and_field_of_view_win():
    hinted = sw.analyze(landscape(), sky=mask(), sun=(50, 30), horizon=80, fov=38)
    assert (hinted.sun.x, hinted.sun.y) == (50, 30)
    assert hinted.sun.source == "hint"
    assert hinted.horizon.row == 80
    assert hinted.horizon.source == "hint"
    assert hinted.camera.fov_vertical_deg == 38
    assert hinted.camera.pixel(hinted.sun.azimuth, hinted.sun.elevation) == pytest.approx((50, 30))
    assert hinted.automatic["sun_azimuth"] == pytest.approx(hinted.sun.azimuth)


def test_two_horizon_points_give_the_camera_its_roll():
    tilted = sw.analyze(landscape(), sky=mask(), horizon=((0, 80), (WIDTH, 100)))
    assert tilted.camera.roll == pytest.approx(math.degrees(math.atan(20 / WIDTH)))
    assert tilted.camera.horizon_row() == pytest.approx(90)


def test_a_sun_hinted_outside_is_known_but_not_visible():
    outside = sw.analyze(landscape(), sky=mask(), sun=(-300, -50))
    assert not outside.sun.visible
    assert outside.sun.azimuth < 0
    assert frame_inputs.uniforms(outside)["sun_visible"] == 0


def test_a_sun_hinted_on_dark_land_is_below_an_unsure_horizon_and_leaves_it():
    random = np.random.default_rng(1)
    roofs = np.repeat(random.integers(15, 55, 30), 6)
    sky = np.arange(120)[:, None] < roofs
    picture = np.where(sky[..., None], 80, 14) + random.normal(0, 2, (120, 180, 3))
    picture = picture.astype(np.uint8)
    picture[87:94, 87:94] = 90
    known = {"sky": sky, "refine": "none", "horizon_method": "row_argmax"}
    unsure = sw.analyze(picture, **known).horizon
    assert unsure.confidence < 0.5
    told = sw.analyze(picture, **known, sun=(90.0, 90.0))
    assert told.horizon == unsure
    assert told.sun.elevation < -5
    picture[87:94, 87:94] = 255  # a sun that is seen
    assert sw.analyze(picture, **known, sun=(90.0, 90.0)).horizon.row > 80


def test_every_automatic_parameter_has_a_value_within_its_range(scene):
    automatic = {p.name: p for p in sw.PARAMETERS if p.kind == "number" and p.default is None}
    assert scene.automatic.keys() == automatic.keys()
    for name, value in scene.automatic.items():
        assert automatic[name].minimum <= value <= automatic[name].maximum


def test_an_edit_without_corrections_gives_the_very_same_scene(scene):
    assert correct.corrected(scene, sw.Edit(sun_elevation=3)) is scene


def test_the_same_corrections_give_the_same_maps_to_the_bit():
    stroke = sw.Stroke("sky", ((0.3, 0.8), (0.5, 0.8)), radius=0.03)
    edit = sw.Edit(strokes=(stroke,))
    first = correct.corrected(sw.analyze(landscape(), sky=mask()), edit)
    second = correct.corrected(sw.analyze(landscape(), sky=mask()), edit)
    assert first is not second
    assert np.array_equal(first.sky, second.sky)
    assert np.array_equal(first.clouds, second.clouds)


def test_a_stroke_is_set_hard_under_the_brush(scene):
    stroke = sw.Stroke("not_sky", ((0.2, 0.2), (0.4, 0.2)), radius=0.02)
    corrected = correct.corrected(scene, sw.Edit(strokes=(stroke,)))
    assert corrected.sky[round(0.2 * HEIGHT), round(0.3 * WIDTH)] == 0
    assert scene.sky[round(0.2 * HEIGHT), round(0.3 * WIDTH)] > 0.95


def test_edit_hints_are_fractions_of_the_picture(scene):
    corrected = correct.corrected(
        scene, sw.Edit(sun_hint=(0.25, 0.2), horizon_hint=((0, 0.5), (1, 0.5)), fov_hint=60)
    )
    assert (corrected.sun.x, corrected.sun.y) == pytest.approx((WIDTH / 4, HEIGHT / 5))
    assert corrected.horizon.row == pytest.approx(HEIGHT / 2)
    assert corrected.camera.fov_vertical_deg == 60
    assert correct.corrected(scene, sw.Edit(sun_hint=(0.25, 0.2))).horizon == scene.horizon


def test_a_picture_without_sky_warns_with_what_to_do():
    dark = np.full((60, 80, 3), 40, np.uint8)
    warned = sw.analyze(dark, sky=np.zeros((60, 80)))
    text = "\n".join(warned.warnings)
    assert "No sky found in array (0.0 % of pixels)" in text
    assert "the whole picture changes evenly, and only a little" in text
    assert "sky=mask" in text


@pytest.mark.parametrize("size", [(1, 1), (1, 600), (600, 1), (2, 3), (16, 16), (8, 3000)])
@pytest.mark.parametrize("sky", [0, 1])
def test_pictures_of_odd_sizes_are_analysed(size, sky):
    picture = np.random.default_rng(0).integers(0, 255, (*size, 3), dtype=np.uint8)
    found = sw.analyze(picture, sky=np.full(size, sky))
    assert found.sky.shape == size
    assert np.isfinite(found.sky).all()
    assert np.isfinite(found.clouds).all()
    assert all(np.isfinite(v) for v in found.automatic.values())


@pytest.mark.parametrize("level", [0, 128, 255])
def test_flat_pictures_are_analysed(level):
    found = sw.analyze(np.full((48, 64, 3), level, np.uint8))
    assert all(np.isfinite(v) for v in found.automatic.values())


def test_progress_counts_up_to_one_and_may_cancel():
    seen = []
    sw.analyze(landscape(), sky=mask(), progress=lambda f, message: seen.append((f, message)))
    fractions = [f for f, _ in seen]
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1
    assert all(message for _, message in seen)

    def cancel(fraction, message):
        if fraction > 0.3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sw.analyze(landscape(), sky=mask(), progress=cancel)


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        ({"sun": 5}, "pair"),
        ({"sun": (math.nan, 3)}, "finite"),
        ({"horizon": "low"}, "row in pixels"),
        ({"horizon": ((3, 1), (3, 9))}, "different x"),
        ({"horizon": (1, 2, 3)}, "row in pixels"),
        ({"horizon": (None, None)}, "row in pixels"),
        ({"horizon": ((0, 0), None)}, "row in pixels"),
        ({"horizon": 1e300}, r"at most 1e\+07 away"),
        ({"horizon": ((0, 1), (1e-9, 9))}, "different x"),
        ({"sun": (1e300, 0)}, r"at most 1e\+07 away"),
        ({"strokes": (1,)}, "tuple of sunwidget.Stroke"),
        ({"strokes": None}, "tuple of sunwidget.Stroke"),
        ({"progress": 3}, "must be a function"),
        ({"sky": np.ones((4, 5), complex)}, "takes a mask array"),
        ({"sky": np.full((4, 5), 1e300)}, "NaN or infinite"),
        ({"depth": np.ones((4, 5), "datetime64[s]")}, "an array .H, W. of metres"),
        ({"fov": 0}, "1 to 150"),
        ({"fov": "wide"}, "1 to 150"),
        ({"clouds": "cumulus"}, "unmix"),
        ({"refine": "magic"}, "grabcut_mask"),
    ],
)
def test_hints_that_cannot_be_used_are_refused_in_words(arguments, word):
    with pytest.raises(AnalysisError, match=word):
        sw.analyze(landscape(), **{"sky": mask(), **arguments})


def test_sureness_has_the_photos_size_and_follows_the_networks_doubt():
    doubt = np.clip((ROW + 30 - np.arange(HEIGHT, dtype=np.float32)) / 60, 0, 1)
    sureness = sw.analyze(landscape(), sky=doubt[:, None].repeat(WIDTH, 1), refine="grabcut_rect")
    sureness = sureness.sureness
    assert sureness.shape == (HEIGHT, WIDTH)
    assert sureness.dtype == np.float32
    assert 0 < sureness.min() <= sureness.max() <= 1
    assert sureness[ROW - 2 : ROW + 2].mean() < 0.7
    assert sureness[: ROW // 2].mean() > 0.95
