"""Materials by name: albedos as measured of such surfaces, with two tints mixed by noise."""

from __future__ import annotations

import bpy
import numpy as np

from training.worlds import CLASSES
from training.worlds.mesh import Random

Tint = np.ndarray | tuple[float, float, float]

# Linear albedo of two tints (each also jittered in a world), roughness, class.
_TABLE: dict[str, tuple[tuple[float, float, float], tuple[float, float, float], float, str]] = {
    "grass": ((0.045, 0.085, 0.020), (0.11, 0.13, 0.045), 0.9, "vegetation"),
    "dry_grass": ((0.22, 0.17, 0.085), (0.34, 0.27, 0.14), 0.9, "vegetation"),
    "meadow": ((0.055, 0.095, 0.025), (0.16, 0.15, 0.06), 0.9, "vegetation"),
    "crop": ((0.07, 0.11, 0.03), (0.30, 0.24, 0.10), 0.9, "vegetation"),
    "heath": ((0.09, 0.06, 0.045), (0.12, 0.10, 0.05), 0.9, "vegetation"),
    "forest": ((0.020, 0.040, 0.012), (0.045, 0.065, 0.020), 0.9, "vegetation"),
    "leaves": ((0.040, 0.080, 0.018), (0.09, 0.13, 0.035), 0.6, "vegetation"),
    "needles": ((0.018, 0.038, 0.016), (0.035, 0.055, 0.022), 0.7, "vegetation"),
    "dry_leaves": ((0.28, 0.13, 0.03), (0.40, 0.24, 0.05), 0.7, "vegetation"),
    "reeds": ((0.20, 0.17, 0.08), (0.12, 0.14, 0.05), 0.8, "vegetation"),
    "bark": ((0.08, 0.06, 0.045), (0.16, 0.13, 0.11), 0.9, "vegetation"),
    "soil": ((0.07, 0.045, 0.028), (0.16, 0.11, 0.07), 0.95, "ground"),
    "gravel": ((0.18, 0.17, 0.155), (0.30, 0.28, 0.25), 0.9, "ground"),
    "asphalt": ((0.055, 0.055, 0.057), (0.11, 0.11, 0.11), 0.8, "ground"),
    "paving": ((0.20, 0.19, 0.17), (0.36, 0.33, 0.29), 0.75, "ground"),
    "kerb": ((0.33, 0.32, 0.30), (0.40, 0.39, 0.37), 0.8, "ground"),
    "line": ((0.65, 0.65, 0.62), (0.55, 0.55, 0.53), 0.7, "ground"),
    "sand": ((0.30, 0.24, 0.16), (0.42, 0.35, 0.25), 0.95, "rock"),
    "wet_sand": ((0.12, 0.095, 0.065), (0.18, 0.14, 0.10), 0.35, "rock"),
    "rock": ((0.12, 0.11, 0.10), (0.30, 0.28, 0.25), 0.9, "rock"),
    "red_rock": ((0.28, 0.12, 0.06), (0.40, 0.21, 0.12), 0.9, "rock"),
    "scree": ((0.20, 0.19, 0.18), (0.33, 0.31, 0.29), 0.95, "rock"),
    "snow": ((0.82, 0.84, 0.87), (0.90, 0.91, 0.92), 0.6, "snow"),
    "trim": ((0.60, 0.59, 0.56), (0.68, 0.67, 0.64), 0.7, "building"),
    "roof0": ((0.30, 0.11, 0.06), (0.40, 0.17, 0.10), 0.8, "building"),
    "roof1": ((0.07, 0.075, 0.085), (0.14, 0.145, 0.155), 0.6, "building"),
    "roof2": ((0.16, 0.13, 0.10), (0.26, 0.22, 0.18), 0.7, "building"),
    "stone": ((0.28, 0.25, 0.21), (0.42, 0.38, 0.33), 0.85, "building"),
    "awning": ((0.45, 0.05, 0.04), (0.60, 0.55, 0.48), 0.8, "building"),
    "wood": ((0.16, 0.10, 0.06), (0.28, 0.19, 0.12), 0.7, "object"),
    "metal": ((0.12, 0.125, 0.13), (0.30, 0.30, 0.31), 0.45, "object"),
    "paint": ((0.30, 0.30, 0.31), (0.30, 0.30, 0.31), 0.3, "object"),
    "plastic": ((0.30, 0.12, 0.05), (0.10, 0.20, 0.35), 0.5, "object"),
    "cloth": ((0.10, 0.11, 0.16), (0.20, 0.15, 0.12), 0.9, "object"),
    "cloth2": ((0.30, 0.10, 0.09), (0.45, 0.43, 0.40), 0.9, "object"),
    "skin": ((0.35, 0.20, 0.14), (0.45, 0.28, 0.20), 0.6, "object"),
    "hair": ((0.02, 0.015, 0.01), (0.10, 0.06, 0.03), 0.6, "object"),
    "rubber": ((0.02, 0.02, 0.02), (0.03, 0.03, 0.03), 0.8, "object"),
    "sail": ((0.60, 0.58, 0.54), (0.70, 0.68, 0.64), 0.8, "object"),
    "lamp": ((0.55, 0.55, 0.50), (0.60, 0.60, 0.55), 0.3, "object"),
}
_GLASS = "glass"
_THIN = ("leaves", "dry_leaves", "grass", "dry_grass", "reeds", "sail")
_WALLS = (
    (0.68, 0.66, 0.62), (0.62, 0.55, 0.42), (0.58, 0.45, 0.28), (0.52, 0.33, 0.26),
    (0.30, 0.13, 0.09), (0.24, 0.12, 0.085), (0.36, 0.35, 0.33), (0.26, 0.25, 0.24),
    (0.42, 0.37, 0.30), (0.30, 0.26, 0.21), (0.45, 0.52, 0.55), (0.35, 0.42, 0.34),
    (0.16, 0.10, 0.065), (0.75, 0.75, 0.74),
)  # fmt: skip
_COLOURED = ("paint", "cloth", "cloth2", "awning", "plastic")


