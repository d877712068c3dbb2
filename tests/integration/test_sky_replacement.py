"""Sky from another photo: horizon and sun where both cameras say, land that follows, no ghosts."""

import cv2
import numpy as np
import pytest
from PIL import Image
from relight_scenes import sample_scene

import sunwidget as sw
from sunwidget.errors import AnalysisError
from sunwidget.transfer.donor_sky import directions, donor_sky

SIZE = (384, 256)


@pytest.fixture(scope="module")
def scenes():
    return {name: sample_scene(name, 384) for name in ("coast", "mountains", "meadow")}


def linear(codes):
    x = codes.astype(np.float64) / np.iinfo(codes.dtype).max
    return np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)


def sure_sky(scene):
    return cv2.erode((scene.sky > 0.99).astype(np.uint8), np.ones((21, 21), np.uint8)) > 0


def sure_land(scene):
    return scene.sky == 0


def test_a_photos_own_sky_gives_the_photo_back(scenes):
    """Donor and photo agree in every direction: what is looked up is what was there."""
    scene = scenes["coast"]
    out = sw.replace_sky(scene, scene, strength=0)
    error = np.abs(out.encoded.astype(int) - scene.photo.encoded)
    # Two float curves and the dither of changed pixels: a level.
    assert error[sure_sky(scene)].max() <= 2
    # Soft edges are taken apart and put together again, with the skyline continued a little.
    assert error.mean() < 1.5


def test_own_land_keeps_its_codes_at_strength_0(scenes):
    scene = scenes["coast"]
    out = sw.replace_sky(scene, scenes["mountains"], strength=0)
    land = sure_land(scene)
    assert land.mean() > 0.2
    assert np.array_equal(out.encoded[land], scene.photo.encoded[land])
    assert np.abs(out.encoded.astype(int) - scene.photo.encoded)[sure_sky(scene)].mean() > 3


def test_the_donors_sun_stands_where_both_cameras_say(scenes):
    scene, donor = scenes["meadow"], scenes["coast"]
    out = sw.replace_sky(scene, donor)
    x, y = scene.camera.pixel(donor.sun.azimuth, donor.sun.elevation)
    assert out.sun == pytest.approx((x, y))
    light = linear(out.encoded)
    around = light[int(y) - 2 : int(y) + 3, int(x) - 2 : int(x) + 3].max()
    assert around > 0.9
    assert around > 1.2 * np.median(light[sure_sky(scene)])


def test_turning_moves_the_sky_by_as_many_degrees(scenes):
    scene, donor = scenes["meadow"], scenes["coast"]
    out = sw.replace_sky(scene, donor, turn=12)
    azimuth, elevation = scene.camera.angles(*out.sun)
    assert azimuth == pytest.approx(donor.sun.azimuth - 12, abs=1e-6)
    assert elevation == pytest.approx(donor.sun.elevation, abs=1e-6)
    light = linear(out.encoded).min(-1) * sure_sky(scene)
    row, column = np.unravel_index(cv2.blur(light, (5, 5)).argmax(), light.shape)
    assert np.hypot(column - out.sun[0], row - out.sun[1]) < 12


def test_the_result_can_be_analysed_and_its_sun_moved(scenes):
    out = sw.replace_sky(scenes["meadow"], scenes["coast"])
    scene = sw.analyze(out, sky=scenes["meadow"].sky, refine="none")
    assert (scene.sun.x, scene.sun.y) == pytest.approx(out.sun)
    moved = sw.render(scene, sw.Edit(sun_azimuth=scene.sun.azimuth + 15))
    assert np.abs(moved.astype(int) - out.encoded).mean() > 1


def test_a_hint_wins_over_the_sun_that_the_photo_carries(scenes):
    out = sw.replace_sky(scenes["meadow"], scenes["coast"])
    scene = sw.analyze(out, sun=(5, 6), sky=scenes["meadow"].sky, refine="none")
    assert (scene.sun.x, scene.sun.y) == pytest.approx((5, 6))


@pytest.mark.parametrize("turn", [0, 40, 110, 180, -75])
def test_the_sky_goes_on_where_the_donor_ends_without_a_seam(scenes, turn):
    """No step beside the donor's frame that is sharper than what its sky holds itself."""
    donor = scenes["coast"]
    sky = donor_sky(donor, donor.camera.focal)
    fov = 2 * np.degrees(np.arctan(150 / donor.camera.focal))  # as fine as the donor
    wide = sw.Camera(700, 300, fov, pitch=fov / 2 + 1)
    seen = sky.look_up(*directions(wide, (700, 300), slice(None), turn))
    assert np.isfinite(seen).all()
    logs = np.log(np.maximum(cv2.GaussianBlur(seen, (0, 0), 1.5), 1e-3))
    own = np.log(np.maximum(cv2.GaussianBlur(linear(donor.photo.encoded), (0, 0), 1.5), 1e-3))
    inside = sure_sky(donor)[:, 1:]
    sharpest = np.abs(np.diff(own, axis=1))[inside].max()
    assert np.abs(np.diff(logs, axis=1)).max() < 1.2 * sharpest + 0.02


