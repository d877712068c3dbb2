"""Depth of the photo: its methods, and how the frame gets it."""

import numpy as np
import pytest
from analysis_pictures import seascape

import sunwidget as sw
from sunwidget.analysis import depth_level
from sunwidget.renderer import quantise_map, scene_textures


@pytest.fixture(scope="module")
def scene():
    return sw.analyze(seascape(240, 160), fov=45.0)


def test_levels_are_log_depth():
    depth = np.array([0.1, 1, 256, 65536, 1e9, np.inf], np.float32)
    level = depth_level.to_level(np.log(depth))
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
    nothing = np.zeros_like(land)
    assert (depth_level.fill_sky(values, nothing) == values).all()


def test_dither_tells_what_lies_between_two_levels():
    between = np.full((90, 90), (100 + 0.37) / 255, np.float32)
    levels = quantise_map(depth_level.dithered(between)).astype(float)
    assert set(np.unique(levels)) == {100, 101}
    blocks = levels.reshape(30, 3, 30, 3).mean((1, 3))
    assert np.abs(blocks - 100.37).max() < 0.2
    assert levels.mean() == pytest.approx(100.37, abs=0.01)


def test_alpha_of_the_surface_is_the_depth_of_the_land(scene):
    for size in ((240, 160), (120, 80), (480, 320)):
        alpha = scene_textures(scene, size)["surface"][..., 3] / 255
        ground = alpha[-1, size[0] // 2]
        depth = depth_level.to_depth(ground)
        assert depth == pytest.approx(scene.depth[-1, 120], rel=0.05)
        assert np.isfinite(scene.depth).any()
        # Nothing in the sky is nearer or farther than the land at the skyline.
        assert alpha[: size[1] // 3].std() < 0.02
