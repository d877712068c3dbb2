"""Look of a before/after pair: no change from none, the pair's own on itself, no seams."""

import cv2
import numpy as np
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.errors import AnalysisError
from sunwidget.transfer.correspondence import correspond, normalization
from sunwidget.transfer.local_affine import apply, global_affine, limit_contrast_loss, local_affine

SIZE = (288, 192)


@pytest.fixture(scope="module")
def pictures():
    return {
        name: cv2.resize(sw.sample(name).encoded, SIZE, interpolation=cv2.INTER_AREA)
        for name in ("coast", "mountains", "meadow")
    }


def warmer(picture):
    """A change that is one affine of the encoded colors everywhere."""
    x = picture / 255
    return np.clip(np.round(255 * (x * [0.85, 0.7, 0.5] + [0.08, 0.03, 0.01])), 0, 255).astype(
        np.uint8
    )


def psnr(a, b):
    return 10 * np.log10(255**2 / np.mean((a.astype(float) - b) ** 2))


@pytest.mark.parametrize("name", ["coast", "mountains"])
def test_a_pair_that_did_not_change_changes_nothing(pictures, name):
    out = sw.transfer_look(pictures["meadow"], pictures[name], pictures[name].copy())
    # Sums of float32, and the dither of what is not the same to the last bit.
    assert np.abs(out.encoded.astype(int) - pictures["meadow"]).max() <= 1


def test_strength_0_is_the_photo_to_the_bit(pictures):
    photo, before = pictures["meadow"], pictures["coast"]
    assert np.array_equal(
        sw.transfer_look(photo, before, warmer(before), strength=0).encoded, photo
    )


def test_strength_grows_from_the_photo_to_the_look(pictures):
    photo, before = pictures["meadow"], pictures["coast"]
    changes = []
    for strength in (0.01, 0.5, 1.0):
        out = sw.transfer_look(photo, before, warmer(before), strength=strength).encoded
        changes.append(np.abs(out.astype(float) - photo).mean())
    assert changes[0] < 1.5
    assert 5 < changes[1] < 0.7 * changes[2]


@pytest.mark.parametrize("name", ["coast", "mountains", "meadow"])
def test_on_the_pairs_own_picture_an_affine_look_is_found_again(pictures, name):
    before = pictures[name]
    out = sw.transfer_look(before, before, warmer(before)).encoded
    assert psnr(out, warmer(before)) > 36
    assert psnr(out, warmer(before)) > psnr(before, warmer(before)) + 15


def test_looks_of_sky_and_land_are_learned_apart(pictures):
    """Sky darkened and reddened, land as it was: on its own picture each keeps to its part."""
    before = pictures["coast"]
    after = before.copy()
    after[:100] = warmer(after)[:100]
    out = sw.transfer_look(before, before, after).encoded
    assert psnr(out[:90], after[:90]) > 30
    assert psnr(out[125:], after[125:]) > 30


def test_another_photo_takes_the_direction_of_the_look(pictures):
    photo, before = pictures["meadow"], pictures["mountains"]
    out = sw.transfer_look(photo, before, warmer(before)).encoded
    wanted = warmer(photo).astype(float) - photo
    got = out.astype(float) - photo
    cosine = (wanted * got).sum() / np.sqrt((wanted**2).sum() * (got**2).sum())
    assert cosine > 0.9


def test_the_photos_detail_stays(pictures):
    """Fine texture before and after agrees in place, and is neither lost nor doubled."""
    photo, before = pictures["meadow"], pictures["mountains"]
    out = sw.transfer_look(photo, before, warmer(before)).encoded.astype(np.float32)

    def fine(picture):
        grey = picture.astype(np.float32).mean(-1)
        return (grey - cv2.GaussianBlur(grey, (0, 0), 1.5))[120:]

    mine, theirs = fine(photo), fine(out)
    assert np.corrcoef(mine.ravel(), theirs.ravel())[0, 1] > 0.97
    assert 0.5 < theirs.std() / mine.std() < 1.5


def test_the_change_has_no_seams(pictures):
    """On a smooth ramp the change is smooth too, whatever picture taught it."""
    ramp = np.linspace(60, 200, SIZE[0])[None, :, None] * np.ones((SIZE[1], 1, 3))
    before = pictures["mountains"]
    after = before.copy()
    after[:, ::2] = warmer(after)[:, ::2]
    after[60:] = warmer(after)[60:]
    out = sw.transfer_look((ramp / 255).astype(np.float32) ** 2.2, before, after).pixels
    code = np.clip(out, 0, 1) ** (1 / 2.2) * 255
    assert np.abs(np.diff(code, axis=0)).max() < 4
    assert np.abs(np.diff(code, axis=1)).max() < 6


def test_the_same_call_gives_the_same_bits(pictures):
    photo, before = pictures["meadow"], pictures["coast"]
    first, second = (sw.transfer_look(photo, before, warmer(before)).encoded for _ in range(2))
    assert np.array_equal(first, second)


