"""A pass runs again only when a value that it reads changed."""

import importlib

import numpy as np
import pytest
from relight_scenes import known_scene

from sunwidget.edit.table import Edit
from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.shader_source import frame_graph

module = importlib.import_module("sunwidget.renderer.offscreen")
SUN_PASSES = {
    "sky_view_edit",
    "light_edit",
    "visibility_edit",
    "meter_edit",
    "mirror_edit",
    "mirror_ratio",
    "air_edit",
    "shadow_edit",
    "land_terms",
    "land_shade",
    "land_sunshine",
    "veil",
    "composite_constants",
    "frame",
}
AIR_PASSES = {
    "first_order_edit",
    "first_field_edit",
    "second_order_edit",
    "multiple_scattering_edit",
}


@pytest.fixture
def passes_run_by():
    """Render an edit; return the names of the passes that ran."""
    scene = known_scene()

    def draw(edit):
        graph = on_gl_thread(
            lambda context: module._renderer(context).graph(scene, (scene.width, scene.height))
        )
        before = dict(graph.runs)
        module.render(scene, edit)
        return {name for name, count in graph.runs.items() if count != before.get(name, 0)}

    return draw


def test_the_same_edit_again_runs_no_pass(passes_run_by):
    passes_run_by(Edit(sun_elevation=5))
    assert passes_run_by(Edit(sun_elevation=5)) == set()


def test_moving_the_sun_runs_neither_the_source_nor_multiple_scattering(passes_run_by):
    passes_run_by(Edit(sun_elevation=5))
    assert passes_run_by(Edit(sun_elevation=6)) == SUN_PASSES


@pytest.mark.parametrize(
    ("name", "value", "passes"),
    [
        ("light_shafts", 0.5, {"shaft_rings_edit", "shafts_edit"}),
        ("added_clouds", 0.4, {"added_layer"}),
        ("cloud_softness", 0.5, {"soft_sky"}),
    ],
)
def test_a_pass_runs_only_where_its_parameter_is_above_zero(passes_run_by, name, value, passes):
    first = passes_run_by(Edit(sun_elevation=5))
    assert not first & passes
    plain = module.render(known_scene(), Edit(sun_elevation=5))
    assert passes_run_by(Edit(sun_elevation=5, **{name: value})) >= passes
    assert not passes_run_by(Edit(sun_elevation=5)) & passes
    assert np.array_equal(module.render(known_scene(), Edit(sun_elevation=5)), plain)


def test_more_haze_runs_the_edits_air_and_no_source(passes_run_by):
    passes_run_by(Edit(sun_elevation=5))
    ran = passes_run_by(Edit(sun_elevation=5, aerosol_optical_depth=0.33))
    assert ran > AIR_PASSES
    assert not {name for name in ran if name.endswith("_source")}
    assert not ran & {"columns_source", "columns_edit", "scene_light", "sky_behind"}


def test_another_scale_height_draws_the_edits_columns_anew_and_no_source(passes_run_by):
    passes_run_by(Edit(sun_elevation=5))
    ran = passes_run_by(Edit(sun_elevation=5, rayleigh_scale_height=9000))
    assert ran > AIR_PASSES | {"columns_edit"}
    assert not {name for name in ran if name.endswith("_source")}


def test_fewer_orders_draw_no_order_anew(passes_run_by):
    passes_run_by(Edit(sun_elevation=5))
    ran = passes_run_by(Edit(sun_elevation=5, scattering_orders=3))
    assert ran & (AIR_PASSES | {"columns_edit"}) == {"multiple_scattering_edit"}


@pytest.mark.parametrize("name", ["exposure", "auto_exposure", "colourfulness"])
def test_exposure_runs_the_terms_and_the_frame_only(passes_run_by, name):
    passes_run_by(Edit(sun_elevation=5, **{name: 0.25}))
    assert passes_run_by(Edit(sun_elevation=5, **{name: 0.75})) == {
        "composite_constants",
        "mirror_ratio",
        "veil",
        "frame",
    }


@pytest.mark.parametrize(
    "name", ["sky_strength", "cloud_strength", "silver_lining", "land_strength"]
)
def test_a_strength_runs_the_frame_only(passes_run_by, name):
    passes_run_by(Edit(sun_elevation=5, **{name: 0.25}))
    assert passes_run_by(Edit(sun_elevation=5, **{name: 0.75})) == {"frame"}


def test_a_parameter_of_the_thesis_leaves_the_ratio_picture_alone(passes_run_by):
    passes_run_by(Edit(sun_elevation=5))
    assert passes_run_by(Edit(sun_elevation=5, sun_sky_ratio=10, blend_power=3)) == set()


def test_changing_the_method_and_back_gives_the_same_picture():
    scene = known_scene()
    first = module.render(scene, Edit(sun_elevation=5))
    thesis = module.render(scene, Edit(sun_elevation=5, method="thesis"))
    assert np.abs(thesis.astype(int) - first).max() > 8
    assert np.array_equal(module.render(scene, Edit(sun_elevation=5)), first)


def test_literal_after_corrected_thesis_runs_the_frame_alone(passes_run_by):
    passes_run_by(Edit(sun_elevation=5, method="thesis"))
    assert passes_run_by(Edit(sun_elevation=5, method="thesis_literal")) == {"frame"}


def test_a_new_texture_is_drawn(passes_run_by):
    scene = known_scene()
    size = (scene.width, scene.height)
    edit = Edit(sun_elevation=5)
    first = module.render(scene, edit)
    textures = module.scene_textures(scene, size)
    graph = on_gl_thread(lambda context: module._renderer(context).graph(scene, size))
    try:
        on_gl_thread(lambda _: graph.set_texture("photo", textures["photo"] * np.float32(0.5)))
        assert passes_run_by(edit) == {
            *("retouched", "sky_behind", "water_level", "water_behind"),
            *("scene_light", "own_sky", "frame"),
        }
        assert module.render(scene, edit).mean() < 0.9 * first.mean()
    finally:
        on_gl_thread(lambda _: graph.set_texture("photo", textures["photo"]))
    assert np.array_equal(module.render(scene, edit), first)


def test_every_pass_of_a_method_runs_on_a_fresh_picture():
    scene = known_scene()

    def task(context):
        fresh = module._Renderer(context).graph(scene, (48, 32))
        module.draw_part(fresh, scene, Edit(method="thesis"), (48, 32), "uint8")
        return fresh.runs

    rows = frame_graph()["passes"]
    assert on_gl_thread(task) == {
        row["name"]: 1 for row in rows if "thesis" in row.get("when", ["thesis"])
    }
