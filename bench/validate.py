"""Compare the clear sky with measurements, other models and itself on both hosts.

usage: python bench/validate.py [--paths N] [--data FOLDER]

Prints the nine rows of atmosphere.md and writes build/validation.json; the exit status is 1 if a
row misses its bound. FOLDER (default $SUNWIDGET_SHARED/data/sky-reference, else ../shared/…) may
hold the measured skies and other models' skies; measured skies are also looked for where
`sunwidget.validation.measurements.download()` keeps them.
"""

from __future__ import annotations

import argparse
import base64
import io
import json
import math
import os
import shutil
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from sunwidget.validation import measurements, report
from sunwidget.validation.report import Row

ROOT = Path(__file__).resolve().parents[1]
STATIC = ROOT / "sunwidget" / "static"
ADDRESS = "http://canvas.invalid/"
# Mesa's llvmpipe through ANGLE, the rasteriser that EGL uses on a machine without a GPU.
FLAGS = ["--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist", "--no-sandbox"]
PAGE = """
<!doctype html><canvas id="canvas"></canvas>
<script type="module">
import { SkyFrame } from "./sky_explorer.js";
const canvas = document.getElementById("canvas");
const frame = new SkyFrame(canvas, await (await fetch("./parameters.json")).json());
window.drawn = (values, size) => {
  frame.draw(values, size);
  return canvas.toDataURL("image/png").split(",")[1];
};
window.radiances = (directions) => Array.from(frame.radiances(directions));
window.ready = true;
</script>
"""
SIZE = (480, 320)
# Bruneton's own tolerance ladder: by day 46 dB, with the sun 2° above the horizon 40 dB.
SUNS = ((60.0, 46), (20.0, 46), (2.0, 40))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--paths", type=int, default=600, help="a direction in row 6 (600)")
    shared = Path(os.environ.get("SUNWIDGET_SHARED", ROOT.parent / "shared"))
    parser.add_argument("--data", type=Path, default=shared / "data" / "sky-reference")
    options = parser.parse_args()
    begin = time.perf_counter()
    data = measurements.load(options.data) if measurements.is_available(options.data) else None
    table = Table()
    found = report.rows(options.data, data, options.paths, progress=table)
    for row in hosts():
        found.append(row)
        table(row)
    missed = [row for row in found if row.met is False]
    skipped = sum(row.met is None for row in found)
    seconds = time.perf_counter() - begin
    show(
        f"\n{len(found) - skipped - len(missed)} of {len(found)} figures meet their bound, "
        f"{len(missed)} miss it, {skipped} need something; {seconds:.0f} s"
    )
    path = ROOT / "build" / "validation.json"
    path.parent.mkdir(exist_ok=True)
    path.write_text(json.dumps([row._asdict() for row in found], indent=1, ensure_ascii=False))
    show(f"figures: {path.relative_to(ROOT)}")
    return 1 if missed else 0


def show(text: str) -> None:
    print(text, flush=True)


class Table:
    """Prints rows below their source."""

    def __init__(self) -> None:
        self.source = ""

    def __call__(self, row: Row) -> None:
        if row.source != self.source:
            self.source = row.source
            show(f"\n{row.number}  {row.source}")
        if row.met is None:
            show(f"   {row.name:58} {row.note}")
            return
        met = "met" if row.met else "MISSED"
        show(f"   {row.name:58} {row.value:10.4g}  {row.target:26} {met}")


def hosts() -> Iterator[Row]:
    """Row 9: NumPy, EGL and WebGL2 draw one sky."""
    at = report._At(9, "hosts against each other; bounds of the picture as Bruneton 2017")  # noqa: SLF001
    name = "shaders on EGL and NumPy"
    try:
        from sunwidget.errors import RendererError
        from sunwidget.explorer.draw import draw

        draw(state(20.0), (8, 8))
    except (ImportError, RendererError) as error:
        yield at.needs(name, f"EGL: {str(error).splitlines()[0]}")
        yield at.needs("WebGL2 and EGL", "EGL")
        return
    for sun, bound in ((60.0, 0.5), (20.0, 0.5), (2.0, 1.0), (-4.0, 3.0)):
        error = 100 * numpy_difference(sun)
        yield at.most(f"{name}, sun at {sun:g}°, 99 % of directions", error, bound, "%")
    missing = [
        what
        for what, there in (
            ("Chromium", shutil.which("chromium") or shutil.which("chromium-browser")),
            ("the built front end (make build)", (STATIC / "sky_explorer.js").is_file()),
            ("playwright", _has_playwright()),
        )
        if not there
    ]
    if missing:
        yield at.needs("WebGL2 and EGL", ", ".join(missing))
        return
    for sun, bound, decibel, relative in webgl_differences():
        yield at.least(f"WebGL2 and EGL, sun at {sun:g}°: picture, PSNR", decibel, bound, "dB")
        yield at.most(f"WebGL2 and EGL, sun at {sun:g}°: radiance", relative, 1e-3)