def test_the_mirrored_sky_beside_the_frame_has_no_second_sun(scenes):
    """The mirrored sky beside the frame is without the sun."""
    donor = scenes["coast"]
    sky = donor_sky(donor, donor.camera.focal)
    edge = float(donor.camera.angles(donor.width, donor.horizon.row)[0])
    twin = 2 * edge - donor.sun.azimuth  # where a mirror at the frame's edge would show it
    near = np.linspace(-2, 2, 9)
    azimuth, elevation = np.meshgrid(twin + near, donor.sun.elevation + near)
    mirrored = sky.look_up(azimuth, elevation).min(-1)
    real = sky.look_up(azimuth - twin + donor.sun.azimuth, elevation).min(-1)
    assert real.max() > 0.9
    assert mirrored.max() < 0.8 * real.max()


def dusk(donor, level):
    """The donor as if it were much darker and redder."""
    light = linear(donor.photo.encoded) * np.array([1.0, 0.55, 0.35]) * level
    return sw.analyze(
        light.astype(np.float32),
        sun=(donor.sun.x, donor.sun.y),
        horizon=donor.horizon.row,
        fov=donor.camera.fov_vertical_deg,
        sky=donor.sky,
        refine="none",
    )


def test_a_darker_sky_gives_darker_land_and_more_so_with_strength(scenes):
    scene, land = scenes["meadow"], sure_land(scenes["meadow"])
    levels = []
    donor = dusk(scenes["coast"], 0.06)
    for strength in (0.0, 0.5, 1.0):
        out = sw.replace_sky(scene, donor, strength=strength)
        levels.append(linear(out.encoded)[land].mean())
    assert levels[0] > 1.3 * levels[1] > 1.3 * 1.2 * levels[2]


def test_the_land_takes_the_tint_of_the_new_light(scenes):
    scene, land = scenes["mountains"], sure_land(scenes["mountains"])
    before = linear(scene.photo.encoded)[land].mean(0)
    after = linear(sw.replace_sky(scene, dusk(scenes["coast"], 0.3)).encoded)[land].mean(0)
    assert after[0] / after[2] > 1.15 * before[0] / before[2]


def test_twigs_lose_the_old_skys_tint():
    """Thin dark things before a blue sky, put before a red one, hold no blue rim."""
    rng = np.random.default_rng(3)
    height, width = 160, 240
    matte = np.ones((height, width), np.float32)
    matte[120:] = 0
    twigs = cv2.GaussianBlur((rng.random((height, width)) < 0.2).astype(np.float32), (0, 0), 1)
    matte[30:120, 50:190] = np.clip(1.4 - 3 * twigs[30:120, 50:190], 0, 1)
    blue, red, bark = np.array([0.15, 0.3, 0.8]), np.array([0.8, 0.3, 0.1]), np.array([0.02] * 3)

    def picture(sky):
        return (matte[..., None] * sky + (1 - matte[..., None]) * bark).astype(np.float32)

    hints = {"horizon": 120.0, "fov": 45.0, "refine": "none"}
    scene = sw.analyze(picture(blue), sky=matte, **hints)
    above = (width / 2, -3.0 * height)  # an even sky has its sun far from what is seen
    donor = sw.analyze(picture(red), sky=(matte > 0.5) * np.float32(1), sun=above, **hints)
    out = sw.replace_sky(scene, donor, strength=0).pixels
    edge = (matte > 0.1) & (matte < 0.9)
    assert edge.sum() > 1000
    true = picture(red)
    # The donor's sky is fitted and filled, not this red to the last digit.
    assert np.abs(out - true)[edge].mean() < 0.04
    # Put in by the matte alone, a rim keeps what blue light shone past the twigs.
    by_matte = matte[..., None] * red + (1 - matte[..., None]) * picture(blue)
    kept = (by_matte[..., 2] - true[..., 2])[edge].mean()
    assert kept > 0.05
    assert abs((out[..., 2] - true[..., 2])[edge].mean()) < 0.2 * kept


def test_depth_profile_and_metadata_are_the_first_photos(scenes):
    donor = scenes["mountains"]
    whole = sw.sample("meadow")
    out = sw.replace_sky(whole, donor)
    assert out.size == whole.size
    assert out.exif == whole.exif
    assert (out.icc, out.profile) == (whole.icc, whole.profile)
    sixteen = Image.fromarray(cv2.resize(whole.encoded, SIZE)).convert("RGB")
    deep = sw.open(np.asarray(sixteen).astype(np.uint16) * 257)
    assert sw.replace_sky(deep, donor).encoded.dtype == np.uint16
    light = sw.open(linear(np.asarray(sixteen)).astype(np.float32))
    assert sw.replace_sky(light, donor).encoded.dtype == np.float32


@pytest.mark.parametrize("bad", [{"strength": 2}, {"strength": "much"}, {"turn": float("nan")}])
def test_what_makes_no_sense_is_refused(scenes, bad):
    with pytest.raises(AnalysisError, match=next(iter(bad))):
        sw.replace_sky(scenes["coast"], scenes["coast"], **bad)


def test_photos_without_sky_are_refused_by_name(scenes):
    indoors = sw.analyze(np.full((64, 96, 3), 90, np.uint8), sky=np.zeros((64, 96), np.float32))
    with pytest.raises(AnalysisError, match="No sky to take"):
        sw.replace_sky(scenes["coast"], indoors)
    with pytest.raises(AnalysisError, match="No sky to replace"):
        sw.replace_sky(indoors, scenes["coast"])
