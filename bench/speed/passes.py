"""Single passes of the editor's frame graph, drawn without reading the picture back."""

from __future__ import annotations

from typing import Any

import numpy as np

import sunwidget as sw
from sunwidget.analysis import frame_inputs
from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.graph import FrameGraph, Programs, Target
from sunwidget.renderer.offscreen import scene_textures
from sunwidget.renderer.shader_source import frame_graph
from sunwidget.renderer.values import states


class Passes:
    """The frame graph of one scene at one size (width, height)."""

    def __init__(self, scene: sw.Scene, size: tuple[int, int]) -> None:
        self.scene = scene
        self.size = size
        uniforms = frame_inputs.uniforms(scene)
        self.uniforms = {name: uniforms[name] for name in frame_graph()["scene_uniforms"]}
        textures = scene_textures(scene, size)
        self.graph = on_gl_thread(lambda context: FrameGraph(Programs(context), textures))

    def draw(self, edit: sw.Edit, until: str) -> None:
        """Draw what changed of the pass ``until`` and all that it reads, and wait for it."""

        def task(context: Any) -> None:
            self._run(edit, until)
            context.finish()

        on_gl_thread(task)

    def texels(self, edit: sw.Edit, until: str) -> np.ndarray:
        """Return what a pass draws, (rows, columns, 4) float32."""

        def task(_context: Any) -> np.ndarray:
            texture = self._run(edit, until).texture
            width, height = texture.size
            return np.frombuffer(texture.read(), np.float32).reshape(height, width, 4).copy()

        return on_gl_thread(task)

    def _run(self, edit: sw.Edit, until: str) -> Target:
        width, height = self.size
        host = {
            "frame_size": (float(width), float(height)),
            "canvas_flip": 0.0,
            "output_transfer": 0,
            "output_white": 1.0,
            "dither": 0.0,
        }
        values = states(edit, self.scene.automatic)
        tile = (0, 0, width, height)
        return self.graph.run(values, self.uniforms, host, tile, (edit.method,), until)


def table_bytes(passes: tuple[str, ...], graph: str = "graph") -> int:
    """Return the bytes of the passes of a fixed size that are named, four floats a texel."""
    sizes = {row["name"]: row["size"] for row in frame_graph(graph)["passes"]}
    return sum(16 * sizes[name][0] * sizes[name][1] for name in passes)
