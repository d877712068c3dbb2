"""Environment maps: the sun where the edit has it, and as much light as the model gives."""

import cv2
import numpy as np
import pytest

import sunwidget as sw
from sunwidget.atmosphere.color import spectral_to_rec709
from sunwidget.atmosphere.sky import SkyTable
from sunwidget.atmosphere.sun import disc_radiance
from sunwidget.errors import PhotoError
from sunwidget.export.environment import environment

SIZE = (256, 128)


@pytest.fixture(scope="module")
def scene():
    small = cv2.resize(sw.sample("coast").encoded, (96, 64), interpolation=cv2.INTER_AREA)
    return sw.analyze(small)


def made(scene, edit, size=SIZE, **options):
    try:
        return environment(scene, edit, size, **options).astype(float)
    except sw.RendererError as error:
        pytest.skip(f"no GL on this machine: {error}")


def angles(size=SIZE):
    """Azimuth and elevation in degrees of the pixels' centres, and their steradians."""
    width, height = size
    azimuth = ((np.arange(width) + 0.5) / width - 0.5) * 360
    elevation = 90 - (np.arange(height) + 0.5) / height * 180
    edges = np.sin(np.radians(90 - np.arange(height + 1) / height * 180))
    return azimuth, elevation, (edges[:-1] - edges[1:]) * 2 * np.pi / width


@pytest.mark.parametrize(("azimuth", "elevation"), [(60, 25), (-150, 5), (0, 70), (179, 45)])
def test_the_sun_stands_where_the_edit_has_it(scene, azimuth, elevation):
    light = made(scene, sw.Edit(sun_azimuth=azimuth, sun_elevation=elevation))
    row, column = np.unravel_index(np.argmax(light.sum(-1)), light.shape[:2])
    at, up, _ = angles()
    apart = (at[column] - azimuth + 180) % 360 - 180
    assert abs(apart) * np.cos(np.radians(elevation)) < 1.5
    assert abs(up[row] - elevation) < 1.5


@pytest.mark.parametrize("width", [64, 256, 1024])
def test_the_disc_gives_the_suns_light_at_any_size(scene, width):
    edit, size = sw.Edit(sun_azimuth=30, sun_elevation=20), (width, width // 2)
    disc = made(scene, edit, size) - made(scene, edit, size, sun=False)
    air = scene.atmosphere.replace(residual=None, confidence=None)
    # The disc's mean radiance times its solid angle: irradiance at normal incidence, in klx.
    share = np.sqrt((np.arange(200) + 0.5) / 200) * 0.2666
    wanted = spectral_to_rec709(disc_radiance(air, np.full(200, 20.0), share)).mean(axis=0)
    wanted *= np.pi * np.radians(0.2666) ** 2
    np.testing.assert_allclose(
        (disc * angles(size)[2][:, None, None]).sum((0, 1)), wanted, rtol=0.02
    )
    assert 20 < wanted[1] < 130  # klx of a clear day


def test_the_sky_is_the_models(scene):
    edit = sw.Edit(sun_azimuth=-40, sun_elevation=30)
    light = made(scene, edit, sun=False)
    at, up, _ = angles()
    rows, columns = np.array([8, 20, 40, 55, 60]), np.array([10, 60, 128, 200, 240])
    air = scene.atmosphere.replace(residual=None, confidence=None)
    model = SkyTable(air).radiance(up[rows], at[columns] + 40, 30)
    np.testing.assert_allclose(light[rows, columns], spectral_to_rec709(model), rtol=0.04)


def test_a_low_sun_and_the_moon_give_less_light(scene):
    solid = angles()[2][:64, None, None]
    up = np.sin(np.radians(angles()[1][:64]))[:, None, None]

    def irradiance(edit):
        return (made(scene, edit)[:64] * solid * up).sum((0, 1))

    noon, evening = irradiance(sw.Edit(sun_elevation=60)), irradiance(sw.Edit(sun_elevation=2))
    assert noon[1] > 10 * evening[1]
    low, high = (made(scene, sw.Edit(sun_elevation=e)).max((0, 1)) for e in (2, 60))
    assert low[0] / low[2] > 2 * high[0] / high[2]  # a redder disc
    moon = irradiance(sw.Edit(sun_elevation=60, light_source="moon"))
    assert moon[1] == pytest.approx(noon[1] / 402_000, rel=0.02)


@pytest.mark.parametrize("ending", [".hdr", ".exr"])
def test_a_map_is_written_and_opens_again(tmp_path, scene, ending):
    if ending == ".exr":
        OpenEXR = pytest.importorskip("OpenEXR")
    edit = sw.Edit(sun_azimuth=60, sun_elevation=25)
    light = made(scene, edit, (64, 32))
    path = sw.environment_map(scene, edit, tmp_path / f"sky{ending}", size=(64, 32))
    photo = sw.open(path)
    np.testing.assert_allclose(
        photo.pixels, light, rtol=1e-6 if ending == ".exr" else 0.02, atol=0.3
    )
    assert photo.recipe == edit
    if ending == ".exr":
        header = OpenEXR.File(str(path)).header()
        assert header["envmap"] == OpenEXR.ENVMAP_LATLONG
        assert header["whiteLuminance"] == 1000
    with pytest.raises(FileExistsError):
        sw.environment_map(scene, edit, path, size=(64, 32))


def test_what_is_no_map_is_refused(tmp_path, scene):
    with pytest.raises(PhotoError, match=r"must end in \.hdr or \.exr"):
        sw.environment_map(scene, None, tmp_path / "sky.png")
    for size in ((64, 64), (4, 2), (40_000, 20_000)):
        with pytest.raises(PhotoError, match="twice as wide as high"):
            sw.environment_map(scene, None, tmp_path / "sky.hdr", size=size)
    assert list(tmp_path.iterdir()) == []
