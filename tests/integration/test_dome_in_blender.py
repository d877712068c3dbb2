"""The dome in Blender: the page's own lines, shadows where the sun says, light as computed."""

import importlib
import importlib.util
import json

import cv2
import numpy as np
import pytest
from pages import blocks

import sunwidget as sw
from sunwidget.dome.disc import sun_disc
from sunwidget.dome.sphere import angles, irradiance, solid_angles
from sunwidget.export.dome.light import DomeLight
from sunwidget.export.dome.photo import write_dome
from sunwidget.formats.color import LUMINANCE

pytestmark = pytest.mark.skipif(
    any(importlib.util.find_spec(name) is None for name in ("bpy", "OpenEXR")),
    reason="needs bpy, which only the extra train brings, and OpenEXR",
)

WIDTH = 1024
AZIMUTH, ELEVATION = 70.0, 30.0
PIXELS, METRES = 200, 8.0  # of the view from above
FLOOR = 0.8  # albedo


def a_dome(scene):
    """A sky brighter ahead than behind, over black ground, with the model's own sun."""
    air = scene.atmosphere.replace(residual=None, confidence=None)
    disc = sun_disc(air, AZIMUTH, ELEVATION, (WIDTH, WIDTH // 2))
    azimuth, elevation = angles(WIDTH)
    level = np.where(elevation > 0, 3 + 2 * np.cos(np.radians(azimuth)), 0)
    return DomeLight(
        sky=(level[..., None] * [0.7, 1, 1.5]).astype(np.float32),
        disc=disc.astype(np.float32),
        seen=np.zeros(level.shape, np.float32),
        mirrored=False,
        direct=(disc * solid_angles(WIDTH)[..., None]).sum((0, 1)),
        direction=(AZIMUTH, ELEVATION),
        through=1.0,
        albedo=np.full(3, 0.2),
    )


@pytest.fixture(params=[True, False], ids=["disc in the map", "sun as a lamp"])
def floor(request, tmp_path, monkeypatch, root):
    """A box on a floor seen from above, (PIXELS, PIXELS, 3) linear; x to the right, y up."""
    scene = sw.analyze(cv2.resize(sw.sample("coast").encoded, (96, 64)))
    write_dome(
        tmp_path / "sky.exr", scene, sw.Edit(), a_dome(scene), sun=request.param, overwrite=False
    )
    bpy = importlib.import_module("bpy")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    page = (root / "docs" / "guide" / "dome.md").read_text("utf-8")
    (code,) = (block for block in blocks(page, "python") if "bpy" in block)
    monkeypatch.chdir(tmp_path)
    exec(compile(code, "dome.md", "exec"), {})
    return seen_from_above(bpy, tmp_path / "floor.exr")


def seen_from_above(bpy, path):
    bpy.ops.mesh.primitive_plane_add(size=40)
    material = bpy.data.materials.new("floor")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    diffuse = nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (FLOOR, FLOOR, FLOOR, 1)
    output = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(diffuse.outputs[0], output.inputs["Surface"])
    bpy.context.object.data.materials.append(material)
    bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 0, 0.5))
    lens = bpy.data.cameras.new("above")
    lens.type, lens.ortho_scale = "ORTHO", METRES
    camera = bpy.data.objects.new("above", lens)
    camera.location = (0, 0, 20)
    scene = bpy.context.scene
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 96, False
    scene.render.resolution_x = scene.render.resolution_y = PIXELS
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    return sw.open(path).pixels


def places():
    middle = (np.arange(PIXELS) + 0.5) / PIXELS * METRES - METRES / 2
    return np.meshgrid(middle, -middle)


@pytest.mark.filterwarnings("ignore:.*use_nodes.*:DeprecationWarning")
def test_the_shadow_falls_away_from_the_sun_and_the_floor_is_as_bright_as_computed(floor, tmp_path):
    x, y = places()
    level = cv2.medianBlur((floor @ LUMINANCE).astype(np.float32), 3)
    lit = np.median(level)
    box = np.maximum(np.abs(x), np.abs(y)) < 0.5
    shadow = (level < 0.6 * lit) | box
    # A swept square is symmetric about half its way: its centre of mass lies there.
    way = -2 * np.array([x[shadow].mean(), y[shadow].mean()])
    sun = json.loads((tmp_path / "sky.json").read_text())["sun"]
    wanted = np.arctan2(sun["direction"][1], sun["direction"][0])
    off = np.degrees(np.arctan2(way[1], way[0]) - wanted)
    assert abs((off + 180) % 360 - 180) < 1.0
    assert np.degrees(np.arctan2(1, np.hypot(*way))) == pytest.approx(ELEVATION, abs=1.0)
    dome = a_dome(sw.analyze(cv2.resize(sw.sample("coast").encoded, (96, 64))))
    up = irradiance(dome.sky) + np.sin(np.radians(ELEVATION)) * dome.direct
    far = np.hypot(x, y) > 3.5
    np.testing.assert_allclose(np.median(floor[far], axis=0), FLOOR * up / np.pi, rtol=0.04)
