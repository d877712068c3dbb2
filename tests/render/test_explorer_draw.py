"""SkyExplorer's picture and curves, drawn on EGL, against closed forms and the sky in NumPy."""

import numpy as np
import pytest

from sunwidget.atmosphere import optics
from sunwidget.atmosphere.color import chromaticity, spectral_to_rec709, spectral_to_xyz
from sunwidget.atmosphere.parameters import RANGES, Atmosphere
from sunwidget.atmosphere.sky import SHADER, SkyTable
from sunwidget.errors import EditError
from sunwidget.explorer import draw as module
from sunwidget.explorer.draw import (
    BACKGROUND,
    CURVES,
    curve,
    draw,
    radiance_at,
    radiance_map,
    table,
)
from sunwidget.explorer.projection import Projection
from sunwidget.explorer.table import EXPLORER_PARAMETERS, PROJECTIONS
from sunwidget.renderer.gl_thread import on_gl_thread
from sunwidget.renderer.graph import FrameGraph, Programs

pytest.importorskip("moderngl")

SIZE = (96, 72)
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def sky(**changes):
    return {p.name: p.default for p in EXPLORER_PARAMETERS} | changes


def air(values):
    return Atmosphere(**{name: values[name] for name in RANGES})


HAZY = {"aerosol_optical_depth": 0.3, "angstrom_exponent": 1.4, "aerosol_asymmetry": 0.8}
ODD = {"air_density": 1.4, "rayleigh_exponent": 3.0, "rayleigh_scale_height": 7000.0}
HIGH = {"altitude": 9000.0, "aerosol_scale_height": 3000.0, "ozone": 420.0}
AIRS = pytest.mark.parametrize(
    "changes", [{}, HAZY, ODD, HIGH], ids=["clear", "hazy", "odd", "high"]
)


# ---- Curves ----------------------------------------------------------------------------------


@AIRS
def test_phase_functions_are_the_closed_forms(changes):
    values = sky(**changes)
    drawn = curve(values, "curve_phase")
    nu = np.cos(np.radians(np.arange(181)))
    rayleigh = optics.rayleigh_phase(nu)
    mie = optics.cornette_shanks_phase(nu, values["aerosol_asymmetry"])
    density = optics.density(optics.camera_height(air(values)), air(values).heights)
    extinction = optics.extinction_coefficients(air(values), [550.0])[:, 0]
    by_air = density[0] * extinction[0]
    by_haze = density[1] * extinction[1] * values["aerosol_albedo"]
    mixture = (by_air * rayleigh + by_haze * mie) / (by_air + by_haze)
    # Single precision; a narrow lobe loses a digit in 1 + g² - 2 g nu.
    assert drawn[:, :3] == pytest.approx(np.stack([rayleigh, mie, mixture], axis=1), rel=2e-5)


def test_mixed_phase_of_empty_air_is_zero_and_not_a_hole():
    drawn = curve(sky(show_rayleigh=False, show_aerosol=False), "curve_phase")
    assert np.all(drawn[:, 2] == 0)
    assert np.all(drawn[:, :2] > 0)


@AIRS
@pytest.mark.parametrize("elevation", [60.0, 8.0, 0.5])
def test_transmittance_is_beer_and_lambert_along_the_path(changes, elevation):
    values = sky(sun_elevation=elevation, **changes)
    drawn = curve(values, "curve_transmittance")
    nm = np.linspace(380, 780, 64)
    a = air(values)
    columns = optics.columns_to_top(
        optics.camera_height(a), np.sin(np.radians(elevation)), a.heights
    )
    depth = columns[:, None] * optics.extinction_coefficients(a, nm)
    wanted = np.exp(-np.stack([depth.sum(axis=0), *depth], axis=1))
    # The shader's table of columns errs by up to 0.6 %, and 1 % in the ozone of a grazing path.
    allowed = np.array([6e-3, 6e-3, 6e-3, 12e-3])
    optical_depth = -np.log(np.maximum(wanted, 1e-30))
    assert np.all(np.abs(drawn - wanted) <= wanted * (1e-4 + allowed * optical_depth) + 1e-7)


