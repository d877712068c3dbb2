"""Cycles at work: pictures in linear light, and maps of labels that photos lack."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np
import OpenEXR
from mathutils import Matrix

from training.worlds import CLASSES
from training.worlds.materials import Palette
from training.worlds.mesh import Mesh
from training.worlds.sky import Sky, Sun

_SAMPLES, _SUN_SAMPLES, _OPEN_SAMPLES = 8, 4, 8
_GRAZING = 0.03  # cosine below which light is not asked for
_COLUMNS, _ABOVE = 24, 9000.0  # of the air at the horizon; metres, over all land
_FAR = 40_000.0  # metres; beyond it is sky
_SHARED = Path("/dev/shm")
_SCRATCH = _SHARED if _SHARED.is_dir() else Path(tempfile.gettempdir())


@dataclass(frozen=True)
class View:
    """A camera: place in metres; vertical field of view, pitch, roll in radians; picture's size."""

    place: tuple[float, float, float]
    fov: float
    pitch: float
    roll: float
    width: int
    height: int

    @property
    def half_angle(self) -> float:
        """Half of the horizontal field of view, radians."""
        return float(np.arctan(np.tan(self.fov / 2) * self.width / self.height))


def empty(threads: int) -> None:
    """Forget the last world."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    scene.render.use_persistent_data = True
    scene.view_settings.view_transform = "Raw"
    scene.cycles.device = "CPU"
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.max_bounces, scene.cycles.diffuse_bounces = 4, 2
    scene.cycles.glossy_bounces, scene.cycles.transmission_bounces = 2, 2
    scene.cycles.caustics_reflective = scene.cycles.caustics_refractive = False
    scene.cycles.sample_clamp_indirect = 40
    scene.cycles.denoising_quality = scene.cycles.denoising_prefilter = "FAST"
    scene.render.image_settings.media_type = "MULTI_LAYER_IMAGE"
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.image_settings.color_depth = "32"
    layer = bpy.context.scene.view_layers[0]
    layer.use_pass_z = layer.use_pass_normal = True
    layer.use_pass_diffuse_color = layer.use_pass_material_index = True


def add(name: str, mesh: Mesh, palette: Palette) -> bpy.types.Mesh:
    """Return the mesh as Blender keeps it, with its materials."""
    data = bpy.data.meshes.new(name)
    triangle = mesh.faces[:, 3] == mesh.faces[:, 2]
    corners = np.where(triangle, 3, 4)
    starts = np.concatenate([[0], np.cumsum(corners)[:-1]])
    keep = np.ones_like(mesh.faces, bool)
    keep[triangle, 3] = False
    data.vertices.add(len(mesh.vertices))
    data.vertices.foreach_set("co", mesh.vertices.astype(np.float32).ravel())
    loops = mesh.faces[keep].astype(np.int32)
    data.loops.add(len(loops))
    data.loops.foreach_set("vertex_index", loops)
    data.polygons.add(len(corners))
    data.polygons.foreach_set("loop_start", starts.astype(np.int32))
    data.polygons.foreach_set("material_index", mesh.materials.astype(np.int32))
    data.update(calc_edges=True)
    for material in mesh.names:
        data.materials.append(palette[material])
    (data.shade_smooth if mesh.smooth else data.shade_flat)()
    return data


def put(
    data: bpy.types.Mesh,
    place: tuple[float, float, float] = (0, 0, 0),
    turned: float = 0.0,
    scaled: float | tuple[float, float, float] = 1.0,
) -> bpy.types.Object:
    """Stand a mesh somewhere; the same mesh may stand in many places."""
    thing = bpy.data.objects.new(data.name, data)
    thing.location = place
    thing.rotation_euler = (0, 0, turned)
    thing.scale = (scaled,) * 3 if np.isscalar(scaled) else scaled
    bpy.context.scene.collection.objects.link(thing)
    return thing


def look(view: View) -> bpy.types.Object:
    """Return the camera, put there; it heads along +y."""
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = view.width, view.height
    if scene.camera is None:
        scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        scene.collection.objects.link(scene.camera)
    camera = scene.camera
    camera.data.sensor_fit, camera.data.angle = "VERTICAL", view.fov
    camera.data.clip_start, camera.data.clip_end = 0.05, 4 * _FAR
    camera.location = view.place
    turn = Matrix.Rotation(np.pi / 2 + view.pitch, 3, "X") @ Matrix.Rotation(view.roll, 3, "Z")
    camera.rotation_euler = turn.to_euler()
    return camera


def measure(
    sky: Sky, suns: Sequence[Sun], view: View, *, pictures: int, clear: float = 0.0
) -> dict[str, np.ndarray] | None:
    """Render a view; None if less than ``clear`` metres before it is to be seen.

    The first ``pictures`` P of the S suns are photographed, of the others only what they light is
    measured, which costs a tenth.

    Returns
    -------
    dict
        ``light`` (P, H, W, 3) float16, scene-linear, each frame by its own ``scale`` (P,): radiance
        is light × scale; ``sunlit`` (S, H, W) uint8, share of the sun's disc that a surface sees;
        ``openness`` (H, W) uint8, share of a white sky's light that reaches it; ``depth`` (H, W)
        float16, log2 of metres along the view axis, inf in the sky; ``normal`` (H, W, 3) int8, ×127
        in the camera's right, up and towards it; ``albedo`` (H, W, 3) uint8, ×255 linear;
        ``matter`` (H, W) uint8, index into ``CLASSES``; ``air`` (P, 24, 3) float32, radiance
        of the sky at the horizon, by columns of the view.
    """
    camera = look(view)
    sky.set(suns[0])
    ahead = np.median(_render(1, denoise=False)["Depth"])
    if ahead * np.tan(view.fov / 2) < clear:
        return None
    light, scales = [], []
    maps: dict[str, np.ndarray] = {}
    for sun in suns[:pictures]:
        sky.set(sun)
        passes = _render(_SAMPLES, denoise=True)
        radiance = np.clip(np.nan_to_num(passes["Combined"][..., :3]), 0, None)
        scale = max(float(np.percentile(radiance, 90)), 1e-6)
        light.append(np.minimum(radiance / scale, 6e4).astype(np.float16))
        scales.append(scale)
        if not maps:
            maps = _maps(passes, camera)
    maps["light"], maps["scale"] = np.stack(light), np.array(scales, np.float32)
    maps |= _lit(sky, suns)
    maps["air"] = _air(sky, suns[:pictures], view)
    return maps


def _air(sky: Sky, suns: Sequence[Sun], view: View) -> np.ndarray:
    """Return what far land fades to: the sky over the horizon, by columns of the view."""
    width = min(2 * view.half_angle, np.radians(150))
    height = 2 * np.arctan(np.tan(width / 2) / _COLUMNS)
    look(View((0, 0, _ABOVE), height, float(np.radians(2)), 0.0, _COLUMNS, 1))
    found = []
    for sun in suns:
        sky.set(sun)
        found.append(_render(16, denoise=False)["Combined"][0, :, :3])
    return np.stack(found).astype(np.float32)


def _maps(passes: dict[str, np.ndarray], camera: bpy.types.Object) -> dict[str, np.ndarray]:
    z = passes["Depth"][..., 0]
    sky = z > _FAR
    turn = np.array(camera.matrix_world.to_3x3())
    normal = np.where(sky[..., None], 0, passes["Normal"][..., :3]) @ turn
    return {
        "depth": np.where(sky, np.inf, np.log2(np.maximum(z, 0.01))).astype(np.float16),
        "normal": np.rint(np.clip(normal, -1, 1) * 127).astype(np.int8),
        "albedo": np.rint(np.clip(passes["Diffuse Color"][..., :3], 0, 1) * 255).astype(np.uint8),
        "matter": np.where(
            sky, 0, np.clip(passes["Material Index"][..., 0], 0, len(CLASSES) - 1)
        ).astype(np.uint8),
    }


def _lit(sky: Sky, suns: Sequence[Sun]) -> dict[str, np.ndarray]:
    """Return what of the sun and what of the sky reaches every place, all matter being alike."""
    layer, scene = bpy.context.scene.view_layers[0], bpy.context.scene
    lamp = bpy.data.lights.new("sun", "SUN")
    lamp.angle, lamp.energy = np.radians(0.53), np.pi
    thing = bpy.data.objects.new("sun", lamp)
    scene.collection.objects.link(thing)
    bounces = scene.cycles.max_bounces
    layer.material_override, scene.cycles.max_bounces = _white(), 0
    sky.flat(0)
    shares = [_share(thing, sun) for sun in suns]
    bpy.data.objects.remove(thing)
    sky.flat(1)
    openness = _render(_OPEN_SAMPLES, denoise=True)["Combined"][..., 0]
    layer.material_override, scene.cycles.max_bounces = None, bounces
    none = np.zeros_like(openness)
    return {
        "sunlit": _bytes(np.stack([none if share is None else share for share in shares])),
        "openness": _bytes(openness),
    }


def _share(lamp: bpy.types.Object, sun: Sun) -> np.ndarray | None:
    """Return the share of the sun's disc seen from every place; None where it lights nothing."""
    if sun.covered or sun.elevation <= 0:
        return None
    lamp.rotation_euler = (np.pi / 2 - sun.elevation, 0, -sun.azimuth + np.pi)
    passes = _render(_SUN_SAMPLES, denoise=False)
    cosine = passes["Normal"][..., :3] @ sun.direction
    return np.where(cosine > _GRAZING, passes["Combined"][..., 0] / np.maximum(cosine, _GRAZING), 0)