def state(sun: float) -> dict[str, Any]:
    """Every parameter of SkyExplorer: a wide view past the sun."""
    from sunwidget.explorer.table import EXPLORER_PARAMETERS

    values = {p.name: p.default for p in EXPLORER_PARAMETERS}
    return values | {
        "sun_elevation": sun,
        "sun_azimuth": 20.0,
        "projection": "camera",
        "view_elevation": 25.0,
        "fov": 80.0,
    }


def directions() -> np.ndarray:
    """Azimuth and elevation all over the sky, (n, 2), off the nodes of any grid."""
    elevation = 90 * ((np.arange(24) + 0.37) / 24) ** 1.5
    azimuth = np.arange(-180, 180, 15.0) + 3.3
    return np.stack(np.meshgrid(azimuth, elevation), axis=-1).reshape(-1, 2)


def numpy_difference(sun: float) -> float:
    """Return the relative error of radiance at four wavelengths: the 99th percentile."""
    from sunwidget.atmosphere.parameters import Atmosphere
    from sunwidget.atmosphere.sky import SHADER, SkyTable
    from sunwidget.explorer.draw import radiance_at

    values, where = state(sun), directions()
    shaders = radiance_at(values, where)
    table = SkyTable(Atmosphere(), quality=SHADER)
    numpy = table.radiance(where[:, 1], where[:, 0] - values["sun_azimuth"], sun)
    return float(np.quantile(np.abs(shaders / numpy - 1), 0.99))


def webgl_differences() -> Iterator[tuple[float, float, float, float]]:
    """Sun, bound, PSNR of the picture in decibel, largest relative difference of radiance."""
    from playwright.sync_api import sync_playwright

    from sunwidget.explorer.draw import draw, radiance_at
    from sunwidget.explorer.table import EXPLORER_PARAMETERS
    from sunwidget.widgets.kernel.payload import parameter_json

    path = shutil.which("chromium") or shutil.which("chromium-browser")
    answers = {
        "": {"body": PAGE, "content_type": "text/html"},
        "parameters.json": {
            "body": json.dumps(parameter_json(EXPLORER_PARAMETERS)),
            "content_type": "application/json",
        },
        "sky_explorer.js": {
            "body": (STATIC / "sky_explorer.js").read_text("utf-8"),
            "content_type": "text/javascript",
        },
    }
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, headless=True, args=FLAGS)
        page = browser.new_page()
        page.route(
            ADDRESS + "**",
            lambda route: route.fulfill(
                **answers.get(route.request.url.rsplit("/", 1)[1], {"status": 404})
            ),
        )
        page.goto(ADDRESS)
        page.wait_for_function("window.ready === true", timeout=120_000)
        for sun, bound in SUNS:
            values = state(sun)
            png = page.evaluate("([v, s]) => drawn(v, s)", [values, list(SIZE)])
            canvas = np.asarray(Image.open(io.BytesIO(base64.b64decode(png))).convert("RGB"), float)
            if canvas.std() < 1:
                raise RuntimeError("The canvas is uniform: nothing was measured.")
            kernel = draw(values, SIZE).astype(float)
            found = page.evaluate("(d) => radiances(d)", directions().tolist())
            browser_radiance = np.array(found).reshape(-1, 4)
            error = np.abs(browser_radiance / radiance_at(values, directions()) - 1).max()
            mean_square = np.mean((canvas - kernel) ** 2)
            decibel = 10 * math.log10(255**2 / mean_square) if mean_square else 99.0
            yield sun, bound, decibel, float(error)
        browser.close()


def _has_playwright() -> bool:
    try:
        import playwright.sync_api  # noqa: F401
    except ImportError:
        return False
    return True


if __name__ == "__main__":
    sys.exit(main())
