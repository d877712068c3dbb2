"""Air drawn in front of worlds: how much of a picture's light is its own."""

import numpy as np
import pytest
from world_meshes import chance

from training.land.air import Air, with_air

SHAPE = (24, 60)
HORIZON = np.repeat([[4, 1, 0.5], [0.5, 1, 4]], 12, 0).astype(np.float32)


def world(log_depth):
    """Gray land at a depth (log2 of metres) below a sky, red on its left and blue on its right."""
    depth = np.full(SHAPE, log_depth, np.float16)
    depth[:8] = np.inf
    return {
        "light": np.full((1, *SHAPE, 3), 0.5, np.float16),
        "depth": depth,
        "air": HORIZON[None],
        "scale": np.ones(1, np.float32),
        "camera": np.float32([0.6, 0, 0, 1.6]),
        "suns": np.float32([[0, 0.3, 0]]),
    }


def test_the_share_is_that_of_the_light_that_the_air_adds():
    for seed in range(12):
        scene = world(12.0)
        plain, dark = scene["light"][0].astype(np.float32), scene | {"light": 0 * scene["light"]}
        hazy, share = with_air(scene, 0, chance(seed))
        added, _ = with_air(dark, 0, chance(seed))
        luminance = np.array([0.2126, 0.7152, 0.0722])
        land = np.isfinite(scene["depth"])
        assert (share[~land] == 1).all()
        assert share[land] == pytest.approx(
            (added @ luminance / (hazy @ luminance))[land], abs=1e-4
        )
        assert (hazy[land] <= added[land] + plain[land] + 1e-3).all()


def test_near_land_has_hardly_any_air_and_far_land_that_of_the_horizon():
    shares = {d: [with_air(world(d), 0, chance(s)) for s in range(20)] for d in (1.0, 10.0, 15.9)}
    near, middle, far = (np.mean([share[12:] for _, share in v]) for v in shares.values())
    assert near < 0.1 < middle < far
    assert far > 0.6
    for hazy, share in shares[15.9]:
        if share[12:].min() > 0.8:
            assert hazy[16, 2, 0] > hazy[16, 2, 2]
            assert hazy[16, -3, 2] > hazy[16, -3, 0]


def test_clear_haze_and_fog_come_in_their_shares():
    drawn = [Air.drawn(chance(seed)) for seed in range(600)]
    visibility = np.array([a.visibility for a in drawn])
    clear, foggy = (visibility > 40).mean(), (visibility < 3).mean()
    assert clear == pytest.approx(0.55, abs=0.07)
    assert foggy == pytest.approx(0.17, abs=0.05)
    assert any(np.isinf(a.height) for a in drawn)
    assert any(a.height < 1 for a in drawn)


def test_fog_lies_below_and_level_air_hides_no_sky():
    away, climb = np.array([[2.0, 2.0, np.inf, np.inf]]), np.array([[-0.05, 0.2, 0.02, 0.5]])
    fog = Air(1.0, 0.1).through(away, climb).mean(-1)[0]
    assert fog[0] < 0.5 * fog[1]
    assert fog[2] < 0.01
    assert fog[3] > 0.4
    assert (Air(1.0, np.inf).through(away, climb)[0, 2:] == 1).all()
