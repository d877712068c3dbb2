"""The precomputed sky: against the march, path tracing and Bruneton's own code; and its cache."""

import functools
import itertools
import os
import threading
import time

import numpy as np
import pytest

from sunwidget.atmosphere.constants import WAVELENGTHS, solar_irradiance
from sunwidget.atmosphere.optics import direct_irradiance
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.sky import SHADER, Quality, SkyTable
from sunwidget.validation.path_tracer import trace

pytest.importorskip("moderngl")

from sunwidget.renderer.bruneton import table_cache
from sunwidget.renderer.bruneton.precomputed_sky import (
    SIZES,
    bruneton_cost,
    bruneton_table,
    is_cached,
)
from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.graph import FrameGraph, Programs
from sunwidget.renderer.shader_source import EGL_HEADER, FULL_SCREEN_TRIANGLE, resolve_includes

AIR = Atmosphere()
ELEVATION = np.array([3, 12, 30, 60, 85.0])[:, None]
AZIMUTH = np.array([0, 40, 90, 135, 180.0])


@functools.cache
def made(air, orders=0):
    return bruneton_table(air, orders, size="tiny", cache=False)


@pytest.fixture(scope="module")
def table():
    return made(AIR)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "sunwidget"


def rms(ratio):
    return np.sqrt(np.mean((ratio - 1) ** 2))


def directions(elevation, azimuth):
    e, a = np.radians(np.broadcast_arrays(elevation, azimuth)).reshape(2, -1)
    return np.stack([np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a)], axis=1)


@pytest.mark.parametrize("sun", [60, 20, 6, 2, 0])
def test_the_table_of_one_order_is_the_march_of_single_scattering(sun):
    one = made(AIR, 1)
    march = SkyTable(AIR, quality=Quality(groups=60), multiple_scattering=False)
    ratio = one.radiance(ELEVATION, AZIMUTH, sun) / march.radiance(ELEVATION, AZIMUTH, sun)
    # 24 suns of a tiny table: what is lost between them, most at the terminator (0.5 % by day, 2 %
    # at 2 and 5 % at 0 degrees; the small size loses 0.1 to 1 %).
    assert rms(ratio) < (0.02 if sun > 2 else 0.07)


@pytest.mark.parametrize(("sun", "allowed"), [(60, 0.04), (20, 0.04), (3, 0.06), (-2, 0.12)])
def test_all_orders_agree_with_path_tracing(table, sun, allowed):
    # 2 % of the tiny table, and noise of 200 paths: 2 % by day, 5 % low, 9 % in twilight.
    views = directions(ELEVATION, AZIMUTH)
    traced, _ = trace(AIR, views, sun, paths=200, bounces=10)
    assert rms(table.radiance(ELEVATION, AZIMUTH, sun).reshape(-1, 4) / traced) < allowed


def test_more_orders_are_brighter_and_reach_all():
    sky = [made(AIR, n).radiance(ELEVATION, AZIMUTH, 30) for n in (1, 2, 4, 12, 0)]
    for fewer, more in itertools.pairwise(sky[:4]):
        assert np.all(more > fewer)
    # What follows the eighth order, in a geometric series, is all but what twelve orders hold.
    assert sky[4] == pytest.approx(sky[3], rel=3e-3)


def test_conservative_air_in_an_even_light_stays_even():
    # Furnace: see test_atmosphere_sky.
    air = Atmosphere(aerosol_albedo=1, ozone=0, ground_albedo=1, aerosol_optical_depth=0.1)
    suns = np.degrees(np.arcsin((np.arange(60) + 0.5) / 30 - 1))
    x, w = np.polynomial.legendre.leggauss(16)
    elevation = np.degrees(np.arcsin(x))[:, None, None]
    azimuth = 15 + 30 * np.arange(6.0)[:, None]
    sky = bruneton_table(air, size="tiny", cache=False).radiance(elevation, azimuth, suns)
    scattered = np.einsum("m,masw->w", w / 2, sky) / 6 / len(suns)
    direct = direct_irradiance(air, suns).mean(axis=0) / (4 * np.pi)
    share = 4 * np.pi * (scattered + direct) / solar_irradiance()
    # 0.994 to 0.996 was seen, of the small size 0.996 to 0.998.
    assert share == pytest.approx(np.ones(4), abs=0.01)


PROBE = """
uniform sampler2D bruneton_view;
uniform sampler2D directions;
out vec4 result;

void main() {
  result = GetSkyRadiance(bruneton_view, texelFetch(directions, ivec2(gl_FragCoord.xy), 0).xyz);
}
"""


