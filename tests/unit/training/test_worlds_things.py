"""What stands in worlds: trees, people, cars …, and buildings with their streets."""

import numpy as np
import pytest
from world_meshes import chance, check, facing, is_known, open_edges, volume

from training.worlds.buildings.castles import castle_tower, castle_wall
from training.worlds.buildings.churches import church
from training.worlds.buildings.farms import barn, shed
from training.worlds.buildings.houses import BLOCK_FACES, HOUSE_FACES, ROW_FACES, block, house, row
from training.worlds.buildings.lighthouses import lighthouse
from training.worlds.buildings.openings import pierced
from training.worlds.buildings.shapes import boxes, prism
from training.worlds.buildings.streets import arcade, stairs, street_surface, wall
from training.worlds.buildings.towers import TOWER_FACES, tower
from training.worlds.props.boats import boat
from training.worlds.props.bridges import bridge, pier
from training.worlds.props.cars import CAR_KINDS, car
from training.worlds.props.farmland import fence, hay_bale, power_line, utility_pole, wind_turbine
from training.worlds.props.people import person, statue
from training.worlds.props.plants import HEDGE_CARDS, bush, grass_patch, hedge, reeds
from training.worlds.props.rocks import rock
from training.worlds.props.street_furniture import bench, bollard, lamp_post, sign, umbrella
from training.worlds.props.trees import bare_tree, broadleaf, conifer, far_tree, palm, poplar

THINGS = {  # maker: lowest and highest top in metres, reach to a side at most, faces at most
    "broadleaf": (broadleaf, 4, 17, 7, 1600),
    "poplar": (poplar, 8.5, 23, 4, 1600),
    "conifer": (conifer, 4.5, 26, 8, 1200),
    "palm": (palm, 3, 14, 7, 1000),
    "bare tree": (bare_tree, 3.9, 15.1, 10, 1800),
    "far tree": (lambda r: far_tree(r, False), 5, 17, 9, 150),
    "far conifer": (lambda r: far_tree(r, True), 7.5, 24, 7, 50),
    "bush": (bush, 0.4, 2.6, 4, 1200),
    "hedge": (lambda r: hedge(r, 20.0), 0.7, 2.5, 11, HEDGE_CARDS + 10),
    "grass": (grass_patch, 0.04, 0.5, 1.2, 240),
    "reeds": (reeds, 0.7, 2.4, 3, 600),
    "rock": (rock, 0.3, 0.8, 0.8, 130),
    "person": (person, 1.45, 2.0, 0.9, 350),
    "car": (car, 1.35, 2.25, 2.8, 300),
    "boat": (boat, 0.5, 19, 7, 300),
    "lamp post": (lamp_post, 3, 9.2, 2.5, 100),
    "bench": (bench, 0.4, 1.2, 1.2, 80),
    "fence": (lambda r: fence(r, 20.0), 0.8, 1.6, 10.2, 1000),
    "pole": (utility_pole, 6.9, 11.1, 1.1, 100),
    "sign": (sign, 2, 3.2, 0.9, 80),
    "bale": (hay_bale, 0.39, 1.65, 1.2, 100),
    "bollard": (bollard, 0.6, 1.1, 0.2, 70),
    "umbrella": (umbrella, 2.1, 2.9, 2, 260),
    "statue": (statue, 2.4, 6, 1.4, 400),
    "pier": (lambda r: pier(r, 20.0), 0.8, 2.3, 10.2, 1000),
    "bridge": (lambda r: bridge(r, 20.0), 1.5, 6, 10.2, 600),
    "turbine": (wind_turbine, 75, 190, 70, 200),
    "house": (house, 4, 14, 10, HOUSE_FACES),
    "block": (
        lambda r: block(r, 20.0, 15.0, 5), 13, 28, 12, BLOCK_FACES
    ),
    "row": (lambda r: row(r, 60.0), 5, 32, 60.2, ROW_FACES),
    "tower": (tower, 40, 185, 32, TOWER_FACES),
    "barn": (barn, 5, 13, 14, 400),
    "shed": (shed, 1.9, 4.5, 3, 150),
    "church": (church, 8, 40, 22, 1200),
    "castle wall": (castle_wall, 3, 25, 25, 1000),
    "castle tower": (castle_tower, 5, 20, 7, 400),
    "lighthouse": (lighthouse, 13, 33, 5, 900),
    "wall": (lambda r: wall(r, 20.0), 0.5, 2.8, 10.6, 800),
    "stairs": (lambda r: stairs(r, 4.0), 0.4, 4, 5, 200),
    "arcade": (lambda r: arcade(r, 20.0), 3, 9, 10.5, 600),
    "street": (lambda r: street_surface(8.0, 100.0, r), 0.1, 0.2, 100.1, 200),
}  # fmt: skip


