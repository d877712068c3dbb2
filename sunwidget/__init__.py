"""sunwidget: move the sun in a photograph.

>>> import sunwidget as sw
>>> scene = sw.analyze(sw.sample("coast"))
>>> picture = sw.render(scene, sw.Edit(sun_elevation=3))

Every name below is loaded when it is first used (PEP 562), so that ``import sunwidget``
costs milliseconds although OpenCV, onnxruntime and the GL stack stand behind it.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

# What type checkers and editors see; a test holds it equal to the table below.
if TYPE_CHECKING:
    from sunwidget.analysis.analyze import analyze
    from sunwidget.analysis.errors import AnalysisError
    from sunwidget.analysis.scene import Scene
    from sunwidget.analysis.sky_network import SkyNetwork
    from sunwidget.camera import Camera
    from sunwidget.dome.source import Dome, analyze_dome
    from sunwidget.edit import PARAMETERS, Edit, EditError, Stroke
    from sunwidget.export.batch.report import BatchReport
    from sunwidget.export.batch.run import batch
    from sunwidget.export.contact_sheet import contact_sheet
    from sunwidget.export.day import Day
    from sunwidget.export.dome import to_dome
    from sunwidget.export.environment import environment_map
    from sunwidget.export.stills import save
    from sunwidget.export.sweep import sweep
    from sunwidget.export.timelapse import timelapse
    from sunwidget.photo import Photo, PhotoError, PhotoWarning
    from sunwidget.photo import open_photo as open  # noqa: A004 - sw.open, as Image.open
    from sunwidget.place import Place
    from sunwidget.presets import PRESETS
    from sunwidget.presets import edit as preset
    from sunwidget.renderer.gl_thread import RendererError
    from sunwidget.renderer.render import render
    from sunwidget.samples import sample
    from sunwidget.study import StudyError
    from sunwidget.transfer.look import transfer_look
    from sunwidget.transfer.sky_replacement import replace_sky
    from sunwidget.widgets.compare import Compare
    from sunwidget.widgets.sky_explorer import SkyExplorer
    from sunwidget.widgets.study import Study
    from sunwidget.widgets.sun_editor import SunEditor
    from sunwidget.widgets.unseen import to_html

__version__ = "0.1.0"

# Public name -> (module, name in it).
_HOMES: dict[str, tuple[str, str]] = {
    "AnalysisError": ("sunwidget.analysis.errors", "AnalysisError"),
    "PARAMETERS": ("sunwidget.edit", "PARAMETERS"),
    "PRESETS": ("sunwidget.presets", "PRESETS"),
    "BatchReport": ("sunwidget.export.batch.report", "BatchReport"),
    "Camera": ("sunwidget.camera", "Camera"),
    "Compare": ("sunwidget.widgets.compare", "Compare"),
    "Day": ("sunwidget.export.day", "Day"),
    "Dome": ("sunwidget.dome.source", "Dome"),
    "Edit": ("sunwidget.edit", "Edit"),
    "EditError": ("sunwidget.edit", "EditError"),
    "Photo": ("sunwidget.photo", "Photo"),
    "PhotoError": ("sunwidget.photo", "PhotoError"),
    "PhotoWarning": ("sunwidget.photo", "PhotoWarning"),
    "Place": ("sunwidget.place", "Place"),
    "RendererError": ("sunwidget.renderer.gl_thread", "RendererError"),
    "Scene": ("sunwidget.analysis.scene", "Scene"),
    "SkyExplorer": ("sunwidget.widgets.sky_explorer", "SkyExplorer"),
    "SkyNetwork": ("sunwidget.analysis.sky_network", "SkyNetwork"),
    "Stroke": ("sunwidget.edit", "Stroke"),
    "Study": ("sunwidget.widgets.study", "Study"),
    "StudyError": ("sunwidget.study", "StudyError"),
    "SunEditor": ("sunwidget.widgets.sun_editor", "SunEditor"),
    "analyze": ("sunwidget.analysis.analyze", "analyze"),
    "analyze_dome": ("sunwidget.dome.source", "analyze_dome"),
    "batch": ("sunwidget.export.batch.run", "batch"),
    "contact_sheet": ("sunwidget.export.contact_sheet", "contact_sheet"),
    "environment_map": ("sunwidget.export.environment", "environment_map"),
    "open": ("sunwidget.photo", "open_photo"),
    "preset": ("sunwidget.presets", "edit"),
    "replace_sky": ("sunwidget.transfer.sky_replacement", "replace_sky"),
    "render": ("sunwidget.renderer.render", "render"),
    "sample": ("sunwidget.samples", "sample"),
    "save": ("sunwidget.export.stills", "save"),
    "transfer_look": ("sunwidget.transfer.look", "transfer_look"),
    "sweep": ("sunwidget.export.sweep", "sweep"),
    "timelapse": ("sunwidget.export.timelapse", "timelapse"),
    "to_dome": ("sunwidget.export.dome", "to_dome"),
    "to_html": ("sunwidget.widgets.unseen", "to_html"),
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
