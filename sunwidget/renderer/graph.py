"""Run the frame graph on EGL. ``docs/frame-graph.md`` is the contract.

The browser's twin is ``js/src/gl/graph.js``. A runner knows nothing about skies: it
compiles the passes, hands them uniforms and textures, and runs again only what changed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from sunwidget.renderer.shader_source import (
    EGL_HEADER,
    FULL_SCREEN_TRIANGLE,
    frame_graph,
    resolve_includes,
)
from sunwidget.renderer.values import uniform_value

if TYPE_CHECKING:
    from collections.abc import Mapping

    import moderngl
    import numpy.typing as npt

    Array = npt.NDArray[Any]


@dataclass
class Target:
    """What one pass drew last: its texture, and the key of what it was drawn from."""

    texture: moderngl.Texture
    framebuffer: moderngl.Framebuffer
    key: Any = None
    version: int = 0


@dataclass
class Programs:
    """The compiled passes and their samplers, shared by every picture of one context."""

    context: moderngl.Context
    programs: dict[str, moderngl.Program] = field(default_factory=dict)
    arrays: dict[str, moderngl.VertexArray] = field(default_factory=dict)
    uniforms: dict[str, dict[str, moderngl.Uniform]] = field(default_factory=dict)

    def get(self, shader: str) -> moderngl.Program:
        """Compile ``shader`` on first use; a failure names the shader."""
        if shader not in self.programs:
            import moderngl

            text = EGL_HEADER + resolve_includes(f"{shader}.glsl")
            try:
                program = self.context.program(
                    vertex_shader=FULL_SCREEN_TRIANGLE, fragment_shader=text
                )
            except Exception as error:  # moderngl.Error derives from Exception alone
                raise RuntimeError(f"Shader {shader!r} does not compile:\n{error}") from error
            self.programs[shader] = program
            self.arrays[shader] = self.context.vertex_array(program, [])
            self.uniforms[shader] = {
                name: member
                for name in program
                if isinstance(member := program[name], moderngl.Uniform)
            }
        return self.programs[shader]


class FrameGraph:
    """The passes of one picture: its scene textures and the targets drawn so far.

    Parameters
    ----------
    programs : Programs
        Compiled passes of the context.
    textures : mapping of str to array
        The scene textures by name, (h, w, 3) float32, uint8 or uint16, row 0 at the top.
    """

    def __init__(self, programs: Programs, textures: Mapping[str, Array]) -> None:
        self.programs = programs
        self.context = programs.context
        self.targets: dict[str, Target] = {}
        self.scene: dict[str, moderngl.Texture] = {}
        self.versions: dict[str, int] = {}
        self.runs: dict[str, int] = {}
        for name, image in textures.items():
            self.set_texture(name, image)

    def set_texture(self, name: str, image: Array) -> None:
        """Upload one scene texture; whatever reads it is drawn again."""
        image = np.ascontiguousarray(image)
        height, width, components = image.shape
        limit = self.context.info["GL_MAX_TEXTURE_SIZE"]
        if max(height, width) > limit:
            raise ValueError(
                f"A picture of {width}×{height} exceeds this renderer's limit of {limit} pixels "
                "a side. Scale it down before opening it."
            )
        dtype = {"uint8": "f1", "uint16": "nu2", "float32": "f4"}[str(image.dtype)]
        self.scene[name] = self.context.texture(
            (width, height), components, image, alignment=1, dtype=dtype
        )
        self.versions[name] = self.versions.get(name, 0) + 1

    def run(
        self,
        state_values: Mapping[str, Mapping[str, Any]],
        scene_values: Mapping[str, Any],
        host_values: Mapping[str, Any],
        tile: tuple[int, int, int, int],
        method: str,
        until: str = "frame",
    ) -> Target:
        """Run what changed, up to the pass ``until``, and return its target.

        ``tile`` is (x, y, width, height) of the piece of the picture that frame-sized
        passes draw, in pixels.
        """
        x, y, width, height = tile
        host = {**host_values, "tile_origin": (float(x), float(y))}
        for row in frame_graph()["passes"]:
            if method not in row.get("when", [method]):
                continue
            size = self._size(row["size"], (width, height), host_values["frame_size"])
            self._run_pass(row, size, state_values[row["state"]], scene_values, host)
            if row["name"] == until:
                return self.targets[until]
        raise KeyError(f"The frame graph has no pass {until!r} for method {method!r}.")

    @staticmethod
    def _size(size: Any, tile: tuple[int, int], frame: tuple[float, float]) -> tuple[int, int]:
        if size == "frame":
            return tile
        if size[0] == "frame":
            return math.ceil(frame[0] / size[1]), math.ceil(frame[1] / size[1])
        return size[0], size[1]

    def _run_pass(
        self,
        row: dict[str, Any],
        size: tuple[int, int],
        state: Mapping[str, Any],
        scene: Mapping[str, Any],
        host: Mapping[str, Any],
    ) -> None:
        name, shader, inputs = row["name"], row["shader"], row["inputs"]
        program = self.programs.get(shader)
        host = {**host, "pass_size": (float(size[0]), float(size[1]))}
        if row["size"] != "frame":
            # Only frame-sized passes are drawn piece by piece; a table is drawn whole.
            host["tile_origin"] = (0.0, 0.0)
        values: dict[str, Any] = {}
        key: list[Any] = [size, shader]
        for uniform in self.programs.uniforms[shader]:
            if uniform in inputs:
                key.append(self._version(inputs[uniform]))
            else:
                values[uniform] = uniform_value(shader, uniform, state, scene, host)
                key.append(values[uniform])
        target = self.targets.get(name)
        if target is None or target.texture.size != size:
            texture = self.context.texture(size, 4, dtype="f4")
            version = target.version if target else 0
            target = Target(texture, self.context.framebuffer([texture]), version=version)
            self.targets[name] = target
        if target.key == key:
            return
        unit = 0
        for uniform, member in self.programs.uniforms[shader].items():
            if uniform in inputs:
                self._texture(inputs[uniform]).use(unit)
                member.value = unit
                unit += 1
            else:
                member.value = values[uniform]
        del program
        target.framebuffer.use()
        self.programs.arrays[shader].render(vertices=3)
        target.key = key
        target.version += 1
        self.runs[name] = self.runs.get(name, 0) + 1

    def _version(self, name: str) -> tuple[str, int]:
        if name in self.targets:
            return name, self.targets[name].version
        return name, self.versions[name]

    def _texture(self, name: str) -> moderngl.Texture:
        return self.targets[name].texture if name in self.targets else self.scene[name]