def test_transmittance_at_any_wavelength_is_that_of_the_four():
    values = sky(sun_elevation=15.0, **ODD)
    drawn = curve(values, "curve_transmittance")[:, 0]
    nm = np.linspace(380, 780, 64)
    light = table(values, "light")[0]
    four = light[7] / [1.630338, 1.836524, 1.924005, 1.826819]
    near = np.interp([640, 580, 510, 440], nm, drawn)
    # Linear between samples 6 nm apart, over the curvature of λ⁻⁴ in the blue.
    assert near == pytest.approx(four, rel=2e-3)


@AIRS
def test_sun_reddens_as_in_numpy(changes):
    values = sky(**changes)
    drawn = curve(values, "curve_sun")
    elevation = -1 + 91 * (np.arange(96) / 95) ** 2
    light = spectral_to_rec709(optics.direct_irradiance(air(values), elevation))
    flux = light @ LUMINANCE
    # Up to optical depths of ten the tables of columns err by 5e-4 of it each; the step where the
    # sun sets is steep.
    assert drawn[:, 3] == pytest.approx(flux, rel=0.012, abs=1e-3 * flux.max())
    assert drawn[:, :3] == pytest.approx(light, rel=0.012, abs=1e-3 * flux.max())
    assert np.all(np.diff(drawn[:, 3]) >= 0)


@AIRS
@pytest.mark.parametrize("elevation", [40.0, 5.0, -4.0])
def test_principal_plane_is_a_cut_through_the_sky(changes, elevation):
    values = sky(sun_elevation=elevation, sun_azimuth=130.0, **changes)
    drawn = curve(values, "curve_principal_plane")
    angle = np.arange(181.0)
    height = np.where(angle <= 90, angle, 180 - angle)
    azimuth = np.where(angle <= 90, 0.0, 180.0)
    reference = SkyTable(air(values), quality=SHADER).radiance(height, azimuth, elevation)
    error = np.abs(drawn / reference - 1).max(axis=1)
    # The sky view's own interpolation: tests/parity/test_atmosphere_shaders.py.
    assert np.median(error) < 4e-3
    assert error.max() < 0.04


def test_principal_plane_of_single_scattering_follows_the_model():
    values = sky(model="single", sun_elevation=10.0)
    drawn = curve(values, "curve_principal_plane")
    angle = np.arange(0, 91.0)
    reference = SkyTable(air(values), quality=SHADER, orders=1).radiance(angle, 0.0, 10.0)
    assert np.abs(drawn[:91] / reference - 1).max() < 0.03


@AIRS
def test_zenith_turns_blue_as_in_numpy(changes):
    values = sky(**changes)
    drawn = curve(values, "curve_zenith")
    elevation = -12 + 0.5 * np.arange(81)
    reference = SkyTable(air(values), quality=SHADER).radiance(90.0, 0.0, elevation)
    xyz = spectral_to_xyz(reference)
    # Interpolation in the table of scattered light, in twilight over a fall of e each degree.
    assert drawn[:, 2] == pytest.approx(1000 * xyz[:, 1], rel=0.04)
    assert drawn[:, :2] == pytest.approx(chromaticity(xyz), abs=0.003)


def test_every_curve_is_finite_at_the_ends_of_every_slider():
    for row in EXPLORER_PARAMETERS:
        if row.kind != "number":
            continue
        for end in (row.minimum, row.maximum):
            for name in CURVES:
                drawn = curve(sky(**{row.name: end}), name)
                assert np.all(np.isfinite(drawn)), f"{name} with {row.name} = {end}"


def test_an_unknown_curve_is_an_error_that_names_the_others():
    with pytest.raises(EditError, match="'curve_rainbow'.*curve_phase"):
        curve(sky(), "curve_rainbow")


def test_radiance_in_a_direction_is_the_curves():
    values = sky(sun_elevation=25.0, sun_azimuth=-40.0)
    plane = curve(values, "curve_principal_plane")
    seen = radiance_at(values, [[-40, 0], [-40, 60], [140, 70], [140, 10]])
    assert seen == pytest.approx(plane[[0, 60, 110, 170]], rel=1e-4)


# ---- Terms and models ------------------------------------------------------------------------


