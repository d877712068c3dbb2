"""Worlds made by seed, as far as neither Blender nor torch is needed, and photos taken of them."""

import ast
import functools
import inspect
import zlib
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest

from training.land import photograph
from training.worlds import CLASSES, buildings, ground, props
from training.worlds.families import TEST, TRAINING, World
from training.worlds.ground import Ground, Noise
from training.worlds.mesh import ball, box, joined, mesh, tube

FAMILIES = TRAINING | TEST
SEEDS = dict.fromkeys(FAMILIES, (0, 1)) | {"city": (0,)}  # it takes a while to make
QUICK = ("coast", "field", "woods", "dunes", "mountains", "park", "fjord", "orchard")  # to make
UP_TUBE = ([[0, 0, 0], [0.1, 0, 1], [0, 0.2, 2.5]], [0.3, 0.2, 0.1])


def chance(seed=0):
    return np.random.default_rng(seed)


def check(found):
    """Every mesh: finite, its faces and materials within what there is."""
    assert np.isfinite(found.vertices).all()
    assert found.vertices.shape[1:] == (3,)
    assert found.faces.shape[1:] == (4,)
    assert 0 <= found.faces.min() <= found.faces.max() < len(found.vertices)
    assert found.materials.shape == (len(found.faces),)
    assert 0 <= found.materials.min() <= found.materials.max() < len(found.names)


def same(one, other):
    return (
        one.names == other.names
        and np.array_equal(one.vertices, other.vertices)
        and np.array_equal(one.faces, other.faces)
        and np.array_equal(one.materials, other.materials)
    )


def open_edges(found):
    """Edges, as pairs of places, that no other face goes along the other way."""
    _, place = np.unique(found.vertices.round(7), axis=0, return_inverse=True)
    faces = place.reshape(-1)[found.faces]
    edges = np.stack([faces, np.roll(faces, -1, 1)], -1).reshape(-1, 2)
    edges = [(int(a), int(b)) for a, b in edges if a != b]
    assert len(set(edges)) == len(edges), "two faces go along an edge the same way"
    return set(edges) - {(b, a) for a, b in edges}


def facing(found):
    """Twice the vector areas of the faces, (M, 3): along the normals."""
    a, b, c, d = found.vertices[found.faces].transpose(1, 0, 2)
    return np.cross(c - a, d - b)


def volume(found):
    a, b, c, d = found.vertices[found.faces].transpose(1, 0, 2)
    return ((np.cross(a, b) * c).sum() + (np.cross(a, c) * d).sum()) / 6


# Meshes


def test_a_triangle_repeats_its_last_index():
    found = mesh(np.zeros((4, 3)), [(0, 1, 2), (0, 1, 2, 3)], "rock")
    assert found.faces.tolist() == [[0, 1, 2, 2], [0, 1, 2, 3]]


def test_moved_scales_then_turns_then_moves():
    found = mesh([[1, 0, 0], [0, 1, 1]], [(0, 1, 1)], "rock")
    there = found.moved((10, 20, 30), np.pi / 2, (2, 3, 4)).vertices
    assert there == pytest.approx(np.array([[10, 22, 30], [7, 20, 34]]))
    assert found.moved(scaled=2).vertices == pytest.approx(2 * found.vertices)
    assert found.moved().vertices == pytest.approx(found.vertices)


def test_joined_parts_share_materials_and_keep_their_faces():
    parts = [box(1, 1, 1, "rock"), box(1, 1, 1, "snow"), box(2, 2, 2, "rock")]
    parts.append(joined(parts[1::-1]).moved((5, 0, 0)))
    found = joined(parts)
    check(found)
    assert found.names == ("rock", "snow")
    starts = np.cumsum([0, 8, 8, 8])
    at = 0
    for part, start in zip(parts, starts, strict=True):
        here = slice(at, at + len(part.faces))
        assert np.array_equal(found.faces[here], part.faces + start)
        names = [found.names[i] for i in found.materials[here]]
        assert names == [part.names[i] for i in part.materials]
        at += len(part.faces)
    assert at == len(found.faces)


def test_joined_parts_are_smooth_if_the_first_is():
    round_, flat = ball(1, "rock"), box(1, 1, 1, "rock")
    assert joined([round_, flat]).smooth
    assert not joined([flat, round_]).smooth


def test_a_box_is_closed_and_faces_outwards():
    found = box(2, 3, 4, "rock")
    assert not open_edges(found)
    outwards = found.vertices[found.faces].mean(1) - (0, 0, 2)
    assert ((facing(found) * outwards).sum(1) > 0).all()
    assert volume(found) == pytest.approx(24)
    assert found.vertices.min(0) == pytest.approx((-1, -1.5, 0))
    assert found.vertices.max(0) == pytest.approx((1, 1.5, 4))