def _bytes(share: np.ndarray) -> np.ndarray:
    return np.rint(np.clip(share, 0, 1) * 255).astype(np.uint8)


def _white() -> bpy.types.Material:
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    surface = tree.nodes.new("ShaderNodeBsdfDiffuse")
    surface.inputs["Color"].default_value = (1, 1, 1, 1)
    out = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(surface.outputs[0], out.inputs["Surface"])
    return material


def _render(samples: int, *, denoise: bool) -> dict[str, np.ndarray]:
    """Return the passes of one picture, each (H, W, channels) float32, row 0 on top."""
    scene = bpy.context.scene
    scene.cycles.samples, scene.cycles.use_denoising = samples, denoise
    path = _SCRATCH / f"world-{os.getpid()}.exr"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    passes: dict[str, np.ndarray] = {}
    with OpenEXR.File(str(path), separate_channels=True) as file:
        for part in range(len(file.parts)):
            channels = file.channels(part)
            for name in dict.fromkeys(key.rsplit(".", 1)[0] for key in channels):
                found = [
                    channels[f"{name}.{c}"].pixels for c in "RGBAXYZV" if f"{name}.{c}" in channels
                ]
                passes[name.rsplit(".", 1)[-1]] = np.stack(found, -1).astype(np.float32)
    path.unlink()
    return passes
