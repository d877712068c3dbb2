"""The sky of an edit as an environment map, a light source for 3D programs.

The projection is equirectangular (latitude-longitude). The middle column is the camera's heading;
azimuth grows to the right, 360° over the width; the top row is the zenith, the bottom row the
nadir. The lower half shows the model's ground, lit by sun and sky. Values are linear Rec. 709 in
kcd m⁻²; 1000 times the luminance of a pixel is in cd m⁻².
"""

from __future__ import annotations

import json
import operator
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from sunwidget.analysis.correct import corrected
from sunwidget.dome.disc import sun_disc
from sunwidget.edit.recipe import edit_of
from sunwidget.errors import PhotoError
from sunwidget.files import complete_or_absent, target
from sunwidget.formats.color import LUMINANCE
from sunwidget.messages import short_repr

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene
    from sunwidget.atmosphere.parameters import Atmosphere
    from sunwidget.edit.table import Edit

Floats = NDArray[np.float32]

# Directions evaluated at a time: one row of a texture.
_AT_ONCE = 8192
# Least share of the luminance in each channel, for spectra outside Rec. 709; as in the frame.
_LEAST_CHANNEL = 0.02
# As sky/moonlight.glsl: full moon over sun, and the sky without either, kcd m⁻².
MOON_OVER_SUN = np.array([1.1, 1.0, 0.8]) / 402_000
"""Full moon over sun, by channel."""
_NIGHT_SKY = np.array([2.6e-7, 2.5e-7, 2.3e-7])


def environment_map(
    scene: Scene,
    edit: Edit | dict[str, Any] | None,
    path: str | os.PathLike[str],
    *,
    size: tuple[int, int] = (2048, 1024),
    sun: bool = True,
    overwrite: bool = False,
) -> Path:
    """Write the clear sky fitted to a photo, under an edit's sun, as an environment map.

    Parameters
    ----------
    scene : Scene
        The result of ``analyze``.
    edit : Edit, dict or None
        Edit of sun and air; None is the photo's own.
    path : path
        ``.hdr`` (Radiance) or ``.exr`` (32-bit floats, since the sun exceeds half floats; needs
        the ``exr`` extra).
    size : (width, height)
        In pixels, width twice the height.
    sun : bool
        Draw the disc. Its pixels, however few, emit the sun's whole light.
    overwrite : bool
        Replace an existing file.

    Returns
    -------
    Path
        The file, which contains the recipe.

    Raises
    ------
    FileExistsError
        When ``path`` exists and ``overwrite`` is false.
    PhotoError
        For another ending or shape, or EXR without its extra.
    RendererError
        When this machine has no EGL.
    """
    place = target(path, overwrite=overwrite)
    check_map(place)
    width, height = checked_size(size)
    edit = edit_of(edit)
    light = environment(scene, edit, (width, height), sun=sun)
    notes = {"recipe": json.dumps(edit.to_dict())}
    write_map(place, light, notes, overwrite=overwrite)
    return place


def write_map(
    place: Path,
    light: NDArray[Any],
    notes: dict[str, str],
    *,
    overwrite: bool,
    white: float | None = 1000.0,
) -> None:
    """Write an environment map (H, 2 H, 3) float32 as .hdr or .exr, by the file's ending.

    ``white`` is the luminance of 1 in cd m⁻², if known.
    """
    from sunwidget.export.metadata import software
    from sunwidget.formats import openexr, radiance

    with complete_or_absent(place, overwrite=overwrite) as unfinished:
        if place.suffix.lower() == ".hdr":
            unfinished.write_bytes(radiance.pack(light, notes, software=software()))
        else:
            latitude_longitude = openexr.library().ENVMAP_LATLONG
            attributes = {"envmap": latitude_longitude, "software": software()}
            attributes |= {} if white is None else {"whiteLuminance": white}
            channels = {name: light[..., i] for i, name in enumerate("RGB")}
            openexr.write(unfinished, channels, attributes, notes, bits=32)


def checked_size(size: Any) -> tuple[int, int]:
    """Return a map's width and height, or raise PhotoError."""
    try:
        width, height = (operator.index(n) for n in size)
    except (TypeError, ValueError):
        width = height = 0
    if width != 2 * height or not 8 <= width <= 16384:
        raise PhotoError(
            "An environment map must be twice as wide as high, 8 to 16384 pixels wide, not "
            f"{short_repr(size, 40)}."
        )
    return width, height


def check_map(path: Path) -> None:
    """Check, before any work, that a file can hold an environment map.

    Raises
    ------
    PhotoError
        For an ending other than .hdr and .exr, and for EXR without its extra.
    """
    from sunwidget.formats import openexr

    kind = path.suffix.lower()
    if kind not in (".hdr", ".exr"):
        raise PhotoError(
            f"An environment map's file must end in .hdr or .exr, not {kind or 'nothing'!r}."
        )
    if kind == ".exr":
        openexr.library()


def environment(scene: Scene, edit: Edit, size: tuple[int, int], *, sun: bool = True) -> Floats:
    """Return the map, (height, width, 3) float32 linear Rec. 709 in kcd m⁻²."""
    from sunwidget.atmosphere.color import spectral_to_rec709
    from sunwidget.explorer.draw import radiance_at

    scene = corrected(scene, edit)
    values = explorer_values(scene, edit)
    width, height = size
    azimuth = ((np.arange(width) + 0.5) / width - 0.5) * 360
    elevation = (0.5 - (np.arange(height) + 0.5) / height) * 180
    directions = np.stack(np.meshgrid(azimuth, elevation), axis=-1).reshape(-1, 2)
    starts = range(0, len(directions), _AT_ONCE)
    parts = [radiance_at(values, directions[start : start + _AT_ONCE]) for start in starts]
    sky = spectral_to_rec709(np.concatenate(parts)).reshape(height, width, 3)
    sky = np.maximum(sky, _LEAST_CHANNEL * (sky @ LUMINANCE)[..., None])
    if sun:
        sky += sun_disc(air_of(values), values["sun_azimuth"], values["sun_elevation"], size)
    if is_moonlit(scene, edit):
        sky = sky * MOON_OVER_SUN + _NIGHT_SKY
    return np.asarray(sky, np.float32)


def explorer_values(scene: Scene, edit: Edit) -> dict[str, Any]:
    """Return SkyExplorer's parameters for the edit's sky; the two tables share names."""
    from sunwidget.explorer.table import EXPLORER_PARAMETERS, GRIDS
    from sunwidget.renderer.values import parameter_values

    values: dict[str, Any] = {row.name: row.default for row in EXPLORER_PARAMETERS}
    chosen = parameter_values(edit, scene.automatic)
    values |= {name: chosen[name] for name in values if name in chosen and name != "exposure"}
    return values | {"grid": GRIDS[-1]}


def air_of(values: dict[str, Any]) -> Atmosphere:
    """Return the air of ``explorer_values``."""
    from sunwidget.atmosphere.parameters import RANGES, Atmosphere

    return Atmosphere(**{name: values[name] for name in RANGES})


def is_moonlit(scene: Scene, edit: Edit) -> bool:
    """Return whether the moon lights an edit's sky."""
    return edit.light_source == "moon" or (edit.light_source == "automatic" and scene.lit_by_moon)