def test_the_orders_of_scattering_add_up():
    whole = radiance_map(sky(sun_elevation=12.0), SIZE)
    single = radiance_map(sky(sun_elevation=12.0, show_multiple=False), SIZE)
    rest = radiance_map(sky(sun_elevation=12.0, show_single=False), SIZE)
    none = radiance_map(sky(sun_elevation=12.0, show_single=False, show_multiple=False), SIZE)
    seen = np.isfinite(whole)
    assert seen.mean() > 0.3
    assert (single + rest)[seen] == pytest.approx(whole[seen], rel=1e-5)
    assert np.all(none[seen] == 0)
    assert np.all(single[seen] > 0)
    assert np.all(rest[seen] > 0)


def test_single_scattering_alone_is_the_model_of_single_scattering():
    term = radiance_map(sky(show_multiple=False), SIZE)
    model = radiance_map(sky(model="single"), SIZE)
    assert np.nan_to_num(term) == pytest.approx(np.nan_to_num(model), rel=1e-5)


def test_without_air_the_sky_is_black_and_the_sun_is_not():
    values = sky(show_rayleigh=False, show_aerosol=False, show_ozone=False, ground_albedo=0.0)
    assert np.nanmax(radiance_map(values, SIZE)) < 1e-6
    assert draw(values | {"sun_azimuth": 90.0}, SIZE).max() > 200


def test_two_models_stand_side_by_side():
    both = radiance_map(sky(compare="single"), SIZE)
    left = radiance_map(sky(), SIZE)
    right = radiance_map(sky(model="single"), SIZE)
    middle = SIZE[0] // 2
    assert np.array_equal(both[:, :middle], left[:, :middle], equal_nan=True)
    assert np.array_equal(both[:, middle:], right[:, middle:], equal_nan=True)


def test_a_finer_table_draws_the_same_sky():
    coarse = radiance_map(sky(), SIZE)
    fine = radiance_map(sky(grid="256×128"), SIZE)
    assert np.nanmedian(np.abs(coarse / fine - 1)) < 2e-3


def test_brunetons_model_without_its_table_says_where_to_get_it():
    with pytest.raises(EditError, match="bruneton_table"):
        draw(sky(compare="bruneton"), SIZE)


# ---- Exposure and display --------------------------------------------------------------------


def shown(**changes):
    # Where the dome is: away from the rim and the background.
    picture = draw(sky(**changes), (80, 80)).astype(float)
    return picture[16:64, 16:64]


def test_twilight_is_darker_than_day_and_blue():
    day, dusk = shown(sun_elevation=40.0), shown(sun_elevation=-6.0)
    assert 0.25 * day.mean() < dusk.mean() < 0.9 * day.mean()
    red, green, blue = dusk.mean(axis=(0, 1))
    assert blue > green > red
    assert dusk.max() < 250


def test_locked_exposure_lets_night_fall():
    assert shown(sun_elevation=-6.0, auto_exposure=0.0).max() < 3
    assert shown(sun_elevation=40.0, auto_exposure=0.0).mean() > 80


def test_full_adaptation_keeps_the_mean_luminance():
    means = [
        table(sky(sun_elevation=e, auto_exposure=1.0), "adaptation")[0, 0, 3]
        * (1.06 * light[0] + 0.06 * max(np.sin(np.radians(e)), 0) * light[1])
        for e in (60.0, 10.0, -5.0)
        for light in [spectral_to_rec709(table(sky(sun_elevation=e), "light")[0]) @ LUMINANCE]
    ]
    # One gain times the mean that it was made from.
    assert means == pytest.approx([means[0]] * 3, rel=1e-3)


def test_a_stop_is_a_factor_of_two():
    gain = [table(sky(exposure=ev), "adaptation")[0, 0, 3] for ev in (0.0, 1.0)]
    assert gain[1] == pytest.approx(2 * gain[0], rel=1e-5)


def test_from_thirty_kilometres_the_zenith_is_nearly_black():
    high = draw(sky(altitude=30000.0, sun_elevation=60.0), (81, 81))
    assert high[52, 40].max() < 40
    assert shown(sun_elevation=60.0)[30, 24].max() > 120


def test_a_low_sun_is_orange_around_and_not_yellow_green():
    picture = draw(sky(sun_elevation=1.0, projection="camera"), (150, 100)).astype(float)
    red, green, blue = picture[60, 60:90].mean(axis=0)
    assert red > green > blue
    assert red - blue > 60


