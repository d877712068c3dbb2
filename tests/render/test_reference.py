"""The path-traced reference in GLSL: against the one in NumPy, the march, and an even light."""

import functools

import numpy as np
import pytest

from sunwidget.atmosphere.constants import solar_irradiance
from sunwidget.atmosphere.optics import direct_irradiance
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.sky import Quality, SkyTable
from sunwidget.validation.path_tracer import trace

pytest.importorskip("moderngl")

from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.graph import FrameGraph, Programs
from sunwidget.renderer.shader_source import frame_graph, resolve_includes

CLEAR = Atmosphere()
HAZE = Atmosphere(aerosol_optical_depth=0.3, aerosol_asymmetry=0.75, ground_albedo=0.3)
ODD = Atmosphere(air_density=1.5, rayleigh_exponent=3, aerosol_scale_height=2500, altitude=2000)
PASSES = {
    "passes": [
        row for row in frame_graph("explorer")["passes"] if row["name"] in ("columns", "reference")
    ]
}


@functools.cache
def programs(context):
    return Programs(context)


def paths(air, sun, view, *, runs=4, side=32, orders=0):
    """Samples towards ``view`` (azimuth from the sun, elevation): side², each a mean of ``runs``.

    A camera of a hundredth of a degree: every pixel has the same view and its own paths.
    """
    values = {
        **air.parameters(),
        "sun_elevation": float(sun),
        "sun_azimuth": 0.0,
        "scattering_orders": float(orders),
        "projection": 2.0,
        "view_azimuth": float(view[0]),
        "view_elevation": float(view[1]),
        "fov": 0.01,
    }
    host = {"frame_size": (float(side), float(side))}

    def task(context):
        graph = FrameGraph(programs(context), {}, PASSES)
        means = []
        for _ in range(runs):
            target = graph.run(
                {"edit": values}, {}, host, (0, 0, side, side), ["reference"], "reference"
            )
            means.append(np.frombuffer(target.texture.read(), np.float32).reshape(-1, 4))
        return np.array(means, float)

    return on_gl_thread(task)


def estimate(*args, **kwargs):
    samples = paths(*args, **kwargs)[-1]
    return samples.mean(axis=0), samples.std(axis=0) / np.sqrt(len(samples))


def directions(views):
    a, e = np.radians(views).T
    return np.stack([np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a)], axis=1)


@pytest.mark.parametrize(
    ("air", "sun"),
    [(CLEAR, 50), (CLEAR, 5), (CLEAR, -2), (HAZE, 30), (HAZE, 3), (ODD, 20)],
    ids=lambda value: {id(CLEAR): "clear", id(HAZE): "haze", id(ODD): "odd"}.get(id(value)),
)
def test_mean_is_that_of_the_path_tracer_in_numpy(air, sun):
    views = [(20, 15), (100, 5), (160, 60), (60, -15)]
    traced, noise = trace(air, directions(views), sun, paths=600, bounces=14, seed=1)
    for view, expected, error in zip(views, traced, noise, strict=True):
        mean, own = estimate(air, sun, view)
        # 96 comparisons: four and a half standard errors. A hundredth more for steps that are
        # longer than the truth's (0.5 % was seen).
        assert np.all(np.abs(mean - expected) < 4.5 * np.hypot(own, error) + 0.01 * expected)


@pytest.mark.parametrize("sun", [60, 10, 0, -4])
@pytest.mark.parametrize("view", [(40, 2), (40, 15), (120, 70), (80, -10)])
def test_first_order_is_the_march(sun, view):
    mean, noise = estimate(CLEAR, sun, view, orders=1, side=16)
    march = SkyTable(CLEAR, quality=Quality(groups=200), multiple_scattering=False)
    expected = march.radiance(view[1], view[0], sun)
    # 48 strata against 400 steps: 0.3 % by day, 1 % where the sun is on the horizon.
    allowed = 0.005 if sun > 0 else 0.02
    brightest = march.radiance(15, 40, sun)
    assert np.all(np.abs(mean - expected) < 4 * noise + allowed * expected + 1e-3 * brightest)


