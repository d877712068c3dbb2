"""Read shaders and the frame graph from the package and resolve includes.

The browser's twin is ``js/src/gl/include.js``; a test asserts that both expand every pass to the
same text.
"""

from __future__ import annotations

import functools
import json
import re
from importlib.resources import files
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

_INCLUDE = re.compile(r'^[ \t]*#include "([^"]+)"[ \t]*$', re.MULTILINE)

EGL_HEADER = "#version 330\n"
# One triangle that covers the target, without buffers, at a given depth.
_TRIANGLE = """
void main() {
  SetConstants();
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, %r, 1.0);
}
"""


def read_shader(path: str) -> str:
    """Return the text of ``sunwidget/shaders/<path>``."""
    return files("sunwidget").joinpath("shaders", *path.split("/")).read_text("utf-8")


def resolve_includes(path: str, _seen: set[str] | None = None) -> str:
    """Return the text of a shader with every ``#include`` expanded.

    A file is expanded at its first mention and dropped at later ones, so that libraries can
    include each other in any order.
    """
    seen = {path} if _seen is None else _seen

    def expand(match: re.Match[str]) -> str:
        name = match.group(1)
        if name in seen:
            return ""
        seen.add(name)
        return resolve_includes(name, seen)

    return _INCLUDE.sub(expand, read_shader(path))


@functools.cache
def frame_graph(name: str = "graph") -> dict[str, Any]:
    """Return ``shaders/<name>.json`` as plain data; ``graph`` is the editor's graph."""
    graph: dict[str, Any] = json.loads(read_shader(f"{name}.json"))
    return graph


def part_shaders(row: Mapping[str, Any]) -> dict[str, float]:
    """Return the shaders that draw the pass of ``row``, and the depth of each.

    Only a pass with ``parts`` has several: ``parts["by"]`` writes the depth of the shader that
    draws a pixel (``frame/part.glsl``), and each shader draws the pixels of its depth.
    """
    shaders = [*row.get("parts", {}).get("shaders", []), row["shader"]]
    return {shader: 0.5 * (part + 1) - 1 for part, shader in enumerate(shaders)}


def vertex_shader(constants: str | None = None, depth: float = 0.0) -> str:
    """Return the text of the vertex shader: the triangle that covers a target.

    Parameters
    ----------
    constants : str, optional
        Name of the shader whose ``SetConstants`` computes the values that all pixels of the
        pass share, once per corner instead of once per pixel.
    depth : float, default 0
        Depth of the triangle, from -1 to 1.
    """
    text = resolve_includes(f"{constants}.glsl") if constants else "void SetConstants() {}\n"
    return EGL_HEADER + text + _TRIANGLE % float(depth)


FULL_SCREEN_TRIANGLE = vertex_shader()
