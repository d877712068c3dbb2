"""Runs the frame graph on EGL, on one GL thread."""

from sunwidget.errors import RendererError
from sunwidget.renderer.offscreen import quantise_map, render, render_pass, scene_textures

__all__ = ["RendererError", "quantise_map", "render", "render_pass", "scene_textures"]
