"""The contract of the public names, checked from outside with the bundled samples."""

import importlib
import itertools

import cv2
import numpy as np
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.edit.table import METHODS
from sunwidget.samples import NAMES


@pytest.fixture(scope="module", params=NAMES)
def any_scene(request):
    return sw.analyze(sw.sample(request.param))


@pytest.fixture(scope="module")
def coast():
    return sw.analyze(sw.sample("coast"))


SMALL = (192, 128)


def test_unmoved_sun_changes_no_pixel(any_scene):
    photo = any_scene.photo.encoded.astype(int)
    assert np.abs(sw.render(any_scene, sw.Edit()).astype(int) - photo).max() <= 1


def test_unmoved_sun_changes_no_16_bit_pixel(any_scene):
    photo = any_scene.photo.encoded.astype(int) * 257
    out = sw.render(any_scene, sw.Edit(), dtype="uint16")
    # 4/65535: float32 light and back, and a fraction of a level of dither.
    assert np.abs(out.astype(int) - photo).max() <= 4


@pytest.mark.parametrize("name", ["sun_azimuth", "sun_elevation"])
def test_naming_the_photos_own_value_moves_nothing(any_scene, name):
    edit = sw.Edit(**{name: any_scene.automatic[name]})
    unmoved = any_scene.photo.encoded.astype(int)
    assert np.abs(sw.render(any_scene, edit).astype(int) - unmoved).max() <= 1


def test_every_map_has_the_photos_shape_and_lies_in_0_to_1(any_scene):
    shape = any_scene.photo.encoded.shape[:2]
    for name in ("sky", "sky_coarse", "clouds", "cloud_softness", "water"):
        found = getattr(any_scene, name)
        assert found.shape == shape
        assert found.dtype == np.float32
        assert found.min() >= 0
        assert found.max() <= 1
    assert any_scene.depth.shape == shape


# Where the path tracer put the sun of these two, in pixels.
SUNS = {"coast.jpg": (952.6, 309.7), "mountains.jpg": (905.9, 322.9)}


def test_the_samples_own_sun_is_found(any_scene):
    if any_scene.photo.name not in SUNS:
        pytest.skip("no true position is on record for this sample")
    assert any_scene.sun is not None
    assert any_scene.sun.visible
    # Half of the disc's radius, 0.27° of 42° in 1024 rows.
    assert (any_scene.sun.x, any_scene.sun.y) == pytest.approx(SUNS[any_scene.photo.name], abs=3)


def test_sun_and_clouds_belong_to_the_sky(any_scene, shared):
    """Holes in the sky show as patches that do not follow the sun."""
    name = any_scene.photo.name.removesuffix(".jpg")
    path = shared / "samples" / name / f"{name}_sky.png"
    if not path.exists():
        pytest.skip("no true mask is on record for this sample")
    found = any_scene.sky > 0.5
    true = np.asarray(Image.open(path).convert("L").resize(found.shape[::-1])) > 127
    # Below this, whole clouds are missing; far hazy mountains that pass for sky cost 5 %.
    assert (found & true).sum() / (found | true).sum() > 0.93


