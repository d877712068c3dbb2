"""What a scene says of itself in a notebook: three short lines."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from sunwidget.analysis.images.working_copy import resize

if TYPE_CHECKING:
    from sunwidget.analysis.scene import Scene


def described(scene: Scene) -> str:
    """Return the photo, where sun, horizon and camera are, and what shares of it are what."""
    return (
        f"<Scene of {scene.photo.name!r}, {scene.width}×{scene.height}\n"
        f" {_sun(scene)}; horizon in row {scene.horizon.row:.0f}; "
        f"field of view {scene.camera.fov_vertical_deg:.3g}°\n"
        f" {_shares(scene)}>"
    )


def _sun(scene: Scene) -> str:
    azimuth, elevation = scene.automatic["sun_azimuth"], scene.automatic["sun_elevation"]
    body = "moon" if scene.lit_by_moon else "sun"
    how = "assumed" if scene.sun is None and scene.moon is None else "seen"
    if scene.sun is not None and scene.sun.source == "hint":
        how = "told"
    return f"{body} at azimuth {azimuth:.1f}°, elevation {elevation:.1f}° ({how})"


def _shares(scene: Scene) -> str:
    sky = scene.small_sky
    clouds = resize(scene.cloud_map, scene.working.width, scene.working.height) * sky
    parts = {"sky": sky, "clouds": clouds, "water": scene.small_water}
    return ", ".join(f"{name} {100 * float(np.mean(part)):.0f} %" for name, part in parts.items())