def test_a_ball_is_closed_and_faces_outwards():
    found = ball(2, "rock", 16, 24)
    assert not open_edges(found)
    assert ((facing(found) * found.vertices[found.faces].mean(1)).sum(1) > 0).all()
    assert np.linalg.norm(found.vertices, axis=1) == pytest.approx(2)
    assert 0.9 < volume(found) / (4 / 3 * np.pi * 8) < 1


def test_a_tube_is_closed_but_for_its_foot_and_faces_outwards():
    found = tube(*UP_TUBE, "bark", 9)
    check(found)
    edges = open_edges(found)
    assert len(edges) == 9
    feet = {tuple(v) for v in found.vertices[:9].round(7)}
    places = np.unique(found.vertices.round(7), axis=0)
    assert {tuple(places[i]) for edge in edges for i in edge} == feet
    centres = found.vertices[found.faces].mean(1)
    path = np.array(UP_TUBE[0])
    middle = np.stack([np.interp(centres[:, 2], path[:, 2], path[:, i]) for i in range(3)], -1)
    sides = slice(0, 18)
    assert ((facing(found) * (centres - middle)).sum(1)[sides] > 0).all()
    assert (facing(found)[18:, 2] > 0).all()  # its end


def test_a_tube_is_as_thick_as_told_whichever_way_it_goes():
    for way in ((0, 0, 1), (1, 0, 0), (0, -1, 0), (1, 2, -3)):
        found = tube(np.outer([0, 1, 2], way), [0.5, 0.5, 0.5], "metal", 8)
        axis = np.array(way) / np.linalg.norm(way)
        rim = found.vertices[:-1]
        off = rim - (rim @ axis)[:, None] * axis
        assert np.linalg.norm(off, axis=1) == pytest.approx(0.5)


# Noise and ground


def grid(count=120, step=0.37):
    return np.meshgrid(np.arange(count) * step - 17.0, np.arange(count) * step - 9.0)


def test_noise_is_told_by_its_seed():
    places = grid()
    assert np.array_equal(Noise(chance(3))(*places), Noise(chance(3))(*places))
    one, other = Noise(chance(3))(*places).ravel(), Noise(chance(4))(*places).ravel()
    assert abs(np.corrcoef(one, other)[0, 1]) < 0.1


def test_noise_is_bounded_even_and_smooth():
    noise = Noise(chance())
    x, y = grid()
    found = noise(x, y)
    assert np.abs(found).max() < 0.75
    assert abs(found.mean()) < 0.02
    assert found.std() > 0.15
    assert noise(np.floor(x), np.floor(y)) == pytest.approx(0)
    assert np.abs(noise(x + 1e-4, y) - found).max() < 1e-3


def test_fractal_noise_and_ridges_are_bounded():
    noise = Noise(chance())
    fractal, ridges = noise.fractal(*grid(), 20.0), noise.ridges(*grid(), 20.0)
    assert np.abs(fractal).max() < 1.4
    assert ridges.min() >= 0
    assert 1 < ridges.max() < 2


def rolling(water=None):
    """Hills by a formula, green below a metre and rock above it, scree where it is steep."""

    def heights(x, y):
        return 2 * np.sin(x / 30) + np.cos(y / 50)

    def cover(x, y, z, slope):
        return np.where(slope > 0.06, 2, np.where(z > 1, 1, 0))

    return Ground(heights, cover, ("grass", "rock", "scree"), water)


def test_water_is_the_lowest_that_the_land_is_told_to_be():
    x, y = grid(step=3.0)
    dry, wet = rolling().at(x, y), rolling(0.5).at(x, y)
    assert np.array_equal(dry, rolling().heights(x, y))
    assert dry.min() < 0
    assert np.array_equal(wet, np.maximum(dry, 0.5))
    sheet = rolling(0.5).sheet()
    check(sheet)
    assert sheet.names == ("water",)
    assert (sheet.vertices[:, 2] == 0.5).all()
    assert (facing(sheet)[:, 2] > 0).all()


def test_slope_is_the_tangent():
    plane = Ground(lambda x, y: 0.3 * x - 0.4 * y, lambda x, *_: 0 * x, ("rock",))
    assert plane.slope(*grid()) == pytest.approx(0.5)


@pytest.fixture
def coarse(monkeypatch):
    """Fewer texels of land: the same mesh, made faster."""
    for name, count in (("_RINGS", 40), ("_SEEN", 30), ("_BEHIND", 10)):
        monkeypatch.setattr(ground, name, count)