def test_the_sky_is_above_and_the_land_below(any_scene):
    rows = any_scene.sky.shape[0]
    assert any_scene.sky[: rows // 8].mean() > 0.9
    assert any_scene.sky[-rows // 8 :].mean() < 0.1


def test_the_camera_takes_a_pixel_to_a_direction_and_back_also_outside(coast):
    for x, y in ((10.0, 20.0), (1500.0, 900.0), (-300.0, 1400.0)):
        assert coast.camera.pixel(*coast.camera.angles(x, y)) == pytest.approx((x, y), abs=1e-3)


def test_the_horizon_lies_at_elevation_zero(any_scene):
    camera, horizon = any_scene.camera, any_scene.horizon
    assert camera.angles(camera.width / 2, horizon.row)[1] == pytest.approx(0, abs=0.01)


@pytest.mark.parametrize("dtype", ["uint8", "uint16", "float32"])
def test_render_returns_the_asked_type_at_full_size(coast, dtype):
    out = sw.render(coast, sw.Edit(sun_elevation=4), dtype=dtype)
    assert out.shape == coast.photo.encoded.shape
    assert out.dtype == dtype
    assert np.isfinite(out).all()


def test_types_agree_with_one_another(coast):
    edit = sw.Edit(sun_elevation=4)
    eight = sw.render(coast, edit, size=SMALL).astype(float)
    sixteen = sw.render(coast, edit, size=SMALL, dtype="uint16") / 257
    light = np.clip(sw.render(coast, edit, size=SMALL, dtype="float32"), 0, 1)
    encoded = np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055) * 255
    # Half a level of rounding and half a level of dither.
    assert np.abs(eight - sixteen).max() <= 1.01
    assert np.abs(encoded - sixteen).max() <= 0.02


@pytest.mark.parametrize("size", [(192, 128), (101, 77), (1, 1), (2, 300)])
def test_render_returns_the_asked_size(coast, size):
    assert sw.render(coast, sw.Edit(sun_elevation=4), size=size).shape == (size[1], size[0], 3)


@pytest.mark.parametrize("method", METHODS)
def test_a_picture_drawn_in_bands_is_the_picture_drawn_at_once(coast, monkeypatch, method):
    module = importlib.import_module("sunwidget.renderer.offscreen")  # a function hides it

    edit = sw.Edit(sun_elevation=4, method=method)
    whole = sw.render(coast, edit, size=SMALL)
    monkeypatch.setattr(module, "_BAND_PIXELS", 5000)
    assert np.array_equal(sw.render(coast, edit, size=SMALL), whole)


@pytest.mark.parametrize("bad", [{"dtype": "int7"}, {"size": (0, 5)}, {"method": "magic"}])
def test_render_refuses_what_it_does_not_know(coast, bad):
    with pytest.raises(sw.EditError):
        sw.render(coast, sw.Edit(), **bad)


def test_the_method_can_be_named_in_the_edit_or_the_call(coast):
    for method in METHODS:
        by_edit = sw.render(coast, sw.Edit(sun_elevation=4, method=method), size=SMALL)
        by_call = sw.render(coast, sw.Edit(sun_elevation=4), method=method, size=SMALL)
        assert np.array_equal(by_edit, by_call)


def test_methods_differ_once_the_sun_moves(coast):
    edit = sw.Edit(sun_elevation=4)
    ratio, thesis, literal = (
        sw.render(coast, edit, size=SMALL, method=method).astype(int) for method in METHODS
    )
    assert np.abs(ratio - thesis).mean() > 1
    assert np.abs(thesis - literal).mean() > 1


@pytest.mark.parametrize("method", METHODS)
def test_going_elsewhere_and_back_gives_the_same_picture_to_the_bit(coast, method):
    here, there = sw.Edit(sun_elevation=2, method=method), sw.Edit(sun_azimuth=40, method=method)
    first = sw.render(coast, here, size=SMALL)
    elsewhere = sw.render(coast, there, size=SMALL)
    assert not np.array_equal(first, elsewhere)
    assert np.array_equal(first, sw.render(coast, here, size=SMALL))


def test_every_strength_at_zero_gives_the_photo_back(coast):
    off = sw.Edit(
        sun_elevation=1,
        sun_size=0,
        sky_strength=0,
        cloud_strength=0,
        land_strength=0,
        auto_exposure=0,
    )
    photo = coast.photo.encoded.astype(int)
    assert np.abs(sw.render(coast, off).astype(int) - photo).max() <= 1


@pytest.mark.parametrize("elevation", [-12, -4, 0, 1, 10, 45, 90])
@pytest.mark.parametrize("azimuth", [-180, -60, 0, 25, 180])
def test_no_sun_breaks_the_picture(coast, elevation, azimuth):
    edit = sw.Edit(sun_elevation=elevation, sun_azimuth=azimuth)
    out = sw.render(coast, edit, size=SMALL, dtype="float32")
    assert np.isfinite(out).all()
    # A hundredth below black: colors outside Rec. 709, cut off when the picture is encoded.
    assert out.min() >= -1e-2


@pytest.mark.parametrize("azimuth", [90, 140])
def test_the_land_does_not_brighten_as_the_sun_sinks(any_scene, azimuth):
    """Monotony with the exposure locked; beside the frame, where no cloud hides the sun."""
    weight = 1 - cv2.resize(any_scene.sky, SMALL, interpolation=cv2.INTER_AREA)
    levels = []
    for elevation in (60, 30, 12, 6, 3, 1, 0, -2, -6, -12):
        edit = sw.Edit(sun_azimuth=azimuth, sun_elevation=elevation, auto_exposure=0)
        picture = sw.render(any_scene, edit, size=SMALL, dtype="float32")
        levels.append(float((picture.mean(-1) * weight).sum() / weight.sum()))
    assert all(lower < higher for higher, lower in itertools.pairwise(levels))


def test_code_of_an_edit_runs_and_gives_the_same_edit():
    edit = sw.Edit(
        sun_elevation=2.5,
        sun_azimuth=-7,
        method="thesis",
        strokes=(sw.Stroke("not_sky", ((0.1, 0.2), (0.3, 0.4)), radius=0.02),),
        horizon_hint=((0.0, 0.5), (1.0, 0.52)),
    )
    assert eval(edit.to_code(), {"sw": sw}) == edit


def test_recipe_of_an_edit_gives_the_same_edit():
    edit = sw.Edit(sun_elevation=2.5, exposure=-0.5, sun_hint=(0.4, -0.2))
    assert sw.Edit.from_dict(edit.to_dict()) == edit
    assert sw.Edit.from_json(edit.to_json()) == edit


def test_hints_win_over_detection():
    scene = sw.analyze(sw.sample("coast"), sun=(300, 200), horizon=600, fov=38)
    assert (scene.sun.x, scene.sun.y) == pytest.approx((300, 200), abs=1)
    assert scene.horizon.row == pytest.approx(600)
    assert scene.camera.fov_vertical_deg == pytest.approx(38)
    assert scene.automatic["sun_azimuth"] == pytest.approx(scene.camera.angles(300, 200)[0])


def test_a_mask_for_the_sky_is_kept_where_it_is_certain():
    mask = np.zeros((1024, 1536), np.float32)
    mask[:600] = 1
    scene = sw.analyze(sw.sample("coast"), sky=mask)
    assert np.array_equal(scene.sky_coarse, mask)
    assert scene.sky[:300].min() > 0.99
    assert scene.sky[-300:].max() < 0.01


def test_progress_runs_from_0_to_1_and_never_back():
    seen = []
    sw.analyze(sw.sample("meadow"), progress=lambda fraction, message: seen.append(fraction))
    assert seen == sorted(seen)
    assert seen[0] == 0
    assert seen[-1] == 1


def test_raising_in_progress_cancels_a_render(coast):
    class CancelledError(Exception):
        pass

    def cancel(_fraction, _message):
        raise CancelledError

    with pytest.raises(CancelledError):
        sw.render(coast, sw.Edit(sun_elevation=3), progress=cancel)
    assert sw.render(coast, sw.Edit(sun_elevation=3), size=SMALL).shape == (128, 192, 3)


def test_a_still_on_disk_is_the_rendered_frame(coast, tmp_path):
    edit = sw.Edit(sun_elevation=3)
    path = sw.save((coast, edit), tmp_path / "out.png")
    assert np.array_equal(sw.open(path).encoded, sw.render(coast, edit))


def test_a_still_is_never_replaced_unasked(coast, tmp_path):
    path = tmp_path / "out.png"
    path.write_bytes(b"mine")
    with pytest.raises(FileExistsError):
        sw.save((coast, sw.Edit()), path)
    assert path.read_bytes() == b"mine"


def test_a_sweep_of_a_real_scene_moves(coast, tmp_path):
    ends = [sw.Edit(sun_elevation=15), sw.Edit(sun_elevation=-3)]
    path = sw.sweep(coast, ends, tmp_path / "film.webp", frames=3, size=SMALL)
    with Image.open(path) as film:
        means = []
        for frame in range(3):
            film.seek(frame)
            means.append(np.asarray(film.convert("RGB"), float).mean((0, 1)))
    assert np.abs(means[0] - means[2]).max() > 5


def test_the_teaching_widget_needs_no_photo():
    explorer = sw.SkyExplorer(sun_elevation=3, projection="panorama")
    picture = explorer.render(size=SMALL)
    assert picture.shape == (128, 192, 3)
    explorer.sun_elevation = -4
    assert np.abs(explorer.render(size=SMALL).astype(int) - picture).mean() > 3
    again = eval(explorer.code(), {"sw": sw})
    assert np.array_equal(again.render(size=SMALL), explorer.render(size=SMALL))
