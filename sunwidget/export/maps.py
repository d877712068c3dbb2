"""All results of the analysis as pictures and one readable JSON file."""

from __future__ import annotations

import contextlib
import dataclasses
import json
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from sunwidget.analysis.maps import MAPS, levels, shares_of
from sunwidget.analysis.scene import checked_scene
from sunwidget.files import complete_or_absent, explain_write_errors, folder_target

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene

FACTS = (
    "camera",
    "horizon",
    "sun",
    "atmosphere",
    "sun_confidence",
    "automatic",
    "warnings",
    "timings",
)


def save_maps(
    scene: Scene, folder: str | os.PathLike[str], *, overwrite: bool = False
) -> list[Path]:
    """Write every map of ``scene`` as a gray PNG, an overview, and ``scene.json``.

    Parameters
    ----------
    scene : Scene
        What ``analyze`` returned.
    folder : path
        Created if missing. It receives a PNG at the photo's size for every entry of
        ``analysis.maps.MAPS`` that this scene has (8 bits; depth has 16), ``overview.png`` (all of
        them small, in color, with legends) and ``scene.json`` (numeric results, the seconds of
        every stage, and how each file's levels convert to values).
    overwrite : bool
        Replace existing files.

    Returns
    -------
    list of Path
        The files, in that order.

    Raises
    ------
    FileExistsError
        When one of the files exists and ``overwrite`` is false. Nothing is written then.
    OSError
        When the folder cannot be created or the disk is full. No file is left then.
    """
    from PIL import Image

    from sunwidget.export.overview import overview

    folder = folder_target(folder, parents=True)
    checked_scene(scene)
    images = {}
    for entry in MAPS:
        shares = shares_of(scene, entry, scene.photo.size)
        if shares is not None:
            images[entry.name] = Image.fromarray(levels(shares, entry.bits))
    made = list(images)
    images["overview"] = overview(scene)
    paths = [folder / f"{name}.png" for name in images] + [folder / "scene.json"]
    for path in paths:
        if path.exists() and not overwrite:
            raise FileExistsError(f"{path} exists already. Pass overwrite to replace it.")
    text = json.dumps(facts(scene, made), indent=2, allow_nan=False, ensure_ascii=False)
    with explain_write_errors(folder), contextlib.ExitStack() as stack:
        folder.mkdir(parents=True, exist_ok=True)
        # Every file is written before the first one gets its name.
        whole = [stack.enter_context(complete_or_absent(p, overwrite=overwrite)) for p in paths]
        for unfinished, image in zip(whole, images.values(), strict=False):
            image.save(unfinished)
        whole[-1].write_bytes(text.encode("utf-8", "replace") + b"\n")
    return paths


def facts(scene: Scene, made: list[str] | None = None) -> dict[str, Any]:
    """Return the numeric results of the analysis as plain JSON types.

    ``made`` names the maps to describe: file, title, unit, and the value of a level.
    """
    found = {"photo": {"name": scene.photo.name, "width": scene.width, "height": scene.height}}
    found |= {name: _plain(getattr(scene, name)) for name in FACTS}
    found["maps"] = {
        entry.name: {
            "file": f"{entry.name}.png",
            "title": entry.title,
            "unit": entry.unit,
            "value": entry.formula(),
            "help": entry.help,
        }
        for entry in MAPS
        if made is not None and entry.name in made
    }
    return found


def _plain(value: Any) -> Any:
    """Return ``value`` as JSON types, without arrays: the maps have their own files."""
    if dataclasses.is_dataclass(value):
        pairs = {f.name: getattr(value, f.name) for f in dataclasses.fields(value)}
        return {k: _plain(v) for k, v in pairs.items() if not isinstance(v, np.ndarray)}
    if hasattr(value, "_asdict"):
        pairs = value._asdict()
        return {k: _plain(v) for k, v in pairs.items() if not isinstance(v, np.ndarray)}
    if isinstance(value, dict):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(v) for v in value]
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float):
        return round(value, 6) if math.isfinite(value) else None
    if value is None or isinstance(value, (bool, int, str)):
        return value
    return str(value)
