"""The photo's own sun: found on a drawn disc, not taken for a cloud, grown from a click."""

import dataclasses
import math

import cv2
import numpy as np
import pytest

import sunwidget as sw
from sunwidget.analysis import correct
from sunwidget.analysis.hints import Hints
from sunwidget.analysis.images.working_copy import Working
from sunwidget.analysis.networks.sun import look_for_sun
from sunwidget.analysis.sun import search, sun
from sunwidget.atmosphere.constants import SUN_ANGULAR_RADIUS_DEG
from sunwidget.geometry.camera import Camera
from sunwidget.photo.photo import open_photo
from sunwidget.timelapses.sun import find_seen_sun

SIZE = (320, 214)
CAMERA = Camera.from_horizon(*SIZE, 40.0, 150.0)
SKY = (np.arange(SIZE[1])[:, None] < 150).astype(np.float32) * np.ones(SIZE[0], np.float32)


def evening(disc=None, cloud=None) -> Working:
    """A sky with an aureole and a burnt-out disc at ``disc``, and a white cloud at ``cloud``."""
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]] + 0.5
    code = np.stack([120 - 0.2 * rows, 150 - 0.1 * rows, 205 - 0.1 * rows], -1) / 255
    if cloud is not None:
        # Lumps with a flat base, grey below as clouds are.
        lumps = [(-40, 4, 16), (-22, -8, 20), (0, -14, 24), (22, -6, 20), (42, 3, 15), (8, 4, 22)]
        lit = np.zeros_like(rows)
        for x, y, size in lumps:
            away = np.hypot(columns - cloud[0] - x, rows - cloud[1] - y)
            lit = np.maximum(lit, np.clip((size - away) / 4, 0, 1))
        lit *= rows < cloud[1] + 10
        shade = np.clip(1.0 - 0.012 * (rows - cloud[1] + 25), 0.6, 1)
        code += lit[..., None] * (shade[..., None] - code)
    if disc is not None:
        distance = np.hypot(columns - disc[0], rows - disc[1])
        code += (0.55 * np.exp(-distance / 45))[..., None] * (1 - code)
        code = np.where((distance < 4.0)[..., None], 1.0, code)
    code = np.where(SKY[..., None] > 0, code, 0.2)
    return Working.of(open_photo(np.round(np.clip(code, 0, 1) * 255).astype(np.uint8)))


def find(working, sky=SKY):
    """The sun as the network sees it, (x, y) and more, or None."""
    return sun.find(working, look_for_sun(working), sky)


@pytest.mark.parametrize("place", [(90.5, 60.5), (250.5, 110.5), (160.5, 30.5)])
def test_a_drawn_sun_is_found_where_it_was_drawn(place):
    found = find(evening(disc=place))
    assert found is not None
    assert math.dist(found[:2], place) < 2.5


@pytest.mark.parametrize(
    ("name", "columns"), [("meadow", slice(760, None)), ("harbour", slice(700, None))]
)
def test_bright_white_clouds_are_no_sun(name, columns):
    part = np.ascontiguousarray(open_photo(sw.sample(name)).encoded[:620, columns])
    working = Working.of(open_photo(part))
    assert working.encoded.max() > 0.9
    assert find(working, np.ones((working.height, working.width), np.float32)) is None


def test_a_sun_beside_a_white_cloud_is_preferred_to_it():
    found = find(evening(disc=(70.5, 60.5), cloud=(250.0, 60.0)))
    assert found is not None
    assert math.dist(found[:2], (70.5, 60.5)) < 2.5


def test_a_lamp_on_the_land_is_no_sun():
    picture = evening().bytes.copy()
    cv2.circle(picture, (160, 190), 4, (255, 255, 255), -1)
    assert find(Working.of(open_photo(picture))) is None