class Palette:
    """The materials of one world: made when first asked for, coloured by its seed."""

    def __init__(self, random: Random, *, wet: float = 0.0, waves: float = 0.3) -> None:
        self._random, self._wet, self._waves = random, wet, waves
        self._made: dict[str, bpy.types.Material] = {}

    def __getitem__(self, name: str) -> bpy.types.Material:
        if name not in self._made:
            self._made[name] = self._make(name)
        return self._made[name]

    def _make(self, name: str) -> bpy.types.Material:
        if name == "water":
            return _water(self._random, self._waves)
        if name == _GLASS:
            return _matter(name, (0.02, 0.022, 0.025), (0.03, 0.03, 0.03), 0.06, "building")
        if name.startswith("wall"):
            tint = np.array(_WALLS[self._random.integers(len(_WALLS))])
            first, second, rough, kind = tint, tint * self._random.uniform(0.8, 1), 0.85, "building"
        else:
            first, second, rough, kind = _TABLE[name]
        jitter = np.exp(self._random.normal(0, 0.18)) * np.exp(self._random.normal(0, 0.05, 3))
        if name in _COLOURED:
            jitter = jitter * np.exp(self._random.normal(0, 0.7, 3))
        top = 0.92 if name == "snow" else 0.8
        if name == "snow":
            jitter = np.ones(3)
        tints = (np.clip(np.array(c) * jitter, 0.005, top) for c in (first, second))
        return _matter(name, *tints, rough * (1 - 0.5 * self._wet), kind)


def class_of(name: str) -> int:
    """Return the index into ``CLASSES`` of a material."""
    if name == "water":
        return CLASSES.index("water")
    if name == _GLASS or name.startswith("wall"):
        return CLASSES.index("building")
    return CLASSES.index(_TABLE[name][3])


