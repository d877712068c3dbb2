"""Domes: the photo's own sky where it is seen, a seamless one elsewhere, and one sun."""

import json

import cv2
import numpy as np
import pytest

import sunwidget as sw
from sunwidget.cli.main import main
from sunwidget.dome.sphere import angles, distance, irradiance, solid_angles
from sunwidget.errors import PhotoError
from sunwidget.export.dome.light import dome_light
from sunwidget.export.dome.mirror import mirror_of
from sunwidget.export.dome.picture import light_of
from sunwidget.formats.color import LUMINANCE
from sunwidget.geometry.camera import Camera

WIDTH = 512
MOVED = sw.Edit(sun_azimuth=100, sun_elevation=25)


@pytest.fixture(scope="module")
def scene():
    small = cv2.resize(sw.sample("coast").encoded, (384, 256), interpolation=cv2.INTER_AREA)
    return sw.analyze(small)


def made(scene, edit, width=WIDTH):
    try:
        return dome_light(scene, edit, width)
    except sw.RendererError as error:
        pytest.skip(f"no GL on this machine: {error}")


@pytest.fixture(scope="module")
def moved(scene):
    return made(scene, MOVED)


def test_what_the_photo_sees_is_the_photos_own(scene):
    dome = made(scene, sw.Edit())
    azimuth, elevation = angles(WIDTH)
    x, y = scene.camera.pixel(azimuth, elevation)
    own = dome.seen > 0.99
    assert own.sum() > 500
    at = x[own].astype(int), y[own].astype(int)
    photo = light_of(scene, scene.photo.pixels)[at[1], at[0]] @ LUMINANCE
    ratio = (dome.sky[own] @ LUMINANCE) / photo
    # A pixel of the dome is several of the photo's, whose clouds have edges.
    assert np.median(ratio) == pytest.approx(1, abs=0.02)
    assert np.mean(np.abs(ratio - 1) < 0.1) > 0.9


def test_a_locked_exposure_keeps_the_scale(scene, moved):
    """The dome of a brighter edit is no brighter: exposure is a camera's, not the sky's."""
    brighter = made(scene, MOVED.replace(exposure=2, glow=3))
    np.testing.assert_allclose(brighter.sky, moved.sky, rtol=1e-4, atol=1e-5)


def test_the_sun_stands_once_and_where_the_edit_has_it(scene, moved):
    azimuth, elevation = angles(WIDTH)
    light = moved.sky + moved.disc
    row, column = np.unravel_index(np.argmax(light @ LUMINANCE), light.shape[:2])
    assert azimuth[row, column] == pytest.approx(100, abs=0.8)
    assert elevation[row, column] == pytest.approx(25, abs=0.8)
    # Where the photo's own sun stood the sky is no brighter than round it.
    level = moved.sky @ LUMINANCE
    apart = distance((scene.sun.azimuth, scene.sun.elevation), azimuth, elevation)
    assert level[apart < 3].mean() < 1.3 * level[(apart > 6) & (apart < 10)].mean()


def test_the_disc_gives_the_models_light_22_stops_above_the_dark(moved):
    solid = solid_angles(WIDTH)[..., None]
    np.testing.assert_allclose((moved.disc * solid).sum((0, 1)), moved.direct, rtol=1e-4)
    assert 20 < moved.direct[1] < 130  # klx of a clear day
    # At half a degree a pixel the disc is spread over 0.7°; its own radiance is told by its light.
    radiance = moved.direct[1] / (np.pi * np.radians(0.2665) ** 2)
    assert radiance > 65504  # kcd m⁻², beyond half floats