def same(one, other):
    return (
        one.names == other.names
        and np.array_equal(one.vertices, other.vertices)
        and np.array_equal(one.faces, other.faces)
        and np.array_equal(one.materials, other.materials)
    )


@pytest.mark.parametrize("name", THINGS)
def test_a_thing_is_whole_and_of_its_size(name):
    make, low, high, reach, most = THINGS[name]
    for seed in range(4):
        found = make(chance(seed))
        check(found)
        assert all(is_known(material) for material in found.names), found.names
        assert low < found.vertices[:, 2].max() < high
        assert -3.1 < found.vertices[:, 2].min() < 0.1  # it stands on the ground, or in it
        assert np.abs(found.vertices[:, :2]).max() < reach
        assert len(found.faces) <= most


@pytest.mark.parametrize("name", THINGS)
def test_a_seed_tells_a_thing(name):
    make = THINGS[name][0]
    first = make(chance(5))
    assert same(first, make(chance(5)))
    assert not same(first, make(chance(6)))


@pytest.mark.parametrize("kind", CAR_KINDS)
def test_cars_stand_on_four_wheels(kind):
    found = car(chance(), kind)
    rubber = found.faces[found.materials == found.names.index("rubber")]
    wheels = found.vertices[np.unique(rubber)]
    wheels = wheels[wheels[:, 2] < 0.03]
    assert {(bool(x > 0), bool(y > 0)) for x, y, _ in wheels} == {
        (a, b) for a in (False, True) for b in (False, True)
    }


def test_a_wire_hangs_between_its_ends():
    wire = power_line(np.array([0, 0, 8.0]), np.array([40, 0, 8.0]), 1.5)
    check(wire)
    assert wire.vertices[:, 2].min() == pytest.approx(6.5, abs=0.05)
    assert np.ptp(wire.vertices[:, 0]) == pytest.approx(40, abs=0.1)


def test_a_row_of_houses_fills_its_length_and_faces_the_street():
    for seed in range(3):
        x, y, _ = row(chance(seed), 60.0).vertices.T
        assert x.min() == pytest.approx(0, abs=0.2)
        assert x.max() == pytest.approx(60, abs=0.2)
        assert y.min() > -2.5  # balconies and cornices over the pavement at most


def test_a_prism_s_and_boxes_faces_look_outwards():
    found = boxes((0, 0, 0), (2, 3, 4), "stone")
    assert not open_edges(found)
    assert volume(found) == pytest.approx(24)
    roof = prism([(0, 0), (4, 0), (2, 1)], -3, 3, "roof0")
    assert not open_edges(roof)
    assert volume(roof) == pytest.approx(12)


def test_openings_of_a_wall_are_holes_with_reveals():
    edges = np.array([[1.0, 2.0], [4.0, 5.5]])
    found = pierced(7, 0, 3, edges, np.array([[1.0, 0.0]]), np.array([2.5]), 0.2, "stone")
    check(found)
    front = np.isclose(found.vertices[found.faces][..., 1], 0).all(1)
    assert -facing(found)[front, 1].sum() / 2 == pytest.approx(21 - 1.5 - 3.75)
    assert found.vertices[:, 1].max() == pytest.approx(0.2)
