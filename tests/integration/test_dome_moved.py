"""Environment maps whose sun moves: unmoved the same bits, moved the sky of the model there."""

import json

import cv2
import numpy as np
import pytest

import sunwidget as sw
from sunwidget.analysis.fit.fit import model_sky
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.cli.main import main
from sunwidget.dome.air import sunlight
from sunwidget.dome.disc import sun_disc
from sunwidget.dome.sky import find_sky
from sunwidget.dome.sphere import (
    angles,
    direction_of,
    distance,
    irradiance,
    pixel_of,
    sample,
    solid_angles,
    toward,
)
from sunwidget.export.dome.moved import move_sun
from sunwidget.formats import radiance
from sunwidget.formats.color import LUMINANCE

WIDTH = 256
UNIT = 0.07  # of the map, per kcd m⁻²
AIR = Atmosphere(
    aerosol_optical_depth=0.12, aerosol_asymmetry=0.76, angstrom_exponent=1.3, aerosol_albedo=0.9
)
HIGH, LOW = (40.0, 35.0), (-100.0, 8.0)
PLANES = ((0, 0, 1), (1, 0, 0), (0, -1, 0), (-1, 0, 0), (0, 1, 0))
ALBEDO = np.array([0.2, 0.18, 0.1])


def true_map(sun, width=WIDTH):
    """A clear sky over flat ground with its sun, (H, W, 3) float32, and the same without disc."""
    azimuth, elevation = angles(width)
    above = elevation > 0
    light = UNIT * model_sky(AIR, azimuth, np.maximum(elevation, 0), sun) * above[..., None]
    disc = UNIT * sun_disc(AIR, *sun, (width, width // 2))
    lit = irradiance(light) + max(np.sin(np.radians(sun[1])), 0) * UNIT * sunlight(AIR, sun[1])
    light = np.where(above[..., None], light, ALBEDO * lit / np.pi)
    return np.asarray(light + disc, np.float32), np.asarray(light, np.float32)


def open_sky(width=WIDTH):
    return (angles(width)[1] > 0).astype(float)


def dome_of(light, **hints):
    return sw.analyze_dome(light, **{"sky": open_sky(light.shape[1]), **hints})


def on_planes(light, direct, sun):
    beam = toward(*sun)
    found = [irradiance(light, n) + max(float(beam @ np.array(n)), 0) * direct for n in PLANES]
    return np.array(found) @ LUMINANCE


def grey_sky():
    """A closed sky, brighter towards one side, over dark ground."""
    azimuth, elevation = angles(WIDTH)
    level = np.where(elevation > 0, 1 + 0.5 * np.cos(np.radians(azimuth)), 0.15)
    return np.asarray(level[..., None] * [0.97, 1, 1.02], np.float32)


@pytest.fixture(scope="module")
def high():
    return dome_of(true_map(HIGH)[0])


@pytest.mark.parametrize("sun", [HIGH, LOW, (-179.0, 60.0), (12.0, 3.0)])
def test_the_sun_is_found_with_its_light(sun):
    dome = dome_of(true_map(sun)[0])
    # 1.4° a pixel; the centre of mass is nearer than that.
    assert distance(sun, *(np.array(a) for a in dome.sun)) < 1
    assert dome.sun_kind == "disc"
    measured = dome.direct @ LUMINANCE
    # What shines within 2.5° of it counts as its own: in this haze a few per cent.
    assert measured == pytest.approx(UNIT * sunlight(AIR, sun[1]) @ LUMINANCE, rel=0.1)
    assert dome.warnings == ()


def test_the_networks_find_the_sky_and_none_in_a_room():
    sky = find_sky(true_map(HIGH, 512)[0])
    above = angles(512)[1] > 0
    assert (sky[above] > 0.5).mean() > 0.95
    assert sky[~above].max() == 0
    azimuth, elevation = angles(512)
    room = 0.3 + 0.1 * np.sign(np.sin(np.radians(6 * azimuth))) * (np.abs(elevation) < 40)
    room = np.asarray(room[..., None] * [1, 0.8, 0.6], np.float32)
    room[elevation > 40] = [0.25, 0.24, 0.22]
    with pytest.raises(sw.AnalysisError, match=r"No sky found in array .*sky=mask"):
        sw.analyze_dome(room)


@pytest.mark.parametrize("to", [LOW, (10.0, 20.0), (40.0, 2.0)])
def test_a_moved_sky_is_as_the_model_has_it(high, to):
    out = move_sun(high, sw.Edit(sun_azimuth=to[0], sun_elevation=to[1]), WIDTH)
    _, wanted = true_map(to)
    ours = on_planes(out.sky, out.direct, to)
    true = on_planes(wanted, UNIT * sunlight(AIR, to[1]), to)
    # The air is one of 18; it and the disc's aureole are what is wrong.
    assert np.abs(np.log2(ours / true)).max() < 0.3
    assert np.median(np.abs(np.log2(ours / true))) < 0.15
    level = out.whole @ LUMINANCE
    row, column = np.unravel_index(np.argmax(level), level.shape)
    azimuth, elevation = angles(WIDTH)
    assert distance(to, azimuth[row, column], elevation[row, column]) < 360 / WIDTH
    # Where the old sun stood there is none.
    apart = distance(HIGH, azimuth, elevation)
    if distance(HIGH, *(np.array(a) for a in to)) > 30:
        assert level[apart < 3].mean() < 1.3 * level[(apart > 8) & (apart < 12)].mean()


def test_the_ground_changes_with_what_falls_on_it(high):
    out = move_sun(high, sw.Edit(sun_azimuth=LOW[0], sun_elevation=LOW[1]), WIDTH)
    wanted = true_map(LOW)[1][-10, 0]
    np.testing.assert_allclose(out.sky[-10, 0], wanted, rtol=0.2)
    assert not np.allclose(true_map(HIGH)[1][-10, 0], wanted, rtol=0.5)


@pytest.mark.parametrize("width", [128, 1024])
def test_the_disc_has_the_same_light_at_any_size(high, width):
    out = move_sun(high, sw.Edit(sun_elevation=20), width)
    given = (out.disc * solid_angles(width)[..., None]).sum((0, 1))
    np.testing.assert_allclose(given, out.direct, rtol=1e-4)
    np.testing.assert_allclose(
        out.direct, move_sun(high, sw.Edit(sun_elevation=20), WIDTH).direct, rtol=0.02
    )
    assert (out.disc > 0).any(axis=-1).sum() < 12


def test_by_night_it_is_dark(high):
    before = np.median(true_map(HIGH)[1] @ LUMINANCE)
    levels = []
    for height in (0, -4, -8, -12):
        out = move_sun(high, sw.Edit(sun_elevation=height), WIDTH)
        levels.append(np.median(out.whole @ LUMINANCE) / before)
        if height < -1:
            assert out.direct.max() == 0
    assert np.all(np.diff(levels) < 0)
    # Some 10⁻⁵ of daylight are left at the end of nautical twilight (Rozenberg 1966).
    assert levels[-1] < 1e-4


def test_a_sun_that_is_cut_off_gets_the_models_light():
    light, _ = true_map(HIGH)
    cut = np.minimum(light, 400 * np.median(light))
    dome = dome_of(cut)
    assert dome.sun_kind == "clipped"
    assert "clipped or hidden" in dome.warnings[0]
    out = move_sun(dome, sw.Edit(sun_azimuth=-60), WIDTH)
    true = UNIT * sunlight(AIR, HIGH[1]) @ LUMINANCE
    assert out.direct @ LUMINANCE == pytest.approx(true, rel=0.4)


def test_a_closed_sky_has_no_disc_and_darkens_with_the_sun():
    dome = dome_of(grey_sky())
    assert dome.sun_kind == "hidden"
    assert dome.closed == 1
    assert "are a guess" in dome.warnings[0]
    low = move_sun(dome, sw.Edit(sun_elevation=5), WIDTH)
    high = move_sun(dome, sw.Edit(sun_elevation=50), WIDTH)
    assert low.disc.max() < 1e-3 * sunlight(AIR, 5).max()
    assert np.median(low.sky @ LUMINANCE) < 0.5 * np.median(high.sky @ LUMINANCE)


def test_land_hides_the_new_sun():
    sky = open_sky()
    light, _ = true_map(HIGH)
    azimuth, elevation = angles(WIDTH)
    tower = (np.abs(azimuth + 60) < 15) & (elevation > 0) & (elevation < 30)
    sky[tower], light[tower] = 0, 0.02
    dome = dome_of(light, sky=sky)
    behind = move_sun(dome, sw.Edit(sun_azimuth=-60, sun_elevation=15), WIDTH)
    assert behind.through < 0.01
    assert move_sun(dome, sw.Edit(sun_azimuth=-90, sun_elevation=15), WIDTH).through > 0.95


def test_a_person_tells_where_the_sun_is():
    x, y = pixel_of(-40.0, 25.0, WIDTH)
    dome = dome_of(grey_sky(), sun=(float(x), float(y)))
    assert dome.sun == pytest.approx((-40, 25))
    assert dome.warnings == ()
    assert dome_of(true_map(HIGH)[0], sun="outside").sun_kind == "hidden"
    near = dome_of(true_map(HIGH)[0], sun=tuple(float(a) + 1 for a in pixel_of(*HIGH, WIDTH)))
    assert distance(HIGH, *(np.array(a) for a in near.sun)) < 1


def test_an_unmoved_sun_changes_no_bit(tmp_path):
    light = true_map(HIGH)[0]
    source = tmp_path / "source.hdr"
    source.write_bytes(radiance.pack(light, {}))
    dome = sw.analyze_dome(source, sky=open_sky())
    out = sw.to_dome(dome, None, tmp_path / "same.hdr")
    # Read by another library.
    packed = [cv2.imread(str(path), cv2.IMREAD_UNCHANGED) for path in (source, out)]
    np.testing.assert_array_equal(*packed)
    own = sw.Edit(sun_azimuth=dome.sun[0], sun_elevation=dome.sun[1])
    np.testing.assert_array_equal(move_sun(dome, own, WIDTH).whole, dome.photo.light())
    without = sw.to_dome(dome, None, tmp_path / "sky.hdr", sun=False)
    assert sw.open(without).pixels.max() < 0.01 * light.max()


def test_openexr_files_hold_it_and_say_so(tmp_path, high):
    OpenEXR = pytest.importorskip("OpenEXR")
    same = sw.to_dome(high, None, tmp_path / "same.exr")
    red = OpenEXR.File(str(same), separate_channels=True).channels()["R"].pixels
    np.testing.assert_array_equal(red, high.photo.light()[..., 0])
    edit = sw.Edit(sun_azimuth=LOW[0], sun_elevation=LOW[1])
    path = sw.to_dome(high, edit, tmp_path / "low.exr", width=512)
    file = OpenEXR.File(str(path), separate_channels=True)
    assert file.header()["envmap"] == OpenEXR.ENVMAP_LATLONG
    # Nobody knows the unit of such a map.
    assert "whiteLuminance" not in file.header()
    assert file.channels()["R"].pixels.shape == (256, 512)
    facts = json.loads((tmp_path / "low.json").read_text("utf-8"))
    assert json.loads(file.header()["sunwidget.dome"]) == facts
    assert facts["sun"]["azimuth_deg"] == LOW[0]
    np.testing.assert_allclose(facts["sun"]["direction"], toward(*LOW), atol=1e-4)
    lux = 1000 * sunlight(AIR, LOW[1]) @ LUMINANCE
    assert facts["sun"]["illuminance_lux"] == pytest.approx(lux, rel=0.3)
    assert facts["source"]["sun_kind"] == "disc"
    assert facts["sky"]["seen_share_of_sky"] == pytest.approx(1, abs=1e-3)
    np.testing.assert_allclose(facts["ground"]["albedo"], ALBEDO, rtol=0.25)


def test_what_is_no_environment_map_is_refused(tmp_path, high):
    with pytest.raises(sw.PhotoError, match="8- or 16-bit"):
        sw.analyze_dome(np.zeros((64, 128, 3), np.uint8))
    with pytest.raises(sw.PhotoError, match="twice as wide"):
        sw.analyze_dome(np.zeros((64, 100, 3), np.float32))
    with pytest.raises(sw.AnalysisError, match="not a position in array"):
        dome_of(true_map(HIGH)[0], sun=(900, 20))
    with pytest.raises(sw.EditError, match="not cloud_opacity, exposure"):
        sw.to_dome(high, {"cloud_opacity": 0.5, "exposure": 1}, tmp_path / "sky.hdr")
    with pytest.raises(sw.PhotoError, match="twice as wide as high"):
        sw.to_dome(high, None, tmp_path / "sky.hdr", width=99)
    with pytest.raises(sw.AnalysisError, match="No sky found"):
        dome_of(true_map(HIGH)[0], sky=np.zeros((WIDTH // 2, WIDTH)))
    assert list(tmp_path.iterdir()) == []


def test_the_command_line_moves_the_sun_of_a_map(tmp_path, capsys):
    source, mask, out = (tmp_path / name for name in ("source.hdr", "mask.png", "out.hdr"))
    source.write_bytes(radiance.pack(true_map(HIGH)[0], {}))
    cv2.imwrite(str(mask), 255 * open_sky().astype(np.uint8))
    command = ["dome", str(source), "--sky", str(mask), "-o", str(out)]
    assert main([*command, "--fov", "40"]) == 2
    assert "Leave out --fov, which is for photos" in capsys.readouterr().err
    assert main([*command, "--time", "12:00"]) == 2
    assert "--heading" in capsys.readouterr().err
    assert main([*command, "--glow", "2"]) == 2
    assert "not glow" in capsys.readouterr().err
    assert not out.exists()
    assert main([*command, "--sun-elevation", "12", "--width", "128"]) == 0
    said = capsys.readouterr()
    assert "sun of source.hdr: azimuth 40." in said.out
    assert sw.open(out).size == (128, 64)
    facts = json.loads(out.with_suffix(".json").read_text("utf-8"))
    assert facts["sun"]["elevation_deg"] == 12
    assert facts["sun"]["azimuth_deg"] == pytest.approx(HIGH[0], abs=0.5)


def test_the_clock_moves_it_where_the_middle_column_looks_is_told(tmp_path, capsys):
    pytest.importorskip("pvlib")
    source, mask, out = (tmp_path / name for name in ("source.hdr", "mask.png", "out.hdr"))
    source.write_bytes(radiance.pack(true_map(HIGH)[0], {}))
    cv2.imwrite(str(mask), 255 * open_sky().astype(np.uint8))
    clock = ["--place", "50,14", "--date", "2026-06-21", "--time", "11:04", "--heading", "90"]
    assert main(["dome", str(source), "--sky", str(mask), "-o", str(out), *clock]) == 0
    sun = json.loads(out.with_suffix(".json").read_text("utf-8"))["sun"]
    # Noon of midsummer: the sun in the south, 90° to the right of east, at 90° - 50° + 23.4°.
    assert sun["compass_deg"] == pytest.approx(180, abs=2)
    assert sun["azimuth_deg"] == pytest.approx(90, abs=2)
    assert sun["elevation_deg"] == pytest.approx(63.4, abs=0.3)


@pytest.mark.parametrize("azimuth", [-180.0, -60.0, 0.0, 179.9])
def test_directions_and_pixels_belong_together(azimuth):
    for elevation in (-80.0, 0.0, 55.0):
        assert direction_of(toward(azimuth, elevation)) == pytest.approx(
            (azimuth, elevation), abs=1e-9
        )
    there = np.asarray(angles(WIDTH)[1], np.float32)
    heights = np.array([-30.0, 10.0, 60.0])
    np.testing.assert_allclose(sample(there, azimuth, heights), heights, atol=1e-3)
