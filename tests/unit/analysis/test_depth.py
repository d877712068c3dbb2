"""Depth of the photo: its methods on drawn scenes of known depth, and how the frame gets it."""

import dataclasses
from types import SimpleNamespace

import cv2
import numpy as np
import onnx_files as onnx
import pytest
from analysis_pictures import seascape

import sunwidget as sw
from sunwidget.analysis import frame_inputs
from sunwidget.analysis.depth import depth, flat_ground
from sunwidget.analysis.depth import levels as depth_level
from sunwidget.analysis.depth.network import DepthNetwork, aligned
from sunwidget.analysis.depth.view import View
from sunwidget.analysis.horizon.horizon import Horizon
from sunwidget.analysis.images.working_copy import Working, encode, resize
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.errors import AnalysisError
from sunwidget.geometry.camera import Camera
from sunwidget.photo.photo import open_photo
from sunwidget.renderer import scene_textures

WIDTH, HEIGHT, ROW, FOV = 300, 200, 100, 40.0
CAMERA = Camera.from_horizon(WIDTH, HEIGHT, FOV, ROW)
AIR = Atmosphere().with_visibility(20_000.0)
BOX = 14.0  # metres to a wall 8 m wide and 4 m high, somewhat right of the middle
RIDGE = 6_000.0


def drawn():
    """Draw a plain, a dark wall on it and a hazy ridge behind: linear light, depth, sky."""
    rows, columns = np.mgrid[:HEIGHT, :WIDTH] + 0.5
    x, y = (columns - WIDTH / 2) / CAMERA.focal, (rows - ROW) / CAMERA.focal
    metres = np.full((HEIGHT, WIDTH), np.inf)
    light = np.broadcast_to(np.array([0.62, 0.72, 0.85]), (HEIGHT, WIDTH, 3)).copy()
    noise = np.random.default_rng(5).normal(1, 0.1, (HEIGHT, WIDTH, 1))

    def paint(where, depth, colour):
        metres[where] = np.broadcast_to(depth, where.shape)[where]
        through = np.exp(-AIR.extinction_550 * metres)[..., None]
        seen = colour * noise * through + np.array([0.62, 0.72, 0.85]) * (1 - through)
        light[where] = seen[where]

    hill = 300 + 120 * np.sin(columns / 40)
    paint((y < 0) & (-y * RIDGE < hill), RIDGE, np.array([0.03, 0.05, 0.02]))
    paint(y > 0, flat_ground.EYE_HEIGHT / np.maximum(y, 1e-9), np.array([0.25, 0.22, 0.05]))
    wall = (np.abs(x * BOX - 2) < 4) & (y * BOX < flat_ground.EYE_HEIGHT) & (y * BOX > -2.3)
    paint(wall, BOX, np.array([0.10, 0.03, 0.02]))
    return light.astype(np.float32), metres, wall


@pytest.fixture(scope="module")
def plain():
    """Light, depth and wall of the drawn plain, and the view that knows all but the depth."""
    light, metres, wall = drawn()
    encoded = encode(light)
    working = Working(light, encoded, encoded, (1.0, 1.0))
    sky = np.isinf(metres).astype(np.float32)
    view = View.of(working, sky, np.zeros_like(sky), CAMERA, Horizon(ROW, 0.0, 1.0, "hint"), AIR)
    return light, metres, wall, view


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(seascape(240, 160), fov=45.0)


def metres_of(method, view):
    field = depth.METHODS[method](view)
    return np.exp(field.log_metres(WIDTH, HEIGHT, view.working)), field


def within(found, known, factor):
    """Share of pixels whose depth is right within a factor."""
    return np.mean(np.abs(np.log(found / known)) < np.log(factor))


def inner_of(wall):
    """Leave out the rim: a pixel or two of the wall's edge may go either way."""
    return cv2.erode(wall.astype(np.uint8), np.ones((9, 9), np.uint8)) > 0


