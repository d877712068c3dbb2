"""Run the frame graph on EGL. ``docs/developer/frame-graph.md`` is the contract.

The browser's twin is ``js/src/gl/graph.js``. A runner knows nothing about skies: it compiles the
passes, sets their uniforms and textures, and runs only the passes whose inputs changed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from sunwidget.renderer.shader_source import (
    EGL_HEADER,
    frame_graph,
    part_shaders,
    resolve_includes,
    vertex_shader,
)
from sunwidget.renderer.values import uniform_value

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    import moderngl
    import numpy.typing as npt

    Array = npt.NDArray[Any]

# Passes at a fraction of the frame's size stop growing at this longer side, in pixels.
LARGEST_FRAME = 4096


@dataclass
class Target:
    """Last output of a pass: its texture, and the key of its inputs."""

    texture: moderngl.Texture
    framebuffer: moderngl.Framebuffer
    key: Any = None
    # For a pass with parts: the key of the inputs of its depth.
    parts_key: Any = None
    version: int = 0
    # For a pass with history: the output before, and the number of samples so far.
    previous: moderngl.Texture | None = None
    samples: int = 0


@dataclass
class Programs:
    """The compiled passes of one context, shared by its pictures."""

    context: moderngl.Context
    programs: dict[str, moderngl.Program] = field(default_factory=dict)
    arrays: dict[str, moderngl.VertexArray] = field(default_factory=dict)
    uniforms: dict[str, dict[str, moderngl.Uniform]] = field(default_factory=dict)

    def get(
        self, shader: str, constants: str | None = None, depth: float = 0.0
    ) -> moderngl.Program:
        """Compile ``shader`` on first use; an error names the shader.

        ``constants`` is the shader of values that all pixels share, ``depth`` the depth of a
        shader that draws a part of a pass (``part_shaders``).
        """
        if shader not in self.programs:
            import moderngl

            text = EGL_HEADER + resolve_includes(f"{shader}.glsl")
            try:
                program = self.context.program(
                    vertex_shader=vertex_shader(constants, depth), fragment_shader=text
                )
            except Exception as error:  # moderngl.Error derives directly from Exception
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
        The scene textures by name, (h, w, 3 or 4) float32, uint8 or uint16, row 0 at the top.
    description : mapping, optional
        The passes, as ``frame_graph`` returns them; default: the editor's.
    """

    def __init__(
        self,
        programs: Programs,
        textures: Mapping[str, Array],
        description: Mapping[str, Any] | None = None,
    ) -> None:
        self.programs = programs
        self.passes = (frame_graph() if description is None else description)["passes"]
        self.context = programs.context
        self.targets: dict[str, Target] = {}
        self.scene: dict[str, moderngl.Texture] = {}
        # Textures of the rows being drawn, for passes of the picture's size (tiles.py).
        self.strip: dict[str, moderngl.Texture] = {}
        self.picture_strip: tuple[float, ...] = (0.0,) * 4
        self.versions: dict[str, int] = {}
        self.runs: dict[str, int] = {}
        self.drawn: set[str] = set()
        # What stands in for a pass that is not drawn.
        self.set_texture("nothing", np.zeros((1, 1, 4), np.uint8))
        for name, image in textures.items():
            self.set_texture(name, image)

    def set_texture(self, name: str, image: Array) -> None:
        """Upload one scene texture; the passes that read it are drawn again."""
        self.scene[name] = self._upload(image, None)
        self.versions[name] = self.versions.get(name, 0) + 1

    def set_strip(self, textures: Mapping[str, Array], picture_strip: tuple[float, ...]) -> None:
        """Upload a strip, which passes of the picture's size read instead of the whole picture.

        Parameters
        ----------
        textures : mapping of str to array
            As for the graph, but only some rows of the picture, folded if a row is longer than
            a texture can be (``tiles.fold``).
        picture_strip : (first row, width, height, rows)
            First row of the strip, size of the picture, and number of rows.
        """
        self.strip = {
            name: self._upload(image, self.strip.get(name)) for name, image in textures.items()
        }
        self.picture_strip = picture_strip
        self.versions["strip"] = self.versions.get("strip", 0) + 1

    def _upload(self, image: Array, into: moderngl.Texture | None) -> moderngl.Texture:
        image = np.ascontiguousarray(image)
        height, width, components = image.shape
        limit = largest_texture(self.context)
        if max(height, width) > limit:
            raise ValueError(
                f"A picture of {width}×{height} exceeds this renderer's limit of {limit} pixels "
                "per side. Scale it down before opening it."
            )
        if into is not None and into.size == (width, height):
            into.write(image, alignment=1)
            return into
        dtype = {"uint8": "f1", "uint16": "nu2", "float32": "f4"}[str(image.dtype)]
        return self.context.texture((width, height), components, image, alignment=1, dtype=dtype)

    def run(
        self,
        state_values: Mapping[str, Mapping[str, Any]],
        scene_values: Mapping[str, Any],
        host_values: Mapping[str, Any],
        tile: tuple[int, int, int, int],
        methods: Collection[str],
        until: str | None = None,
        sizes: Mapping[str, tuple[int, int]] | None = None,
    ) -> Target:
        """Run the pass ``until`` and its ancestors if they changed; return its target.

        ``until`` defaults to the pass that makes the picture. ``tile`` is (x, y, width, height)
        in pixels of the piece of the picture that frame-sized passes draw. Passes with a named
        size look it up in ``sizes``.
        """
        x, y, width, height = tile
        host = {**host_values, "tile_origin": (float(x), float(y))}
        host["picture_strip"] = self.picture_strip
        rows = self._wanted(methods, until)
        for row in rows:
            size = self._size(row["size"], (width, height), host_values["frame_size"], sizes or {})
            self._run_pass(row, size, state_values[row["state"]], scene_values, host)
        return self.targets[rows[-1]["name"]]

    def compile(self, frame: Sequence[Any], part: int, parts: int) -> None:
        """Draw every ``parts``-th pass of a run from its end, so that its shader is compiled.

        ``frame`` are the arguments of ``run``, ``part`` is the first pass's number. Inputs that
        are not drawn yet are black.
        """
        state_values, scene_values, host_values, tile, methods = frame
        host = {**host_values, "tile_origin": (0.0, 0.0), "picture_strip": self.picture_strip}
        draws = [
            (row, self._size(row["size"], tile[2:], host["frame_size"], {}))
            for row in self._wanted(methods)
        ]
        for row, size in draws:
            self._target(row, size, host)
        for row, size in draws[::-1][part::parts]:
            self._run_pass(row, size, state_values[row["state"]], scene_values, host)
            self.context.finish()

    def _wanted(self, methods: Collection[str], until: str | None = None) -> list[dict[str, Any]]:
        """Return the rows that a run draws, in order; the last is ``until``, or the picture."""
        rows = [row for row in self.passes if "when" not in row or set(row["when"]) & set(methods)]
        if until is None:
            until = next(row["name"] for row in rows if row["format"] == "output")
        if all(row["name"] != until for row in rows):
            raise KeyError(f"The frame graph has no pass {until!r} for {' and '.join(methods)}.")
        return self._ancestors(rows, until)

    def _ancestors(self, rows: list[dict[str, Any]], until: str) -> list[dict[str, Any]]:
        """Return the rows that ``until`` depends on, directly or indirectly, and its own."""
        self.drawn = {row["name"] for row in rows}
        wanted = {until}
        for row in reversed(rows):
            if row["name"] in wanted:
                wanted |= {self._source(source) for source in row["inputs"].values()}
        return [row for row in rows if row["name"] in wanted]

    def _source(self, names: str | list[str]) -> str:
        """Return the first of an input's ``names`` that this run draws or that is loaded."""
        if isinstance(names, str):
            return names
        return next((n for n in names if n in self.drawn or n in self.scene), names[-1])

    @staticmethod
    def _size(
        size: Any,
        tile: tuple[int, int],
        frame: tuple[float, float],
        sizes: Mapping[str, tuple[int, int]],
    ) -> tuple[int, int]:
        if size == "frame":
            return tile
        if isinstance(size, str):
            return sizes[size]
        if size[0] == "frame":
            # A fraction of a very large picture would still be large.
            shrink = size[1] * max(1.0, max(frame) / LARGEST_FRAME)
            return math.ceil(frame[0] / shrink), math.ceil(frame[1] / shrink)
        return size[0], size[1]

    def _run_pass(
        self,
        row: dict[str, Any],
        size: tuple[int, int],
        state: Mapping[str, Any],
        scene: Mapping[str, Any],
        host: Mapping[str, Any],
    ) -> None:
        name = row["name"]
        inputs = {uniform: self._source(names) for uniform, names in row["inputs"].items()}
        shaders = self._shaders(row)
        host = {**host, "pass_size": (float(size[0]), float(size[1]))}
        framed = row["size"] == "frame"
        if not framed:
            # Only frame-sized passes are drawn in pieces; other passes are drawn whole.
            host["tile_origin"] = (0.0, 0.0)
        values: dict[str, Any] = {}
        keys: list[list[Any]] = []
        for shader in shaders:
            keys.append([shader])
            for uniform in self.programs.uniforms[shader]:
                if uniform in inputs:
                    keys[-1].append(self._version(inputs[uniform], framed))
                elif uniform not in ("history", "sample_index"):
                    values[uniform] = uniform_value(shader, uniform, state, scene, host)
                    keys[-1].append(values[uniform])
        target = self._target(row, size, host)
        key = [size, keys]
        if row.get("history"):
            self._swap_history(target, key)
            values["sample_index"] = float(target.samples)
        elif target.key == key:
            return
        textures = {uniform: self._texture(of, framed) for uniform, of in inputs.items()}
        if target.previous is not None:
            textures["history"] = target.previous
        target.framebuffer.use()
        if "parts" in row:
            self._write_parts(target, shaders[0], keys[0], values, textures)
            self._draw_parts(shaders[1:], values, textures)
        else:
            self._draw(row["shader"], values, textures)
        target.key = key
        target.version += 1
        target.samples += 1
        self.runs[name] = self.runs.get(name, 0) + 1

    def _shaders(self, row: Mapping[str, Any]) -> list[str]:
        """Compile the shaders of a pass; with parts, the first one assigns pixels to parts."""
        drawn = part_shaders(row)
        for shader, depth in drawn.items():
            self.programs.get(shader, row.get("constants"), depth)
        if "parts" not in row:
            return list(drawn)
        self.programs.get(row["parts"]["by"])
        return [row["parts"]["by"], *drawn]

    def _draw(
        self, shader: str, values: Mapping[str, Any], textures: Mapping[str, moderngl.Texture]
    ) -> None:
        unit = 0
        for uniform, member in self.programs.uniforms[shader].items():
            if uniform in values:
                member.value = values[uniform]
                continue
            textures[uniform].use(unit)
            member.value = unit
            unit += 1
        self.programs.arrays[shader].render(vertices=3)

    def _write_parts(
        self,
        target: Target,
        shader: str,
        key: list[Any],
        values: Mapping[str, Any],
        textures: Mapping[str, moderngl.Texture],
    ) -> None:
        """Write each pixel's part as its depth, unless it is written already."""
        import moderngl

        if target.parts_key == key:
            return
        context, framebuffer = self.context, target.framebuffer
        context.enable(moderngl.DEPTH_TEST)
        context.depth_func = "1"  # always
        framebuffer.color_mask = (False,) * 4
        framebuffer.depth_mask = True
        self._draw(shader, values, textures)
        framebuffer.color_mask = (True,) * 4
        framebuffer.depth_mask = False
        context.disable(moderngl.DEPTH_TEST)
        target.parts_key = key

    def _draw_parts(
        self,
        shaders: list[str],
        values: Mapping[str, Any],
        textures: Mapping[str, moderngl.Texture],
    ) -> None:
        """Draw each part's pixels with its shader.

        The depth test skips all other pixels on every driver; with a branch instead, some drivers
        would compute both sides.
        """
        import moderngl

        self.context.enable(moderngl.DEPTH_TEST)
        self.context.depth_func = "=="
        for shader in shaders:
            self._draw(shader, values, textures)
        self.context.disable(moderngl.DEPTH_TEST)

    def _target(
        self, row: Mapping[str, Any], size: tuple[int, int], host: Mapping[str, Any]
    ) -> Target:
        """Return the target of a pass, a new one if the present one does not fit."""
        name, parts = row["name"], "parts" in row
        dtype = "f1" if row["format"] == "output" and host.get("output_levels") == 255 else "f4"
        target = self.targets.get(name)
        if target is not None:
            fits = (target.texture.size, target.texture.dtype) == (size, dtype)
            if fits and (not parts or target.framebuffer.depth_attachment is not None):
                return target
        texture = self.context.texture(size, 4, dtype=dtype)
        depth = self.context.depth_renderbuffer(size) if parts else None
        framebuffer = self.context.framebuffer([texture], depth)
        framebuffer.depth_mask = False
        self.targets[name] = Target(texture, framebuffer, version=target.version if target else 0)
        return self.targets[name]

    def _swap_history(self, target: Target, key: list[Any]) -> None:
        """Swap the two textures of a pass with history; a new ``key`` restarts its samples."""
        if target.key != key:
            target.samples = 0
        if target.previous is None:
            target.previous = self.context.texture(target.texture.size, 4, dtype="f4")
        target.texture, target.previous = target.previous, target.texture
        target.framebuffer = self.context.framebuffer([target.texture])

    def _version(self, name: str, framed: bool) -> tuple[str, int]:
        if name in self.targets:
            return name, self.targets[name].version
        return name, self.versions["strip" if framed and name in self.strip else name]

    def _texture(self, name: str, framed: bool) -> moderngl.Texture:
        """Return a texture that a pass reads; ``framed`` passes read the strip if there is one."""
        if name in self.targets:
            return self.targets[name].texture
        return self.strip[name] if framed and name in self.strip else self.scene[name]


def largest_texture(context: moderngl.Context) -> int:
    """Return the most pixels that a side of a texture can have."""
    return int(context.info["GL_MAX_TEXTURE_SIZE"])
