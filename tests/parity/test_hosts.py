"""The canvas and the kernel draw the same frame: WebGL2 in Chromium against EGL.

Both run on Mesa here. Mean difference at most 1/255, largest 3/255: what is left comes from
8-bit rounding on either side of a half, and from float arithmetic that two compilers order
differently. Difference images (×40) of what fails stay behind in build/parity.
"""

import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import sunwidget as sw
from sunwidget.widgets import SunEditor

sys.path.insert(0, str(Path(__file__).parents[1] / "browser"))

from chromium import chromium, open_page, picture_of, widget_state

pytestmark = [pytest.mark.browser, pytest.mark.timeout(900)]

SAMPLES = ["coast", "harbour", "meadow", "mountains"]
TRUTH = ["field_clouds_az+00_el+06.0", "town_az-12_el+06.0", "coast_az+00_el-02.0"]
# Degrees: noon, evening, both sides, out of the picture, twilight.
SUNS = [(0, 55), (5, 12), (-14, 3), (18, 0.5), (60, 20), (2, -4)]
METHODS = ["ratio", "thesis", "thesis_literal"]
EDITS = [
    sw.Edit(sun_azimuth=azimuth, sun_elevation=elevation, method=method)
    for method in METHODS
    for azimuth, elevation in SUNS
]
# What only a person turns on.
EFFECTS = [
    sw.Edit(
        sun_azimuth=6,
        sun_elevation=3,
        light_shafts=1,
        lens_flare=1,
        glow=1.5,
        added_clouds=0.5,
        aerosol_optical_depth=0.3,
    ),
    sw.Edit(sun_azimuth=-8, sun_elevation=25, cloud_opacity=0.4, cloud_softness=0.6, glitter=1),
    sw.Edit(
        sun_azimuth=-8, sun_elevation=14, light_source="moon", added_clouds=0.3, light_shafts=1
    ),
]
LONG_EDGE = 480  # parity is per pixel; small pictures make room for many


@pytest.fixture(scope="module")
def page():
    with chromium() as browser:
        yield open_page(browser.new_context())


def compare(page, root, name, photo, edits=EDITS):
    scene = sw.analyze(photo)
    page.evaluate("async (state) => makeFrame(state)", widget_state(SunEditor(scene).wait()))
    worst = []
    for number, edit in enumerate(edits):
        canvas = picture_of(page.evaluate("(edit) => drawn(edit)", edit.to_dict()))
        kernel = sw.render(scene, edit)
        assert canvas.shape == kernel.shape
        assert canvas.std() > 1, "the canvas is uniform"
        away = np.abs(canvas.astype(int) - kernel)
        worst.append((away.mean(), away.max(), f"{edit}"))
        if away.mean() > 1 or away.max() > 3:
            folder = root / "build" / "parity"
            folder.mkdir(parents=True, exist_ok=True)
            stem = f"{name}-{edit.method}-{number}"
            Image.fromarray(np.minimum(away * 40, 255).astype(np.uint8)).save(
                folder / f"{stem}-difference.png"
            )
            Image.fromarray(canvas).save(folder / f"{stem}-canvas.png")
            Image.fromarray(kernel).save(folder / f"{stem}-kernel.png")
    mean, largest = max(w[0] for w in worst), max(w[1] for w in worst)
    print(f"{name}: largest mean {mean:.4f}/255, largest difference {largest}/255")
    assert mean <= 1, max(worst)
    assert largest <= 3, max(worst, key=lambda w: w[1])


def test_a_webgl2_context_exists(page):
    renderer = page.evaluate(
        """() => {
          const gl = document.createElement("canvas").getContext("webgl2");
          return gl && gl.getParameter(gl.VERSION);
        }"""
    )
    assert "WebGL 2.0" in renderer


@pytest.mark.parametrize("name", SAMPLES)
def test_canvas_and_kernel_agree_on_a_sample(page, root, name):
    compare(page, root, name, sw.sample(name).preview(LONG_EDGE))


@pytest.mark.parametrize("name", ["coast", "meadow"])
def test_canvas_and_kernel_agree_with_every_effect_on(page, root, name):
    compare(page, root, f"{name}-effects", sw.sample(name).preview(LONG_EDGE), EFFECTS)


@pytest.mark.shared
@pytest.mark.parametrize("name", TRUTH)
def test_canvas_and_kernel_agree_on_ground_truth(page, root, shared, name):
    compare(page, root, name, sw.open(shared / "truth" / f"{name}.png").preview(LONG_EDGE))


def test_unmoved_sun_changes_no_pixel_of_the_canvas(page):
    photo = sw.sample("coast").preview(LONG_EDGE)
    scene = sw.analyze(photo)
    page.evaluate("async (state) => makeFrame(state)", widget_state(SunEditor(scene).wait()))
    canvas = picture_of(page.evaluate("drawn({method: 'ratio'})"))
    assert np.abs(canvas.astype(int) - photo).max() <= 1
