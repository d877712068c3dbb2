"""The atmosphere's shaders, run by the renderer on EGL, against the reference sky in NumPy.

Both sample alike (``multiple.SHADER``). What is left is single precision, the tables' grids and,
for the sky view, its own interpolation.
"""

import numpy as np
import pytest

from sunwidget.atmosphere import optics
from sunwidget.atmosphere.color import spectral_to_rec709
from sunwidget.atmosphere.parameters import Atmosphere
from sunwidget.atmosphere.presets import PRESETS
from sunwidget.atmosphere.sky import SHADER, SkyTable
from sunwidget.atmosphere.sun import disc_radiance
from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.graph import FrameGraph, Programs
from sunwidget.renderer.shader_source import (
    EGL_HEADER,
    FULL_SCREEN_TRIANGLE,
    frame_graph,
    resolve_includes,
)

pytest.importorskip("moderngl")

PROBE = """
uniform sampler2D sky_view;
uniform sampler2D columns;
uniform sampler2D directions;
uniform int what;
out vec4 result;

void main() {
  vec3 direction = texelFetch(directions, ivec2(gl_FragCoord.xy), 0).xyz;
  vec3 sun = ReadSkyView(sky_view).sun;
  result = what == 0 ? GetSkyRadiance(sky_view, direction)
      : what == 1 ? GetSunDiscRadiance(columns, direction, sun, 1.0, 1.0, 1e-6)
      : vec4(SpectralToRec709(GetSkyRadiance(sky_view, direction)), 0.0);
}
"""


class Shaders:
    """The passes from columns to light, and look-ups in what they draw."""

    def __init__(self, context):
        self.context = context
        self.graph = FrameGraph(Programs(context), {})
        text = EGL_HEADER + resolve_includes("atmosphere/sun_disc_radiance.glsl") + PROBE
        self.probe = context.program(vertex_shader=FULL_SCREEN_TRIANGLE, fragment_shader=text)
        self.triangle = context.vertex_array(self.probe, [])

    def draw(self, air, sun_elevation, sun_azimuth=0.0, orders=0):
        values = {
            **air.parameters(),
            "scattering_orders": float(orders),
            "sun_elevation": float(sun_elevation),
            "sun_azimuth": float(sun_azimuth),
        }
        self.values = values
        passes = {row["name"]: row for row in frame_graph()["passes"]}
        wanted = set()

        def need(name):
            wanted.add(name)
            for source in dict(passes[name]["inputs"]).values():
                need(source)

        need("light_source")
        for name, row in passes.items():
            if name in wanted:
                self.graph._run_pass(row, tuple(row["size"]), values, {}, {"tile_origin": (0, 0)})
        return self

    def read(self, name):
        texture = self.graph.targets[name].texture
        width, height = texture.size
        return np.frombuffer(texture.read(), np.float32).reshape(height, width, 4)

    def look(self, directions, what=0):
        count = len(directions)
        padded = np.zeros((count, 4), np.float32)
        padded[:, :3] = directions
        source = self.context.texture((count, 1), 4, padded.tobytes(), dtype="f4")
        target = self.context.texture((count, 1), 4, dtype="f4")
        frame = self.context.framebuffer([target])
        for name, value in self.values.items():
            if name in self.probe:
                self.probe[name].value = value
        self.graph.targets["sky_view_source"].texture.use(0)
        self.graph.targets["columns_source"].texture.use(1)
        source.use(2)
        for unit, name in enumerate(("sky_view", "columns", "directions")):
            self.probe[name].value = unit
        self.probe["what"].value = what
        frame.use()
        self.triangle.render(vertices=3)
        return np.frombuffer(target.read(), np.float32).reshape(count, 4).astype(float)


_made = {}


def shaders(task):
    """Run ``task(Shaders)`` on the GL thread, with one set of compiled shaders."""

    def run(context):
        if context not in _made:
            _made[context] = Shaders(context)
        return task(_made[context])

    return on_gl_thread(run)


def unit_vectors(elevation, azimuth):
    e, a = np.radians(np.broadcast_arrays(elevation, azimuth)).reshape(2, -1)
    return np.stack([np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a)], axis=1)