@pytest.mark.parametrize("half_angle", [0.2, 0.9, 3.1])
def test_the_land_s_mesh_follows_the_heights_without_a_gap(half_angle, coarse):
    land = rolling()
    found = land.mesh(half_angle)
    check(found)
    x, y, z = found.vertices.T
    assert np.array_equal(z, land.heights(x, y))
    assert np.hypot(x, y).max() > 10_000  # no end is to be seen
    assert np.hypot(x, y).min() == 0  # and no hole at the camera's feet
    turn = np.sort(np.arctan2(x, y)[np.hypot(x, y) > 10_000])
    steps = np.diff([*turn, turn[0] + 2 * np.pi])
    ring = 0.5 * np.hypot(x, y).max() ** 2 * np.sin(steps).sum()
    assert np.abs(facing(found)[:, 2]).sum() / 2 == pytest.approx(ring)
    counts = np.bincount(found.faces.ravel(), minlength=len(x))
    assert counts.min() >= 2


def test_the_land_faces_up(coarse):
    assert (facing(rolling().mesh(0.4))[:, 2] > 0).all()


def test_the_land_is_finest_in_view_and_near():
    found = rolling().mesh(0.4)
    centres = found.vertices[found.faces].mean(1)
    angle = np.arctan2(centres[:, 0], centres[:, 1])
    seen = np.abs(angle) < 0.4
    assert seen.mean() > 0.7
    far = np.hypot(*centres[:, :2].T)
    size = np.sqrt(np.linalg.norm(facing(found), axis=1))
    assert size[seen & (far < 3)].max() < 0.2 < size[seen & (far > 1000)].min()
    ring = (far > 90) & (far < 110)
    assert size[ring & seen].max() < 0.5 * size[ring & ~seen].min()


def test_the_land_lies_about_where_it_is_asked_for(coarse):
    found = rolling().mesh(0.4, (300.0, -40.0))
    x, y, z = found.vertices.T
    assert np.hypot(x - 300, y + 40).min() == 0
    assert np.array_equal(z, rolling().heights(x, y))


def test_what_covers_the_land_is_told_by_height_and_slope():
    land = rolling()
    found = land.mesh(0.5)
    assert found.names == land.names
    x, y, z = found.vertices[found.faces].mean(1).T
    near = np.hypot(x, y) < 300
    steep = np.hypot(np.cos(x / 30) / 15, np.sin(y / 50) / 50)
    sure = near & (np.abs(steep - 0.06) > 0.005)
    wanted = np.where(steep > 0.06, 2, np.where(z > 1, 1, 0))
    assert set(wanted[sure]) == {0, 1, 2}
    assert np.array_equal(found.materials[sure], wanted[sure])


# Families


@functools.cache
def materials_known():
    """Names and classes of ``materials._TABLE``, read: to import it takes Blender."""
    path = Path(inspect.getfile(ground)).with_name("materials.py")
    for statement in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(statement, ast.AnnAssign) and statement.target.id == "_TABLE":
            return {name: row[3] for name, row in ast.literal_eval(statement.value).items()}
    raise AssertionError("materials.py has no _TABLE any more")


def is_known(name):
    return name in materials_known() or name in {"water", "glass"} or name.startswith("wall")


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
def test_a_family_s_land_is_whole(family, coarse):
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


# Things