def test_depth_and_metadata_are_the_photos(pictures):
    whole, before = sw.sample("harbour"), pictures["coast"]
    out = sw.transfer_look(whole, before, warmer(before))
    assert (out.size, out.exif, out.icc) == (whole.size, whole.exif, whole.icc)
    deep = pictures["meadow"].astype(np.uint16) * 257
    assert sw.transfer_look(deep, before, warmer(before)).encoded.dtype == np.uint16


def test_pairs_of_two_shapes_and_senseless_strengths_are_refused(pictures):
    with pytest.raises(AnalysisError, match="pixel by pixel"):
        sw.transfer_look(pictures["coast"], pictures["coast"], pictures["coast"][:100])
    with pytest.raises(AnalysisError, match="strength"):
        sw.transfer_look(pictures["coast"], pictures["coast"], pictures["coast"], strength=-1)


def test_a_local_affine_finds_an_affine_and_falls_back_to_the_global_one():
    rng = np.random.default_rng(7)
    x = rng.random((40, 60, 3)).astype(np.float32)
    x[:, 30:] = 0.4  # flat: says nothing
    matrix = np.array([[0.8, 0.1, 0], [0, 0.9, 0.05], [0.1, 0, 0.6]])
    y = (x @ matrix.T + [0.02, 0.05, 0.1]).astype(np.float32)
    found = local_affine(x, y, 4, 1e-3)
    assert np.abs(apply(found, x) - y).max() < 5e-3
    assert np.abs(found[20, 50, :, :3] - global_affine(x, y)[:, :3]).max() < 1e-3
    assert np.abs(global_affine(x, y)[:, :3] - matrix).max() < 0.02


def test_a_picture_corresponds_to_itself_pixel_by_pixel(pictures):
    picture = pictures["coast"].astype(np.float32) / 255
    sky = np.zeros(picture.shape[:2], np.float32)
    gain, shift = normalization(picture, sky, picture, sky)
    assert np.abs(gain - 1).max() < 1e-6
    assert np.abs(shift).max() < 1e-6
    found = correspond(picture, sky, picture, sky)
    assert np.array_equal(found.index[..., 0].ravel(), np.arange(sky.size))
    assert np.abs(found.carry(picture) - picture).mean() < 2e-3


def test_a_time_lapse_pair_is_carried_to_its_own_frame(shared):
    """Between two real frames: much nearer than the frame itself (16 dB to 27 dB when measured)."""
    folder = shared / "data" / "timelapse" / "684"
    if not folder.is_dir():
        pytest.skip("no time-lapse frames in the shared folder")
    before, after = (
        np.asarray(Image.open(folder / f"{name}.jpg").convert("RGB"))
        for name in ("20120603_134139", "20120602_234143")
    )
    out = sw.transfer_look(before, before, after).encoded
    assert psnr(out, after) > psnr(before, after) + 9


def test_no_transform_flattens_or_inverts():
    rng = np.random.default_rng(11)
    matrix = rng.normal(0, 0.8, (20, 30, 3, 4)).astype(np.float32)
    pivot = rng.random((20, 30, 3)).astype(np.float32)
    kept = limit_contrast_loss(matrix, pivot)
    symmetric = (kept[..., :3] + np.swapaxes(kept[..., :3], -1, -2)) / 2
    assert np.linalg.eigvalsh(symmetric)[..., 0].min() > 0.44
    assert np.abs(apply(kept, pivot) - apply(matrix, pivot)).max() < 1e-4
    good = np.zeros((2, 2, 3, 4), np.float32)
    good[..., :3] = np.diag([0.6, 0.9, 1.3])
    assert np.array_equal(limit_contrast_loss(good, pivot[:2, :2]), good)


def test_clouds_that_moved_do_not_turn_dark(pictures):
    """A pair whose clouds have gone elsewhere: white stays brighter than the blue round it."""
    rng = np.random.default_rng(2)

    def sky(seed):
        noise = np.random.default_rng(seed).random((SIZE[1], SIZE[0])).astype(np.float32)
        cloud = np.clip(60 * (cv2.GaussianBlur(noise, (0, 0), 9) - 0.5) + 0.3, 0, 1)[..., None]
        land = (np.arange(SIZE[1]) > 140)[:, None, None]
        view = cloud * 235 + (1 - cloud) * np.array([70, 120, 200])
        return np.where(land, 60 + 20 * rng.random((SIZE[1], SIZE[0], 1)), view).astype(np.uint8)

    photo = sky(1)
    out = sw.transfer_look(photo, sky(2), sky(3)).encoded[:120]
    white, blue = photo[:120, :, 0] > 200, photo[:120, :, 0] < 90
    assert min(white.sum(), blue.sum()) > 500
    assert out[white].mean() > out[blue].mean() + 20
