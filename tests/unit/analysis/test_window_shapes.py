"""Windows are upright trapezia in rows and columns, however ragged what the network sees is."""

import cv2
import numpy as np
import pytest

from sunwidget.analysis.windows import panes, shapes
from sunwidget.analysis.windows.shapes import FOOT, TALL, TOP, WIDE, X, Y

SIZE = 240, 360
GRID = [(x, y) for y in (40, 90, 140) for x in range(40, 330, 40)]


def seen(windows, level=0.9, ragged=0.0):
    """What a network sees of windows (n, 6): the likelier, the farther from an edge."""
    picture = np.zeros(SIZE, np.float32)
    for window in windows:
        picture = np.maximum(picture, shapes.filled(shapes.corners(window), SIZE))
    noise = cv2.GaussianBlur(np.random.default_rng(1).normal(0, 1, SIZE), (0, 0), 1.5)
    return np.clip(level * picture + ragged * noise / noise.std() * (picture > 0), 0, 1)


def grid(slope=0.0):
    """Windows of 14 x 24 pixels; with a slope their sills run towards the picture's middle."""
    rows = []
    for x, y in GRID:
        slopes = [slope * (y + off - 120) for off in (-12, 12)]
        rows.append((x, y + sum(slopes) / 2 * (x - 180), 14, 24, *slopes))
    return np.array(rows)


def matched(found, known):
    """The windows that are nearest to the known ones."""
    apart = np.linalg.norm(known[:, None, [X, Y]] - found[None, :, [X, Y]], axis=2)
    assert apart.min(1).max() < 2
    return found[apart.argmin(1)]


@pytest.mark.parametrize("slope", [0.0, 0.002])
def test_ragged_windows_of_a_facade_become_the_trapezia_they_are(slope):
    known = grid(slope)
    picture = seen(known, level=0.75, ragged=0.12)
    found = shapes.find(picture).windows
    assert len(found) == len(known)
    error = np.abs(matched(found, known) - known)
    assert error[:, [X, Y]].max() < 1.2
    assert error[:, [WIDE, TALL]].max() < 2.2
    assert error[:, [TOP, FOOT]].max() < 0.08


def test_neighbours_straighten_what_one_window_alone_tells_wrongly():
    known = grid()
    picture = seen(known)
    x, y = GRID[12]
    picture[y : y + 13, x - 7 : x + 8] = 0  # its lower half is hidden
    own = shapes.aligned(known)
    assert np.allclose(own, known)
    half = known[12] - [0, 6, 0, 12, 0, 0]
    told = shapes.aligned(np.vstack([known[:12], half * [1, 1, 1, 1.6, 1, 1], known[13:]]))
    assert abs(told[12, Y] - y) < 3


def test_what_is_hardly_seen_is_a_window_where_its_row_and_column_say_so():
    known = grid()
    picture = np.maximum(seen(np.delete(known, 12, 0)), seen(known[12:13], level=0.35))
    assert len(shapes.find(picture).windows) == len(known)
    apart = known[12] + [17, 22, 0, 0, 0, 0]
    picture = np.maximum(seen(np.delete(known, 12, 0)), seen(apart[None], level=0.35))
    assert len(shapes.find(picture).windows) == len(known) - 1
    assert not len(shapes.find(seen(known, level=0.35)).windows)


def test_windows_that_touch_are_told_apart_where_the_network_is_surer():
    known = np.array([(x, 100, 26, 40, 0, 0) for x in (100, 132, 164)], float)
    picture = seen(known)
    picture[90:110, 88:178] = np.maximum(picture[90:110, 88:178], 0.55)
    found = shapes.find(picture).windows
    assert len(found) == 3
    assert np.abs(np.sort(found[:, X]) - [100, 132, 164]).max() < 2


def test_posts_boards_and_specks_are_no_windows():
    things = np.array(
        [(60, 120, 5, 150, 0, 0), (200, 60, 120, 12, 0, 0), (200, 150, 2, 2, 0, 0)], float
    )
    found = shapes.find(seen(things))
    assert not len(found.windows)
    assert not found.wall.any()