THINGS = {  # maker: lowest and highest top in metres, reach to a side at most, faces at most
    "broadleaf": (props.broadleaf, 4, 17, 7, 1600),
    "poplar": (props.poplar, 8.5, 23, 4, 1600),
    "conifer": (props.conifer, 4.5, 26, 8, 1200),
    "palm": (props.palm, 3, 14, 7, 1000),
    "bare tree": (props.bare_tree, 3.9, 15.1, 10, 1800),
    "far tree": (lambda r: props.far_tree(r, False), 5, 17, 9, 150),
    "far conifer": (lambda r: props.far_tree(r, True), 7.5, 24, 7, 50),
    "bush": (props.bush, 0.4, 2.6, 4, 1200),
    "hedge": (lambda r: props.hedge(r, 20.0), 0.7, 2.5, 11, props.HEDGE_CARDS + 10),
    "grass": (props.grass_patch, 0.04, 0.5, 1.2, 240),
    "reeds": (props.reeds, 0.7, 2.4, 3, 600),
    "rock": (props.rock, 0.3, 0.8, 0.8, 130),
    "person": (props.person, 1.45, 2.0, 0.9, 350),
    "car": (props.car, 1.35, 2.25, 2.8, 300),
    "boat": (props.boat, 0.5, 19, 7, 300),
    "lamp post": (props.lamp_post, 3, 9.2, 2.5, 100),
    "bench": (props.bench, 0.4, 1.2, 1.2, 80),
    "fence": (lambda r: props.fence(r, 20.0), 0.8, 1.6, 10.2, 1000),
    "pole": (props.utility_pole, 6.9, 11.1, 1.1, 100),
    "sign": (props.sign, 2, 3.2, 0.9, 80),
    "bale": (props.hay_bale, 0.39, 1.65, 1.2, 100),
    "bollard": (props.bollard, 0.6, 1.1, 0.2, 70),
    "umbrella": (props.umbrella, 2.1, 2.9, 2, 260),
    "statue": (props.statue, 2.4, 6, 1.4, 400),
    "pier": (lambda r: props.pier(r, 20.0), 0.8, 2.3, 10.2, 1000),
    "bridge": (lambda r: props.bridge(r, 20.0), 1.5, 6, 10.2, 600),
    "turbine": (props.wind_turbine, 75, 190, 70, 200),
    "house": (buildings.house, 4, 14, 10, buildings.HOUSE_FACES),
    "block": (
        lambda r: buildings.block(r, 20.0, 15.0, 5), 13, 28, 12, buildings.BLOCK_FACES
    ),
    "row": (lambda r: buildings.row(r, 60.0), 5, 32, 60.2, buildings.ROW_FACES),
    "tower": (buildings.tower, 40, 185, 32, buildings.TOWER_FACES),
    "barn": (buildings.barn, 5, 13, 14, 400),
    "shed": (buildings.shed, 1.9, 4.5, 3, 150),
    "church": (buildings.church, 8, 40, 22, 1200),
    "castle wall": (buildings.castle_wall, 3, 25, 25, 1000),
    "castle tower": (buildings.castle_tower, 5, 20, 7, 400),
    "lighthouse": (buildings.lighthouse, 13, 33, 5, 900),
    "wall": (lambda r: buildings.wall(r, 20.0), 0.5, 2.8, 10.6, 800),
    "stairs": (lambda r: buildings.stairs(r, 4.0), 0.4, 4, 5, 200),
    "arcade": (lambda r: buildings.arcade(r, 20.0), 3, 9, 10.5, 600),
    "street": (lambda r: buildings.street_surface(8.0, 100.0, r), 0.1, 0.2, 100.1, 200),
}  # fmt: skip


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


@pytest.mark.parametrize("kind", props.CAR_KINDS)
def test_cars_stand_on_four_wheels(kind):
    found = props.car(chance(), kind)
    rubber = found.faces[found.materials == found.names.index("rubber")]
    wheels = found.vertices[np.unique(rubber)]
    wheels = wheels[wheels[:, 2] < 0.03]
    assert {(bool(x > 0), bool(y > 0)) for x, y, _ in wheels} == {
        (a, b) for a in (False, True) for b in (False, True)
    }


def test_a_wire_hangs_between_its_ends():
    wire = props.power_line(np.array([0, 0, 8.0]), np.array([40, 0, 8.0]), 1.5)
    check(wire)
    assert wire.vertices[:, 2].min() == pytest.approx(6.5, abs=0.05)
    assert np.ptp(wire.vertices[:, 0]) == pytest.approx(40, abs=0.1)


def test_a_row_of_houses_fills_its_length_and_faces_the_street():
    for seed in range(3):
        x, y, _ = buildings.row(chance(seed), 60.0).vertices.T
        assert x.min() == pytest.approx(0, abs=0.2)
        assert x.max() == pytest.approx(60, abs=0.2)
        assert y.min() > -2.5  # balconies and cornices over the pavement at most


def test_a_prism_s_and_boxes_faces_look_outwards():
    found = buildings.boxes((0, 0, 0), (2, 3, 4), "stone")
    assert not open_edges(found)
    assert volume(found) == pytest.approx(24)
    roof = buildings._prism([(0, 0), (4, 0), (2, 1)], -3, 3, "roof0")
    assert not open_edges(roof)
    assert volume(roof) == pytest.approx(12)


def test_openings_of_a_wall_are_holes_with_reveals():
    edges = np.array([[1.0, 2.0], [4.0, 5.5]])
    found = buildings.pierced(7, 0, 3, edges, np.array([[1.0, 0.0]]), np.array([2.5]), 0.2, "stone")
    check(found)
    front = np.isclose(found.vertices[found.faces][..., 1], 0).all(1)
    assert -facing(found)[front, 1].sum() / 2 == pytest.approx(21 - 1.5 - 3.75)
    assert found.vertices[:, 1].max() == pytest.approx(0.2)