def test_no_colour_falls_to_black_outside_the_gamut():
    for elevation in (-12.0, -8.0, -3.0, 0.0, 3.0):
        picture = shown(sun_elevation=elevation)
        assert np.all(picture.max(axis=-1) > 25), elevation


def test_the_sun_is_seen_at_the_size_of_a_dome():
    for elevation, azimuth in ((60.0, 30.0), (30.0, 200.0)):
        values = sky(sun_elevation=elevation, sun_azimuth=azimuth)
        with_sun, without = (draw(values | {"sun_size": s}, (256, 256)) for s in (1.0, 0.0))
        x, y = module.projection(values, (256, 256)).pixel(azimuth, elevation)
        change = np.abs(with_sun.astype(int) - without).max(axis=-1)
        row, column = np.unravel_index(change.argmax(), change.shape)
        assert change.max() > 20
        assert abs(column + 0.5 - x) <= 1.5
        assert abs(row + 0.5 - y) <= 1.5


def test_around_the_dome_lies_the_background():
    picture = draw(sky(), (120, 80))
    assert np.all(picture[0, 0] == BACKGROUND)
    assert np.all(picture[40, 5] == BACKGROUND)
    assert np.any(picture[40, 60] != BACKGROUND)


@pytest.mark.parametrize("projection", PROJECTIONS)
def test_the_same_values_draw_the_same_picture(projection):
    first = draw(sky(projection=projection), SIZE)
    draw(sky(projection=projection, sun_elevation=3.0), (40, 50))
    assert np.array_equal(draw(sky(projection=projection), SIZE), first)


@pytest.mark.parametrize("projection", PROJECTIONS)
def test_bands_join_without_a_seam(projection, monkeypatch):
    values = sky(projection=projection, compare="single")
    whole = draw(values, SIZE)
    seen = []
    monkeypatch.setattr(module, "_BAND_PIXELS", 11 * SIZE[0])
    assert np.array_equal(draw(values, SIZE, progress=lambda *step: seen.append(step)), whole)
    assert len(seen) == 7
    assert seen[-1][0] == 1


@pytest.mark.parametrize("size", [(0, 10), (10,), (1.5, 2), "ab", None])
def test_an_impossible_size_is_refused(size):
    with pytest.raises(EditError, match="size must be"):
        draw(sky(), size)


# ---- Projections -----------------------------------------------------------------------------

LOOK = {"view_azimuth": 75.0, "view_elevation": 20.0, "fov": 70.0}


def unit_vector(azimuth, elevation):
    a, e = np.radians(azimuth), np.radians(elevation)
    return np.stack([np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a)], axis=-1)


@pytest.mark.parametrize("name", PROJECTIONS)
@pytest.mark.parametrize("size", [(120, 80), (64, 200)])
def test_shader_and_python_look_the_same_way(name, size):
    drawn = on_gl_thread(lambda context: rays(context, sky(projection=name, **LOOK), size))
    x, y = np.meshgrid(np.arange(size[0]) + 0.5, np.arange(size[1]) + 0.5)
    angles = Projection(name=name, size=size, **LOOK).direction(x, y)
    inside = np.isfinite(angles[..., 0])
    assert np.array_equal(drawn[..., 3] >= 0.5, inside)
    # Single precision over angles of up to 2 pi, and the rasteriser's arc tangent.
    wanted = unit_vector(*np.moveaxis(angles, -1, 0))
    assert np.abs(drawn[..., :3] - wanted)[inside].max() < 5e-6


def rays(_context, values, size):
    return module._run(values, size, {}, "rays", {})


@pytest.mark.parametrize("name", PROJECTIONS)
def test_a_pixel_and_its_direction_belong_together(name):
    view = Projection(name=name, size=(300, 200), **LOOK)
    x, y = np.meshgrid(np.arange(300) + 0.5, np.arange(200) + 0.5)
    angles = view.direction(x, y)
    back = view.pixel(angles[..., 0], angles[..., 1])
    inside = np.isfinite(angles[..., 0])
    assert inside.mean() > 0.2
    assert back[inside] == pytest.approx(np.stack([x, y], axis=-1)[inside], abs=1e-6)