def test_a_wall_of_glass_has_rooms_behind_it():
    picture = np.zeros(SIZE, np.float32)
    picture[30:200, 100:200] = 0.9
    found = shapes.find(picture)
    assert not len(found.windows)
    (wall,) = shapes.walls(found.wall)
    assert (wall.left, len(wall.top)) == (100, 100)
    assert np.allclose(wall.top, 30, atol=1)
    assert np.allclose(wall.foot, 200, atol=1)
    light = panes.lamps([panes.View(picture, picture)])[..., 0]
    assert 0.1 < (light[30:200, 100:200] > 0).mean() < 0.8
    light[30:200, 100:200] = 0
    assert not light.any()
    tall = np.array([(180, 120, 20, 90, 0, 0)], float)
    windows, (tower,) = shapes.stacks(np.vstack([tall, grid()]), SIZE)
    assert np.array_equal(windows, grid())
    assert np.array_equal(tower.inside, shapes.filled(shapes.corners(tall[0]), SIZE) > 0.5)
    assert np.allclose([tower.top, tower.foot], [[75], [165]])


def test_a_large_surface_that_is_no_tower_is_not_lit():
    picture = np.zeros(SIZE, np.float32)
    picture[100:180, 60:300] = 0.9
    assert shapes.find(picture).wall.any()
    assert not panes.lamps([panes.View(picture, picture)]).any()


def test_a_filled_trapezium_has_the_area_that_it_has():
    window = np.array([50.3, 40.7, 10.4, 20.6, 0.1, -0.2])
    left, right = shapes.corners(window)[[0, 3], 1], shapes.corners(window)[[1, 2], 1]
    area = 10.4 * 0.5 * (left[1] - left[0] + right[1] - right[0])
    cover = shapes.filled(shapes.corners(window), SIZE)
    assert cover.sum() == pytest.approx(area, rel=0.05)
    assert (cover * np.arange(SIZE[1])).sum() / cover.sum() == pytest.approx(50.3, abs=0.3)


def test_windows_side_by_side_light_one_room_and_others_their_own():
    row = np.array([(x, 100, 14, 24, 0, 0) for x in (40, 57, 74, 140)], float)
    assert [list(room) for room in panes.rooms(row)] == [[0, 1, 2], [3]]
    assert panes.rooms(row[:0]) == []


def test_bars_stay_dark_from_side_to_side():
    known = np.array([(180, 120, 24, 40, 0, 0)], float)
    pane = seen(known)
    pane[:, 179:182] = 0
    for shift in range(40):  # a place where some light falls
        moved = known + np.array([shift, 0, 0, 0, 0, 0])
        view = panes.View(seen(moved), np.roll(pane, shift, 1))
        light = panes.lamps([view])[105:135, :, 0]
        if light.any():
            break
    at = 180 + shift
    assert light[:, at].max() == 0
    assert light[:, at - 9 : at - 4].mean() > 0
    assert (panes.lamps([panes.View(*[seen(moved)] * 2)])[105:135, at, 0] > 0).any()


def test_what_hides_a_window_stays_dark():
    known = np.array([(180, 120, 24, 40, 0, 0)], float)
    for shift in range(40):
        picture = seen(known + np.array([shift, 0, 0, 0, 0, 0]))
        picture[100:140, 177 + shift : 180 + shift] = 0
        light = panes.lamps([panes.View(picture, picture)])[..., 0]
        if light.any():
            break
    assert light[110:130, 178 + shift].max() == 0
    assert light[110:130, 172 + shift].max() > 0


def test_shutters_and_boards_have_no_glass_and_no_light():
    known = grid()
    picture = seen(known)
    assert panes.lamps([panes.View(picture, picture)])[..., 0].any()
    assert not panes.lamps([panes.View(picture, 0.08 * picture)])[..., 0].any()


def test_large_windows_are_seen_in_a_coarse_picture_and_small_ones_in_a_fine_one():
    small = grid()
    large = np.array([(180, 205, 44, 32, 0, 0)], float)
    half = cv2.resize(seen(np.vstack([small, large])), None, fx=0.5, fy=0.5, interpolation=3)
    found = shapes.find(seen(small), half).windows
    assert len(found) == len(small) + 1
    error = np.abs(matched(found, np.vstack([small, large])) - np.vstack([small, large]))
    assert error[:, [X, Y, WIDE, TALL]].max() < 2
    # Panes of one window, in a fine picture, are what it is made of.
    parts = np.array([(x, 205, 19, 30, 0, 0) for x in (169, 192)], float)
    assert len(shapes.find(seen(parts), half * 0).windows) == 2
    assert len(shapes.find(seen(np.vstack([small, parts])), half).windows) == len(small) + 2
