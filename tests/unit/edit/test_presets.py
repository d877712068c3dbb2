"""Presets set the time of day and nothing else, and put the sun where a photo shows it."""

import dataclasses

import pytest
from relight_scenes import known_scene, sample_scene

import sunwidget as sw
from sunwidget import presets
from sunwidget.cli.main import main
from sunwidget.edit.table import Edit, Stroke, parameter
from sunwidget.errors import EditError


def with_sun_at(scene, azimuth, elevation):
    """The scene as if its sun had been assumed there."""
    return dataclasses.replace(scene, sun=None, assumed_sun=(azimuth, elevation))


def test_all_presets_set_the_same_parameters_within_their_ranges():
    names = {frozenset(p.parameters) for p in presets.PRESETS}
    assert names == {frozenset(("sun_elevation", "light_source", "exposure", "window_lights"))}
    for preset in presets.PRESETS:
        assert sw.preset(preset.name, known_scene()).changed().keys() <= {
            "sun_azimuth",
            *preset.parameters,
        }
        for name, value in preset.parameters.items():
            row = parameter(name)
            assert value in row.choices or row.minimum <= value <= row.maximum


@pytest.mark.parametrize("name", presets.NAMES)
def test_a_preset_leaves_all_else_and_forgets_the_preset_before(name):
    scene = known_scene()
    mine = Edit(strokes=(Stroke("sky", ((0.5, 0.1),)),), cloud_opacity=0.4, glow=2, fov_hint=45.0)
    once = sw.preset(name, scene, mine)
    own = ("sun_azimuth", "sun_elevation", "light_source", "exposure", "window_lights")
    for p in sw.PARAMETERS:
        assert p.name in own or getattr(once, p.name) == getattr(mine, p.name)
    for other in presets.NAMES:
        assert sw.preset(name, scene, sw.preset(other, scene, mine)) == once


def test_a_sun_before_the_camera_keeps_its_azimuth_and_one_behind_comes_into_view():
    scene = known_scene()
    assert sw.preset("sunset", scene).sun_azimuth == pytest.approx(scene.sun.azimuth)
    for own in (-170.0, -95.0, 120.0):
        behind = with_sun_at(scene, own, 30.0)
        for name in presets.NAMES:
            found = sw.preset(name, behind)
            if name == "noon":
                assert found.sun_azimuth == own
                continue
            x, _ = scene.camera.pixel(found.sun_azimuth, max(found.sun_elevation, 0.1))
            assert 0.25 < x / scene.width < 0.75


def test_a_sun_is_brought_in_over_the_lower_skyline():
    scene = known_scene()
    for side in (slice(None, 60), slice(60, None)):
        sky = scene.sky.copy()
        sky[20:, side] = 0
        behind = dataclasses.replace(with_sun_at(scene, 180.0, 30.0), sky=sky)
        assert (sw.preset("sunset", behind).sun_azimuth > 0) == (side.start is None)


def test_the_presets_light_the_land_in_the_order_of_their_names():
    scene = sample_scene("coast")
    land = scene.sky < 0.02
    level = {
        name: sw.render(scene, sw.preset(name, scene), dtype="float32")[land].mean()
        for name in presets.NAMES
    }
    assert min(level["noon"], level["golden_hour"]) > level["sunset"] > level["blue_hour"]
    assert level["blue_hour"] > level["moonlight"] > 0.001


@pytest.mark.parametrize(
    ("name", "meant"),
    [("sunst", "sunset"), ("Blue Hour", "blue_hour"), ("golden-hour", "golden_hour")],
)
def test_a_misspelt_preset_is_told_the_right_spelling(name, meant, capsys):
    with pytest.raises(EditError, match=f"Did you mean '{meant}'"):
        sw.preset(name, known_scene())
    with pytest.raises(SystemExit):
        main(["render", "no.jpg", "-o", "out.png", "--preset", name])
    assert f"Did you mean '{meant}'" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["", 3, "midnight sun over the sea"])
def test_what_is_like_no_preset_is_told_all_of_them(name):
    with pytest.raises(EditError, match="dawn, golden_hour"):
        presets.find(name)


def test_the_command_line_takes_recipe_preset_and_flags_in_this_order(tmp_path, monkeypatch):
    scene, drawn = known_scene(), []
    monkeypatch.setattr("sunwidget.cli.render.scene_to_draw", lambda _: scene)
    monkeypatch.setattr(sw, "save", lambda pair, *_a, **_k: drawn.append(pair[1]), raising=False)
    recipe = tmp_path / "recipe.json"
    recipe.write_text(Edit(glow=0.5, exposure=2, sun_elevation=33).to_json())
    out = str(tmp_path / "out.png")
    main(["render", "x.jpg", "-o", out, "--recipe", str(recipe), "--preset", "sunset",
          "--sun-elevation", "4"])  # fmt: skip
    (edit,) = drawn
    preset = presets.find("sunset")
    assert (edit.glow, edit.sun_elevation) == (0.5, 4.0)
    assert edit.exposure == preset.parameters["exposure"]
