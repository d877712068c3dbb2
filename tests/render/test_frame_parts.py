"""Pixels that are sky or land alone are drawn by shaders that leave the other out.

So are photos whose clouds nobody edits, dry land, and water away from the old sun's glints.
"""

import importlib
import json

import numpy as np
import pytest

import sunwidget as sw
from sunwidget.edit.table import Edit
from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.graph import FrameGraph, Programs
from sunwidget.renderer.shader_source import frame_graph

module = importlib.import_module("sunwidget.renderer.offscreen")
EDITS = [
    Edit(),
    Edit(sun_elevation=3),
    Edit(sun_azimuth=9, sun_elevation=-4),
    Edit(sun_elevation=20, light_source="moon", glow=2, light_shafts=1),
    Edit(sun_elevation=6, added_clouds=0.6, aerosol_optical_depth=0.3, grain=2),
    Edit(sun_elevation=4, sky_strength=0.5, land_strength=0.7, colour_loss="power"),
    Edit(sun_elevation=9, cloud_opacity=0.4),
    Edit(sun_elevation=9, cloud_opacity=1.6, cloud_softness=0.5),
    Edit(sun_elevation=5, sun_azimuth=2, glitter=2, wind_speed=9),
]


@pytest.fixture(scope="module")
def drawn():
    """Draw edits in parts, and all by the pass's own shader."""
    scene = sw.analyze(sw.sample("coast").preview(240))
    size = scene.photo.size

    def make(context):
        whole = json.loads(json.dumps(frame_graph()))
        for row in whole["passes"]:
            row.pop("parts", None)
        textures = module.scene_textures(scene, size)
        programs = Programs(context)
        return FrameGraph(programs, textures), FrameGraph(programs, textures, whole)

    graphs = on_gl_thread(make)

    def draw(edit, dtype):
        return on_gl_thread(
            lambda _: [module.draw_part(graph, scene, edit, size, dtype) for graph in graphs]
        )

    return draw


@pytest.mark.parametrize("edit", EDITS, ids=range(len(EDITS)))
def test_a_frame_in_parts_is_the_frame_drawn_at_once(drawn, edit):
    parts, whole = drawn(edit, "uint8")
    assert np.array_equal(parts, whole)


def test_parts_outlast_another_method_and_another_depth_of_levels(drawn):
    edit = Edit(sun_elevation=3)
    first, _ = drawn(edit, "uint8")
    drawn(edit.replace(method="thesis"), "uint8")
    light, _ = drawn(edit, "float32")
    again, whole = drawn(edit, "uint8")
    assert light.dtype == np.float32
    assert np.array_equal(again, first)
    assert np.array_equal(again, whole)