def test_where_a_blot_grew_into_the_glow_the_networks_disc_stands():
    working = evening(disc=(90.5, 60.5))
    sun_mask = sun.flood_fill(working, SKY, 20.0, 20.0, CAMERA.focal)  # some sky
    peak = sun.Peak(90.5, 60.5, 5.0, 0.9, 0.1)
    settled = sun.limit_to_peak(sun_mask, peak)
    assert (settled.x, settled.y, settled.radius) == (90.5, 60.5, 5.0)
    assert settled.mask.sum() == pytest.approx(math.pi * 25, rel=0.1)
    fitting = sun.disc_fit(working, SKY, 90.5, 60.5, CAMERA.focal)
    assert sun.limit_to_peak(fitting, peak._replace(radius=4.0)) is fitting


def test_a_hinted_sun_leaves_the_white_clouds_that_it_touches():
    picture = evening(disc=(90.5, 60.5)).bytes.copy()
    whole = sun.disc_fit(Working.of(open_photo(picture)), SKY, 90.5, 60.5, CAMERA.focal)
    assert sun.limit_to_core(whole, (90.5, 60.5)) is whole
    cv2.rectangle(picture, (20, 60), (300, 80), (255, 255, 255), -1)
    shown = sw.analyze(picture, sky=SKY, sun=(90.5, 60.5)).sun
    assert shown.visible
    assert (shown.x, shown.y) == (90.5, 60.5)
    assert shown.mask[70, 200:300].max() == 0
    assert shown.mask[60, 90] == 1


def limb(step):
    """A disc of 20 px in an even sky that is darker by ``step``."""
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]] + 0.5
    inside = np.hypot(columns - 160, rows - 80) < 20
    code = np.where(inside, 0.95, 0.95 - step)[..., None] * np.ones(3)
    return Working.of(open_photo(np.round(255 * code).astype(np.uint8)))


@pytest.mark.parametrize(
    ("step", "sharp", "expected"),
    [(0.4, 0.9, True), (0.4, 0.2, False), (0.05, 0.9, False)],
)
def test_a_sharp_limb_tells_the_field_of_view_and_a_glow_does_not(step, sharp, expected):
    working = limb(step)
    sun_mask = sun.disc_fit(working, SKY, 160.0, 80.0, CAMERA.focal)
    peak = sun.Peak(160.0, 80.0, 20.0, 0.9, sharp)
    degrees = sun.field_of_view_of(sun_mask, peak, working, 50.0)
    assert (degrees is not None) == expected
    if expected:  # 40 px are 0.533°
        assert degrees == pytest.approx(SIZE[1] / 40 * 0.533, rel=0.06)


def test_disc_fit_centres_on_the_blot_even_when_clicked_off_centre():
    sun_mask = sun.disc_fit(evening(disc=(90.5, 60.5)), SKY, 92.5, 58.5, CAMERA.focal)
    assert math.dist((sun_mask.x, sun_mask.y), (90.5, 60.5)) < 1.5
    assert 3 <= sun_mask.radius <= 9  # a burnt core is larger than the 4 px disc, never far larger


def test_disc_fit_is_never_smaller_than_the_true_disc():
    sun_mask = sun.disc_fit(evening(), SKY, 100.0, 60.0, CAMERA.focal)
    assert sun_mask.radius >= CAMERA.focal * math.tan(math.radians(SUN_ANGULAR_RADIUS_DEG)) - 1e-9


def test_flood_fill_takes_what_is_as_bright_as_the_seed_and_connected_to_it():
    picture = np.full((60, 80, 3), 60, np.uint8)
    cv2.circle(picture, (30, 30), 8, (250, 250, 250), -1)
    cv2.circle(picture, (60, 30), 5, (250, 250, 250), -1)  # as bright, but apart
    sun_mask = sun.flood_fill(
        Working.of(open_photo(picture)), np.ones((60, 80), np.float32), 31, 29, 100
    )
    white = picture[..., 0] == 250
    white[:, 48:] = False
    assert np.array_equal(sun_mask.mask > 0, white)
    assert (sun_mask.x, sun_mask.y) == (30.5, 30.5)
    assert sun_mask.radius == pytest.approx(math.sqrt(white.sum() / math.pi))


