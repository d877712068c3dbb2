"""SkyExplorer's sky is the same on the page and in the kernel: WebGL2 in Chromium against EGL.

Both run on Mesa here. Bounds after Bruneton's ladder ("Precomputed Atmospheric Scattering: a New
Implementation", 2017): PSNR of 46 dB by day and 40 dB with the sun at 88 degrees from the zenith
and below; linear radiance within 1e-3.
"""

import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from sunwidget.explorer.draw import BACKGROUND, CURVES, curve, draw, radiance_at, table
from sunwidget.explorer.projection import Projection
from sunwidget.explorer.table import EXPLORER_PARAMETERS, PROJECTIONS

sys.path.insert(0, str(Path(__file__).parents[1] / "browser"))

from chromium import chromium, open_page, picture_of

pytestmark = [pytest.mark.browser, pytest.mark.timeout(900)]

SIZE = (360, 240)
# Elevation, and the bound in dB.
SUNS = [(60.0, 46), (20.0, 46), (4.0, 46), (2.0, 40), (0.0, 40), (-3.0, 40), (-8.0, 40)]
HAZY = {"aerosol_optical_depth": 0.4, "aerosol_asymmetry": 0.85, "ground_albedo": 0.5}
VIEWS = [
    {},
    HAZY,
    {"altitude": 12000.0, "air_density": 1.5, "rayleigh_exponent": 3.2},
    {"compare": "single"},
    {"show_single": False, "grid": "128×128"},
    {"scattering_orders": 2.0, "show_ozone": False},
]


def sky(**changes):
    return {p.name: p.default for p in EXPLORER_PARAMETERS} | changes


@pytest.fixture(scope="module")
def page():
    with chromium() as browser:
        page = open_page(browser.new_context())
        page.evaluate(
            """async (rows) => {
              const { SkyFrame } = await import("/sky_explorer.js");
              const canvas = document.createElement("canvas");
              document.body.append(canvas);
              window.sky = new SkyFrame(canvas, rows);
              window.drawn = (values, size, [red, green, blue]) => {
                if (!sky.draw(values, size)) throw new Error("nothing was drawn");
                // Over the kernel's background, for the canvas is see-through round the dome.
                const opaque = document.createElement("canvas");
                [opaque.width, opaque.height] = size;
                const context = opaque.getContext("2d");
                context.fillStyle = `rgb(${red} ${green} ${blue})`;
                context.fillRect(0, 0, ...size);
                context.drawImage(canvas, 0, 0);
                return opaque.toDataURL("image/png").split(",")[1];
              };
              window.texels = (name) => Array.from(sky.curve(name));
            }""",
            [p._asdict() for p in EXPLORER_PARAMETERS],
        )
        yield page


def canvas_of(page, values, size=SIZE):
    return picture_of(page.evaluate("(list) => drawn(...list)", [values, list(size), BACKGROUND]))


def floats_of(page, name):
    return np.array(page.evaluate("(name) => texels(name)", name)).reshape(-1, 4)


def psnr(first, second):
    error = np.mean((first.astype(float) - second) ** 2)
    return 10 * np.log10(255**2 / max(error, 1e-12))


def compare(page, root, name, values, bound):
    canvas, kernel = canvas_of(page, values), draw(values, SIZE)
    assert canvas.shape == kernel.shape
    assert canvas.std() > 5, "the canvas is uniform"
    reached = psnr(canvas, kernel)
    if reached < bound:
        folder = root / "build" / "parity"
        folder.mkdir(parents=True, exist_ok=True)
        away = np.abs(canvas.astype(int) - kernel)
        Image.fromarray(np.minimum(away * 40, 255).astype(np.uint8)).save(
            folder / f"sky-{name}-difference.png"
        )
        Image.fromarray(canvas).save(folder / f"sky-{name}-canvas.png")
    assert reached >= bound, name
    return reached


@pytest.mark.parametrize("projection", PROJECTIONS)
def test_canvas_and_kernel_agree(page, root, projection):
    worst = min(
        compare(
            page,
            root,
            f"{projection}-{elevation:g}",
            sky(sun_elevation=elevation, sun_azimuth=20.0, projection=projection),
            bound,
        )
        for elevation, bound in SUNS
    )
    print(f"{projection}: at least {worst:.1f} dB")