def drawn(cut, air, sun, views, grid=(96, 80)):
    """Radiance towards ``views`` in the sky view that the shader draws from a slice."""

    def task(context):
        values = {**air.parameters(), "sun_elevation": float(sun), "sun_azimuth": 0.0}
        values |= {"scattering_orders": 0.0}
        inputs = {"bruneton": "bruneton"}
        row = {
            "name": "bruneton_view",
            "shader": "bruneton/view",
            "size": "grid",
            "format": "rgba32f",
            "inputs": inputs,
        }
        graph = FrameGraph(Programs(context), {"bruneton": cut})
        graph._run_pass(row, grid, values, {}, {"tile_origin": (0, 0)})
        text = EGL_HEADER + resolve_includes("atmosphere/read_sky_view.glsl") + PROBE
        probe = context.program(vertex_shader=FULL_SCREEN_TRIANGLE, fragment_shader=text)
        listed = np.zeros((1, len(views), 4), np.float32)
        listed[0, :, :3] = views
        source = context.texture((len(views), 1), 4, listed.tobytes(), dtype="f4")
        target = context.texture((len(views), 1), 4, dtype="f4")
        graph.targets["bruneton_view"].texture.use(0)
        source.use(1)
        probe["bruneton_view"].value, probe["directions"].value = 0, 1
        context.framebuffer([target]).use()
        context.vertex_array(probe, []).render(vertices=3)
        return np.frombuffer(target.read(), np.float32).reshape(-1, 4).astype(float)

    return on_gl_thread(task)


@pytest.mark.parametrize("altitude", [0.0, 3000.0])
@pytest.mark.parametrize("sun", [50, 8, -3])
def test_sky_view_from_a_slice_is_the_table(table, altitude, sun):
    elevation = np.array([-60, -20, -5, 0.5, 2, 10, 35, 70.0])[:, None]
    views = directions(elevation, AZIMUTH)
    shader = drawn(table.slice(altitude), AIR.replace(altitude=altitude), sun, views)
    numpy = table.radiance(elevation, AZIMUTH, sun, altitude).reshape(-1, 4)
    # Interpolation in the sky view; below the horizon it has twelve rows only.
    error = np.abs(shader / numpy - 1).reshape(len(elevation), -1)
    assert error[3:].max() < 0.02
    assert error[:3].max() < 0.05


def test_slice_is_small_and_knows_its_altitude(table):
    cut = table.slice(2500.0)
    assert cut.dtype == np.float32
    assert cut[-1, 0] == pytest.approx([2500, AIR.aerosol_asymmetry, 8, 24])
    for size in SIZES.values():
        _, mu, mu_s, nu = size.table
        assert (3 * mu_s + 1) * mu * nu * 16 < 1.6e6


def test_table_serves_every_altitude(table):
    march = SkyTable(AIR.replace(altitude=4000), quality=SHADER)
    ratio = table.radiance(ELEVATION, AZIMUTH, 25, altitude=4000) / march.radiance(
        ELEVATION, AZIMUTH, 25
    )
    # 2 % of the other model, 6 % of nine altitudes (of the small size's 16: 2 %).
    assert rms(ratio) < 0.08


def test_progress_rises_to_one_and_can_cancel():
    seen = []
    bruneton_table(AIR, 2, size="tiny", cache=False, progress=lambda f, _: seen.append(f))
    assert seen == sorted(seen)
    assert seen[-1] == pytest.approx(1)

    def cancel(fraction, _):
        if fraction > 0.1:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        bruneton_table(AIR, 2, size="tiny", cache=False, progress=cancel)


def test_other_users_of_the_gl_thread_wait_for_one_band_only():
    waits = []
    done = threading.Event()

    def other():
        while not done.is_set():
            start = time.perf_counter()
            on_gl_thread(lambda context: None)
            waits.append(time.perf_counter() - start)

    thread = threading.Thread(target=other)
    thread.start()
    start = time.perf_counter()
    bruneton_table(AIR, size="tiny", cache=False)
    whole = time.perf_counter() - start
    done.set()
    thread.join()
    assert len(waits) > 5
    assert max(waits) < 0.5 * whole + 0.5


def test_what_a_table_costs_is_told_before_it_is_made(table):
    assert 0 < bruneton_cost("tiny") < bruneton_cost("small") < bruneton_cost("full")
    assert table.seconds > 0
    with pytest.raises(ValueError, match="small"):
        bruneton_cost("huge")