def _matter(name: str, first: Tint, second: Tint, rough: float, kind: str) -> bpy.types.Material:
    material = bpy.data.materials.new(name)
    material.pass_index = CLASSES.index(kind)
    material.use_nodes = True
    tree = material.node_tree
    nodes, link = tree.nodes, tree.links.new
    surface = nodes["Principled BSDF"]
    surface.inputs["Roughness"].default_value = rough
    surface.inputs["Specular IOR Level"].default_value = 0.25 if rough > 0.5 else 0.5
    place = nodes.new("ShaderNodeNewGeometry").outputs["Position"]
    colour = _mottled(tree, place, first, second, 0.35)
    fine = nodes.new("ShaderNodeTexNoise")
    fine.inputs["Scale"].default_value = 7.0
    fine.inputs["Detail"].default_value = 1.0
    link(place, fine.inputs["Vector"])
    shade = nodes.new("ShaderNodeMapRange")
    shade.inputs["From Min"].default_value, shade.inputs["From Max"].default_value = 0.25, 0.75
    shade.inputs["To Min"].default_value, shade.inputs["To Max"].default_value = 0.75, 1.2
    if kind == "snow" or name == _GLASS:
        shade.inputs["To Min"].default_value, shade.inputs["To Max"].default_value = 0.97, 1.0
    link(fine.outputs["Fac"], shade.inputs["Value"])
    scale = nodes.new("ShaderNodeVectorMath")
    scale.operation = "SCALE"
    link(colour, scale.inputs[0])
    link(shade.outputs["Result"], scale.inputs["Scale"])
    link(scale.outputs["Vector"], surface.inputs["Base Color"])
    if name in _THIN:
        _let_light_through(tree, surface, scale.outputs["Vector"])
    return material


def _mottled(
    tree: bpy.types.NodeTree, place: bpy.types.NodeSocket, first: Tint, second: Tint, scale: float
) -> bpy.types.NodeSocket:
    """Return the output of a mix of two tints by broad noise."""
    noise = tree.nodes.new("ShaderNodeTexNoise")
    noise.inputs["Scale"].default_value = scale
    noise.inputs["Detail"].default_value = 3.0
    tree.links.new(place, noise.inputs["Vector"])
    mix = tree.nodes.new("ShaderNodeValToRGB")
    mix.color_ramp.elements[0].position, mix.color_ramp.elements[1].position = 0.38, 0.62
    mix.color_ramp.elements[0].color = (*first, 1)
    mix.color_ramp.elements[1].color = (*second, 1)
    tree.links.new(noise.outputs["Fac"], mix.inputs["Fac"])
    return mix.outputs["Color"]


def _let_light_through(
    tree: bpy.types.NodeTree, surface: bpy.types.Node, colour: bpy.types.NodeSocket
) -> None:
    through = tree.nodes.new("ShaderNodeBsdfTranslucent")
    tree.links.new(colour, through.inputs["Color"])
    mix = tree.nodes.new("ShaderNodeMixShader")
    mix.inputs["Fac"].default_value = 0.35
    tree.links.new(surface.outputs["BSDF"], mix.inputs[1])
    tree.links.new(through.outputs["BSDF"], mix.inputs[2])
    tree.links.new(mix.outputs["Shader"], tree.nodes["Material Output"].inputs["Surface"])


def _water(random: Random, waves: float) -> bpy.types.Material:
    """Return water that mirrors: what light leaves it, and waves as two noises."""
    material = bpy.data.materials.new("water")
    material.pass_index = CLASSES.index("water")
    material.use_nodes = True
    tree = material.node_tree
    nodes, link = tree.nodes, tree.links.new
    surface = nodes["Principled BSDF"]
    deep = np.array((0.008, 0.020, 0.026)) * np.exp(random.normal(0, 0.5, 3))
    surface.inputs["Base Color"].default_value = (*np.minimum(deep, 0.12), 1)
    surface.inputs["Roughness"].default_value = random.uniform(0.02, 0.12)
    surface.inputs["IOR"].default_value = 1.333
    place = nodes.new("ShaderNodeNewGeometry").outputs["Position"]
    height = None
    for scale, strength in ((0.25, 1.0), (1.7, 0.35)):
        noise = nodes.new("ShaderNodeTexNoise")
        noise.inputs["Scale"].default_value = scale * np.exp(random.normal(0, 0.4))
        noise.inputs["Detail"].default_value = 2.0
        stretch = nodes.new("ShaderNodeMapping")
        stretch.inputs["Scale"].default_value = (1, random.uniform(1.2, 3), 1)
        stretch.inputs["Rotation"].default_value = (0, 0, random.uniform(-0.6, 0.6))
        link(place, stretch.inputs["Vector"])
        link(stretch.outputs["Vector"], noise.inputs["Vector"])
        bump = nodes.new("ShaderNodeBump")
        bump.inputs["Distance"].default_value = strength
        bump.inputs["Strength"].default_value = waves
        link(noise.outputs["Fac"], bump.inputs["Height"])
        if height is not None:
            link(height, bump.inputs["Normal"])
        height = bump.outputs["Normal"]
    link(height, surface.inputs["Normal"])
    return material
