"""The table of inspectable maps, its files and its overview."""

import dataclasses
import json

import numpy as np
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.analysis import frame_inputs
from sunwidget.analysis.maps import MAPS, levels, ramp_colors, scene_map, shares_of
from sunwidget.export.maps import save_maps


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(sw.sample("coast").preview(256))


@pytest.fixture(scope="module")
def folder(scene, tmp_path_factory):
    folder = tmp_path_factory.mktemp("maps")
    save_maps(scene, folder)
    return folder


@pytest.mark.parametrize("entry", MAPS, ids=lambda entry: entry.name)
def test_levels_become_the_values_that_made_them(entry):
    values = entry.value(np.linspace(0, 1, 257))
    assert values[0] == pytest.approx(entry.low)
    assert values[-1] == pytest.approx(entry.high)
    top = 2**entry.bits - 1
    back = entry.value(levels(entry.share(values), entry.bits) / top)
    step = entry.value(1.0) - entry.value(1 - 1 / top)
    assert np.abs(back - values).max() <= step
    evaluated = eval(entry.formula().removesuffix(entry.unit), {"level": 0.25 * top})
    assert evaluated == pytest.approx(entry.value(0.25))


@pytest.mark.parametrize("entry", MAPS, ids=lambda entry: entry.name)
def test_a_ramp_runs_from_0_to_1(entry):
    positions = [position for position, _ in entry.ramp]
    assert positions == sorted(positions)
    assert (positions[0], positions[-1]) == (0, 1)
    colors = ramp_colors(entry.ramp)
    assert colors.shape == (256, 4)
    assert np.ptp(colors, axis=0).max() > 0.1


def test_every_map_is_written_at_the_photos_size(scene, folder):
    facts = json.loads((folder / "scene.json").read_text("utf-8"))
    assert {"sky", "sky_coarse", "clouds", "sun", "depth", "glare"} <= facts["maps"].keys()
    for name, described in facts["maps"].items():
        picture = Image.open(folder / described["file"])
        assert picture.size == scene.photo.size
        assert picture.mode == ("I;16" if name == "depth" else "L")
    assert facts["timings"]["sky"] > 0
    assert facts["warnings"] == list(scene.warnings)


def test_a_file_holds_the_scenes_values(scene, folder):
    sky = np.asarray(Image.open(folder / "sky.png")) / 255
    assert np.abs(sky - scene.sky).max() <= 0.5 / 255 + 1e-6
    depth = np.asarray(Image.open(folder / "depth.png"))
    far = np.isinf(scene.depth)
    assert (depth[far] == 65535).all()
    near = scene_map("depth").value(depth[~far] / 65535)
    assert np.abs(near / scene.depth[~far] - 1).max() < 1e-3


def test_the_horizon_map_is_the_cameras(scene):
    entry = scene_map("elevation")
    shares = shares_of(scene, entry, scene.photo.size)
    at = scene.camera.angles(40.5, 30.5)[1]
    assert entry.value(shares[30, 40]) == pytest.approx(at, abs=0.01)


def test_the_glitter_map_is_the_shaders_own_and_none_without_water(scene):
    small = scene.working
    wet = dataclasses.replace(scene, water_map=(1 - scene.sky).astype(np.float32))
    glitter = frame_inputs.surface(wet, (small.width, small.height))[..., 2]
    assert glitter.max() > 0
    assert np.array_equal(scene_map("glitter").read(wet), glitter)
    dry = dataclasses.replace(scene, water_map=np.zeros_like(scene.water))
    assert scene_map("glitter").read(dry) is None


def test_the_overview_shows_every_map(scene, folder):
    sheet = np.asarray(Image.open(folder / "overview.png"))
    rows = -(-(1 + len([e for e in MAPS if e.read(scene) is not None])) // 4)
    assert sheet.shape[0] > rows * 170
    # The photo itself stands at the upper left, and colors tell maps from grey.
    assert np.ptp(sheet, axis=-1).mean() > 5


def test_nothing_is_replaced_without_overwrite(scene, folder, tmp_path):
    (tmp_path / "depth.png").write_bytes(b"mine")
    with pytest.raises(FileExistsError, match=r"depth\.png"):
        save_maps(scene, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["depth.png"]
    save_maps(scene, folder, overwrite=True)


def test_an_unknown_map_is_refused_with_the_names():
    with pytest.raises(ValueError, match="sky_coarse"):
        scene_map("skyline")