def test_second_time_comes_from_the_disk(folder):
    assert not is_cached(AIR, 1, size="tiny")
    first = bruneton_table(AIR, 1, size="tiny")
    assert is_cached(AIR, 1, size="tiny")
    assert is_cached(AIR.replace(altitude=900), 1, size="tiny")
    assert not is_cached(AIR.replace(ozone=250), 1, size="tiny")
    second = bruneton_table(AIR, 1, size="tiny")
    assert second.seconds == 0
    np.testing.assert_allclose(second.tables, first.tables, rtol=3.5e-4, atol=2**-48)
    assert [f.suffix for f in folder.iterdir()] == [".npz"]


@pytest.mark.parametrize("content", [b"", b"PK no archive", None])
def test_a_spoilt_file_is_made_again(folder, content):
    table = np.ones((3, 2, 2), np.float32)
    table_cache.write("spoilt", table)
    file = table_cache.path("spoilt")
    whole = file.read_bytes()
    if content is None:
        middle = len(whole) // 2
        content = whole[:middle] + bytes([whole[middle] ^ 255]) + whole[middle + 1 :]
    file.write_bytes(content)
    assert table_cache.read("spoilt", table.shape) is None
    table_cache.write("spoilt", table)
    assert table_cache.read("spoilt", table.shape) is not None
    assert table_cache.read("spoilt", (1, 2, 3)) is None


def test_a_folder_that_cannot_be_written_is_warned_of(tmp_path, monkeypatch):
    blocked = tmp_path / "a file where the folder should be"
    blocked.write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(blocked))
    with pytest.warns(UserWarning, match="XDG_CACHE_HOME"):
        table = bruneton_table(AIR, 1, size="tiny")
    assert np.all(np.isfinite(table.tables))


def test_least_used_tables_go_first(folder, monkeypatch):
    table = np.ones(5000, np.float32)
    monkeypatch.setattr(table_cache, "_MOST_BYTES", 25_000)
    for age, name in ((300, "old"), (200, "older but used"), (100, "new")):
        table_cache.write(name, table)
        then = time.time() - age
        os.utime(table_cache.path(name), (then, then))
        table_cache.read("older but used", table.shape)
    assert table_cache.read("old", table.shape) is None
    assert table_cache.read("older but used", table.shape) is not None


def test_logarithms_keep_what_they_promise():
    rng = np.random.default_rng(0)
    values = np.exp2(rng.uniform(-48, 16, 10_000)).astype(np.float32)
    back = table_cache.decode(table_cache.encode(values))
    assert np.abs(back / values - 1).max() < 3.45e-4
    assert table_cache.decode(table_cache.encode(np.float32([0, 1e-30]))) == pytest.approx([0, 0])


def against_bruneton(folder, size="tiny"):
    """Sky per unit of solar irradiance by his code and ours, and the sun's elevation, by row."""
    spectra = np.genfromtxt(folder / "clear_sky_models_input_spectra_40bins.csv", delimiter=",")[1:]
    rows = np.genfromtxt(folder / "csm_model_outputs" / "dump_elek.csv", delimiter=",")[1:, 1:]
    nm, solar, albedo = spectra[:, [0, 1, 5]].T
    # Divided by the sun's lines, sky spectra are smooth enough to interpolate between bins.
    ratio = np.log(rows[:, 6:] / solar)
    theirs = np.exp([[np.interp(w, nm, row) for w in WAVELENGTHS] for row in ratio])
    # Over grass, whose albedo differs from colour to colour: radiance is all but linear in it.
    share = np.interp(WAVELENGTHS, nm, albedo) / 0.1
    sun, azimuth, elevation = 90 - rows[:, 0], rows[:, 5] - rows[:, 1], 90 - rows[:, 4]
    dark, bright = (
        bruneton_table(Atmosphere(ozone=0, ground_albedo=a), size=size, cache=False).radiance(
            elevation, azimuth, sun
        )
        for a in (0.0, 0.1)
    )
    ours = (dark * (1 - share) + bright * share) / solar_irradiance()
    return theirs, ours, sun


@pytest.mark.shared
def test_agrees_with_brunetons_own_code(shared):
    # 15 scans of 81 directions of one day, all orders, no ozone in his run: as in
    # test_atmosphere_measured, at the four wavelengths of the shaders.
    folder = shared / "data" / "sky-reference"
    if not (folder / "csm_model_outputs" / "dump_elek.csv").is_file():
        pytest.skip(f"no outputs of other models in {folder}")
    theirs, ours, _ = against_bruneton(folder)
    assert rms(ours / theirs) < 0.06