# Photos


@pytest.mark.parametrize("shape", [(186, 279), (279, 186), (228, 228), (171, 304)])
def test_a_box_lies_inside_the_picture_and_has_the_wanted_proportions(shape):
    random = chance(2)
    for rows, columns in ((128, 192), (192, 128), (160, 160), (96, 160)):
        boxes = [photograph.box(random, shape, rows, columns) for _ in range(40)]
        for found in boxes:
            assert 0 <= found.top <= found.top + found.height <= shape[0]
            assert 0 <= found.left <= found.left + found.width <= shape[1]
            assert found.width == pytest.approx(found.height * columns / rows, abs=2)
            scale = min(shape[0] / rows, shape[1] / columns)
            assert found.height > 0.64 * scale * rows - 1
        assert {found.mirrored for found in boxes} == {False, True}
        assert len({(found.top, found.left, found.height) for found in boxes}) > 10
    assert found.of(np.zeros((*shape, 3), np.float32)).shape == (rows, columns, 3)


def test_a_mirrored_box_is_the_other_one_flipped():
    picture = chance().random((60, 90, 3)).astype(np.float32)
    plain, mirrored = (photograph.Box(5, 7, 40, 60, 20, 30, flag) for flag in (False, True))
    assert mirrored.of(picture) == pytest.approx(plain.of(picture)[:, ::-1], abs=1e-6)
    whole = photograph.Box(5, 7, 40, 60, 40, 60, False)
    assert np.array_equal(whole.of(picture), picture[5:45, 7:67])


def halves(ratio=5.0, scale=1.0):
    """Radiance, the right half ``ratio`` times as bright as the left."""
    light = chance(1).uniform(0.7, 1.3, (48, 64, 3)).astype(np.float32)
    light[:, 32:] *= ratio
    return light * np.float32(scale)


def test_a_photo_is_bright_where_the_world_is():
    for seed in range(24):
        found = photograph.develop(halves(), chance(seed))
        assert found.dtype == np.uint8
        assert found.shape == (48, 64, 3)
        left, right = found[:, :30].mean(), found[:, 34:].mean()
        assert right > left + 15
        assert 5 < found.mean() < 250


def test_a_camera_exposes_for_the_light_there_is():
    for seed in range(6):
        dim, bright = (photograph.develop(halves(scale=s), chance(seed)) for s in (0.01, 300.0))
        assert np.abs(dim.astype(int) - bright).max() <= 2


def test_a_camera_shoots_the_same_by_the_same_seed_and_otherwise_by_another():
    shots = [photograph.develop(halves(), chance(seed)) for seed in (7, 7, 8)]
    assert np.array_equal(shots[0], shots[1])
    assert not np.array_equal(shots[0], shots[2])


def test_glare_takes_no_light_away_and_spreads_from_what_is_bright():
    light = np.full((40, 60, 3), 0.1, np.float32)
    light[20, 30] = 2000
    found = photograph.glare(light, chance())
    assert (found >= light).all()
    assert found[20, 33].mean() > found[20, 55].mean() > 0.1


def hazy(log_depth, seed=0):
    """Grey land at these depths (log2 of metres) under a horizon red on its left, blue right."""
    light = np.full((4, 60, 3), 0.5, np.float32)
    depth = np.full((4, 60), log_depth, np.float16)
    depth[0] = np.inf
    horizon = np.repeat([[4, 1, 0.5], [0.5, 1, 4]], 12, 0).astype(np.float32)
    return light, photograph.with_air(light, depth, horizon, chance(seed))


def test_air_leaves_the_sky_and_what_is_near_alone():
    for seed in range(8):
        light, found = hazy(1.0, seed)
        assert np.array_equal(found[0], light[0])
        assert found == pytest.approx(light, rel=0.02)


def test_air_pulls_far_land_towards_the_horizon_s_colour():
    for seed in range(8):
        _, found = hazy(15.99, seed)  # 65 km
        before = np.abs(0.5 - np.array([4, 1, 0.5]))
        after = np.abs(found[2, 2] - (4, 1, 0.5))
        assert (after <= 0.75 * before + 1e-6).all()
        assert found[2, 2, 0] > found[2, 2, 2]
        assert found[2, -3, 2] > found[2, -3, 0]


def test_more_air_lies_before_what_is_farther():
    for seed in range(8):
        reds = [hazy(depth, seed)[1][2, 2, 0] for depth in (3, 7, 10, 13, 15)]
        assert reds == sorted(reds)
        assert reds[-1] > reds[0] + 0.3
