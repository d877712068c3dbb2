"""One picture of all results of the analysis: small maps with titles and legends."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from sunwidget.analysis.maps import MAPS, SceneMap, ramp_colors, shares_of
from sunwidget.analysis.notices import UNSURE
from sunwidget.export import lettering

if TYPE_CHECKING:
    from PIL import Image

    from sunwidget.analysis.scene import Scene

_COLUMNS = 4
_LONG_EDGE = 420  # of a small picture, in pixels
_MARGIN, _GAP = 28, 24
_LINE = 19  # height of a line of small text
_BACK, _TEXT, _QUIET, _WARN = (24, 25, 27), (236, 237, 239), (160, 164, 170), (240, 184, 110)


def overview(scene: Scene) -> Image.Image:
    """Return a sheet: the photo with its findings marked, every map over the photo, warnings.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    PIL.Image.Image
        RGB; its width does not depend on the photo's.
    """
    from PIL import Image, ImageDraw

    photo = scene.photo.preview(long_edge=_LONG_EDGE)
    height, width = photo.shape[:2]
    tiles: list[tuple[str, str, Image.Image, SceneMap | None]] = [
        (scene.photo.name, _facts(scene), draw_findings(scene), None)
    ]
    absent = []
    for entry in MAPS:
        shares = shares_of(scene, entry, (width, height))
        if shares is None:
            absent.append(entry.title)
        else:
            empty = entry.low == 0 and float(shares.max()) < 1 / 255
            text = "None found: 0 everywhere." if empty else entry.help
            tiles.append((entry.title, text, tint_map(photo, shares, entry), entry))
    cell_width = max(width, 300)
    columns = min(_COLUMNS, max(2, round(1760 / cell_width)))
    cell_height = 30 + height + 26 + 2 * _LINE + 18
    rows = math.ceil(len(tiles) / columns)
    sheet_width = 2 * _MARGIN + columns * cell_width + (columns - 1) * _GAP
    notes = [f"! {text}" for text in scene.warnings]
    if absent:
        notes.append(f"Not in this photo: {', '.join(absent)}.")
    lines = [
        line for note in notes for line in lettering.wrapped(note, sheet_width - 2 * _MARGIN, 15)
    ]
    sheet_height = 2 * _MARGIN + rows * cell_height + len(lines) * 22
    sheet = Image.new("RGB", (sheet_width, sheet_height), _BACK)
    draw = ImageDraw.Draw(sheet)
    for i, (title, text, image, described) in enumerate(tiles):
        x = _MARGIN + i % columns * (cell_width + _GAP)
        y = _MARGIN + i // columns * cell_height
        lettering.write(draw, (x, y), lettering.cut(title, cell_width, 18), 18, _TEXT)
        sheet.paste(image, (x, y + 28))
        below = y + 28 + height + 6
        if described is not None:
            _legend(sheet, (x, below), width, described)
            below += 22
        for line in lettering.wrapped(text, cell_width, 14)[: 2 if described else 3]:
            lettering.write(draw, (x, below), line, 14, _QUIET)
            below += _LINE
    y = _MARGIN + rows * cell_height
    for line in lines:
        lettering.write(draw, (_MARGIN, y), line, 15, _WARN)
        y += 22
    return sheet


def draw_findings(scene: Scene, long_edge: int = _LONG_EDGE) -> Image.Image:
    """Return the photo with the sky's edge (blue), the horizon (red) and the sun (yellow)."""
    import cv2
    from PIL import Image, ImageDraw

    photo = scene.photo.preview(long_edge=long_edge).copy()
    height, width = photo.shape[:2]
    scale = width / scene.camera.width
    sky = cv2.resize(scene.sky, (width, height), interpolation=cv2.INTER_AREA)
    outlines, _ = cv2.findContours(
        (sky > 0.5).astype(np.uint8), cv2.RETR_LIST, cv2.CHAIN_APPROX_NONE
    )
    cv2.drawContours(photo, outlines, -1, (60, 150, 255), max(1, round(width / 400)))
    image = Image.fromarray(photo)
    draw = ImageDraw.Draw(image)
    stroke = max(2, round(width / 250))
    rise = math.tan(math.radians(scene.horizon.roll)) * width / 2
    row = scene.horizon.row * scale
    draw.line([(0, row - rise), (width, row + rise)], fill=(255, 60, 40), width=stroke)
    if scene.sun is not None:
        x, y = scene.sun.x * scale, scene.sun.y * scale
        ring = max(scene.sun.radius_px * scale * 1.5, width / 40)
        draw.ellipse((x - ring, y - ring, x + ring, y + ring), outline=(255, 220, 0), width=stroke)
    return image


def tint_map(photo: np.ndarray, shares: np.ndarray, entry: SceneMap) -> Image.Image:
    """Return a map in color over the photo in subdued gray.

    Parameters
    ----------
    photo : (h, w, 3) uint8
    shares : (h, w) float32
        As returned by ``shares_of``.
    entry : SceneMap
    """
    from PIL import Image

    gray = photo.astype(np.float32).mean(-1, keepdims=True) * np.float32(0.75) + 10
    color = ramp_colors(entry.ramp)[np.round(shares * 255).astype(np.uint8)]
    alpha = color[..., 3:]
    mixed = gray * (1 - alpha) + 255 * color[..., :3] * alpha
    return Image.fromarray(np.round(mixed).astype(np.uint8))


def _facts(scene: Scene) -> str:
    sky = 100 * float(np.mean(scene.sky))
    parts = [f"{scene.width} x {scene.height}, sky {sky:.0f} %"]
    if scene.sun is None:
        parts.append("no sun found, position assumed")
    else:
        side = "left" if scene.sun.azimuth < 0 else "right"
        where = "" if scene.sun.visible else " (not visible)"
        what = f"{scene.sun.kind} {abs(scene.sun.azimuth):.1f}° {side}"
        parts.append(f"{what}, {scene.sun.elevation:.1f}° up{where}")
    horizon = scene.horizon
    sure = "guessed" if horizon.confidence < 0.3 else "found"
    parts.append(
        f"horizon at {100 * horizon.row / scene.height:.0f} % of the height, "
        f"roll {horizon.roll:.1f}° ({horizon.source}, {sure})"
    )
    parts.append(f"field of view {scene.camera.fov_vertical_deg:.0f}°")
    if scene.atmosphere.confidence is not None:
        fits = "fits" if scene.atmosphere.confidence >= UNSURE else "a guess"
        parts.append(f"atmosphere {fits}")
    return " · ".join(parts)


def _legend(sheet: Image.Image, at: tuple[int, int], width: int, entry: SceneMap) -> None:
    """Draw the color ramp between its lowest and highest value."""
    from PIL import Image, ImageDraw

    colors = ramp_colors(entry.ramp, 160)
    mixed = 60 * (1 - colors[:, 3:]) + 255 * colors[:, :3] * colors[:, 3:]
    bar = np.repeat(np.round(mixed).astype(np.uint8)[None], 10, axis=0)
    draw = ImageDraw.Draw(sheet)
    x, y = at
    low, high = (f"{v:g} {entry.unit}".strip() for v in (entry.low, entry.high))
    lettering.write(draw, (x, y), low, 13, _QUIET)
    x += lettering.width(low, 13) + 6
    sheet.paste(Image.fromarray(bar), (x, y + 4))
    lettering.write(draw, (x + 166, y), high, 13, _QUIET)
