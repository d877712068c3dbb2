"""Worlds made by seed, as far as neither Blender nor torch is needed."""

import functools
import zlib
from unittest.mock import patch

import numpy as np
import pytest
from world_meshes import chance, check, coarsen, grid, is_known, materials_known, rolling

from training.worlds import CLASSES
from training.worlds.families import TEST, TRAINING
from training.worlds.families.world import World
from training.worlds.mesh import box

FAMILIES = TRAINING | TEST
SEEDS = dict.fromkeys(FAMILIES, (0, 1)) | {"city": (0,)}  # it takes a while to make
QUICK = ("coast", "field", "woods", "dunes", "mountains", "park", "fjord", "orchard")  # to make


@functools.cache
def made(family, seed):
    """A world, and what of it was put (not laid out round the camera on purpose)."""
    stood, put = [], World.put

    def listening(self, thing, places):
        before = len(self.things)
        put(self, thing, places)
        stood.extend(self.things[before:])

    with patch.object(World, "put", listening):
        return FAMILIES[family](chance(seed)), stood


def digest(world):
    found = 0
    for thing, places in world.things:
        for array in (thing.vertices, thing.faces, thing.materials, np.array(places, float)):
            found = zlib.crc32(np.ascontiguousarray(array), found)
        found = zlib.crc32(" ".join(thing.names).encode(), found)
    x, y = grid(20, 7.0)
    found = zlib.crc32(np.ascontiguousarray(world.ground.at(x, y)), found)
    return found, world.ground.names, world.ground.water, world.waves


def test_classes_of_materials_are_classes():
    assert set(materials_known().values()) <= set(CLASSES) - {"sky"}


def test_no_family_is_both_learned_from_and_tested_on():
    assert not set(TRAINING) & set(TEST)
    assert not set(TRAINING.values()) & set(TEST.values())
    assert len(set(FAMILIES.values())) == len(FAMILIES)


@pytest.mark.parametrize("family", FAMILIES)
def test_a_family_s_worlds_are_whole(family):
    for seed in SEEDS[family]:
        world, _ = made(family, seed)
        assert world.things
        for thing, places in world.things:
            check(thing)
            assert all(is_known(name) for name in thing.names), thing.names
            table = np.array(places, float)
            assert table.shape == (len(places), 5)
            assert np.isfinite(table).all()
            assert (table[:, 4] > 0).all()
            assert np.hypot(table[:, 0], table[:, 1]).max() < 5000
        faces = sum(len(thing.faces) * len(places) for thing, places in world.things)
        assert faces < 1_500_000
        assert 0 < world.eye[0] < world.eye[1]
        assert 0 < world.narrowest < world.widest < 120


@pytest.mark.parametrize("family", FAMILIES)
def test_a_family_s_land_is_whole(family, monkeypatch):
    coarsen(monkeypatch)
    for seed in SEEDS[family]:
        land = made(family, seed)[0].ground
        found = land.mesh(0.6)
        check(found)
        assert all(is_known(name) for name in found.names), found.names
        assert np.abs(found.vertices[:, 2]).max() < 9000  # no higher than there are mountains
        assert float(land.at(np.zeros(1), np.zeros(1))[0]) >= (land.water or -np.inf)
        if land.water is not None:
            assert land.heights(*grid(60, 8.0)).min() < land.water


@pytest.mark.parametrize("family", FAMILIES)
def test_nothing_stands_on_the_camera(family):
    for seed in SEEDS[family]:
        world, stood = made(family, seed)
        for thing, places in stood:
            reach = np.hypot(*thing.vertices[:, :2].T).max()
            for x, y, _, turned, size in places:
                if np.hypot(x, y) < world.clear + reach * size:
                    there = thing.moved((x, y, 0), turned, size).vertices
                    # The corners of what is square may come a little nearer.
                    assert np.hypot(*there[:, :2].T).min() > 0.9 * world.clear


@pytest.mark.parametrize("family", QUICK)
def test_a_seed_tells_the_world(family):
    assert digest(made(family, 0)[0]) == digest(FAMILIES[family](chance(0)))
    assert digest(made(family, 0)[0]) != digest(made(family, 1)[0])


def test_put_leaves_out_what_would_stand_on_the_camera():
    world = World(rolling(), clear=3.0)
    thing = box(2, 2, 2, "rock")
    world.put(thing, [(3.9, 0, 0, 0, 1.0), (4.1, 0, 0, 0, 1.0), (4.1, 0, 0, 0, 2.0)])
    assert world.things == [(thing, [(4.1, 0, 0, 0, 1.0)])]
    world.put(thing, [(1.0, 1.0, 0, 0, 1.0)])
    assert len(world.things) == 1