@pytest.fixture
def sees(plain, monkeypatch):
    """Let the land network see the drawn plain as it is, but for a scale."""
    _, metres, wall, _ = plain
    land = np.isfinite(metres)
    log_depth = depth_level.fill_sky(np.log(np.where(land, metres, 1)).astype(np.float32), land)
    normal = np.zeros((HEIGHT, WIDTH, 3), np.float32)
    normal[..., 2] = 1  # what stands faces the camera
    normal[land & (metres < RIDGE) & ~wall] = CAMERA.up * np.array([1, -1, -1])

    def see(times=1.0, noise=0.0):
        rough = np.random.default_rng(3).normal(0, noise, log_depth.shape).astype(np.float32)
        maps = SimpleNamespace(log_depth=log_depth + rough + np.log(times), normal=normal)
        monkeypatch.setattr(depth, "look_at_land", lambda _: maps)

    return see


@pytest.mark.parametrize("times", [0.05, 1.0, 30.0])
def test_the_plain_the_wall_and_the_ridge_have_their_depths(plain, sees, times):
    _, metres, wall, view = plain
    sees(times, noise=0.1)
    found, field = metres_of("network", view)
    near = np.isfinite(metres) & ~wall & (metres < 200)
    assert within(found[near], metres[near], 1.1) > 0.9
    inner = inner_of(wall)
    assert within(found[inner], metres[inner], 1.2) > 0.95
    ridge = (metres == RIDGE) & ~wall
    assert np.median(found[ridge]) == pytest.approx(RIDGE, rel=0.25)
    assert 0 <= field.confidence.min() <= field.confidence.max() <= 1
    # Ground that the plane tells is known better than what stands on it.
    assert np.median(field.confidence[near]) > np.median(field.confidence[ridge])


def test_the_plane_is_nothing_but_ground(plain):
    _, metres, wall, view = plain
    found, _ = metres_of("ground_plane", view)
    ground = np.isfinite(metres) & ~wall & (metres < 200)
    assert within(found[ground], metres[ground], 1.05) > 0.98
    assert found[metres == RIDGE].min() > 200


def test_without_ground_in_sight_the_network_tells_the_scale(plain, sees):
    *_, view = plain
    above = dataclasses.replace(view, camera=Camera(WIDTH, HEIGHT, FOV, 40.0))
    sees(1.0)
    near = np.exp(depth.network(above).log_metres(WIDTH, HEIGHT, view.working))
    sees(10.0)
    far = np.exp(depth.network(above).log_metres(WIDTH, HEIGHT, view.working))
    assert np.median(far[view.land] / near[view.land]) > 3


def test_an_unsure_horizon_is_a_lower_confidence(plain, sees):
    *_, view = plain
    sees()
    sure = depth.network(view).confidence.mean()
    unsure = depth.network(dataclasses.replace(view, horizon_error=8.0)).confidence.mean()
    assert unsure < 0.95 * sure


def test_ground_has_no_terraces_at_any_size(plain, sees):
    *_, view = plain
    sees()
    field = depth.network(view)
    for scale in (0.5, 1, 3):
        width, height = round(WIDTH * scale), round(HEIGHT * scale)
        column = field.log_metres(width, height, view.working)[:, round(20 * scale)]
        ground = column[round(120 * scale) :]
        known = np.log(
            flat_ground.EYE_HEIGHT
            * CAMERA.resized(width, height).focal
            / (np.arange(round(120 * scale), height) + 0.5 - ROW * scale)
        )
        assert np.abs(ground - known).max() < 0.05


def test_levels_are_log_depth():
    metres = np.array([0.1, 1, 256, 65536, 1e9, np.inf], np.float32)
    level = depth_level.to_level(np.log(metres))
    assert level == pytest.approx([0, 0, 0.5, 1, 1, 1])
    assert depth_level.to_depth(level)[1:4] == pytest.approx([1, 256, 65536])


def test_sky_takes_the_depth_of_the_nearest_land():
    values = np.tile(np.arange(6, dtype=np.float32), (5, 1))
    land = np.zeros((5, 6), bool)
    land[4, :2] = land[3:, 5] = True
    filled = depth_level.fill_sky(values, land)
    assert (filled[land] == values[land]).all()
    assert filled[0, 0] == 0
    assert filled[0, 1] == 1
    assert filled[0, 5] == 5
    assert set(np.unique(filled)) == {0, 1, 5}
    assert (depth_level.fill_sky(np.dstack([values, -values]), land)[..., 1] == -filled).all()
    nothing = np.zeros_like(land)
    assert (depth_level.fill_sky(values, nothing) == values).all()


