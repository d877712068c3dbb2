"""Compile a first frame's shaders with several processes where the processor draws.

llvmpipe compiles a shader when it is first drawn: a frame's take 13 s on one core. It keeps what
it has compiled on disk, so other processes that draw the frame's passes from the end share the
work. Threads could not: a draw holds the interpreter's lock.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from sunwidget.renderer.graph import FrameGraph, Programs

if TYPE_CHECKING:
    from collections.abc import Iterator

MOST_HELPERS = 3
COMPILED = 0.06  # s that the first pass takes if it is on disk; to compile it takes twice as long


@contextmanager
def helped(graph: FrameGraph, frame: tuple[Any, Any, Any, Any, Any]) -> Iterator[None]:
    """Let other processes compile what a context's first frame needs, while the block draws it.

    ``frame`` are the arguments of ``graph.run``. Nothing happens on a graphics card, on one core,
    and where the driver has compiled the shaders before. Helpers end with the block; without them
    it only takes longer.
    """
    helpers = min((os.cpu_count() or 1) - 1, MOST_HELPERS)
    drawn_by = str(graph.context.info["GL_RENDERER"])
    if graph.programs.programs or not (helpers and sys.executable and "llvmpipe" in drawn_by):
        yield
        return
    begin = time.perf_counter()
    graph.run(*frame, until=graph.passes[0]["name"])
    graph.context.finish()
    if time.perf_counter() - begin < COMPILED:
        yield
        return
    textures = {name: (t.size, t.components, t.dtype) for name, t in graph.scene.items()}
    started = [
        _start({"textures": textures, "frame": frame, "part": part, "parts": helpers})
        for part in range(helpers)
    ]
    try:
        yield
    finally:
        for process in started:
            if process is not None:
                process.kill()
                process.wait()


def _start(work: dict[str, Any]) -> subprocess.Popen[bytes] | None:
    """Start a helper, or return None where no process can be started."""
    text = json.dumps(work, default=lambda value: np.asarray(value).tolist())
    try:
        process = subprocess.Popen(  # noqa: S603 - no shell, no word of a photo
            [sys.executable, "-m", __name__],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
    except OSError:
        return None
    assert process.stdin is not None
    with suppress(OSError):  # it may have ended already
        process.stdin.write(text.encode())
        process.stdin.close()
    return process


def main() -> None:
    """Compile the part of a frame's passes that standard input describes."""
    import moderngl

    work = json.load(sys.stdin)
    types = {"f1": np.uint8, "nu2": np.uint16, "f4": np.float32}
    black = {
        name: np.zeros((height, width, components), types[dtype])
        for name, ((width, height), components, dtype) in work["textures"].items()
    }
    graph = FrameGraph(Programs(moderngl.create_standalone_context(backend="egl")), black)
    graph.compile(work["frame"], work["part"], work["parts"])


if __name__ == "__main__":
    main()