def test_there_is_no_seam(scene, moved):
    level = np.log2(np.maximum(moved.sky[: WIDTH // 4] @ LUMINANCE, 1e-6))
    # Behind the camera, where the first and the last column meet.
    behind = np.abs(level[:, 0] - level[:, -1])
    beside = np.abs(np.diff(level, axis=1))
    assert np.quantile(behind, 0.9) < 2 * np.quantile(beside, 0.99)
    # Along the border of the picture the step is no larger than clouds make elsewhere.
    azimuth, elevation = angles(WIDTH)
    x, _ = scene.camera.pixel(azimuth[: WIDTH // 4], elevation[: WIDTH // 4])
    border = np.diff((x > 0) & (x < scene.camera.width), axis=1)
    assert np.median(beside[border]) < 2 * np.median(beside) + 0.05


def test_the_ground_reflects_what_falls_on_it(moved):
    sky = moved.sky.copy()
    sky[WIDTH // 4 :] = 0
    lit = irradiance(sky) + np.sin(np.radians(25)) * moved.direct
    np.testing.assert_allclose(moved.sky[-1, 0], moved.albedo * lit / np.pi, rtol=1e-3)
    assert np.all((moved.albedo >= 0.03) & (moved.albedo <= 0.7))


def test_a_veiled_sun_gives_no_light(scene):
    assert made(scene, MOVED.replace(sun_visibility=0), 64).direct.max() == 0


def test_a_picture_without_sky_has_the_model_alone():
    rng = np.random.default_rng(3)
    scene = sw.analyze(rng.integers(20, 90, (64, 96, 3), dtype=np.uint8), sky=np.zeros((64, 96)))
    dome = made(scene, sw.Edit(), 64)
    assert not dome.mirrored
    assert dome.seen.max() == 0
    assert np.isfinite(dome.sky).all()


def test_an_even_dome_lights_every_plane_alike():
    even = np.ones((64, 128, 3))
    for normal in ((0, 0, 1), (1, 0, 0), (0, -1, 0), (0.6, 0, 0.8)):
        np.testing.assert_allclose(irradiance(even, normal), np.pi, rtol=2e-3)


@pytest.mark.parametrize("fov", [20, 45, 70])
def test_the_mirror_goes_on_at_the_pictures_edges_and_meets_behind(fov):
    camera = Camera(600, 400, fov, pitch=fov / 4)
    mirror = mirror_of(camera)
    heights = np.linspace(1, mirror.top - 1, 20)
    for x in (0, camera.width):
        edge = np.array([mirror._edges_at(h)[0 if x == 0 else 1] for h in heights])
        inside, outside = (mirror.around(edge + side, heights)[0] for side in (-0.01, 0.01))
        np.testing.assert_allclose(inside, outside, atol=0.1)
    behind = [mirror.around(np.full(20, a), heights)[0] for a in (-180.0, 180.0)]
    np.testing.assert_allclose(*behind, atol=1e-6)
    shown = camera.pixel(*mirror.overhead(*np.meshgrid(np.arange(-180, 180, 7.0), [60, 75, 89.0])))
    assert np.nanmin(shown[0]) > -1
    assert np.nanmax(shown[0]) < camera.width + 1


def test_a_camera_without_sky_has_no_mirror():
    assert mirror_of(Camera(600, 400, 30, pitch=-30)) is None
    assert mirror_of(Camera(600, 400, 60, pitch=80)) is None


@pytest.mark.parametrize("sun", [True, False])
def test_the_files_say_what_they_hold(tmp_path, scene, sun):
    try:
        path = sw.to_dome(scene, MOVED, tmp_path / "sky.hdr", width=256, sun=sun)
    except sw.RendererError as error:
        pytest.skip(f"no GL on this machine: {error}")
    facts = json.loads((tmp_path / "sky.json").read_text("utf-8"))
    assert facts["dome"] == "sky.hdr"
    assert facts["sun"]["in_the_map"] is sun
    up, across = np.radians(25), np.radians(100)
    toward = [np.cos(up) * np.cos(across), -np.cos(up) * np.sin(across), np.sin(up)]
    np.testing.assert_allclose(facts["sun"]["direction"], toward, atol=1e-4)
    assert facts["sun"]["angular_diameter_deg"] == pytest.approx(0.533, abs=0.001)
    assert facts["sun"]["illuminance_lux"] == pytest.approx(
        1000 * np.array(facts["sun"]["irradiance"]) @ LUMINANCE, rel=1e-4
    )
    assert 0 < facts["sky"]["seen_share_of_sky"] < 0.2
    assert facts["sky"]["seen_share_of_sky"] + facts["sky"]["modelled_share_of_sky"] == 1
    assert facts["camera"]["fov_vertical_deg"] == pytest.approx(
        scene.camera.fov_vertical_deg, abs=1e-3
    )
    photo = sw.open(path)
    assert photo.size == (256, 128)
    assert photo.recipe == MOVED
    # At 1.4° a pixel the disc is a seventh as bright as it is, and still far above its sky.
    assert (photo.pixels.max() > 5000) == sun
    with pytest.raises(FileExistsError):
        sw.to_dome(scene, MOVED, path, width=256)


def test_openexr_has_floats_that_hold_the_sun(tmp_path, scene):
    OpenEXR = pytest.importorskip("OpenEXR")
    try:
        path = sw.to_dome(scene, MOVED, tmp_path / "sky.exr", width=1024)
    except sw.RendererError as error:
        pytest.skip(f"no GL on this machine: {error}")
    file = OpenEXR.File(str(path), separate_channels=True)
    header, red = file.header(), file.channels()["R"].pixels
    assert header["envmap"] == OpenEXR.ENVMAP_LATLONG
    assert header["whiteLuminance"] == 1000
    assert json.loads(header["sunwidget.dome"])["dome"] == "sky.exr"
    assert red.dtype == np.float32
    assert red.max() > 1e5


def test_what_is_no_dome_is_refused_before_the_work(tmp_path, scene):
    with pytest.raises(PhotoError, match=r"must end in \.hdr or \.exr"):
        sw.to_dome(scene, None, tmp_path / "sky.png")
    for width in (5, 2, 99_999, "wide", 10.5):
        with pytest.raises(PhotoError, match="twice as wide as high"):
            sw.to_dome(scene, None, tmp_path / "sky.hdr", width=width)
    (tmp_path / "sky.json").write_text("{}")
    with pytest.raises(FileExistsError, match=r"sky\.json"):
        sw.to_dome(scene, None, tmp_path / "sky.hdr")
    assert [path.name for path in tmp_path.iterdir()] == ["sky.json"]


def test_the_command_line_writes_both_files(tmp_path, capsys):
    photo, out = tmp_path / "beach.png", tmp_path / "sky.hdr"
    small = cv2.resize(sw.sample("coast").encoded, (96, 64), interpolation=cv2.INTER_AREA)
    cv2.imwrite(str(photo), small[..., ::-1])
    command = ["dome", str(photo), "--sun-elevation", "12", "--width", "128", "-o", str(out)]
    if main([*command, "--no-sun"]) != 0 and "OpenGL" in capsys.readouterr().err:
        pytest.skip("no GL on this machine")
    said = capsys.readouterr().out
    assert "sky.hdr" in said
    assert "sky.json" in said
    facts = json.loads((tmp_path / "sky.json").read_text("utf-8"))
    assert facts["sun"]["elevation_deg"] == 12
    assert not facts["sun"]["in_the_map"]
    assert sw.open(out).size == (128, 64)
    assert main(command) == 2
    assert "exists already" in capsys.readouterr().err