def test_in_the_dome_one_looks_up():
    view = Projection(name="dome", size=(200, 200))
    x, y = view.pixel(0, 0)
    assert (x, y) == pytest.approx((100, 6))  # north at the top, on the rim
    assert view.pixel(90, 0) == pytest.approx([6, 100])  # east on the left
    assert view.pixel(33, 90) == pytest.approx([100, 100])
    assert Projection(name="dome", size=(200, 200), view_azimuth=90.0).pixel(90, 0)[1] == 6


def test_in_the_camera_azimuths_grow_to_the_right():
    view = Projection(name="camera", size=(300, 200), view_elevation=0.0, fov=60.0)
    assert view.pixel(10, 0)[0] > 150
    assert view.pixel(0, 30)[1] == pytest.approx(0)
    assert np.all(np.isnan(view.pixel(180, 0)))


def test_a_panorama_holds_all_azimuths_once():
    view = Projection(name="panorama", size=(720, 200), view_azimuth=180.0)
    angles = view.direction(np.arange(720) + 0.5, 100.0)
    assert np.sort(angles[:, 0]) == pytest.approx(np.arange(-179.75, 180, 0.5))
    assert view.direction(360, [0.01, 199.99])[:, 1] == pytest.approx([90, -10], abs=0.02)


def test_browser_and_python_project_alike(in_node):
    cases = [
        {"name": name, "size": size, "look": LOOK} for name in PROJECTIONS for size in [(300, 200)]
    ]
    grid = [[x, y] for x in range(5, 300, 29) for y in range(5, 200, 21)]
    script = """
      import { Projection } from "./src/explorer/projection.js";
      const { cases, grid } = asked;
      const all = cases.map(({ name, size, look }) => {
        const view = new Projection(name, size, look);
        return grid.map(([x, y]) => {
          const seen = view.direction(x, y);
          return seen && [...seen, ...(view.pixel(...seen) ?? [])];
        });
      });
      answer(all);
    """
    found_by_browser = in_node(script, {"cases": cases, "grid": grid})
    x, y = np.array(grid, float).T
    for case, seen in zip(cases, found_by_browser, strict=True):
        angles = Projection(name=case["name"], size=case["size"], **LOOK).direction(x, y)
        assert np.isfinite(angles[:, 0]).sum() > 20
        for wanted, found, place in zip(angles, seen, grid, strict=True):
            if np.isnan(wanted[0]):
                # The browser goes on to -12 degrees, for a sun that is dragged below the horizon.
                assert found is None or found[1] < 0
            else:
                assert found == pytest.approx([*wanted, *place], abs=1e-9)


# ---- What is drawn again ---------------------------------------------------------------------


@pytest.fixture
def passes_run_by():
    """Draw; return the names of the passes that ran."""

    def run(**changes):
        before = on_gl_thread(lambda context: dict(module._graph(context, {}).runs))
        draw(sky(**changes), SIZE)
        after = on_gl_thread(lambda context: dict(module._graph(context, {}).runs))
        return {name for name, count in after.items() if count != before.get(name, 0)}

    return run


def test_moving_the_sun_leaves_the_air_and_the_rays_alone(passes_run_by):
    passes_run_by()
    assert passes_run_by(sun_elevation=21.0) == {
        "sky_view",
        "shown",
        "light",
        "adaptation",
        "sun_disc",
        "explorer_frame",
    }


def test_exposure_draws_no_sky(passes_run_by):
    passes_run_by()
    assert passes_run_by(exposure=1.0) == {"adaptation", "explorer_frame"}


def test_turning_the_view_draws_no_sky(passes_run_by):
    passes_run_by(projection="camera")
    ran = passes_run_by(projection="camera", view_azimuth=10.0)
    assert ran == {"rays", "explorer_frame"}


def test_single_terms_are_drawn_only_when_asked_for(passes_run_by):
    assert "sky_view_single" not in passes_run_by(ozone=215.0)  # a sky no other test draws
    assert "sky_view_single" in passes_run_by(ozone=215.0, show_multiple=False)
    assert "sky_view_single" not in passes_run_by(ozone=210.0)