def test_a_burnt_disc_that_the_sky_surrounds_belongs_to_the_sky():
    working = evening(disc=(90.5, 60.5))
    sun_mask = sun.disc_fit(working, SKY, 90.5, 60.5, CAMERA.focal)
    hole = SKY * (1 - sun_mask.mask)
    disc = sun.in_sky(sun_mask, hole, working.encoded)
    assert (disc[sun_mask.mask > 0] > 0.5).all()
    assert disc[:, 200:].max() == 0
    twig = working.encoded.copy()
    twig[:, 90] = 0.1
    assert sun.in_sky(sun_mask, hole, twig)[:, 90].max() == 0


def skyline(left, right, notch):
    """A sky (100, 160) down to a slope between two rows, into which the sun burnt a notch."""
    rows, columns = np.mgrid[:100, :160] + 0.5
    end = left + (right - left) * columns / 160
    burnt = np.hypot(columns - 80, rows - 50) < 8
    return ((rows < end) | (burnt & notch)).astype(np.float32)


def test_the_notch_that_a_setting_sun_burns_into_an_even_skyline_is_no_sky():
    sun_mask = sun.SunMask(80, 50, 6.0, skyline(0, 0, notch=True))
    for left, right in ((52, 52), (49, 57)):
        notched = skyline(left, right, notch=True)
        mended = notched * (1 - sun.find_land_glare(sun_mask, notched))
        assert np.abs(mended - skyline(left, right, notch=False)).sum() < 12
        assert np.abs(notched - skyline(left, right, notch=False)).sum() > 40


def sea(lifted):
    """The sky (200, 300) above a level sea, which the glints of the sun seem to lift."""
    rows, columns = np.mgrid[:200, :300] + 0.5
    return np.float32(rows < 120 - lifted * np.clip(1 - np.abs(columns - 150) / 20, 0, 1))


@pytest.mark.parametrize(("light", "mended"), [(0.9, True), (0.1, False)])
def test_bright_land_above_a_level_sea_is_sky_and_a_dark_ship_is_none(light, mended):
    seen, level = sea(lifted=6), sea(lifted=0)
    disc = np.zeros_like(seen)
    disc[80:90, 145:155] = 1
    encoded = np.where(level > 0, 0.9, 0.3)
    encoded = np.where((level > 0) & (seen == 0), light, encoded)
    encoded = np.repeat(encoded[..., None], 3, -1).astype(np.float32)
    is_sky, no_sky = sun.find_sea(sun.SunMask(150, 85, 5.0, disc), seen, encoded)
    found = np.maximum(seen, is_sky) * (1 - no_sky)
    assert (np.abs(found - level).sum() < 30) == mended
    assert np.abs(seen - level).sum() > 90


def test_a_notch_in_a_tilted_sea_is_straightened_and_a_boat_beside_it_is_ignored():
    rows, columns = np.mgrid[:200, :300] + 0.5
    level = np.float32(rows < 120 + 0.02 * (columns - 150))
    seen = level.copy()
    seen[118:126, 140:160] = 1
    seen[105:, 110:114] = 0  # a boat
    disc = np.float32(np.hypot(columns - 150, rows - 85) < 5)
    white = np.ones((200, 300, 3), np.float32)
    is_sky, no_sky = sun.find_sea(sun.SunMask(150, 85, 5.0, disc), seen, white)
    found = np.maximum(seen, is_sky) * (1 - no_sky)
    assert np.abs(seen - level)[:, 130:170].sum() > 90
    assert np.abs(found - level)[:, 130:170].sum() < 30


def test_above_hills_no_sea_is_lifted():
    rows, columns = np.mgrid[:200, :300] + 0.5
    hills = np.float32(rows < 120 + 8 * np.sin(columns / 9))
    white = np.ones((200, 300, 3), np.float32)
    disc = np.float32(np.hypot(columns - 150, rows - 85) < 5)
    assert sun.find_sea(sun.SunMask(150, 85, 5.0, disc), hills, white) is None