@pytest.mark.parametrize("changes", VIEWS, ids=lambda changes: "-".join(changes) or "default")
def test_canvas_and_kernel_agree_on_other_skies(page, root, changes):
    for elevation, bound in ((35.0, 46), (1.0, 40)):
        values = sky(sun_elevation=elevation, **changes)
        compare(page, root, f"{'-'.join(changes)}-{elevation:g}", values, bound)


@pytest.mark.parametrize("elevation", [50.0, 1.0, -6.0])
def test_the_tables_of_linear_radiance_agree_between_canvas_and_kernel(page, elevation):
    values = sky(sun_elevation=elevation, **HAZY)
    canvas_of(page, values)
    for name in ("multiple_scattering", "sky_view", "light"):
        kernel = table(values, name).reshape(-1, 4)
        assert np.ptp(kernel) > 0
        # Absolute: what is zero but for rounding.
        floor = 1e-9 * float(np.abs(kernel).max())
        assert floats_of(page, name) == pytest.approx(kernel, rel=1e-3, abs=floor), name


@pytest.mark.parametrize("name", CURVES)
def test_the_curves_beside_the_sky_agree_between_canvas_and_kernel(page, name):
    for elevation in (40.0, 0.5):
        values = sky(sun_elevation=elevation, **HAZY)
        canvas_of(page, values)
        kernel = curve(values, name)
        assert np.ptp(kernel) > 0
        assert floats_of(page, name) == pytest.approx(kernel, rel=1e-3, abs=1e-9)


def test_single_directions_agree(page):
    values = sky(sun_elevation=25.0, sun_azimuth=-100.0)
    directions = [[-100.0, 20.0], [10.0, 3.0], [170.0, 88.0], [0.0, -5.0]]
    canvas_of(page, values)
    seen = page.evaluate("(list) => Array.from(sky.radiances(list))", directions)
    assert np.reshape(seen, (4, 4)) == pytest.approx(radiance_at(values, directions), rel=1e-3)


def test_around_the_dome_the_canvas_is_see_through(page):
    canvas_of(page, sky())
    alpha = page.evaluate("Array.from(sky.pixels()).filter((_, i) => i % 4 === 3)")
    alpha = np.reshape(alpha, SIZE[::-1])
    dome = Projection(name="dome", size=SIZE)
    x, y = np.meshgrid(np.arange(SIZE[0]) + 0.5, np.arange(SIZE[1]) + 0.5)
    from_zenith = np.hypot(x - 180, y - 120)
    assert np.all(alpha[from_zenith < dome.scale - 1] == 255)
    assert np.all(alpha[from_zenith > dome.scale + 1] == 0)


def test_a_lost_context_is_made_again_and_draws_the_same(page):
    values = sky(sun_elevation=15.0)
    before = canvas_of(page, values)
    page.evaluate("sky.graph.gl.getExtension('WEBGL_lose_context').loseContext()")
    page.wait_for_timeout(50)
    assert np.array_equal(canvas_of(page, values), before)


def test_dragging_the_sun_leaves_the_air_alone(page):
    canvas_of(page, sky(sun_elevation=30.0))
    before = page.evaluate("({...sky.graph.runs})")
    canvas_of(page, sky(sun_elevation=31.0))
    after = page.evaluate("sky.graph.runs")
    ran = {name for name in after if after[name] != before.get(name, 0)}
    assert ran == {"sky_view", "shown", "light", "adaptation", "sun_disc", "explorer_frame"}


def test_the_reference_gathers_the_same_paths(page):
    values = sky(model="reference", sun_elevation=12.0, ground_albedo=0.3)
    size = (60, 40)
    for samples in range(1, 5):
        canvas = canvas_of(page, values, size)
        assert page.evaluate("sky.samples") == samples
    # Same random numbers; a path that turns elsewhere by a rounding is one pixel of 2400.
    assert psnr(canvas, draw(values, size, samples=4)) >= 40
    canvas_of(page, values | {"sun_elevation": 13.0}, size)
    assert page.evaluate("sky.samples") == 1, "another sun begins anew"
    canvas_of(page, sky(), size)
    assert page.evaluate("sky.samples") == 0


def test_no_error_was_thrown_on_the_page(page):
    assert page.errors == []