def all_over_the_sky(sun_elevation, count=600, seed=0):
    """Directions above the horizon, a third of them within a few degrees of the sun."""
    rng = np.random.default_rng(seed)
    elevation = np.concatenate([90 * rng.random(count) ** 2, sun_elevation + rng.normal(0, 4, 300)])
    azimuth = np.concatenate([rng.uniform(-180, 180, count), rng.normal(0, 4, 300)])
    return np.clip(elevation, 0.02, 89.9), azimuth


CLEAR = Atmosphere()
HAZY = Atmosphere(aerosol_optical_depth=0.4, aerosol_albedo=0.9, angstrom_exponent=1.3)
HIGH = Atmosphere(altitude=4000, ground_albedo=0.7)


def errors_all_over_the_sky(air, sun):
    """Relative error of the worst wavelength in each direction, shaders against NumPy."""
    elevation, azimuth = all_over_the_sky(sun)
    drawn = shaders(lambda s: s.draw(air, sun).look(unit_vectors(elevation, azimuth)))
    reference = SkyTable(air, quality=SHADER).radiance(elevation, azimuth, sun)
    return np.abs(drawn / reference - 1).max(axis=1)


@pytest.mark.parametrize("air", [CLEAR, HAZY, HIGH], ids=["clear", "hazy", "high"])
@pytest.mark.parametrize(
    ("sun", "typical", "worst"),
    # Interpolation errs more where light varies faster: by day 0.2 %, in twilight 1 to 2 %.
    [
        (75, 1e-3, 0.005),
        (30, 1e-3, 0.005),
        (8, 2e-3, 0.01),
        (1, 2e-3, 0.02),
        (-2, 2e-3, 0.02),
        (-6, 3e-3, 0.03),
        (-11, 4e-3, 0.04),
    ],
)
def test_sky_view_agrees_with_the_reference_sky(air, sun, typical, worst):
    error = errors_all_over_the_sky(air, sun)
    assert np.median(error) < typical
    assert np.quantile(error, 0.99) < worst


THIN_HAZE = Atmosphere(aerosol_scale_height=400, aerosol_optical_depth=0.2)
OTHER_AIR = Atmosphere(
    air_density=1.6,
    rayleigh_exponent=2.0,
    rayleigh_scale_height=12_000,
    aerosol_scale_height=4000,
)
NO_AIR = Atmosphere(air_density=0, aerosol_optical_depth=0.3)


@pytest.mark.parametrize(
    "air",
    [THIN_HAZE, OTHER_AIR, NO_AIR, PRESETS["thesis"]],
    ids=["thin haze", "other air", "no air", "thesis"],
)
@pytest.mark.parametrize(
    ("sun", "typical", "worst"),
    # As above; haze of 400 m lies between fewer rows of the table of columns, which have other
    # sizes on the two hosts.
    [(50, 1.5e-3, 0.01), (5, 2e-3, 0.02), (-4, 5e-3, 0.03)],
)
def test_the_drawn_sky_of_other_air_agrees_with_numpy(air, sun, typical, worst):
    error = errors_all_over_the_sky(air, sun)
    assert np.median(error) < typical
    assert np.quantile(error, 0.99) < worst


@pytest.mark.parametrize("orders", [1, 2, 3, 4, 7])
@pytest.mark.parametrize(
    ("air", "sun", "typical", "worst"),
    # The lower the sun the more the first order is what the tables of columns say, which have
    # other sizes on the two hosts; other orders dilute that.
    [(CLEAR, 30, 2e-3, 0.01), (HAZY, 3, 6e-3, 0.05), (CLEAR, -4, 0.03, 0.09)],
    ids=["day", "low sun", "twilight"],
)
def test_the_first_orders_of_scattering_agree_with_numpy(orders, air, sun, typical, worst):
    elevation, azimuth = all_over_the_sky(sun, count=200)
    views = unit_vectors(elevation, azimuth)
    drawn = shaders(lambda s: s.draw(air, sun, orders=orders).look(views))
    reference = SkyTable(air, quality=SHADER, orders=orders).radiance(elevation, azimuth, sun)
    # The first order leaves the far side of a twilight sky in the shadow of the earth: there a
    # hundredth of the brightest counts instead of nothing.
    floor = 0.01 * reference.max(axis=0)
    error = (np.abs(drawn - reference) / (reference + floor)).max(axis=1)
    assert np.median(error) < typical
    assert np.quantile(error, 0.99) < worst


