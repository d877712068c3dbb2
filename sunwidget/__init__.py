"""sunwidget: move the sun in a photograph.

>>> import sunwidget as sw
>>> scene = sw.analyze(sw.sample("coast"))
>>> picture = sw.render(scene, sw.Edit(sun_elevation=3))

Each name below is loaded on first use (PEP 562), so that ``import sunwidget`` takes
milliseconds although the package depends on OpenCV, onnxruntime and the GL stack.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from sunwidget.version import __version__

# For type checkers and editors; a test keeps it equal to the table below.
if TYPE_CHECKING:
    from sunwidget.analysis.analyze import analyze
    from sunwidget.analysis.correct import corrected
    from sunwidget.analysis.scene import Scene
    from sunwidget.analysis.segmentation.sky_network import SkyNetwork
    from sunwidget.batches.report import BatchReport
    from sunwidget.batches.run import batch
    from sunwidget.dome.source import Dome, analyze_dome
    from sunwidget.edit.table import PARAMETERS, Edit, Stroke
    from sunwidget.errors import (
        AnalysisError,
        EditError,
        PhotoError,
        PhotoWarning,
        RendererError,
        StudyError,
    )
    from sunwidget.export.dome.photo import to_dome
    from sunwidget.export.environment import environment_map
    from sunwidget.export.stills import save
    from sunwidget.film.contact_sheet import contact_sheet
    from sunwidget.film.day import Day
    from sunwidget.film.sweep import sweep
    from sunwidget.geometry.camera import Camera
    from sunwidget.geometry.place import Place
    from sunwidget.photo.photo import Photo
    from sunwidget.photo.photo import open_photo as open  # noqa: A004 - sw.open, as Image.open
    from sunwidget.presets import PRESETS
    from sunwidget.presets import edit as preset
    from sunwidget.renderer.offscreen import render
    from sunwidget.samples import sample
    from sunwidget.timelapses.timelapse import timelapse
    from sunwidget.transfer.look import transfer_look
    from sunwidget.transfer.sky_replacement import replace_sky
    from sunwidget.widgets import Compare, SkyExplorer, Study, SunEditor
    from sunwidget.widgets.page.standalone import to_html

# Public name -> (module, name in it).
_HOMES: dict[str, tuple[str, str]] = {
    "AnalysisError": ("sunwidget.errors", "AnalysisError"),
    "PARAMETERS": ("sunwidget.edit.table", "PARAMETERS"),
    "PRESETS": ("sunwidget.presets", "PRESETS"),
    "BatchReport": ("sunwidget.batches.report", "BatchReport"),
    "Camera": ("sunwidget.geometry.camera", "Camera"),
    "Compare": ("sunwidget.widgets", "Compare"),
    "Day": ("sunwidget.film.day", "Day"),
    "Dome": ("sunwidget.dome.source", "Dome"),
    "Edit": ("sunwidget.edit.table", "Edit"),
    "EditError": ("sunwidget.errors", "EditError"),
    "Photo": ("sunwidget.photo.photo", "Photo"),
    "PhotoError": ("sunwidget.errors", "PhotoError"),
    "PhotoWarning": ("sunwidget.errors", "PhotoWarning"),
    "Place": ("sunwidget.geometry.place", "Place"),
    "RendererError": ("sunwidget.errors", "RendererError"),
    "Scene": ("sunwidget.analysis.scene", "Scene"),
    "SkyExplorer": ("sunwidget.widgets", "SkyExplorer"),
    "SkyNetwork": ("sunwidget.analysis.segmentation.sky_network", "SkyNetwork"),
    "Stroke": ("sunwidget.edit.table", "Stroke"),
    "Study": ("sunwidget.widgets", "Study"),
    "StudyError": ("sunwidget.errors", "StudyError"),
    "SunEditor": ("sunwidget.widgets", "SunEditor"),
    "analyze": ("sunwidget.analysis.analyze", "analyze"),
    "analyze_dome": ("sunwidget.dome.source", "analyze_dome"),
    "batch": ("sunwidget.batches.run", "batch"),
    "corrected": ("sunwidget.analysis.correct", "corrected"),
    "contact_sheet": ("sunwidget.film.contact_sheet", "contact_sheet"),
    "environment_map": ("sunwidget.export.environment", "environment_map"),
    "open": ("sunwidget.photo.photo", "open_photo"),
    "preset": ("sunwidget.presets", "edit"),
    "replace_sky": ("sunwidget.transfer.sky_replacement", "replace_sky"),
    "render": ("sunwidget.renderer.offscreen", "render"),
    "sample": ("sunwidget.samples", "sample"),
    "save": ("sunwidget.export.stills", "save"),
    "transfer_look": ("sunwidget.transfer.look", "transfer_look"),
    "sweep": ("sunwidget.film.sweep", "sweep"),
    "timelapse": ("sunwidget.timelapses.timelapse", "timelapse"),
    "to_dome": ("sunwidget.export.dome.photo", "to_dome"),
    "to_html": ("sunwidget.widgets.page.standalone", "to_html"),
}

__all__ = [
    "PARAMETERS",
    "PRESETS",
    "AnalysisError",
    "BatchReport",
    "Camera",
    "Compare",
    "Day",
    "Dome",
    "Edit",
    "EditError",
    "Photo",
    "PhotoError",
    "PhotoWarning",
    "Place",
    "RendererError",
    "Scene",
    "SkyExplorer",
    "SkyNetwork",
    "Stroke",
    "Study",
    "StudyError",
    "SunEditor",
    "__version__",
    "analyze",
    "analyze_dome",
    "batch",
    "contact_sheet",
    "corrected",
    "environment_map",
    "open",
    "preset",
    "render",
    "replace_sky",
    "sample",
    "save",
    "sweep",
    "timelapse",
    "to_dome",
    "to_html",
    "transfer_look",
]


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module 'sunwidget' has no attribute {name!r}")
    module, attribute = _HOMES[name]
    value = getattr(importlib.import_module(module), attribute)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOMES})