def test_a_sun_in_a_gap_of_the_skyline_keeps_its_sky():
    high = skyline(40, 40, notch=True)  # hills left and right of it
    assert not sun.find_land_glare(sun.SunMask(80, 50, 6.0, high), high).any()


def test_a_sun_over_a_valley_keeps_the_sky_below_it():
    rows, columns = np.mgrid[:200, :240] + 0.5
    valley = np.float32(rows < 120 - 1.4 * np.abs(columns - 120))
    disc = np.float32(np.hypot(columns - 120, rows - 55) < 8)
    assert not sun.find_land_glare(sun.SunMask(120, 55, 8.0, disc), valley).any()


def test_among_trees_only_what_is_burnt_is_no_notch():
    trees = skyline(55, 55, notch=True)
    trees[:70, 28:38] = 1
    trees[:90, 33:36] = 1
    burnt = (np.hypot(*(np.mgrid[:100, :160] + 0.5 - np.array([50, 80])[:, None, None])) < 8) * 1.0
    gone = sun.find_land_glare(sun.SunMask(80, 50, 8.0, np.float32(burnt)), trees)
    assert gone[62, 80] > 0.5
    assert gone[:50].max() < 0.1
    assert gone[:, :60].max() == 0
    assert gone[85, 80] == 0


def test_a_lamp_between_houses_does_not_become_sky():
    working = evening(disc=(90.5, 60.5))
    sun_mask = sun.disc_fit(working, SKY, 90.5, 60.5, CAMERA.focal)
    assert sun.in_sky(sun_mask, np.zeros_like(SKY), working.encoded).max() == 0


def test_the_observed_angles_are_those_of_the_camera_at_the_suns_pixel():
    working = evening(disc=(90.5, 60.5))
    sun_mask = sun.disc_fit(working, SKY, 90.5, 60.5, CAMERA.focal)
    seen = sun.observe(None, sun_mask, SKY, CAMERA, working)
    assert seen is not None
    assert seen.visible
    assert CAMERA.pixel(seen.azimuth, seen.elevation) == pytest.approx((seen.x, seen.y), abs=1e-6)
    # 70 px left of the centre at the camera's focal length: about 13° to the left.
    expected = math.degrees(math.atan((sun_mask.x - SIZE[0] / 2) / CAMERA.focal))
    assert seen.azimuth == pytest.approx(expected, abs=0.6)
    assert seen.mask.shape == SIZE[::-1]


@pytest.mark.parametrize(("depth", "visible"), [(2, True), (12, True), (40, False)])
def test_a_detected_sun_is_visible_until_it_has_set(depth, visible):
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]] + 0.5
    mask = (np.hypot(columns - 90, rows - 150 - depth) < 30).astype(np.float32)
    peak = sun.Peak(90.0, 150.0 + depth, 30.0, 0.9, 0.9)
    sun_mask = sun.SunMask(peak.x, peak.y, peak.radius, mask)
    seen = sun.observe(None, sun_mask, SKY, CAMERA, evening(), peak)
    assert seen is not None
    assert seen.visible == visible
    assert (seen.radius_px > 0) == visible


def test_a_hinted_sun_outside_the_picture_keeps_its_place_and_is_not_visible():
    seen = sun.observe((-500.0, 40.0), None, SKY, CAMERA, evening())
    assert seen is not None
    assert (seen.x, seen.y) == (-500.0, 40.0)
    assert not seen.visible
    assert seen.source == "hint"
    assert seen.mask.max() == 0
    assert seen.azimuth < -30


def test_no_frame_shows_a_sun_that_is_said_not_to_be_in_the_picture():
    frame = evening(disc=(90.5, 60.5))
    hints = Hints(methods=(("sun", "disc_fit"),))
    assert find_seen_sun(frame, SKY, CAMERA, hints) is not None
    assert find_seen_sun(frame, SKY, CAMERA, dataclasses.replace(hints, sun="outside")) is None


