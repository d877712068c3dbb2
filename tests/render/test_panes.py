"""Windows are found and lit: by lamps of their own, seen at dusk and drowned by day."""

import cv2
import numpy as np
import pytest
from house_scenes import SIZE, facade, house_scene
from relight_scenes import known_photo

import sunwidget as sw
from sunwidget.analysis import frame_inputs
from sunwidget.analysis.windows import panes
from sunwidget.renderer import render
from sunwidget.widgets.kernel.payload import preset_json

DUSK = sw.Edit(sun_elevation=-4, window_lights=1)


@pytest.fixture(scope="module")
def house():
    return house_scene()


@pytest.fixture(scope="module")
def meadow():
    return known_photo(size=(240, 160), clouds=False).analyze()


def lit_everywhere(scene, pane):
    """The scene with lamps of median light where ``pane`` says, (h, w) bool."""
    lamps = np.zeros((*pane.shape, 4), np.float32)
    lamps[pane] = (1 / panes.BRIGHTEST, 0, 0.5, 1)
    scene.__dict__["lamps"] = lamps
    return scene


def test_panes_of_a_drawn_house_are_found():
    picture, glass = facade()
    found = (
        cv2.resize(panes.look(sw.open(picture))[0].window, SIZE, interpolation=cv2.INTER_AREA) > 0.5
    )
    assert (found & glass).sum() / (found | glass).sum() > 0.5


def test_a_photo_without_windows_has_no_lamps_and_nothing_to_light(meadow):
    assert meadow.lamps.shape == (1, 1, 4)
    off = render(meadow, DUSK.replace(window_lights=0), dtype="float32")
    assert np.array_equal(render(meadow, DUSK.replace(window_lights=4), dtype="float32"), off)


def test_at_dusk_panes_are_the_brightest_of_a_house_and_by_day_they_drown(house):
    _, glass = facade()
    lit = glass & (cv2.resize(house.lamps[..., 0], SIZE) > 0.15)
    assert lit.sum() > 0.15 * glass.sum()
    wall = np.zeros_like(glass)
    wall[70:225, 62:70] = True
    level = {
        name: render(house, edit, dtype="float32") @ [0.2126, 0.7152, 0.0722]
        for name, edit in {
            "dusk": DUSK,
            "dark": DUSK.replace(window_lights=0),
            "day": sw.Edit(sun_elevation=50, window_lights=1),
            "unlit": sw.Edit(sun_elevation=50),
        }.items()
    }
    assert level["dusk"][lit].mean() > 2.5 * level["dusk"][wall].mean()
    assert level["dark"][lit].mean() < level["dark"][wall].mean()
    assert np.abs(level["day"] - level["unlit"])[lit].mean() < 0.01


@pytest.mark.parametrize("kelvin", [2000, 2900, 4500, 6500])
def test_the_light_has_the_colour_of_a_black_body(kelvin):
    import colour

    scene = known_photo(size=(240, 160), clouds=False).analyze()
    where = np.zeros((160, 240), bool)
    where[135:150, 100:140] = True
    lit_everywhere(scene, where)
    # So little that the picture's tone curve is a line.
    edit = sw.Edit(window_temperature=kelvin, sun_elevation=-4, window_lights=0.02)
    new = render(scene, edit, dtype="float32") - render(
        scene, edit.replace(window_lights=0), dtype="float32"
    )
    found = new[138:147, 105:135].mean((0, 1)) / frame_inputs.uniforms(scene)["sky_gain"]
    spectrum = colour.sd_blackbody(kelvin)
    xyz = colour.sd_to_XYZ(spectrum) / 100
    expected = colour.XYZ_to_RGB(xyz, "sRGB", np.array([0.3127, 0.3290]), None)
    expected = np.clip(expected, 0, None)
    assert found / found.sum() == pytest.approx(expected / expected.sum(), abs=0.04)


def test_unlit_windows_change_nothing_to_the_bit(house):
    assert np.array_equal(render(house, sw.Edit(window_temperature=5000)), house.photo.encoded)


def test_the_same_photo_has_the_same_evening_and_some_rooms_stay_dark():
    pane = np.zeros((240, 360), np.float32)
    for x in range(10, 350, 20):
        for y in range(10, 230, 20):
            pane[y : y + 9, x : x + 7] = 1
    first, again = (panes.lamps([panes.View(pane, pane)]) for _ in range(2))
    assert np.array_equal(first, again)
    centres = first[14:230:20, 13:350:20, 0]
    assert 0.25 < (centres == 0).mean() < 0.55
    # A window elsewhere comes or goes: the others keep their lamps.
    pane[10:19, 10:17] = 0
    other = panes.lamps([panes.View(pane, pane)])[14:230:20, 13:350:20, 0]
    assert np.array_equal(other.ravel()[1:], centres.ravel()[1:])


def test_no_pane_is_in_the_sky(house):
    sky = cv2.resize(house.sky, house.panes.shape[::-1])
    assert house.panes[sky > 0.99].max() < 0.02


def test_the_preset_lights_windows_and_others_switch_them_off(house):
    edit = sw.preset("dusk_lights", house)
    assert edit.window_lights == 1
    assert edit.sun_elevation < 0
    assert sw.preset("noon", house, edit).window_lights == 0


def test_the_editor_offers_lights_where_there_are_windows(house, meadow):
    offered = [{p["label"] for p in preset_json(scene)} for scene in (house, meadow)]
    assert offered[0] - offered[1] == {"Lights on"}
    assert not offered[1] - offered[0]


def test_nobody_looks_for_windows_that_are_not_lit_nor_twice_in_a_photo(monkeypatch):
    looked = []
    look = panes._look
    monkeypatch.setattr(panes, "_look", lambda *view: looked.append(view) or look(*view))
    scene = known_photo(size=(120, 80), clouds=False).analyze()
    render(scene, sw.Edit(sun_elevation=-4))
    assert not looked
    render(scene, DUSK)
    render(scene, DUSK.replace(strokes=(sw.Stroke("sky", ((0.5, 0.1),)),)))
    assert len(looked) == 2  # two sizes


def test_lights_that_are_switched_on_later_are_the_same(house):
    fresh = sw.analyze(sw.open(facade()[0]))
    render(fresh, DUSK.replace(window_lights=0))
    assert np.array_equal(render(fresh, DUSK), render(house, DUSK))
