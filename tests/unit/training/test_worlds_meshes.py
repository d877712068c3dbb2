"""Meshes as arrays, and the balls, boxes and tubes that the rest is made of."""

import numpy as np
import pytest
from world_meshes import check, facing, open_edges, volume

from training.worlds.mesh import ball, box, joined, mesh, tube

UP_TUBE = ([[0, 0, 0], [0.1, 0, 1], [0, 0.2, 2.5]], [0.3, 0.2, 0.1])


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
