"""Run the frame graph on EGL, on one GL thread."""

from sunwidget.errors import RendererError
from sunwidget.renderer.offscreen import render, render_pass, scene_textures

__all__ = ["RendererError", "render", "render_pass", "scene_textures"]