def test_light_grows_with_every_order_and_ends():
    light = [estimate(HAZE, 30, (90, 20), orders=n, runs=8)[0] for n in (1, 2, 3, 8, 0)]
    assert np.all(np.diff(light[:4], axis=0) > 0)
    # Beyond eight orders lies 0.1 to 1 %; paths differ not before they part.
    assert np.all(light[4] >= light[3])
    assert light[4] == pytest.approx(light[3], rel=0.02)


@pytest.mark.parametrize("elevation", [-20, 8, 50])
def test_air_that_absorbs_nothing_over_white_ground_is_a_furnace(elevation):
    # Sunlight from everywhere is an even light. Whichever way one looks in conservative air, what
    # is scattered this way and what comes straight through make up that light again.
    air = Atmosphere(aerosol_albedo=1, ozone=0, ground_albedo=1, aerosol_optical_depth=0.1)
    suns = np.degrees(np.arcsin((np.arange(48) + 0.5) / 24 - 1))
    turns = 360 * (0.618 * np.arange(48) % 1)
    means, errors = zip(
        *(
            estimate(air, sun, (turn, elevation), runs=3)
            for sun, turn in zip(suns, turns, strict=True)
        ),
        strict=True,
    )
    scattered = 4 * np.pi * np.mean(means, axis=0) / solar_irradiance()
    noise = 4 * np.pi * np.linalg.norm(errors, axis=0) / 48 / solar_irradiance()
    through = direct_irradiance(air, elevation) / solar_irradiance() if elevation > 0 else 0
    # 48 suns stand for all: 2 %.
    assert np.all(np.abs(scattered + through - 1) < 4 * noise + 0.02)


def test_history_is_a_mean_whose_noise_falls_as_the_root_of_the_runs():
    means = paths(CLEAR, 30, (90, 30), runs=64)
    samples = np.diff(means * np.arange(1, 65)[:, None, None], axis=0, prepend=0)
    assert samples.min() > 0
    # Single paths of a pixel owe nothing to each other, nor to those of its neighbours.
    deviation = samples.std(axis=(0, 1)) / np.sqrt(64)
    assert means[-1].std(axis=0) == pytest.approx(deviation, rel=0.1)
    rows = means[0].reshape(32, 32, 4)[..., 3]
    assert abs(np.corrcoef(rows[:, 1:].ravel(), rows[:, :-1].ravel())[0, 1]) < 0.12


def test_colours_share_their_paths():
    # Hero wavelengths: what a path brings varies far more than its colour does.
    samples = paths(CLEAR, 60, (90, 30), runs=1, side=64)[-1]
    colour = samples / samples.mean(axis=0)
    assert (colour[:, 1] / colour[:, 2]).std() < 0.5 * colour[:, 2].std()


@pytest.mark.parametrize(
    "air",
    [
        Atmosphere(air_density=0, aerosol_optical_depth=0, ozone=0),
        Atmosphere(air_density=0, aerosol_optical_depth=0, ozone=300, ground_albedo=1),
        Atmosphere(aerosol_optical_depth=0.6, aerosol_asymmetry=0.95, aerosol_albedo=1),
        Atmosphere(aerosol_optical_depth=0.6, aerosol_asymmetry=0, aerosol_scale_height=200),
        Atmosphere(altitude=30_000, ground_albedo=1, rayleigh_scale_height=15_000),
    ],
)
def test_every_corner_of_the_sliders_draws_finite_light(air):
    for sun in (-12, 0, 90):
        for view in ((0, 90), (10, 0), (180, -90)):
            samples = paths(air, sun, view, runs=2, side=8)
            assert np.all(np.isfinite(samples))
            assert samples.min() >= 0


def test_it_is_within_what_browsers_understand():
    header = "#version 300 es\nprecision highp float;\nprecision highp int;\n"
    header += "precision highp sampler2D;\n"
    corner = header + "void main() { gl_Position = vec4(float(gl_VertexID), 0.0, 0.0, 1.0); }\n"

    def task(context):
        if "GL_ARB_ES3_compatibility" not in context.extensions:
            pytest.skip("this driver compiles no GLSL ES")
        for shader in ("explorer/reference", "bruneton/view"):
            text = header + resolve_includes(f"{shader}.glsl")
            context.program(vertex_shader=corner, fragment_shader=text)

    on_gl_thread(task)
