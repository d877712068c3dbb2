"""The light: Blender's physical sky with its sun, and a layer of clouds in it."""

from __future__ import annotations

from dataclasses import dataclass

import bpy
import numpy as np

from training.worlds.mesh import Random


@dataclass(frozen=True)
class Sun:
    """Where the sun stands: radians, azimuth right of the camera's heading; covered by cloud?"""

    azimuth: float
    elevation: float
    covered: bool = False

    @property
    def direction(self) -> np.ndarray:
        """Return the unit vector towards it; x right, y ahead, z up."""
        flat = np.cos(self.elevation)
        return np.array(
            [flat * np.sin(self.azimuth), flat * np.cos(self.azimuth), np.sin(self.elevation)]
        )


@dataclass(frozen=True)
class Clouds:
    """A layer of clouds: share of the sky (0 none, 1 overcast), size, sharpness, seed."""

    cover: float
    scale: float
    detail: float
    soft: float
    seed: float

    @classmethod
    def drawn(cls, random: Random, cover: float) -> Clouds:
        """Return clouds by chance of this cover."""
        return cls(
            cover,
            float(np.exp(random.uniform(np.log(0.5), np.log(3.0)))),
            float(random.uniform(3, 5)),
            float(random.uniform(0.06, 0.3)),
            float(random.uniform(0, 100)),
        )


class Sky:
    """The world's light in Blender; ``set`` moves the sun, ``flat`` is for measuring."""

    def __init__(self, random: Random, clouds: Clouds) -> None:
        self.clouds = clouds
        self.world = bpy.data.worlds.new("sky")
        bpy.context.scene.world = self.world
        self.world.use_nodes = True
        # What Blender chooses for an overcast sky takes four seconds a picture and shows no more.
        self.world.cycles.sampling_method = "MANUAL"
        self.world.cycles.sample_map_resolution = 256
        self.air = float(np.exp(random.normal(0, 0.15)))
        self.aerosol = float(np.exp(random.normal(0.0, 0.7)))
        self.ozone = float(random.uniform(0.6, 1.5))
        self.altitude = float(random.choice([5.0, 300.0, 1500.0]))
        tree = self.world.node_tree
        self.sky = _texture(tree, self)
        self.background = tree.nodes["Background"]
        self.mix, self.opening = self._layer(tree)

    def set(self, sun: Sun) -> None:
        """Put the sun where it is to stand."""
        self.sky.sun_elevation, self.sky.sun_rotation = sun.elevation, sun.azimuth
        tree = self.world.node_tree
        tree.links.new(self.mix, self.background.inputs["Color"])
        self.background.inputs["Strength"].default_value = 1.0
        self.opening.inputs[1].default_value = tuple(sun.direction)
        # Round a sun that shines the layer is open; before one that does not it is closed.
        # (cosine - a) * b, clamped, times the opacity
        self.hole.default_value = 0.0 if sun.covered else 1.0
        self.sky.sun_disc = not sun.covered
        light = _sunlight(max(sun.elevation, np.radians(-1.0)), self.aerosol) * (
            np.clip((sun.elevation + np.radians(2)) / np.radians(4), 0, 1)
        )
        share = 0.25 if sun.covered else 1.0
        self.lit.default_value = (*(_SUN_ON_CLOUD * light * share), 1)
        elevations = [np.radians(row[0]) for row in _OVERHEAD]
        overhead = [
            np.interp(sun.elevation, elevations, [r[c] for r in _OVERHEAD]) for c in (1, 2, 3)
        ]
        self.ambient.default_value = (*(_SKY_ON_CLOUD * 2.0 ** np.array(overhead)), 1)

    def flat(self, level: float) -> None:
        """Light the world alike from everywhere (0: not at all), for measuring."""
        links = self.background.inputs["Color"].links
        for link in list(links):
            self.world.node_tree.links.remove(link)
        self.background.inputs["Color"].default_value = (level, level, level, 1)

    def _layer(self, tree: bpy.types.NodeTree) -> tuple[bpy.types.NodeSocket, bpy.types.Node]:
        """Return the socket of the sky with clouds in it, and the node that knows the sun."""
        nodes, link = tree.nodes, tree.links.new
        view = nodes.new("ShaderNodeTexCoord").outputs["Generated"]
        parts = nodes.new("ShaderNodeSeparateXYZ")
        link(view, parts.inputs[0])
        height = _math(tree, "MAXIMUM", parts.outputs["Z"], 0.0)
        lifted = _math(tree, "ADD", height, 0.06)
        plane = nodes.new("ShaderNodeCombineXYZ")
        link(_math(tree, "DIVIDE", parts.outputs["X"], lifted), plane.inputs["X"])
        link(_math(tree, "DIVIDE", parts.outputs["Y"], lifted), plane.inputs["Y"])
        plane.inputs["Z"].default_value = self.clouds.seed
        noise = nodes.new("ShaderNodeTexNoise")
        noise.inputs["Scale"].default_value = self.clouds.scale
        noise.inputs["Detail"].default_value = self.clouds.detail
        link(plane.outputs["Vector"], noise.inputs["Vector"])
        shape = nodes.new("ShaderNodeMapRange")
        shape.interpolation_type = "SMOOTHSTEP"
        edge = 0.75 - 0.5 * self.clouds.cover  # of the noise, which is about .5 ± .15
        if self.clouds.cover >= 1:
            edge = 0.0
        shape.inputs["From Min"].default_value = edge - self.clouds.soft / 2
        shape.inputs["From Max"].default_value = edge + self.clouds.soft / 2
        shape.inputs["To Max"].default_value = 0.95 if self.clouds.cover > 0 else 0.0
        link(noise.outputs["Fac"], shape.inputs["Value"])
        far = _math(tree, "MULTIPLY", height, 12.0, clamp=True)  # the layer ends in haze
        opacity = _math(tree, "MULTIPLY", shape.outputs["Result"], far)
        to_sun = nodes.new("ShaderNodeVectorMath")
        to_sun.operation = "DOT_PRODUCT"
        link(view, to_sun.inputs[0])
        cosine = to_sun.outputs["Value"]
        opened = _math(tree, "MULTIPLY", _math(tree, "SUBTRACT", cosine, 0.985), 90.0, clamp=True)
        switch = nodes.new("ShaderNodeMath")
        switch.operation = "MULTIPLY"
        link(opened, switch.inputs[0])
        self.hole = switch.inputs[1]
        opacity = _math(tree, "MULTIPLY", opacity, _math(tree, "SUBTRACT", 1.0, switch.outputs[0]))
        lit, self.lit = self._lit(tree, cosine, noise.outputs["Fac"])
        mix = nodes.new("ShaderNodeMix")
        mix.data_type = "RGBA"
        link(opacity, mix.inputs["Factor"])
        link(self.sky.outputs[0], mix.inputs["A"])
        link(lit, mix.inputs["B"])
        return mix.outputs["Result"], to_sun

    def _lit(
        self,
        tree: bpy.types.NodeTree,
        cosine: bpy.types.NodeSocket,
        thickness: bpy.types.NodeSocket,
    ) -> tuple[bpy.types.NodeSocket, bpy.types.NodeSocket]:
        """Return a cloud's radiance: of the sky overhead, and of the sun by a forward phase."""
        nodes, link = tree.nodes, tree.links.new
        overhead = nodes.new("ShaderNodeRGB")
        self.ambient = overhead.outputs[0]
        forward = _math(tree, "POWER", _math(tree, "MAXIMUM", cosine, 0.0), 12.0)
        phase = _math(tree, "ADD", _math(tree, "MULTIPLY", forward, 1.2), 1.0)
        thin = _math(tree, "SUBTRACT", 1.55, thickness)
        sun = nodes.new("ShaderNodeVectorMath")
        sun.operation = "SCALE"
        link(_math(tree, "MULTIPLY", phase, thin), sun.inputs["Scale"])
        both = nodes.new("ShaderNodeMix")
        both.data_type, both.blend_type = "RGBA", "ADD"
        both.inputs["Factor"].default_value = 1.0
        colour = nodes.new("ShaderNodeRGB")
        link(colour.outputs[0], sun.inputs[0])
        link(self.ambient, both.inputs["A"])
        link(sun.outputs["Vector"], both.inputs["B"])
        return both.outputs["Result"], colour.outputs[0]


