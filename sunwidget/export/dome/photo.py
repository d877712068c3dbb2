"""A dome for 3D: a photo's edited sky as an environment map, and its sun as numbers.

The projection is that of ``environment_map``. Vectors have x at the camera's heading, y to its left
and z up. With these axes Blender reads the map without a rotation.
"""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.analysis.correct import corrected
from sunwidget.dome.sphere import irradiance, solid_angles
from sunwidget.edit.recipe import edit_of
from sunwidget.export.dome.facts import FORMAT, PROJECTION, digits, rounded, sun_facts
from sunwidget.export.dome.light import DomeLight, dome_light
from sunwidget.export.dome.moved import describe_moved, move_sun
from sunwidget.export.environment import check_map, checked_size, write_map
from sunwidget.files import complete_or_absent, target
from sunwidget.formats.color import LUMINANCE

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.dome.source import Dome
    from sunwidget.edit.table import Edit

_WIDTH = 2048


def to_dome(
    scene: Scene | Dome,
    edit: Edit | dict[str, Any] | None,
    path: str | os.PathLike[str],
    *,
    width: int | None = None,
    sun: bool = True,
    overwrite: bool = False,
) -> Path:
    """Write a photo's sky, or an environment map, under an edit's sun as an environment map.

    The sky that the photo shows is the edited photo. The rest of the upper half is the fitted model
    with the photo's clouds mirrored. The lower half has the land's mean albedo and is lit by that
    sky. A ``.json`` of the same name describes the sun as a separate lamp, the seen and modeled
    parts, the camera and every convention. A Dome is relit by the model's ratio of new to old
    light; an unmoved Dome is written unchanged.

    Parameters
    ----------
    scene : Scene or Dome
        The result of ``analyze`` for a photo, or of ``analyze_dome`` for an environment map.
    edit : Edit, dict or None
        Edit of sun, air and clouds; None is the source's own. Exposure, glow and other lens effects
        are ignored. A Dome supports edits of sun and air only.
    path : path
        ``.exr`` (32-bit floats; needs the ``exr`` extra) or ``.hdr`` (Radiance).
    width : int
        Pixels, even, 8 to 16384; the height is half of it. Default: 2048, or the Dome's own.
    sun : bool
        Draw the disc, 0.533° wide, with the sun's whole light. False leaves it to a lamp.
    overwrite : bool
        Replace existing files.

    Returns
    -------
    Path
        The map's file.

    Raises
    ------
    FileExistsError
        When one of the two files exists and ``overwrite`` is false.
    PhotoError
        For another extension or width, or EXR without its extra.
    EditError
        For an edit of a Dome that changes more than sun and air.
    RendererError
        When this machine has no EGL. A Dome does not need it.
    """
    from sunwidget.analysis.scene import checked_scene
    from sunwidget.dome.source import Dome

    place = target(path, overwrite=overwrite)
    check_map(place)
    target(place.with_suffix(".json"), overwrite=overwrite)
    if width is None:
        width = scene.photo.width if isinstance(scene, Dome) else _WIDTH
    half = width // 2 if isinstance(width, int) else width
    size = checked_size((width, half))
    edit = edit_of(edit)
    if isinstance(scene, Dome):
        light = move_sun(scene, edit, size[0])
        facts = describe_moved(scene, edit, light, place.name, drawn=sun)
        _write(place, light.whole if sun else light.sky, facts, edit, overwrite, white=None)
        return place
    dome = dome_light(checked_scene(scene), edit, size[0])
    write_dome(place, scene, edit, dome, sun=sun, overwrite=overwrite)
    return place


def write_dome(
    place: Path, scene: Scene, edit: Edit, dome: DomeLight, *, sun: bool, overwrite: bool
) -> None:
    """Write a finished dome and its JSON."""
    facts = describe(corrected(scene, edit), edit, dome, place.name, sun=sun)
    _write(place, dome.sky + dome.disc if sun else dome.sky, facts, edit, overwrite, white=1000.0)


def _write(
    place: Path,
    light: NDArray[Any],
    facts: dict[str, Any],
    edit: Edit,
    overwrite: bool,
    *,
    white: float | None,
) -> None:
    notes = {"recipe": json.dumps(edit.to_dict()), "dome": json.dumps(facts)}
    light = np.asarray(light, np.float32)
    write_map(place, light, notes, overwrite=overwrite, white=white)
    with complete_or_absent(place.with_suffix(".json"), overwrite=overwrite) as unfinished:
        unfinished.write_text(json.dumps(facts, indent=1) + "\n", "utf-8")


def describe(scene: Scene, edit: Edit, dome: DomeLight, name: str, *, sun: bool) -> dict[str, Any]:
    """Return the JSON of a photo's dome; ``docs/guide/dome.md`` explains it."""
    camera = scene.camera
    heading = edit.place.heading if edit.place is not None else None
    heading = scene.photo.heading if heading is None else heading
    wide = 2 * np.degrees(np.arctan(camera.width / 2 / camera.focal))
    return {
        "format": FORMAT,
        "dome": name,
        "projection": PROJECTION,
        "unit": {
            "colour": "linear Rec. 709, the photo's own white balance",
            "radiance": "kcd m^-2",
            "absolute": False,
            "scale": "the fitted model's: a photo does not record its exposure",
        },
        "sun": sun_facts(
            dome.direction,
            dome.direct,
            heading=heading,
            drawn=sun,
            through=dome.through,
            confidence=scene.sun_confidence,
            spread=scene.sun_spread,
        ),
        "sky": _sky(dome),
        "ground": {"albedo": rounded(dome.albedo), "lit_by": "sky and sun of this dome"},
        "camera": {
            "fov_vertical_deg": round(camera.fov_vertical_deg, 4),
            "fov_horizontal_deg": round(float(wide), 4),
            "heading_deg": heading,
            "pitch_deg": round(camera.pitch, 4),
            "roll_deg": round(camera.roll, 4),
            "size": [camera.width, camera.height],
        },
        "horizon": {
            "elevation_deg": 0.0,
            "photo_row": round(scene.horizon.row, 2),
            "confidence": round(scene.horizon.confidence, 3),
        },
        "recipe": edit.to_dict(),
    }


def _sky(dome: DomeLight) -> dict[str, Any]:
    width = dome.sky.shape[1]
    seen = float((dome.seen * solid_angles(width)).sum())
    half = 2 * np.pi
    return {
        "illuminance_level_lux": digits(1000 * float(irradiance(dome.sky) @ LUMINANCE)),
        "seen_sr": round(seen, 5),
        "seen_share_of_sky": round(seen / half, 5),
        "modelled_share_of_sky": round(1 - seen / half, 5),
        "outside_the_photo": "model and mirrored clouds" if dome.mirrored else "model",
    }