def test_dither_tells_what_lies_between_two_levels():
    between = np.full((90, 90), (100 + 0.37) / 255, np.float32)
    levels = frame_inputs.quantise_map(depth_level.dithered(between)).astype(float)
    assert set(np.unique(levels)) == {100, 101}
    blocks = levels.reshape(30, 3, 30, 3).mean((1, 3))
    assert np.abs(blocks - 100.37).max() < 0.2
    assert levels.mean() == pytest.approx(100.37, abs=0.01)


def test_alpha_of_the_surface_is_the_depth_of_the_land(scene):
    for size in ((240, 160), (120, 80), (480, 320)):
        alpha = scene_textures(scene, size)["surface"][..., 3] / 255
        ground = alpha[-1, size[0] // 2]
        assert depth_level.to_depth(ground) == pytest.approx(scene.depth[-1, 120], rel=0.05)
        # Nothing in the sky is nearer or farther than the land at the skyline below it.
        skyline = np.argmax(resize(scene.sky, *size) <= 0.5, axis=0)
        beside = np.take_along_axis(alpha, skyline[None], 0)
        assert np.abs(alpha[: size[1] // 3] - beside).max() < 0.02


def test_the_sky_is_infinitely_far_and_known_to_be(scene):
    sky = scene.sky > 0.5
    assert (np.isinf(scene.depth) == sky).all()
    assert (scene.depth_confidence[sky] == 1).all()
    assert scene.depth_confidence.dtype == scene.depth.dtype == np.float32
    assert 0 <= scene.depth_confidence.min() <= scene.depth_confidence.max() <= 1


def test_a_given_array_is_the_depth():
    picture = seascape(240, 160)
    metres = np.broadcast_to(np.linspace(400, 80, 80)[:, None], (80, 120)).copy()
    metres[:40] = np.inf
    scene = sw.analyze(picture, depth=metres)
    land = scene.sky < 0.5
    below = land & (np.arange(160)[:, None] > 100)
    known = np.repeat(np.repeat(metres, 2, 0), 2, 1)
    # Half a row of the array is this far in depth.
    assert np.abs(scene.depth[below] - known[below]).max() < 4.5
    assert (scene.depth_confidence == 1).all()
    assert np.isinf(scene.depth[~land]).all()
    assert np.isfinite(scene.depth[land]).all()
    level = frame_inputs.surface(scene)[-1, 100, 3]
    assert depth_level.to_depth(level) == pytest.approx(80, rel=0.05)


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ("stereo", "choose one of network, ground_plane"),
        (3.0, "has no method 3.0"),
        (object(), "has no method"),
        (np.ones((4, 5, 2)), r"shape \(height, width\)"),
        (np.full((160, 240), np.nan), "NaN, zero or negative"),
        (np.zeros((160, 240)), "NaN, zero or negative"),
        (np.full((160, 240), np.inf), "infinite everywhere"),
        (np.ones((240, 160)), "Was one of them rotated"),
    ],
)
def test_what_is_no_depth_is_refused_with_what_to_do(value, message):
    with pytest.raises(AnalysisError, match=message):
        sw.analyze(seascape(240, 160), depth=value)


@pytest.mark.parametrize("method", list(depth.METHODS))
@pytest.mark.parametrize("shape", [(1, 1), (1, 300), (300, 1), (9, 11), (40, 60)])
def test_pictures_of_odd_sizes_have_a_depth(method, shape):
    rng = np.random.default_rng(1)
    light = rng.random((*shape, 3)).astype(np.float32)
    working = Working(light, encode(light), encode(light), (1.0, 1.0))
    camera = Camera(shape[1], shape[0], 40.0)
    for sky in (np.zeros(shape, np.float32), np.ones(shape, np.float32)):
        view = View.of(working, sky, sky * 0, camera, Horizon(shape[0] / 2), AIR)
        field = depth.METHODS[method](view)
        found = field.log_metres(shape[1], shape[0], working)
        assert found.shape == shape
        assert np.isfinite(found).all()
        assert np.isfinite(field.confidence).all()


def test_a_photo_is_analysed_by_each_method():
    photo = open_photo(seascape(240, 160))
    base = sw.analyze(photo)
    assert base.hints.method("depth") == "network"
    for method in depth.METHODS:
        assert np.isfinite(frame_inputs.surface(sw.analyze(photo, depth=method))).all()


def test_inverse_depth_is_aligned_with_the_ground(plain):
    _, metres, wall, view = plain
    land = np.isfinite(metres)
    nearness = np.where(land, 1 / metres, 0)
    value = (3.0 + 70.0 * nearness).astype(np.float32)
    # The wall is an outlier on what would be ground.
    field = aligned(view, value, value)
    found = np.exp(field.log_metres(WIDTH, HEIGHT, view.working))
    near = land & (metres < 500)
    assert within(found[near], metres[near], 1.08) > 0.97
    assert within(found[wall], metres[wall], 1.08) > 0.97
    assert field.confidence.min() > 0.5


def test_depth_up_to_a_scale_is_aligned_with_the_ground(plain):
    _, metres, wall, view = plain
    value = np.where(np.isfinite(metres), metres / 7.5, 1e4).astype(np.float32)
    field = aligned(view, value, value)
    found = np.exp(field.log_metres(WIDTH, HEIGHT, view.working))
    near = np.isfinite(metres) & (metres < 500)
    assert within(found[near], metres[near], 1.05) > 0.97


def test_the_other_way_round_can_be_told(plain):
    *_, metres, _, view = (None, *plain[1:])
    value = np.where(np.isfinite(metres), metres, 1e4).astype(np.float32)
    as_told = aligned(view, value, value, "inverse")
    # As inverse depth it disagrees with the ground, and the confidence says so.
    assert as_told.confidence.max() < 0.5 < aligned(view, value, value).confidence.min()


def network(tmp_path, size=("height", "width"), weights=((1,), (1,), (1,)), maps=1, **options):
    """Write a network that returns a weighted sum of the channels."""
    weight = np.tile(np.array(weights, np.float32).reshape(1, 3, 1, 1), (maps, 1, 1, 1))
    nodes = [onnx.node("Conv", ["image", "w"], ["depth"])]
    path = tmp_path / "depth.onnx"
    entries = [("image", np.float32, (1, 3, *size))]
    result = ("depth", np.float32, (1, maps, *size))
    return onnx.write(path, nodes, {"w": weight}, entries, [result], **options)


def shaded():
    """Draw a seascape whose sea is the brighter the nearer it is."""
    picture = seascape(240, 160).astype(np.float32)
    rows = np.arange(160)[:, None, None]
    sea = 20 + 120 * (rows - 96) / 64 + 0 * picture
    return np.where(rows > 96, sea, picture * 0 + np.array([120, 160, 220])).astype(np.uint8)


@pytest.mark.parametrize("size", [("height", "width"), (64, 96)])
def test_a_network_of_any_size_finds_depth(tmp_path, size):
    path = network(tmp_path, size)
    scene = sw.analyze(shaded(), depth=str(path), horizon=96.0)
    column = scene.depth[100:, 120]
    assert np.isfinite(column).all()
    assert (np.diff(column) <= 1e-3).all()
    plane = sw.analyze(shaded(), depth="ground_plane", horizon=96.0).depth[100:, 120]
    assert np.median(np.abs(np.log(column / plane))) < 0.35
    assert np.isinf(scene.depth[:90]).all()
    told = sw.analyze(shaded(), depth=DepthNetwork(path, kind="inverse"), horizon=96.0)
    assert (told.depth[100:] == scene.depth[100:]).all()


def test_networks_that_cannot_be_used_are_refused_with_what_to_do(tmp_path):
    with pytest.raises(AnalysisError, match=r"No depth network at .*Pass depth="):
        _ = sw.analyze(shaded(), depth=str(tmp_path / "missing.onnx")).depth
    broken = tmp_path / "broken.onnx"
    broken.write_bytes(b"no network")
    with pytest.raises(AnalysisError, match=r"not an ONNX network.*depth="):
        _ = sw.analyze(shaded(), depth=broken).depth
    with pytest.raises(AnalysisError, match="the same value everywhere"):
        _ = sw.analyze(shaded(), depth=network(tmp_path, weights=((0,), (0,), (0,)))).depth
    with pytest.raises(AnalysisError, match="returned 5 maps"):
        _ = sw.analyze(shaded(), depth=network(tmp_path, maps=5)).depth
    for options in ({"kind": "metres"}, {"layout": "hwc"}):
        with pytest.raises(AnalysisError, match="must be"):
            DepthNetwork(tmp_path / "x.onnx", **options)