def test_a_curve_draws_no_picture():
    draw(sky(), SIZE)
    before = on_gl_thread(lambda context: dict(module._graph(context, {}).runs))
    curve(sky(sun_elevation=33.0), "curve_zenith")
    after = on_gl_thread(lambda context: dict(module._graph(context, {}).runs))
    assert {n for n in after if after[n] != before.get(n, 0)} == {"curve_zenith"}


# ---- The runner's history --------------------------------------------------------------------

ACCUMULATE = """
uniform sampler2D history;
uniform float sample_index;
uniform float step_size;
out vec4 result;
void main() {
  vec4 before = texelFetch(history, ivec2(gl_FragCoord.xy), 0);
  result = sample_index > 0.5 ? before + step_size : vec4(sample_index, 0.0, 0.0, 1.0);
}
"""


def test_a_pass_with_history_gathers_and_begins_anew(monkeypatch):
    from sunwidget.renderer import shader_source

    monkeypatch.setattr(shader_source, "read_shader", lambda _path: ACCUMULATE)
    row = {"name": "sum", "shader": "sum", "size": "grid", "format": "output", "state": "edit"}
    description = {"passes": [{**row, "inputs": {}, "history": True}]}

    def task(context):
        graph = FrameGraph(Programs(context), {}, description)
        seen = []
        for step in (1.0, 1.0, 1.0, 2.0, 2.0):
            target = graph.run(
                {"edit": {"step_size": step}},
                {},
                {"frame_size": (3.0, 2.0)},
                (0, 0, 3, 2),
                (),
                sizes={"grid": (3, 2)},
            )
            texels = np.frombuffer(target.texture.read(), np.float32).reshape(2, 3, 4)
            assert np.ptp(texels[..., 0]) == 0
            seen.append((float(texels[0, 0, 0]), target.samples))
        return seen

    assert on_gl_thread(task) == [(0, 1), (1, 2), (2, 3), (0, 1), (2, 2)]


def test_brunetons_sky_is_drawn_from_its_table():
    from sunwidget.renderer.bruneton.precomputed_sky import bruneton_table

    made = bruneton_table(Atmosphere(), size="tiny", cache=False)
    cut = made.slice(0.0)
    values = sky(model="bruneton", compare="multiple", sun_elevation=30.0)
    both = radiance_map(values, SIZE, bruneton=cut)
    middle = SIZE[0] // 2
    left, right = both[:, :middle], both[:, : middle - 1 : -1]
    # The sun stands in the north, so the halves mirror each other; the models are 1 to 3 % apart,
    # and so small a table adds as much.
    assert np.nanmedian(np.abs(left / right - 1)) < 0.05
    assert not np.array_equal(left, right, equal_nan=True)
    values = values | {"sun_elevation": 10.0, "compare": "none"}
    plane = curve(values, "curve_principal_plane", bruneton=cut)
    # Interpolation in the view of 96 × 80.
    reference = made.radiance(np.arange(5, 90.0), 0.0, 10.0)
    assert plane[5:90] == pytest.approx(reference, rel=0.05)
    assert curve(values | {"model": "multiple", "compare": "bruneton"}, "curve_phase").all(axis=0)[
        0
    ]


def test_the_reference_is_the_same_sky_with_noise():
    values = sky(model="reference", sun_elevation=30.0)
    traced = radiance_map(values, (40, 40), samples=24)
    own = radiance_map(sky(sun_elevation=30.0), (40, 40))
    # About 1250 pixels × 24 paths: the mean is known to some 0.5 %, the models are 2 % apart.
    assert np.nanmean(traced, axis=(0, 1)) == pytest.approx(np.nanmean(own, axis=(0, 1)), rel=0.03)
    assert np.nanstd(traced / own) > 0.005
    assert np.array_equal(radiance_map(values, (40, 40), samples=24), traced, equal_nan=True)


def test_more_samples_leave_less_noise():
    values = sky(model="reference", sun_elevation=30.0)
    own = radiance_map(sky(sun_elevation=30.0), (40, 40))
    few, many = (np.nanstd(radiance_map(values, (40, 40), samples=n) / own) for n in (4, 64))
    # Four times less noise, but for what is no noise.
    assert many < 0.5 * few