_SUN_ON_CLOUD = (
    18.0  # radiance of a lit cloud; the sun's irradiance above the air is about 160 here
)
_SKY_ON_CLOUD = 1.3
# Sun's elevation in degrees, log2 of Blender's sky 50 degrees high beside it: R, G, B.
_OVERHEAD = (
    (-8, -11.6, -8.25, -5.89), (-6, -10.2, -7.32, -5.0), (-4, -6.84, -5.82, -3.89),
    (-2, -3.88, -3.64, -2.43), (0, -2.29, -1.96, -1.14), (2, -1.59, -0.99, -0.22),
    (4, -1.21, -0.43, 0.41), (7, -0.87, 0.06, 1.01), (12, -0.54, 0.48, 1.52),
    (20, -0.22, 0.83, 1.88), (35, 0.2, 1.23, 2.27), (60, 0.67, 1.67, 2.67), (90, 0.9, 1.87, 2.85),
)  # fmt: skip


def _texture(
    tree: bpy.types.NodeTree, sky: Sky, *, disc: bool = True
) -> bpy.types.ShaderNodeTexSky:
    node = tree.nodes.new("ShaderNodeTexSky")
    node.sky_type = "MULTIPLE_SCATTERING"
    node.sun_disc = disc
    node.air_density, node.aerosol_density = sky.air, sky.aerosol
    node.ozone_density, node.altitude = sky.ozone, sky.altitude
    return node


def _math(
    tree: bpy.types.NodeTree,
    operation: str,
    first: float | bpy.types.NodeSocket,
    second: float | bpy.types.NodeSocket,
    *,
    clamp: bool = False,
) -> bpy.types.NodeSocket:
    """Return the output of one sum; arguments are sockets or numbers."""
    node = tree.nodes.new("ShaderNodeMath")
    node.operation, node.use_clamp = operation, clamp
    for value, socket in zip((first, second), node.inputs, strict=False):
        if isinstance(value, (int, float)):
            socket.default_value = value
        else:
            tree.links.new(value, socket)
    return node.outputs[0]


def _sunlight(elevation: float, aerosol: float) -> np.ndarray:
    """Return the share of the sun's R, G, B that comes through the air (Kasten and Young 1989)."""
    degrees = np.degrees(elevation)
    mass = 1 / (np.sin(elevation) + 0.50572 * (degrees + 6.07995) ** -1.6364)
    depth = np.array([0.047, 0.095, 0.22]) + 0.06 * aerosol
    return np.exp(-depth * np.minimum(mass, 38))