def test_orders_end_at_all_of_them():
    def skies(s):
        return [s.draw(HAZY, 20, orders=n).read("sky_view_source")[:-1] for n in (1, 2, 3, 16, 0)]

    once, twice, thrice, sixteen, whole = shaders(skies)
    assert np.all(once < twice)
    assert np.all(twice < thrice)
    assert np.all(thrice < sixteen)
    assert sixteen == pytest.approx(whole, rel=1e-3)


def test_nothing_in_the_air_is_black():
    nothing = Atmosphere(air_density=0, aerosol_optical_depth=0, ozone=0)
    for orders in (0, 1, 2, 5):
        sky = shaders(
            lambda s, n=orders: s.draw(nothing, 20, orders=n).read("sky_view_source")[:67]
        )
        assert np.all(sky == 0)


def test_ground_below_the_horizon_agrees_too():
    elevation, azimuth = np.array([-80, -30, -8, -2.0])[:, None], np.arange(0, 181, 20.0)
    views = unit_vectors(elevation, azimuth)
    for sun in (50, 10, -3):
        drawn = shaders(lambda s, sun=sun: s.draw(HIGH, sun).look(views))
        reference = SkyTable(HIGH, quality=SHADER).radiance(elevation, azimuth, sun)
        # Twelve rows are spent on what a photo of the sky hardly shows.
        assert drawn == pytest.approx(reference.reshape(-1, 4), rel=0.03)


def test_sky_turns_with_the_sun():
    views = unit_vectors(np.array([3, 20, 50.0])[:, None], np.array([-60, 0, 45, 170.0]))
    turned = unit_vectors(np.array([3, 20, 50.0])[:, None], np.array([-60, 0, 45, 170.0]) + 73)
    straight = shaders(lambda s: s.draw(CLEAR, 12).look(views))
    aside = shaders(lambda s: s.draw(CLEAR, 12, 73).look(turned))
    assert aside == pytest.approx(straight, rel=1e-3)


@pytest.mark.parametrize(
    "air",
    [CLEAR, OTHER_AIR, Atmosphere(aerosol_scale_height=200)],
    ids=["standard", "other", "low haze"],
)
def test_columns_of_air_agree_with_their_integrals(air):
    drawn = shaders(lambda s: s.draw(air, 30).read("columns_source"))
    # Row 0 is sea level; its first sample looks up, its last one to the horizon.
    for column, mu in ((0, 1), (-1, 0)):
        exact = optics.integrate_columns(0, mu, air.heights, steps=4000)
        # Forty steps; they round the corners of the ozone layer, 0.27 % of it.
        assert drawn[0, column, :3] == pytest.approx(exact, rel=3e-3)


@pytest.mark.parametrize(("sun", "allowed"), [(70, 0.01), (20, 0.01), (2, 0.01), (-5, 0.02)])
def test_light_is_the_integral_of_the_sky(sun, allowed):
    light = shaders(lambda s: s.draw(CLEAR, sun).read("light_source")[0])
    x, w = np.polynomial.legendre.leggauss(48)
    elevation, w = np.degrees(np.arcsin((x + 1) / 2)), w / 2
    azimuth = 3 * np.arange(120)
    sky = SkyTable(CLEAR, quality=SHADER).radiance(elevation[:, None], azimuth, sun)
    right, up, ahead = np.moveaxis(unit_vectors(elevation[:, None], azimuth), -1, 0)
    share = np.repeat(w * 2 * np.pi / 120, 120)

    def integral(cosine):
        weight = share * np.maximum(cosine, 0)
        return weight @ sky.reshape(-1, 4), weight.sum()

    for texel, cosine in {0: up, 2: -ahead, 3: right, 4: -right, 5: ahead}.items():
        assert light[texel] == pytest.approx(integral(cosine)[0], rel=allowed)
    whole, weight = integral(ahead)
    assert light[6] == pytest.approx(whole / weight, rel=allowed)