def night_sky(disc=True, post=False) -> Working:
    """A dark blue sky with a bright disc that lights hardly anything; on a post, a lamp."""
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]] + 0.5
    code = np.ones((*SIZE[::-1], 3)) * np.array([25, 32, 60]) / 255
    distance = np.hypot(columns - 200.5, rows - 70.5)
    if disc:
        code += (0.3 * np.exp(-distance / 6))[..., None] * (1 - code)
        code = np.where((distance < 5)[..., None], 1.0, code)
    code = np.where(SKY[..., None] > 0, code, 0.05)
    if post:
        code[75:, 190:212] = 0.05
    return Working.of(open_photo(np.round(np.clip(code, 0, 1) * 255).astype(np.uint8)))


def test_a_disc_in_a_night_sky_is_the_moon_and_no_sun():
    assert find(night_sky()) is None
    found = sun.find_moon(night_sky(), SKY)
    assert found is not None
    assert math.dist((found[0] * SIZE[0], found[1] * SIZE[1]), (200.5, 70.5)) < 1.5


def test_neither_a_lamp_nor_an_empty_night_nor_a_day_has_a_moon():
    post = SKY.copy()
    post[75:, 190:212] = 0
    assert sun.find_moon(night_sky(post=True), post) is None
    assert sun.find_moon(night_sky(disc=False), SKY) is None
    assert sun.find_moon(evening(disc=(90.5, 60.5)), SKY) is None


def test_a_found_moon_is_told_and_a_pointed_one_is_marked():
    picture = night_sky().bytes
    scene = sw.analyze(picture, sky=SKY)
    assert scene.sun is None
    assert any("(200, 70)" in note and "moon" in note for note in scene.warnings)
    dab = sw.Stroke("not_sky", ((0.1, 0.9),), 0.01)
    brushed = correct.corrected(scene, sw.Edit(strokes=(dab,)))
    assert any("(200, 70)" in note and "moon" in note for note in brushed.warnings)
    pointed = sw.analyze(picture, sky=SKY, sun=(200.5, 70.5))
    assert pointed.sun is not None
    assert pointed.sun.kind == "moon"
    assert any("may be the moon" in note for note in pointed.warnings)


def test_a_ragged_bright_spot_of_a_cloud_is_no_sun():
    picture = evening().bytes.copy()
    # Blossom: many small burnt specks, one of them round.
    for x, y in np.random.default_rng(5).integers((-14, -10), (15, 11), (60, 2)):
        cv2.circle(picture, (160 + int(x), 60 + int(y)), 1, (250, 250, 250), -1)
    cv2.circle(picture, (160, 60), 3, (255, 255, 255), -1)
    assert find(Working.of(open_photo(picture))) is None


def test_a_setting_sun_on_the_skyline_is_found_in_its_orange_sky():
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]] + 0.5
    distance = np.hypot(columns - 180.5, rows - 146.5)
    glow = np.exp(-distance / 110)[..., None]
    code = (1 - glow) * np.array([50, 60, 90]) / 255 + glow * np.array([255, 165, 25]) / 255
    code = np.where((distance < 3.1)[..., None], np.array([255, 250, 243]) / 255, code)
    code = np.where(SKY[..., None] > 0, code, 0.04)
    working = Working.of(open_photo(np.round(code * 255).astype(np.uint8)))
    found = find(working)
    assert found is not None
    assert math.dist(found[:2], (180.5, 146.5)) < 3


@pytest.mark.parametrize(("confidence", "certain"), [(0.9, False), (0.98, True)])
def test_a_sun_without_sky_beside_it_must_be_certain(monkeypatch, confidence, certain):
    # Sunlit snow shines like a sun (0.89), and so does one between leaves (0.99).
    working = evening(disc=(90.5, 60.5))
    beside = np.zeros_like(SKY)
    beside[:, 110:] = 1
    assert find(working) is not None
    peak = search.peak_of(look_for_sun(working), working)._replace(confidence=confidence)
    monkeypatch.setattr(search, "peak_of", lambda *_: peak)
    assert (find(working, beside) is not None) == certain
    beside[:, 98:] = 1
    assert find(working, beside) is not None
