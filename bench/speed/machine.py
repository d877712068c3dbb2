"""What was measured on."""

from __future__ import annotations

import os
import platform
import time
from pathlib import Path
from typing import Any

import sunwidget as sw


def machine() -> dict[str, Any]:
    """Return the facts that a figure means nothing without."""
    return {
        "processor": processor(),
        "cores": os.cpu_count(),
        "load_average": round(os.getloadavg()[0], 2),
        "system": platform.platform(),
        "python": platform.python_version(),
        "renderer": renderer(),
        "sunwidget": sw.__version__,
        "time": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
    }


def processor() -> str:
    """Return the processor's name where the system tells it."""
    facts = Path("/proc/cpuinfo")
    lines = facts.read_text().splitlines() if facts.exists() else []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def renderer() -> str:
    """Return the name of the OpenGL driver that the kernel draws with."""
    from sunwidget.errors import RendererError
    from sunwidget.renderer.gl_thread import on_gl_thread

    try:
        return str(on_gl_thread(lambda context: context.info["GL_RENDERER"]))
    except RendererError as error:
        return f"none: {error}"


def is_software(name: str) -> bool:
    """Whether a driver draws on the processor."""
    return any(word in name.lower() for word in ("llvmpipe", "softpipe", "swiftshader", "swrast"))