def test_sun_sets_in_the_light_table():
    def sunlight(elevation):
        return shaders(lambda s: s.draw(CLEAR, elevation).read("light_source")[0][[1, 7]])

    for elevation in (60, 10, 1):
        shown, risen = sunlight(elevation)
        # Both tables err by some 5e-4 of the optical depth, which is 9 in the blue at 1 degree.
        assert shown == pytest.approx(optics.direct_irradiance(CLEAR, elevation), rel=6e-3)
        assert shown == pytest.approx(risen, rel=1e-6)
    shown, risen = sunlight(0)
    # The eye is one metre up: its horizon lies 0.03 degrees below the level.
    dip = -np.arcsin(optics.cosine_of_horizon(1.0))
    assert shown == pytest.approx(risen * optics.visible_fraction(dip), rel=1e-3)
    shown, risen = sunlight(-0.5)
    assert np.all(shown == 0)
    assert np.all(risen > 0)


def test_light_moves_smoothly_with_the_sun():
    suns = np.arange(-12.0, 90.0, 0.7)

    def all_lights(s):
        return np.array([s.draw(HAZY, sun).read("light_source")[0][0] for sun in suns])

    light = shaders(all_lights)
    assert np.all(np.isfinite(light))
    change = np.diff(np.log(light), axis=0)
    # No step of its own: neighbouring changes differ little.
    assert np.abs(np.diff(change, axis=0)).max() < 0.12
    by_day = suns[2:] > 8
    assert np.abs(np.diff(change, axis=0))[by_day].max() < 0.02


def test_disc_agrees_and_integrates_to_the_sun():
    distance = np.array([0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3])
    for sun in (40.0, 3.0):
        drawn = shaders(
            lambda s, sun=sun: s.draw(CLEAR, sun).look(unit_vectors(sun + distance, 0.0), what=1)
        )
        reference = disc_radiance(CLEAR, sun + distance, distance)
        assert drawn == pytest.approx(reference, rel=0.01)


def test_drawn_colour_is_that_of_the_drawn_spectrum():
    views = unit_vectors(np.array([2, 30, 80.0])[:, None], np.array([0, 90, 180.0]))
    drawn = shaders(lambda s: s.draw(CLEAR, 15).look(views, what=2))[:, :3]
    spectral = shaders(lambda s: s.draw(CLEAR, 15).look(views))
    assert drawn == pytest.approx(spectral_to_rec709(spectral), rel=1e-4)


@pytest.mark.parametrize(
    "air",
    [
        Atmosphere(aerosol_optical_depth=0, ozone=0, ground_albedo=0),
        Atmosphere(aerosol_optical_depth=0.6, aerosol_asymmetry=0.95, aerosol_albedo=1),
        Atmosphere(aerosol_optical_depth=0.6, aerosol_asymmetry=0, angstrom_exponent=2, ozone=500),
        Atmosphere(altitude=30_000, ground_albedo=1),
        Atmosphere(air_density=2, rayleigh_exponent=6, rayleigh_scale_height=15_000),
        Atmosphere(
            rayleigh_exponent=0,
            rayleigh_scale_height=3000,
            aerosol_scale_height=200,
            aerosol_optical_depth=0.6,
        ),
        Atmosphere(air_density=0, aerosol_scale_height=6000, aerosol_optical_depth=0.6),
    ],
)
def test_every_corner_of_the_sliders_draws_finite_light(air):
    for sun in (-12, -6, -0.2665, 0, 0.2665, 30, 90):
        sky, light = shaders(
            lambda s, sun=sun: (
                s.draw(air, sun).read("sky_view_source")[:-1],
                s.read("light_source")[0],
            )
        )
        assert np.all(np.isfinite(sky))
        assert sky.min() >= 0
        assert sky.max() > 0
        assert np.all(np.isfinite(light))
        assert np.all(light[0] > 0)
